//! A robot that is singular wherever it goes.

use crate::output::note;
use aspecta::kinematics::seems_architecturally_singular;
use aspecta::robot::Robot;
use aspecta::text::doubt::ARCHITECTURE;

/// Warns of a robot that is singular wherever it goes.
pub fn warn_of_architecture(robot: &Robot) {
    if seems_architecturally_singular(robot) {
        note(&format!("warning: {ARCHITECTURE}"));
    }
}
