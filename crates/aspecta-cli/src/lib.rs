//! `aspecta`: the command line. What it prints and how it ends is a contract that scripts rely on:
//! results on stdout (with `--json` nothing but JSON), messages on stderr, exit status 0 done, 1 ran
//! but the answer is negative or undecided, 2 bad input.
//!
//! It is a library so that its readers of input can be fuzzed; what programs are to call is in `aspecta`.

mod args;
mod commands;
mod failure;
#[doc(hidden)]
pub mod fuzz;
mod input;
mod output;
mod show;
mod work;

use clap::Parser;
use commands::Command;
use failure::{Answer, Failure};
use std::env;
use std::ffi::OsString;
use std::io::{self, BufWriter, ErrorKind, Write};
use std::process::ExitCode;

/// Which solution is a parallel robot in, and where can it go from there without meeting a singularity?
///
/// Inverse and direct solutions, working modes, singularities and certified generalized aspects
/// (Chablat & Wenger 2001) of any fully parallel robot that a robot file can describe.
#[derive(Parser)]
#[command(name = "aspecta", version, after_help = EXIT_STATUS)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

const EXIT_STATUS: &str = "\
ROBOT is a name from `aspecta robots` or the path of a robot file.
A working mode is given by its signs, `--mode +-`, or by the postures of its legs, `--mode left,right` (docs/robot-files.md).
Exit status: 0 done; 1 ran, but the answer is negative or undecided; 2 bad input.";

/// Runs the command that the program's arguments name.
pub fn main() -> ExitCode {
    ExitCode::from(run(env::args_os()))
}

/// Runs the command that some arguments name, the first being the program itself, and returns its exit status.
/// Arguments that are wrong, and requests for help, end the process, as clap has it.
pub fn run(arguments: impl IntoIterator<Item = impl Into<OsString> + Clone>) -> u8 {
    let cli = Cli::parse_from(arguments);
    // Not locked: an interrupt may have a document to end.
    let mut out = BufWriter::new(io::stdout());
    let answer = cli.command.run(&mut out).and_then(|answer| {
        out.flush()?;
        Ok(answer)
    });
    match answer {
        Ok(Answer::Yes) => 0,
        Ok(Answer::No) => 1,
        // The reader has seen enough, as in `aspecta robots | head -1`.
        Err(Failure::Output(e)) if e.kind() == ErrorKind::BrokenPipe => 0,
        Err(failure) => {
            output::note(&format!("error: {failure}"));
            2
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Cli;
    use clap::{Command, CommandFactory};

    /// Options that several commands share get their help from each.
    #[test]
    fn every_option_of_every_command_has_a_help() {
        fn check(command: &Command) {
            for argument in command.get_arguments() {
                let name = format!("{} {}", command.get_name(), argument.get_id());
                assert!(argument.get_help().is_some(), "{name} has no help");
            }
            command.get_subcommands().for_each(check);
        }
        let mut cli = Cli::command();
        cli.build();
        check(&cli);
    }
}
