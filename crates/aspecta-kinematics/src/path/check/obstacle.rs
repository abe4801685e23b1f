//! Where a path fails, and in what.

use crate::constraints::{Bound, Kind, Margins};
use serde::Serialize;
use std::cmp::Ordering;

/// A demand on every configuration of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Asked {
    /// To be in reach and not singular.
    Regular,
    /// To keep the margins from singularities.
    Margin,
    /// To be within joint limits and the robot's window.
    Limit,
}

/// The place where a path fails, or is in doubt.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Obstacle {
    /// The demand that fails.
    pub asked: Asked,
    /// Segment, from 1 (the sample, where samples are not joined).
    pub segment: usize,
    /// Start and end of the stretch, t ∈ [0, 1] along the segment.
    pub t: (f64, f64),
    /// Pose at the middle of the stretch; of joint vectors, at its start.
    pub pose: Vec<f64>,
    /// What fails; in JSON `constraint`: `{"kind": "det A"}`, `{"kind": "reach", "leg"}`, `{"kind": "limit",
    /// "leg", "limit"}`, counted from 1, or `{"kind": "window", "coordinate"}`.
    #[serde(rename = "constraint")]
    pub bound: Bound,
    /// Whether the failure is proved (else undecided).
    pub proved: bool,
}

impl Obstacle {
    /// Whether what fails is what was asked, and not that nobody can tell beyond a singularity.
    pub(super) fn is_of_its_own(&self, margins: &Margins) -> bool {
        let kind = match self.bound {
            Bound::Constraint(constraint) => constraint.kind(),
            Bound::Window { .. } => return true,
        };
        match (self.asked, kind) {
            (Asked::Regular, _) | (Asked::Limit, Kind::Limit) => true,
            (Asked::Margin, Kind::Parallel) => margins.parallel > 0.0,
            (Asked::Margin, Kind::Serial(_)) => margins.serial > 0.0,
            (Asked::Margin, Kind::Limit) | (Asked::Limit, Kind::Parallel | Kind::Serial(_)) => false,
        }
    }

    /// Their order along the path.
    pub(super) fn by_place(&self, other: &Self) -> Ordering {
        self.segment.cmp(&other.segment).then(self.t.0.total_cmp(&other.t.0))
    }
}
