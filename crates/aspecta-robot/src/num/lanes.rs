//! Eight doubles at once.

use super::interval::{ETA, PHI};
use super::{LANES, Mask};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A double in each lane, rounded to nearest: what enclosures over eight boxes are computed with.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(super) struct Lanes(pub [f64; LANES]);

/// More than some thirty roundings to nearest add, relatively.
pub(super) const ROUNDING: f64 = 64.0 * PHI;

impl Lanes {
    pub(super) const ZERO: Self = Self::of(0.0);

    #[inline(always)]
    pub(super) const fn of(x: f64) -> Self {
        Self([x; LANES])
    }

    #[inline(always)]
    fn each(f: impl Fn(usize) -> f64) -> Self {
        let mut lanes = Self::ZERO;
        for l in 0..LANES {
            lanes.0[l] = f(l);
        }
        lanes
    }

    #[inline(always)]
    pub(super) fn abs(self) -> Self {
        Self::each(|l| self.0[l].abs())
    }

    #[inline(always)]
    pub(super) fn sqrt(self) -> Self {
        Self::each(|l| self.0[l].sqrt())
    }

    /// The greater of two numbers, the second where one is none.
    #[inline(always)]
    pub(super) fn greatest(self, b: Self) -> Self {
        Self::each(|l| if self.0[l] > b.0[l] { self.0[l] } else { b.0[l] })
    }

    /// The smaller of two numbers, the second where one is none.
    #[inline(always)]
    pub(super) fn least(self, b: Self) -> Self {
        Self::each(|l| if self.0[l] < b.0[l] { self.0[l] } else { b.0[l] })
    }

    /// Lane by lane, `yes` where the mask holds, else `no`.
    #[inline(always)]
    pub(super) fn select(mask: &Mask, yes: Self, no: Self) -> Self {
        Self::each(|l| if mask[l] { yes.0[l] } else { no.0[l] })
    }

    /// A number above every sum of up to thirty numbers ≥ 0 that rounds to this one.
    #[inline(always)]
    pub(super) fn above(self) -> Self {
        self * Self::of(1.0 + ROUNDING)
    }

    /// A number at or below every real number that rounds to this one; −∞ if it is none.
    #[inline(always)]
    pub(super) fn down(self) -> Self {
        Self::each(|l| {
            let x = self.0[l] - (self.0[l].abs() * PHI + ETA);
            if x.is_nan() { f64::NEG_INFINITY } else { x }
        })
    }

    /// A number at or above every real number that rounds to this one; ∞ if it is none.
    #[inline(always)]
    pub(super) fn up(self) -> Self {
        -(-self).down()
    }
}

macro_rules! operator {
    ($operator:ident, $name:ident, $sign:tt) => {
        impl $operator for Lanes {
            type Output = Self;
            #[inline(always)]
            fn $name(self, b: Self) -> Self {
                Self::each(|l| self.0[l] $sign b.0[l])
            }
        }
    };
}
operator!(Add, add, +);
operator!(Sub, sub, -);
operator!(Mul, mul, *);
operator!(Div, div, /);

impl Neg for Lanes {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::each(|l| -self.0[l])
    }
}
