//! Which legs do not reach a pose, and by how much.

use super::placement::Placement;
use super::{KinematicsError, for_platform};
use crate::Kinematics;
use aspecta_robot::{LegIndex, Robot};
use serde::Serialize;

/// A leg that cannot close at a pose.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct OutOfReach {
    /// The leg.
    pub leg: LegIndex,
    /// The amount by which its rod is too short or too long to join its ends, > 0: a length, or an angle
    /// (rad) for spherical legs. Numerical.
    pub gap: f64,
    /// Whether `gap` is an angle.
    pub angle: bool,
}

/// [`Kinematics::out_of_reach`](crate::Kinematics::out_of_reach).
pub(crate) fn out_of_reach(robot: &Robot, pose: &[f64]) -> Result<Vec<OutOfReach>, KinematicsError> {
    let solutions = robot.leg_solutions(pose)?;
    let gaps = for_platform!(robot.platform, gaps(robot, pose));
    let describe = |(k, gap): (usize, f64)| OutOfReach {
        leg: LegIndex::new(k),
        gap,
        angle: robot.legs[k].actuator.kind().facts().is_on_sphere,
    };
    let unreached = gaps.into_iter().enumerate().filter(|(k, _)| solutions[*k].q == [None; 2]);
    Ok(unreached.map(describe).collect())
}

fn gaps<const D: usize, const N: usize>(robot: &Robot, pose: &[f64]) -> Vec<f64> {
    let placement = Placement::<f64, D>::at(robot.platform, pose);
    robot.legs.iter().map(|leg| leg.actuator.gap(&placement.span(leg, &placement.arm(leg)))).collect()
}
