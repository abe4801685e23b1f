//! A body that does not turn on three legs: three spheres.

use super::mirror::{MirrorPair, Pair};
use aspecta_robot::num::{Interval, Scalar, cross};

type Vector = [Interval; 3];

fn minus(a: &Vector, b: &Vector) -> Vector {
    std::array::from_fn(|k| a[k] - b[k])
}

fn norm2(a: &Vector) -> Interval {
    a[0].square() + a[1].square() + a[2].square()
}

/// The common points of the spheres round `p` with radii `r`.
///
/// With v = X − P₁, dᵢ = Pᵢ − P₁ and n = d₂ × d₃, subtracting the first equation from the others leaves
/// v · dᵢ = kᵢ = (R₁² − Rᵢ² + ‖dᵢ‖²)/2, and
///
/// > v × n = e := k₃ d₂ − k₂ d₃,   v = (n × e ± n √N) / ‖n‖²,   N = R₁² ‖n‖² − ‖e‖².
pub(super) fn intersect(p: &[Vector; 3], r: &[Interval; 3]) -> Pair<3> {
    let r2 = r.map(Interval::square);
    let d = [minus(&p[1], &p[0]), minus(&p[2], &p[0])];
    let k: [Interval; 2] = std::array::from_fn(|i| (r2[0] - r2[i + 1] + norm2(&d[i])) * Interval::point(0.5));
    // Two spheres without a common point, which N cannot see where the centres are in line.
    let apart = |i: usize| (r2[0] * norm2(&d[i]) - k[i].square()).is_negative();
    let n = cross(&d[0], &d[1]);
    let e: Vector = std::array::from_fn(|j| k[1] * d[0][j] - k[0] * d[1][j]);
    let n2 = norm2(&n);
    let square = r2[0] * n2 - norm2(&e);
    if apart(0) || apart(1) || square.is_negative() {
        return Pair::None;
    }
    if !n2.is_positive() {
        return Pair::SelfMotion;
    }
    let across = cross(&n, &e);
    Pair::Mirrored(MirrorPair {
        foot: std::array::from_fn(|j| p[0][j] + across[j] / n2),
        normal: n,
        square: square / n2.square(),
    })
}
