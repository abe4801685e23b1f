//! `aspecta check`: whether a robot file is right.

use crate::failure::{Answer, Failure};
use crate::output::note;
use aspecta::kinematics::seems_architecturally_singular;
use aspecta::robot::Robot;
use aspecta_cli::doubt::ARCHITECTURE;
use clap::Args;
use std::io::Write;
use std::path::PathBuf;

/// Arguments of `check`.
#[derive(Args)]
pub struct Check {
    /// The robot file
    file: PathBuf,
}

impl Check {
    pub fn run(&self, out: &mut dyn Write) -> Result<Answer, Failure> {
        let robot = Robot::load(&self.file)?;
        let modes = robot.working_modes().len();
        let plural = if modes == 1 { "" } else { "s" };
        let (name, platform, legs) = (&robot.name, robot.platform, robot.dof());
        writeln!(
            out,
            "{}: `{name}` is a {platform} with {legs} legs and {modes} working mode{plural}",
            self.file.display()
        )?;
        if seems_architecturally_singular(&robot, robot.slice(&[]).ok().as_ref()) {
            note(&format!("warning: {ARCHITECTURE}"));
        }
        Ok(Answer::Yes)
    }
}
