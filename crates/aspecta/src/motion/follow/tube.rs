//! The certificate of one stretch: the theorem of [`super`], in intervals.

use super::newton::Root;
use crate::kinematics::leg::equation_turned;
use crate::kinematics::placement::{Placement, displacement_row, leg_gradient_turned, wrench};
use crate::num::{Interval, Scalar, dot, each};
use crate::robot::{Platform, Robot};
use nalgebra::SMatrix;

/// (sin, cos) of an angle.
pub(super) type Turn<T> = (T, T);

const ZERO: Interval = Interval::point(0.0);

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

/// What was proved of a stretch.
pub(super) struct Proof<const N: usize> {
    /// Its end.
    pub end: Located<N>,
    /// The signs of B_jj where they are proved all along it, else 0.
    pub signs: [i8; N],
}

impl<'a, const D: usize, const N: usize> Model<'a, D, N> {
    pub fn new(robot: &'a Robot) -> Self {
        let coordinates = robot.platform.coordinates();
        let length = robot.characteristic_length();
        Self { robot, unit: std::array::from_fn(|k| if coordinates[k].angle { 1.0 } else { length }) }
    }

    /// Proves the stretch from `start` to the joint vector `q`, for all joint vectors within `slack` of the straight segment.
    pub fn prove(&self, start: &Located<N>, q: &[f64; N], slack: &[f64; N]) -> Option<Proof<N>> {
        let turns = self.turns(q);
        let plain = plain(&turns);
        let root = self.newton(&start.pose, &start.inverse, q, &plain)?;
        self.certify(start, root, q, &turns, slack)
    }

    /// (sin, cos) of the joints that are angles.
    pub fn turns(&self, q: &[f64; N]) -> [Turn<Interval>; N] {
        let mut turns = [(ZERO, ZERO); N];
        for (j, leg) in self.robot.legs.iter().enumerate().take(N) {
            if leg.actuator.is_angle() {
                turns[j] = Interval::point(q[j]).sin_cos();
            }
        }
        turns
    }

    fn certify(
        &self,
        start: &Located<N>,
        root: Root<N>,
        q: &[f64; N],
        turns: &[Turn<Interval>; N],
        slack: &[f64; N],
    ) -> Option<Proof<N>> {
        let platform = self.robot.platform;
        let Root { pose, inverse } = root;
        let y = rows(&inverse);
        let at = Placement::<Interval, D>::at(platform, &pose.map(Interval::point));

        // Y f(X₁, q₁).
        let mut f = [ZERO; N];
        for (j, leg) in self.robot.legs.iter().enumerate().take(N) {
            let span = at.span(leg, &at.arm(leg));
            f[j] = equation_turned(&leg.actuator, &span, Interval::point(q[j]), || turns[j]);
        }
        let miss: [Interval; N] = each!(|i| dot(&y[i], &f));

        // The box B: what joins both poses, with room for the tube. Any room is sound; this much suits short stretches.
        let known = self.displacement(start, &pose, &at);
        let s: [Interval; N] = each!(|k| Interval::point(known[k].mid()));
        let room = 0.25 * self.size(&s) + 4.0 * self.size(&miss).max(start.radius);
        let margin: [Interval; N] =
            each!(|k| Interval::point(self.unit[k]) * Interval { lo: -room, hi: room });
        let region: [Interval; N] = each!(|k| ZERO.hull(s[k]) + margin[k]);
        if !(0..N).all(|k| region[k].lo <= known[k].lo && known[k].hi <= region[k].hi) {
            return None;
        }

        // [A] and [b] over B × Q.
        let turn: [Turn<Interval>; N] = std::array::from_fn(|k| region[k].small_sin_cos());
        let placement = at.displaced(platform, &region, &turn);
        let mut a = [[ZERO; N]; N];
        let mut rest = [ZERO; N];
        let mut signs = [0; N];
        for (j, leg) in self.robot.legs.iter().enumerate().take(N) {
            let back = Interval::point(start.q[j]) - Interval::point(q[j]);
            let off = Interval { lo: -slack[j], hi: slack[j] };
            let over = ZERO.hull(back) + off;
            let arm = placement.arm(leg);
            let span = placement.span(leg, &arm);
            let (_, gradient, b) =
                leg_gradient_turned(leg, &span, Interval::point(q[j]) + over, || plus(turns[j], over));
            a[j] = displacement_row(platform, &wrench::<_, D, N>(platform, &gradient, &arm), &turn);
            rest[j] = ZERO.hull(dot(&a[j], &s) + b * back) + b * off;
            signs[j] = b.sign();
        }

        let contraction = self.contraction(&y, &a);
        let left = Interval::point(1.0) - Interval::point(contraction);
        if !left.is_positive() {
            return None;
        }
        let off: [Interval; N] = each!(|i| miss[i] + dot(&y[i], &rest));
        let radius = (Interval::point(self.size(&off)) / left).hi;
        if !(radius <= room) {
            return None;
        }
        let radius = (Interval::point(self.size(&miss)) / left).hi;
        Some(Proof { end: Located { pose, q: *q, radius, inverse }, signs })
    }

