//! Output for people, scripts and spreadsheets.

mod about;
mod answers;
pub mod stream;
mod target;
mod zeros;

pub use about::About;
pub use answers::{Shown, print_each};
pub use aspecta::text::{Align, Labels, Table, brief, det_a_unit, number, unsigned};
pub use target::Target;

use crate::failure::Failure;
use aspecta::robot::is_unprintable;
use serde::Serialize;
use serde_json::ser::{CompactFormatter, Formatter, PrettyFormatter, Serializer};
use std::io::{self, Write};
use zeros::UnsignedZeros;

/// Version of the JSON of `ik`, `fk`, `state`, `check-path` and `time`; raised when a field changes its meaning
/// or goes away.
pub const FORMAT_VERSION: u32 = 1;

/// How results are printed.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// An aligned table for people.
    Table,
    /// JSON.
    Json,
    /// CSV with a header.
    Csv,
}

impl Format {
    /// Says something beside the results, such as where a file is: below a table; else on stderr, for stdout holds nothing
    /// but the results.
    pub fn say(self, out: &mut dyn Write, text: &str) -> Result<(), Failure> {
        match self {
            Self::Table => writeln!(out, "{text}")?,
            Self::Json | Self::Csv => note(text),
        }
        Ok(())
    }
}

/// Writes `value` as one JSON document.
pub fn json(out: &mut dyn Write, value: &impl Serialize) -> Result<(), Failure> {
    json_in(out, value, PrettyFormatter::new())
}

/// Writes `value` as JSON in one line.
pub fn json_line(out: &mut dyn Write, value: &impl Serialize) -> Result<(), Failure> {
    json_in(out, value, CompactFormatter)
}

fn json_in(out: &mut dyn Write, value: &impl Serialize, layout: impl Formatter) -> Result<(), Failure> {
    value.serialize(&mut Serializer::with_formatter(&mut *out, UnsignedZeros(layout)))?;
    writeln!(out)?;
    Ok(())
}

/// A message to the user on stderr. There is nobody to tell if stderr is closed.
///
/// What of a file is in it cannot move the terminal.
pub fn note(message: &str) {
    let _ = writeln!(io::stderr(), "{}", printable(message));
}

/// A message in which characters that cannot be seen are written out, as `\u{1b}`.
fn printable(message: &str) -> String {
    let shown = |c: char| match c {
        '\n' | '\t' => c.to_string(),
        c if is_unprintable(c) => c.escape_unicode().to_string(),
        c => c.to_string(),
    };
    message.chars().map(shown).collect()
}

/// A number for machines: the shortest that reads back as the same.
pub fn exact(x: f64) -> String {
    format!("{:?}", unsigned(x))
}
