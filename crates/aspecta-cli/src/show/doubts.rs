//! A robot that is singular wherever it goes.

use crate::output::note;
use aspecta::kinematics::{Architecture, architecture};
use aspecta::robot::Robot;
use aspecta::text::doubt::{ARCHITECTURE, nearly_singular};

/// Warns of a robot that is singular wherever it goes.
pub fn warn_of_architecture(robot: &Robot) {
    match architecture(robot) {
        Architecture::Regular => {}
        Architecture::Singular => note(&format!("warning: {ARCHITECTURE}")),
        Architecture::NearlySingular { measure } => {
            note(&format!("warning: {}", nearly_singular(measure)));
        }
    }
}
