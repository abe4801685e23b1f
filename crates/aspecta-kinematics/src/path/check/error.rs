//! Why a path cannot be checked.

use crate::follow::StartError;
use crate::{KinematicsError, LegIndex, WorkingMode};
use aspecta_robot::num::{self, written};

/// Why a path cannot be checked at all.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PathError {
    /// Too few samples.
    #[error("a path needs at least {wanted}, but {found} given")]
    TooShort {
        /// The number needed.
        wanted: &'static str,
        /// Samples given.
        found: usize,
    },
    /// A sample does not fit the robot.
    #[error("sample {row} of the path: {error}")]
    Sample {
        /// Row, from 1.
        row: usize,
        /// The fault of the sample.
        error: KinematicsError,
    },
    /// The mode does not fit the robot.
    #[error("`{mode}` is not a working mode of robot `{robot}`: its modes are {known}")]
    Mode {
        /// The mode asked for.
        mode: WorkingMode,
        /// The robot.
        robot: String,
        /// Its modes.
        known: String,
    },
    /// Margins that no configuration keeps.
    #[error("{of} cannot be kept at or above {}: margins are at least 0 (none) and below 1", written(*.value))]
    Margin {
        /// The margin asked for.
        value: f64,
        /// The quantity.
        of: &'static str,
    },
    /// The first pose is out of reach.
    #[error("the path starts out of reach: leg {leg} cannot close at pose 1")]
    StartOutOfReach {
        /// The leg.
        leg: LegIndex,
    },
    /// The first pose is singular, as far as intervals can tell.
    #[error("the path starts in a singularity, or too near to one to tell the sign of det A or of a B_jj")]
    StartSingular,
    /// Joint vectors without anything between.
    #[error(
        "joint vectors have to be joined: which direct solution the robot is in, only the way there tells"
    )]
    Unjoined,
    /// Nothing tells which direct solution is meant.
    #[error(
        "the first joint vector has {}, and the path starts in one of them: say in which, by its pose\n{list}",
        num::count(*.count, "direct solution", "direct solutions")
    )]
    WhichSolution {
        /// How many.
        count: usize,
        /// One a line: working mode and pose.
        list: String,
    },
    /// There is no direct solution to start in.
    #[error("the first joint vector has no direct solution: no pose of the platform fits it")]
    NoSolution,
    /// The start is not one.
    #[error("at the first joint vector: {0}")]
    Start(StartError),
}
