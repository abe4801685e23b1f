//! Numbers from the command line and from CSV files.

use crate::failure::Failure;
use aspecta::domain::Map;
use aspecta::kinematics::WorkingMode;
use aspecta::robot::Robot;
use aspecta_view::words::count;
use std::fmt::Display;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read};
use std::path::Path;

/// Named numbers that are read together: the coordinates of a pose or of a joint vector.
#[derive(Clone)]
pub struct Columns {
    /// The names, as in CSV headers.
    pub names: Vec<String>,
    /// Which of them are angles.
    pub angles: Vec<bool>,
}

impl Columns {
    /// X, in the order of the platform's coordinates.
    pub fn pose(robot: &Robot) -> Self {
        let coordinates = robot.platform.coordinates();
        Self {
            names: coordinates.iter().map(|c| c.name.to_owned()).collect(),
            angles: coordinates.iter().map(|c| c.angle).collect(),
        }
    }

    /// q, as q1, q2, …
    pub fn joints(robot: &Robot) -> Self {
        Self {
            names: (1..=robot.dof()).map(|k| format!("q{k}")).collect(),
            angles: robot.legs.iter().map(|l| l.actuator.is_angle()).collect(),
        }
    }

    /// These and then `more`.
    pub fn and(mut self, more: &Self) -> Self {
        self.names.extend_from_slice(&more.names);
        self.angles.extend_from_slice(&more.angles);
        self
    }

    /// Degrees to radians, where `values` are angles given in degrees.
    fn to_radians(&self, values: &mut [f64], degrees: bool) {
        if degrees {
            let angles = values.iter_mut().zip(&self.angles).filter(|(_, angle)| **angle);
            angles.for_each(|(x, _)| *x = x.to_radians());
        }
    }
}

/// A comma-separated list given to `option`. How many numbers there should be is for the robot to say.
pub fn list(option: &str, text: &str, columns: &Columns, degrees: bool) -> Result<Vec<f64>, Failure> {
    let number = |(k, field): (usize, &str)| {
        let field = field.trim();
        field.parse::<f64>().map_err(|_| {
            let names = columns.names.join(",");
            Failure::Input(format!(
                "{option}: number {} of `{text}`, `{field}`, is not a number; write {names} separated by commas",
                k + 1
            ))
        })
    };
    let mut values = text.split(',').enumerate().map(number).collect::<Result<Vec<_>, _>>()?;
    columns.to_radians(&mut values, degrees);
    Ok(values)
}

/// Whether a file may be a map, as far as its first bytes tell.
pub fn is_map(path: &Path) -> bool {
    let mut mark = [0; 2];
    File::open(path).and_then(|mut file| file.read_exact(&mut mark)).is_ok() && Map::is_map(&mark)
}

/// The robot of a catalogue name or of a file.
pub fn robot(name_or_path: &str) -> Result<Robot, Failure> {
    if is_map(name_or_path.as_ref()) {
        return Err(Failure::Input(format!(
            "`{name_or_path}` is a map of a robot's aspects, for `aspecta locate` and `aspecta domains`: give the robot's name or file"
        )));
    }
    Ok(Robot::resolve(name_or_path)?)
}

/// The working mode given to `--mode`, which must be one of the robot's.
pub fn mode(robot: &Robot, text: &str) -> Result<WorkingMode, Failure> {
    let modes = robot.working_modes();
    let given = text.parse().ok().filter(|m| modes.contains(m));
    given.ok_or_else(|| {
        let names: Vec<_> = modes.iter().map(WorkingMode::to_string).collect();
        Failure::Input(format!(
            "--mode: `{text}` is not a working mode of `{}`; it has {}",
            robot.name,
            names.join(", ")
        ))
    })
}

/// The working modes given to `--mode`, each once.
pub fn modes(robot: &Robot, given: &[String]) -> Result<Vec<WorkingMode>, Failure> {
    let mut modes = Vec::new();
    for text in given {
        let mode = mode(robot, text.trim())?;
        if !modes.contains(&mode) {
            modes.push(mode);
        }
    }
    Ok(modes)
}

/// A line of a CSV file.
pub struct Row {
    /// Its line number.
    pub line: u64,
    /// Its numbers, in the order of the columns asked for; angles in rad.
    pub values: Vec<f64>,
    /// What its `mode` column says, if the header has one.
    pub mode: Option<String>,
}

