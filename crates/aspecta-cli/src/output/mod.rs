//! What people, scripts and spreadsheets read.

mod answers;
mod labels;
mod paragraph;
mod table;
mod target;
mod zeros;

pub use answers::json_of_each;
pub use labels::{Labels, det_a_unit};
pub use paragraph::paragraph;
pub use table::{Align, Table};
pub use target::Target;

use crate::failure::Failure;
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
pub fn note(message: &str) {
    let _ = writeln!(io::stderr(), "{message}");
}

/// A number for people: six decimals, or six digits and a power of ten where these would not show it.
pub fn number(x: f64) -> String {
    let size = x.abs();
    if size == 0.0 || (1e-3..1e7).contains(&size) {
        format!("{:.6}", unsigned(x))
    } else {
        format!("{x:.5e}")
    }
}

/// A number for people, in five digits.
pub fn brief(x: f64) -> String {
    let size = x.abs();
    if size == 0.0 {
        return "0".into();
    }
    if !(1e-4..1e6).contains(&size) {
        return format!("{x:.3e}");
    }
    let decimals = (4 - size.log10().floor() as i32).clamp(0, 4) as usize;
    format!("{x:.decimals$}")
}

/// A number for machines: the shortest that reads back as the same.
pub fn exact(x: f64) -> String {
    format!("{:?}", unsigned(x))
}

/// The number with a zero that has no sign: nobody asks from which side it is one.
pub fn unsigned(x: f64) -> f64 {
    x + 0.0
}
