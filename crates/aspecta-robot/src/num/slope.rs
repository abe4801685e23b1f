//! Slopes: enclosures of difference quotients about a centre.

use super::{Ball, Interval, Nearest, Pack, Scalar, TwoLinks, each, kernel::kernel};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// An enclosing scalar on which slopes can be built.
pub trait Enclosure: Scalar {
    /// The common part of two enclosures of the same numbers.
    fn meet(self, other: Self) -> Self;

    /// [−m, m] with m the greatest magnitude in `self`.
    fn symmetric(self) -> Self;

    /// For f with f(x) ∈ `range`, f(c) ∈ `centre`: enclosures (r, k) such that √f(x) − r ∋ k (f(x) − f(c))
    /// for all x with f(x) ≥ 0, with r ∋ √f(c) and k ∋ 1/(√f(x) + √f(c)) where f(c) > 0 is proved, else r ∋
    /// √f(x), k = 0.
    fn root_slope(range: Self, centre: Self) -> (Self, Self);
}

impl Enclosure for Interval {
    fn meet(self, other: Self) -> Self {
        Interval::meet(self, other)
    }
    fn symmetric(self) -> Self {
        Self { lo: -self.magnitude(), hi: self.magnitude() }
    }
    fn root_slope(range: Self, centre: Self) -> (Self, Self) {
        if centre.is_positive() {
            let root = centre.sqrt();
            (root, Self::point(1.0) / (range.sqrt() + root))
        } else {
            (range.sqrt(), Self::point(0.0))
        }
    }
}

impl Enclosure for Pack {
    #[inline(always)]
    fn meet(self, other: Self) -> Self {
        Pack::meet(self, other)
    }
    #[inline(always)]
    fn symmetric(self) -> Self {
        Pack::symmetric(self)
    }
    #[inline(always)]
    fn root_slope(range: Self, centre: Self) -> (Self, Self) {
        let known = centre.positive();
        let (over, at) = (range.sqrt(), centre.sqrt());
        (
            Pack::select(&known, at, over),
            Pack::select(&known, (over + at).positive_reciprocal(), Pack::zero()),
        )
    }
}

impl Enclosure for Ball {
    #[inline(always)]
    fn meet(self, other: Self) -> Self {
        self.narrower(other)
    }
    #[inline(always)]
    fn symmetric(self) -> Self {
        Ball::about_zero(self.magnitude())
    }
    fn root_slope(range: Self, centre: Self) -> (Self, Self) {
        let (root, quotient) = Interval::root_slope(range.into(), centre.into());
        (root.into(), quotient.into())
    }
}

/// A function f over a box c + r∘t, t ∈ [−1, 1]^N: its range, its value at the centre c, and slopes s with
///
/// > f(c + r∘t) ∈ f(c) + Σ sₖ tₖ.
///
/// Sums and products are calls on references, not inlined: over packs each is several hundred instructions,
/// and a kernel made of hundreds of them would neither fit the instruction cache nor compile in reasonable
/// time.
///
/// The rules are those of Krawczyk and Neumaier (1985). For the same cost as a gradient over the box, a slope
/// is about half as wide, so the centred form is twice as tight; and the slope of √f is bounded where f
/// reaches zero inside the box, where the derivative is not.
#[derive(Clone, Copy, Debug)]
pub struct Slope<T, const N: usize> {
    /// Encloses f over the box.
    pub range: T,
    /// Encloses f(c), or whatever the slopes start from.
    pub centre: T,
    /// Slopes with respect to t.
    pub slope: [T; N],
}

impl<T: Enclosure, const N: usize> Slope<T, N> {
    /// The `k`-th coordinate, centre + radius·t.
    pub fn variable(range: T, centre: T, radius: T, k: usize) -> Self {
        let mut slope = [T::zero(); N];
        slope[k] = radius;
        Self { range, centre, slope }
    }

    /// The product with a number that does not depend on the point of the box.
    #[inline(always)]
    pub fn times(self, c: T) -> Self {
        let f = &self;
        let c = &c;
        kernel!({T: Enclosure, const N: usize} (f: &Slope<T, N>, c: &T) -> Slope<T, N> {
            Slope { range: f.range * *c, centre: f.centre * *c, slope: each!(|k| f.slope[k] * *c) }
        })
    }

    /// A function of `self`, with its range, its value at the centre, and an enclosure of
    /// (φ(f(x)) − φ(f(c))) / (f(x) − f(c)).
    #[inline(never)]
    pub fn chain(self, range: T, centre: T, quotient: T) -> Self {
        Self { range, centre, slope: each!(|k| self.slope[k] * quotient) }
    }
}

