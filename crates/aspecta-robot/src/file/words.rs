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

/// Whether words stay in one line and are what they look like: no [`is_unprintable`] characters.
pub(crate) fn is_line(text: &str) -> bool {
    !text.contains(is_unprintable)
}

/// Whether a character would move a terminal, break a table, or be seen as nothing: control characters, and
/// those of no width or that turn the direction of writing, by which one name can look like another.
pub fn is_unprintable(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{ad}' | '\u{61c}' | '\u{180e}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}')
}
