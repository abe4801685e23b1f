//! The functions whose common positivity region is a class of aspects, in plain doubles, with their
//! gradients.

use super::face::Face;
use crate::aspect::{Analysis, AspectId, ClassId, DetSign, Place};
use aspecta_kinematics::constraints::{Constraint, Constraints, Demand};
use aspecta_kinematics::modal::{LegClosure, closures};
use aspecta_kinematics::placement::{Placement, leg_gradient, moved, wrench};
use aspecta_kinematics::{SINGULAR, WorkingMode};
use aspecta_robot::num::{Interval, Jet, Scalar, each, without_turns};
use aspecta_robot::{Robot, Window};
use nalgebra::{SMatrix, SVector};

/// Most iterations of Newton's method.
const STEPS: usize = 30;

/// A class of aspects of one robot within its window. Poses are in the robot's coordinates; distances between
/// them count each coordinate in widths of the window.
#[derive(Clone, Copy)]
pub struct Field<'a, const D: usize, const N: usize> {
    /// The robot.
    pub robot: &'a Robot,
    /// The working mode.
    pub mode: WorkingMode,
    /// The sign of det A.
    pub sign: DetSign,
    /// The window that holds its workspace.
    pub window: &'a Window,
}

impl<const D: usize, const N: usize> Field<'_, D, N> {
    /// Width of the window along coordinate k; 0 where it is held.
    pub fn width(&self, k: usize) -> f64 {
        self.window.ranges[k].1 - self.window.ranges[k].0
    }

    /// b − a, per coordinate in widths of the window, glued angles the short way round; 0 where held.
    pub fn difference(&self, a: &[f64; N], b: &[f64; N]) -> [f64; N] {
        std::array::from_fn(|k| {
            let gap = b[k] - a[k];
            let gap = if self.window.glued[k] { without_turns(gap) } else { gap };
            if self.width(k) > 0.0 { gap / self.width(k) } else { 0.0 }
        })
    }

    /// The norm of [`Field::difference`].
    pub fn distance(&self, a: &[f64; N], b: &[f64; N]) -> f64 {
        norm(&self.difference(a, b))
    }

    /// a + t (b − a), glued angles the short way round.
    pub fn between(&self, a: &[f64; N], b: &[f64; N], t: f64) -> [f64; N] {
        self.moved(a, &self.difference(a, b), t)
    }

    /// x + t d, where d is in widths of the window.
    pub fn moved(&self, x: &[f64; N], d: &[f64; N], t: f64) -> [f64; N] {
        std::array::from_fn(|k| x[k] + t * d[k] * self.width(k))
    }

    /// The first function that is not positive at x, `None` inside the class. What lies after a leg that does
    /// not close is not looked at: det A does not exist there. `exempt` are not looked at either.
    pub fn violated(&self, x: &[f64; N], exempt: &[Option<Face>]) -> Option<Face> {
        let mut found = None;
        self.visit::<f64>(x, 0, |face, value| {
            // A NaN is not positive.
            let positive = value > 0.0 || exempt.contains(&Some(face));
            if !positive {
                found = Some(face);
            }
            positive
        });
        found
    }

    /// Whether a leg is at its serial singularity, to the tolerance [`SINGULAR`]: rounding may then put it on
    /// either side.
    pub fn is_folded(&self, x: &[f64; N]) -> bool {
        let mut folded = false;
        self.visit::<f64>(x, 0, |face, value| {
            if let Face::Of(Constraint::Reach(j)) = face
                && let Some(greatest) = self.robot.leg(j).actuator.greatest_reach()
            {
                folded |= value <= SINGULAR * SINGULAR * greatest.mid();
            }
            // Reaches come before all that depends on them.
            !folded && matches!(face, Face::Cut { .. } | Face::Of(Constraint::Reach(_)))
        });
        folded
    }

    /// The sign of det A at x, whatever that of the class, if all else is positive.
    ///
    /// # Errors
    /// The first other function that is not positive, or det A where it is zero.
    pub fn sign_at(&self, x: &[f64; N]) -> Result<DetSign, Face> {
        let mut found = Err(Face::Of(Constraint::Det));
        self.visit::<f64>(x, 0, |face, value| {
            // A NaN has no sign.
            let positive = value > 0.0;
            match face {
                Face::Of(Constraint::Det) if positive => found = Ok(self.sign),
                Face::Of(Constraint::Det) if value < 0.0 => found = Ok(self.sign.opposite()),
                Face::Of(_) | Face::Cut { .. } if !positive => found = Err(face),
                Face::Of(_) | Face::Cut { .. } => {}
            }
            positive
        });
        found
    }

    /// Visits every function at `x`; the legs in the bit set `flat` are taken to be at their serial
    /// singularity, with h = 0. `visit` returns whether to go on.
    fn visit<T: Scalar>(&self, x: &[T; N], flat: u8, mut visit: impl FnMut(Face, T) -> bool) {
        for (k, &(lower, upper)) in self.window.cut.iter().enumerate() {
            let (lo, hi) = self.window.ranges[k];
            let at = |bound: f64| T::constant(Interval::point(bound));
            if lower && !visit(Face::Cut { coordinate: k, upper: false }, x[k] - at(lo)) {
                return;
            }
            if upper && !visit(Face::Cut { coordinate: k, upper: true }, at(hi) - x[k]) {
                return;
            }
        }
        let placement = Placement::<T, D>::at(self.robot.platform, x);
        let legs = closures::<T, D, N>(self.robot, &placement);
        let constraints = Constraints { robot: self.robot, placement: &placement, legs: &legs, flat };
        constraints.visit(&Demand::class(self.mode, self.sign.factor()), |constraint, value| {
            visit(Face::Of(constraint), value)
        });
    }

    fn heights<T: Scalar>(&self, legs: &[LegClosure<T, D>; N], flat: u8) -> [T; N] {
        each!(|j| if flat >> j & 1 == 1 { T::zero() } else { legs[j].closure.reach.sqrt() })
    }

    /// The coordinates as variables that count in widths of the window.
    fn jets(&self, x: &[f64; N]) -> [Jet<f64, N>; N] {
        std::array::from_fn(|k| {
            let mut x = Jet::variable(x[k], k);
            x.gradient[k] = self.width(k);
            x
        })
    }

    /// U = Σ log f over all functions f of the class; −∞ on its boundary and outside.
    fn height(&self, x: &[f64; N]) -> f64 {
        let mut sum = 0.0;
        self.visit::<f64>(x, 0, |_, value| {
            sum += if value > 0.0 { value.ln() } else { f64::NEG_INFINITY };
            sum > f64::NEG_INFINITY
        });
        sum
    }

    /// The direction of ∇U, of length 1 in widths of the window.
    fn uphill(&self, x: &[f64; N]) -> [f64; N] {
        let mut sum = [0.0; N];
        self.visit(&self.jets(x), 0, |_, value| {
            (0..N).for_each(|k| sum[k] += value.gradient[k] / value.value);
            true
        });
        let size = norm(&sum);
        sum.map(|g| g / size)
    }

    /// The aspect of a class in which x lies, strictly inside the class: that of the first place
    /// known to `analysis` on a climb of U, which does not leave the class as far as samples show. `None` if
    /// there is none within ten times `cell`.
    pub fn aspect_of(
        &self,
        analysis: &Analysis,
        class: ClassId,
        x: &[f64; N],
        cell: f64,
    ) -> Option<AspectId> {
        const STEPS: usize = 40;
        let mut at = *x;
        for _ in 0..STEPS {
            if let Place::Inside(id) = analysis.locate(&at, class) {
                return Some(id);
            }
            let (here, way) = (self.height(&at), self.uphill(&at));
            let on = |part: f64| self.height(&self.moved(&at, &way, part));
            let climbs = |step: &f64| {
                on(*step) > here && (1..4).all(|t| on(0.25 * f64::from(t) * step) > f64::NEG_INFINITY)
            };
            let mut steps = (2..24).map(|halvings| cell / f64::from(1 << halvings));
            at = self.moved(&at, &way, steps.find(climbs)?);
        }
        None
    }

    /// Value and gradient, per width of the window, of the function of each face at x.
    fn linear(&self, x: &[f64; N], faces: &[Option<Face>; 3]) -> [Option<Jet<f64, N>>; 3] {
        let mut found = [None; 3];
        self.visit(&self.jets(x), flat_legs(faces), |face, value| {
            if let Some(m) = faces.iter().position(|f| *f == Some(face)) {
                found[m] = Some(value);
            }
            true
        });
        found
    }

    /// Returns how far x is from the surfaces of `faces`, in widths of the window: the largest |value| /
    /// ‖gradient‖. Infinite where it cannot be told.
    pub fn offset(&self, x: &[f64; N], faces: &[Option<Face>; 3]) -> f64 {
        let relative = |j: &Jet<f64, N>| j.value.abs() / norm(&j.gradient);
        let values = self.linear(x, faces);
        let far = values
            .iter()
            .flatten()
            .map(relative)
            .fold(0.0, |m: f64, v| if v > m || v.is_nan() { v } else { m });
        if far.is_finite() { far } else { f64::INFINITY }
    }

    /// The nearest point to x where all functions of `faces` vanish, by Newton's method with least steps; it
    /// stays within `reach` widths of x.
    pub fn project(&self, x: &[f64; N], faces: &[Option<Face>; 3], reach: f64) -> Option<[f64; N]> {
        let mut at = *x;
        let mut last = f64::INFINITY;
        for _ in 0..STEPS {
            let values = self.linear(&at, faces);
            let mut rows = SMatrix::<f64, 3, N>::zeros();
            let mut residual = SVector::<f64, 3>::zeros();
            let mut normal = SMatrix::<f64, 3, 3>::identity();
            for (m, jet) in values.iter().enumerate() {
                let Some(jet) = jet else { continue };
                let size = norm(&jet.gradient);
                residual[m] = jet.value / size;
                (0..N).for_each(|k| rows[(m, k)] = jet.gradient[k] / size);
                normal[(m, m)] = 0.0;
            }
            normal += rows * rows.transpose();
            let step = rows.transpose() * (normal.try_inverse()? * residual);
            let size = step.norm();
            if !size.is_finite() {
                return None;
            }
            at = self.moved(&at, &std::array::from_fn(|k| step[k]), -1.0);
            if self.distance(x, &at) > reach {
                return None;
            }
            // Quadratic convergence ends in rounding.
            if size < 1e-15 || (size < 1e-11 && size >= 0.5 * last) {
                return Some(at);
            }
            last = size;
        }
        None
    }

    /// The point of the boundary on the way from `inside` to `outside` and the face that is crossed there, by
    /// bisection down to neighbouring doubles.
    pub fn cross(&self, inside: &[f64; N], outside: &[f64; N]) -> Option<([f64; N], Face)> {
        let way = self.difference(inside, outside);
        let mut face = self.violated(outside, &[])?;
        let (mut a, mut b) = (0.0, 1.0);
        loop {
            let t = 0.5 * (a + b);
            // 2⁻⁵⁶ of a cell: finer than the poses resolve.
            if t <= a || t >= b || b - a < 1.4e-17 {
                return Some((self.moved(inside, &way, a), face));
            }
            match self.violated(&self.moved(inside, &way, t), &[]) {
                None => a = t,
                Some(crossed) => (b, face) = (t, crossed),
            }
        }
    }

    /// g_s(X), extended by continuity: legs whose serial singularity is among `faces` have h = 0, as have
    /// those that rounding puts beyond it. Angles lie within the ranges of their joints.
    pub fn joints(&self, x: &[f64; N], faces: &[Option<Face>; 3]) -> [f64; N] {
        let placement = Placement::<f64, D>::at(self.robot.platform, x);
        let legs = closures::<f64, D, N>(self.robot, &placement);
        let heights = self.heights(&legs, flat_legs(faces));
        std::array::from_fn(|j| {
            let sh = f64::from(self.mode.sign(j)) * heights[j];
            let leg = &self.robot.legs[j];
            leg.joint_value(leg.actuator.drive(&legs[j].span, &legs[j].closure, sh))
        })
    }

    /// The largest difference between two joint vectors: rad modulo 2π for angles, length units for lengths.
    pub fn joint_distance(&self, p: &[f64; N], q: &[f64; N]) -> f64 {
        let gap = |j: usize| {
            let gap = p[j] - q[j];
            match self.robot.legs[j].actuator.is_angle() {
                true => without_turns(gap).abs(),
                false => gap.abs(),
            }
        };
        (0..N).map(gap).fold(0.0, f64::max)
    }

    /// The solution of f(X, q) = 0 near x, by Newton's method in displacements ([`moved`]). `None` unless the
    /// steps, counted in widths of the window, shrink from the first on, each to a half at most.
    pub fn close(&self, x: &[f64; N], q: &[f64; N]) -> Option<[f64; N]> {
        let mut at = *x;
        let mut last = f64::INFINITY;
        for _ in 0..STEPS {
            let placement = Placement::<f64, D>::at(self.robot.platform, &at);
            let mut a = SMatrix::<f64, N, N>::zeros();
            let mut f = SVector::<f64, N>::zeros();
            for (j, leg) in self.robot.legs.iter().enumerate() {
                let arm = placement.arm(leg);
                let (value, gradient, _) = leg_gradient(leg, &placement.span(leg, &arm), q[j]);
                let row: [f64; N] = wrench(self.robot.platform, &gradient, &arm);
                f[j] = value;
                (0..N).for_each(|k| a[(j, k)] = row[k]);
            }
            let step = solve(a, f)?;
            let size = norm(&std::array::from_fn::<_, N, _>(|k| step[k] / self.width(k)));
            at = moved::<D, N>(self.robot.platform, &at, &step.map(|z| -z).into());
            if size < 1e-15 || (size < 1e-9 && size >= 0.5 * last) {
                return Some(at);
            }
            if !size.is_finite() || size > 0.25 || size > 0.5 * last {
                return None;
            }
            last = size;
        }
        None
    }
}

