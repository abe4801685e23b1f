//! From a place in the text (a span of bytes) to line, column, key and value.

use super::error::{FileError, Mistake, Problem, closest};
use super::format::hint;
use crate::Platform;
use crate::legs::Kind;
use std::ops::Range as Span;
use toml::de::{DeTable, DeValue};

/// A problem and the bytes of the text it is about.
#[derive(Debug)]
pub(crate) struct Fault {
    pub span: Span<usize>,
    pub problem: Problem,
}

impl Fault {
    pub fn new(span: &Span<usize>, problem: Problem) -> Self {
        Self { span: span.clone(), problem }
    }

    /// Translates an error of serde or the TOML parser into the words of robot files. Their messages name
    /// keys and values in backquotes; the tests of the messages hold that to be so.
    pub fn from_serde(error: &toml::de::Error, text: &str, tree: &DeTable<'_>) -> Self {
        let message = error.message();
        let span = error.span().unwrap_or(text.len()..text.len());
        let mut quoted = message.split('`').skip(1).step_by(2).map(str::to_owned);
        let problem = if message.starts_with("unknown field") || message.starts_with("unknown variant") {
            let wrong = quoted.next().unwrap_or_default();
            let mut known: Vec<_> = quoted.collect();
            if let Some(taken) = keys_taken(tree, &span) {
                known.retain(|key| key == "kind" || taken.contains(&key.as_str()));
            }
            let closest = closest(&wrong, known.iter().map(String::as_str));
            match message.starts_with("unknown field") {
                true => Problem::UnknownKey { closest, known },
                false => Problem::UnknownName { closest, known },
            }
        } else if message.starts_with("missing field") {
            let key = quoted.next().unwrap_or_default();
            Problem::MissingKey { hint: hint(&key), key }
        } else {
            let reason = message.trim_start_matches("invalid type: ").trim_start_matches("invalid value: ");
            Problem::WrongType(reason.replace("a sequence", "a list in brackets"))
        };
        Self { span, problem }
    }

    pub fn from_parser(error: &toml::de::Error, text: &str) -> Self {
        let span = error.span().unwrap_or(text.len()..text.len());
        let problem = match error.message() {
            "duplicate key" => Problem::DuplicateKey(text.get(span.clone()).unwrap_or_default().to_owned()),
            other => Problem::Syntax(other.to_owned()),
        };
        Self { span, problem }
    }

    /// The message for people.
    pub fn locate(self, file: &str, text: &str, tree: Option<&DeTable<'_>>) -> FileError {
        let start = self.span.start.min(text.len());
        let line_start = text[..start].rfind('\n').map_or(0, |k| k + 1);
        let source_line = text[line_start..].lines().next().unwrap_or_default();
        let column = text[line_start..start].chars().count() + 1;
        let marked = text.get(start..self.span.end).unwrap_or_default();
        let (key, is_value) = tree.map(|t| key_at(t, &self.span)).unwrap_or_default();
        let value = if is_value && !marked.contains('\n') { marked } else { "" };
        let width = marked.lines().next().unwrap_or_default().chars().count().max(1);
        Box::new(Mistake {
            file: file.to_owned(),
            line: text[..start].matches('\n').count() + 1,
            column,
            key,
            value: value.to_owned(),
            problem: self.problem,
            source_line: source_line.to_owned(),
            width,
        })
        .into()
    }
}

/// The keys that the actuator with a key at `span` takes beside `kind`, if there is one and its kind is
/// known.
fn keys_taken(tree: &DeTable<'_>, span: &Span<usize>) -> Option<&'static [&'static str]> {
    let word = |table: &DeTable<'_>, key: &str| Some(table.get(key)?.get_ref().as_str()?.to_owned());
    let legs = tree.get("legs")?.get_ref().as_array()?;
    let mut actuators = legs.iter().filter_map(|leg| leg.get_ref().get("actuator")?.get_ref().as_table());
    let actuator = actuators.find(|table| table.keys().any(|key| key.span() == *span))?;
    let name = word(actuator, "kind")?;
    let kind = Kind::ALL.iter().find(|kind| kind.name() == name)?;
    let platform = word(tree, "platform").unwrap_or_default();
    let space = Platform::ALL.into_iter().find(|p| p.name() == platform).map_or(3, Platform::space);
    Some(kind.facts().keys(space))
}

/// The key at `span`, as in `legs[2].actuator.crank`, and whether `span` is that of its value (rather than
/// of the key or of a table's header).
fn key_at(tree: &DeTable<'_>, span: &Span<usize>) -> (String, bool) {
    let mut best = Found { length: usize::MAX, key: String::new(), is_value: false };
    search_table(tree, &mut Vec::new(), span, &mut best);
    (best.key, best.is_value)
}

/// A step from a table or list into it.
#[derive(Clone, Copy, PartialEq)]
enum Step<'a> {
    Key(&'a str),
    /// From 0.
    Item(usize),
}

/// Steps as they are written: `legs[2].actuator`.
fn key_of(path: &[Step<'_>]) -> String {
    let step = |(k, step): (usize, &Step<'_>)| match step {
        Step::Key(name) if k == 0 => (*name).to_owned(),
        Step::Key(name) => format!(".{name}"),
        Step::Item(item) => format!("[{}]", item + 1),
    };
    path.iter().enumerate().map(step).collect()
}

/// The shortest span met so far that holds the wanted one.
struct Found {
    length: usize,
    key: String,
    is_value: bool,
}

impl Found {
    fn offer(&mut self, candidate: Span<usize>, span: &Span<usize>, path: &[Step<'_>], is_value: bool) {
        // The file as a whole has an empty span: no key holds it, whichever comes first.
        let holds = !span.is_empty() && candidate.start <= span.start && span.end <= candidate.end;
        // On a tie the deeper one, which comes later, is meant.
        if holds && candidate.len() <= self.length {
            *self = Self { length: candidate.len(), key: key_of(path), is_value };
        }
    }
}

fn search_table<'a>(table: &'a DeTable<'_>, path: &mut Vec<Step<'a>>, span: &Span<usize>, best: &mut Found) {
    for (name, value) in table {
        path.push(Step::Key(name.get_ref()));
        best.offer(name.span(), span, path, false);
        search_value(value.get_ref(), value.span(), path, span, best);
        path.pop();
    }
}

fn search_value<'a>(
    value: &'a DeValue<'_>,
    at: Span<usize>,
    path: &mut Vec<Step<'a>>,
    span: &Span<usize>,
    best: &mut Found,
) {
    // The span of a [table] is its header, which is no value; that of { … } is one, but too long to repeat.
    let is_value = !value.is_table() && *path != [Step::Key("legs")];
    best.offer(at, span, path, is_value);
    match value {
        DeValue::Table(table) => search_table(table, path, span, best),
        DeValue::Array(items) => {
            for (k, item) in items.iter().enumerate() {
                path.push(Step::Item(k));
                search_value(item.get_ref(), item.span(), path, span, best);
                path.pop();
            }
        }
        DeValue::String(_)
        | DeValue::Integer(_)
        | DeValue::Float(_)
        | DeValue::Boolean(_)
        | DeValue::Datetime(_) => {}
    }
}
