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
/// The greatest one of robots that are singular but for the decimals of their file, of which they have three at least.
const ROUNDED: f64 = 1e-3;

/// What a robot is wherever it goes, as far as random configurations tell ([`architecture`]). *Numerical*.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Architecture {
    /// Some configuration is far from singular, or too few were found.
    Regular,
    /// det A vanishes at all of them, to 10⁻¹² of the homogeneous A: two legs may be one and the same, or all
    /// joints of a platform in one line. Such a robot moves with all actuators locked, and has no aspects.
    Singular,
    /// At none of them is the homogeneous A further than this, below 10⁻³, from a singular matrix: that it is
    /// not one may be due to the decimals in which lengths were written down, and the robot as built hardly
    /// keeps its platform.
    NearlySingular {
        /// The greatest [`State::parallel_measure`](super::singularity::State::parallel_measure) seen.
        measure: f64,
    },
}

/// Returns whether a robot is singular at every configuration drawn at random, 64 or more of them, in every
/// working mode there. *Numerical*.
///
/// Poses are drawn in the robot's window, or, if it has none, within three characteristic lengths of the
/// origin.
///
/// # Examples
/// ```
/// use aspecta_kinematics::{Architecture, architecture};
/// use aspecta_robot::Robot;
///
/// let mut robot = Robot::resolve("gough-stewart")?;
/// assert_eq!(architecture(&robot), Architecture::Regular);
///
/// robot.legs[1] = robot.legs[0].clone();
/// assert_eq!(architecture(&robot), Architecture::Singular);
/// # Ok::<(), aspecta_robot::FileError>(())
/// ```
pub fn architecture(robot: &Robot) -> Architecture {
    let window = robot.slice(&[]).ok();
    let mut random = Random::new(1);
    let reach = 3.0 * robot.characteristic_length();
    let (mut seen, mut measure) = (0, 0.0_f64);
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
            measure = measure.max(state.parallel_measure);
            if measure > ROUNDED {
                return Architecture::Regular;
            }
            seen += 1;
        }
        if seen >= SEEN {
            return if measure > ZERO {
                Architecture::NearlySingular { measure }
            } else {
                Architecture::Singular
            };
        }
    }
    Architecture::Regular
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
            assert_eq!(architecture(&robot), Architecture::Regular, "{}", robot.name);
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
                let is_singular = architecture(&twin) == Architecture::Singular;
                assert_eq!(is_singular, alike, "{}, leg {leg}", robot.name);
            }
        }
    }
}
