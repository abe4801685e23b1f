//! What every JSON document begins with.

use super::FORMAT_VERSION;
use aspecta::robot::Robot;
use serde::Serialize;

/// The version of the format, the robot, and the units of all that follows; times are in seconds.
#[derive(Clone, Copy, Serialize)]
pub struct About<'a> {
    format_version: u32,
    robot: &'a str,
    length_unit: &'a str,
    angle_unit: &'static str,
}

impl<'a> About<'a> {
    /// That of a robot.
    pub fn of(robot: &'a Robot) -> Self {
        Self {
            format_version: FORMAT_VERSION,
            robot: &robot.name,
            length_unit: &robot.length_unit,
            angle_unit: "rad",
        }
    }
}
