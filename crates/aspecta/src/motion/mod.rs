//! Motion: paths checked against singularities, between their samples too; paths planned, and timed under joint limits; solutions followed in a control loop.

pub mod assembly;
mod check;
pub mod crossing;
pub mod explore;
pub mod follow;
pub mod modes;
mod named;
pub mod plan;
mod search;
mod spline;
pub mod time;
pub mod traverse;

use crate::num::without_turns;
use crate::robot::Robot;

pub use check::{
    Asked, Clearance, Joined, Least, Obstacle, PathCheck, PathError, PathOptions, ProfilePoint, check_joints,
    check_path, check_poses,
};

/// What makes pose coordinates numbers of order one: the characteristic length for translations, else 1.
fn units(robot: &Robot) -> [f64; 6] {
    let mut units = [1.0; 6];
    let lengths = units.iter_mut().zip(robot.platform.coordinates()).filter(|(_, c)| !c.angle);
    lengths.for_each(|(unit, _)| *unit = robot.characteristic_length());
    units
}

/// a + t (b − a).
fn between(a: &[f64], b: &[f64], t: f64) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a + t * (b - a)).collect()
}

/// Turns the angles of `q` by full turns to be next to those of `last`; the furthest that one of them then is away, in rad.
fn go_on_from(robot: &Robot, last: &[f64], q: &mut [f64]) -> f64 {
    let angles = q.iter_mut().zip(last).zip(&robot.legs).filter(|(_, leg)| leg.actuator.is_angle());
    angles.fold(0.0, |furthest, ((q, last), _)| {
        let turn = without_turns(*q - last);
        *q = last + turn;
        f64::max(furthest, turn.abs())
    })
}
