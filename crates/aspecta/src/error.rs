//! One error for all calls of the front door.

use crate::aspect::AnalysisError;
use crate::certificate::CertificateError;
use crate::domain::boundary::BoundaryError;
use crate::domain::characteristic::CharacteristicError;
use crate::domain::{DomainError, MapError, Nowhere};
use crate::kinematics::KinematicsError;
use crate::kinematics::cusps::CuspError;
use crate::kinematics::follow::{self, StartError};
use crate::kinematics::path::PathError;
use crate::kinematics::path::time::TimeError;
use crate::kinematics::start::NoStart;
use crate::motion::explore::{ExploreError, NoWay};
use crate::motion::modes::NoRoute;
use crate::motion::plan;
use crate::robot::{FileError, NoSuchMode, NotAMode, RobotError, SliceError, Unbounded};

/// Any error of this library, as `?` makes it: the message is that of the error inside.
///
/// # Examples
/// ```
/// use aspecta::{Error, Kinematics, Robot};
///
/// fn solutions(robot: &str, pose: &[f64]) -> Result<usize, Error> {
///     Ok(Robot::resolve(robot)?.inverse(pose)?.len())
/// }
///
/// assert_eq!(solutions("five-bar", &[4.0, 7.0])?, 4);
/// let error = solutions("five-bar", &[4.0]).unwrap_err();
/// assert!(matches!(error, Error::Kinematics(_)));
/// assert_eq!(error.to_string(), "robot `five-bar` has 2 pose coordinates (x, y), not 1");
/// assert!(matches!(solutions("five-baar", &[4.0, 7.0]), Err(Error::File(_))));
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A robot file cannot be read, or there is no such robot.
    #[error(transparent)]
    File(#[from] FileError),
    /// Legs and platform do not make a robot.
    #[error(transparent)]
    Robot(#[from] RobotError),
    /// A text is not a working mode.
    #[error(transparent)]
    Mode(#[from] NotAMode),
    /// A text is no working mode of the robot.
    #[error(transparent)]
    NoSuchMode(#[from] NoSuchMode),
    /// A pose or a joint vector does not fit the robot.
    #[error(transparent)]
    Kinematics(#[from] KinematicsError),
    /// There is no configuration to start from.
    #[error(transparent)]
    NoStart(#[from] NoStart),
    /// Nothing bounds a coordinate.
    #[error(transparent)]
    Unbounded(#[from] Unbounded),
    /// There is no such slice of the workspace.
    #[error(transparent)]
    Slice(#[from] SliceError),
    /// The robot cannot be analysed.
    #[error(transparent)]
    Analysis(#[from] AnalysisError),
    /// An aspect cannot be cut into regions.
    #[error(transparent)]
    Domain(#[from] DomainError),
    /// An aspect has no mesh of its boundary.
    #[error(transparent)]
    Boundary(#[from] BoundaryError),
    /// An aspect has no mesh of its characteristic surface.
    #[error(transparent)]
    Characteristic(#[from] CharacteristicError),
    /// A file is no map.
    #[error(transparent)]
    Map(#[from] MapError),
    /// A pose is in no aspect.
    #[error(transparent)]
    Nowhere(#[from] Nowhere),
    /// A path cannot be checked.
    #[error(transparent)]
    Path(#[from] PathError),
    /// A path cannot be timed.
    #[error(transparent)]
    Time(#[from] TimeError),
    /// There is no plan within a working mode.
    #[error(transparent)]
    Plan(#[from] plan::Refusal),
    /// There is no motion through several working modes.
    #[error(transparent)]
    Route(#[from] NoRoute),
    /// The robot cannot be explored.
    #[error(transparent)]
    Explore(#[from] ExploreError),
    /// There is no plan over a roadmap.
    #[error(transparent)]
    Roadmap(#[from] NoWay),
    /// Cusps cannot be looked for.
    #[error(transparent)]
    Cusps(#[from] CuspError),
    /// Following cannot start.
    #[error(transparent)]
    Start(#[from] StartError),
    /// A step is refused: the follower stays where it was.
    #[error(transparent)]
    Step(#[from] follow::Refusal),
    /// A file is no certificate.
    #[error(transparent)]
    Certificate(#[from] CertificateError),
    /// A certificate cannot be written as JSON.
    #[error(transparent)]
    Json(#[from] serde_json::Error),
}