impl<T: Enclosure, const N: usize> Scalar for Slope<T, N> {
    fn constant(c: Interval) -> Self {
        let value = T::constant(c);
        Self { range: value, centre: value, slope: [T::zero(); N] }
    }

    #[inline(always)]
    fn square(self) -> Self {
        let f = &self;
        kernel!({T: Enclosure, const N: usize} (f: &Slope<T, N>) -> Slope<T, N> {
            let quotient = f.range + f.centre;
            Slope { range: f.range.square(), centre: f.centre.square(), slope: each!(|k| f.slope[k] * quotient) }
        })
    }

    /// Holds for the x with f(x) ≥ 0.
    #[inline(never)]
    fn sqrt(self) -> Self {
        let f = self.tightened();
        let (centre, quotient) = T::root_slope(f.range, f.centre);
        f.chain(f.range.sqrt(), centre, quotient)
    }

    fn sin_cos(self) -> (Self, Self) {
        // By the mean-value theorem the quotients lie in the range of the derivative.
        let (sin, cos) = self.range.sin_cos();
        let (sin_c, cos_c) = self.centre.sin_cos();
        (self.chain(sin, sin_c, cos), self.chain(cos, cos_c, -sin))
    }

    fn clamped(self) -> Self {
        self.chain(self.range.clamped(), self.centre.clamped(), self.range.clamped_slope())
    }

    /// It jumps, and has no slopes: what it starts from is as wide as its range.
    fn clamped_slope(self) -> Self {
        let range = self.range.clamped_slope();
        Self { range, centre: range, slope: [T::zero(); N] }
    }

    fn clamped_square(self) -> Self {
        let f = self.tightened();
        let c = f.range.clamped();
        f.chain(f.range.clamped_square(), f.centre.clamped_square(), c + c)
    }

    /// Where either may be the greater, the difference quotient lies between those of both: if f(c) ≥ g(c) and g(x) ≥ f(x), then
    /// f(x) − f(c) ≤ g(x) − f(c) ≤ g(x) − g(c).
    fn greatest(self, other: Self) -> Self {
        let (f, g) = (self.tightened(), other.tightened());
        let first = f.range - g.range;
        Self {
            range: f.range.greatest(g.range),
            centre: f.centre.greatest(g.centre),
            slope: each!(|k| first.choose(f.slope[k], g.slope[k])),
        }
    }

    /// It jumps, and has no slopes: what it starts from is as wide as its range.
    fn choose(self, yes: Self, no: Self) -> Self {
        let range = self.tightened().range.choose(yes.tightened().range, no.tightened().range);
        Self { range, centre: range, slope: [T::zero(); N] }
    }

    /// They jump too.
    fn nearest<const D: usize>(links: &TwoLinks<Self, D>) -> Nearest<Self> {
        let still = |range: T| Self { range, centre: range, slope: [T::zero(); N] };
        T::nearest(&links.map(|x| x.tightened().range)).map(still)
    }

    /// With φ(x; u, v) = ‖gap + u first − v second‖² and (u, v), (u′, v′) the nearest points at x and at the centre c,
    /// φ(x; u, v) − φ(c; u, v) ≤ F(x) − F(c) ≤ φ(x; u′, v′) − φ(c; u′, v′): a difference quotient of φ with some nearest points held.
    fn least_square<const D: usize>(links: &TwoLinks<Self, D>) -> Self {
        let (over, at_centre) = (links.map(|x| x.tightened().range), links.map(|x| x.centre));
        let nearest = T::nearest(&over);
        let (here, there) = (over.between(&nearest), at_centre.between(&nearest));
        let along = |k: usize| {
            let moved = links.map(|x| x.slope[k]).between(&nearest);
            let term = |i: usize| moved[i] * (here[i] + there[i]);
            (1..D).fold(term(0), |sum, i| sum + term(i))
        };
        Self {
            range: T::least_square(&over),
            centre: T::least_square(&at_centre),
            slope: each!(|k| along(k)),
        }
    }

    #[inline(always)]
    fn scale(self, c: Interval) -> Self {
        if c == Interval::point(1.0) {
            return self;
        }
        let f = &self;
        let c = &c;
        kernel!({T: Scalar, const N: usize} (f: &Slope<T, N>, c: &Interval) -> Slope<T, N> {
            Slope { range: f.range.scale(*c), centre: f.centre.scale(*c), slope: each!(|k| f.slope[k].scale(*c)) }
        })
    }

