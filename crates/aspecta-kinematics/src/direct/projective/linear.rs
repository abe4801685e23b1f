//! Complex linear systems of a few unknowns.

use super::Point;
use nalgebra::Complex;

/// A matrix, factorised by elimination with row pivoting: the rows of U with the multipliers of L to their
/// left, in the order `rows`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Factors<const V: usize> {
    matrix: [Point<V>; V],
    pivots: [usize; V],
    /// 1 / U_kk.
    inverses: [Complex<f64>; V],
}

impl<const V: usize> Factors<V> {
    /// `None` if a pivot is zero or not finite.
    #[inline(always)]
    pub fn of(mut matrix: [Point<V>; V]) -> Option<Self> {
        let mut pivots = [0; V];
        let mut inverses = [Complex::default(); V];
        for k in 0..V {
            let mut best = k;
            let mut most = -1.0;
            for i in k..V {
                let size = matrix[i].re[k].abs() + matrix[i].im[k].abs();
                if size > most {
                    (best, most) = (i, size);
                }
            }
            matrix.swap(k, best);
            pivots[k] = best;
            let pivot = matrix[k].get(k);
            let inverse = pivot.conj() * (1.0 / pivot.norm_sqr());
            if !(inverse.re.is_finite() && inverse.im.is_finite()) || most == 0.0 {
                return None;
            }
            inverses[k] = inverse;
            // Without its multipliers: those of the rows below stay as they are, and all lanes go at once.
            let mut row = matrix[k];
            row.re[..k].fill(0.0);
            row.im[..k].fill(0.0);
            for below in &mut matrix[k + 1..] {
                let factor = below.get(k) * inverse;
                below.add_scaled(-factor, &row);
                (below.re[k], below.im[k]) = (factor.re, factor.im);
            }
        }
        Some(Self { matrix, pivots, inverses })
    }

    /// x with A x = b.
    #[inline(always)]
    pub fn solve(&self, b: &Point<V>) -> Point<V> {
        let mut x = *b;
        for k in 0..V {
            let p = self.pivots[k];
            x.re.swap(k, p);
            x.im.swap(k, p);
        }
        for i in 1..V {
            let mut sum = x.get(i);
            for k in 0..i {
                sum -= self.matrix[i].get(k) * x.get(k);
            }
            (x.re[i], x.im[i]) = (sum.re, sum.im);
        }
        for i in (0..V).rev() {
            let mut sum = x.get(i);
            for k in i + 1..V {
                sum -= self.matrix[i].get(k) * x.get(k);
            }
            let value = sum * self.inverses[i];
            (x.re[i], x.im[i]) = (value.re, value.im);
        }
        x
    }

    /// x with Aᵀ x = b: Uᵀ and Lᵀ in turn, then the exchanges backwards.
    pub fn solve_transposed(&self, b: &Point<V>) -> Point<V> {
        let mut x = *b;
        for i in 0..V {
            let mut sum = x.get(i);
            for k in 0..i {
                sum -= self.matrix[k].get(i) * x.get(k);
            }
            let value = sum * self.inverses[i];
            (x.re[i], x.im[i]) = (value.re, value.im);
        }
        for i in (0..V).rev() {
            let mut sum = x.get(i);
            for k in i + 1..V {
                sum -= self.matrix[k].get(i) * x.get(k);
            }
            (x.re[i], x.im[i]) = (sum.re, sum.im);
        }
        for k in (0..V).rev() {
            let p = self.pivots[k];
            x.re.swap(k, p);
            x.im.swap(k, p);
        }
        x
    }

    /// A⁻¹, by columns.
    pub fn inverse(&self) -> [Point<V>; V] {
        std::array::from_fn(|k| {
            let mut unit = Point::ZERO;
            unit.re[k] = 1.0;
            self.solve(&unit)
        })
    }
}