    /// ‖z‖, rounded up.
    fn size(&self, z: &[Interval; N]) -> f64 {
        let mut most = 0.0;
        for k in 0..N {
            let share = (Interval::point(z[k].magnitude()) / Interval::point(self.unit[k])).hi;
            // NaN must not get lost.
            most = if share <= most { most } else { share };
        }
        most
    }

    /// ‖I − Y[A]‖, rounded up.
    fn contraction(&self, y: &[[Interval; N]; N], a: &[[Interval; N]; N]) -> f64 {
        let mut most = 0.0;
        for i in 0..N {
            let mut sum = ZERO;
            for k in 0..N {
                let mut entry = Interval::point(if i == k { -1.0 } else { 0.0 });
                for j in 0..N {
                    entry = entry + y[i][j] * a[j][k];
                }
                sum = sum + Interval::point(entry.magnitude()) * Interval::point(self.unit[k]);
            }
            let share = (sum / Interval::point(self.unit[i])).hi;
            most = if share <= most { most } else { share };
        }
        most
    }

    /// Where the solution at the start lies, in the coordinates z about `pose`, whose placement is `at`.
    fn displacement(
        &self,
        start: &Located<N>,
        pose: &[f64; N],
        at: &Placement<Interval, D>,
    ) -> [Interval; N] {
        let platform = self.robot.platform;
        let doubt = |k: usize| {
            let radius = Interval::point(start.radius) * Interval::point(self.unit[k]);
            Interval { lo: -radius.hi, hi: radius.hi }
        };
        let mut z: [Interval; N] =
            each!(|k| Interval::point(start.pose[k]) - Interval::point(pose[k]) + doubt(k));
        if matches!(platform, Platform::TurningBody | Platform::FreeBody) {
            // R(start, displaced by its doubt) · R(pose)ᵀ.
            let from = Placement::<Interval, D>::at(platform, &start.pose.map(Interval::point));
            let doubts: [Interval; N] = each!(|k| doubt(k));
            let turn: [Turn<Interval>; N] = std::array::from_fn(|k| doubts[k].small_sin_cos());
            let from = from.displaced(platform, &doubts, &turn);
            if let (Some(r), Some(base)) = (from.rotation(), at.rotation()) {
                let entry = |i: usize, j: usize| dot(&r[i], &base[j]);
                let low = D - 1;
                let (sx, cx) = (entry(low, 1), entry(low, low));
                let cy = (sx.square() + cx.square()).sqrt();
                let angles = [
                    Interval::angle(cx, sx),
                    Interval::angle(cy, -entry(low, 0)),
                    Interval::angle(entry(0, 0), entry(1, 0)),
                ];
                for (k, angle) in (N - 3..N).zip(angles) {
                    z[k] = angle.unwrap_or(Interval::ENTIRE);
                }
            }
        }
        z
    }
}

/// (sin, cos) of x + δ from those of x, by the addition theorems.
fn plus((sin, cos): Turn<Interval>, delta: Interval) -> Turn<Interval> {
    let (s, c) = delta.small_sin_cos();
    (sin * c + cos * s, cos * c - sin * s)
}

/// The same in doubles.
pub(super) fn plain<const N: usize>(turns: &[Turn<Interval>; N]) -> [Turn<f64>; N] {
    turns.map(|(sin, cos)| (sin.mid(), cos.mid()))
}

fn rows<const N: usize>(m: &SMatrix<f64, N, N>) -> [[Interval; N]; N] {
    let mut all = [[ZERO; N]; N];
    for i in 0..N {
        all[i] = each!(|k| Interval::point(m[(i, k)]));
    }
    all
}
