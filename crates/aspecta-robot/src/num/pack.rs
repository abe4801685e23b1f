//! Eight intervals at once.

use super::interval::{ETA, PHI};
use super::{Interval, Nearest, Scalar, TwoLinks, trig};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Intervals in a [`Pack`]: the children of an octree cell.
pub const LANES: usize = 8;

/// A yes or no for each lane.
pub type Mask = [bool; LANES];

/// Eight intervals, bounds stored apart so that every operation is eight identical, branch-free
/// lanes which the compiler turns into vector instructions of whatever width the target has.
///
/// Bounds must stay finite: `min` and `max` here are the machine's, which lose a NaN. The paving sees
/// to that (no division by zero, robot dimensions bounded by the robot file's rules).
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub struct Pack {
    /// Lower bounds.
    pub lo: [f64; LANES],
    /// Upper bounds.
    pub hi: [f64; LANES],
}

#[inline(always)]
fn least(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

#[inline(always)]
fn most(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// See [`super::interval`]: the same outward step without its guard against NaN.
#[inline(always)]
fn down(x: f64) -> f64 {
    x - (x.abs() * PHI + ETA)
}

#[inline(always)]
fn up(x: f64) -> f64 {
    x + (x.abs() * PHI + ETA)
}

impl Pack {
    /// The pack whose lane k is `f(k)`.
    #[inline(always)]
    pub fn from_fn(f: impl Fn(usize) -> Interval) -> Self {
        let mut p = Self { lo: [0.0; LANES], hi: [0.0; LANES] };
        for k in 0..LANES {
            let i = f(k);
            p.lo[k] = i.lo;
            p.hi[k] = i.hi;
        }
        p
    }

    /// Lane `k`.
    #[inline(always)]
    pub fn lane(&self, k: usize) -> Interval {
        Interval { lo: self.lo[k], hi: self.hi[k] }
    }

    #[inline(always)]
    fn lanes(f: impl Fn(usize) -> (f64, f64)) -> Self {
        let mut p = Self { lo: [0.0; LANES], hi: [0.0; LANES] };
        for k in 0..LANES {
            (p.lo[k], p.hi[k]) = f(k);
        }
        p
    }

    /// The common part, lane by lane, of two enclosures of the same numbers. A lane comes out empty (lo > hi)
    /// only if there is no number to enclose: a function evaluated where it has no value. Whatever is then
    /// concluded of its values is vacuously true.
    #[inline(always)]
    pub fn meet(self, b: Self) -> Self {
        Self::lanes(|k| (most(self.lo[k], b.lo[k]), least(self.hi[k], b.hi[k])))
    }

    /// Lane by lane, `self` where `mask` holds, else `other`.
    #[inline(always)]
    pub fn select(mask: &Mask, yes: Self, no: Self) -> Self {
        Self::lanes(|k| if mask[k] { (yes.lo[k], yes.hi[k]) } else { (no.lo[k], no.hi[k]) })
    }

    /// Lanes proved > 0.
    #[inline(always)]
    pub fn positive(&self) -> Mask {
        let mut mask = [false; LANES];
        for k in 0..LANES {
            mask[k] = self.lo[k] > 0.0;
        }
        mask
    }

    /// Lanes proved < 0.
    #[inline(always)]
    pub fn negative(&self) -> Mask {
        let mut mask = [false; LANES];
        for k in 0..LANES {
            mask[k] = self.hi[k] < 0.0;
        }
        mask
    }

    /// [−m, m] with m the greatest magnitude, lane by lane.
    #[inline(always)]
    pub fn symmetric(self) -> Self {
        Self::lanes(|k| {
            let m = most(-self.lo[k], self.hi[k]);
            (-m, m)
        })
    }

    /// 1/x for lanes that are > 0; other lanes have no meaning and are masked away by the caller.
    #[inline(always)]
    pub fn positive_reciprocal(self) -> Self {
        Self::lanes(|k| (down(1.0 / self.hi[k]), up(1.0 / self.lo[k])))
    }
}

impl Scalar for Pack {
    #[inline(always)]
    fn constant(c: Interval) -> Self {
        Self { lo: [c.lo; LANES], hi: [c.hi; LANES] }
    }

    #[inline(always)]
    fn square(self) -> Self {
        Self::lanes(|k| {
            let nearest = most(most(self.lo[k], -self.hi[k]), 0.0);
            let farthest = most(-self.lo[k], self.hi[k]);
            (most(down(nearest * nearest), 0.0), up(farthest * farthest))
        })
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self::lanes(|k| (most(down(most(self.lo[k], 0.0).sqrt()), 0.0), up(most(self.hi[k], 0.0).sqrt())))
    }

    fn clamped(self) -> Self {
        Self::from_fn(|k| self.lane(k).clamped())
    }

    fn clamped_slope(self) -> Self {
        Self::from_fn(|k| self.lane(k).clamped_slope())
    }

    fn clamped_square(self) -> Self {
        Self::from_fn(|k| self.lane(k).clamped_square())
    }

    fn greatest(self, other: Self) -> Self {
        Self::lanes(|k| (most(self.lo[k], other.lo[k]), most(self.hi[k], other.hi[k])))
    }

    fn choose(self, yes: Self, no: Self) -> Self {
        Self::from_fn(|k| self.lane(k).choose(yes.lane(k), no.lane(k)))
    }

    fn nearest<const D: usize>(links: &TwoLinks<Self, D>) -> Nearest<Self> {
        let of_lane = |k: usize| Interval::nearest(&links.map(|x| x.lane(k)));
        let all: [Nearest<Interval>; LANES] = std::array::from_fn(of_lane);
        Nearest { first: Self::from_fn(|k| all[k].first), second: Self::from_fn(|k| all[k].second) }
    }

    fn least_square<const D: usize>(links: &TwoLinks<Self, D>) -> Self {
        Self::from_fn(|k| Interval::least_square(&links.map(|x| x.lane(k))))
    }

    fn sin_cos(self) -> (Self, Self) {
        let within = |x: &[f64; LANES]| x.iter().all(|x| x.abs() < trig::MOST_ANGLE);
        if !(within(&self.lo) && within(&self.hi)) {
            let both = std::array::from_fn::<_, LANES, _>(|k| self.lane(k).sin_cos());
            return (Self::from_fn(|k| both[k].0), Self::from_fn(|k| both[k].1));
        }
        let (mut sin, mut cos) = (Self::zero(), Self::zero());
        let mut set = |k: usize, (s, c): (Interval, Interval)| {
            (sin.lo[k], sin.hi[k], cos.lo[k], cos.hi[k]) = (s.lo, s.hi, c.lo, c.hi);
        };
        // Centres are points: half the work.
        if self.lo == self.hi {
            for k in 0..LANES {
                let x = trig::sin_cos(self.lo[k]);
                set(k, Interval::waves(x, x));
            }
        } else {
            for k in 0..LANES {
                set(k, Interval::waves(trig::sin_cos(self.lo[k]), trig::sin_cos(self.hi[k])));
            }
        }
        (sin, cos)
    }

    #[inline(always)]
    fn scale(self, c: Interval) -> Self {
        if c == Interval::point(1.0) {
            self
        } else if c.lo >= 0.0 {
            // The sign is known: half the products of the general case.
            Self::lanes(|k| {
                let (lo, hi) = (self.lo[k], self.hi[k]);
                (down(least(lo * c.lo, lo * c.hi)), up(most(hi * c.lo, hi * c.hi)))
            })
        } else {
            self * Self::constant(c)
        }
    }
}

impl Neg for Pack {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::lanes(|k| (-self.hi[k], -self.lo[k]))
    }
}

impl Add for Pack {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        Self::lanes(|k| (down(self.lo[k] + b.lo[k]), up(self.hi[k] + b.hi[k])))
    }
}

