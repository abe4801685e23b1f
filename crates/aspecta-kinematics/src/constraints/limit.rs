//! Joint limits as functions that are positive strictly inside.

use crate::modal::LegClosure;
use crate::placement::{Placement, into_frame};
use aspecta_robot::legs::{Closure, Drive};
use aspecta_robot::num::{Interval, Scalar, dot, dot_constant, each};
use aspecta_robot::{Leg, Limit};

/// A leg at a pose, with q eliminated: what a limit looks at.
pub struct LegAt<'a, T, const D: usize> {
    /// The leg.
    pub leg: &'a Leg,
    /// d = C − A in the leg's frame.
    pub span: &'a [T; D],
    /// The leg equation with q eliminated.
    pub closure: &'a Closure<T, D>,
    /// (cos q, sin q), where the leg's own coordinates are used.
    pub crank: Option<(T, T)>,
}

impl<'a, T: Scalar, const D: usize> LegAt<'a, T, D> {
    /// The leg where it closes.
    pub fn of(leg: &'a Leg, at: &'a LegClosure<T, D>) -> Self {
        let crank = at.fold.as_ref().map(|f| (f.cos, f.sin));
        Self { leg, span: &at.span, closure: &at.closure, crank }
    }

    fn drive(&self, sh: T) -> Drive<T> {
        match self.crank {
            Some((cos, sin)) => Drive::Angle { cos, sin, norm: T::constant(Interval::point(1.0)) },
            None => self.leg.actuator.drive(self.span, self.closure, sh),
        }
    }
}

/// c_k > 0: how far inside `limit` the leg is in posture s, where `sh` = s h. Zero at the limit. The unit
/// differs from limit to limit; only the sign has a meaning.
pub fn margin<T: Scalar, const D: usize>(
    limit: &Limit,
    at: &LegAt<'_, T, D>,
    sh: T,
    placement: &Placement<T, D>,
) -> T {
    match limit {
        Limit::ActuatorAngle { middle, half_cos, .. } => match at.drive(sh) {
            Drive::Angle { cos, sin, norm } => {
                cos.scale(middle.0) + sin.scale(middle.1) - norm.scale(*half_cos)
            }
            Drive::Length(_) => T::constant(Interval::ENTIRE),
        },
        Limit::ActuatorLength { min, max } => at.leg.actuator.length_margin(at.span, sh, *min, *max),
        Limit::Elbow { middle, half_cos } => {
            let (bend, both) = bend(at);
            bend.scale(middle.0) - sh.scale(middle.1) - T::constant(both * *half_cos)
        }
        Limit::SpatialElbow { min_cos, max_cos } => {
            let (bend, both) = bend(at);
            (T::constant(both * *min_cos) - bend) * (bend - T::constant(both * *max_cos))
        }
        Limit::BaseCone { axis, half_cos } => {
            let rod = rod_direction(at, sh);
            dot_constant(&axis[..D], &rod) - rod_length(at).scale(*half_cos)
        }
        Limit::PlatformCone { axis, half_cos } => {
            let axis = into_frame(at.leg, &placement.turned(axis));
            dot(&axis, &rod_direction(at, sh)) - rod_length(at).scale(*half_cos)
        }
        Limit::Clearance(clearance) => super::clearance::margin(clearance, at, sh),
    }
}

/// Returns the divisor of [`margin`] that makes it one and the same function of the configuration, whatever
/// coordinates it was computed in. Positive wherever the leg closes strictly.
pub fn unit<T: Scalar, const D: usize>(limit: &Limit, at: &LegAt<'_, T, D>, sh: T) -> T {
    match limit {
        Limit::ActuatorAngle { .. } => match at.drive(sh) {
            Drive::Angle { norm, .. } => norm,
            Drive::Length(_) => T::constant(Interval::ENTIRE),
        },
        Limit::BaseCone { .. } | Limit::PlatformCone { .. } => rod_length(at),
        Limit::ActuatorLength { .. }
        | Limit::Elbow { .. }
        | Limit::SpatialElbow { .. }
        | Limit::Clearance(_) => T::constant(Interval::point(1.0)),
    }
}

/// (2LM cos ψ, 2LM) with ψ the angle at B; it may be anything if there is none.
fn bend<T: Scalar, const D: usize>(at: &LegAt<'_, T, D>) -> (T, Interval) {
    at.leg.actuator.bend(at.span).unwrap_or((T::constant(Interval::ENTIRE), Interval::point(1.0)))
}

/// The rod's direction in the leg's frame, times [`rod_length`].
pub(super) fn rod_direction<T: Scalar, const D: usize>(at: &LegAt<'_, T, D>, sh: T) -> [T; D] {
    each!(|k| at.closure.fixed[k] + sh * at.closure.swing[k])
}

/// ‖weight · ∂f/∂d‖ = 2 M weight (2 q for a strut).
pub(super) fn rod_length<T: Scalar, const D: usize>(at: &LegAt<'_, T, D>) -> T {
    at.leg.actuator.row_length(at.closure)
}
