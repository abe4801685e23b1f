//! The scalars every formula of the crate is generic over.
//!
//! The kinematics are written once, for any [`Scalar`]:
//!
//! | scalar | what a formula yields |
//! |---|---|
//! | `f64` | a number, to rounding: *numerical* |
//! | [`Interval`] | bounds that hold the exact value: *certified* |
//! | [`Ball`] | the same as midpoint and radius, faster where ranges are narrow |
//! | [`Pack`] | eight intervals at once, for eight sibling boxes of a paving |
//! | [`Affine`] | the functions over eight boxes as linear ones up to an error, second-order tight |
//! | [`Slope`] over either | range, centre and slopes: the centred form, second-order tight |
//! | [`Jet`] | the value and its gradient (forward mode) |

mod affine;
mod ball;
mod disc;
mod exact;
mod interval;
mod jet;
mod kernel;
mod lanes;
mod nearest;
mod pack;
mod random;
mod slope;
mod trig;
mod written;

pub use affine::{Affine, Line};
pub use ball::Ball;
pub use disc::Disc;
pub use interval::Interval;
pub use jet::Jet;
pub use nearest::{Nearest, TwoLinks};
pub use pack::{LANES, Mask, Pack};
pub use random::Random;
pub use slope::{Enclosure, Slope};
pub use written::{count, written};

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number, an enclosure of numbers, or either with its gradient.
///
/// Every operation on an enclosing scalar returns an enclosure of all results over all operands
/// (the inclusion property), so a formula evaluated on enclosures encloses its exact range.
pub trait Scalar:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// The constant `c`; a plain `f64` takes its midpoint.
    fn constant(c: Interval) -> Self;

    /// `self²`, tighter than `self * self` on enclosures.
    fn square(self) -> Self;

    /// √max(self, 0): the part of an enclosure below zero is cut off. Callers test the sign first.
    fn sqrt(self) -> Self;

    /// (sin, cos) of an angle in radians.
    fn sin_cos(self) -> (Self, Self);

    /// The number of [0, 1] that is nearest: c(t) = min(max(t, 0), 1).
    fn clamped(self) -> Self;

    /// The derivative of [`Scalar::clamped`], 1 within [0, 1] and 0 outside; at the ends it may be either.
    fn clamped_slope(self) -> Self;

    /// 2∫c, c(t) = [`Scalar::clamped`] and the integral from 0 to t: t² within [0, 1], 0 below and 2t − 1 above. It is smooth, with the
    /// derivative 2c.
    fn clamped_square(self) -> Self;

    /// The greater of two numbers.
    fn greatest(self, other: Self) -> Self;

    /// The smaller of two numbers.
    fn least(self, other: Self) -> Self {
        -(-self).greatest(-other)
    }

    /// `yes` where `self` is positive and `no` where it is negative; where it is zero, either.
    fn choose(self, yes: Self, no: Self) -> Self;

    /// The [`Nearest`] points of two links; of enclosures all that there are.
    fn nearest<const D: usize>(links: &TwoLinks<Self, D>) -> Nearest<Self>;

    /// The square of the least distance of two links.
    fn least_square<const D: usize>(links: &TwoLinks<Self, D>) -> Self {
        let between = links.between(&Self::nearest(links));
        (1..D).fold(between[0].square(), |sum, k| sum + between[k].square())
    }

    /// Returns the number enclosed as tightly as its own slopes allow; other scalars are returned unchanged.
    #[inline(always)]
    fn tightened(self) -> Self {
        self
    }

    /// The constant zero.
    #[inline(always)]
    fn zero() -> Self {
        Self::constant(Interval::point(0.0))
    }

    /// `c · self`. Robots are full of zeros and ones (anchors at the origin, axis-aligned frames):
    /// both cost nothing.
    #[inline(always)]
    fn scale(self, c: Interval) -> Self {
        if c == Interval::point(1.0) { self } else { self * Self::constant(c) }
    }
}

impl Scalar for f64 {
    #[inline(always)]
    fn constant(c: Interval) -> Self {
        c.mid()
    }
    #[inline(always)]
    fn square(self) -> Self {
        self * self
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self.max(0.0))
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        f64::sin_cos(self)
    }
    fn clamped(self) -> Self {
        self.clamp(0.0, 1.0)
    }
    fn clamped_slope(self) -> Self {
        if (0.0..=1.0).contains(&self) { 1.0 } else { 0.0 }
    }
    fn clamped_square(self) -> Self {
        let c = self.clamped();
        c * (2.0 * self - c)
    }
    fn greatest(self, other: Self) -> Self {
        self.max(other)
    }
    fn choose(self, yes: Self, no: Self) -> Self {
        if self > 0.0 { yes } else { no }
    }
    fn nearest<const D: usize>(links: &TwoLinks<Self, D>) -> Nearest<Self> {
        links.nearest_numbers()
    }
}

/// `each!(|k| e)`: the array [e(0), e(1), …], as long as its place wants it.
///
/// It is for the kernels. `std::array::from_fn` does the same, but the calls of its closure are not reliably
/// inlined, and packs that pass through memory cost several times what they compute (`docs/performance.md`).
#[macro_export]
macro_rules! each {
    (|$k:ident| $entry:expr) => {{
        let mut array = [$crate::num::Scalar::zero(); _];
        for $k in 0..array.len() {
            array[$k] = $entry;
        }
        array
    }};
}
pub use each;

/// Σ aₖ bₖ.
#[inline]
pub fn dot<T: Scalar, const D: usize>(a: &[T; D], b: &[T; D]) -> T {
    let mut sum = a[0] * b[0];
    for k in 1..D {
        sum = sum + a[k] * b[k];
    }
    sum
}

/// a × b.
pub fn cross<T: Scalar>(a: &[T; 3], b: &[T; 3]) -> [T; 3] {
    let minor = |i: usize, j: usize| a[i] * b[j] - a[j] * b[i];
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

/// Σ cₖ aₖ with constant cₖ: exact zeros cost nothing.
#[inline]
pub fn dot_constant<T: Scalar, const D: usize>(c: &[Interval], a: &[T; D]) -> T {
    let mut terms = (0..D).filter(|&k| c[k] != Interval::point(0.0));
    let Some(first) = terms.next() else { return T::zero() };
    let mut sum = a[first].scale(c[first]);
    for k in terms {
        sum = sum + a[k].scale(c[k]);
    }
    sum
}

/// Numbers, and zeros after them; those that do not fit are left out.
pub fn padded<const K: usize>(values: &[f64]) -> [f64; K] {
    std::array::from_fn(|k| values.get(k).copied().unwrap_or(0.0))
}

/// An angle turned by full turns to be next to another one: at most π (and roundings) away. An angle that is
/// next to it already keeps its digits.
pub fn turned_to(angle: f64, near: f64) -> f64 {
    angle + std::f64::consts::TAU * ((near - angle) / std::f64::consts::TAU).round()
}

/// An angle without its full turns: in [−π, π].
pub fn without_turns(angle: f64) -> f64 {
    angle - std::f64::consts::TAU * (angle / std::f64::consts::TAU).round()
}
