//! `aspecta export`: robots as files of other programs.

use crate::args::help::{help, value_name};
use crate::args::mode::ModeArg;
use crate::args::robot::RobotArg;
use crate::failure::{Answer, Failure};
use crate::input::{self, Columns};
use crate::output::{Target, note};
use crate::work::solve;
use aspecta::Kinematics;
use aspecta::kinematics::{Singularity, start};
use aspecta_view::mjcf;
use clap::{Args, Subcommand};
use std::io::Write;
use std::path::PathBuf;

/// Arguments of `export`.
#[derive(Args)]
pub struct Export {
    #[command(subcommand)]
    format: Format,
}

#[derive(Subcommand)]
enum Format {
    /// A model for MuJoCo, with closed loops and a servo for every driven joint
    Mjcf(Mjcf),
}

/// Arguments of `export mjcf`.
#[derive(Args)]
#[command(mut_args(help(
    "mode",
    "The working mode in which it starts, such as `+-+` [default: that farthest from singularities]"
)))]
#[command(mut_args(value_name("mode", "SIGNS")))]
struct Mjcf {
    #[command(flatten)]
    robot: RobotArg,
    /// The pose in which the model starts [default: one far from singularities]
    #[arg(long, value_name = "LIST", allow_hyphen_values = true)]
    pose: Option<String>,
    #[command(flatten)]
    mode: ModeArg,
    /// Angles of --pose are in degrees
    #[arg(long, requires = "pose")]
    deg: bool,
    /// Write the model into this file instead of stdout
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

impl Export {
    pub fn run(&self, out: &mut dyn Write) -> Result<Answer, Failure> {
        match &self.format {
            Format::Mjcf(mjcf) => mjcf.run(out),
        }
    }
}

impl Mjcf {
    fn run(&self, out: &mut dyn Write) -> Result<Answer, Failure> {
        let robot = self.robot.load()?;
        let mode = self.mode.of(&robot)?;
        let target = self.out.as_deref().map(|path| Target::new("--out", path)).transpose()?;
        let start = match &self.pose {
            Some(list) => {
                let pose = input::list("--pose", list, &Columns::pose(&robot), self.deg)?;
                solve::within_reach(&robot, &pose)?;
                start::at(&robot, &pose, mode)?
            }
            None => start::anywhere(&robot, mode)?,
        };
        let model = mjcf::model(&robot, &start);
        let state = robot.state(&start.pose, &start.q)?;
        if state.singularity != Singularity::Regular {
            let kind = state.singularity.name();
            note(&format!(
                "the model starts in a singular configuration ({kind}): it may leave it either way"
            ));
        }
        match target {
            Some(target) => writeln!(out, "written: {}", target.write(model)?.display())?,
            None => out.write_all(model.as_bytes())?,
        }
        let left_out = mjcf::left_out(&robot);
        if !left_out.is_empty() {
            note(&format!("the model lacks these limits: {}", left_out.join(", ")));
        }
        Ok(Answer::Yes)
    }
}
