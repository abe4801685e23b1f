//! How near a singularity a refused step ends. Numerical throughout.

use super::refusal::Refusal;
use super::tube::{Located, Model, Proof, plain};
use crate::homogeneous::Homogeneous;
use crate::placement::{Placement, determinant, leg_gradient_turned, moved};
use aspecta_robot::WorkingMode;
use nalgebra::SVector;

/// Displacement (in units) of the difference quotient of det A.
const APART: f64 = 1e-6;
/// Iterations for the greatest singular value of A⁻¹, of which two digits would do.
const POWERS: usize = 32;

impl<const D: usize, const N: usize> Model<'_, D, N> {
    /// The working mode at the end of a proved stretch; in doubles where the proof leaves a sign open.
    pub fn mode(&self, proof: &Proof<N>) -> WorkingMode {
        if !proof.signs.contains(&0) {
            return WorkingMode::from_signs(proof.signs.iter().map(|s| *s > 0));
        }
        let b = self.slopes(&proof.end.pose, &proof.end.q);
        WorkingMode::from_signs(
            (0..N).map(|j| if proof.signs[j] == 0 { b[j] > 0.0 } else { proof.signs[j] > 0 }),
        )
    }

    /// Why there is no proof beyond `last`, which lies at t = `proved` of the way from `start` to `goal`.
    ///
    /// The singularity is named if it seems to lie within the step, or one more like it.
    ///
    /// At a parallel singularity two solutions meet like the roots ±√(t* − t): there det A² goes to zero
    /// linearly.
    pub fn refusal(&self, last: &Located<N>, start: &[f64; N], goal: &[f64; N], proved: f64) -> Refusal {
        let distance = self.parallel_measure(last);
        let (det, rate) = self.det_and_rate(last, start, goal);
        let singular_at = proved - 0.5 * det / rate;
        if singular_at > proved && singular_at <= proved + 1.0 {
            Refusal::Parallel { proved, singular_at, distance }
        } else {
            Refusal::TooLong { proved, distance }
        }
    }

    /// The smallest singular value of the homogeneous A, as 1 / ‖A⁻¹‖₂ by the power method.
    fn parallel_measure(&self, at: &Located<N>) -> f64 {
        let (_, mut a) = self.linearised(&at.pose, &at.q, &plain(&self.turns(&at.q)));
        let homogeneous = Homogeneous::of(self.robot);
        for j in 0..N {
            let mut row: [f64; N] = std::array::from_fn(|k| a[(j, k)]);
            homogeneous.scale(&mut row);
            (0..N).for_each(|k| a[(j, k)] = row[k]);
        }
        let Some(inverse) = a.try_inverse() else { return 0.0 };
        // Not orthogonal to what is looked for, but by bad luck.
        let mut v = SVector::<f64, N>::from_fn(|k, _| 1.0 + 0.1 * k as f64).normalize();
        let mut greatest = 0.0;
        for _ in 0..POWERS {
            let w = inverse.transpose() * (inverse * v);
            greatest = w.norm();
            v = w / greatest;
        }
        1.0 / greatest.sqrt()
    }

    /// det A, and its derivative with t along the solution curve of the segment from `start` to `goal`.
    fn det_and_rate(&self, at: &Located<N>, start: &[f64; N], goal: &[f64; N]) -> (f64, f64) {
        let b = self.slopes(&at.pose, &at.q);
        let drive = SVector::<f64, N>::from_fn(|j, _| b[j] * (goal[j] - start[j]));
        let velocity = -(at.inverse * drive);
        let speed = (0..N).fold(0.0, |most: f64, k| most.max(velocity[k].abs() / self.unit[k]));
        let dt = APART / speed.max(f64::MIN_POSITIVE);
        let det_at = |dt: f64| {
            let pose = moved::<D, N>(self.robot.platform, &at.pose, &(velocity * dt).into());
            let q = std::array::from_fn(|j| at.q[j] + dt * (goal[j] - start[j]));
            let (_, a) = self.linearised(&pose, &q, &plain(&self.turns(&q)));
            determinant(&std::array::from_fn::<_, N, _>(|j| std::array::from_fn::<_, N, _>(|k| a[(j, k)])))
        };
        (det_at(0.0), (det_at(dt) - det_at(-dt)) / (2.0 * dt))
    }

    /// B_jj.
    fn slopes(&self, pose: &[f64; N], q: &[f64; N]) -> [f64; N] {
        let placement = Placement::<f64, D>::at(self.robot.platform, pose);
        let turns = plain(&self.turns(q));
        let mut b = [0.0; N];
        for (j, leg) in self.robot.legs.iter().enumerate().take(N) {
            let span = placement.span(leg, &placement.arm(leg));
            b[j] = leg_gradient_turned(leg, &span, q[j], || turns[j]).2;
        }
        b
    }
}
