//! `--fix`: coordinates or joints held at a value.

use crate::failure::Failure;
use crate::input::{Columns, warn_of_degrees};
use aspecta::robot::{LegIndex, Robot};
use clap::Args;

/// What is held. Each command says what for.
#[derive(Args)]
pub struct FixArg {
    #[arg(long, value_name = "COORDINATE=VALUE", value_delimiter = ',')]
    fix: Vec<String>,
}

impl FixArg {
    /// Coordinates of the pose, as in `phi=0.5`, `phi=30deg`, `x=-4`: (index, value), lengths in the robot's
    /// unit, angles in rad. Whether the robot can have these values is for the library to say.
    ///
    /// # Errors
    /// A sentence that names the text at fault and what would do.
    pub fn coordinates(&self, robot: &Robot) -> Result<Vec<(usize, f64)>, Failure> {
        all(robot, &Columns::pose(robot), "coordinate", &self.fix)
    }

    /// Joints, as in `q1=14.98`, `q2=30deg`: each by its leg, with its value.
    ///
    /// # Errors
    /// As [`Self::coordinates`].
    pub fn joints(&self, robot: &Robot) -> Result<Vec<(LegIndex, f64)>, Failure> {
        let held = all(robot, &Columns::joints(robot), "joint", &self.fix)?;
        Ok(held.into_iter().map(|(j, value)| (LegIndex::new(j), value)).collect())
    }
}

fn all(robot: &Robot, columns: &Columns, what: &str, given: &[String]) -> Result<Vec<(usize, f64)>, Failure> {
    given.iter().map(|text| one(robot, columns, what, text.trim())).collect()
}

fn one(robot: &Robot, columns: &Columns, what: &str, text: &str) -> Result<(usize, f64), Failure> {
    let refused = |why: String| Failure::Input(format!("--fix: {why}"));
    let Some((name, value)) = text.split_once('=') else {
        return Err(refused(format!(
            "`{text}` is not {}=VALUE; write for instance {}=0.5",
            what.to_uppercase(),
            columns.names[0]
        )));
    };
    let name = name.trim();
    let Some(k) = columns.names.iter().position(|c| c == name) else {
        let names = columns.names.join(", ");
        return Err(refused(format!("`{}` has no {what} `{name}`; it has {names}", robot.name)));
    };
    let value = quantity(value.trim(), &columns.names[k], columns.angles[k]);
    value.map(|x| (k, x)).map_err(|why| refused(format!("`{text}`: {why}")))
}

/// A number, for an angle with the unit `deg` or `rad` or none (rad).
fn quantity(text: &str, name: &str, angle: bool) -> Result<f64, String> {
    let (number, degrees) = match (text.strip_suffix("deg"), text.strip_suffix("rad")) {
        (None, None) => (text, false),
        _ if !angle => return Err(format!("`{name}` is a length: give a plain number")),
        (Some(number), _) => (number, true),
        (None, Some(number)) => (number, false),
    };
    let form = if angle { "radians, or 30deg" } else { "a plain number" };
    match number.trim().parse::<f64>() {
        Ok(x) if degrees => Ok(x.to_radians()),
        Ok(x) => {
            if angle && number == text {
                warn_of_degrees(name, x, &format!("{name}={text}deg"));
            }
            Ok(x)
        }
        Err(_) => Err(format!("`{text}` is not a value of `{name}`: give {form}")),
    }
}
