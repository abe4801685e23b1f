//! The vectors a command is asked about: one from the command line or many from a CSV file.

use crate::failure::Failure;
use crate::input::{self, Columns};
use crate::output::{self, FORMAT_VERSION};
use aspecta::robot::Robot;
use serde::Serialize;
use std::io::Write;

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

/// JSON: what was found of one vector, at the top; or of many, a list with their lines.
pub fn print_json<T: Serialize>(
    out: &mut dyn Write,
    robot: &Robot,
    mut answers: Vec<(Option<u64>, T)>,
) -> Result<(), Failure> {
    let (format_version, robot) = (FORMAT_VERSION, robot.name.as_str());
    if matches!(answers[..], [(None, _)])
        && let Some((_, answer)) = answers.pop()
    {
        return output::json(out, &One { format_version, robot, answer });
    }
    let results = answers.into_iter().map(|(line, answer)| InLine { line: line.unwrap_or_default(), answer });
    output::json(out, &Many { format_version, robot, results: results.collect() })
}

#[derive(Serialize)]
struct One<'a, T> {
    format_version: u32,
    robot: &'a str,
    #[serde(flatten)]
    answer: T,
}

#[derive(Serialize)]
struct Many<'a, T> {
    format_version: u32,
    robot: &'a str,
    results: Vec<InLine<T>>,
}

#[derive(Serialize)]
struct InLine<T> {
    line: u64,
    #[serde(flatten)]
    answer: T,
}

/// Which legs do not reach `pose`, in a sentence.
pub fn out_of_reach(robot: &Robot, pose: &[f64]) -> Result<String, Failure> {
    let legs = robot.out_of_reach(pose)?.into_iter().map(|leg| {
        let unit = if leg.angle { "rad" } else { &robot.length_unit };
        format!("leg {} by {} {unit}", leg.leg, output::number(leg.gap))
    });
    Ok(format!("out of reach: {}", legs.collect::<Vec<_>>().join(", ")))
}

/// Prints vectors as people read them: names, units, degrees if asked for.
pub struct Labels {
    columns: Columns,
    units: Vec<String>,
    degrees: bool,
}

impl Labels {
    /// Labels of pose coordinates.
    pub fn pose(robot: &Robot, degrees: bool) -> Self {
        Self::of(Columns::pose(robot), robot, degrees)
    }

    /// Labels of joint coordinates.
    pub fn joints(robot: &Robot, degrees: bool) -> Self {
        Self::of(Columns::joints(robot), robot, degrees)
    }

    fn of(columns: Columns, robot: &Robot, degrees: bool) -> Self {
        let angle = if degrees { "deg" } else { "rad" };
        let unit = |is_angle: &bool| if *is_angle { angle } else { &*robot.length_unit }.to_owned();
        Self { units: columns.angles.iter().map(unit).collect(), columns, degrees }
    }

    /// Those of some coordinates, by index.
    pub fn only(mut self, which: &[usize]) -> Self {
        self.columns.names = which.iter().map(|&k| self.columns.names[k].clone()).collect();
        self.columns.angles = which.iter().map(|&k| self.columns.angles[k]).collect();
        self.units = which.iter().map(|&k| self.units[k].clone()).collect();
        self
    }

    /// Column headings: `x [mm]`.
    pub fn headings(&self) -> impl Iterator<Item = String> + '_ {
        self.columns.names.iter().zip(&self.units).map(|(name, unit)| format!("{name} [{unit}]"))
    }

    /// The numbers alone.
    pub fn numbers<'a>(&'a self, values: &'a [f64]) -> impl Iterator<Item = String> + 'a {
        let shown = |(x, angle): (&f64, &bool)| if *angle && self.degrees { x.to_degrees() } else { *x };
        values.iter().zip(&self.columns.angles).map(move |pair| output::number(shown(pair)))
    }

    /// `x = 1.0000, y = …`: five digits, no units.
    pub fn brief(&self, values: &[f64]) -> String {
        let parts =
            self.columns.names.iter().zip(values).map(|(name, x)| format!("{name} = {}", output::brief(*x)));
        parts.collect::<Vec<_>>().join(", ")
    }

    /// `x = 1.000000 mm, y = …`.
    pub fn sentence(&self, values: &[f64]) -> String {
        let names = self.columns.names.iter().zip(&self.units);
        let parts = names.zip(self.numbers(values)).map(|((name, unit), x)| format!("{name} = {x} {unit}"));
        parts.collect::<Vec<_>>().join(", ")
    }
}

/// The unit of det A: every row of A is a length, every moment a length more; numbers for robots that only turn.
pub fn det_a_unit(robot: &Robot) -> String {
    let coordinates = robot.platform.coordinates();
    let angles = coordinates.iter().filter(|c| c.angle).count();
    if angles == coordinates.len() {
        return String::new();
    }
    format!(" [{}^{}]", robot.length_unit, coordinates.len() + angles)
}
