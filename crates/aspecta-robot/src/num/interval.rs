//! Closed intervals with outward rounding.

use super::trig::{self, Turned};
use super::{Nearest, Scalar, TwoLinks};
use serde::{Deserialize, Serialize};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// φ = 2⁻⁵³(1 + 2⁻⁵²): for every finite x, x − (|x|φ + η) rounded to nearest is a double below or
/// equal to the predecessor of x (Rump, Zimmermann, Boldo, Melquiond, BIT 49, 2009). So a result
/// rounded to nearest and then moved by this much bounds the exact result, whatever the rounding did.
pub(super) const PHI: f64 = f64::EPSILON / 2.0 * (1.0 + f64::EPSILON);
/// η, the smallest positive double.
pub(super) const ETA: f64 = f64::from_bits(1);

/// A double at or below every real number that rounds to `x`. NaN and overflow give −∞.
#[inline(always)]
pub(super) fn down(x: f64) -> f64 {
    (x - (x.abs() * PHI + ETA)).max(f64::NEG_INFINITY)
}

/// A double at or above every real number that rounds to `x`. NaN and overflow give +∞.
#[inline(always)]
pub(super) fn up(x: f64) -> f64 {
    (x + (x.abs() * PHI + ETA)).min(f64::INFINITY)
}

/// The closed interval [lo, hi], lo ≤ hi; bounds may be infinite, never NaN.
///
/// An operation that has no finite answer (a division by an interval around zero, an overflow)
/// returns [−∞, +∞]: *undecided*, never a wrong bound.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Interval {
    /// Lower bound.
    pub lo: f64,
    /// Upper bound.
    pub hi: f64,
}

impl Interval {
    /// All reals.
    pub const ENTIRE: Self = Self { lo: f64::NEG_INFINITY, hi: f64::INFINITY };
    /// π.
    pub const PI: Self = Self { lo: std::f64::consts::PI, hi: 3.141_592_653_589_793_6 };

    /// [x, x].
    #[inline(always)]
    pub const fn point(x: f64) -> Self {
        Self { lo: x, hi: x }
    }

    /// [lo, hi]; NaN bounds give [`Interval::ENTIRE`].
    #[inline(always)]
    pub const fn new(lo: f64, hi: f64) -> Self {
        if lo <= hi { Self { lo, hi } } else { Self::ENTIRE }
    }

    /// The interval that holds the decimal number a file shows as `x`: `x` itself if it is an
    /// integer below 2⁵³ (which every decimal integer of up to 15 digits is), else `x` and both
    /// neighbouring doubles, between which every decimal that rounds to `x` lies.
    pub fn decimal(x: f64) -> Self {
        let exact = x == x.trunc() && x.abs() < 9_007_199_254_740_992.0;
        if exact { Self::point(x) } else { Self::new(x.next_down(), x.next_up()) }
    }

    /// The smallest interval that holds both.
    pub fn hull(self, other: Self) -> Self {
        Self { lo: self.lo.min(other.lo), hi: self.hi.max(other.hi) }
    }

    /// The common part. Two enclosures of one number always meet; should they not (an empty domain),
    /// `self` is kept.
    #[inline(always)]
    pub fn meet(self, other: Self) -> Self {
        let (lo, hi) = (self.lo.max(other.lo), self.hi.min(other.hi));
        if lo <= hi { Self { lo, hi } } else { self }
    }

    /// Midpoint, a double inside (0 for [−∞, ∞]).
    #[inline(always)]
    pub fn mid(self) -> f64 {
        if self.lo == self.hi {
            return self.lo;
        }
        let m = 0.5 * self.lo + 0.5 * self.hi;
        if m.is_nan() { 0.0 } else { m.clamp(self.lo, self.hi) }
    }

    /// An upper bound of hi − lo.
    pub fn width(self) -> f64 {
        up(self.hi - self.lo)
    }

    /// The greatest |x| inside.
    pub fn magnitude(self) -> f64 {
        self.lo.abs().max(self.hi.abs())
    }

    /// Whether `x` lies inside.
    pub fn contains(self, x: f64) -> bool {
        self.lo <= x && x <= self.hi
    }

    /// Whether all of it is > 0: a proof.
    #[inline(always)]
    pub fn is_positive(self) -> bool {
        self.lo > 0.0
    }

    /// Whether all of it is < 0: a proof.
    #[inline(always)]
    pub fn is_negative(self) -> bool {
        self.hi < 0.0
    }

    /// −1, 0 or +1: the sign where it is proved, 0 where it is not.
    pub fn sign(self) -> i8 {
        i8::from(self.is_positive()) - i8::from(self.is_negative())
    }

