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

/// The help of `--deg` where it is for this option too.
pub const OF_FIX_AND_TABLES: &str = "Angles of --fix without a unit and of the tables are in degrees";

impl FixArg {
    /// Coordinates of the pose, as in `phi=0.5`, `phi=30deg`, `x=-4`: (index, value), lengths in the robot's
    /// unit, angles in rad; without a unit they are given in degrees if `degrees`. Whether the robot can have
    /// these values is for the library to say.
    ///
    /// # Errors
    /// A sentence that names the text at fault and what would do.
    pub fn coordinates(&self, robot: &Robot, degrees: bool) -> Result<Vec<(usize, f64)>, Failure> {
        all(robot, &Columns::pose(robot), ("coordinate", degrees), &self.fix)
    }

    /// Joints, as in `q1=14.98`, `q2=30deg`: each by its leg, with its value.
    ///
    /// # Errors
    /// As [`Self::coordinates`].
    pub fn joints(&self, robot: &Robot, degrees: bool) -> Result<Vec<(LegIndex, f64)>, Failure> {
        let held = all(robot, &Columns::joints(robot), ("joint", degrees), &self.fix)?;
        Ok(held.into_iter().map(|(j, value)| (LegIndex::new(j), value)).collect())
    }
}

fn all(
    robot: &Robot,
    columns: &Columns,
    (what, degrees): (&str, bool),
    given: &[String],
) -> Result<Vec<(usize, f64)>, Failure> {
    given.iter().map(|text| one(robot, columns, (what, degrees), text.trim())).collect()
}

fn one(
    robot: &Robot,
    columns: &Columns,
    (what, degrees): (&str, bool),
    text: &str,
) -> Result<(usize, f64), Failure> {
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
    let value = quantity(value.trim(), &columns.names[k], columns.angles[k], degrees);
    value.map(|x| (k, x)).map_err(|why| refused(format!("`{text}`: {why}")))
}

/// A number, for an angle with the unit `deg` or `rad` or none: then in degrees if `by_default`, else in
/// radians.
fn quantity(text: &str, name: &str, angle: bool, by_default: bool) -> Result<f64, String> {
    let (number, degrees) = match (text.strip_suffix("deg"), text.strip_suffix("rad")) {
        (None, None) => (text, angle && by_default),
        _ if !angle => return Err(format!("`{name}` is a length: give a plain number")),
        (Some(number), _) => (number, true),
        (None, Some(number)) => (number, false),
    };
    let form = match (angle, by_default) {
        (false, _) => "a plain number",
        (true, false) => "radians, or 30deg",
        (true, true) => "degrees, or 0.5rad",
    };
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
