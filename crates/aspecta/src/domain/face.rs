//! The faces of the boundary of an aspect.

use aspecta_kinematics::constraints::Constraint;
use serde::{Deserialize, Serialize};

/// A face of the boundary of an aspect.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Face {
    /// det A = 0 (parallel singularity), H_j = 0 (serial singularity) or a joint limit. In a map's file legs and
    /// limits count from 0.
    Of(Constraint),
    /// An end of the window's range: the user's cut (or the poles of a pitch), beyond which nothing was
    /// looked at.
    Cut {
        /// The coordinate, from 0.
        coordinate: usize,
        /// Whether it is the upper end.
        upper: bool,
    },
}
