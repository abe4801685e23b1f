//! The certificate of one stretch: the theorem of [`super`], in intervals.

use super::newton::Root;
use super::on_the_way::OnTheWay;
use super::{Padded, unpadded};
use crate::placement::{Placement, displacement_row, leg_gradient_turned, wrench};
use aspecta_robot::num::{Ball, Interval, Scalar, Slope, dot, each};
use aspecta_robot::{Leg, Robot};
use nalgebra::SMatrix;

/// (sin, cos) of an angle.
pub(super) type Turn<T> = (T, T);

const ZERO: Ball = Ball::point(0.0);

/// The robot as proofs see it: its equations, and the units in which displacements are of order one.
#[derive(Clone, Copy)]
pub(super) struct Model<'a, const D: usize, const N: usize> {
    pub robot: &'a Robot,
    /// The weights of the norm ‖z‖ = max |z_k| / unit_k.
    pub unit: [f64; N],
}

/// A solution that is known: at `q` the branch followed has its pose within `radius` (in units) of `pose`.
#[derive(Clone, Copy)]
pub(super) struct Located<const N: usize> {
    pub pose: [f64; N],
    pub q: [f64; N],
    pub radius: f64,
    /// ≈ A⁻¹.
    pub inverse: SMatrix<f64, N, N>,
}

/// The quantities by which a stretch is judged, as the theorem of [`super`] names them.
pub(super) struct Stretch<'a, const D: usize, const N: usize> {
    /// The placement of X₁, about which z is counted.
    at: Placement<Ball, D>,
    q: [f64; N],
    turns: &'a [Turn<Ball>; N],
    y: [[Ball; N]; N],
    /// f(X₁, q₁), and Y times that.
    f: [Ball; N],
    miss: [Ball; N],
    /// An enclosure of the solution at the start.
    known: [Ball; N],
    s: [Ball; N],
    /// q₀ − q₁.
    back: [Ball; N],
    /// e.
    off: [Ball; N],
    /// ρ. Any radius is sound; this one suits short stretches.
    room: f64,
}

impl<'a, const D: usize, const N: usize> Stretch<'a, D, N> {
    fn moving(
        model: &Model<'_, D, N>,
        start: &Located<N>,
        root: &Root<N>,
        q: &[f64; N],
        turns: &'a [Turn<Ball>; N],
        slack: &[f64; N],
    ) -> Self {
        let at = model.placement(&root.pose);
        let y = rows(&root.inverse);
        let f = model.equations(&at, q, turns);
        let miss: [Ball; N] = each!(|i| dot(&y[i], &f));
        let known = model.displacement(start, &root.pose, &at);
        let s: [Ball; N] = each!(|k| Ball::point(known[k].mid));
        let room = 0.25 * model.size(&s) + 4.0 * model.size(&miss) + 4.0 * start.radius;
        let back: [Ball; N] = each!(|j| Ball::point(start.q[j]) - Ball::point(q[j]));
        let off: [Ball; N] = each!(|j| Ball::about_zero(slack[j]));
        Self { at, q: *q, turns, y, f, miss, known, s, back, off, room }
    }

    /// A leg over the tube, whose placements are `placement`.
    #[inline]
    pub fn leg<T: OnTheWay>(&self, leg: &Leg, j: usize, placement: &Placement<T, D>) -> LegOver<T, D> {
        let arm = placement.arm(leg);
        let span = placement.span(leg, &arm);
        let over = T::on_the_way(self.back[j], self.off[j]);
        let q = T::fixed(Ball::point(self.q[j])) + over;
        let mut turn = None;
        // The addition theorems.
        let turned = || {
            let (sin, cos) = (T::fixed(self.turns[j].0), T::fixed(self.turns[j].1));
            let (s, c) = over.small_sin_cos();
            *turn.insert((sin * c + cos * s, cos * c - sin * s))
        };
        let (_, gradient, slope) = leg_gradient_turned(leg, &span, q, turned);
        LegOver { arm, span, turn, gradient, slope }
    }
}

