//! Forward-mode derivatives.

use super::{Interval, Nearest, Scalar, TwoLinks, each};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A value and its gradient with respect to `N` variables.
///
/// Over [`Interval`] or [`super::Pack`] the gradient encloses all gradients over the box, which is what the
/// mean-value form needs. A `Jet<Jet<f64, N>, N>` carries the Hessian.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet<T, const N: usize> {
    /// The value.
    pub value: T,
    /// ∂value/∂xₖ.
    pub gradient: [T; N],
}

impl<T: Scalar, const N: usize> Jet<T, N> {
    /// The `k`-th variable, with value `value`.
    pub fn variable(value: T, k: usize) -> Self {
        let mut gradient = [T::zero(); N];
        gradient[k] = T::constant(Interval::point(1.0));
        Self { value, gradient }
    }

    /// A number that does not depend on the variables.
    pub fn fixed(value: T) -> Self {
        Self { value, gradient: [T::zero(); N] }
    }

    /// A function of `self` with the given value and slope: the chain rule.
    pub fn chain(self, value: T, slope: T) -> Self {
        Self { value, gradient: each!(|k| self.gradient[k] * slope) }
    }
}

impl<T: Scalar, const N: usize> Scalar for Jet<T, N> {
    fn constant(c: Interval) -> Self {
        Self::fixed(T::constant(c))
    }
    fn square(self) -> Self {
        self.chain(self.value.square(), self.value + self.value)
    }
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.chain(root, T::constant(Interval::point(0.5)) / root)
    }
    fn sin_cos(self) -> (Self, Self) {
        let (s, c) = self.value.sin_cos();
        (self.chain(s, c), self.chain(c, -s))
    }
    fn clamped(self) -> Self {
        self.chain(self.value.clamped(), self.value.clamped_slope())
    }
    fn clamped_slope(self) -> Self {
        Self::fixed(self.value.clamped_slope())
    }
    fn clamped_square(self) -> Self {
        let c = self.value.clamped();
        self.chain(self.value.clamped_square(), c + c)
    }
    fn greatest(self, other: Self) -> Self {
        let first = self.value - other.value;
        Self {
            value: self.value.greatest(other.value),
            gradient: each!(|k| first.choose(self.gradient[k], other.gradient[k])),
        }
    }
    fn choose(self, yes: Self, no: Self) -> Self {
        Self {
            value: self.value.choose(yes.value, no.value),
            gradient: each!(|k| self.value.choose(yes.gradient[k], no.gradient[k])),
        }
    }
    /// They jump, and have no derivatives.
    fn nearest<const D: usize>(links: &TwoLinks<Self, D>) -> Nearest<Self> {
        T::nearest(&links.map(|x| x.value)).map(Self::fixed)
    }
    /// The derivative of a least value is that with the nearest points held (Danskin).
    fn least_square<const D: usize>(links: &TwoLinks<Self, D>) -> Self {
        let values = links.map(|x| x.value);
        let nearest = T::nearest(&values);
        let between = values.between(&nearest);
        let along = |k: usize| {
            let moved = links.map(|x| x.gradient[k]).between(&nearest);
            let half = (1..D).fold(between[0] * moved[0], |sum, i| sum + between[i] * moved[i]);
            half + half
        };
        Self { value: T::least_square(&values), gradient: each!(|k| along(k)) }
    }
    fn tightened(self) -> Self {
        Self { value: self.value.tightened(), gradient: each!(|k| self.gradient[k].tightened()) }
    }
    fn scale(self, c: Interval) -> Self {
        Self { value: self.value.scale(c), gradient: each!(|k| self.gradient[k].scale(c)) }
    }
}

impl<T: Scalar, const N: usize> Neg for Jet<T, N> {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, gradient: each!(|k| -self.gradient[k]) }
    }
}

impl<T: Scalar, const N: usize> Add for Jet<T, N> {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        Self { value: self.value + b.value, gradient: each!(|k| self.gradient[k] + b.gradient[k]) }
    }
}

impl<T: Scalar, const N: usize> Sub for Jet<T, N> {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        Self { value: self.value - b.value, gradient: each!(|k| self.gradient[k] - b.gradient[k]) }
    }
}

impl<T: Scalar, const N: usize> Mul for Jet<T, N> {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        Self {
            value: self.value * b.value,
            gradient: each!(|k| self.gradient[k] * b.value + self.value * b.gradient[k]),
        }
    }
}

impl<T: Scalar, const N: usize> Div for Jet<T, N> {
    type Output = Self;
    fn div(self, b: Self) -> Self {
        let value = self.value / b.value;
        Self { value, gradient: each!(|k| (self.gradient[k] - value * b.gradient[k]) / b.value) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn formula<T: Scalar>(x: T, y: T) -> T {
        let (s, c) = (x * y).sin_cos();
        (x.square() + y * s).sqrt() / (c + T::constant(Interval::point(3.0))) - x * c
    }

    proptest! {
        #[test]
        fn the_gradient_is_that_of_finite_differences(x in 2.0..4.0f64, y in -1.0..1.0f64) {
            let j = formula(Jet::<f64, 2>::variable(x, 0), Jet::variable(y, 1));
            let h = 1e-6;
            let dx = (formula(x + h, y) - formula(x - h, y)) / (2.0 * h);
            let dy = (formula(x, y + h) - formula(x, y - h)) / (2.0 * h);
            prop_assert!((j.gradient[0] - dx).abs() < 1e-7 && (j.gradient[1] - dy).abs() < 1e-7);
        }
    }
}
