//! Robots, modes and numbers from the command line and from CSV files.

mod fields;
mod rows;

pub use rows::{Row, Rows, rows};

use crate::failure::Failure;
use aspecta::domain::Map;
use aspecta::kinematics::WorkingMode;
use aspecta::robot::Robot;
use std::fs::File;
use std::io::Read;
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
