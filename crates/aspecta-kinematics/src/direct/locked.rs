//! Legs with locked actuators: what the direct problem sees of a robot.

use crate::placement::{Placement, out_of_frame};
use arrayvec::ArrayVec;
use aspecta_robot::legs::LockedEnd;
use aspecta_robot::num::{Interval, Jet, Scalar};
use aspecta_robot::{Leg, Platform};
use nalgebra::{SMatrix, SVector};

/// A leg whose actuator is locked at q. The end C of a point-to-point leg is then tied to a sphere (a circle
/// in the plane) ‖C − P‖² = R²: it has become a strut of length R = `q` anchored at P = `leg.anchor`.
///
/// | actuator | P | R |
/// |---|---|---|
/// | revolute | A + L(cos q u + sin q v) | M |
/// | prismatic | A + q u | M |
/// | strut | A | q |
#[derive(Clone, Debug)]
pub(super) struct Locked {
    pub leg: Leg,
    pub q: Interval,
}

/// The legs of a robot, locked.
pub(super) type LockedLegs = ArrayVec<Locked, 6>;

impl Locked {
    /// Locks a point-to-point leg at the joint coordinate `q`, within the [`slack`] of q: a configuration
    /// whose q was rounded must not be lost. Spherical legs have no such form; they stay as they are.
    pub fn new<const D: usize>(leg: &Leg, q: f64) -> Self {
        let slack = slack(leg, q);
        let q = Interval::new(q - slack, q + slack);
        let (end, length) = match leg.actuator.locked::<D>(q) {
            LockedEnd::Sphere { centre, radius } => (out_of_frame(leg, &centre), radius),
            LockedEnd::Cone { .. } => return Self { leg: leg.clone(), q },
        };
        let mut anchor = leg.anchor;
        for k in 0..D {
            anchor[k] = anchor[k] + end[k];
        }
        Self { leg: Leg::strut_between(anchor, leg.attachment), q: length }
    }

    /// The centre P − c of the sphere of poses that this leg allows a platform that does not turn.
    pub fn centre<const D: usize>(&self) -> [Interval; D] {
        std::array::from_fn(|k| self.leg.anchor[k] - self.leg.attachment[k])
    }
}

/// Returns the rounding error of a `q` that the inverse model made of a pose: a few units in the last place
/// of the coordinates that went into it, seen as an angle of the crank where q is one.
fn slack(leg: &Leg, q: f64) -> f64 {
    let ends = largest(&leg.anchor) + largest(&leg.attachment);
    2.0 * f64::EPSILON * leg.actuator.rounded_size(ends, q)
}

/// f(X), one leg equation a locked leg, for any scalar: values, enclosures, or either with gradients.
#[inline]
pub(super) fn equations<T: Scalar, const D: usize, const N: usize>(
    platform: Platform,
    legs: &[Locked],
    x: &[T; N],
) -> [T; N] {
    let placement = Placement::<T, D>::at(platform, x);
    std::array::from_fn(|j| {
        let Locked { leg, q } = &legs[j];
        leg.actuator.equation(&placement.span(leg, &placement.arm(leg)), T::constant(*q))
    })
}

/// f and ∂f/∂X at the point `x`.
#[inline]
pub(super) fn linearised<const D: usize, const N: usize>(
    platform: Platform,
    legs: &[Locked],
    x: &[f64; N],
) -> (SVector<f64, N>, SMatrix<f64, N, N>) {
    let variables = std::array::from_fn(|k| Jet::<f64, N>::variable(x[k], k));
    let f = equations::<_, D, N>(platform, legs, &variables);
    (SVector::from_fn(|j, _| f[j].value), SMatrix::from_fn(|j, k| f[j].gradient[k]))
}

/// Returns the units in which pose coordinates are of order one: the longest leg, or a radian.
pub(super) fn units<const N: usize>(platform: Platform, legs: &[Locked]) -> [f64; N] {
    let longest = legs.iter().map(|l| l.q.hi).fold(0.0, f64::max);
    std::array::from_fn(|k| if platform.coordinates()[k].angle { 1.0 } else { longest })
}

/// Newton's method from `x`: the best iterate, the one with the least residual.
///
/// It stops after the first step so small that the next, quadratically smaller, is lost in rounding.
pub(super) fn polish<const D: usize, const N: usize>(
    platform: Platform,
    legs: &[Locked],
    x: [f64; N],
) -> [f64; N] {
    const MOST_STEPS: usize = 12;
    const SMALL_STEP: f64 = 1e-10;
    let unit = units::<N>(platform, legs);
    let (mut best, mut least) = (x, f64::INFINITY);
    let mut here = x;
    for _ in 0..MOST_STEPS {
        let (f, jacobian) = linearised::<D, N>(platform, legs, &here);
        let residual = f.amax();
        if residual >= least || residual.is_nan() {
            break;
        }
        (best, least) = (here, residual);
        let Some(inverse) = jacobian.try_inverse() else { break };
        let step = inverse * f;
        here = std::array::from_fn(|k| here[k] - step[k]);
        if (0..N).all(|k| step[k].abs() < SMALL_STEP * unit[k]) {
            return here;
        }
    }
    best
}

/// Whether the leg equations hold at `x` as far as rounding lets them: |f| is within a few dozen units in the
/// last place of the square of the coordinates that enter it.
pub(super) fn rounds_to_zero<const D: usize, const N: usize>(
    platform: Platform,
    legs: &[Locked],
    x: &[f64; N],
) -> bool {
    const ROUNDINGS: f64 = 64.0 * f64::EPSILON;
    let f = equations::<f64, D, N>(platform, legs, x);
    let size = |l: &Locked| l.q.hi + largest(&l.leg.anchor) + largest(&l.leg.attachment);
    f.iter().zip(legs).all(|(f, leg)| f.abs() <= ROUNDINGS * size(leg).powi(2))
}

fn largest(v: &[Interval; 3]) -> f64 {
    v.iter().map(|x| x.magnitude()).fold(0.0, f64::max)
}
