//! Robots, modes and numbers from the command line and from CSV files.

mod fields;
mod lines;
mod rows;

pub use rows::{Row, Rows, held, rows};

use crate::failure::Failure;
use crate::output::{note, number};
use aspecta::domain::Map;
use aspecta::kinematics::WorkingMode;
use aspecta::robot::{GREATEST, MixedUnits, Robot};
use std::f64::consts::TAU;
use std::fs::File;
use std::io::Read;
use std::path::Path;
use std::sync::Once;

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

    /// Degrees to radians, where `values` are angles given in degrees; else warns of angles that seem to be.
    fn to_radians(&self, values: &mut [f64], degrees: bool) {
        let angles = values.iter_mut().zip(&self.angles).filter(|(_, angle)| **angle);
        if degrees {
            angles.for_each(|(x, _)| *x = x.to_radians());
        } else {
            let named = self.names.iter().zip(&*values).zip(&self.angles).filter(|(_, angle)| **angle);
            named.for_each(|((name, x), _)| warn_of_degrees(name, *x, "--deg"));
        }
    }
}

/// Warns, once, of an angle in radians that is more than a full turn, and not so great that it is refused:
/// `way` is how degrees are given.
pub fn warn_of_degrees(name: &str, angle: f64, way: &str) {
    static WARNED: Once = Once::new();
    if angle.abs() > TAU && angle.abs() < GREATEST {
        WARNED.call_once(|| {
            let turns = angle.abs() / TAU;
            note(&format!(
                "warning: {name} = {angle} is taken in radians, {turns:.1} full turns; if it is in degrees, give {way}"
            ));
        });
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

/// Whether a file may be a map, as far as its first bytes tell. A pipe, which can be read but once, is none.
pub fn is_map(path: &Path) -> bool {
    let mut mark = [0; 2];
    path.is_file()
        && File::open(path).and_then(|mut file| file.read_exact(&mut mark)).is_ok()
        && Map::is_map(&mark)
}

/// The robot of a catalogue name or of a file.
pub fn robot(name_or_path: &str) -> Result<Robot, Failure> {
    if is_map(name_or_path.as_ref()) {
        return Err(Failure::Input(format!(
            "`{name_or_path}` is a map of a robot's aspects, for `aspecta locate` and `aspecta domains`: give the robot's name or file"
        )));
    }
    let robot = Robot::resolve(name_or_path)?;
    warn_of_mixed_units(&robot);
    Ok(robot)
}

/// Warns of a robot of which some lengths seem to be in other units than others.
pub fn warn_of_mixed_units(robot: &Robot) {
    if let Some(MixedUnits { small, large }) = robot.mixed_units() {
        let (unit, ratio) = (&robot.length_unit, large.1 / small.1);
        note(&format!(
            "warning: {} is {} {unit} and {} {} {unit}, {ratio:.0} times as much; all lengths of a robot file are in one unit",
            small.0,
            number(small.1),
            large.0,
            number(large.1)
        ));
    }
}

/// The working mode given to `--mode`, which must be one of the robot's: by its signs, or leg by leg by the
/// names of postures.
pub fn mode(robot: &Robot, text: &str) -> Result<WorkingMode, Failure> {
    robot.working_mode(text).map_err(|e| Failure::Input(format!("--mode: {e}")))
}

/// The working modes given to `--mode`, each once. Those given leg by leg have commas inside, as there are
/// between modes.
pub fn modes(robot: &Robot, given: &[String]) -> Result<Vec<WorkingMode>, Failure> {
    let mut parts = given.iter().flat_map(|text| text.split(',')).map(str::trim);
    let mut modes = Vec::new();
    while let Some(first) = parts.next() {
        // No robot has one leg.
        let is_whole = first.parse::<WorkingMode>().is_ok_and(|mode| mode.legs() > 1);
        let others = if is_whole { 0 } else { robot.dof() - 1 };
        let text: Vec<&str> = std::iter::once(first).chain(parts.by_ref().take(others)).collect();
        let mode = mode(robot, &text.join(","))?;
        if !modes.contains(&mode) {
            modes.push(mode);
        }
    }
    Ok(modes)
}