    /// Encloses sines and cosines from one angle to another: between extrema, which lie at multiples of π/2,
    /// both are monotone.
    #[inline(always)]
    pub(super) fn waves(from: Turned, to: Turned) -> (Self, Self) {
        // Whether (4n + k) π/2 lies there for an integer n.
        let holds = |k: i64| from.ceil + ((k - from.ceil) & 3) <= to.floor;
        // Zero is the only angle there is, as no other double is a multiple of π/2.
        let exact = from.floor == to.ceil;
        let wave = |a: f64, b: f64, peak: i64| {
            let (lo, hi) = (a.min(b), a.max(b));
            let (lo, hi) = if exact { (lo, hi) } else { (down(lo).max(-1.0), up(hi).min(1.0)) };
            Self { lo: if holds(peak + 2) { -1.0 } else { lo }, hi: if holds(peak) { 1.0 } else { hi } }
        };
        (wave(from.sin, to.sin, 1), wave(from.cos, to.cos, 0))
    }

    /// The angle of the vectors (c, s), c ∈ `c`, s ∈ `s`, in radians: an interval of width < 2π that
    /// starts in [−π, π], or `None` if the vector may vanish or its direction may be anything.
    pub fn angle(c: Self, s: Self) -> Option<Self> {
        let corners = [(c.lo, s.lo), (c.lo, s.hi), (c.hi, s.lo), (c.hi, s.hi)];
        if c.contains(0.0) && s.contains(0.0) {
            return None;
        }
        // The box sees the origin from outside: its angles, measured from that of its centre, stay
        // within (−π, π), and the extremes are at corners.
        let centre = trig::atan2(s.mid(), c.mid());
        let mut range: Option<Self> = None;
        for (x, y) in corners {
            let a = trig::atan2(y, x);
            let a = if a - centre > std::f64::consts::PI {
                Self::new(down(a), up(a)) - Self::PI * Self::point(2.0)
            } else if centre - a > std::f64::consts::PI {
                Self::new(down(a), up(a)) + Self::PI * Self::point(2.0)
            } else {
                Self::new(down(a), up(a))
            };
            range = Some(range.map_or(a, |r| r.hull(a)));
        }
        range
    }
}

impl Scalar for Interval {
    #[inline(always)]
    fn constant(c: Interval) -> Self {
        c
    }

    #[inline(always)]
    fn square(self) -> Self {
        let (a, b) = (self.lo * self.lo, self.hi * self.hi);
        let lo = if self.contains(0.0) { 0.0 } else { down(a.min(b)).max(0.0) };
        Self { lo, hi: up(a.max(b)) }
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self { lo: down(self.lo.max(0.0).sqrt()).max(0.0), hi: up(self.hi.max(0.0).sqrt()) }
    }

    fn sin_cos(self) -> (Self, Self) {
        if self.magnitude() >= trig::MOST_ANGLE {
            return (Self::new(-1.0, 1.0), Self::new(-1.0, 1.0));
        }
        let first = trig::sin_cos(self.lo);
        Self::waves(first, if self.lo == self.hi { first } else { trig::sin_cos(self.hi) })
    }

    fn clamped(self) -> Self {
        Self { lo: self.lo.clamp(0.0, 1.0), hi: self.hi.clamp(0.0, 1.0) }
    }

    fn clamped_slope(self) -> Self {
        let within = self.lo >= 0.0 && self.hi <= 1.0;
        let beyond = self.hi < 0.0 || self.lo > 1.0;
        Self { lo: f64::from(u8::from(within)), hi: f64::from(u8::from(!beyond)) }
    }

    /// It grows with its argument.
    fn clamped_square(self) -> Self {
        let at = |t: f64| match Self::point(t) {
            _ if t <= 0.0 => Self::point(0.0),
            t if t.hi <= 1.0 => t.square(),
            t => t + t - Self::point(1.0),
        };
        Self { lo: at(self.lo).lo, hi: at(self.hi).hi }
    }

    fn greatest(self, other: Self) -> Self {
        Self { lo: self.lo.max(other.lo), hi: self.hi.max(other.hi) }
    }

    fn choose(self, yes: Self, no: Self) -> Self {
        match self.sign() {
            1 => yes,
            -1 => no,
            _ => yes.hull(no),
        }
    }

    fn nearest<const D: usize>(links: &TwoLinks<Self, D>) -> Nearest<Self> {
        links.nearest_enclosed()
    }

    fn least_square<const D: usize>(links: &TwoLinks<Self, D>) -> Self {
        links.least_square_enclosed()
    }
}

impl Neg for Interval {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { lo: -self.hi, hi: -self.lo }
    }
}

impl Add for Interval {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        Self { lo: down(self.lo + b.lo), hi: up(self.hi + b.hi) }
    }
}

impl Sub for Interval {
    type Output = Self;
    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        Self { lo: down(self.lo - b.hi), hi: up(self.hi - b.lo) }
    }
}

