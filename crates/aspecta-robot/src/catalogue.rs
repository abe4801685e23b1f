//! The robots built into the program: those of the paper and the well-known ones. They are ordinary robot
//! files, kept in `robots/`.

use super::Robot;

/// A built-in robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Its name, as on the command line.
    pub name: &'static str,
    /// Its robot file, ready to copy and edit.
    pub text: &'static str,
}

macro_rules! entries {
    ($($name:literal),* $(,)?) => {
        &[$(Entry { name: $name, text: include_str!(concat!("../robots/", $name, ".toml")) }),*]
    };
}

const ENTRIES: &[Entry] = entries![
    "five-bar",
    "symmetric-five-bar",
    "2-prr",
    "3-rrr",
    "3-prr",
    "3-rpr",
    "delta",
    "irb-360",
    "linear-delta",
    "orthoglide",
    "spherical-3-rrr",
    "hexa",
    "gough-stewart",
];

/// All built-in robots, smallest platforms first.
///
/// # Examples
/// ```
/// use aspecta_robot::{Robot, catalogue};
///
/// for entry in catalogue::all() {
///     let robot = Robot::from_toml(entry.text, entry.name)?;
///     assert_eq!(robot.name, entry.name);
/// }
/// # Ok::<(), aspecta_robot::FileError>(())
/// ```
pub const fn all() -> &'static [Entry] {
    ENTRIES
}

/// The built-in robot called `name`.
pub fn find(name: &str) -> Option<Robot> {
    let entry = ENTRIES.iter().find(|e| e.name == name)?;
    Robot::from_toml(entry.text, entry.name).ok()
}
