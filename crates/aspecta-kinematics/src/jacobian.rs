//! The Jacobians A and B of (2), by differentiating the leg equations.

use super::WorkingMode;
use super::placement::{Placement, determinant, leg_gradient, wrench};
use aspecta_robot::Robot;
use serde::Serialize;

/// A = ∂f/∂X and the diagonal of B = ∂f/∂q (3) at a configuration.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Jacobians {
    /// A, row by row (one row per leg); columns: translations, then the angular velocity.
    pub a: Vec<Vec<f64>>,
    /// B_jj.
    pub b: Vec<f64>,
    /// Largest |f_j|, relative to the squares of the leg's lengths.
    pub residual: f64,
    det_a: f64,
}

impl Jacobians {
    /// det A.
    pub fn det_a(&self) -> f64 {
        self.det_a
    }

    /// det B, the product of the B_jj.
    pub fn det_b(&self) -> f64 {
        self.b.iter().product()
    }

    /// The working mode: signs of B_jj.
    pub fn mode(&self) -> WorkingMode {
        mode(&self.b)
    }
}

/// [`Jacobians`] without allocation.
pub(crate) struct Matrices<const N: usize> {
    a: [[f64; N]; N],
    pub b: [f64; N],
    pub residual: f64,
}

impl<const N: usize> Matrices<N> {
    pub(crate) fn at<const D: usize>(robot: &Robot, pose: &[f64], q: &[f64]) -> Self {
        let placement = Placement::<f64, D>::at(robot.platform, pose);
        let mut all = Self { a: [[0.0; N]; N], b: [0.0; N], residual: 0.0 };
        for (j, leg) in robot.legs.iter().enumerate() {
            let arm = placement.arm(leg);
            let (f, gradient, slope) = leg_gradient(leg, &placement.span(leg, &arm), q[j]);
            all.a[j] = wrench(robot.platform, &gradient, &arm);
            all.b[j] = slope;
            all.residual = all.residual.max(f.abs() / leg.actuator.equation_scale(q[j]));
        }
        all
    }

    pub(crate) fn det_a(&self) -> f64 {
        determinant(&self.a)
    }

    pub(crate) fn mode(&self) -> WorkingMode {
        mode(&self.b)
    }
}

/// The signs of the B_jj.
fn mode(b: &[f64]) -> WorkingMode {
    WorkingMode::from_signs(b.iter().map(|&b| b > 0.0))
}

/// A, B and the residual of the leg equations.
pub(crate) fn jacobians<const D: usize, const N: usize>(robot: &Robot, pose: &[f64], q: &[f64]) -> Jacobians {
    let all = Matrices::<N>::at::<D>(robot, pose, q);
    let rows = all.a.iter().map(|row| row.to_vec()).collect();
    Jacobians { det_a: all.det_a(), a: rows, b: all.b.to_vec(), residual: all.residual }
}