    /// The range cut by the centred form.
    #[inline(always)]
    fn tightened(self) -> Self {
        let f = &self;
        kernel!({T: Enclosure, const N: usize} (f: &Slope<T, N>) -> Slope<T, N> {
            let mut spread = f.slope[0].symmetric();
            for k in 1..N {
                spread = spread + f.slope[k].symmetric();
            }
            Slope { range: f.range.meet(f.centre + spread), ..*f }
        })
    }
}

impl<T: Scalar, const N: usize> Neg for Slope<T, N> {
    type Output = Self;
    #[inline(never)]
    fn neg(self) -> Self {
        Self { range: -self.range, centre: -self.centre, slope: each!(|k| -self.slope[k]) }
    }
}

impl<T: Scalar, const N: usize> Add for Slope<T, N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        let a = &self;
        let b = &b;
        kernel!({T: Scalar, const N: usize} (a: &Slope<T, N>, b: &Slope<T, N>) -> Slope<T, N> {
            Slope {
                range: a.range + b.range,
                centre: a.centre + b.centre,
                slope: each!(|k| a.slope[k] + b.slope[k]),
            }
        })
    }
}

impl<T: Scalar, const N: usize> Sub for Slope<T, N> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        let a = &self;
        let b = &b;
        kernel!({T: Scalar, const N: usize} (a: &Slope<T, N>, b: &Slope<T, N>) -> Slope<T, N> {
            Slope {
                range: a.range - b.range,
                centre: a.centre - b.centre,
                slope: each!(|k| a.slope[k] - b.slope[k]),
            }
        })
    }
}

impl<T: Scalar, const N: usize> Mul for Slope<T, N> {
    type Output = Self;
    /// f(x)g(x) − f(c)g(c) = (f(x) − f(c)) g(c) + f(x) (g(x) − g(c)).
    #[inline(always)]
    fn mul(self, b: Self) -> Self {
        let a = &self;
        let b = &b;
        kernel!({T: Scalar, const N: usize} (a: &Slope<T, N>, b: &Slope<T, N>) -> Slope<T, N> {
            Slope {
                range: a.range * b.range,
                centre: a.centre * b.centre,
                slope: each!(|k| a.slope[k] * b.centre + a.range * b.slope[k]),
            }
        })
    }
}

impl<T: Scalar, const N: usize> Div for Slope<T, N> {
    type Output = Self;
    /// (f/g)(x) − (f/g)(c) = ((f(x) − f(c)) − (f/g)(c) (g(x) − g(c))) / g(x).
    #[inline(never)]
    fn div(self, b: Self) -> Self {
        let centre = self.centre / b.centre;
        Self {
            range: self.range / b.range,
            centre,
            slope: each!(|k| (self.slope[k] - centre * b.slope[k]) / b.range),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    type S = Slope<Interval, 2>;

    fn formula<T: Scalar>(x: T, y: T) -> T {
        let (s, c) = (x * y).sin_cos();
        (x.square() - y * s).sqrt() / (c + T::constant(Interval::point(3.0))) - x * c
    }

    fn over(x: f64, r: f64, k: usize) -> S {
        let range = Interval::new(x - r * 1.0000001, x + r * 1.0000001);
        S::variable(range, Interval::point(x), Interval::point(r), k)
    }

    proptest! {
        #[test]
        fn the_centred_form_encloses(
            x in 0.3..3.0f64, y in -1.0..1.0f64, r in 0.0..0.8f64, s in -1.0..=1.0f64, t in -1.0..=1.0f64,
        ) {
            let f = formula(over(x, r, 0), over(y, r, 1));
            let exact = formula(x + r * s, y + r * t);
            // Where the square root's argument is negative the formula has no value.
            prop_assume!((x + r * s).powi(2) - (y + r * t) * ((x + r * s) * (y + r * t)).sin() >= 0.0);
            let linear = f.centre + f.slope[0] * Interval::point(s) + f.slope[1] * Interval::point(t);
            let slack = 1e-11 * (1.0 + exact.abs());
            prop_assert!(linear.lo - slack <= exact && exact <= linear.hi + slack);
            prop_assert!(f.tightened().range.lo - slack <= exact && exact <= f.tightened().range.hi + slack);
        }
    }

    /// About a centre, x² has slope 2c + r t: half as wide as its derivative.
    #[test]
    fn slopes_are_narrower_than_derivatives() {
        let f = over(1.0, 0.5, 0).square();
        assert!(f.slope[0].width() < 0.5 * 0.5 * 2.0 * 1.01);
    }
}
