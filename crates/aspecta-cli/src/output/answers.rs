//! JSON of what is found for the vectors a command is asked about.

use super::{FORMAT_VERSION, json};
use crate::failure::Failure;
use aspecta::robot::Robot;
use serde::Serialize;
use std::io::Write;

/// JSON: what was found of one vector, at the top; or of many, a list with their lines.
pub fn json_of_each<T: Serialize>(
    out: &mut dyn Write,
    robot: &Robot,
    mut answers: Vec<(Option<u64>, T)>,
) -> Result<(), Failure> {
    let about = About {
        format_version: FORMAT_VERSION,
        robot: &robot.name,
        length_unit: &robot.length_unit,
        angle_unit: "rad",
    };
    if matches!(answers[..], [(None, _)])
        && let Some((_, answer)) = answers.pop()
    {
        return json(out, &One { about, answer });
    }
    let results = answers.into_iter().map(|(line, answer)| InLine { line: line.unwrap_or_default(), answer });
    json(out, &Many { about, results: results.collect() })
}

#[derive(Serialize)]
struct About<'a> {
    format_version: u32,
    robot: &'a str,
    length_unit: &'a str,
    angle_unit: &'static str,
}

#[derive(Serialize)]
struct One<'a, T> {
    #[serde(flatten)]
    about: About<'a>,
    #[serde(flatten)]
    answer: T,
}

#[derive(Serialize)]
struct Many<'a, T> {
    #[serde(flatten)]
    about: About<'a>,
    results: Vec<InLine<T>>,
}

#[derive(Serialize)]
struct InLine<T> {
    line: u64,
    #[serde(flatten)]
    answer: T,
}
