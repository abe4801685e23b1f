//! Sentences of any length on a terminal.

use crate::failure::Failure;
use std::io::Write;

/// Columns of the terminal that text is broken for.
const WIDTH: usize = 100;

/// Prints a paragraph: further lines are indented.
pub fn paragraph(out: &mut dyn Write, text: &str) -> Result<(), Failure> {
    let options = textwrap::Options::new(WIDTH).subsequent_indent("  ");
    Ok(writeln!(out, "{}", textwrap::fill(text, options))?)
}
