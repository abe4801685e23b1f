//! How large the constraints typically are, to make them comparable.

use aspecta_kinematics::chart::Chart;
use aspecta_kinematics::chart::Coordinates;
use aspecta_kinematics::for_platform;
use aspecta_kinematics::limits::{margin, unit};
use aspecta_kinematics::modal::ModalRows;
use aspecta_robot::WorkingMode;
use aspecta_robot::{Robot, Window};
use aspecta_verify::certificate::Scale;

/// Sample poses per coordinate.
const SAMPLES: usize = 8;

/// Mean magnitudes over a grid of poses.
pub fn scale(robot: &Robot, window: &Window, modes: &[WorkingMode]) -> Scale {
    for_platform!(robot.platform, sample(robot, window, modes))
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
