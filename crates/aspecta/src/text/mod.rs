//! Results in words and tables, as a terminal shows them: what [`Display`](std::fmt::Display) writes.

mod analysis;
mod domains;
pub mod doubt;
mod doubts;
mod remarks;
mod route;
mod table;

pub use analysis::{AnalysisAdvice, AnalysisSummary, EARLIER_NEED};
pub use aspecta_kinematics::path::PathSummary;
pub use aspecta_robot::text::{Labels, between, brief, det_a_unit, number, subscript, unsigned};
pub use domains::{DomainsAdvice, DomainsSummary};
pub use remarks::remarks;
pub use route::RouteSummary;
pub use table::{Align, Table};

/// Columns that text is broken for.
const WIDTH: usize = 100;

/// A text broken into lines, of which those after the first are indented.
pub fn paragraph(text: &str) -> String {
    textwrap::fill(text, textwrap::Options::new(WIDTH).subsequent_indent("  "))
}
