//! A configuration to start from: at a pose, or at any that the robot can take.

use super::solve;
use crate::failure::Failure;
use aspecta::Kinematics;
use aspecta::kinematics::{Solution, WorkingMode};
use aspecta::robot::Robot;

/// Poses that are tried before giving up, and how many within reach are enough to choose from.
const TRIES: usize = 200_000;
const ENOUGH: usize = 200;

/// The configuration at a pose within joint limits and farthest from singularities, in `mode` if one is
/// given.
pub fn at(robot: &Robot, pose: &[f64], mode: Option<WorkingMode>) -> Result<Solution, Failure> {
    let solutions = solve::within_reach(robot, pose)?;
    let best = best(robot, solutions, mode)?;
    let modes = mode.map_or("every working mode".into(), |m| format!("working mode {m}"));
    let refused = || Failure::Input(format!("the pose is beyond the robot's joint limits in {modes}"));
    best.map(|(_, solution)| solution).ok_or_else(refused)
}

/// The configuration farthest from singularities among many that fill the window evenly. Always the same.
pub fn anywhere(robot: &Robot, mode: Option<WorkingMode>) -> Result<Solution, Failure> {
    let window = robot
        .workspace_window()
        .map_err(|e| Failure::Input(format!("{e}; or say where to start with --pose")))?;
    let mut found: Vec<(f64, Solution)> = Vec::new();
    for pose in spread(&window.ranges).take(TRIES) {
        found.extend(best(robot, robot.inverse(&pose)?, mode)?);
        if found.len() == ENOUGH {
            break;
        }
    }
    let farthest = found.into_iter().max_by(|a, b| a.0.total_cmp(&b.0));
    farthest.map(|(_, solution)| solution).ok_or_else(|| {
        Failure::Input(format!(
            "`{}`: none of {TRIES} poses is within its reach and limits; say where to start with --pose",
            robot.name
        ))
    })
}

/// Returns, of the solutions within limits (and in `mode`), the one farthest from singularities, and how far
/// it is.
fn best(
    robot: &Robot,
    solutions: Vec<Solution>,
    mode: Option<WorkingMode>,
) -> Result<Option<(f64, Solution)>, Failure> {
    let mut best: Option<(f64, Solution)> = None;
    for solution in solutions.into_iter().filter(|s| s.within_limits && mode.is_none_or(|m| s.mode == m)) {
        let state = robot.state(&solution.pose, &solution.q)?;
        let far = state.serial_measures.iter().copied().fold(state.parallel_measure, f64::min);
        if best.as_ref().is_none_or(|(most, _)| far > *most) {
            best = Some((far, solution));
        }
    }
    Ok(best)
}

/// Poses that fill the ranges evenly, beginning in the middle: the multiples of 1/g, 1/g², …, modulo 1, where
/// gⁿ⁺¹ = g + 1 (Roberts 2018).
fn spread(ranges: &[(f64, f64)]) -> impl Iterator<Item = Vec<f64>> {
    let n = ranges.len() as i32;
    let g = (0..60).fold(1.5_f64, |g, _| (1.0 + g).powf(1.0 / f64::from(n + 1)));
    (0..).map(move |k: u32| {
        let place = |(j, (low, high)): (i32, &(f64, f64))| {
            low + (high - low) * (0.5 + f64::from(k) * g.powi(-j - 1)).fract()
        };
        (0..).zip(ranges).map(place).collect()
    })
}