/// One leg over a tube.
pub(super) struct LegOver<T, const D: usize> {
    /// r = R c, base frame.
    pub arm: [T; D],
    /// d = C − A, leg frame.
    pub span: [T; D],
    /// (sin q, cos q), if q is an angle.
    pub turn: Option<Turn<T>>,
    /// ∂f/∂C, base frame.
    pub gradient: [T; D],
    /// B_jj.
    pub slope: T,
}

/// The result of a proof about a stretch.
pub(super) struct Proof<const N: usize> {
    /// Its end.
    pub end: Located<N>,
    /// The signs of B_jj where they are proved all along it, else 0.
    pub signs: [i8; N],
}

impl<'a, const D: usize, const N: usize> Model<'a, D, N> {
    pub fn new(robot: &'a Robot, unit: &Padded) -> Self {
        Self { robot, unit: unpadded(unit) }
    }

    /// Proves the stretch from `start` to the joint vector `q`, for all joint vectors within `slack` of the
    /// straight segment.
    pub fn prove(&self, start: &Located<N>, q: &[f64; N], slack: &[f64; N]) -> Option<Proof<N>> {
        let turns = self.turns(q);
        let root = self.newton(&start.pose, &start.inverse, q, &plain(&turns))?;
        self.certify::<Ball>(&Stretch::moving(self, start, &root, q, &turns, slack), &root).ok()
    }

    /// Proves longer stretches than [`Self::prove`], at several times the cost: enclosures know where on the
    /// way they are, and the solution halfway gives Y and the width of the tube.
    pub fn prove_carefully(&self, start: &Located<N>, q: &[f64; N], slack: &[f64; N]) -> Option<Proof<N>> {
        self.prove_and_look(start, q, slack, |_| ()).map(|(proof, ())| proof)
    }

