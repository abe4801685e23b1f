//! `aspecta ik`: the inverse problem.

use crate::args::format::ShownArgs;
use crate::args::given::queries;
use crate::failure::{Answer, Failure};
use crate::input::{self, Columns};
use crate::show::solutions::{self, Unknown};
use crate::work::solve::{self, Found};
use clap::Args;
use std::io::Write;

/// Arguments of `ik`.
#[derive(Args)]
pub struct Ik {
    /// Name from `aspecta robots`, or path of a robot file
    robot: String,
    #[command(flatten)]
    input: Input,
    /// Only the solution in this working mode, such as `+-`
    #[arg(long, allow_hyphen_values = true)]
    mode: Option<String>,
    #[command(flatten)]
    shown: ShownArgs,
}

#[derive(Args)]
#[group(required = true, multiple = false)]
struct Input {
    /// The pose: x,y | x,y,phi | x,y,z | roll,pitch,yaw | x,y,z,roll,pitch,yaw
    #[arg(long, value_name = "LIST", allow_hyphen_values = true)]
    pose: Option<String>,
    /// A CSV file of poses, one a line; `-` reads stdin
    #[arg(long, value_name = "CSV")]
    file: Option<String>,
}

impl Ik {
    pub fn run(&self, out: &mut dyn Write) -> Result<Answer, Failure> {
        let robot = input::robot(&self.robot)?;
        let mode = self.mode.as_deref().map(|m| input::mode(&robot, m)).transpose()?;
        let layout = [Columns::pose(&robot)];
        let (pose, file) = (self.input.pose.as_deref(), self.input.file.as_deref());
        let mut found = Vec::new();
        for query in queries("--pose", pose, file, &layout, self.shown.deg)? {
            let mut solutions = solve::inverse(&robot, &query.values, query.line)?;
            solutions.retain(|s| mode.is_none_or(|m| s.mode == m));
            found.push(Found { query, solutions, complete: None });
        }
        solutions::print(out, &robot, Unknown::Joints, &found, self.shown.format(), self.shown.deg)?;
        Ok(Answer::from(found.iter().all(|f| !f.solutions.is_empty())))
    }
}
