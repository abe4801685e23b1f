//! Determinants of up to six rows: they are expanded by minors, each of which is computed once.

use super::body::MOST;
use arrayvec::ArrayVec;
use aspecta_robot::num::{Interval, Scalar};
use nalgebra::DMatrix;

/// Sets of columns, as bits.
const SETS: usize = 1 << MOST;

/// Which rows the minors of a matrix are made of.
#[derive(Clone, Copy, PartialEq)]
enum Rows {
    First,
    Last,
}

/// Returns, for each set of columns, the determinant of as many of the first, or of the last, rows on these
/// columns.
fn minors<T: Scalar>(rows: &[[T; MOST]], which: Rows) -> [T; SETS] {
    let mut all = [T::zero(); SETS];
    all[0] = T::constant(Interval::point(1.0));
    for set in 1..1usize << rows.len() {
        let size = set.count_ones() as usize;
        for column in columns(set) {
            // Along the innermost row: signs change from that of its corner on.
            let (row, beside) = match which {
                Rows::First => (size - 1, set >> (column + 1)),
                Rows::Last => (rows.len() - size, below(set, column)),
            };
            let term = signed(beside.count_ones(), rows[row][column] * all[set & !(1 << column)]);
            all[set] = all[set] + term;
        }
    }
    all
}

fn columns(set: usize) -> impl Iterator<Item = usize> {
    (0..MOST).filter(move |column| set >> column & 1 == 1)
}

/// The columns of a set before this one.
fn below(set: usize, column: usize) -> usize {
    set & ((1 << column) - 1)
}

fn signed<T: Scalar>(changes: u32, x: T) -> T {
    if changes.is_multiple_of(2) { x } else { -x }
}

/// The determinant of a square matrix, expanded along its first row; rows are padded to [`MOST`] entries.
pub(super) fn determinant<T: Scalar>(rows: &[[T; MOST]]) -> T {
    minors(rows, Rows::Last)[(1 << rows.len()) - 1]
}

/// The derivatives of [`determinant`] with respect to all entries: the rows above an entry and those below it
/// share the columns beside it out in all ways.
pub(super) fn cofactors<T: Scalar>(rows: &[[T; MOST]]) -> [[T; MOST]; MOST] {
    let (first, last) = (minors(rows, Rows::First), minors(rows, Rows::Last));
    let whole = (1usize << rows.len()) - 1;
    let mut all = [[T::zero(); MOST]; MOST];
    for above in 0..whole {
        let row = above.count_ones() as usize;
        for column in columns(whole & !above) {
            let rest = whole & !above & !(1 << column);
            // How many columns stand before one of those of a row further up.
            let changes = columns(above).map(|c| below(whole & !above, c).count_ones()).sum::<u32>()
                + below(rest, column).count_ones();
            all[row][column] = all[row][column] + signed(changes, first[above] * last[rest]);
        }
    }
    all
}

/// A matrix A as PAR, P and R being constant and PAR nearly diagonal: few of the products in its determinant
/// are large then.
pub(super) struct Turned {
    /// (P, R, det P · det R); `None` if both are one.
    by: Option<(Matrix, Matrix, Interval)>,
}

type Matrix = [[Interval; MOST]; MOST];

impl Turned {
    /// Returns the factors for matrices near one with these rows: P and R are made of its singular vectors.
    /// How they are found does not matter. Up to three rows have so few products that they are left as they
    /// are.
    pub(super) fn near(rows: &[[Interval; MOST]]) -> Self {
        if rows.len() <= 3 { Self { by: None } } else { Self { by: singular_vectors(rows) } }
    }

    /// [`determinant`] by way of det PAR.
    pub(super) fn determinant<T: Scalar>(&self, rows: &[[T; MOST]]) -> T {
        match &self.by {
            None => determinant(rows),
            Some((p, r, det)) => {
                determinant(&sandwich(p, rows, r)[..rows.len()]).scale(Interval::point(1.0) / *det)
            }
        }
    }

    /// det A in one or more ways, all of which hold: of up to three rows along each, because the entries of
    /// that row then count once.
    pub(super) fn expansions<T: Scalar>(&self, rows: &[[T; MOST]]) -> ArrayVec<T, MOST> {
        let along = |j: usize| {
            let mut first: ArrayVec<[T; MOST], MOST> = rows.iter().copied().collect();
            first.swap(0, j);
            signed((j > 0).into(), self.determinant(&first))
        };
        (0..if self.by.is_none() { rows.len() } else { 1 }).map(along).collect()
    }

