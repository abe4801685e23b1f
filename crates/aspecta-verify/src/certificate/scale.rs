//! What makes the functions that bound an aspect comparable.

use serde::{Deserialize, Serialize};

/// Positive constants by which the functions that bound S_{s,σ} are divided to form P (`docs/theory.md`, 5): their mean magnitude
/// over the window. Every proof holds for any choice; this one keeps boxes from being taken for corners.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scale {
    /// Of det A.
    pub det: f64,
    /// Of H_j, per leg: h_j is divided by its root.
    pub reach: Vec<f64>,
    /// Of the limits, per leg.
    pub limits: Vec<Vec<f64>>,
}
