//! `aspecta fk`: the direct problem.

use super::queries::queries;
use super::solutions::{self, Found, Unknown};
use crate::failure::{Answer, Failure};
use crate::input::{self, Columns};
use crate::output::{FormatArgs, note};
use aspecta::kinematics::DirectSolutions;
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
    /// Angles of the input and of the table are in degrees
    #[arg(long)]
    deg: bool,
    #[command(flatten)]
    format: FormatArgs,
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
        let mut found = Vec::new();
        for query in queries("--q", q, file, &layout, self.deg)? {
            let DirectSolutions { mut solutions, complete } =
                match (robot.direct_certified(&query.values), query.line) {
                    (Ok(found), _) => found,
                    (Err(e), None) => return Err(e.into()),
                    // One bad row does not cost the others.
                    (Err(e), Some(line)) => {
                        note(&format!("line {line}: {e}"));
                        found.push(Found { query, solutions: Vec::new(), complete: Some(false) });
                        continue;
                    }
                };
            solutions.retain(|s| mode.is_none_or(|m| s.mode == m));
            if solutions.is_empty() {
                let place = query.line.map_or(String::new(), |line| format!("line {line}: "));
                let which = mode.map_or(String::new(), |m| format!(" in working mode {m}"));
                let proof = if complete { "" } else { " was found (that there is none is not proved)" };
                note(&format!("{place}no direct solution{which}{proof}"));
            }
            found.push(Found { query, solutions, complete: Some(complete) });
        }
        solutions::print(out, &robot, Unknown::Pose, &found, self.format.format(), self.deg)?;
        Ok(Answer::from(found.iter().all(|f| !f.solutions.is_empty() && f.complete == Some(true))))
    }
}
