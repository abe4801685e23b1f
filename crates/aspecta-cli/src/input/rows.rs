//! CSV files of vectors, line by line.

use super::Columns;
use super::fields::Fields;
use super::lines::Lines;
use crate::failure::Failure;
use crate::output::note;
use aspecta_view::words::count;
use std::fmt::Display;
use std::fs::File;
use std::io::{self, BufRead, BufReader};

/// The most rows that are held at a time, where all of them are needed.
const MOST_HELD: usize = 1_000_000;

/// A line of a CSV file.
pub struct Row {
    /// Its line number.
    pub line: u64,
    /// Its numbers, in the order of the columns asked for; angles in rad.
    pub values: Vec<f64>,
    /// The entry of its `mode` column, if the header has one.
    pub mode: Option<String>,
}

/// All rows of a CSV file: [`Rows`], within bounds.
pub fn rows(path: &str, layouts: &[Columns], degrees: bool) -> Result<Vec<Row>, Failure> {
    held(Rows::open(path, layouts, degrees)?)
}

/// All of what rows lead to, where it is needed at a time.
pub fn held<T>(mut rows: impl Iterator<Item = Result<T, Failure>>) -> Result<Vec<T>, Failure> {
    let all = rows.by_ref().take(MOST_HELD).collect::<Result<Vec<_>, _>>()?;
    match rows.next() {
        None => Ok(all),
        Some(_) => Err(Failure::Input(format!(
            "more than {MOST_HELD} rows: this command holds all of them at a time"
        ))),
    }
}

/// The rows of a CSV file (`-` is stdin), each with the columns of one of `layouts` (the first that fits), one
/// at a time as they come. An input without any is an error.
///
/// A first line without any number is a header: then columns are found by name, in any order, and others
/// are ignored, so that what one command prints another can read. Empty lines and lines that start with
/// `#` are skipped.
pub struct Rows<'a> {
    name: &'a str,
    lines: Lines,
    line: u64,
    fields: Fields,
    layouts: &'a [Columns],
    shape: Option<Shape>,
    degrees: bool,
    /// Whether nan and inf are numbers too.
    unbounded: bool,
    ended: bool,
    any: bool,
}

impl<'a> Rows<'a> {
    /// Opens the file.
    pub fn open(path: &'a str, layouts: &'a [Columns], degrees: bool) -> Result<Self, Failure> {
        if path == "-" {
            return Ok(Self::of("stdin", Box::new(io::stdin().lock()), layouts, degrees));
        }
        let file = File::open(path).map_err(|e| Failure::Input(format!("cannot read `{path}`: {e}")))?;
        Ok(Self::of(path, Box::new(BufReader::new(file)), layouts, degrees))
    }

    /// Those of an input, with its name in messages.
    pub fn of(name: &'a str, input: Box<dyn BufRead>, layouts: &'a [Columns], degrees: bool) -> Self {
        let (lines, fields) = (Lines::of(input), Fields::default());
        let (shape, unbounded, ended, any) = (None, false, false, false);
        Self { name, lines, line: 0, fields, layouts, shape, degrees, unbounded, ended, any }
    }

    /// Takes numbers that are not finite too, which whoever reads the rows refuses: one of them does not end a stream.
    pub fn unbounded(self) -> Self {
        Self { unbounded: true, ..self }
    }

    /// A message about a line.
    pub fn at(&self, line: u64, message: impl Display) -> Failure {
        Failure::Input(format!("{}:{line}: {message}", self.name))
    }

    /// The row of a line, if it holds one.
    fn read(&mut self, text: &str) -> Result<Option<Row>, String> {
        let Some(text) = record(text) else { return Ok(None) };
        // Quotes after a blank are part of a field to the reader.
        let fields: Vec<&str> =
            self.fields.of(text).map(|field| field.trim().trim_matches('"').trim()).collect();
        if let [whole] = fields[..]
            && let Some(separator) = [';', '\t'].into_iter().find(|c| whole.contains(*c))
        {
            return Err(elsewise_separated(whole, separator));
        }
        let shape = match &self.shape {
            Some(shape) => shape,
            None => {
                let header = fields.iter().all(|field| field.parse::<f64>().is_err());
                let of = if header { Shape::of_header } else { Shape::of_row };
                let found = self.shape.insert(of(&fields, self.layouts)?);
                if header {
                    if self.degrees && found.is_printed() {
                        note(&format!(
                            "warning: {} has a column `mode`, as CSV that aspecta prints, whose angles are in radians; with --deg they are taken in degrees",
                            self.name
                        ));
                    }
                    return Ok(None);
                }
                found
            }
        };
        let mode = shape.mode.and_then(|k| fields.get(k)).map(|&mode| mode.to_owned());
        Ok(Some(Row { line: self.line, values: shape.read(&fields, self.degrees, self.unbounded)?, mode }))
    }

