//! The robot in a working mode: a configuration is a function of the pose alone.
//!
//! In mode s the inverse model is closed form, so reachabilities H_j, joint limits c_k and det A are
//! functions of X. All working modes share everything but signs: row j of A, times the leg's weight > 0, is
//! fixed_j + s_j swing_j, so that weighted det A is multi-affine in the signs.

use super::WorkingMode;
use super::condition::Conditioner;
use super::minors::Minors;
use super::placement::{Placement, determinant, minor, out_of_frame, wrench};
use aspecta_robot::legs::{Closure, Drive};
use aspecta_robot::num::{Affine, Interval, Scalar, each};
use aspecta_robot::{Leg, LegIndex, Robot};

/// Every leg at one pose (or box of poses), with q eliminated; h not yet chosen.
pub fn closures<T: Scalar, const D: usize, const N: usize>(
    robot: &Robot,
    placement: &Placement<T, D>,
) -> [LegClosure<T, D>; N] {
    let zero = [T::zero(); D];
    let open = Closure { reach: T::zero(), weight: T::zero(), fixed: zero, swing: zero };
    let mut legs = [LegClosure { arm: zero, span: zero, closure: open, fold: None }; N];
    for (at, leg) in legs.iter_mut().zip(&robot.legs) {
        at.arm = placement.arm(leg);
        at.span = placement.span(leg, &at.arm);
        at.closure = leg.actuator.eliminate(&at.span);
    }
    legs
}

/// One leg at one pose.
#[derive(Clone, Copy, Debug)]
pub struct LegClosure<T, const D: usize> {
    /// r = R c, base frame.
    pub arm: [T; D],
    /// d = C − A, leg frame.
    pub span: [T; D],
    /// The leg equation with q eliminated.
    pub closure: Closure<T, D>,
    /// The leg's own state, where its own coordinates are used: B then has one sign at a point, and `closure`
    /// no part that changes sign.
    pub fold: Option<Folded<T>>,
}

/// A leg's state in its own coordinates, of which its q is one.
#[derive(Clone, Copy, Debug)]
pub struct Folded<T> {
    /// cos q.
    pub cos: T,
    /// sin q.
    pub sin: T,
    /// B_jj: the posture s has s B_jj > 0.
    pub b: T,
}

impl<T: Scalar, const D: usize> LegClosure<T, D> {
    /// s h = s √H for the postures + and −; where the leg's own coordinates are used, its B both times.
    pub fn heights(&self) -> [T; 2] {
        match &self.fold {
            Some(fold) => [fold.b; 2],
            None => {
                let h = self.closure.reach.sqrt();
                [h, -h]
            }
        }
    }

    /// The driven joint in the posture named by `sign`.
    pub fn drive(&self, leg: &Leg, sign: i8) -> Drive<T> {
        leg.actuator.drive(&self.span, &self.closure, self.heights()[usize::from(sign < 0)])
    }

    /// Whether [`Closure::weight`] varies with the pose.
    pub fn is_weighted(&self, leg: &Leg) -> bool {
        self.fold.is_none() && leg.actuator.is_angle()
    }

    /// Converts the closure to another scalar.
    pub fn map<U: Scalar>(&self, to: impl Fn(T) -> U) -> LegClosure<U, D> {
        let vector = |v: &[T; D]| each!(|k| to(v[k]));
        let Closure { reach, weight, fixed, swing } = &self.closure;
        LegClosure {
            arm: vector(&self.arm),
            span: vector(&self.span),
            closure: Closure {
                reach: to(*reach),
                weight: to(*weight),
                fixed: vector(fixed),
                swing: vector(swing),
            },
            fold: self.fold.map(|Folded { cos, sin, b }| Folded { cos: to(cos), sin: to(sin), b: to(b) }),
        }
    }
}

/// The rows of weighted A for both postures of every leg.
#[derive(Clone, Copy, Debug)]
pub struct ModalRows<T, const N: usize> {
    /// The part that both postures share.
    pub fixed: [[T; N]; N],
    /// The part that changes sign with the posture, times h.
    pub swing: [[T; N]; N],
}

