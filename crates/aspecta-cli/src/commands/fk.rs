//! `aspecta fk`: the direct problem.

use crate::args::format::ShownArgs;
use crate::args::given::queries;
use crate::failure::{Answer, Failure};
use crate::input::{self, Columns};
use crate::show::solutions::{self, Unknown};
use crate::work::solve;
use clap::Args;
use std::io::Write;

/// Arguments of `fk`.
#[derive(Args)]
pub struct Fk {
    /// Name from `aspecta robots`, or path of a robot file
    robot: String,
    #[command(flatten)]
    input: Input,
    /// Only the solutions in this working mode, such as `+-`
    #[arg(long, allow_hyphen_values = true)]
    mode: Option<String>,
    #[command(flatten)]
    shown: ShownArgs,
}

#[derive(Args)]
#[group(required = true, multiple = false)]
struct Input {
    /// The joint vector, one number per leg
    #[arg(long, value_name = "LIST", allow_hyphen_values = true)]
    q: Option<String>,
    /// A CSV file of joint vectors, one a line; `-` reads stdin
    #[arg(long, value_name = "CSV")]
    file: Option<String>,
}

impl Fk {
    pub fn run(&self, out: &mut dyn Write) -> Result<Answer, Failure> {
        let robot = input::robot(&self.robot)?;
        let mode = self.mode.as_deref().map(|m| input::mode(&robot, m)).transpose()?;
        let layout = [Columns::joints(&robot)];
        let (q, file) = (self.input.q.as_deref(), self.input.file.as_deref());
        let asked = queries("--q", q, file, &layout, self.shown.deg)?;
        let found = asked.into_iter().map(|query| solve::direct(&robot, query, mode));
        let found = found.collect::<Result<Vec<_>, Failure>>()?;
        solutions::print(out, &robot, Unknown::Pose, &found, self.shown.format(), self.shown.deg)?;
        Ok(Answer::from(found.iter().all(|f| !f.solutions.is_empty() && f.complete == Some(true))))
    }
}