impl Mul for Interval {
    type Output = Self;
    #[inline(always)]
    fn mul(self, b: Self) -> Self {
        // 0·∞ is 0 here (a bound of a product whose factor is exactly zero); `min` and `max` drop the
        // NaN it makes, and another corner of the same factor zero supplies the 0 …
        let p = [self.lo * b.lo, self.lo * b.hi, self.hi * b.lo, self.hi * b.hi];
        let lo = p[0].min(p[1]).min(p[2].min(p[3]));
        let hi = p[0].max(p[1]).max(p[2].max(p[3]));
        // … or all four are NaN, and `down` and `up` make that [−∞, ∞].
        Self { lo: down(lo), hi: up(hi) }
    }
}

impl Div for Interval {
    type Output = Self;
    fn div(self, b: Self) -> Self {
        if b.contains(0.0) {
            return Self::ENTIRE;
        }
        let p = [self.lo / b.lo, self.lo / b.hi, self.hi / b.lo, self.hi / b.hi];
        let lo = p[0].min(p[1]).min(p[2].min(p[3]));
        let hi = p[0].max(p[1]).max(p[2].max(p[3]));
        Self { lo: down(lo), hi: up(hi) }
    }
}

impl std::fmt::Display for Interval {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "[{}, {}]", self.lo, self.hi)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::exact::two_sum;
    use proptest::prelude::*;

    /// Whether the exact number s + e (|e| far below |s|) lies in `i`.
    fn holds(i: Interval, s: f64, e: f64) -> bool {
        (i.lo < s || (i.lo == s && e >= 0.0)) && (s < i.hi || (s == i.hi && e <= 0.0))
    }

    proptest! {
        #[test]
        fn sums_and_products_hold_the_exact_result(x in -1e6..1e6f64, y in -1e6..1e6f64) {
            let (a, b) = (Interval::point(x), Interval::point(y));
            let (s, e) = two_sum(x, y);
            prop_assert!(holds(a + b, s, e));
            let p = x * y;
            prop_assert!(holds(a * b, p, x.mul_add(y, -p)));
            let q = x / y;
            // x − q·y has the sign of the error of q, times the sign of y.
            prop_assert!(holds(a / b, q, (-q).mul_add(y, x) * y.signum()));
            let r = x.abs().sqrt();
            prop_assert!(holds(Interval::point(x.abs()).sqrt(), r, (-r).mul_add(r, x.abs())));
        }

        #[test]
        fn operations_are_inclusion_monotone(
            x in -9.0..9.0f64, w in 0.0..3.0f64, y in -9.0..9.0f64, v in 0.0..3.0f64,
            s in 0.0..=1.0f64, t in 0.0..=1.0f64,
        ) {
            let (a, b) = (Interval::new(x, x + w), Interval::new(y, y + v));
            let (p, q) = ((x + s * w).min(a.hi), (y + t * v).min(b.hi));
            prop_assert!((a + b).contains(p + q) && (a - b).contains(p - q) && (a * b).contains(p * q));
            prop_assert!((a / b).contains(p / q) && a.square().contains(p * p));
            let (sin, cos) = a.sin_cos();
            prop_assert!(sin.contains(p.sin()) && cos.contains(p.cos()));
            if let Some(angle) = Interval::angle(a, b) {
                let th = q.atan2(p);
                let turn = std::f64::consts::TAU;
                prop_assert!([th - turn, th, th + turn].iter().any(|&t| t > angle.lo - 1e-12 && t < angle.hi + 1e-12));
            }
        }
    }

    #[test]
    fn no_answer_is_everything_and_never_nan() {
        let zero = Interval::new(-1.0, 1.0);
        assert_eq!(Interval::point(1.0) / zero, Interval::ENTIRE);
        let big = Interval::point(1e308) * Interval::point(1e308);
        assert!(big.hi == f64::INFINITY && !big.lo.is_nan());
        let poison = Interval::ENTIRE * Interval::point(0.0) + Interval::ENTIRE;
        assert_eq!(poison, Interval::ENTIRE);
        assert_eq!(Interval::new(f64::NAN, 1.0), Interval::ENTIRE);
    }

    #[test]
    fn sine_reaches_its_extrema() {
        let (s, c) = Interval::new(1.5, 1.6).sin_cos();
        assert_eq!(s.hi, 1.0);
        assert!(c.contains(0.0) && c.width() < 0.11);
        assert_eq!(Interval::new(3.0, 3.2).sin_cos().1.lo, -1.0);
        assert!(Interval::new(-0.1, 0.1).sin_cos().0.hi < 0.1);
    }

    #[test]
    fn a_decimal_lies_in_its_interval() {
        assert_eq!(Interval::decimal(10.0), Interval::point(10.0));
        let tenth = Interval::decimal(0.1);
        assert!(tenth.lo < 0.1 && tenth.hi > 0.1);
    }
}
