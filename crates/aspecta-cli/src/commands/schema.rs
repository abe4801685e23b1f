//! `aspecta schema`: the JSON Schema of robot files.

use crate::failure::{Answer, Failure};
use crate::output;
use aspecta::robot::Robot;
use clap::Args;
use std::io::Write;

/// Arguments of `schema`: none.
#[derive(Args)]
pub struct Schema {}

impl Schema {
    pub fn run(&self, out: &mut dyn Write) -> Result<Answer, Failure> {
        output::json(out, &Robot::file_schema())?;
        Ok(Answer::Yes)
    }
}
