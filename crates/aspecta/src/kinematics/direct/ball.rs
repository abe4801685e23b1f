//! Enclosures by midpoint and radius.

use crate::num::{Interval, Scalar};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// The numbers within `radius` of `middle`.
///
/// For long polynomials of narrow operands: a product takes no minimum or maximum and is several times faster than
/// that of [`Interval`]s. A radius that is infinite or NaN means that nothing is known.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ball {
    pub middle: f64,
    pub radius: f64,
}

/// Rounding to nearest is off by at most this times the result, underflow apart.
const UNIT: f64 = f64::EPSILON / 2.0;

impl Ball {
    /// A ball round `middle`, the rounded result of an operation whose error without the rounding is `radius`, itself
    /// the rounded result of at most five operations on numbers ≥ 0 (each off by a factor of 1 + UNIT at most).
    #[inline(always)]
    fn rounded(middle: f64, radius: f64) -> Self {
        let radius = (radius + UNIT * middle.abs() + f64::MIN_POSITIVE) * (1.0 + 16.0 * UNIT);
        Self { middle, radius }
    }

    fn interval(self) -> Interval {
        Interval::point(self.middle) + Interval::new(-self.radius, self.radius)
    }
}

impl Scalar for Ball {
    #[inline(always)]
    fn constant(c: Interval) -> Self {
        let middle = c.mid();
        if c.lo == c.hi {
            return Self { middle, radius: 0.0 };
        }
        Self::rounded(middle, (c.hi - middle).max(middle - c.lo))
    }

    #[inline(always)]
    fn square(self) -> Self {
        let radius = self.radius * (2.0 * self.middle.abs() + self.radius);
        Self::rounded(self.middle * self.middle, radius)
    }

    fn sqrt(self) -> Self {
        Self::constant(self.interval().sqrt())
    }

    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.interval().sin_cos();
        (Self::constant(sin), Self::constant(cos))
    }
}

impl Neg for Ball {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { middle: -self.middle, ..self }
    }
}

impl Add for Ball {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        Self::rounded(self.middle + b.middle, self.radius + b.radius)
    }
}

impl Sub for Ball {
    type Output = Self;
    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        Self::rounded(self.middle - b.middle, self.radius + b.radius)
    }
}

impl Mul for Ball {
    type Output = Self;
    #[inline(always)]
    fn mul(self, b: Self) -> Self {
        let radius = self.radius * (b.middle.abs() + b.radius) + self.middle.abs() * b.radius;
        Self::rounded(self.middle * b.middle, radius)
    }
}

impl Div for Ball {
    type Output = Self;
    fn div(self, b: Self) -> Self {
        Self::constant(self.interval() / b.interval())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Points of the operands, combined in intervals, meet the ball of the result.
        #[test]
        fn results_hold_those_of_all_operands(
            a in -9.0..9.0f64, r in 0.0..1.0f64, b in -9.0..9.0f64, s in 0.0..1.0f64,
            t in -1.0..=1.0f64, u in -1.0..=1.0f64,
        ) {
            let (x, y) = (Ball { middle: a, radius: r }, Ball { middle: b, radius: s });
            let (p, q) = (x.interval(), y.interval());
            let (p, q) = ((a + t * r).clamp(p.lo, p.hi), (b + u * s).clamp(q.lo, q.hi));
            let (p, q) = (Interval::point(p), Interval::point(q));
            let meets = |ball: Ball, point: Interval| {
                let i = ball.interval();
                i.lo <= point.hi && point.lo <= i.hi
            };
            prop_assert!(meets(x + y, p + q) && meets(x - y, p - q) && meets(-x, -p));
            prop_assert!(meets(x * y, p * q) && meets(x.square(), p * p));
            prop_assert!(meets(x / y, p / q));
        }

        #[test]
        fn rounding_is_inside(a in -9.0..9.0f64, b in -9.0..9.0f64) {
            let x = Ball::constant(Interval::point(a)) * Ball::constant(Interval::point(b));
            let error = a.mul_add(b, -x.middle).abs();
            prop_assert!(error <= x.radius && x.radius <= 1.1 * UNIT * x.middle.abs() + 1e-300);
        }
    }
}