/// The rows of a CSV file (`-` is stdin), each with the columns of one of `layouts` (the first that fits).
///
/// A first line without any number is a header: then columns are found by name, in any order, and others
/// are ignored, so that what one command prints another can read. Empty lines and lines that start with
/// `#` are skipped.
pub fn rows(path: &str, layouts: &[Columns], degrees: bool) -> Result<Vec<Row>, Failure> {
    Rows::open(path, layouts, degrees)?.collect()
}

/// [`rows`], one at a time as they come. An input without any is an error.
pub struct Rows<'a> {
    name: &'a str,
    lines: Box<dyn Iterator<Item = io::Result<String>>>,
    line: u64,
    layouts: &'a [Columns],
    shape: Option<Shape>,
    degrees: bool,
    ended: bool,
    any: bool,
}

impl<'a> Rows<'a> {
    /// Opens the file.
    pub fn open(path: &'a str, layouts: &'a [Columns], degrees: bool) -> Result<Self, Failure> {
        let lines: Box<dyn Iterator<Item = _>> = match path {
            "-" => Box::new(io::stdin().lock().lines()),
            _ => {
                let file =
                    File::open(path).map_err(|e| Failure::Input(format!("cannot read `{path}`: {e}")))?;
                Box::new(BufReader::new(file).lines())
            }
        };
        let name = if path == "-" { "stdin" } else { path };
        Ok(Self { name, lines, line: 0, layouts, shape: None, degrees, ended: false, any: false })
    }

    /// A message about a line.
    pub fn at(&self, line: u64, message: impl Display) -> Failure {
        Failure::Input(format!("{}:{line}: {message}", self.name))
    }

    /// The row of a line, if it holds one.
    fn read(&mut self, text: &str) -> Result<Option<Row>, String> {
        let Some(fields) = fields(text) else { return Ok(None) };
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
                    return Ok(None);
                }
                found
            }
        };
        let mode = shape.mode.and_then(|k| fields.get(k)).map(|&mode| mode.to_owned());
        Ok(Some(Row { line: self.line, values: shape.read(&fields, self.degrees)?, mode }))
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

/// The fields of a line, or `None` if it is empty or a comment. Numbers and names hold no commas, so quotes are
/// only stripped; a spreadsheet's byte order mark is skipped.
fn fields(line: &str) -> Option<Vec<&str>> {
    let line = line.trim_start_matches('\u{feff}').trim();
    let filled = !line.is_empty() && !line.starts_with('#');
    filled.then(|| line.split(',').map(|field| field.trim().trim_matches('"').trim()).collect())
}

/// Where the wanted columns stand in a file.
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

    fn of_row(row: &[&str], layouts: &[Columns]) -> Result<Self, String> {
        let fit = layouts.iter().find(|c| c.names.len() == row.len());
        let columns = fit
            .ok_or_else(|| format!("{}; {} wanted", count(row.len(), "field", "fields"), wanted(layouts)))?;
        Ok(Self { columns: columns.clone(), fields: (0..row.len()).collect(), width: row.len(), mode: None })
    }

    fn read(&self, record: &[&str], degrees: bool) -> Result<Vec<f64>, String> {
        if record.len() != self.width {
            return Err(format!(
                "{}, but the first line has {}",
                count(record.len(), "field", "fields"),
                self.width
            ));
        }
        let number = |(&field, name): (&usize, &String)| match record[field].parse::<f64>() {
            Ok(x) if x.is_finite() => Ok(x),
            Ok(x) => Err(format!("column {}, {name}: {x} is not a finite number", field + 1)),
            Err(_) => Err(format!("column {}, {name}: `{}` is not a number", field + 1, record[field])),
        };
        let mut values =
            self.fields.iter().zip(&self.columns.names).map(number).collect::<Result<Vec<_>, _>>()?;
        self.columns.to_radians(&mut values, degrees);
        Ok(values)
    }
}

/// What is said of a line without a comma, as spreadsheets write it where numbers hold commas.
fn elsewise_separated(line: &str, separator: char) -> String {
    let name = if separator == ';' { "semicolons" } else { "tabs" };
    format!(
        "`{line}` has {name} and no commas: separate the fields by commas, and write numbers with a point, 0.5"
    )
}

fn wanted(layouts: &[Columns]) -> String {
    layouts.iter().map(|c| format!("`{}`", c.names.join(","))).collect::<Vec<_>>().join(" or ")
}