impl Sub for Pack {
    type Output = Self;
    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        Self::lanes(|k| (down(self.lo[k] - b.hi[k]), up(self.hi[k] - b.lo[k])))
    }
}

impl Mul for Pack {
    type Output = Self;
    #[inline(always)]
    fn mul(self, b: Self) -> Self {
        Self::lanes(|k| {
            let p = self.lo[k] * b.lo[k];
            let q = self.lo[k] * b.hi[k];
            let r = self.hi[k] * b.lo[k];
            let s = self.hi[k] * b.hi[k];
            (down(least(least(p, q), least(r, s))), up(most(most(p, q), most(r, s))))
        })
    }
}

impl Div for Pack {
    type Output = Self;
    /// Lane by lane; lanes whose divisor may be zero come out as [`Interval::ENTIRE`] and must be
    /// masked away before anything else is done with them.
    fn div(self, b: Self) -> Self {
        Self::from_fn(|k| self.lane(k) / b.lane(k))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn interval() -> impl Strategy<Value = Interval> {
        (-9.0..9.0f64, 0.0..3.0f64).prop_map(|(x, w)| Interval::new(x, x + w))
    }

    proptest! {
        /// A pack must enclose at least what the single interval does; the two agree bit for bit.
        #[test]
        fn lanes_are_intervals(a in prop::array::uniform8(interval()), b in prop::array::uniform8(interval())) {
            let (p, q) = (Pack::from_fn(|k| a[k]), Pack::from_fn(|k| b[k]));
            for k in 0..LANES {
                prop_assert_eq!((p + q).lane(k), a[k] + b[k]);
                prop_assert_eq!((p - q).lane(k), a[k] - b[k]);
                prop_assert_eq!((p * q).lane(k), a[k] * b[k]);
                prop_assert_eq!(p.square().lane(k), a[k].square());
                prop_assert_eq!(p.sqrt().lane(k), a[k].sqrt());
                prop_assert_eq!(p.scale(b[0]).lane(k), a[k] * b[0]);
                let ((sin, cos), centre) = (p.sin_cos(), Pack::from_fn(|k| Interval::point(a[k].lo)).sin_cos());
                prop_assert_eq!((sin.lane(k), cos.lane(k)), a[k].sin_cos());
                prop_assert_eq!((centre.0.lane(k), centre.1.lane(k)), Interval::point(a[k].lo).sin_cos());
            }
        }
    }
}