    /// [`cofactors`] by way of those of PAR: cof PAR = cof P · cof A · cof R, and cof P = det P · P^{-T}.
    pub(super) fn cofactors<T: Scalar>(&self, rows: &[[T; MOST]]) -> [[T; MOST]; MOST] {
        match &self.by {
            None => cofactors(rows),
            Some((p, r, det)) => {
                let turned = cofactors(&sandwich(p, rows, r)[..rows.len()]);
                let factor = Interval::point(1.0) / *det;
                sandwich(&transposed(p), &turned[..rows.len()], &transposed(r))
                    .map(|row| row.map(|x| x.scale(factor)))
            }
        }
    }
}

/// P and R of [`Turned`], unless the arithmetic fails.
fn singular_vectors(rows: &[[Interval; MOST]]) -> Option<(Matrix, Matrix, Interval)> {
    let n = rows.len();
    let svd = DMatrix::from_fn(n, n, |j, i| rows[j][i].mid()).try_svd(true, true, f64::EPSILON, 100)?;
    let (u, v) = (svd.u?.transpose(), svd.v_t?.transpose());
    let of = |m: DMatrix<f64>| -> Matrix {
        std::array::from_fn(|j| {
            std::array::from_fn(|i| Interval::point(m.get((j, i)).copied().unwrap_or(0.0)))
        })
    };
    let (p, r) = (of(u), of(v));
    let det = determinant(&p[..n]) * determinant(&r[..n]);
    (det.sign() != 0).then_some((p, r, det))
}

/// left · rows · right.
fn sandwich<T: Scalar>(left: &Matrix, rows: &[[T; MOST]], right: &Matrix) -> [[T; MOST]; MOST] {
    let n = rows.len();
    let sum = |term: &dyn Fn(usize) -> T| (1..n).fold(term(0), |sum, k| sum + term(k));
    let square = |entry: &dyn Fn(usize, usize) -> T| -> [[T; MOST]; MOST] {
        std::array::from_fn(|j| std::array::from_fn(|i| if j < n && i < n { entry(j, i) } else { T::zero() }))
    };
    let half = square(&|j, i| sum(&|k| rows[j][k].scale(right[k][i])));
    square(&|j, i| sum(&|k| half[k][i].scale(left[j][k])))
}

fn transposed(m: &Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| m[j][i]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use aspecta_robot::num::Random;
    use nalgebra::DMatrix;

    #[test]
    fn of_random_matrices() {
        let mut random = Random::new(3);
        for n in (1..=MOST).cycle().take(60) {
            let rows: Vec<[f64; MOST]> =
                (0..n).map(|_| std::array::from_fn(|_| random.within((-1.0, 1.0)))).collect();
            let matrix = DMatrix::from_fn(n, n, |i, k| rows[i][k]);
            let det = matrix.determinant();
            assert!((determinant(&rows) - det).abs() < 1e-12);
            let expected = matrix.try_inverse().unwrap().transpose() * det;
            let found = cofactors(&rows);
            for (i, k) in (0..n).flat_map(|i| (0..n).map(move |k| (i, k))) {
                assert!((found[i][k] - expected[(i, k)]).abs() < 1e-9, "{n}: {i}, {k}");
            }
            let exact: Vec<[Interval; MOST]> = rows.iter().map(|row| row.map(Interval::point)).collect();
            let turned = Turned::near(&exact);
            assert_eq!(turned.by.is_some(), n > 3);
            // Enclosures of both kinds overlap, as they hold the same numbers.
            let overlap = |a: Interval, b: Interval| a.lo <= b.hi && b.lo <= a.hi && a.width() < 1e-12;
            assert!(overlap(turned.determinant(&exact), determinant(&exact)), "{n}");
            let all = turned.expansions(&exact);
            assert_eq!(all.len(), if n > 3 { 1 } else { n });
            assert!(all.iter().all(|&found| overlap(found, determinant(&exact))), "{n}");
            let (found, expected) = (turned.cofactors(&exact), cofactors(&exact));
            for (i, k) in (0..n).flat_map(|i| (0..n).map(move |k| (i, k))) {
                assert!(overlap(found[i][k], expected[i][k]), "{n}: {i}, {k}");
            }
        }
    }
}
