//! Architecturally singular robots: det A vanishes wherever they go.

use crate::Kinematics;
use aspecta_robot::num::Random;
use aspecta_robot::{Coordinate, Robot};
use std::f64::consts::PI;

/// Poses drawn at most.
const DRAWN: usize = 4000;
/// Configurations that have to be singular, and not one regular.
const SEEN: usize = 64;
/// The greatest [`State::parallel_measure`](super::singularity::State::parallel_measure) that is taken for
/// zero: some thousand roundings.
const ZERO: f64 = 1e-12;

/// Whether det A vanishes at every configuration drawn at random, 64 or more of them, in every working mode
/// there: two legs may be one and the same, or all joints of a platform in one line. *Numerical*, to 10⁻¹² of
/// the homogeneous A. Such a robot moves with all actuators locked, and has no aspects.
///
/// Poses are drawn in the robot's window, or, if it has none, within three characteristic lengths of the
/// origin.
pub fn seems_architecturally_singular(robot: &Robot) -> bool {
    let window = robot.slice(&[]).ok();
    let mut random = Random::new(1);
    let reach = 3.0 * robot.characteristic_length();
    let mut seen = 0;
    for _ in 0..DRAWN {
        let coordinates = robot.platform.coordinates().iter().enumerate();
        let range = |(k, c): (usize, &Coordinate)| match &window {
            Some(window) => window.ranges[k],
            None if c.angle => (-PI, PI),
            None => (-reach, reach),
        };
        let pose: Vec<f64> = coordinates.map(range).map(|range| random.within(range)).collect();
        for found in robot.inverse(&pose).unwrap_or_default() {
            let Ok(state) = robot.state(&found.pose, &found.q) else { continue };
            if state.parallel_measure > ZERO {
                return false;
            }
            seen += 1;
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
    use aspecta_robot::catalogue;

    fn all() -> impl Iterator<Item = Robot> {
        catalogue::all().iter().map(|entry| catalogue::find(entry.name).unwrap())
    }

    #[test]
    fn no_robot_of_the_catalogue_is() {
        for robot in all() {
            assert!(!seems_architecturally_singular(&robot), "{}", robot.name);
        }
    }

    /// Two legs in one place push in one direction if they are struts, and in opposite ones, which is no
    /// better, if they are spherical with right angles. Other legs push in two directions where their
    /// postures differ.
    #[test]
    fn robots_with_two_legs_in_one_are_if_these_push_alike() {
        for robot in all() {
            let alike = robot.working_modes().len() == 1 || robot.name == "spherical-3-rrr";
            for leg in 1..robot.dof() {
                let mut twin = robot.clone();
                twin.legs[leg] = twin.legs[leg - 1].clone();
                assert_eq!(seems_architecturally_singular(&twin), alike, "{}, leg {leg}", robot.name);
            }
        }
    }
}
