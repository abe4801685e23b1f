//! Determinants over boxes, conditioned: A Z instead of A, where Z makes A lower triangular at the boxes'
//! middles.
//!
//! The minors of a 6 × 6 matrix cancel: products of the entries' ranges are much wider than the
//! determinant's. With A = L U at the middle, by elimination with complete pivoting, and Z = U⁻¹ in doubles,
//! A Z is nearly L, whose expansion has one large term. Whatever Z is,
//!
//! > det A · det Z = det(A Z),
//!
//! and Z is a permutation of columns times a triangular matrix exactly, so det Z is the product of its
//! diagonal, up to the sign of the permutation. Complete pivoting leaves what nearly vanishes to the last
//! column of Z, the only one that is large.

use aspecta_robot::num::{Affine, Interval, LANES, Pack, Scalar, each};

/// Z for each of eight boxes.
pub struct Conditioner<const N: usize> {
    z: [[Pack; N]; N],
    /// det Z, which is not zero.
    pub det: Pack,
}

impl<const N: usize> Conditioner<N> {
    /// For matrices over eight boxes. Where one is singular at the middle Z is the identity.
    pub fn new<const M: usize>(rows: &[[Affine<M>; N]; N]) -> Self {
        let lanes: [([[f64; N]; N], Interval); LANES] = std::array::from_fn(|l| {
            triangular(std::array::from_fn(|j| std::array::from_fn(|k| rows[j][k].lane(l).0)))
                .unwrap_or_else(|| (identity(), Interval::point(1.0)))
        });
        let entry = |i: usize, k: usize| Pack::from_fn(|l| Interval::point(lanes[l].0[i][k]));
        Self {
            z: std::array::from_fn(|i| std::array::from_fn(|k| entry(i, k))),
            det: Pack::from_fn(|l| lanes[l].1),
        }
    }

    /// A row of A Z, given that of A.
    pub fn row<const M: usize>(&self, row: &[Affine<M>; N]) -> [Affine<M>; N] {
        each!(|k| {
            let mut sum = row[0].times(&self.z[0][k]);
            for i in 1..N {
                sum = sum + row[i].times(&self.z[i][k]);
            }
            sum.tightened()
        })
    }
}

fn identity<const N: usize>() -> [[f64; N]; N] {
    std::array::from_fn(|i| std::array::from_fn(|k| f64::from(u8::from(i == k))))
}

/// Z and det Z for the matrix `a`; `None` if it is singular in doubles.
fn triangular<const N: usize>(mut a: [[f64; N]; N]) -> Option<([[f64; N]; N], Interval)> {
    let mut z = identity::<N>();
    let mut det = Interval::point(1.0);
    for k in 0..N {
        let places = (k..N).flat_map(|i| (k..N).map(move |j| (i, j)));
        let (row, column) = places.max_by(|&(i, j), &(l, m)| a[i][j].abs().total_cmp(&a[l][m].abs()))?;
        a.swap(k, row);
        if column != k {
            a.iter_mut().for_each(|line| line.swap(k, column));
            z.iter_mut().for_each(|line| line.swap(k, column));
            det = -det;
        }
        let inverse = 1.0 / a[k][k];
        if !inverse.is_normal() {
            return None;
        }
        for i in k + 1..N {
            let share = a[i][k] * inverse;
            for j in k..N {
                a[i][j] -= share * a[k][j];
            }
        }
    }
    // a is U now. The columns of Z become those of U⁻¹: each is only added to later ones, so that Z stays
    // triangular but for the order of its rows, and its diagonal holds what the columns were multiplied by.
    for k in 0..N {
        let inverse = 1.0 / a[k][k];
        z.iter_mut().for_each(|line| line[k] *= inverse);
        det = det * Interval::point(inverse);
        for j in k + 1..N {
            let share = a[k][j];
            z.iter_mut().for_each(|line| line[j] -= share * line[k]);
        }
    }
    let usable = z.iter().flatten().all(|x| x.is_finite()) && det.sign() != 0 && det.magnitude().is_finite();
    usable.then_some((z, det))
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::SMatrix;

    /// det Z is what elimination says of Z, and A Z is triangular up to the order of its rows.
    #[test]
    fn matrices_become_triangular() {
        for seed in 0..50 {
            let entry = |j: usize, i: usize| {
                ((seed * 13 + 7 * j * j + 3 * i * i * i + 11 * i * j) as f64 * 0.754_877_666).fract() - 0.5
            };
            let a: [[f64; 6]; 6] = std::array::from_fn(|j| std::array::from_fn(|i| entry(j, i)));
            let (z, det) = triangular(a).unwrap();
            let matrix = |m: &[[f64; 6]; 6]| SMatrix::<f64, 6, 6>::from_fn(|i, j| m[i][j]);
            let (a, z) = (matrix(&a), matrix(&z));
            assert!((z.determinant() / det.mid() - 1.0).abs() < 1e-9);
            let product = a * z;
            let mut rows: Vec<Vec<f64>> = product.row_iter().map(|r| r.iter().copied().collect()).collect();
            let last = |row: &Vec<f64>| row.iter().rposition(|x| x.abs() > 1e-9).unwrap_or(0);
            rows.sort_by_key(last);
            for (i, row) in rows.iter().enumerate() {
                assert!(
                    last(row) == i && (row[i] - 1.0).abs() < 1e-9 && row.iter().all(|x| x.abs() < 1.0 + 1e-9)
                );
            }
        }
        assert!(triangular([[1.0, 2.0], [2.0, 4.0]]).is_none());
    }
}
