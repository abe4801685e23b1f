//! Numbers with an error bound: midpoint and radius.

use super::{Interval, Nearest, Scalar, TwoLinks};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Half the distance from 1 to the next double: a result rounded to nearest is off by at most this share of
/// itself.
pub(super) const UNIT: f64 = f64::EPSILON / 2.0;
/// Makes up for the roundings of a radius itself: at most six operations, each losing at most `UNIT`.
const ENLARGE: f64 = 1.0 + 8.0 * f64::EPSILON;
/// Far above all that underflow can lose, and still a normal double, so that it slows nothing down.
pub(super) const TINY: f64 = 1e-290;

/// All x with |x − mid| ≤ rad.
///
/// For narrow ranges that need not be cut: a product takes a quarter of the time of an [`Interval`]'s,
/// without a branch. A radius that is infinite or NaN means that nothing is known; what compares with it is
/// false.
///
/// Each operation rounds the midpoint to nearest, which is off by at most u |mid| (and by less than TINY if
/// it underflows), u = 2⁻⁵³, and adds that to the radius that exact arithmetic would give. The radius is
/// computed in at most six roundings of non-negative terms, each losing at most the share u, and is then
/// multiplied by 1 + 16 u.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// The midpoint.
    pub mid: f64,
    /// The radius, ≥ 0.
    pub rad: f64,
}

impl Ball {
    /// x alone.
    #[inline(always)]
    pub const fn point(x: f64) -> Self {
        Self { mid: x, rad: 0.0 }
    }

    /// Returns the ball of numbers at most `rad` from zero.
    #[inline(always)]
    pub const fn about_zero(rad: f64) -> Self {
        Self { mid: 0.0, rad }
    }

    /// A ball with this midpoint as computed and a radius from at most four rounded operations on numbers
    /// ≥ 0.
    #[inline(always)]
    fn rounded(mid: f64, rad: f64) -> Self {
        Self { mid, rad: (rad + mid.abs() * UNIT) * ENLARGE + TINY }
    }

    /// An upper bound of |x|.
    #[inline(always)]
    pub fn magnitude(self) -> f64 {
        (self.mid.abs() + self.rad) * ENLARGE
    }

    /// −1, 0 or +1: the sign where it is proved, 0 where it is not.
    #[inline(always)]
    pub fn sign(self) -> i8 {
        i8::from(self.mid > self.rad) - i8::from(-self.mid > self.rad)
    }

    /// Holds t x for all t ∈ [0, 1].
    #[inline(always)]
    pub fn towards_zero(self) -> Self {
        let mid = 0.5 * self.mid;
        Self::rounded(mid, mid.abs() + self.rad)
    }

    /// The narrower one of two that hold the same number.
    #[inline(always)]
    pub fn narrower(self, other: Self) -> Self {
        if other.rad < self.rad { other } else { self }
    }

    /// (sin, cos) without calling either, tight for small angles: for every real z
    /// sin z ∈ z · [1 − z²/6, 1] ⊂ z · [1 − z²/4, 1] and cos z ∈ [1 − z²/2, 1].
    #[inline(always)]
    pub fn small_sin_cos(self) -> (Self, Self) {
        let most = self.magnitude();
        let square = most * most * ENLARGE + TINY;
        let below_one = |depth: f64| Self::rounded(1.0 - 0.5 * depth, 0.5 * depth);
        (self * below_one(0.25 * square), below_one(0.5 * square))
    }
}

impl From<Interval> for Ball {
    #[inline(always)]
    fn from(x: Interval) -> Self {
        if x.lo == x.hi {
            return Self::point(x.lo);
        }
        let mid = x.mid();
        Self::rounded(mid, (x.hi - mid).max(mid - x.lo))
    }
}

impl From<Ball> for Interval {
    fn from(x: Ball) -> Self {
        let around = Self::point(x.mid) + Self::new(-x.rad, x.rad);
        if x.mid.is_finite() { around } else { Self::ENTIRE }
    }
}

impl Scalar for Ball {
    #[inline(always)]
    fn constant(c: Interval) -> Self {
        c.into()
    }
    #[inline(always)]
    fn square(self) -> Self {
        self * self
    }
    fn sqrt(self) -> Self {
        Interval::from(self).sqrt().into()
    }
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = Interval::from(self).sin_cos();
        (sin.into(), cos.into())
    }
    fn clamped(self) -> Self {
        Interval::from(self).clamped().into()
    }
    fn clamped_slope(self) -> Self {
        Interval::from(self).clamped_slope().into()
    }
    fn clamped_square(self) -> Self {
        Interval::from(self).clamped_square().into()
    }
    fn greatest(self, other: Self) -> Self {
        Interval::from(self).greatest(other.into()).into()
    }
    fn choose(self, yes: Self, no: Self) -> Self {
        Interval::from(self).choose(yes.into(), no.into()).into()
    }
    fn nearest<const D: usize>(links: &TwoLinks<Self, D>) -> Nearest<Self> {
        Interval::nearest(&links.map(Interval::from)).map(Self::from)
    }
    fn least_square<const D: usize>(links: &TwoLinks<Self, D>) -> Self {
        Interval::least_square(&links.map(Interval::from)).into()
    }
}

