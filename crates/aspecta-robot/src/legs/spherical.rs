//! RRR on a sphere about the origin.

use super::closure::{Closure, Drive, LockedEnd, RigidRod, outside};
use super::drawn::{Body, Dimension, Joint, Part, Points, Role, Size, axis};
use super::facts::{Facts, ROOTS_OF_A_QUADRATIC};
use super::{LegKind, Revolute};
use crate::num::{Interval, Scalar};
use crate::{Fault, Leg, LegKeys, out_of_frame};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// w_i = cos(proximal) w + sin(proximal)(cos q u + sin q v) is the intermediate joint, at the angle `distal`
/// of the platform joint v_i: f = w_i · v_i − cos(distal).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Spherical {
    /// (cos, sin) of the proximal link's angle.
    pub proximal: (Interval, Interval),
    /// cos of the distal link's angle.
    pub distal_cos: Interval,
}

impl Spherical {
    /// w_i in the leg's frame.
    fn intermediate_joint<T: Scalar, const D: usize>(&self, q: T) -> [T; D] {
        let (cos_p, sin_p) = (T::constant(self.proximal.0), T::constant(self.proximal.1));
        let (sin, cos) = q.sin_cos();
        let mut w = [T::zero(); D];
        (w[0], w[1], w[D - 1]) = (cos * sin_p, sin * sin_p, cos_p);
        w
    }
}

impl LegKind for Spherical {
    const FACTS: Facts = Facts {
        name: "spherical",
        planar_keys: &["proximal", "distal", "axis", "zero"],
        spatial_keys: &["proximal", "distal", "axis", "zero"],
        is_on_sphere: true,
        postures: 2,
        // The side of the way from the axis to the platform joint where the intermediate joint is, as seen
        // from outside.
        posture_names: &["right", "left"],
        why_not_cuspidal: ROOTS_OF_A_QUADRATIC,
        is_angle: true,
        is_positive: false,
        has_elbow: false,
        has_rod: false,
        parts: &[
            Part::new(Role::Driven, "proximal link (driven joint filled)"),
            Part::new(Role::Follower, "distal link"),
        ],
    };

    fn read(keys: &LegKeys<'_>) -> Result<Leg, Fault> {
        let (anchor, attachment) = keys.joints_on_sphere()?;
        let frame = keys.crank_frame()?;
        let data = Self { proximal: keys.link("proximal")?, distal_cos: keys.link("distal")?.0 };
        Ok(Leg { anchor, attachment, frame, actuator: data.into(), limits: Vec::new() })
    }

    #[inline]
    fn equation_turned<T: Scalar, const D: usize>(
        &self,
        d: &[T; D],
        _: T,
        turn: impl FnOnce() -> (T, T),
    ) -> T {
        let (cos_p, sin_p) = self.proximal;
        let (sin, cos) = turn();
        (cos * d[0] + sin * d[1]).scale(sin_p) + d[D - 1].scale(cos_p) - T::constant(self.distal_cos)
    }

    /// Eliminates q as for revolute legs, with (a, b) = −sin(proximal)(α, β), k = cos(proximal) γ −
    /// cos(distal), ‖d‖ = 1.
    fn eliminate<T: Scalar, const D: usize>(&self, d: &[T; D]) -> Closure<T, D> {
        let (cos_p, sin_p) = self.proximal;
        let zero = T::zero();
        let height = d[D - 1];
        let planar = d[0].square() + d[1].square();
        let k = height.scale(cos_p) - T::constant(self.distal_cos);
        let reach = planar.scale(sin_p.square()) - k.square();
        let mut fixed = [zero; D];
        let mut swing = [zero; D];
        fixed[0] = -(d[0] * k);
        fixed[1] = -(d[1] * k);
        fixed[D - 1] = planar.scale(cos_p);
        swing[0] = d[1];
        swing[1] = -d[0];
        Closure { reach, weight: planar, fixed, swing }
    }

    fn drive<T: Scalar, const D: usize>(&self, _: &[T; D], closure: &Closure<T, D>, sh: T) -> Drive<T> {
        Drive::Angle {
            cos: closure.fixed[0] + sh * closure.swing[0],
            sin: closure.fixed[1] + sh * closure.swing[1],
            norm: closure.weight.scale(self.proximal.1),
        }
    }

