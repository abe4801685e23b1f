//! The distance from A to C is driven: RPR, UPS, SPS.

use super::closure::{Closure, Drive, LockedEnd, RigidRod, sum_of_squares};
use super::drawn::{Body, Dimension, Joint, Part, Points, Role, Size, minus, times};
use super::facts::Facts;
use super::{LegKind, Revolute, Spherical};
use crate::num::{Interval, Scalar, dot, each};
use crate::{BASE_FRAME, Fault, Leg, LegKeys, LinkPart};
use serde::{Deserialize, Serialize};

/// A leg from A to C of length q > 0: f = ‖C − A‖² − q².
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Strut;

impl Leg {
    /// A strut in the plane.
    pub fn strut(anchor: [f64; 2], attachment: [f64; 2]) -> Self {
        Self::planar(anchor, attachment, Strut.into())
    }

    /// A strut from A to C, described in base coordinates.
    pub fn strut_between(anchor: [Interval; 3], attachment: [Interval; 3]) -> Self {
        Self { anchor, attachment, frame: BASE_FRAME, actuator: Strut.into(), limits: Vec::new() }
    }
}

impl LegKind for Strut {
    const FACTS: Facts = Facts {
        name: "strut",
        planar_keys: &[],
        spatial_keys: &[],
        is_on_sphere: false,
        postures: 1,
        posture_names: &[],
        why_not_cuspidal: "one posture: the strut's length is positive",
        is_angle: false,
        is_positive: true,
        has_elbow: false,
        has_rod: true,
        parts: &[Part::new(Role::Driven, "strut (driven length)")],
    };

    fn read(keys: &LegKeys<'_>) -> Result<Leg, Fault> {
        let (anchor, attachment) = keys.points()?;
        Ok(Leg::strut_between(anchor, attachment))
    }

    #[inline]
    fn equation_turned<T: Scalar, const D: usize>(&self, d: &[T; D], q: T, _: impl FnOnce() -> (T, T)) -> T {
        sum_of_squares(d) - q.square()
    }

    /// H = ‖d‖² = q², and ∂f/∂q = −2q: s = −1, and ∂f/∂q = 2 s h.
    fn eliminate<T: Scalar, const D: usize>(&self, d: &[T; D]) -> Closure<T, D> {
        let fixed = each!(|k| d[k].scale(Interval::point(2.0)));
        let weight = T::constant(Interval::point(1.0));
        Closure { reach: sum_of_squares(d), weight, fixed, swing: [T::zero(); D] }
    }

    fn drive<T: Scalar, const D: usize>(&self, _: &[T; D], closure: &Closure<T, D>, _: T) -> Drive<T> {
        Drive::Length(closure.reach.sqrt())
    }

    #[inline]
    fn signed_height<T: Scalar>(&self, slope: T) -> T {
        slope.scale(Interval::point(0.5))
    }

    #[inline]
    fn force<T: Scalar, const D: usize>(&self, gradient: &[T; D]) -> T {
        dot(gradient, gradient).sqrt()
    }

    #[inline]
    fn row_length<T: Scalar, const D: usize>(&self, closure: &Closure<T, D>) -> T {
        let q = closure.reach.sqrt();
        q + q
    }

    fn constants(&self) -> Vec<Interval> {
        Vec::new()
    }

    /// In q², which is smooth in d.
    fn length_margin<T: Scalar, const D: usize>(&self, d: &[T; D], _: T, min: Interval, max: Interval) -> T {
        let q2 = sum_of_squares(d);
        (q2 - T::constant(min.square())) * (T::constant(max.square()) - q2)
    }

    fn bend<T: Scalar, const D: usize>(&self, _: &[T; D]) -> Option<(T, Interval)> {
        None
    }

    fn greatest_reach(&self) -> Option<Interval> {
        None
    }

    fn usual_weight(&self) -> Option<f64> {
        None
    }

    fn equation_scale(&self, q: f64) -> f64 {
        q * q
    }

    fn size(&self) -> f64 {
        1.0
    }

    fn size_at(&self, q: f64) -> f64 {
        q
    }

    fn rounded_size(&self, ends: f64, q: f64) -> f64 {
        ends + q.abs()
    }

    fn extent(&self, leg: &Leg, k: usize) -> Option<(Interval, Interval)> {
        leg.length_range().map(|(_, max)| (leg.anchor[k], max))
    }

    fn gap<const D: usize>(&self, _: &[f64; D]) -> f64 {
        0.0
    }

    fn elbow<T: Scalar, const D: usize>(&self, _: T) -> Option<[T; D]> {
        None
    }

    fn locked<const D: usize>(&self, q: Interval) -> LockedEnd<D> {
        LockedEnd::Sphere { centre: [Interval::point(0.0); D], radius: q }
    }

    fn rigid_rod(&self) -> Option<RigidRod> {
        None
    }

    fn points<T: Scalar, const D: usize>(&self, leg: &Leg, span: &[T; D], _: &[T; D], _: T) -> Points<T, D> {
        Points::ends(leg, span)
    }

    /// Both parts are as long as the shortest strut if they cover the longest so, as those that are built are.
    fn bodies(&self, leg: &Leg, at: &Points<f64, 3>, q: f64) -> [Body; 2] {
        let span = minus(at.c, at.a);
        let part = times(leg.telescope().map_or(0.5, |part| part.lo / q), span);
        [
            Body {
                name: "cylinder",
                place: at.a,
                ends: [[0.0; 3], part],
                link: Some(LinkPart::Rod),
                joint: Joint::Passive { name: "base" },
            },
            Body {
                name: "piston",
                place: [0.0; 3],
                ends: [minus(span, part), span],
                link: Some(LinkPart::Rod),
                joint: Joint::Driven { axis: times(1.0 / q, span) },
            },
        ]
    }

    fn dimensions(&self, leg: &Leg) -> Vec<Dimension> {
        let size = leg.length_range().map(|(min, max)| Size::Lengths(min.mid(), max.mid()));
        vec![Dimension { name: "strut", size }]
    }

    fn as_revolute(&self) -> Option<&Revolute> {
        None
    }

    fn as_spherical(&self) -> Option<&Spherical> {
        None
    }
}
