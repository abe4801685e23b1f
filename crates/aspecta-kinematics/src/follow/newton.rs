//! The pose at the new joint vector, in doubles: what the certificate then judges.

use super::tube::{Model, Turn};
use crate::placement::{Placement, leg_gradient_turned, moved, wrench};
use nalgebra::{SMatrix, SVector};

/// Chord steps after the one Newton step with a fresh Jacobian.
const MOST_CHORDS: usize = 4;

/// A pose and the inverse of A there.
pub(super) struct Root<const N: usize> {
    pub pose: [f64; N],
    pub inverse: SMatrix<f64, N, N>,
}

impl<const D: usize, const N: usize> Model<'_, D, N> {
    /// Newton's method for f(·, q) = 0 from `pose`, where `inverse` ≈ A⁻¹. `None` if A has no inverse.
    pub fn newton(
        &self,
        pose: &[f64; N],
        inverse: &SMatrix<f64, N, N>,
        q: &[f64; N],
        turns: &[Turn<f64>; N],
    ) -> Option<Root<N>> {
        let platform = self.robot.platform;
        let predicted = moved::<D, N>(platform, pose, &(-(inverse * self.residual(pose, q, turns))).into());
        let (f, a) = self.linearised(&predicted, q, turns);
        let inverse = a.try_inverse()?;
        let step = -(inverse * f);
        let mut pose = moved::<D, N>(platform, &predicted, &step.into());
        let mut last = self.length(&step);
        for _ in 0..MOST_CHORDS {
            let step = -(inverse * self.residual(&pose, q, turns));
            pose = moved::<D, N>(platform, &pose, &step.into());
            let length = self.length(&step);
            // Steps shrink by one factor: the next would be lost in rounding.
            if length * length <= 0.5 * f64::EPSILON * last {
                break;
            }
            last = length;
        }
        pose.iter().all(|x| x.is_finite()).then_some(Root { pose, inverse })
    }

    /// ‖z‖, numerical.
    fn length(&self, z: &SVector<f64, N>) -> f64 {
        (0..N).fold(0.0, |most: f64, k| most.max(z[k].abs() / self.unit[k]))
    }

    /// f.
    fn residual(&self, pose: &[f64; N], q: &[f64; N], turns: &[Turn<f64>; N]) -> SVector<f64, N> {
        let placement = Placement::<f64, D>::at(self.robot.platform, pose);
        let mut f = SVector::zeros();
        for (j, leg) in self.robot.legs.iter().enumerate().take(N) {
            let span = placement.span(leg, &placement.arm(leg));
            f[j] = leg.actuator.equation_turned(&span, q[j], || turns[j]);
        }
        f
    }

    /// f and A, with respect to translations and the angular velocity.
    pub fn linearised(
        &self,
        pose: &[f64; N],
        q: &[f64; N],
        turns: &[Turn<f64>; N],
    ) -> (SVector<f64, N>, SMatrix<f64, N, N>) {
        let platform = self.robot.platform;
        let placement = Placement::<f64, D>::at(platform, pose);
        let (mut f, mut a) = (SVector::zeros(), SMatrix::zeros());
        for (j, leg) in self.robot.legs.iter().enumerate().take(N) {
            let arm = placement.arm(leg);
            let (value, gradient, _) =
                leg_gradient_turned(leg, &placement.span(leg, &arm), q[j], || turns[j]);
            f[j] = value;
            let row: [f64; N] = wrench(platform, &gradient, &arm);
            for k in 0..N {
                a[(j, k)] = row[k];
            }
        }
        (f, a)
    }
}
