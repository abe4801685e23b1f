//! The second-order test for summits: where det A alone decides, a summit is a local maximum of σ det A.
//!
//! Theorem. Let det A / scale be certainly the least of all constraints in a box in which every leg closes
//! strictly (so that the others stay greater near a summit there). If v·∇²(σ det A)·v > 0 all over the box
//! for some vector v, no point of it is a local maximum of σ det A, and no aspect has a summit in the box.
//! This settles boxes round the double points of det A = 0, where ∇det A vanishes and no first-order test can
//! succeed: robots with a symmetry have them exactly.

use crate::paving::Paving;
use aspecta_kinematics::chart::Coordinates;
use aspecta_kinematics::modal::ModalRows;
use aspecta_robot::Robot;
use aspecta_robot::WorkingMode;
use aspecta_robot::num::{Interval, Jet, Scalar};
use nalgebra::{DMatrix, SMatrix};

type Second<const M: usize> = Jet<Jet<Interval, M>, M>;

/// Whether, for σ = + and −, σ det A of a mode is proved to have no local maximum in a box. The caller knows
/// that nothing else is active.
pub(super) fn no_local_maximum<const D: usize, const N: usize, const M: usize>(
    robot: &Robot,
    paving: &Paving,
    node: u32,
    mode: WorkingMode,
) -> [bool; 2] {
    let (lo, hi) = paving.bounds(node);
    let y: [Second<M>; N] = std::array::from_fn(|k| match paving.axes.iter().position(|&axis| axis == k) {
        None => Second::constant(Interval::point(paving.window.ranges[k].0)),
        Some(a) => Jet::variable(Jet::variable(Interval::new(lo[a], hi[a]), a), a),
    });
    let (_, legs) = paving.chart.at::<Second<M>, D, N>(robot, &y, |k| y[k].sin_cos());
    let closes = |j: usize| legs[j].fold.is_some() || legs[j].closure.reach.value.value.is_positive();
    if !(0..N).all(closes) {
        return [false; 2];
    }
    let heights = std::array::from_fn(|j| legs[j].heights()[0]);
    let mut det = ModalRows::<Second<M>, N>::parted(robot, &paving.twins, &legs, heights).det(mode);
    for weight in ModalRows::weights_of_parted(&paving.twins, &legs) {
        det = det / weight;
    }
    let hessian = |i: usize, j: usize| det.gradient[i].gradient[j];
    let middle = SMatrix::<f64, M, M>::from_fn(|i, j| hessian(i, j).mid());
    if middle.iter().any(|x| !x.is_finite()) {
        return [false; 2];
    }
    let eigen = DMatrix::from_column_slice(M, M, middle.as_slice()).symmetric_eigen();
    [1.0, -1.0].map(|sign| {
        let best =
            (0..M).max_by(|&a, &b| (sign * eigen.eigenvalues[a]).total_cmp(&(sign * eigen.eigenvalues[b])));
        best.is_some_and(|k| {
            let v = eigen.eigenvectors.column(k);
            let mut sum = Interval::point(0.0);
            for i in 0..M {
                for j in 0..M {
                    sum = sum + hessian(i, j) * Interval::point(v[i]) * Interval::point(v[j]);
                }
            }
            (sum * Interval::point(sign)).is_positive()
        })
    })
}