    #[inline]
    fn signed_height<T: Scalar>(&self, slope: T) -> T {
        slope
    }

    /// ∂f/∂d is the unit vector of the intermediate joint.
    #[inline]
    fn force<T: Scalar, const D: usize>(&self, _: &[T; D]) -> T {
        T::constant(Interval::point(1.0))
    }

    #[inline]
    fn row_length<T: Scalar, const D: usize>(&self, closure: &Closure<T, D>) -> T {
        closure.weight
    }

    fn constants(&self) -> Vec<Interval> {
        vec![self.proximal.0, self.proximal.1, self.distal_cos]
    }

    fn length_margin<T: Scalar, const D: usize>(&self, _: &[T; D], _: T, _: Interval, _: Interval) -> T {
        T::constant(Interval::ENTIRE)
    }

    fn bend<T: Scalar, const D: usize>(&self, _: &[T; D]) -> Option<(T, Interval)> {
        None
    }

    fn greatest_reach(&self) -> Option<Interval> {
        let one = Interval::point(1.0);
        Some(self.proximal.1.square() * (one - self.distal_cos.square()))
    }

    fn usual_weight(&self) -> Option<f64> {
        None
    }

    fn equation_scale(&self, _: f64) -> f64 {
        1.0
    }

    fn size(&self) -> f64 {
        1.0
    }

    fn size_at(&self, _: f64) -> f64 {
        1.0
    }

    fn rounded_size(&self, _: f64, q: f64) -> f64 {
        q.abs() + 1.0
    }

    fn extent(&self, _: &Leg, _: usize) -> Option<(Interval, Interval)> {
        None
    }

    fn gap<const D: usize>(&self, d: &[f64; D]) -> f64 {
        let (cos, sin) = self.proximal;
        let (proximal, distal) = (sin.mid().atan2(cos.mid()), self.distal_cos.mid().acos());
        let tilt = d[0].hypot(d[1]).atan2(d.get(2).copied().unwrap_or(0.0));
        outside(distal, (proximal - tilt).abs(), (proximal + tilt).min(2.0 * PI - proximal - tilt))
    }

    fn elbow<T: Scalar, const D: usize>(&self, q: T) -> Option<[T; D]> {
        Some(self.intermediate_joint(q))
    }

    fn locked<const D: usize>(&self, q: Interval) -> LockedEnd<D> {
        LockedEnd::Cone { axis: self.intermediate_joint(q), cosine: self.distal_cos }
    }

    fn rigid_rod(&self) -> Option<RigidRod> {
        None
    }

    fn points<T: Scalar, const D: usize>(&self, leg: &Leg, _: &[T; D], arm: &[T; D], q: T) -> Points<T, D> {
        let mut w = [T::zero(); D];
        w[D - 1] = T::constant(Interval::point(1.0));
        let b = out_of_frame(leg, &self.intermediate_joint(q));
        Points { a: out_of_frame(leg, &w), b: Some(b), c: *arm, rail: None }
    }

    fn bodies(&self, leg: &Leg, at: &Points<f64, 3>, _: f64) -> [Body; 2] {
        let Points { a, c, .. } = *at;
        let b = at.b.unwrap_or(a);
        [
            Body {
                name: "proximal",
                place: [0.0; 3],
                ends: [a, b],
                link: None,
                joint: Joint::Driven { axis: axis(leg, 2) },
            },
            Body {
                name: "distal",
                place: [0.0; 3],
                ends: [b, c],
                link: None,
                joint: Joint::Hinge { name: "elbow", axis: b },
            },
        ]
    }

    fn dimensions(&self, _: &Leg) -> Vec<Dimension> {
        let (cos, sin) = self.proximal;
        let angle = |name, angle| Dimension { name, size: Some(Size::Angle(angle)) };
        vec![angle("proximal", sin.mid().atan2(cos.mid())), angle("distal", self.distal_cos.mid().acos())]
    }

    fn as_revolute(&self) -> Option<&Revolute> {
        None
    }

    fn as_spherical(&self) -> Option<&Self> {
        Some(self)
    }
}
