//! Paths: checked against singularities and joint limits, between their samples too, and timed under joint
//! limits.

mod check;
pub mod curve;
pub mod spline;
mod text;
pub mod time;

use aspecta_robot::Robot;
use aspecta_robot::num::turned_to;

pub use check::{
    Asked, Bound, Clearance, Joined, Least, Obstacle, PathCheck, PathError, PathOptions, ProfilePoint,
    check_joints, check_path, check_poses,
};
pub use text::PathSummary;

/// Returns the units in which pose coordinates are of order one: the characteristic length for translations,
/// else 1.
pub fn units(robot: &Robot) -> [f64; 6] {
    let mut units = [1.0; 6];
    let lengths = units.iter_mut().zip(robot.platform.coordinates()).filter(|(_, c)| !c.angle);
    lengths.for_each(|(unit, _)| *unit = robot.characteristic_length());
    units
}

/// Turns the angles of `q` by full turns to be next to those of `last`; the furthest that one of them then is
/// away, in rad.
pub fn go_on_from(robot: &Robot, last: &[f64], q: &mut [f64]) -> f64 {
    let angles = q.iter_mut().zip(last).zip(&robot.legs).filter(|(_, leg)| leg.actuator.is_angle());
    angles.fold(0.0, |furthest, ((q, last), _)| {
        *q = turned_to(*q, *last);
        f64::max(furthest, (*q - last).abs())
    })
}
