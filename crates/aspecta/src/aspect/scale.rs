//! How large the constraints typically are, to make them comparable.

use crate::kinematics::WorkingMode;
use crate::kinematics::chart::Chart;
use crate::kinematics::for_platform;
use crate::kinematics::limits::{margin, unit};
use crate::kinematics::modal::ModalRows;
use crate::robot::{Robot, Window};
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

/// Sample poses per coordinate.
const SAMPLES: usize = 8;

impl Scale {
    /// Mean magnitudes over a grid of poses.
    pub fn of(robot: &Robot, window: &Window, modes: &[WorkingMode]) -> Self {
        for_platform!(robot.platform, sample(robot, window, modes))
    }
}

/// A running mean of magnitudes.
#[derive(Clone, Copy, Default)]
struct Mean {
    sum: f64,
    count: usize,
}

impl Mean {
    fn add(&mut self, x: f64) {
        if x.is_finite() {
            self.sum += x.abs();
            self.count += 1;
        }
    }

    fn value(self) -> f64 {
        let mean = self.sum / self.count as f64;
        if mean.is_normal() { mean } else { 1.0 }
    }
}

fn sample<const D: usize, const N: usize>(robot: &Robot, window: &Window, modes: &[WorkingMode]) -> Scale {
    let mut det = Mean::default();
    let mut reach = [Mean::default(); N];
    let mut limits: Vec<Vec<Mean>> =
        robot.legs.iter().map(|leg| vec![Mean::default(); leg.limits.len()]).collect();
    let axes = window.axes();
    for index in 0..SAMPLES.pow(axes.len() as u32) {
        let mut pose: [f64; N] = std::array::from_fn(|k| window.ranges[k].0);
        for (a, &k) in axes.iter().enumerate() {
            let (lo, hi) = window.ranges[k];
            let step = (index / SAMPLES.pow(a as u32) % SAMPLES) as f64 + 0.5;
            pose[k] = lo + (hi - lo) * step / SAMPLES as f64;
        }
        let (placement, legs) = Chart::Pose.at::<f64, D, N>(robot, &pose, |k| pose[k].sin_cos());
        if legs.iter().any(|leg| leg.closure.reach < 0.0) {
            continue;
        }
        let heights: [[f64; 2]; N] = std::array::from_fn(|j| legs[j].heights());
        for (j, leg) in robot.legs.iter().enumerate() {
            reach[j].add(legs[j].closure.reach);
            let at = legs[j].limited(leg);
            for (mean, limit) in limits[j].iter_mut().zip(&leg.limits) {
                heights[j]
                    .iter()
                    .for_each(|&sh| mean.add(margin(limit, &at, sh, &placement) / unit(limit, &at, sh)));
            }
        }
        let rows = ModalRows::<f64, N>::new(robot, &legs, &std::array::from_fn(|j| heights[j][0]));
        let weights: f64 = legs.iter().map(|leg| leg.closure.weight).product();
        modes.iter().for_each(|&mode| det.add(rows.det(mode) / weights));
    }
    Scale {
        det: det.value(),
        reach: reach.iter().map(|mean| mean.value()).collect(),
        limits: limits.iter().map(|leg| leg.iter().map(|mean| mean.value()).collect()).collect(),
    }
}
