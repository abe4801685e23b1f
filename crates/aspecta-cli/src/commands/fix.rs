//! `--fix`: coordinates held at a value.

use crate::failure::Failure;
use aspecta::robot::{Coordinate, Robot};

/// Reads `phi=0.5`, `phi=30deg`, `x=-4`: (index, value), lengths in the robot's unit, angles in rad. Whether the robot can have these
/// values is for the library to say.
///
/// # Errors
/// A sentence that names the text at fault and what would do.
pub fn parse(robot: &Robot, given: &[String]) -> Result<Vec<(usize, f64)>, Failure> {
    given.iter().map(|text| one(robot, text.trim())).collect()
}

fn one(robot: &Robot, text: &str) -> Result<(usize, f64), Failure> {
    let refused = |why: String| Failure::Input(format!("--fix: {why}"));
    let Some((name, value)) = text.split_once('=') else {
        return Err(refused(format!(
            "`{text}` is not COORDINATE=VALUE; write for instance {}=0.5",
            robot.platform.coordinates()[0].name
        )));
    };
    let coordinates = robot.platform.coordinates();
    let Some(k) = coordinates.iter().position(|c| c.name == name.trim()) else {
        let names = coordinates.iter().map(|c| c.name).collect::<Vec<_>>().join(", ");
        let name = name.trim();
        return Err(refused(format!("`{}` has no coordinate `{name}`; it has {names}", robot.name)));
    };
    let value = quantity(value.trim(), &coordinates[k]);
    value.map(|x| (k, x)).map_err(|why| refused(format!("`{text}`: {why}")))
}

/// A number, for an angle with the unit `deg` or `rad` or none (rad).
fn quantity(text: &str, coordinate: &Coordinate) -> Result<f64, String> {
    let (number, degrees) = match (text.strip_suffix("deg"), text.strip_suffix("rad")) {
        (None, None) => (text, false),
        _ if !coordinate.angle => {
            return Err(format!("`{}` is a length: give a plain number", coordinate.name));
        }
        (Some(number), _) => (number, true),
        (None, Some(number)) => (number, false),
    };
    let form = if coordinate.angle { "radians, or 30deg" } else { "a plain number" };
    match number.trim().parse::<f64>() {
        Ok(x) => Ok(if degrees { x.to_radians() } else { x }),
        Err(_) => Err(format!("`{text}` is not a value of `{}`: give {form}", coordinate.name)),
    }
}
