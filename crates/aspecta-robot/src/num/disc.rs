//! Complex numbers with an error bound: discs.

use super::ball::{TINY, UNIT};
use super::{Ball, Interval};
use std::ops::{Add, Mul, Neg, Sub};

/// All complex z with |z − (re + i im)| ≤ rad.
///
/// Like [`Ball`] for real numbers: each operation computes the centre in double precision and adds what
/// rounding may have done to the radius. A radius that is infinite or NaN means that nothing is known; what
/// compares with it is false.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disc {
    /// Real part of the centre.
    pub re: f64,
    /// Imaginary part of the centre.
    pub im: f64,
    /// The radius, ≥ 0.
    pub rad: f64,
}

/// Makes up for the roundings of a radius itself: at most eight operations on numbers ≥ 0, each losing at
/// most the share u.
const ENLARGE: f64 = 1.0 + 16.0 * f64::EPSILON;

impl Disc {
    /// The centre alone.
    #[inline(always)]
    pub const fn point(re: f64, im: f64) -> Self {
        Self { re, im, rad: 0.0 }
    }

    /// An upper bound of |z|, at most √2 times too large: squares might underflow.
    #[inline(always)]
    pub fn magnitude(self) -> f64 {
        (self.size() + self.rad) * ENLARGE
    }

    /// Whether 0 is proved not to lie in it; squares that underflow prove nothing.
    #[inline(always)]
    pub fn excludes_zero(self) -> bool {
        (self.re * self.re + self.im * self.im).sqrt() * (1.0 - 8.0 * f64::EPSILON) > self.rad + TINY
    }

    /// |re| + |im| ≥ |centre|, to bound roundings with.
    #[inline(always)]
    fn size(self) -> f64 {
        self.re.abs() + self.im.abs()
    }
}

impl From<Interval> for Disc {
    #[inline(always)]
    fn from(x: Interval) -> Self {
        let Ball { mid, rad } = x.into();
        Self { re: mid, im: 0.0, rad }
    }
}

impl Neg for Disc {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { re: -self.re, im: -self.im, rad: self.rad }
    }
}

impl Add for Disc {
    type Output = Self;
    /// Each part is rounded once: off by at most u |part|.
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        let sum = Self { re: self.re + b.re, im: self.im + b.im, rad: 0.0 };
        Self { rad: (self.rad + b.rad + UNIT * sum.size()) * ENLARGE + TINY, ..sum }
    }
}

impl Sub for Disc {
    type Output = Self;
    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        self + -b
    }
}

impl Mul for Disc {
    type Output = Self;
    /// Each part is made of two products and a sum: off by at most 2u(1 + u) of the sum of their moduli, and
    /// those of both parts sum up to the product of the sizes. |z w − c d| ≤ |c| rad w + |d| rad z + rad z
    /// rad w for the rest.
    #[inline(always)]
    fn mul(self, b: Self) -> Self {
        let (m, n) = (self.size(), b.size());
        let rad = self.rad * (n + b.rad) + m * b.rad + 4.0 * UNIT * (m * n);
        Self {
            re: self.re * b.re - self.im * b.im,
            im: self.re * b.im + self.im * b.re,
            rad: rad * ENLARGE + TINY,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::{Scalar, exact::two_sum};
    use proptest::prelude::*;

    /// The real and imaginary part of an expression in intervals, which hold the exact value of doubles.
    type Exact = [Interval; 2];

    fn exact(z: [f64; 2]) -> Exact {
        z.map(Interval::point)
    }

    fn holds(disc: Disc, z: Exact) -> bool {
        let square = (z[0] - Interval::point(disc.re)).square() + (z[1] - Interval::point(disc.im)).square();
        square.hi <= (disc.rad * disc.rad) * (1.0 + 1e-9) + 1e-300
    }

    proptest! {
        #[test]
        fn discs_hold_products_and_sums_of_what_they_hold(
            z in prop::array::uniform2(-1e3..1e3f64), w in prop::array::uniform2(-1e-3..1e3f64),
            radii in prop::array::uniform2(1e-6..1e-3f64), turns in prop::array::uniform2(0.0..6.3f64),
        ) {
            let disc = |z: [f64; 2], rad| Disc { re: z[0], im: z[1], rad };
            let (a, b) = (disc(z, radii[0]), disc(w, radii[1]));
            // Points well within the discs, so that their own rounding does not matter.
            let within = |z: [f64; 2], k: usize| {
                [z[0] + 0.999 * radii[k] * turns[k].cos(), z[1] + 0.999 * radii[k] * turns[k].sin()]
            };
            let (p, q) = (exact(within(z, 0)), exact(within(w, 1)));
            prop_assert!(holds(a + b, [p[0] + q[0], p[1] + q[1]]));
            prop_assert!(holds(a - b, [p[0] - q[0], p[1] - q[1]]));
            prop_assert!(holds(a * b, [p[0] * q[0] - p[1] * q[1], p[0] * q[1] + p[1] * q[0]]));
            prop_assert!((a * b).magnitude() >= z[0].hypot(z[1]) * w[0].hypot(w[1]));
        }

        /// The errors of the products by fused residuals, of their sums by TwoSum.
        #[test]
        fn the_rounding_of_products_is_within_the_radius(
            z in prop::array::uniform2(-1e3..1e3f64), w in prop::array::uniform2(-1e3..1e3f64),
        ) {
            let product = Disc::point(z[0], z[1]) * Disc::point(w[0], w[1]);
            let error = |a: f64, b: f64, c: f64, d: f64| {
                let (p, q) = (a * b, c * d);
                let (_, rounded) = two_sum(p, q);
                rounded + a.mul_add(b, -p) + c.mul_add(d, -q)
            };
            let off = error(z[0], w[0], -z[1], w[1]).hypot(error(z[0], w[1], z[1], w[0]));
            prop_assert!(off <= product.rad);
            prop_assert!(product.rad <= 1e-15 * z[0].hypot(z[1]) * w[0].hypot(w[1]) + 1e-280);
        }
    }
}
