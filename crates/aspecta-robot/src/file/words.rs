//! Names and other words of a robot file, which are printed in messages, tables and headings.

use super::error::Problem;
use super::format::At;
use super::locate::Fault;

/// A name: something to call the robot by.
pub(super) fn name(text: &At<String>) -> Result<&str, Fault> {
    if text.value.trim().is_empty() {
        return Err(Fault::new(&text.span, Problem::Nameless));
    }
    line(text)
}

/// Replaces `field` by what the file gives, if it does.
pub(super) fn set(field: &mut String, given: &Option<At<String>>) -> Result<(), Fault> {
    if let Some(text) = given {
        *field = line(text)?.to_owned();
    }
    Ok(())
}

/// Words in one line.
fn line(text: &At<String>) -> Result<&str, Fault> {
    match is_line(&text.value) {
        true => Ok(&text.value),
        false => Err(Fault::new(&text.span, Problem::NotOneLine)),
    }
}

/// Whether words stay in one line: no control characters, which would break a table or a terminal.
pub(crate) fn is_line(text: &str) -> bool {
    !text.contains(char::is_control)
}
