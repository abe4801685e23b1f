//! `aspecta completions`: completion scripts.

use crate::Cli;
use crate::failure::{Answer, Failure};
use clap::{Args, CommandFactory};
use clap_complete::Shell;
use std::io::Write;

/// Arguments of `completions`.
#[derive(Args)]
pub struct Completions {
    /// The shell
    shell: Shell,
}

impl Completions {
    pub fn run(&self, out: &mut dyn Write) -> Result<Answer, Failure> {
        // `generate` panics when its writer fails: print from memory.
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut Cli::command(), "aspecta", &mut script);
        out.write_all(&script)?;
        Ok(Answer::Yes)
    }
}
