//! A direction in which several functions grow.

use aspecta_robot::num::Interval;
use nalgebra::{DMatrix, DVector};

/// Corrections of a direction.
const CORRECTIONS: usize = 4;

/// Whether some fixed v has v·γ > 0 for every γ in each of the boxes `growth`, all of one dimension M. How v
/// is found does not matter: it is checked.
///
/// Of the directions in which given vectors g_k all grow, the one with the widest margin is the shortest v
/// with g_k·v = 1 for some up to M of them (the support vectors of a machine of that name): all are tried.
/// The vectors are first the middles of the boxes, then the corners that are worst for the direction found
/// before.
///
/// Along an axis on which all components may be zero no direction is sure to gain anything: it stays out, lest noise be taken for a component.
pub(super) fn climbable(growth: &[Vec<Interval>]) -> bool {
    let axes = growth.first().map_or(0, Vec::len);
    let axes: Vec<usize> = (0..axes).filter(|&i| growth.iter().any(|g| !g[i].contains(0.0))).collect();
    let growth: Vec<Vec<Interval>> = growth.iter().map(|g| axes.iter().map(|&i| g[i]).collect()).collect();
    let Some(size) = growth.first().map(Vec::len) else { return false };
    let may_vanish = |g: &Vec<Interval>| g.iter().all(|x| x.contains(0.0));
    if growth.iter().any(may_vanish) {
        return false;
    }
    let units = balanced(&growth);
    let scaled = |g: &Vec<Interval>| -> Vec<Interval> {
        g.iter().zip(&units).map(|(x, unit)| *x * Interval::point(1.0 / unit)).collect()
    };
    let growth: Vec<Vec<Interval>> = growth.iter().map(scaled).collect();
    let grows = |v: &DVector<f64>| {
        growth.iter().all(|g| {
            let terms = (0..size).map(|i| g[i] * Interval::point(v[i]));
            terms.fold(Interval::point(0.0), |sum, term| sum + term).is_positive()
        })
    };
    subsets(growth.len(), size).iter().any(|some| {
        let mut v = DVector::zeros(size);
        (0..CORRECTIONS).any(|_| {
            let worst = |k: &usize| {
                let vector =
                    DVector::from_iterator(size, growth[*k].iter().zip(&v).map(|(g, v)| corner(*g, *v)));
                vector.clone().try_normalize(f64::MIN_POSITIVE).unwrap_or(vector)
            };
            let found = shortest(&some.iter().map(worst).collect::<Vec<_>>());
            found.is_some_and(|found| {
                v = found;
                grows(&v)
            })
        })
    })
}

/// The number in an interval that makes its product with v least.
fn corner(g: Interval, v: f64) -> f64 {
    match v {
        v if v > 0.0 => g.lo,
        v if v < 0.0 => g.hi,
        _ => g.mid(),
    }
}

/// Units of the M axes in which the components of all vectors, each brought to length one, are alike in size.
fn balanced(growth: &[Vec<Interval>]) -> Vec<f64> {
    let mut units = vec![1.0; growth[0].len()];
    for _ in 0..4 {
        let size = |g: &Vec<Interval>| {
            let vector = DVector::from_fn(units.len(), |i, _| g[i].magnitude() / units[i]);
            vector.clone().try_normalize(f64::MIN_POSITIVE).unwrap_or(vector)
        };
        let sizes: Vec<DVector<f64>> = growth.iter().map(size).collect();
        for (i, unit) in units.iter_mut().enumerate() {
            let largest = sizes.iter().map(|v| v[i]).fold(0.0, f64::max);
            if largest.is_normal() && (*unit * largest).is_normal() {
                *unit *= largest;
            }
        }
    }
    units
}

/// Returns all sets of 1 to `most` numbers below `count`.
fn subsets(count: usize, most: usize) -> Vec<Vec<usize>> {
    let mut all: Vec<Vec<usize>> = vec![vec![]];
    let mut from = 0;
    for _ in 0..most {
        let upto = all.len();
        for at in from..upto {
            let next = all[at].last().map_or(0, |last| last + 1);
            for k in next..count {
                let larger = all[at].iter().copied().chain([k]).collect();
                all.push(larger);
            }
        }
        from = upto;
    }
    all.split_off(1)
}

/// The shortest v with g·v = 1 for all the vectors.
fn shortest(vectors: &[DVector<f64>]) -> Option<DVector<f64>> {
    let g = DMatrix::from_columns(vectors);
    let weights = g.tr_mul(&g).lu().solve(&DVector::repeat(vectors.len(), 1.0))?;
    Some(g * weights)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn thin(rows: &[[f64; 2]]) -> Vec<Vec<Interval>> {
        rows.iter().map(|row| row.iter().map(|&x| Interval::new(x - 1e-6, x + 1e-6)).collect()).collect()
    }

    #[test]
    fn a_direction_is_found_where_there_is_one() {
        assert!(!climbable(&thin(&[[0.0, -200.0], [1.0, 2000.0], [-1e5, -1e3]])));
        assert!(climbable(&thin(&[[0.0, -200.0], [1.0, 150.0]])));
        assert!(climbable(&thin(&[[1.0, 0.0], [-0.9, 0.1]])));
        assert!(!climbable(&thin(&[[1.0, 0.0], [-1.0, 0.0]])));
        assert!(!climbable(&thin(&[[1.0, 0.0], [-1.0, 1.0], [-1.0, -1.0]])));
        assert!(!climbable(&thin(&[[0.0, 0.0]])));
        assert!(!climbable(&[]));
    }

    /// A third axis with nothing but rounding, as where two functions do not change with an angle, hides no direction.
    #[test]
    fn noise_is_no_component() {
        let with = |rows: [[f64; 2]; 2], noise: [Interval; 2]| {
            let rows = thin(&rows).into_iter().zip(noise);
            rows.map(|(row, noise)| [&row[..], &[noise]].concat()).collect::<Vec<_>>()
        };
        let noise = [Interval::new(-1e-318, 1e-318), Interval::new(-2.8e-10, 2.8e-9)];
        assert!(climbable(&with([[-55775.6, 11939.5], [18000.4, -9643.9]], noise)));
        assert!(!climbable(&with([[-55775.6, 11939.5], [55775.6, -11939.5]], noise)));
    }

    #[test]
    fn subsets_are_all_there() {
        assert_eq!(subsets(3, 2), [vec![0], vec![1], vec![2], vec![0, 1], vec![0, 2], vec![1, 2]]);
        assert_eq!(subsets(2, 3).len(), 3);
    }
}