    fn next_row(&mut self) -> Result<Option<Row>, Failure> {
        while let Some(text) = self.lines.next() {
            self.line += 1;
            let text = text.map_err(|e| self.at(self.line, e))?;
            if let Some(row) = self.read(&text).map_err(|e| self.at(self.line, e))? {
                self.any = true;
                return Ok(Some(row));
            }
        }
        if self.any {
            return Ok(None);
        }
        let (name, wanted) = (self.name, wanted(self.layouts));
        Err(Failure::Input(format!("{name} holds no rows; one row of numbers is wanted a line: {wanted}")))
    }
}

impl Iterator for Rows<'_> {
    type Item = Result<Row, Failure>;
    fn next(&mut self) -> Option<Self::Item> {
        if self.ended {
            return None;
        }
        let row = self.next_row().transpose();
        self.ended = !matches!(row, Some(Ok(_)));
        row
    }
}

/// The record in a line, or `None` if it is empty or a comment; a spreadsheet's byte order mark is skipped.
fn record(line: &str) -> Option<&str> {
    let line = line.trim_start_matches('\u{feff}').trim();
    (!line.is_empty() && !line.starts_with('#')).then_some(line)
}

/// The positions of the wanted columns in a file.
struct Shape {
    columns: Columns,
    /// `fields[k]` is the index in the record of column k.
    fields: Vec<usize>,
    /// Fields a record must have; a headed file may hold more than is wanted, but no line of another length.
    width: usize,
    /// The column called `mode`.
    mode: Option<usize>,
}

impl Shape {
    fn of_header(header: &[&str], layouts: &[Columns]) -> Result<Self, String> {
        let find = |name: &String| header.iter().position(|field| field.eq_ignore_ascii_case(name));
        let fit = |c: &Columns| {
            let fields = c.names.iter().map(find).collect::<Option<Vec<_>>>()?;
            Some(Self { columns: c.clone(), fields, width: header.len(), mode: find(&"mode".to_owned()) })
        };
        layouts.iter().find_map(fit).ok_or_else(|| {
            format!("the header `{}` lacks a column; {} wanted", header.join(","), wanted(layouts))
        })
    }

    /// Whether it seems to be of angles that one of the commands has printed.
    fn is_printed(&self) -> bool {
        self.mode.is_some() && self.columns.angles.contains(&true)
    }

    fn of_row(row: &[&str], layouts: &[Columns]) -> Result<Self, String> {
        let fit = layouts.iter().find(|c| c.names.len() == row.len());
        let columns = fit
            .ok_or_else(|| format!("{}; {} wanted", count(row.len(), "field", "fields"), wanted(layouts)))?;
        Ok(Self { columns: columns.clone(), fields: (0..row.len()).collect(), width: row.len(), mode: None })
    }

    fn read(&self, record: &[&str], degrees: bool, unbounded: bool) -> Result<Vec<f64>, String> {
        if record.len() != self.width {
            return Err(format!(
                "{}, but the first line has {}",
                count(record.len(), "field", "fields"),
                self.width
            ));
        }
        let number = |(&field, name): (&usize, &String)| match record[field].parse::<f64>() {
            Ok(x) if unbounded || x.is_finite() => Ok(x),
            Ok(x) => Err(format!("column {}, {name}: {x} is not a finite number", field + 1)),
            Err(_) => Err(format!("column {}, {name}: `{}` is not a number", field + 1, record[field])),
        };
        let mut values =
            self.fields.iter().zip(&self.columns.names).map(number).collect::<Result<Vec<_>, _>>()?;
        self.columns.to_radians(&mut values, degrees);
        Ok(values)
    }
}

/// Returns the message about a line without a comma, as spreadsheets write it where numbers hold commas.
fn elsewise_separated(line: &str, separator: char) -> String {
    let name = if separator == ';' { "semicolons" } else { "tabs" };
    format!(
        "`{line}` has {name} and no commas: separate the fields by commas, and write numbers with a point, 0.5"
    )
}

fn wanted(layouts: &[Columns]) -> String {
    layouts.iter().map(|c| format!("`{}`", c.names.join(","))).collect::<Vec<_>>().join(" or ")
}
