//! The inverse geometric model: all joint vectors of a pose, one per working mode (5).

use super::leg::{drive, eliminate};
use super::limits::{LegAt, margin};
use super::placement::Placement;
use super::{KinematicsError, Solution, WorkingMode, for_platform};
use crate::num::Interval;
use crate::robot::Robot;

/// What one leg allows at a pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LegSolutions {
    /// q for s = + and s = −; `None` where the posture does not exist (out of reach, or a strut's s = +).
    pub q: [Option<f64>; 2],
    /// Whether that posture respects the leg's joint limits.
    pub within_limits: [bool; 2],
    /// H / H_max, in [0, 1]: the square of the sine of the elbow angle; 0 at a serial singularity, below
    /// 0 out of reach. 1 for struts.
    pub reach: f64,
    /// Whether interval arithmetic proves that the leg closes strictly (H > 0).
    pub certified: bool,
}

/// Every leg's solutions at `pose`.
fn legs_at<const D: usize, const N: usize>(robot: &Robot, pose: &[f64]) -> Vec<LegSolutions> {
    let sharp: [Interval; N] = std::array::from_fn(|k| Interval::point(pose[k]));
    let exact = Placement::<Interval, D>::at(robot.platform, &sharp);
    let placement = Placement::<f64, D>::at(robot.platform, pose);
    let solve = |leg| {
        let span = placement.span(leg, &placement.arm(leg));
        let closure = eliminate(&leg.actuator, &span);
        let proof = eliminate(&leg.actuator, &exact.span(leg, &exact.arm(leg)));
        let at = LegAt { leg, span, closure, crank: None };
        let mut solutions = LegSolutions {
            q: [None; 2],
            within_limits: [false; 2],
            reach: leg.actuator.greatest_reach().map_or(1.0, |most| closure.reach / most.mid()),
            certified: proof.reach.is_positive(),
        };
        // At the very limit of reach rounding may make H negative: intervals decide.
        if proof.reach.is_negative() {
            return solutions;
        }
        for (k, s) in [1.0, -1.0].into_iter().enumerate() {
            if leg.actuator.postures() == 1 && s > 0.0 {
                continue;
            }
            let sh = s * closure.reach.max(0.0).sqrt();
            solutions.q[k] = Some(drive(&leg.actuator, &span, &closure, sh).value());
            solutions.within_limits[k] =
                leg.limits.iter().all(|limit| margin(limit, &at, sh, &placement) > 0.0);
        }
        solutions
    };
    robot.legs.iter().map(solve).collect()
}

impl Robot {
    /// What each leg allows at `pose`.
    ///
    /// # Errors
    /// [`KinematicsError`] if `pose` has the wrong length or is not finite.
    pub fn leg_solutions(&self, pose: &[f64]) -> Result<Vec<LegSolutions>, KinematicsError> {
        self.check_pose(pose)?;
        Ok(for_platform!(self.platform, legs_at(self, pose)))
    }

    /// All inverse solutions of `pose` within reach, one per working mode, in the order of
    /// [`Robot::working_modes`]; empty if the pose is out of reach. Solutions beyond joint limits are
    /// listed too, with `within_limits` false.
    ///
    /// *Certified* means: interval arithmetic proves H_j > 0 for every leg, so by the closed form
    /// ([`eliminate`]) exactly one configuration of each working mode exists here.
    ///
    /// # Errors
    /// [`KinematicsError`] if `pose` has the wrong length or is not finite.
    pub fn inverse(&self, pose: &[f64]) -> Result<Vec<Solution>, KinematicsError> {
        let legs = self.leg_solutions(pose)?;
        let certified = legs.iter().all(|l| l.certified);
        let mut solutions = Vec::new();
        for mode in self.working_modes() {
            let Some(q) = joint_vector(&legs, mode) else { continue };
            let within = mode.signs().zip(&legs).all(|(s, l)| l.within_limits[usize::from(s < 0)]);
            let jacobians = self.jacobians(pose, &q)?;
            solutions.push(Solution {
                pose: pose.to_vec(),
                mode,
                serial_legs: self.serial_legs(&jacobians.b),
                det_a: jacobians.det_a(),
                residual: jacobians.residual,
                q,
                certified,
                within_limits: within,
            });
        }
        Ok(solutions)
    }

    /// g_i(X) of (5): the joint vector of `pose` in `mode`, or `None` out of reach. Limits are not looked at.
    ///
    /// # Errors
    /// [`KinematicsError`] if `pose` has the wrong length or is not finite.
    pub fn inverse_in(&self, pose: &[f64], mode: WorkingMode) -> Result<Option<Vec<f64>>, KinematicsError> {
        Ok(joint_vector(&self.leg_solutions(pose)?, mode))
    }

    pub(crate) fn check_pose(&self, pose: &[f64]) -> Result<(), KinematicsError> {
        let names = || self.platform.coordinates().iter().map(|c| c.name.to_string()).collect();
        self.check_vector("pose", pose, names)
    }

    pub(crate) fn check_joints(&self, q: &[f64]) -> Result<(), KinematicsError> {
        self.check_vector("joint", q, || (1..=self.dof()).map(|k| format!("q{k}")).collect())
    }

    fn check_vector(
        &self,
        what: &'static str,
        v: &[f64],
        names: impl Fn() -> Vec<String>,
    ) -> Result<(), KinematicsError> {
        if v.len() != self.dof() {
            return Err(KinematicsError::Length {
                robot: self.name.clone(),
                what,
                names: names().join(", "),
                wanted: self.dof(),
                found: v.len(),
            });
        }
        match v.iter().position(|x| !x.is_finite()) {
            Some(k) => Err(KinematicsError::NotFinite { what, index: k + 1, value: v[k] }),
            None => match v.iter().position(|x| x.abs() > 1e7) {
                Some(k) => Err(KinematicsError::TooLarge { what, index: k + 1, value: v[k] }),
                None => Ok(()),
            },
        }
    }
}

fn joint_vector(legs: &[LegSolutions], mode: WorkingMode) -> Option<Vec<f64>> {
    mode.signs().zip(legs).map(|(s, l)| l.q[usize::from(s < 0)]).collect()
}
