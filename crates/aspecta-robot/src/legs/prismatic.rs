//! A slider on a rail, a rod follows: PRR, PSS, PUS.

use super::closure::{Closure, Drive, Elbow, LockedEnd, RigidRod, outside, sum_of_squares};
use super::drawn::{Body, Dimension, Joint, Part, Points, Role, axis, beyond_anchor, minus, times};
use super::facts::{Facts, ROOTS_OF_A_QUADRATIC};
use super::{LegKind, Revolute, Spherical};
use crate::num::{Interval, Scalar};
use crate::{Fault, Leg, LegKeys, LinkPart};
use serde::{Deserialize, Serialize};

/// A slider at A + q u, a rod of length M: f = ‖C − A − q u‖² − M².
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Prismatic {
    /// M > 0.
    pub rod: Interval,
}

/// q u.
fn along_rail<T: Scalar, const D: usize>(q: T) -> [T; D] {
    let mut b = [T::zero(); D];
    b[0] = q;
    b
}

impl LegKind for Prismatic {
    const FACTS: Facts = Facts {
        name: "prismatic",
        planar_keys: &["rod", "direction"],
        spatial_keys: &["rod", "direction"],
        is_on_sphere: false,
        postures: 2,
        // Where B is along the rail, as seen from C.
        posture_names: &["ahead", "behind"],
        why_not_cuspidal: ROOTS_OF_A_QUADRATIC,
        is_angle: false,
        is_positive: false,
        has_elbow: false,
        has_rod: true,
        parts: &[
            Part::new(Role::Guide, "slider's range (driven joint filled)"),
            Part::new(Role::Follower, "rod"),
        ],
    };

    fn read(keys: &LegKeys<'_>) -> Result<Leg, Fault> {
        let (anchor, attachment) = keys.points()?;
        let frame = keys.rail_frame()?;
        let data = Self { rod: keys.length("rod")? };
        Ok(Leg { anchor, attachment, frame, actuator: data.into(), limits: Vec::new() })
    }

    #[inline]
    fn equation_turned<T: Scalar, const D: usize>(&self, d: &[T; D], q: T, _: impl FnOnce() -> (T, T)) -> T {
        let mut b = *d;
        b[0] = b[0] - q;
        sum_of_squares(&b) - T::constant(self.rod.square())
    }

    /// H = M² − β² − γ², q = α + s h, ∂f/∂q = 2 s h.
    fn eliminate<T: Scalar, const D: usize>(&self, d: &[T; D]) -> Closure<T, D> {
        let zero = T::zero();
        let mut across = zero;
        let mut fixed = [zero; D];
        let mut swing = [zero; D];
        for k in 1..D {
            across = across + d[k].square();
            fixed[k] = d[k].scale(Interval::point(2.0));
        }
        swing[0] = T::constant(Interval::point(-2.0));
        let weight = T::constant(Interval::point(1.0));
        Closure { reach: T::constant(self.rod.square()) - across, weight, fixed, swing }
    }

    fn drive<T: Scalar, const D: usize>(&self, d: &[T; D], _: &Closure<T, D>, sh: T) -> Drive<T> {
        Drive::Length(d[0] + sh)
    }

    #[inline]
    fn signed_height<T: Scalar>(&self, slope: T) -> T {
        slope.scale(Interval::point(0.5))
    }

    #[inline]
    fn force<T: Scalar, const D: usize>(&self, _: &[T; D]) -> T {
        T::constant(self.rod + self.rod)
    }

    #[inline]
    fn row_length<T: Scalar, const D: usize>(&self, closure: &Closure<T, D>) -> T {
        closure.weight.scale(self.rod + self.rod)
    }

    fn constants(&self) -> Vec<Interval> {
        vec![self.rod]
    }

    fn length_margin<T: Scalar, const D: usize>(&self, d: &[T; D], sh: T, min: Interval, max: Interval) -> T {
        let q = d[0] + sh;
        (q - T::constant(min)) * (T::constant(max) - q)
    }

    fn bend<T: Scalar, const D: usize>(&self, _: &[T; D]) -> Option<(T, Interval)> {
        None
    }

    fn greatest_reach(&self) -> Option<Interval> {
        Some(self.rod.square())
    }

    fn usual_weight(&self) -> Option<f64> {
        None
    }

    fn equation_scale(&self, q: f64) -> f64 {
        self.rod.mid().powi(2) + q * q
    }

    fn size(&self) -> f64 {
        self.rod.mid()
    }

    fn size_at(&self, _: f64) -> f64 {
        self.size()
    }

    fn rounded_size(&self, ends: f64, q: f64) -> f64 {
        ends + self.rod.hi + q.abs()
    }

    fn extent(&self, leg: &Leg, k: usize) -> Option<(Interval, Interval)> {
        let along = leg.frame[0][k];
        if along == Interval::point(0.0) {
            return Some((leg.anchor[k], self.rod));
        }
        leg.length_range().map(|(min, max)| (leg.anchor[k] + min.hull(max) * along, self.rod))
    }

    fn gap<const D: usize>(&self, d: &[f64; D]) -> f64 {
        outside(self.rod.mid(), (sum_of_squares(d) - d[0] * d[0]).max(0.0).sqrt(), f64::INFINITY)
    }

    fn elbow<T: Scalar, const D: usize>(&self, q: T) -> Option<[T; D]> {
        Some(along_rail(q))
    }

    fn locked<const D: usize>(&self, q: Interval) -> LockedEnd<D> {
        LockedEnd::Sphere { centre: along_rail(q), radius: self.rod }
    }

    fn rigid_rod(&self) -> Option<RigidRod> {
        Some(RigidRod { length: self.rod.mid(), elbow: Elbow::Line })
    }

    fn points<T: Scalar, const D: usize>(&self, leg: &Leg, span: &[T; D], _: &[T; D], q: T) -> Points<T, D> {
        let on = |t: T| beyond_anchor(leg, &along_rail(t));
        let rod = T::constant(self.rod);
        let (low, high) =
            leg.length_range().map_or((q - rod, q + rod), |(min, max)| (T::constant(min), T::constant(max)));
        Points { b: Some(on(q)), rail: Some([on(low), on(high)]), ..Points::ends(leg, span) }
    }

    fn bodies(&self, leg: &Leg, at: &Points<f64, 3>, _: f64) -> [Body; 2] {
        let b = at.b.unwrap_or(at.a);
        let rod = minus(at.c, b);
        [
            Body {
                name: "slider",
                place: b,
                ends: [[0.0; 3], times(0.1, rod)],
                link: None,
                joint: Joint::Driven { axis: axis(leg, 0) },
            },
            Body {
                name: "rod",
                place: [0.0; 3],
                ends: [[0.0; 3], rod],
                link: Some(LinkPart::Rod),
                joint: Joint::Passive { name: "elbow" },
            },
        ]
    }

    fn dimensions(&self, _: &Leg) -> Vec<Dimension> {
        vec![Dimension::length("rod", self.rod)]
    }

    fn as_revolute(&self) -> Option<&Revolute> {
        None
    }

    fn as_spherical(&self) -> Option<&Spherical> {
        None
    }
}
