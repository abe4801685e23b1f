//! Robot files: TOML in, a [`Robot`] or a message that says what to mend out. `docs/robot-files.md`
//! describes the format.

mod bodies;
mod convert;
mod error;
mod format;
mod keys;
mod limits;
mod locate;
mod obstacles;
mod schema;
mod tables;
mod words;

pub use error::{FileError, Mistake, Problem};
pub(crate) use keys::LegKeys;
pub(crate) use locate::Fault;
pub(crate) use words::is_line;
pub use words::is_unprintable;

use super::{Robot, catalogue};
use serde::Deserialize;
use std::fs::File;
use std::io::{self, ErrorKind, Read};
use std::path::Path;
use toml::de::{DeTable, Deserializer};

/// The largest file that is read, in bytes: a thousand times what a robot of six legs needs.
const LARGEST: u64 = 1 << 20;

fn catalogue_names() -> String {
    let names: Vec<_> = catalogue::all().iter().map(|e| e.name).collect();
    names.join(", ")
}

impl Robot {
    /// The robot that the TOML `text` describes. `file` is its name in messages.
    ///
    /// Every decimal becomes an interval that holds it, every direction one that holds the exact unit vector.
    ///
    /// # Errors
    /// [`FileError::Invalid`], which names line, column, key and value.
    ///
    /// # Examples
    /// ```
    /// use aspecta_robot::Robot;
    ///
    /// let text = r#"
    /// name = "two-struts"
    /// platform = "plane-point"
    ///
    /// [[legs]]
    /// anchor = [0, 0]
    /// actuator = { kind = "strut" }
    /// limits = { actuator = [1, 3] }
    ///
    /// [[legs]]
    /// anchor = [2, 0]
    /// actuator = { kind = "strut" }
    /// limits = { actuator = [1, 3] }
    /// "#;
    /// let robot = Robot::from_toml(text, "two-struts.toml")?;
    /// assert_eq!(robot.working_modes().len(), 1);
    ///
    /// let mistake = Robot::from_toml(&text.replace("strut\"", "spring\""), "two-struts.toml").unwrap_err();
    /// assert!(mistake.to_string().contains("two-struts.toml:7"));
    /// # Ok::<(), aspecta_robot::FileError>(())
    /// ```
    pub fn from_toml(text: &str, file: &str) -> Result<Self, FileError> {
        let tree = DeTable::parse(text).map_err(|e| Fault::from_parser(&e, text).locate(file, text, None))?;
        format::RobotFile::deserialize(Deserializer::from(tree.clone()))
            .map_err(|e| Fault::from_serde(&e, text, tree.get_ref()))
            .and_then(|table| convert::robot(&table, text))
            .map_err(|fault| fault.locate(file, text, Some(tree.get_ref())))
    }

    /// The robot of a file.
    ///
    /// # Errors
    /// [`FileError::Unreadable`], [`FileError::TooLarge`] or [`FileError::Invalid`].
    pub fn load(path: &Path) -> Result<Self, FileError> {
        let file = path.display().to_string();
        match File::open(path) {
            Ok(input) => Self::read(input, &file),
            Err(reason) => Err(FileError::Unreadable { file, reason }),
        }
    }

    /// The robot that an input describes, of which no more is read than the largest file may hold. `file` is
    /// its name in messages.
    ///
    /// # Errors
    /// As [`Robot::load`].
    pub fn read(input: impl Read, file: &str) -> Result<Self, FileError> {
        let mut text = Vec::new();
        let unreadable = |reason| FileError::Unreadable { file: file.to_owned(), reason };
        input.take(LARGEST + 1).read_to_end(&mut text).map_err(unreadable)?;
        if text.len() as u64 > LARGEST {
            return Err(FileError::TooLarge { file: file.to_owned() });
        }
        let text =
            str::from_utf8(&text).map_err(|e| unreadable(io::Error::new(ErrorKind::InvalidData, e)))?;
        Self::from_toml(text, file)
    }

    /// The built-in robot of that name, else the robot of that file.
    ///
    /// # Errors
    /// [`FileError::UnknownRobot`] if it is neither; else as [`Robot::load`].
    ///
    /// # Examples
    /// ```
    /// use aspecta_robot::{FileError, Robot};
    ///
    /// assert_eq!(Robot::resolve("gough-stewart")?.dof(), 6);
    /// assert!(matches!(Robot::resolve("stewart-gough"), Err(FileError::UnknownRobot { .. })));
    /// # Ok::<(), FileError>(())
    /// ```
    pub fn resolve(name_or_path: &str) -> Result<Self, FileError> {
        if let Some(entry) = catalogue::all().iter().find(|e| e.name == name_or_path) {
            return Self::from_toml(entry.text, &format!("{name_or_path}.toml"));
        }
        let path = Path::new(name_or_path);
        let names_a_file = path.extension().is_some() || name_or_path.contains(std::path::is_separator);
        if path.exists() || names_a_file {
            return Self::load(path);
        }
        let closest = error::closest(name_or_path, catalogue::all().iter().map(|e| e.name));
        Err(FileError::UnknownRobot { name: name_or_path.to_owned(), closest })
    }

    /// The JSON Schema of robot files, as published in `robots/robot.schema.json`.
    pub fn file_schema() -> schemars::Schema {
        schema::schema()
    }
}
