//! The vectors a command is asked about: one from the command line or many from a CSV file.

use crate::failure::Failure;
use crate::input::{self, Columns};

/// One vector asked about.
pub struct Query {
    /// Its line, if it comes from a file.
    pub line: Option<u64>,
    /// Its numbers; angles in rad.
    pub values: Vec<f64>,
}

/// Reads the value of `option`, or the rows of `file` in one of `layouts`; clap sees to it that one of both is there.
pub fn queries(
    option: &str,
    value: Option<&str>,
    file: Option<&str>,
    layouts: &[Columns],
    degrees: bool,
) -> Result<Vec<Query>, Failure> {
    if let Some(path) = file {
        let rows = input::rows(path, layouts, degrees)?;
        return Ok(rows.into_iter().map(|r| Query { line: Some(r.line), values: r.values }).collect());
    }
    let values = input::list(option, value.unwrap_or_default(), &layouts[0], degrees)?;
    Ok(vec![Query { line: None, values }])
}
