//! Prints what is found of the vectors a command is asked about: each as soon as it is found, however many
//! there are.

use super::{About, Format, json, stream};
use crate::failure::{Answer, Failure};
use aspecta::robot::Robot;
use serde::ser::SerializeSeq;
use serde::{Serialize, Serializer};
use std::cell::RefCell;
use std::io::{self, Write};
use std::iter;

/// The most lines of a table, whose columns are as wide as the widest of their entries: it is held as a whole.
const MOST_IN_TABLE: usize = 100_000;

/// How a command shows what it finds of a vector.
pub trait Shown {
    /// What is found of one.
    type Found;

    /// The robot.
    fn robot(&self) -> &Robot;

    /// The line of the vector, if it comes from a file.
    fn line(&self, found: &Self::Found) -> Option<u64>;

    /// Whether the answer is positive.
    fn is_positive(&self, found: &Self::Found) -> bool;

    /// What JSON says of it, beside its line.
    fn json(&self, found: &Self::Found) -> impl Serialize;

    /// The columns of CSV, beside the line.
    fn columns(&self) -> Vec<String>;

    /// Its records of CSV, beside the line.
    fn records(&self, found: &Self::Found) -> Vec<Vec<String>>;

    /// How many lines of a table it makes.
    fn lines(&self, found: &Self::Found) -> usize;

    /// Writes the table of all that was found.
    fn table(&self, out: &mut dyn Write, found: &[Self::Found]) -> Result<(), Failure>;
}

/// Prints what is found, up to the first failure, and says whether all answers are positive.
pub fn print_each<S: Shown>(
    out: &mut dyn Write,
    shown: &S,
    format: Format,
    found: impl Iterator<Item = Result<S::Found, Failure>>,
) -> Result<Answer, Failure> {
    let out = Shared(RefCell::new(out));
    let mut positive = true;
    let mut found = UpToFailure { found, out: &out, failure: None };
    let mut answers = found.by_ref().inspect(|found| positive &= shown.is_positive(found));
    match format {
        Format::Json => print_json(&out, shown, &mut answers)?,
        Format::Csv => print_csv(&out, shown, &mut answers)?,
        Format::Table => print_table(&out, shown, &mut answers)?,
    }
    found.failure.map_or(Ok(Answer::from(positive)), Err)
}

/// JSON: the list of what was found, of the rows of a file with their lines; of one vector it stands at the top
/// too.
fn print_json<S: Shown>(
    mut out: &Shared<'_>,
    shown: &S,
    found: &mut dyn Iterator<Item = S::Found>,
) -> Result<(), Failure> {
    let Some(first) = found.next() else { return Ok(()) };
    let about = About::of(shown.robot());
    if shown.line(&first).is_none() {
        let answer = &shown.json(&first);
        return json(&mut out, &One { about, answer, results: [answer] });
    }
    stream::begin();
    let found = RefCell::new(iter::once(first).chain(found));
    json(&mut out, &Many { about, results: Results { shown, found } })?;
    stream::done();
    Ok(())
}

/// CSV: a header, and records with the line in front.
fn print_csv<S: Shown>(
    out: &Shared<'_>,
    shown: &S,
    found: &mut dyn Iterator<Item = S::Found>,
) -> Result<(), Failure> {
    let mut csv = csv::Writer::from_writer(out);
    let mut header = Some(shown.columns());
    for found in found {
        if let Some(columns) = header.take() {
            csv.write_record(iter::once("line".to_owned()).chain(columns))?;
        }
        let line = shown.line(&found).map_or(String::new(), |line| line.to_string());
        for record in shown.records(&found) {
            csv.write_record(iter::once(line.clone()).chain(record))?;
        }
        csv.flush()?;
    }
    Ok(())
}

fn print_table<S: Shown>(
    mut out: &Shared<'_>,
    shown: &S,
    found: &mut dyn Iterator<Item = S::Found>,
) -> Result<(), Failure> {
    let (mut held, mut lines) = (Vec::new(), 0);
    for found in found {
        lines += shown.lines(&found).max(1);
        if lines > MOST_IN_TABLE {
            shown.table(&mut out, &held)?;
            let line = shown.line(&found).unwrap_or_default();
            return Err(Failure::Input(format!(
                "line {line}: a table holds at most {MOST_IN_TABLE} lines; --csv and --json print any number, as they come"
            )));
        }
        held.push(found);
    }
    if held.is_empty() { Ok(()) } else { shown.table(&mut out, &held) }
}

/// What is found, up to the first failure. What is printed of it goes out before the next is waited for.
struct UpToFailure<'a, I> {
    found: I,
    out: &'a Shared<'a>,
    failure: Option<Failure>,
}

impl<T, I: Iterator<Item = Result<T, Failure>>> Iterator for UpToFailure<'_, I> {
    type Item = T;

    fn next(&mut self) -> Option<T> {
        if self.failure.is_some() {
            return None;
        }
        let flushed = self.out.0.borrow_mut().flush().map_err(Failure::from);
        stream::wait();
        let next = flushed.and_then(|()| self.found.next().transpose());
        stream::go_on();
        next.unwrap_or_else(|failure| {
            self.failure = Some(failure);
            None
        })
    }
}

/// An output that is written to and flushed from two places.
struct Shared<'a>(RefCell<&'a mut dyn Write>);

impl Write for &Shared<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.borrow_mut().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.borrow_mut().flush()
    }
}

#[derive(Serialize)]
struct One<'a, T> {
    #[serde(flatten)]
    about: About<'a>,
    #[serde(flatten)]
    answer: T,
    results: [T; 1],
}

#[derive(Serialize)]
struct Many<'a, R> {
    #[serde(flatten)]
    about: About<'a>,
    results: R,
}

#[derive(Serialize)]
struct InLine<T> {
    line: u64,
    #[serde(flatten)]
    answer: T,
}

/// A list that is found while it is written.
struct Results<'a, S, I> {
    shown: &'a S,
    found: RefCell<I>,
}

impl<S: Shown, I: Iterator<Item = S::Found>> Serialize for Results<'_, S, I> {
    fn serialize<W: Serializer>(&self, serializer: W) -> Result<W::Ok, W::Error> {
        let mut results = serializer.serialize_seq(None)?;
        for found in self.found.borrow_mut().by_ref() {
            let line = self.shown.line(&found).unwrap_or_default();
            results.serialize_element(&InLine { line, answer: self.shown.json(&found) })?;
        }
        results.end()
    }
}
