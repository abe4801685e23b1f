//! `--mode`: one working mode.

use crate::failure::Failure;
use crate::input;
use aspecta::kinematics::WorkingMode;
use aspecta::robot::Robot;
use clap::Args;

/// A working mode, if one is given. Each command says what for.
#[derive(Args)]
pub struct ModeArg {
    #[arg(long, allow_hyphen_values = true)]
    mode: Option<String>,
}

impl ModeArg {
    /// The mode, which must be one of the robot's.
    pub fn of(&self, robot: &Robot) -> Result<Option<WorkingMode>, Failure> {
        self.mode.as_deref().map(|mode| input::mode(robot, mode)).transpose()
    }
}