impl Neg for Ball {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { mid: -self.mid, rad: self.rad }
    }
}

impl Add for Ball {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        Self::rounded(self.mid + b.mid, self.rad + b.rad)
    }
}

impl Sub for Ball {
    type Output = Self;
    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        Self::rounded(self.mid - b.mid, self.rad + b.rad)
    }
}

impl Mul for Ball {
    type Output = Self;
    /// |x y − m n| ≤ |m| s + r (|n| + s).
    #[inline(always)]
    fn mul(self, b: Self) -> Self {
        let spread = self.mid.abs() * b.rad + self.rad * (b.mid.abs() + b.rad);
        Self::rounded(self.mid * b.mid, spread)
    }
}

impl Div for Ball {
    type Output = Self;
    fn div(self, b: Self) -> Self {
        (Interval::from(self) / Interval::from(b)).into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::exact::two_sum;
    use proptest::prelude::*;

    /// Whether s + e exactly, |e| far below |s|, lies in `b`, judged with room for nothing but the sign of e.
    fn holds(b: Ball, s: f64, e: f64) -> bool {
        let (gap, rest) = two_sum(s, -b.mid);
        let off = if gap == 0.0 { (rest + e).abs() } else { gap.abs() + (rest + e) * gap.signum() };
        off <= b.rad
    }

    fn ball() -> impl Strategy<Value = (Ball, f64)> {
        (-1e3..1e3f64, 0..16i32, 0.0..1.0f64, -1.0..=1.0f64).prop_map(|(m, scale, r, t)| {
            let b = Ball { mid: m, rad: r * 10f64.powi(-scale) };
            // A point of the ball, its ends included.
            let p = m + t * b.rad;
            (b, if (p - m).abs() <= b.rad { p } else { m })
        })
    }

    proptest! {
        #[test]
        fn operations_hold_all_results((a, x) in ball(), (b, y) in ball()) {
            let (s, e) = two_sum(x, y);
            prop_assert!(holds(a + b, s, e));
            let (d, e) = two_sum(x, -y);
            prop_assert!(holds(a - b, d, e));
            let p = x * y;
            prop_assert!(holds(a * b, p, x.mul_add(y, -p)));
            prop_assert!(holds(a.square(), x * x, x.mul_add(x, -x * x)));
            prop_assert!(a.magnitude() >= x.abs() && (a.sign() == 0 || f64::from(a.sign()) == x.signum()));
            prop_assert!(holds(a.towards_zero(), 0.0, 0.0) && holds(a.towards_zero(), x, 0.0));
            prop_assert!(Interval::from(a).contains(x) && holds(Interval::from(a).into(), x, 0.0));
            let quotient = Interval::from(a / b);
            prop_assert!(quotient == Interval::ENTIRE || quotient.contains(x / y) || b.sign() == 0);
        }

        #[test]
        fn small_angles((a, p) in ball(), scale in 0..9i32) {
            let shrink = 10f64.powi(-scale);
            let (a, x) = (Ball { mid: a.mid * shrink, rad: a.rad * shrink }, p * shrink);
            prop_assume!((x - a.mid).abs() <= a.rad);
            let (sin, cos) = a.small_sin_cos();
            // To an ulp of what is compared with.
            let near = |b: Ball, exact: f64| (exact - b.mid).abs() <= b.rad + f64::EPSILON * exact.abs();
            prop_assert!(near(sin, x.sin()) && near(cos, x.cos()));
        }
    }

    #[test]
    fn nothing_known_is_never_decided() {
        let big = Ball::point(1e300) * Ball::point(1e300);
        assert!(big.sign() == 0 && big.magnitude() == f64::INFINITY);
        let nothing = Ball::from(Interval::ENTIRE);
        assert!(nothing.sign() == 0 && nothing.magnitude() == f64::INFINITY);
        let poison = nothing * Ball::point(0.0) - nothing;
        assert!(poison.sign() == 0 && poison.magnitude().is_nan());
        assert_eq!(Interval::from(poison), Interval::ENTIRE);
        assert_eq!((Ball::point(1.0) / Ball::about_zero(1.0)).sign(), 0);
    }
}
