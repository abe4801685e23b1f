//! Results in words and tables, as a terminal shows them: what [`Display`](std::fmt::Display) writes.

mod analysis;
pub mod doubt;
mod doubts;
mod labels;
mod numbers;
mod table;

pub use analysis::{Advice, EARLIER_NEED, Summary};
pub use labels::{Labels, det_a_unit};
pub use numbers::{between, brief, number, unsigned};
pub use table::{Align, Table};

/// Columns that text is broken for.
const WIDTH: usize = 100;

/// A text broken into lines, of which those after the first are indented.
pub fn paragraph(text: &str) -> String {
    textwrap::fill(text, textwrap::Options::new(WIDTH).subsequent_indent("  "))
}
