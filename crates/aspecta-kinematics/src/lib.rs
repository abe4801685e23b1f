//! Inverse and direct geometric models, Jacobians and singularities (section 2 of the paper).

// A variant that is added leads to every place that must decide about it.
#![warn(clippy::wildcard_enum_match_arm)]

mod agile_eye;
mod architecture;
pub mod chart;
pub mod condition;
pub mod constraints;
pub mod cusps;
pub mod direct;
pub mod follow;
mod homogeneous;
mod inverse;
mod jacobian;
mod minors;
pub mod modal;
mod model;
mod out_of_reach;
pub mod parallel_rods;
pub mod path;
pub mod placement;
mod singularity;
pub mod start;
mod velocities;

pub use agile_eye::AgileEye;
pub use architecture::{Architecture, architecture};
pub use direct::{DirectSolutions, Poses};
pub use inverse::{LegSolutions, check_joints, check_pose};
pub use jacobian::Jacobians;
pub use model::Kinematics;
pub use out_of_reach::OutOfReach;
pub use singularity::{SINGULAR, Singularity, State};
pub use velocities::{Lost, SerialPosture, Velocities};

#[doc(hidden)]
pub use aspecta_robot::Platform;
use aspecta_robot::num::written;
pub use aspecta_robot::{LegIndex, LegSet, NotAMode, WorkingMode};
use serde::Serialize;

/// Runs a function generic over (D, N) — the dimension of space and the degrees of freedom — for the
/// dimensions of a platform.
#[macro_export]
macro_rules! for_platform {
    ($platform:expr, $f:ident ( $($arg:expr),* $(,)? )) => {
        match $platform {
            $crate::Platform::PlanePoint => $f::<2, 2>($($arg),*),
            $crate::Platform::PlaneBody => $f::<2, 3>($($arg),*),
            $crate::Platform::TranslatingBody | $crate::Platform::TurningBody => $f::<3, 3>($($arg),*),
            $crate::Platform::FreeBody => $f::<3, 6>($($arg),*),
        }
    };
}
/// A configuration (X, q) of the robot, labelled: what `ik` and `fk` return.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Solution {
    /// X, as [`aspecta_robot::Platform::coordinates`] orders it; angles in rad, in (−π, π].
    pub pose: Vec<f64>,
    /// q; angles in rad, in (−π, π].
    pub q: Vec<f64>,
    /// The working mode: signs of B_jj.
    pub mode: WorkingMode,
    /// The legs at a serial singularity, to the tolerance [`SINGULAR`]: their signs in `mode` mean nothing.
    pub serial_legs: Vec<LegIndex>,
    /// det A = det ∂f/∂X.
    pub det_a: f64,
    /// Largest |f_i| relative to the leg's lengths squared.
    pub residual: f64,
    /// Whether existence and uniqueness near here are proved by intervals.
    pub certified: bool,
    /// Whether every joint is within its limits and the pose in the robot's window.
    pub within_limits: bool,
}

/// Input that does not fit the robot.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum KinematicsError {
    /// Wrong number of coordinates.
    #[error("robot `{robot}` has {wanted} {what} coordinates ({names}), not {found}")]
    Length {
        /// Robot name.
        robot: String,
        /// `pose` or `joint`.
        what: &'static str,
        /// Their names.
        names: String,
        /// Number wanted.
        wanted: usize,
        /// Number given.
        found: usize,
    },
    /// NaN or infinity.
    #[error("{what} coordinate {index} is {}: give a finite number", written(*.value))]
    NotFinite {
        /// `pose` or `joint`.
        what: &'static str,
        /// Index from 1.
        index: usize,
        /// The value.
        value: f64,
    },
    /// Too large for double precision to mean anything.
    #[error("{what} coordinate {index} is {}: beyond ±1e7, where doubles no longer resolve a robot", written(*.value))]
    TooLarge {
        /// `pose` or `joint`.
        what: &'static str,
        /// Index from 1.
        index: usize,
        /// The value.
        value: f64,
    },
    /// The length of a strut must be positive.
    #[error("joint coordinate {leg} is {}, but leg {leg} is a strut, whose length must be positive", written(*.value))]
    StrutLength {
        /// The leg.
        leg: LegIndex,
        /// The value given.
        value: f64,
    },
    /// With the actuators locked the platform can still move: infinitely many direct solutions.
    #[error(
        "robot `{robot}` has a self-motion at this joint vector: the platform can move with all actuators locked, \
         so the direct solutions are infinitely many (or cannot be told from it in double precision)"
    )]
    SelfMotion {
        /// Robot name.
        robot: String,
    },
}

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