    /// [`Model::prove_carefully`], and then what `look` makes of the stretch that was proved.
    pub fn prove_and_look<R>(
        &self,
        start: &Located<N>,
        q: &[f64; N],
        slack: &[f64; N],
        look: impl FnOnce(&Stretch<'_, D, N>) -> R,
    ) -> Option<(Proof<N>, R)> {
        let turns = self.turns(q);
        let root = self.newton(&start.pose, &start.inverse, q, &plain(&turns))?;
        let mut stretch = Stretch::moving(self, start, &root, q, &turns, slack);
        let q = std::array::from_fn(|j| 0.5 * (start.q[j] + q[j]));
        let Root { pose, inverse } = self.newton(&start.pose, &start.inverse, &q, &plain(&self.turns(&q)))?;
        let halfway = self.displacement(&Located { pose, q, radius: 0.0, inverse }, &root.pose, &stretch.at);
        let deviation: [Ball; N] = each!(|k| Ball::point(halfway[k].mid - 0.5 * stretch.s[k].mid));
        stretch.room += 3.0 * self.size(&deviation) - 0.25 * self.size(&stretch.s);
        stretch.y = rows(&inverse);
        stretch.miss = each!(|i| dot(&stretch.y[i], &stretch.f));
        let proof = self.certify::<Slope<Ball, 1>>(&stretch, &root).or_else(|needed| {
            stretch.room = 1.5 * needed;
            self.certify::<Slope<Ball, 1>>(&stretch, &root)
        });
        proof.ok().map(|proof| (proof, look(&stretch)))
    }

    /// Proves that the solution for `guess.q` near `guess.pose` is the only one in a ball that holds both.
    pub fn prove_alone(&self, guess: &Located<N>) -> Option<Proof<N>> {
        let turns = self.turns(&guess.q);
        let root = self.newton(&guess.pose, &guess.inverse, &guess.q, &plain(&turns))?;
        let mut stretch = Stretch::moving(self, guess, &root, &guess.q, &turns, &[0.0; N]);
        stretch.room += self.size(&stretch.known);
        stretch.s = [ZERO; N];
        self.certify::<Ball>(&stretch, &root).ok()
    }

    /// (sin, cos) of the joints that are angles.
    pub fn turns(&self, q: &[f64; N]) -> [Turn<Ball>; N] {
        let mut turns = [(ZERO, ZERO); N];
        for (j, leg) in self.robot.legs.iter().enumerate().take(N) {
            if leg.actuator.is_angle() {
                turns[j] = turn_of(q[j]);
            }
        }
        turns
    }

    /// The theorem of [`super`]. `Err` holds a radius ρ that might do; infinite if κ ≥ 1.
    ///
    /// Certifies a stretch. Numbers that are compared may be infinite or NaN: each condition is one that must
    /// be true.
    fn certify<T: OnTheWay>(&self, stretch: &Stretch<'_, D, N>, root: &Root<N>) -> Result<Proof<N>, f64> {
        let Stretch { s, back, off, room, .. } = stretch;
        let from_centre: [Ball; N] = each!(|k| stretch.known[k] - s[k]);
        let needed = self.size(&from_centre);
        let holds_start = needed <= *room && *room < f64::INFINITY;
        if !holds_start {
            return Err(needed);
        }
        let (a, b) = self.derivatives::<T>(stretch);
        let y: [[T; N]; N] = each_row(|i| each!(|k| T::fixed(stretch.y[i][k])));

        // 1 − κ, rounded down.
        let left = (1.0 - self.contraction(&y, &a)) * (1.0 - f64::EPSILON);
        // The rate at which f changes on the way back from X₁.
        let drift: [T; N] = each!(|j| {
            let mut sum = b[j] * T::fixed(back[j]);
            for k in 0..N {
                sum = sum + a[j][k] * T::fixed(s[k]);
            }
            sum
        });
        let disturbance: [Ball; N] = each!(|j| b[j].range() * off[j]);
        let missed: [Ball; N] =
            each!(|i| stretch.miss[i] + dot(&y[i], &drift).so_far() + dot(&stretch.y[i], &disturbance));
        let needed = if left > 0.0 { above(self.size(&missed) / left) } else { f64::INFINITY };
        let holds_tube = needed <= *room && left > 0.0;
        if !holds_tube {
            return Err(needed);
        }
        let radius = above(self.size(&stretch.miss) / left);
        let end = Located { pose: root.pose, q: stretch.q, radius, inverse: root.inverse };
        Ok(Proof { end, signs: b.map(|b| b.range().sign()) })
    }

    /// f(X, q) at a placement.
    fn equations(&self, at: &Placement<Ball, D>, q: &[f64; N], turns: &[Turn<Ball>; N]) -> [Ball; N] {
        let mut f = [ZERO; N];
        for (j, leg) in self.robot.legs.iter().enumerate().take(N) {
            let span = at.span(leg, &at.arm(leg));
            f[j] = leg.actuator.equation_turned(&span, Ball::point(q[j]), || turns[j]);
        }
        f
    }

    /// \[A\] and \[b\]: ∂f/∂z and ∂f/∂q over the tube.
    fn derivatives<T: OnTheWay>(&self, stretch: &Stretch<'_, D, N>) -> ([[T; N]; N], [T; N]) {
        let platform = self.robot.platform;
        let (placement, turn) = self.placements(stretch);
        let (mut a, mut b) = ([[T::zero(); N]; N], [T::zero(); N]);
        for (j, leg) in self.robot.legs.iter().enumerate().take(N) {
            let over = stretch.leg(leg, j, &placement);
            a[j] = displacement_row(platform, &wrench(platform, &over.gradient, &over.arm), &turn);
            b[j] = over.slope;
        }
        (a, b)
    }

    /// The placements of the tube, and (sin, cos) of the angles of z.
    pub fn placements<T: OnTheWay>(&self, stretch: &Stretch<'_, D, N>) -> (Placement<T, D>, [Turn<T>; N]) {
        let noise: [Ball; N] = each!(|k| Ball::point(self.unit[k]) * Ball::about_zero(stretch.room));
        let z: [T; N] = each!(|k| T::on_the_way(stretch.s[k], noise[k]));
        let mut turn = [(T::zero(), T::zero()); N];
        for k in 0..N {
            turn[k] = z[k].small_sin_cos();
        }
        (stretch.at.map(T::fixed).displaced(self.robot.platform, &z, &turn), turn)
    }

    /// The placement of a pose.
    fn placement(&self, pose: &[f64; N]) -> Placement<Ball, D> {
        let x: [Ball; N] = each!(|k| Ball::point(pose[k]));
        Placement::new(self.robot.platform, &x, |k| turn_of(pose[k]))
    }

    /// Bounds of the errors of lengths and of angles, 0 where there are none.
    pub fn errors(&self, at: &Located<N>) -> [f64; 2] {
        let mut errors = [0.0; 2];
        for (coordinate, unit) in self.robot.platform.coordinates().iter().zip(&self.unit) {
            errors[usize::from(coordinate.angle)] = above(at.radius * unit);
        }
        errors
    }

    /// ‖z‖, rounded up.
    fn size(&self, z: &[Ball; N]) -> f64 {
        let mut most = 0.0;
        for k in 0..N {
            most = greater(most, above(z[k].magnitude() / self.unit[k]));
        }
        most
    }

    /// κ = ‖I − Y\[A\]‖, rounded up.
    fn contraction<T: OnTheWay>(&self, y: &[[T; N]; N], a: &[[T; N]; N]) -> f64 {
        let mut most = 0.0;
        for i in 0..N {
            let mut sum = 0.0;
            for k in 0..N {
                let mut entry = T::fixed(Ball::point(if i == k { -1.0 } else { 0.0 }));
                for j in 0..N {
                    entry = entry + y[i][j] * a[j][k];
                }
                sum = above(sum + above(entry.range().magnitude() * self.unit[k]));
            }
            most = greater(most, above(sum / self.unit[i]));
        }
        most
    }

    /// Encloses the solution at the start, in the coordinates z about `pose`, whose placement is `at`.
    fn displacement(&self, start: &Located<N>, pose: &[f64; N], at: &Placement<Ball, D>) -> [Ball; N] {
        let platform = self.robot.platform;
        let doubt: [Ball; N] = each!(|k| Ball::point(self.unit[k]) * Ball::about_zero(start.radius));
        let mut z: [Ball; N] = each!(|k| Ball::point(start.pose[k]) - Ball::point(pose[k]) + doubt[k]);
        if platform.turns_in_space() {
            // R(z) = R(doubt) · R(start) · R(pose)ᵀ.
            let turn = doubt.map(Ball::small_sin_cos);
            let from = self.placement(&start.pose).displaced(platform, &doubt, &turn);
            if let (Some(from), Some(to)) = (from.rotation(), at.rotation()) {
                let entry = |i: usize, j: usize| Interval::from(dot(&from[i], &to[j]));
                let low = D - 1;
                let (sin_x, cos_x) = (entry(low, 1), entry(low, low));
                let cos_y = (sin_x.square() + cos_x.square()).sqrt();
                let angles = [
                    Interval::angle(cos_x, sin_x),
                    Interval::angle(cos_y, -entry(low, 0)),
                    Interval::angle(entry(0, 0), entry(1, 0)),
                ];
                for (k, angle) in (N - 3..N).zip(angles) {
                    z[k] = angle.unwrap_or(Interval::ENTIRE).into();
                }
            }
        }
        z
    }
}

/// A double above the quotient, product or sum of non-negative doubles that was rounded to `x`.
#[inline(always)]
fn above(x: f64) -> f64 {
    x * (1.0 + 2.0 * f64::EPSILON) + f64::MIN_POSITIVE
}

/// The greater one; infinity if the second is NaN, of which nothing is known.
#[inline(always)]
fn greater(most: f64, x: f64) -> f64 {
    if x <= most {
        most
    } else if x > most {
        x
    } else {
        f64::INFINITY
    }
}

/// (sin, cos) of an angle given as a double.
fn turn_of(angle: f64) -> Turn<Ball> {
    let (sin, cos) = Interval::point(angle).sin_cos();
    (sin.into(), cos.into())
}

/// Returns the turns in doubles.
pub(super) fn plain<const N: usize>(turns: &[Turn<Ball>; N]) -> [Turn<f64>; N] {
    turns.map(|(sin, cos)| (sin.mid, cos.mid))
}

fn rows<const N: usize>(m: &SMatrix<f64, N, N>) -> [[Ball; N]; N] {
    each_row(|i| each!(|k| Ball::point(m[(i, k)])))
}

fn each_row<T: Scalar, const N: usize>(row: impl Fn(usize) -> [T; N]) -> [[T; N]; N] {
    let mut all = [[T::zero(); N]; N];
    for i in 0..N {
        all[i] = row(i);
    }
    all
}

#[cfg(test)]
mod tests;
