//! The certificate of one stretch: the theorem of [`super`], in intervals.

use super::newton::{Root, moved};
use super::{Padded, unpadded};
use crate::kinematics::leg::equation_turned;
use crate::kinematics::placement::{Placement, displacement_row, leg_gradient_turned, wrench};
use crate::num::{Ball, Interval, Scalar, dot, each};
use crate::robot::{Platform, Robot};
use nalgebra::{SMatrix, SVector};

/// (sin, cos) of an angle.
pub(super) type Turn<T> = (T, T);

const ZERO: Ball = Ball::point(0.0);

/// What a robot looks like to the proofs: its equations, and what makes a displacement a number of order one.
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

/// Where the centre of the tube is.
#[derive(Clone, Copy)]
enum Centre {
    /// It goes from the pose at the start to the one at the end.
    Moves,
    /// At the end: the start is a guess, and no solution.
    Stands,
}

/// What was proved of a stretch.
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

    /// Proves the stretch from `start` to the joint vector `q`, for all joint vectors within `slack` of the straight segment.
    ///
    /// Y is A⁻¹ at the end, or, if `careful`, in the middle: dearer, but the stretch may be longer.
    pub fn prove(
        &self,
        start: &Located<N>,
        q: &[f64; N],
        slack: &[f64; N],
        careful: bool,
    ) -> Option<Proof<N>> {
        let turns = self.turns(q);
        let root = self.newton(&start.pose, &start.inverse, q, &plain(&turns))?;
        let y = if careful { self.inverse_between(start, &root, q)? } else { root.inverse };
        self.certify(start, Centre::Moves, root, &y, q, &turns, slack)
    }

    /// A⁻¹ halfway between two configurations.
    fn inverse_between(
        &self,
        start: &Located<N>,
        root: &Root<N>,
        q: &[f64; N],
    ) -> Option<SMatrix<f64, N, N>> {
        let at = self.placement(&root.pose);
        let back = self.displacement(start, &root.pose, &at);
        let half = SVector::from_fn(|k, _| 0.5 * back[k].mid);
        let pose = moved::<D, N>(self.robot.platform, &root.pose, &half);
        let q = std::array::from_fn(|j| 0.5 * (start.q[j] + q[j]));
        self.linearised(&pose, &q, &plain(&self.turns(&q))).1.try_inverse()
    }

    /// Proves that the solution for `guess.q` near `guess.pose` is the only one in a box that holds both.
    pub fn prove_alone(&self, guess: &Located<N>) -> Option<Proof<N>> {
        let turns = self.turns(&guess.q);
        let root = self.newton(&guess.pose, &guess.inverse, &guess.q, &plain(&turns))?;
        let y = root.inverse;
        self.certify(guess, Centre::Stands, root, &y, &guess.q, &turns, &[0.0; N])
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

    /// The theorem of [`super`], word for word.
    fn certify(
        &self,
        start: &Located<N>,
        centre: Centre,
        root: Root<N>,
        y: &SMatrix<f64, N, N>,
        q: &[f64; N],
        turns: &[Turn<Ball>; N],
        slack: &[f64; N],
    ) -> Option<Proof<N>> {
        let Root { pose, inverse } = root;
        let at = self.placement(&pose);
        let y = rows(y);
        let f = self.equations(&at, q, turns);
        let miss: [Ball; N] = each!(|i| dot(&y[i], &f));
        let missed = self.size(&miss);

        // B: what joins both poses, with room for the tube. Any room is sound; this much suits short stretches.
        let known = self.displacement(start, &pose, &at);
        let s: [Ball; N] = each!(|k| Ball::point(known[k].mid));
        let room = 0.25 * self.size(&s) + 4.0 * missed + 4.0 * start.radius;
        let region: [Ball; N] =
            each!(|k| s[k].towards_zero() + Ball::point(self.unit[k]) * Ball::about_zero(room));
        if !(0..N).all(|k| known[k].lies_in(region[k])) {
            return None;
        }

        let back: [Ball; N] = each!(|j| Ball::point(start.q[j]) - Ball::point(q[j]));
        let off: [Ball; N] = each!(|j| Ball::about_zero(slack[j]));
        let over: [Ball; N] = each!(|j| back[j].towards_zero() + off[j]);
        let (a, b) = self.derivatives(&at, &region, q, turns, &over);
        // 1 − κ, rounded down.
        let left = (1.0 - self.contraction(&y, &a)) * (1.0 - f64::EPSILON);
        if !(left > 0.0) {
            return None;
        }
        let s = if matches!(centre, Centre::Moves) { s } else { [ZERO; N] };
        let rest: [Ball; N] = each!(|j| (dot(&a[j], &s) + b[j] * back[j]).towards_zero() + b[j] * off[j]);
        let missed_on_the_way: [Ball; N] = each!(|i| miss[i] + dot(&y[i], &rest));
        if !(above(self.size(&missed_on_the_way) / left) <= room) {
            return None;
        }
        let end = Located { pose, q: *q, radius: above(missed / left), inverse };
        Some(Proof { end, signs: b.map(Ball::sign) })
    }

    /// f(X, q) at a placement.
    fn equations(&self, at: &Placement<Ball, D>, q: &[f64; N], turns: &[Turn<Ball>; N]) -> [Ball; N] {
        let mut f = [ZERO; N];
        for (j, leg) in self.robot.legs.iter().enumerate().take(N) {
            let span = at.span(leg, &at.arm(leg));
            f[j] = equation_turned(&leg.actuator, &span, Ball::point(q[j]), || turns[j]);
        }
        f
    }

    /// ∂f/∂z and ∂f/∂q over all displacements z ∈ `region` from `at` and all joint vectors in q + `over`.
    fn derivatives(
        &self,
        at: &Placement<Ball, D>,
        region: &[Ball; N],
        q: &[f64; N],
        turns: &[Turn<Ball>; N],
        over: &[Ball; N],
    ) -> ([[Ball; N]; N], [Ball; N]) {
        let platform = self.robot.platform;
        let turn = each_turn(region);
        let placement = at.displaced(platform, region, &turn);
        let (mut a, mut b) = ([[ZERO; N]; N], [ZERO; N]);
        for (j, leg) in self.robot.legs.iter().enumerate().take(N) {
            let arm = placement.arm(leg);
            let span = placement.span(leg, &arm);
            let turned = || plus(turns[j], over[j]);
            let (_, gradient, slope) = leg_gradient_turned(leg, &span, Ball::point(q[j]) + over[j], turned);
            a[j] = displacement_row(platform, &wrench(platform, &gradient, &arm), &turn);
            b[j] = slope;
        }
        (a, b)
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

    /// ‖I − Y[A]‖, rounded up.
    fn contraction(&self, y: &[[Ball; N]; N], a: &[[Ball; N]; N]) -> f64 {
        let mut most = 0.0;
        for i in 0..N {
            let mut sum = 0.0;
            for k in 0..N {
                let mut entry = Ball::point(if i == k { -1.0 } else { 0.0 });
                for j in 0..N {
                    entry = entry + y[i][j] * a[j][k];
                }
                sum = above(sum + above(entry.magnitude() * self.unit[k]));
            }
            most = greater(most, above(sum / self.unit[i]));
        }
        most
    }

    /// Where the solution at the start lies, in the coordinates z about `pose`, whose placement is `at`.
    fn displacement(&self, start: &Located<N>, pose: &[f64; N], at: &Placement<Ball, D>) -> [Ball; N] {
        let platform = self.robot.platform;
        let doubt: [Ball; N] = each!(|k| Ball::point(self.unit[k]) * Ball::about_zero(start.radius));
        let mut z: [Ball; N] = each!(|k| Ball::point(start.pose[k]) - Ball::point(pose[k]) + doubt[k]);
        if matches!(platform, Platform::TurningBody | Platform::FreeBody) {
            // R(z) = R(doubt) · R(start) · R(pose)ᵀ.
            let from = self.placement(&start.pose).displaced(platform, &doubt, &each_turn(&doubt));
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

/// (sin, cos) of small angles.
fn each_turn<const N: usize>(z: &[Ball; N]) -> [Turn<Ball>; N] {
    let mut turns = [(ZERO, ZERO); N];
    for k in 0..N {
        turns[k] = z[k].small_sin_cos();
    }
    turns
}

/// (sin, cos) of x + δ from those of x, by the addition theorems.
fn plus((sin, cos): Turn<Ball>, delta: Ball) -> Turn<Ball> {
    let (s, c) = delta.small_sin_cos();
    (sin * c + cos * s, cos * c - sin * s)
}

/// The same in doubles.
pub(super) fn plain<const N: usize>(turns: &[Turn<Ball>; N]) -> [Turn<f64>; N] {
    turns.map(|(sin, cos)| (sin.mid, cos.mid))
}

fn rows<const N: usize>(m: &SMatrix<f64, N, N>) -> [[Ball; N]; N] {
    let mut all = [[ZERO; N]; N];
    for i in 0..N {
        all[i] = each!(|k| Ball::point(m[(i, k)]));
    }
    all
}
