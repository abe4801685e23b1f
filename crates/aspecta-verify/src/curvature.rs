//! The second-order test for summits.
//!
//! Where det A alone is the least of the functions of P, all over a box, and every leg closes strictly, P is
//! σ det A / scale near each point of it. If σ det A has a positive second derivative along one and the same
//! straight line of coordinates at all points of the box, none is a local maximum. This settles boxes at
//! double points of det A = 0, where no direction leads uphill.

use super::body::{Body, MOST};
use super::determinant::Turned;
use super::place::{Coordinates, Setting};
use arrayvec::ArrayVec;
use aspecta_robot::AXES;
use aspecta_robot::num::{Interval, Jet, Scalar};
use nalgebra::{DMatrix, DVector};

/// A function of the parameter t of a line, with two derivatives.
type Twice<S> = Jet<Jet<S, 1>, 1>;

fn twice<S: Scalar>(value: S, first: S, second: S) -> Twice<S> {
    Jet { value: Jet { value, gradient: [first] }, gradient: [Jet { value: first, gradient: [second] }] }
}

/// A along the line y + t v at t = 0, where the legs have the joint coordinates q (if a leg is the fold's,
/// its own is not looked at).
fn rows_along<S: Scalar, const D: usize>(
    setting: &Setting<'_>,
    y: &[S; MOST],
    v: &[f64; MOST],
    q: &[S; MOST],
) -> ArrayVec<[Twice<S>; MOST], MOST> {
    let zero = S::zero();
    let line = |k: usize| twice(y[k], S::constant(Interval::point(v[k])), zero);
    let line: [Twice<S>; MOST] = std::array::from_fn(line);
    let body = Body::<Twice<S>, D>::new(setting.robot, setting.chart, &line);
    let row = |j: usize| {
        let span = body.span(j);
        if setting.is_own(j) {
            return body.leg(j, &span, line[0]).row;
        }
        // f(y + t v, q(t)) = 0 for all t: its first derivative gives q̇, its second q̈.
        let still = body.leg(j, &span, twice(q[j], zero, zero));
        let slope = still.slope.value.value;
        let rate = -(still.equation.gradient[0].value / slope);
        let moving = body.leg(j, &span, twice(q[j], rate, zero));
        let bend = -(moving.equation.gradient[0].gradient[0] / slope);
        body.leg(j, &span, twice(q[j], rate, bend)).row
    };
    (0..setting.robot.dof()).map(row).collect()
}

/// The second derivative.
fn second<S: Scalar>(det: &Twice<S>) -> S {
    det.gradient[0].gradient[0]
}

/// Whether σ det A has no local maximum in the box; σ = `sign`, `q` as in [`rows_along`] over the box and at
/// its middle.
pub(super) fn has_no_maximum<const D: usize>(
    setting: &Setting<'_>,
    y: &Coordinates,
    q: (&[Interval; MOST], &[f64; MOST]),
    turned: &Turned,
    sign: f64,
) -> bool {
    let axes = &setting.axes;
    let middle = y.map(Interval::mid);
    let along = |some: &[usize]| {
        let mut v = [0.0; MOST];
        some.iter().for_each(|&a| v[axes[a]] += 1.0);
        second(&turned.determinant(&rows_along::<f64, D>(setting, &middle, &v, q.1)))
    };
    // How the line is found does not matter: the greatest eigenvector of the Hessian at the middle.
    let straight: ArrayVec<f64, AXES> = (0..axes.len()).map(|a| along(&[a])).collect();
    let mut hessian = DMatrix::from_diagonal(&DVector::from_column_slice(&straight));
    for (a, b) in (0..axes.len()).flat_map(|b| (0..b).map(move |a| (a, b))) {
        hessian[(a, b)] = 0.5 * (along(&[a, b]) - straight[a] - straight[b]);
        hessian[(b, a)] = hessian[(a, b)];
    }
    hessian *= sign;
    if hessian.iter().any(|x| !x.is_finite()) {
        return false;
    }
    let eigen = hessian.symmetric_eigen();
    let steepest = eigen.eigenvalues.imax();
    if eigen.eigenvalues[steepest] <= 0.0 {
        return false;
    }
    let vector = eigen.eigenvectors.column(steepest);
    let mut v = [0.0; MOST];
    axes.iter().enumerate().for_each(|(a, &k)| v[k] = vector[a]);
    let all = turned.expansions(&rows_along::<Interval, D>(setting, y, &v, q.0));
    all.iter().any(|det| (second(det) * Interval::point(sign)).is_positive())
}
