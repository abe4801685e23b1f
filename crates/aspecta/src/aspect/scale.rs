//! How large the constraints typically are, to make them comparable.

use aspecta_kinematics::chart::{Chart, Coordinates};
use aspecta_kinematics::constraints::{Configuration, Constraint, Scale};
use aspecta_kinematics::for_platform;
use aspecta_kinematics::modal::ModalRows;
use aspecta_robot::{Robot, Window, WorkingMode};

/// Sample poses per coordinate.
const SAMPLES: usize = 8;

/// The mean magnitudes of the constraints over a grid of poses.
pub fn typical(robot: &Robot, window: &Window, modes: &[WorkingMode]) -> Scale {
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
    let mut limits: Vec<(Constraint, Mean)> = Constraint::of(robot)
        .filter(|constraint| constraint.is_limit())
        .map(|constraint| (constraint, Mean::default()))
        .collect();
    let (axes, twins) = (window.axes(), robot.twins());
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
        reach.iter_mut().zip(&legs).for_each(|(mean, leg)| mean.add(leg.closure.reach));
        for (constraint, mean) in &mut limits {
            for mode in constraint.postures().choices(N) {
                let at = Configuration { robot, placement: &placement, legs: &legs, heights: &heights, mode };
                mean.add(at.margin(*constraint) / at.unit(*constraint));
            }
        }
        let rows = ModalRows::<f64, N>::parted(robot, &twins, &legs, std::array::from_fn(|j| heights[j][0]));
        let weights: f64 = ModalRows::weights_of_parted(&twins, &legs).product();
        modes.iter().for_each(|&mode| det.add(rows.det(mode) / weights));
    }
    let mut scale = Scale::ones(robot);
    scale.det = det.value();
    scale.reach.iter_mut().zip(reach).for_each(|(scale, mean)| *scale = mean.value());
    limits.iter().for_each(|(constraint, mean)| scale[*constraint] = mean.value());
    scale
}
