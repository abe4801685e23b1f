//! `aspecta fk`: the direct problem.

use crate::args::format::ShownArgs;
use crate::args::given::JointVectors;
use crate::args::help::help;
use crate::args::mode::ModeArg;
use crate::args::robot::RobotArg;
use crate::failure::{Answer, Failure};
use crate::input::Columns;
use crate::output::print_each;
use crate::show::solutions::{Solutions, Unknown};
use crate::work::solve;
use clap::Args;
use std::io::Write;

/// Arguments of `fk`.
#[derive(Args)]
#[command(mut_args(help("mode", "Only the solutions in this working mode, such as `+-`")))]
pub struct Fk {
    #[command(flatten)]
    robot: RobotArg,
    #[command(flatten)]
    joints: JointVectors,
    #[command(flatten)]
    mode: ModeArg,
    #[command(flatten)]
    shown: ShownArgs,
}

impl Fk {
    pub fn run(&self, out: &mut dyn Write) -> Result<Answer, Failure> {
        let robot = self.robot.load()?;
        let mode = self.mode.of(&robot)?;
        let layout = [Columns::joints(&robot)];
        let asked = self.joints.read(&layout, self.shown.deg)?;
        let found = asked.map(|query| solve::direct(&robot, query?, mode));
        let shown = Solutions { robot: &robot, unknown: Unknown::Pose, degrees: self.shown.deg };
        print_each(out, &shown, self.shown.format(), found)
    }
}