impl<T: Scalar, const N: usize> ModalRows<T, N> {
    /// The rows, with h_j given.
    pub fn new<const D: usize>(robot: &Robot, legs: &[LegClosure<T, D>; N], h: &[T; N]) -> Self {
        let mut rows = Self { fixed: [[T::zero(); N]; N], swing: [[T::zero(); N]; N] };
        for (j, at) in legs.iter().enumerate() {
            let leg = &robot.legs[j];
            let fixed = out_of_frame(leg, &at.closure.fixed);
            let fixed: [T; N] = wrench(robot.platform, &fixed, &at.arm);
            rows.fixed[j] = each!(|k| fixed[k].tightened());
            if leg.actuator.postures() == 2 && at.fold.is_none() {
                let swing = out_of_frame(leg, &each!(|k| at.closure.swing[k] * h[j]));
                let swing: [T; N] = wrench(robot.platform, &swing, &at.arm);
                rows.swing[j] = each!(|k| swing[k].tightened());
            }
        }
        rows
    }

    /// The rows for modes in which legs that are one and the same are in opposite postures. With equal parts f and w their rows are
    /// f ± h w, and of det A the factor 2h > 0 is taken out: it is 2h times the determinant with f in place of the first and ± w in
    /// place of the second. That has the sign of det A, and need not vanish where these legs are singular.
    pub fn parted<const D: usize>(
        robot: &Robot,
        twins: &[[LegIndex; 2]],
        legs: &[LegClosure<T, D>; N],
        mut h: [T; N],
    ) -> Self {
        let one = T::constant(Interval::point(1.0));
        twins.iter().for_each(|[_, second]| h[second.index()] = one);
        let mut rows = Self::new(robot, legs, &h);
        for [first, second] in twins {
            rows.swing[first.index()] = [T::zero(); N];
            rows.fixed[second.index()] = [T::zero(); N];
        }
        rows
    }

    /// The weights that the rows of [`ModalRows::parted`] are multiplied by: what stands in place of the second of two legs that are one is
    /// a polynomial, and has none.
    pub fn weights_of_parted<const D: usize>(
        twins: &[[LegIndex; 2]],
        legs: &[LegClosure<T, D>; N],
    ) -> impl Iterator<Item = T> {
        let is_second = |j: usize| twins.iter().any(|[_, second]| second.index() == j);
        (0..N).filter(move |&j| !is_second(j)).map(|j| legs[j].closure.weight)
    }

    /// Row j of A in posture s = `sign`, times the leg's weight.
    pub fn row(&self, j: usize, sign: i8) -> [T; N] {
        let (a, b) = (&self.fixed[j], &self.swing[j]);
        if sign > 0 { each!(|k| a[k] + b[k]) } else { each!(|k| a[k] - b[k]) }
    }

    /// [`ModalRows::det`] for each mode wanted, with its index; modes that differ in few legs share minors.
    pub fn dets(&self, modes: &[WorkingMode], wanted: u8, mut visit: impl FnMut(usize, T)) {
        let is_wanted = |m: usize| wanted >> m & 1 == 1;
        match N {
            2 => (0..modes.len()).filter(|&m| is_wanted(m)).for_each(|m| visit(m, self.det(modes[m]))),
            3 => self.dets_of_three(modes, is_wanted, visit),
            _ => self.dets_below(modes, wanted, &Minors::none(), 0, &mut visit),
        }
    }

    /// Modes that differ in the first leg only share their minors.
    fn dets_of_three(
        &self,
        modes: &[WorkingMode],
        is_wanted: impl Fn(usize) -> bool,
        mut visit: impl FnMut(usize, T),
    ) {
        for (s, t) in [(1, 1), (1, -1), (-1, 1), (-1, -1)] {
            let of_pair = |m: &usize| is_wanted(*m) && modes[*m].sign(1) == s && modes[*m].sign(2) == t;
            if !(0..modes.len()).any(|m| of_pair(&m)) {
                continue;
            }
            let (b, c) = (self.row(1, s), self.row(2, t));
            let shared = [minor(&b, &c, 1, 2), minor(&b, &c, 2, 0), minor(&b, &c, 0, 1)];
            for m in (0..modes.len()).filter(of_pair) {
                let a = self.row(0, modes[m].sign(0));
                visit(m, a[0] * shared[0] + a[1] * shared[1] + a[2] * shared[2]);
            }
        }
    }