/// a⁻¹ f by Gauss elimination with row pivots. (nalgebra's needs a fixed dimension it knows.)
fn solve<const N: usize>(mut a: SMatrix<f64, N, N>, mut f: SVector<f64, N>) -> Option<SVector<f64, N>> {
    for k in 0..N {
        let pivot = (k..N).max_by(|&i, &j| a[(i, k)].abs().total_cmp(&a[(j, k)].abs()))?;
        if a[(pivot, k)] == 0.0 || !a[(pivot, k)].is_finite() {
            return None;
        }
        a.swap_rows(k, pivot);
        f.swap_rows(k, pivot);
        for i in k + 1..N {
            let factor = a[(i, k)] / a[(k, k)];
            (k..N).for_each(|m| a[(i, m)] -= factor * a[(k, m)]);
            f[i] -= factor * f[k];
        }
    }
    for k in (0..N).rev() {
        let known: f64 = (k + 1..N).map(|m| a[(k, m)] * f[m]).sum();
        f[k] = (f[k] - known) / a[(k, k)];
    }
    Some(f)
}

/// ‖v‖.
pub fn norm<const N: usize>(v: &[f64; N]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// The legs whose serial singularity is among the faces.
fn flat_legs(faces: &[Option<Face>; 3]) -> u8 {
    let leg = |face: &Face| match face {
        Face::Of(Constraint::Reach(j)) => 1 << j.index(),
        Face::Of(
            Constraint::Limit(..) | Constraint::RodAngle(..) | Constraint::Apart(..) | Constraint::Det,
        )
        | Face::Cut { .. } => 0,
    };
    faces.iter().flatten().map(leg).fold(0, |set: u8, leg: u8| set | leg)
}
