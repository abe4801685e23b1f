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
        WorkingMode::from_signs(self.b.iter().map(|&b| b > 0.0))
    }
}

/// A, B and the residual of the leg equations.
pub(crate) fn jacobians<const D: usize, const N: usize>(robot: &Robot, pose: &[f64], q: &[f64]) -> Jacobians {
    let placement = Placement::<f64, D>::at(robot.platform, pose);
    let mut a = [[0.0; N]; N];
    let mut b = vec![0.0; N];
    let mut residual: f64 = 0.0;
    for (j, leg) in robot.legs.iter().enumerate() {
        let arm = placement.arm(leg);
        let (f, gradient, slope) = leg_gradient(leg, &placement.span(leg, &arm), q[j]);
        a[j] = wrench(robot.platform, &gradient, &arm);
        b[j] = slope;
        residual = residual.max(f.abs() / leg.actuator.equation_scale(q[j]));
    }
    Jacobians { det_a: determinant(&a), a: a.iter().map(|r| r.to_vec()).collect(), b, residual }
}
