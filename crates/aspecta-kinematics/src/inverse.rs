//! The inverse geometric model: all joint vectors of a pose, one per working mode (5).

use super::constraints::within_limits;
use super::placement::Placement;
use super::singularity::serial_legs;
use super::{KinematicsError, Solution, WorkingMode, for_platform};
use crate::Kinematics;
use aspecta_robot::Robot;
use aspecta_robot::num::Interval;

/// The inverse solutions of one leg at a pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LegSolutions {
    /// q for s = + and s = −, as [`Leg::joint_value`](aspecta_robot::Leg::joint_value) tells it; `None` where
    /// the posture does not exist (out of reach, or a strut's s = +).
    pub q: [Option<f64>; 2],
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
        let closure = leg.actuator.eliminate(&span);
        let proof = leg.actuator.eliminate(&exact.span(leg, &exact.arm(leg)));
        let mut solutions = LegSolutions {
            q: [None; 2],
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
            solutions.q[k] = Some(leg.joint_value(leg.actuator.drive(&span, &closure, sh)));
        }
        solutions
    };
    robot.legs.iter().map(solve).collect()
}

/// [`Kinematics::leg_solutions`](crate::Kinematics::leg_solutions).
pub(crate) fn leg_solutions(robot: &Robot, pose: &[f64]) -> Result<Vec<LegSolutions>, KinematicsError> {
    check_pose(robot, pose)?;
    Ok(for_platform!(robot.platform, legs_at(robot, pose)))
}

/// Every mode's solution at `pose`.
fn solutions_at<const D: usize, const N: usize>(
    robot: &Robot,
    pose: &[f64],
) -> Result<Vec<Solution>, KinematicsError> {
    let legs = legs_at::<D, N>(robot, pose);
    let is_within = within_limits::<D, N>(robot, pose);
    let certified = legs.iter().all(|l| l.certified);
    let mut solutions = Vec::new();
    for mode in robot.working_modes() {
        let Some(q) = joint_vector(&legs, mode) else { continue };
        let jacobians = robot.jacobians(pose, &q)?;
        solutions.push(Solution {
            pose: pose.to_vec(),
            mode,
            serial_legs: serial_legs(robot, &jacobians.b),
            det_a: jacobians.det_a(),
            residual: jacobians.residual,
            q,
            certified,
            within_limits: is_within(mode),
        });
    }
    Ok(solutions)
}

/// [`Kinematics::inverse`](crate::Kinematics::inverse).
pub(crate) fn inverse(robot: &Robot, pose: &[f64]) -> Result<Vec<Solution>, KinematicsError> {
    check_pose(robot, pose)?;
    for_platform!(robot.platform, solutions_at(robot, pose))
}

/// [`Kinematics::inverse_in`](crate::Kinematics::inverse_in).
pub(crate) fn inverse_in(
    robot: &Robot,
    pose: &[f64],
    mode: WorkingMode,
) -> Result<Option<Vec<f64>>, KinematicsError> {
    Ok(joint_vector(&robot.leg_solutions(pose)?, mode))
}

/// Whether `pose` is one of the robot: as many finite coordinates as it has, none beyond ±1e7.
///
/// # Errors
/// [`KinematicsError`]
pub fn check_pose(robot: &Robot, pose: &[f64]) -> Result<(), KinematicsError> {
    let names = || robot.platform.coordinates().iter().map(|c| c.name.to_string()).collect();
    check_vector(robot, "pose", pose, names)
}

/// Whether `q` is a joint vector of the robot: as many finite coordinates as it has, none beyond ±1e7.
///
/// # Errors
/// [`KinematicsError`]
pub fn check_joints(robot: &Robot, q: &[f64]) -> Result<(), KinematicsError> {
    check_vector(robot, "joint", q, || (1..=robot.dof()).map(|k| format!("q{k}")).collect())
}

fn check_vector(
    robot: &Robot,
    what: &'static str,
    v: &[f64],
    names: impl Fn() -> Vec<String>,
) -> Result<(), KinematicsError> {
    if v.len() != robot.dof() {
        return Err(KinematicsError::Length {
            robot: robot.name.clone(),
            what,
            names: names().join(", "),
            wanted: robot.dof(),
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

fn joint_vector(legs: &[LegSolutions], mode: WorkingMode) -> Option<Vec<f64>> {
    mode.signs().zip(legs).map(|(s, l)| l.q[usize::from(s < 0)]).collect()
}
