//! How large the constraints typically are, to make them comparable.

use super::Constraint;
use crate::Robot;
use serde::{Deserialize, Serialize};
use std::ops::{Index, IndexMut};

/// Positive constants by which the functions that bound S_{s,σ} are divided to form P (`docs/theory.md`, 5):
/// their mean magnitude over the window. Every proof holds for any choice; this one keeps boxes from being
/// taken for corners.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scale {
    /// The scale of det A.
    pub det: f64,
    /// The scale of H_j, per leg: h_j is divided by its root.
    pub reach: Vec<f64>,
    /// The scales of the limits, per leg.
    pub limits: Vec<Vec<f64>>,
    /// The scales of limits that two legs share.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub rod_angles: Vec<f64>,
    /// The scales of the pairs of bodies.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pairs: Vec<f64>,
}

impl Scale {
    /// Every constraint divided by one.
    pub fn ones(robot: &Robot) -> Self {
        let limits = robot.legs.iter().map(|leg| vec![1.0; leg.limits.len()]).collect();
        Self {
            det: 1.0,
            reach: vec![1.0; robot.dof()],
            limits,
            rod_angles: vec![1.0; robot.rod_angles.len()],
            pairs: vec![1.0; robot.pairs.len()],
        }
    }
}

impl Index<Constraint> for Scale {
    type Output = f64;

    fn index(&self, constraint: Constraint) -> &f64 {
        match constraint {
            Constraint::Reach(j) => &self.reach[j.index()],
            Constraint::Limit(j, k) => &self.limits[j.index()][k],
            Constraint::RodAngle(_, k) => &self.rod_angles[k],
            Constraint::Apart(_, k) => &self.pairs[k],
            Constraint::Det => &self.det,
        }
    }
}

impl IndexMut<Constraint> for Scale {
    fn index_mut(&mut self, constraint: Constraint) -> &mut f64 {
        match constraint {
            Constraint::Reach(j) => &mut self.reach[j.index()],
            Constraint::Limit(j, k) => &mut self.limits[j.index()][k],
            Constraint::RodAngle(_, k) => &mut self.rod_angles[k],
            Constraint::Apart(_, k) => &mut self.pairs[k],
            Constraint::Det => &mut self.det,
        }
    }
}
