//! Architecturally singular robots: det A vanishes wherever they go.

use crate::num::Random;
use crate::robot::{Robot, Window};
use std::f64::consts::PI;

/// Poses drawn at most.
const DRAWN: usize = 4000;
/// Configurations that have to be singular, and not one regular.
const SEEN: usize = 64;
/// The greatest [`State::parallel_measure`](super::singularity::State::parallel_measure) that is taken for zero: some thousand roundings.
const ZERO: f64 = 1e-12;

/// Whether det A vanishes at every configuration drawn at random, 64 or more of them: two legs may be one and the same, or all joints of a
/// platform in one line. *Numerical*, to 10⁻¹² of the homogeneous A. Such a robot moves with all actuators locked, and has no aspects.
///
/// Poses are drawn in `window`, or, if the robot has none, within three characteristic lengths of the origin.
pub fn seems_architecturally_singular(robot: &Robot, window: Option<&Window>) -> bool {
    let mut random = Random::new(1);
    let reach = 3.0 * robot.characteristic_length();
    let mut seen = 0;
    for _ in 0..DRAWN {
        let coordinates = robot.platform.coordinates().iter().enumerate();
        let range = |(k, c): (usize, &crate::robot::Coordinate)| match window {
            Some(window) => window.ranges[k],
            None if c.angle => (-PI, PI),
            None => (-reach, reach),
        };
        let pose: Vec<f64> = coordinates.map(range).map(|range| random.within(range)).collect();
        let Some(found) = robot.inverse(&pose).ok().and_then(|mut found| found.pop()) else { continue };
        match robot.state(&found.pose, &found.q) {
            Ok(state) if state.parallel_measure > ZERO => return false,
            _ => seen += 1,
        }
        if seen >= SEEN {
            return true;
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::catalogue;

    fn all() -> impl Iterator<Item = Robot> {
        catalogue::all().iter().map(|entry| Robot::resolve(entry.name).unwrap())
    }

    #[test]
    fn no_robot_of_the_catalogue_is() {
        for robot in all() {
            let window = robot.slice(&[]).ok();
            assert!(!seems_architecturally_singular(&robot, window.as_ref()), "{}", robot.name);
        }
    }

    #[test]
    fn two_struts_in_one_are() {
        // Cranks would not be: in two postures they push in two directions.
        for robot in all().filter(|robot| robot.working_modes().len() == 1) {
            let mut twin = robot.clone();
            twin.legs[1] = twin.legs[0].clone();
            let window = twin.slice(&[]).ok();
            assert!(seems_architecturally_singular(&twin, window.as_ref()), "{}", robot.name);
        }
    }
}
