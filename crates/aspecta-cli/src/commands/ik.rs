//! `aspecta ik`: the inverse problem.

use crate::args::format::ShownArgs;
use crate::args::given::{Poses, Query};
use crate::args::help::help;
use crate::args::mode::ModeArg;
use crate::args::robot::RobotArg;
use crate::failure::{Answer, Failure};
use crate::input::Columns;
use crate::output::print_each;
use crate::show::solutions::{Solutions, Unknown};
use crate::work::solve::{self, Found};
use clap::Args;
use std::io::Write;

/// Arguments of `ik`.
#[derive(Args)]
#[command(mut_args(help("mode", "Only the solution in this working mode, such as `+-`")))]
pub struct Ik {
    #[command(flatten)]
    robot: RobotArg,
    #[command(flatten)]
    poses: Poses,
    #[command(flatten)]
    mode: ModeArg,
    #[command(flatten)]
    shown: ShownArgs,
}

impl Ik {
    pub fn run(&self, out: &mut dyn Write) -> Result<Answer, Failure> {
        let robot = self.robot.load()?;
        let mode = self.mode.of(&robot)?;
        let layout = [Columns::pose(&robot)];
        let solved = |query: Query| {
            let mut solutions = solve::inverse(&robot, &query.values, query.line)?;
            solutions.retain(|s| mode.is_none_or(|m| s.mode == m));
            Ok(Found { query, solutions, complete: None })
        };
        let found = self.poses.read(&layout, self.shown.deg)?.map(|query| solved(query?));
        let shown = Solutions { robot: &robot, unknown: Unknown::Joints, degrees: self.shown.deg };
        print_each(out, &shown, self.shown.format(), found)
    }
}
