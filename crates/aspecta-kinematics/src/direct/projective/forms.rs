//! Systems of quadratic forms, and a segment of such systems.

use super::Point;
use nalgebra::Complex;

/// F quadratic forms xᵀ Q x in V variables: the matrices Q, symmetric, by columns.
#[derive(Clone, Debug)]
pub(crate) struct Quadrics<const V: usize, const F: usize> {
    pub forms: [[Point<V>; V]; F],
}

/// The forms at a point: their values and half their gradients.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Values<const V: usize, const F: usize> {
    pub values: [Complex<f64>; F],
    /// Q x.
    pub halves: [Point<V>; F],
}

impl<const V: usize, const F: usize> Quadrics<V, F> {
    pub const ZERO: Self = Self { forms: [[Point::ZERO; V]; F] };

    #[inline(always)]
    pub(crate) fn at(&self, x: &Point<V>) -> Values<V, F> {
        let mut at = Values { values: [Complex::default(); F], halves: [Point::ZERO; F] };
        for k in 0..F {
            let mut half = Point::ZERO;
            for (b, column) in self.forms[k].iter().enumerate() {
                half.add_scaled(x.get(b), column);
            }
            at.values[k] = half.dot(x);
            at.halves[k] = half;
        }
        at
    }
}

/// The systems (1 − t) start + t target, t ∈ [0, 1]. Where both belong to a linear family whose members have
/// the same number of common points but for an algebraic subset, and the start is generic, so have all of t <
/// 1: the subset has complex codimension one and misses almost every segment of real dimension one.
pub(crate) struct Family<'a, const V: usize, const F: usize> {
    pub start: &'a Quadrics<V, F>,
    pub target: &'a Quadrics<V, F>,
}

impl<const V: usize, const F: usize> Family<'_, V, F> {
    /// The system at t, into `system`.
    #[inline(always)]
    pub(super) fn mix(&self, t: f64, system: &mut Quadrics<V, F>) {
        let s = 1.0 - t;
        for k in 0..F {
            for b in 0..V {
                let (from, to, mixed) =
                    (&self.start.forms[k][b], &self.target.forms[k][b], &mut system.forms[k][b]);
                for a in 0..V {
                    mixed.re[a] = s * from.re[a] + t * to.re[a];
                    mixed.im[a] = s * from.im[a] + t * to.im[a];
                }
            }
        }
    }

    /// target − start at a common point x of the system at t. There start and target are multiples of one
    /// another, so either will do: the one with the greater weight.
    #[inline(always)]
    pub(super) fn change(&self, t: f64, x: &Point<V>) -> [Complex<f64>; F] {
        let (system, factor) = if t < 0.5 { (self.target, 1.0 / (1.0 - t)) } else { (self.start, -1.0 / t) };
        system.at(x).values.map(|v| v * factor)
    }
}
