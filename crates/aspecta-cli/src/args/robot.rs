//! ROBOT: a robot of the catalogue, or one of the user's.

use crate::failure::Failure;
use crate::input;
use aspecta::robot::Robot;
use clap::Args;

/// Which robot.
#[derive(Args)]
pub struct RobotArg {
    /// Name from `aspecta robots`, or path of a robot file
    robot: String,
}

impl RobotArg {
    /// Finds it in the catalogue, or reads its file.
    pub fn load(&self) -> Result<Robot, Failure> {
        input::robot(&self.robot)
    }
}
