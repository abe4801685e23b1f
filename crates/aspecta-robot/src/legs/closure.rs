//! The types in which kinds of legs answer: the leg equation with q eliminated, the driven joint, the end of
//! a locked leg.

use crate::num::{Interval, Scalar};

/// The leg equation with q eliminated, for both inverse solutions at once.
///
/// With s = ±1 the posture and h = √reach, B = ∂f/∂q has the sign of s, and
///
/// > weight · ∂f/∂d = fixed + s h · swing.
///
/// All four are polynomials in d: nothing is divided, and nothing but h fails to be smooth.
#[derive(Clone, Copy, Debug)]
pub struct Closure<T, const D: usize> {
    /// H: the leg closes strictly where H > 0; H = 0 is its serial singularity. s h is a constant fraction of
    /// ∂f/∂q ([`Actuator::signed_height`](super::Actuator::signed_height)). Struts close everywhere: their H
    /// is ‖d‖².
    pub reach: T,
    /// A factor ≥ 0, zero only where q is free (C on the axis of the crank).
    pub weight: T,
    /// The part of weight · ∂f/∂d that both postures share.
    pub fixed: [T; D],
    /// The part that changes sign with the posture, per h.
    pub swing: [T; D],
}

/// The driven joint in posture s, from `swing` = s h.
#[derive(Clone, Copy, Debug)]
pub enum Drive<T> {
    /// norm · (cos q, sin q), norm ≥ 0.
    Angle {
        /// norm · cos q.
        cos: T,
        /// norm · sin q.
        sin: T,
        /// The norm, a multiple of [`Closure::weight`].
        norm: T,
    },
    /// q itself.
    Length(T),
}

impl Drive<f64> {
    /// q as it is computed: rad in (−π, π], or a length. People are told [`Leg::joint_value`](crate::Leg::joint_value).
    pub fn value(self) -> f64 {
        match self {
            Self::Angle { cos, sin, .. } => sin.atan2(cos),
            Self::Length(q) => q,
        }
    }
}

/// The points that the end C of a leg can reach while its actuator is locked, in the leg's frame.
#[derive(Clone, Copy, Debug)]
pub enum LockedEnd<const D: usize> {
    /// C is on a sphere (a circle in the plane): the leg has become a strut.
    Sphere {
        /// Its centre, from A.
        centre: [Interval; D],
        /// Its radius.
        radius: Interval,
    },
    /// The direction of C is on a cone about the anchor.
    Cone {
        /// The cone's axis, a unit vector.
        axis: [Interval; D],
        /// The cosine of its half-angle.
        cosine: Interval,
    },
}

/// A rod of constant length that ends in C.
#[derive(Clone, Copy, Debug)]
pub struct RigidRod {
    /// Its length, approximately.
    pub length: f64,
    /// The curve that its other end B runs on.
    pub elbow: Elbow,
}

/// The curve of a point B that the actuator moves.
#[derive(Clone, Copy, Debug)]
pub enum Elbow {
    /// The circle about A from u towards v with this radius, approximately.
    Circle(f64),
    /// The line through A along u.
    Line,
}

/// Σ dₖ².
pub fn sum_of_squares<T: Scalar, const D: usize>(d: &[T; D]) -> T {
    let mut sum = d[0].square();
    for x in &d[1..] {
        sum = sum + x.square();
    }
    sum
}

/// The distance of `x` from [lo, hi].
pub(super) fn outside(x: f64, lo: f64, hi: f64) -> f64 {
    (lo - x).max(x - hi).max(0.0)
}
