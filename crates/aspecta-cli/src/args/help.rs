//! The purpose of a shared option in one command: `#[command(mut_args(help("mode", "Only …")))]`.
//!
//! `mut_args` keeps the order of options, which `mut_arg` does not.

use clap::Arg;

/// Gives an option its help.
pub fn help(option: &'static str, text: &'static str) -> impl FnMut(Arg) -> Arg {
    move |argument| if argument.get_id() == option { argument.help(text) } else { argument }
}

/// Gives the value of an option another name.
pub fn value_name(option: &'static str, name: &'static str) -> impl FnMut(Arg) -> Arg {
    move |argument| if argument.get_id() == option { argument.value_name(name) } else { argument }
}
