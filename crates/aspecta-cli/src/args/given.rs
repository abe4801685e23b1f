//! The vectors a command is asked about: one from the command line or many from a CSV file.

use crate::failure::Failure;
use crate::input::{self, Columns, Row, Rows};
use clap::Args;
use std::iter;

/// One vector asked about.
pub struct Query {
    /// Its line, if it comes from a file.
    pub line: Option<u64>,
    /// Its numbers; angles in rad.
    pub values: Vec<f64>,
}

/// Vectors asked about, as they come.
pub type Queries<'a> = Box<dyn Iterator<Item = Result<Query, Failure>> + 'a>;

/// Poses.
#[derive(Args)]
#[group(required = true, multiple = false)]
pub struct Poses {
    /// The pose: x,y | x,y,phi | x,y,z | roll,pitch,yaw | x,y,z,roll,pitch,yaw
    #[arg(long, value_name = "LIST", allow_hyphen_values = true)]
    pose: Option<String>,
    /// A CSV file of poses, one a line; `-` reads stdin
    #[arg(long, value_name = "CSV")]
    file: Option<String>,
}

/// Joint vectors.
#[derive(Args)]
#[group(required = true, multiple = false)]
pub struct JointVectors {
    /// The joint vector, one number per leg
    #[arg(long, value_name = "LIST", allow_hyphen_values = true)]
    q: Option<String>,
    /// A CSV file of joint vectors, one a line; `-` reads stdin
    #[arg(long, value_name = "CSV")]
    file: Option<String>,
}

/// Poses or joint vectors.
#[derive(Args)]
#[group(required = true, multiple = false)]
pub struct PosesOrJoints {
    /// A pose: x,y | x,y,phi | x,y,z | roll,pitch,yaw. It is looked for in every working mode
    #[arg(long, value_name = "LIST", allow_hyphen_values = true)]
    pose: Option<String>,
    /// A joint vector, one number per leg. All its direct solutions are looked for
    #[arg(long, value_name = "LIST", allow_hyphen_values = true)]
    q: Option<String>,
    /// A CSV file of poses (with --joints of joint vectors), one a line; `-` reads stdin
    #[arg(long, value_name = "CSV")]
    file: Option<String>,
}

impl Poses {
    /// Reads them, those of a file in one of `layouts`.
    pub fn read<'a>(&'a self, layouts: &'a [Columns], degrees: bool) -> Result<Queries<'a>, Failure> {
        read(("--pose", &self.pose), &self.file, layouts, degrees)
    }

    /// Whether it is one, from the command line.
    pub fn is_one(&self) -> bool {
        self.pose.is_some()
    }
}

impl JointVectors {
    /// Reads them, those of a file in one of `layouts`.
    pub fn read<'a>(&'a self, layouts: &'a [Columns], degrees: bool) -> Result<Queries<'a>, Failure> {
        read(("--q", &self.q), &self.file, layouts, degrees)
    }
}

impl PosesOrJoints {
    /// Reads them, those of a file in one of `layouts`.
    pub fn read<'a>(&'a self, layouts: &'a [Columns], degrees: bool) -> Result<Queries<'a>, Failure> {
        let one = if self.is_joints() { ("--q", &self.q) } else { ("--pose", &self.pose) };
        read(one, &self.file, layouts, degrees)
    }

    /// Whether it is a joint vector from the command line.
    pub fn is_joints(&self) -> bool {
        self.q.is_some()
    }

    /// Whether it is the rows of a file.
    pub fn is_file(&self) -> bool {
        self.file.is_some()
    }
}

/// The value of an option, or the rows of `file` in one of `layouts`; clap sees to it that one of both is
/// there.
fn read<'a>(
    (option, value): (&str, &Option<String>),
    file: &'a Option<String>,
    layouts: &'a [Columns],
    degrees: bool,
) -> Result<Queries<'a>, Failure> {
    if let Some(path) = file {
        let query = |row: Row| Query { line: Some(row.line), values: row.values };
        return Ok(Box::new(Rows::open(path, layouts, degrees)?.map(move |row| row.map(query))));
    }
    let values = input::list(option, value.as_deref().unwrap_or_default(), &layouts[0], degrees)?;
    Ok(Box::new(iter::once(Ok(Query { line: None, values }))))
}
