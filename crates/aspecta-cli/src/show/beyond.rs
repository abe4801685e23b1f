//! Which limits a configuration goes beyond.

use aspecta::Kinematics;
use aspecta::kinematics::{Solution, State, WorkingMode};
use aspecta::robot::Robot;
use serde::Serialize;

/// Something found, with the names of the limits that it goes beyond.
#[derive(Serialize)]
pub struct WithBeyond<'a, T> {
    #[serde(flatten)]
    found: &'a T,
    beyond: Vec<String>,
}

impl<'a> WithBeyond<'a, Solution> {
    pub fn of(robot: &Robot, solution: &'a Solution) -> Self {
        Self { found: solution, beyond: of_solution(robot, solution) }
    }
}

/// The names of the limits that a solution goes beyond.
pub fn of_solution(robot: &Robot, solution: &Solution) -> Vec<String> {
    if solution.within_limits { Vec::new() } else { names(robot, &solution.pose, solution.mode) }
}

/// The names of the limits that a state goes beyond.
pub fn of_state(robot: &Robot, state: &State) -> Vec<String> {
    let mode = WorkingMode::from_signs(state.b.iter().map(|b| *b > 0.0));
    if state.within_limits { Vec::new() } else { names(robot, &state.pose, mode) }
}

/// The names of the limits that the robot goes beyond at a pose, in a working mode.
pub fn names(robot: &Robot, pose: &[f64], mode: WorkingMode) -> Vec<String> {
    // A pose that was solved for is one of the robot.
    let broken = robot.broken_limits(pose, mode).unwrap_or_default();
    broken.into_iter().map(|bound| bound.named(robot)).collect()
}

/// The entry of a table: within limits, or beyond which.
pub fn entry(beyond: &[String]) -> String {
    if beyond.is_empty() { "within".into() } else { format!("beyond: {}", beyond.join(", ")) }
}
