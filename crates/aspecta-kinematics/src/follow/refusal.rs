//! Why a step is refused, without allocating.

use crate::{KinematicsError, LegIndex};
use aspecta_robot::num::{count, written};
use serde::Serialize;

/// A vector that does not fit the robot.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, thiserror::Error)]
#[serde(rename_all = "kebab-case")]
pub enum BadInput {
    /// Wrong number of coordinates.
    #[error("{} given, but the robot has {wanted} coordinates", count(*.found, "number", "numbers"))]
    Length {
        /// Number wanted.
        wanted: usize,
        /// Number given.
        found: usize,
    },
    /// NaN, infinity, or beyond ±10⁷.
    #[error("coordinate {index} is {}: give a finite number within ±1e7", written(*.value))]
    Number {
        /// Index from 1.
        index: usize,
        /// The value.
        value: f64,
    },
    /// A strut's length must be positive.
    #[error("joint coordinate {leg} is {}, but leg {leg} is a strut, whose length must be positive", written(*.value))]
    StrutLength {
        /// The leg.
        leg: LegIndex,
        /// The value.
        value: f64,
    },
}

/// Why a step is refused. The follower stays at its last state.
///
/// `proved` is the part of the step, t ∈ [0, 1), up to which the motion is certified. What else is said is *numerical*.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, thiserror::Error)]
#[serde(tag = "reason", rename_all = "kebab-case")]
pub enum Refusal {
    /// The numbers cannot be used.
    #[error(transparent)]
    Input(#[from] BadInput),
    /// A parallel singularity is ahead: two direct solutions seem to meet within the step.
    #[error(
        "a parallel singularity is ahead: proved up to {proved:.3} of the step, the singularity is estimated at \
         {singular_at:.3} of it; distance left there {distance:.3e} (smallest singular value of the homogeneous A)"
    )]
    Parallel {
        /// Up to where the step is proved, t.
        proved: f64,
        /// The t at which det A² extrapolates to zero.
        singular_at: f64,
        /// [`State::parallel_measure`](crate::State::parallel_measure) at `proved`.
        distance: f64,
    },
    /// A serial singularity of a leg is ahead, or its reach ends there.
    #[error(
        "a serial singularity of leg {leg} is ahead, the end of its reach: proved up to {proved:.3} of the step, the \
         singularity is estimated at {singular_at:.3} of it; distance left there {distance:.3e} (|B_jj| / max)"
    )]
    Serial {
        /// The leg.
        leg: LegIndex,
        /// Up to where the step is proved, t.
        proved: f64,
        /// The t at which H_j extrapolates to zero.
        singular_at: f64,
        /// [`State::serial_measures`](crate::State::serial_measures) of the leg at `proved`.
        distance: f64,
    },
    /// The proof needs smaller steps: too much motion at once, or a jump.
    #[error(
        "the step is too long, or jumps: proved up to {proved:.3} of it, distance from a singularity there \
         {distance:.3e}; go in smaller steps"
    )]
    TooLong {
        /// Up to where the step is proved, t.
        proved: f64,
        /// The distance, as in [`Refusal::Parallel`] or [`Refusal::Serial`].
        distance: f64,
    },
}

/// Why following cannot start.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StartError {
    /// The pose or the joint vector does not fit the robot.
    #[error(transparent)]
    Kinematics(#[from] KinematicsError),
    /// No direct solution near the pose can be told from all others.
    #[error(
        "no solution for this joint vector is proved to be the one meant by the pose: they do not belong together, or \
         lie too near to a parallel singularity"
    )]
    NoSolution,
    /// The pose is out of reach in the mode.
    #[error("leg {leg} cannot close at the pose, or is in a serial singularity there")]
    OutOfReach {
        /// The leg.
        leg: LegIndex,
    },
    /// The mode has another number of legs.
    #[error("working mode {mode} is not one of the robot's")]
    Mode {
        /// The mode given.
        mode: aspecta_robot::WorkingMode,
    },
}