    /// Visits the determinants leg by leg from leg j on, with the minors of the rows before: modes share
    /// those of the first legs, in which they agree if they follow one another in Gray's order.
    fn dets_below(
        &self,
        modes: &[WorkingMode],
        wanted: u8,
        above: &Minors<T, N>,
        j: usize,
        visit: &mut impl FnMut(usize, T),
    ) {
        if j == N {
            (0..modes.len()).filter(|m| wanted >> m & 1 == 1).for_each(|m| visit(m, above.determinant()));
            return;
        }
        for sign in [1, -1] {
            let alike = (0..modes.len()).filter(|&m| wanted >> m & 1 == 1 && modes[m].sign(j) == sign);
            let alike = alike.fold(0, |set: u8, m| set | 1 << m);
            if alike != 0 {
                self.dets_below(modes, alike, &above.with(&self.row(j, sign)), j + 1, visit);
            }
        }
    }

    /// det A in `mode`, times the product of the weights: the sign is that of det A.
    pub fn det(&self, mode: WorkingMode) -> T {
        let mut rows = [[T::zero(); N]; N];
        for j in 0..N {
            rows[j] = self.row(j, mode.sign(j));
        }
        determinant(&rows)
    }
}

impl<const N: usize, const M: usize> ModalRows<Affine<M>, N> {
    /// [`ModalRows::det`] over eight boxes, times some positive number: more work, but mostly much narrower where N > 3 (the
    /// module `condition`).
    pub fn conditioned_det(&self, mode: WorkingMode) -> Affine<M> {
        let rows: [[_; N]; N] = std::array::from_fn(|j| self.row(j, mode.sign(j)));
        let by = Conditioner::new(&rows);
        determinant(&rows.map(|row| by.row(&row))).tightened().times(&by.det)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Kinematics;
    use crate::chart::{Chart, Coordinates};
    use crate::for_platform;
    use aspecta_robot::catalogue;
    use aspecta_robot::num::Random;

    /// det A / 2h by the parted rows, both times the weights.
    fn quotient<const D: usize, const N: usize>(robot: &Robot, pose: &[f64], mode: WorkingMode) -> [f64; 2] {
        let x: [f64; N] = std::array::from_fn(|k| pose[k]);
        let (_, legs) = Chart::Pose.at::<f64, D, N>(robot, &x, |k| x[k].sin_cos());
        let h: [f64; N] = each!(|j| legs[j].heights()[0]);
        let parted = ModalRows::<f64, N>::parted(robot, &robot.twins(), &legs, h).det(mode);
        [ModalRows::<f64, N>::new(robot, &legs, &h).det(mode), 2.0 * h[0] * parted]
    }

    /// With two legs made one, in every robot that has legs of two postures.
    #[test]
    fn the_height_is_taken_out_of_det_a() {
        let random = &mut Random::new(8);
        let mut seen = 0;
        for name in ["five-bar", "2-prr", "3-rrr", "3-prr", "delta", "spherical-3-rrr", "hexa"] {
            let mut robot = catalogue::find(name).unwrap();
            robot.legs[1] = robot.legs[0].clone();
            let window = robot.slice(&[]).unwrap();
            for _ in 0..300 {
                let pose: Vec<f64> = window.ranges.iter().map(|range| random.within(*range)).collect();
                for mode in robot.inverse(&pose).unwrap().into_iter().map(|found| found.mode) {
                    if mode.sign(0) != mode.sign(1) {
                        let [det, product] = for_platform!(robot.platform, quotient(&robot, &pose, mode));
                        assert!(
                            (det - product).abs() <= 1e-9 * det.abs().max(product.abs()) + 1e-12,
                            "{name}: {det}, {product}"
                        );
                        seen += 1;
                    }
                }
            }
        }
        assert!(seen > 1000, "{seen}");
    }
}
