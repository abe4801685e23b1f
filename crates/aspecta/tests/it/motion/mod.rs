//! Motions: every path that is returned is sound, everything that is refused is explained.

mod assembly;
mod modes;
mod plan;
mod traverse;

use crate::random::Random;
use aspecta::Kinematics;
use aspecta::aspect::{Analysis, Options, analyze};
use aspecta::kinematics::WorkingMode;
use aspecta::motion::check_path;
use aspecta::motion::plan::Plan;
use aspecta::paving::{Budget, Control};
use aspecta::robot::{Robot, catalogue};
use std::f64::consts::TAU;

fn robot(name: &str) -> Robot {
    catalogue::find(name).unwrap()
}

fn mode(signs: &str) -> WorkingMode {
    signs.parse().unwrap()
}

/// The aspects of some modes (none: all), in boxes down to a depth.
fn analysed(robot: &Robot, depth: u32, modes: &[&str]) -> Analysis {
    let budget = Budget { depth: Some(depth), ..Budget::default() };
    let modes = modes.iter().map(|signs| mode(signs)).collect();
    analyze(robot, &Options { budget, modes, ..Options::default() }, &Control::unwatched()).unwrap()
}

/// A pose that the robot can take in a mode, within its limits; `None` if a good many draws find none.
fn pose_in(analysis: &Analysis, mode: WorkingMode, random: &mut Random) -> Option<Vec<f64>> {
    let draw = |_| -> Vec<f64> { analysis.window.ranges.iter().map(|r| random.within(r.0, r.1)).collect() };
    (0..100_000).map(draw).find(|pose| {
        let solutions = analysis.robot.inverse(pose).unwrap();
        solutions.iter().any(|s| s.mode == mode && s.within_limits)
    })
}

/// Whether two poses are one, angles modulo full turns.
fn same_pose(robot: &Robot, a: &[f64], b: &[f64]) -> bool {
    let near = |k: usize| {
        let gap = b[k] - a[k];
        let angle = robot.platform.coordinates()[k].angle;
        (if angle { gap - TAU * (gap / TAU).round() } else { gap }).abs() < 1e-9
    };
    (0..a.len()).all(near)
}

/// The path is sound as the path check sees it, and as samples do.
fn assert_sound(robot: &Robot, plan: &Plan) {
    let check = check_path(robot, &plan.waypoints, plan.mode).unwrap();
    assert_eq!(check.singularity_free, Some(true), "{plan:?}");
    assert_eq!(check.within_limits, Some(true), "{plan:?}");
    for (det_a, _) in sampled(robot, plan) {
        assert_eq!(det_a > 0.0, plan.det_a.factor() > 0, "{plan:?}");
    }
}

/// det A and the least |B_jj| / max |B_jj| along a path.
fn sampled(robot: &Robot, plan: &Plan) -> Vec<(f64, f64)> {
    let mut all = Vec::new();
    for ends in plan.waypoints.windows(2) {
        for i in 0..=50 {
            let t = f64::from(i) / 50.0;
            let pose: Vec<f64> = ends[0].iter().zip(&ends[1]).map(|(a, b)| a + t * (b - a)).collect();
            let solution = robot.inverse(&pose).unwrap().into_iter().find(|s| s.mode == plan.mode).unwrap();
            assert!(solution.within_limits, "{pose:?} of {plan:?}");
            let state = robot.state(&pose, &solution.q).unwrap();
            all.push((state.det_a, state.serial_measures.iter().copied().fold(1.0, f64::min)));
        }
    }
    all
}

/// The least |det A| along a path.
fn least_det(robot: &Robot, plan: &Plan) -> f64 {
    sampled(robot, plan).into_iter().map(|(det, _)| det.abs()).fold(f64::INFINITY, f64::min)
}
