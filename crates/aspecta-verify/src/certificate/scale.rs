//! How large a scale can be that was found as a mean magnitude.

use super::{Certificate, Unsound};
use aspecta_robot::constraint::Constraint;
use aspecta_robot::num::Interval;
use aspecta_robot::{Actuator, Clearance, Leg, Limit, Prismatic, Revolute, Shape, Solid, Strut, Window};

/// How many times the greatest magnitude of a function its scale may be. Proofs hold for any scale, but what
/// is divided by very much is all but zero, and then each leaf takes as long as one can take.
const ROOM: f64 = 1e9;

impl Certificate {
    /// Whether no scale is far beyond all that its function can be.
    pub(super) fn check_sizes(&self) -> Result<(), Unsound> {
        let arms = self.robot.legs.iter().map(|leg| gradient(leg, &self.window) * (1.0 + arm(leg)));
        // Hadamard: a determinant is at most the product of its rows' lengths.
        let det: f64 = arms.product();
        for constraint in Constraint::of(&self.robot) {
            let greatest = match constraint {
                Constraint::Det => det,
                Constraint::Reach(j) => reach(self.robot.leg(j)),
                Constraint::Limit(j, k) => {
                    let leg = self.robot.leg(j);
                    limit(leg, &leg.limits[k], &self.window)
                }
                // Two differences of cosines.
                Constraint::RodAngle(..) => 4.0,
                // The square of a distance, or the product of two.
                Constraint::Apart(_, k) => {
                    let legs = self.robot.legs.iter();
                    let far = legs
                        .map(|leg| span(leg, &self.window) + gradient(leg, &self.window) + norm(&leg.anchor));
                    let ends = self.robot.bodies.iter().flat_map(|capsule| capsule.shape.ends()).flatten();
                    let far = far.sum::<f64>() + ends.map(|end| norm(&end)).sum::<f64>();
                    let offsets = self.robot.bodies.iter().map(|capsule| match capsule.shape {
                        Shape::Wall { offset, .. } => offset.magnitude(),
                        Shape::Link | Shape::Axis(_) => 0.0,
                    });
                    (far + offsets.sum::<f64>() + self.robot.pairs[k].distance.hi).max(1.0).powi(2)
                }
            };
            // A function whose magnitudes are none has the scale 1.
            let (value, most) = (self.scale[constraint], (ROOM * greatest).max(1.0));
            if value > most {
                return Err(Unsound::Scale { key: key(constraint), value, most });
            }
        }
        Ok(())
    }
}

/// The place in the file, counted from 0.
fn key(constraint: Constraint) -> String {
    match constraint {
        Constraint::Det => "scale.det".into(),
        Constraint::Reach(j) => format!("scale.reach[{}]", j.index()),
        Constraint::Limit(j, k) => format!("scale.limits[{}][{k}]", j.index()),
        Constraint::RodAngle(_, k) => format!("scale.rod_angles[{k}]"),
        Constraint::Apart(_, k) => format!("scale.pairs[{k}]"),
    }
}

/// A bound of the length of a vector.
fn norm(v: &[Interval]) -> f64 {
    v.iter().map(|x| x.lo.abs().max(x.hi.abs())).sum()
}

/// A bound of ‖C‖ in the platform.
fn arm(leg: &Leg) -> f64 {
    norm(&leg.attachment)
}

/// A bound of ‖C − A‖.
fn span(leg: &Leg, window: &Window) -> f64 {
    let poses: f64 = window.ranges.iter().map(|(lo, hi)| lo.abs().max(hi.abs())).sum();
    norm(&leg.anchor) + arm(leg) + poses
}

/// A bound of ‖∂f/∂C‖: twice the length of the rod, or of the strut.
fn gradient(leg: &Leg, window: &Window) -> f64 {
    match &leg.actuator {
        Actuator::Revolute(Revolute { rod, .. }) | Actuator::Prismatic(Prismatic { rod }) => 2.0 * rod.hi,
        Actuator::Strut(Strut) => 2.0 * span(leg, window),
        Actuator::Spherical(_) => 1.0,
    }
}

/// A bound of H.
fn reach(leg: &Leg) -> f64 {
    match &leg.actuator {
        Actuator::Revolute(Revolute { crank, rod }) => (2.0 * crank.hi * rod.hi).powi(2),
        Actuator::Prismatic(Prismatic { rod }) => rod.hi.powi(2),
        Actuator::Strut(Strut) | Actuator::Spherical(_) => 1.0,
    }
}

/// A bound of the modulus of the margin of a limit.
fn limit(leg: &Leg, limit: &Limit, window: &Window) -> f64 {
    match limit {
        // Of directions: a cosine less a cosine.
        Limit::ActuatorAngle { .. } | Limit::BaseCone { .. } | Limit::PlatformCone { .. } => 2.0,
        // 2LM, the root of H at most, times cosines.
        Limit::Elbow { .. } => 3.0 * reach(leg).sqrt(),
        Limit::SpatialElbow { .. } => 4.0 * reach(leg),
        // The square of a distance, or one.
        Limit::Clearance(Clearance { solid, distance, .. }) => {
            let place = match solid {
                Solid::Ball { centre, radius } => norm(centre) + radius.hi,
                Solid::Wall { offset, .. } => norm(&[*offset]),
            };
            let far = place + distance.hi + norm(&leg.anchor) + span(leg, window) + gradient(leg, window);
            far.max(1.0).powi(2)
        }
        Limit::ActuatorLength { min, max } => {
            // Of a slider two differences of lengths, of a strut two of their squares.
            let length = span(leg, window) + gradient(leg, window) + norm(&[*min, *max]);
            length.max(1.0).powi(4)
        }
    }
}
