//! How a command ends.

pub mod advice;

use aspecta::aspect::AnalysisError;
use aspecta::certificate::CertificateError;
use aspecta::domain::DomainError;
use aspecta::domain::cusps::CuspError;
use aspecta::kinematics::KinematicsError;
use aspecta::kinematics::start::NoStart;
use aspecta::motion::PathError;
use aspecta::motion::explore::ExploreError;
use aspecta::motion::follow::StartError;
use aspecta::motion::time::TimeError;
use aspecta::robot::FileError;
use std::io;
use std::path::{Path, PathBuf};

/// The outcome of a command that ran.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answer {
    /// Exit status 0.
    Yes,
    /// The answer is negative or undecided: exit status 1.
    No,
}

impl Answer {
    /// `Yes` if `found`.
    pub fn from(found: bool) -> Self {
        if found { Self::Yes } else { Self::No }
    }
}

/// Why a command could not run: exit status 2, after the message on stderr.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// Input that cannot be used; the message says where, and what would do.
    #[error("{0}")]
    Input(String),
    /// The robot file.
    #[error(transparent)]
    File(#[from] FileError),
    /// It does not fit the robot.
    #[error(transparent)]
    Kinematics(#[from] KinematicsError),
    /// It cannot be analysed.
    #[error("{error}{}", advice::on_analysis(.0), error = .0)]
    Analysis(#[from] AnalysisError),
    /// It cannot be explored.
    #[error("{error}{}", advice::on_exploring(.0), error = .0)]
    Explore(#[from] ExploreError),
    /// Its cusps cannot be looked for.
    #[error(transparent)]
    Cusps(#[from] CuspError),
    /// The certificate cannot be read.
    #[error(transparent)]
    Certificate(#[from] CertificateError),
    /// The path cannot be checked.
    #[error("{error}{}", advice::on_path(.0), error = .0)]
    Path(#[from] PathError),
    /// The path cannot be timed.
    #[error(transparent)]
    Time(#[from] TimeError),
    /// Following cannot start.
    #[error("{error}{}", advice::on_start(.0), error = .0)]
    Start(#[from] StartError),
    /// There is no configuration to start from.
    #[error("{error}{}", advice::on_no_start(.0), error = .0)]
    NoStart(#[from] NoStart),
    /// The directory of `--out` cannot be written to.
    #[error("--out {}: {error}", directory.display())]
    Directory {
        /// The directory.
        directory: PathBuf,
        /// Why.
        error: io::Error,
    },
    /// Results cannot be written.
    #[error("cannot write the results: {0}")]
    Output(#[from] io::Error),
}

impl Failure {
    /// Returns the conversion of an error of the file system in the directory of `--out` into a message to
    /// the user.
    pub fn in_directory(directory: &Path) -> impl Fn(io::Error) -> Self {
        move |error| Self::Directory { directory: directory.to_owned(), error }
    }
}

impl From<DomainError> for Failure {
    fn from(error: DomainError) -> Self {
        Self::Input(error.to_string())
    }
}

impl From<serde_json::Error> for Failure {
    fn from(e: serde_json::Error) -> Self {
        Self::Output(e.into())
    }
}

impl From<csv::Error> for Failure {
    fn from(e: csv::Error) -> Self {
        // The conversion of the csv crate hides the kind, and with it a broken pipe.
        match e.into_kind() {
            csv::ErrorKind::Io(e) => Self::Output(e),
            other => Self::Output(io::Error::other(format!("{other:?}"))),
        }
    }
}
