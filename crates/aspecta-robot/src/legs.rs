//! The leg equation, typed once, and its closed-form inverse.
//!
//! Everything here is in the leg's own frame u, v, w, with d = C − A = (α, β, γ) (γ is absent in the
//! plane) and for any scalar.

use crate::Actuator;
use crate::num::{Interval, Scalar, each};

/// f(d, q), the left side of the leg equation f = 0. Lengths squared, except for spherical legs (a cosine).
pub fn equation<T: Scalar, const D: usize>(actuator: &Actuator, d: &[T; D], q: T) -> T {
    equation_turned(actuator, d, q, || q.sin_cos())
}

/// [`equation`] with (sin q, cos q) from `turn`, which is asked only where q is an angle.
#[inline]
pub fn equation_turned<T: Scalar, const D: usize>(
    actuator: &Actuator,
    d: &[T; D],
    q: T,
    turn: impl FnOnce() -> (T, T),
) -> T {
    match actuator {
        Actuator::Revolute { crank, rod } => {
            let (sin, cos) = turn();
            let mut b = *d;
            b[0] = b[0] - cos.scale(*crank);
            b[1] = b[1] - sin.scale(*crank);
            sum_of_squares(&b) - T::constant(rod.square())
        }
        Actuator::Prismatic { rod } => {
            let mut b = *d;
            b[0] = b[0] - q;
            sum_of_squares(&b) - T::constant(rod.square())
        }
        Actuator::Strut => sum_of_squares(d) - q.square(),
        Actuator::Spherical { proximal: (cos_p, sin_p), distal_cos } => {
            let (sin, cos) = turn();
            (cos * d[0] + sin * d[1]).scale(*sin_p) + d[D - 1].scale(*cos_p) - T::constant(*distal_cos)
        }
    }
}

/// What the leg equation becomes once q is eliminated, for both inverse solutions at once.
///
/// With s = ±1 the posture and h = √reach, B = ∂f/∂q has the sign of s, and
///
/// > weight · ∂f/∂d = fixed + s h · swing.
///
/// All four are polynomials in d: nothing is divided, and nothing but h fails to be smooth.
#[derive(Clone, Copy, Debug)]
pub struct Closure<T, const D: usize> {
    /// H: the leg closes strictly where H > 0; H = 0 is its serial singularity. h = |∂f/∂q|, or half of
    /// it for a prismatic leg. Struts close everywhere: their H is ‖d‖².
    pub reach: T,
    /// A factor ≥ 0, zero only where q is free (C on the axis of the crank).
    pub weight: T,
    /// The part of weight · ∂f/∂d that both postures share.
    pub fixed: [T; D],
    /// The part that changes sign with the posture, per h.
    pub swing: [T; D],
}

/// Eliminates q from the leg equation.
///
/// Revolute legs: f = k − a cos q − b sin q with (a, b) = 2L(α, β), k = ‖d‖² + L² − M². It has solutions
/// where H = a² + b² − k² ≥ 0, namely (a² + b²)(cos q, sin q) = k(a, b) + s h(−b, a), and there
/// ∂f/∂q = a sin q − b cos q = s h. Spherical legs are the same with (a, b) = −sin(proximal)(α, β),
/// k = cos(proximal) γ − cos(distal), ‖d‖ = 1. Prismatic legs: q = α + s h, ∂f/∂q = 2 s h.
pub fn eliminate<T: Scalar, const D: usize>(actuator: &Actuator, d: &[T; D]) -> Closure<T, D> {
    let zero = T::zero();
    let one = T::constant(Interval::point(1.0));
    let two = Interval::point(2.0);
    match actuator {
        Actuator::Revolute { crank, rod } => {
            let (l2, m2) = (crank.square(), rod.square());
            let planar = d[0].square() + d[1].square();
            // weight = α² + β². H is written so that ‖d‖ appears once.
            let (lateral, span) = match d.get(2) {
                Some(g) => (g.square(), planar + g.square()),
                None => (zero, planar),
            };
            let mut head = T::constant(l2 * m2);
            if D == 3 {
                head = T::constant(l2) * (T::constant(m2) - lateral);
            }
            let reach = head.scale(Interval::point(4.0)) - (span - T::constant(l2 + m2)).square();
            // ρ ∂f/∂d = 2ρ d − k(α, β) − s h(−β, α), simplified: 2ρ − k = α² + β² − γ² − L² + M².
            let mut rest = planar + T::constant(m2 - l2);
            if D == 3 {
                rest = rest - lateral;
            }
            let mut fixed = [zero; D];
            let mut swing = [zero; D];
            fixed[0] = d[0] * rest;
            fixed[1] = d[1] * rest;
            swing[0] = d[1];
            swing[1] = -d[0];
            if D == 3 {
                fixed[2] = (planar * d[2]).scale(two);
            }
            Closure { reach, weight: planar, fixed, swing }
        }
        Actuator::Prismatic { rod } => {
            let mut across = zero;
            let mut fixed = [zero; D];
            let mut swing = [zero; D];
            for k in 1..D {
                across = across + d[k].square();
                fixed[k] = d[k].scale(two);
            }
            swing[0] = T::constant(Interval::point(-2.0));
            Closure { reach: T::constant(rod.square()) - across, weight: one, fixed, swing }
        }
        Actuator::Strut => {
            let fixed = each!(|k| d[k].scale(two));
            Closure { reach: sum_of_squares(d), weight: one, fixed, swing: [zero; D] }
        }
        Actuator::Spherical { proximal: (cos_p, sin_p), distal_cos } => {
            let height = d[D - 1];
            let planar = d[0].square() + d[1].square();
            let k = height.scale(*cos_p) - T::constant(*distal_cos);
            let reach = planar.scale(sin_p.square()) - k.square();
            let mut fixed = [zero; D];
            let mut swing = [zero; D];
            fixed[0] = -(d[0] * k);
            fixed[1] = -(d[1] * k);
            fixed[D - 1] = planar.scale(*cos_p);
            swing[0] = d[1];
            swing[1] = -d[0];
            Closure { reach, weight: planar, fixed, swing }
        }
    }
}

/// Σ dₖ².
pub fn sum_of_squares<T: Scalar, const D: usize>(d: &[T; D]) -> T {
    let mut sum = d[0].square();
    for x in &d[1..] {
        sum = sum + x.square();
    }
    sum
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
    /// q: rad in (−π, π], or a length.
    pub fn value(self) -> f64 {
        match self {
            Self::Angle { cos, sin, .. } => sin.atan2(cos),
            Self::Length(q) => q,
        }
    }
}

/// The driven joint q in the posture given by `sh` = s h: g_i(X) of (5), leg by leg.
pub fn drive<T: Scalar, const D: usize>(
    actuator: &Actuator,
    d: &[T; D],
    closure: &Closure<T, D>,
    sh: T,
) -> Drive<T> {
    match actuator {
        Actuator::Revolute { crank, rod } => {
            let k = sum_of_squares(d) + T::constant(crank.square() - rod.square());
            let norm = closure.weight.scale(*crank + *crank);
            Drive::Angle { cos: k * d[0] - sh * d[1], sin: k * d[1] + sh * d[0], norm }
        }
        Actuator::Spherical { proximal: (_, sin_p), .. } => Drive::Angle {
            cos: closure.fixed[0] + sh * closure.swing[0],
            sin: closure.fixed[1] + sh * closure.swing[1],
            norm: closure.weight.scale(*sin_p),
        },
        Actuator::Prismatic { .. } => Drive::Length(d[0] + sh),
        Actuator::Strut => Drive::Length(closure.reach.sqrt()),
    }
}
