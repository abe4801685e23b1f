//! Minors of the rows of a matrix, shared by all that is made of them: determinants, cofactors, working
//! modes.
//!
//! Nothing is divided, so all of it holds for enclosures.

use arrayvec::ArrayVec;
use aspecta_robot::num::{Interval, Scalar};

/// Sets of up to 6 columns, one bit each.
const SETS: usize = 64;

/// The minors of the first rows of an N × N matrix, by sets of columns: those sets count that have as many
/// columns as there are rows.
#[derive(Clone)]
pub struct Minors<T, const N: usize> {
    rows: usize,
    of: [T; SETS],
}

impl<T: Scalar, const N: usize> Minors<T, N> {
    /// Returns the minors of no rows: the empty one is 1.
    pub fn none() -> Self {
        const { assert!(N <= 6, "sets of columns have up to 6 bits") }
        let mut of = [T::zero(); SETS];
        of[0] = T::constant(Interval::point(1.0));
        Self { rows: 0, of }
    }

    /// Returns the minors with one row more, below the others, by expansion along it.
    pub fn with(&self, row: &[T; N]) -> Self {
        let mut next = Self { rows: self.rows + 1, of: [T::zero(); SETS] };
        for set in next.sets() {
            next.of[set] = if self.rows == 0 {
                row[set.trailing_zeros() as usize]
            } else {
                let mut sum: Option<T> = None;
                for (place, k) in (0..N).filter(|k| set >> k & 1 == 1).enumerate() {
                    let term = row[k] * self.of[set & !(1 << k)];
                    let plus = (self.rows + place).is_multiple_of(2);
                    sum = Some(match sum {
                        Some(sum) if plus => sum + term,
                        Some(sum) => sum - term,
                        None if plus => term,
                        None => -term,
                    });
                }
                sum.unwrap_or_else(T::zero).tightened()
            };
        }
        next
    }

    /// The determinant, once there are N rows.
    pub fn determinant(&self) -> T {
        self.of[(1 << N) - 1]
    }

    fn sets(&self) -> impl Iterator<Item = usize> + use<T, N> {
        let rows = self.rows;
        (0..1usize << N).filter(move |set| set.count_ones() as usize == rows)
    }
}

/// The determinant.
pub fn determinant<T: Scalar, const N: usize>(m: &[[T; N]; N]) -> T {
    m.iter().fold(Minors::none(), |minors, row| minors.with(row)).determinant()
}

/// The cofactors: entry (j, i) is the derivative of the determinant with respect to `m[j][i]`.
///
/// Returns the cofactors by Laplace's expansion: the minors of the rows above row j with those of the rows
/// below it, over all ways to share the other columns.
pub fn cofactors<T: Scalar, const N: usize>(m: &[[T; N]; N]) -> [[T; N]; N] {
    let mut below = ArrayVec::<Minors<T, N>, N>::new();
    below.push(Minors::none());
    // Rows from the last up: their minors are those of the rows in order but for the sign of the reversal.
    for row in m.iter().skip(1).rev() {
        below.push(below[below.len() - 1].with(row));
    }
    let mut all = [[T::zero(); N]; N];
    let mut above = Minors::none();
    for j in 0..N {
        let rest = &below[N - 1 - j];
        for i in 0..N {
            all[j][i] = laplace(&above, rest, i);
        }
        above = above.with(&m[j]);
    }
    all
}

/// The cofactor of column i of the row between those `above` and, in reverse order, those `below`.
fn laplace<T: Scalar, const N: usize>(above: &Minors<T, N>, below: &Minors<T, N>, i: usize) -> T {
    let all = (1usize << N) - 1;
    let reversal = below.rows * below.rows.saturating_sub(1) / 2;
    let mut sum: Option<T> = None;
    for set in above.sets().filter(|set| set >> i & 1 == 0) {
        let other = all & !set & !(1 << i);
        // How often a column comes after a later one, the rows taken in order: set, i, other.
        let after = |columns: usize, k: usize| (columns >> (k + 1)).count_ones() as usize;
        let inversions = after(set, i)
            + (0..N).filter(|k| other >> k & 1 == 1).map(|k| after(set | 1 << i, k)).sum::<usize>()
            + reversal;
        let term = match (above.rows, below.rows) {
            (0, _) => below.of[other],
            (_, 0) => above.of[set],
            _ => above.of[set] * below.of[other],
        };
        let plus = inversions.is_multiple_of(2);
        sum = Some(match sum {
            Some(sum) if plus => sum + term,
            Some(sum) => sum - term,
            None if plus => term,
            None => -term,
        });
    }
    sum.unwrap_or_else(T::zero)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check<const N: usize>(seed: u32) {
        let entry = |j: usize, i: usize| {
            let mixed = (seed as usize + 37 * j + 101 * i) as f64;
            (mixed * 0.754_877_666).fract() - 0.5
        };
        let rows: [[f64; N]; N] = std::array::from_fn(|j| std::array::from_fn(|i| entry(j, i)));
        let whole = nalgebra::DMatrix::from_fn(N, N, |j, i| rows[j][i]);
        assert!((determinant(&rows) - whole.determinant()).abs() < 1e-13);
        let found = cofactors(&rows);
        for j in 0..N {
            for i in 0..N {
                let sign = if (i + j).is_multiple_of(2) { 1.0 } else { -1.0 };
                let exact = sign * whole.clone().remove_row(j).remove_column(i).determinant();
                assert!((found[j][i] - exact).abs() < 1e-13, "{N}: {j} {i}: {} {exact}", found[j][i]);
            }
        }
    }

    #[test]
    fn minors_are_those_of_elimination() {
        for seed in 0..20 {
            check::<4>(seed);
            check::<5>(seed);
            check::<6>(seed);
        }
        assert_eq!(determinant(&[[3.0, 4.0], [5.0, 6.0]]), -2.0);
    }

    /// The derivative of an enclosure's determinant holds those of all its matrices.
    #[test]
    fn cofactors_of_enclosures_hold_those_of_their_matrices() {
        let middle = |j: usize, i: usize| ((37 * j + 101 * i) as f64 * 0.754_877_666).fract() - 0.5;
        let wide: [[Interval; 6]; 6] = std::array::from_fn(|j| {
            std::array::from_fn(|i| Interval::new(middle(j, i) - 1e-3, middle(j, i) + 1e-3))
        });
        let all = cofactors(&wide);
        for corner in 0..64u32 {
            let at = |j: usize, i: usize| {
                let up = (corner >> ((5 * j + i) % 6)) & 1 == 1;
                if up { wide[j][i].hi } else { wide[j][i].lo }
            };
            let one: [[f64; 6]; 6] = std::array::from_fn(|j| std::array::from_fn(|i| at(j, i)));
            let exact = cofactors(&one);
            assert!((0..6).all(|j| {
                (0..6).all(|i| all[j][i].lo <= exact[j][i] + 1e-14 && exact[j][i] - 1e-14 <= all[j][i].hi)
            }));
        }
    }
}
