//! Which legs do not reach a pose, and by how much.

use super::placement::Placement;
use super::{KinematicsError, for_platform};
use crate::Kinematics;
use aspecta_robot::legs::sum_of_squares;
use aspecta_robot::{Actuator, Leg, Robot};
use serde::Serialize;
use std::f64::consts::PI;

/// A leg that cannot close at a pose.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct OutOfReach {
    /// Leg number, from 1.
    pub leg: usize,
    /// By how much its rod is too short or too long to join its ends, > 0: a length, or an angle (rad) for
    /// spherical legs. Numerical.
    pub gap: f64,
    /// Whether `gap` is an angle.
    pub angle: bool,
}

/// [`Kinematics::out_of_reach`](crate::Kinematics::out_of_reach).
pub(crate) fn out_of_reach(robot: &Robot, pose: &[f64]) -> Result<Vec<OutOfReach>, KinematicsError> {
    let solutions = robot.leg_solutions(pose)?;
    let gaps = for_platform!(robot.platform, gaps(robot, pose));
    let describe = |(k, gap): (usize, f64)| OutOfReach {
        leg: k + 1,
        gap,
        angle: matches!(robot.legs[k].actuator, Actuator::Spherical { .. }),
    };
    let unreached = gaps.into_iter().enumerate().filter(|(k, _)| solutions[*k].q == [None; 2]);
    Ok(unreached.map(describe).collect())
}

fn gaps<const D: usize, const N: usize>(robot: &Robot, pose: &[f64]) -> Vec<f64> {
    let placement = Placement::<f64, D>::at(robot.platform, pose);
    robot.legs.iter().map(|leg| gap(leg, &placement.span(leg, &placement.arm(leg)))).collect()
}

/// How far the rod's length is from the range of distances between C and the places its other end can take.
fn gap<const D: usize>(leg: &Leg, d: &[f64; D]) -> f64 {
    let planar = d[0].hypot(d[1]);
    let off_plane = d.get(2).copied().unwrap_or(0.0);
    match leg.actuator {
        Actuator::Revolute { crank, rod } => {
            let (crank, rod) = (crank.mid(), rod.mid());
            outside(rod, (planar - crank).hypot(off_plane), (planar + crank).hypot(off_plane))
        }
        Actuator::Prismatic { rod } => {
            outside(rod.mid(), (sum_of_squares(d) - d[0] * d[0]).max(0.0).sqrt(), f64::INFINITY)
        }
        Actuator::Strut => 0.0,
        Actuator::Spherical { proximal: (cos, sin), distal_cos } => {
            let (proximal, distal) = (sin.mid().atan2(cos.mid()), distal_cos.mid().acos());
            let tilt = planar.atan2(off_plane);
            outside(distal, (proximal - tilt).abs(), (proximal + tilt).min(2.0 * PI - proximal - tilt))
        }
    }
}

/// The distance of `x` from [lo, hi].
fn outside(x: f64, lo: f64, hi: f64) -> f64 {
    (lo - x).max(x - hi).max(0.0)
}
