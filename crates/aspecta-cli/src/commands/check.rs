//! `aspecta check`: whether a robot file is right.

use crate::failure::{Answer, Failure};
use crate::input::warn_of_mixed_units;
use crate::show::doubts::warn_of_architecture;
use crate::show::facts;
use aspecta::robot::Robot;
use aspecta_view::words::count;
use clap::Args;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Arguments of `check`.
#[derive(Args)]
pub struct Check {
    /// The robot file; `-` reads stdin
    file: PathBuf,
}

impl Check {
    pub fn run(&self, out: &mut dyn Write) -> Result<Answer, Failure> {
        let (robot, file) = if self.file == Path::new("-") {
            (Robot::read(io::stdin().lock(), "stdin")?, "stdin".to_owned())
        } else {
            (Robot::load(&self.file)?, self.file.display().to_string())
        };
        let modes = count(robot.working_modes().len(), "working mode", "working modes");
        let (name, platform, legs) = (&robot.name, robot.platform, robot.dof());
        writeln!(out, "{file}: `{name}` is a {platform} with {legs} legs and {modes}")?;
        facts::bodies(out, &robot)?;
        warn_of_mixed_units(&robot);
        warn_of_architecture(&robot);
        Ok(Answer::Yes)
    }
}
