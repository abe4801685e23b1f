//! A configuration to start from: at a pose, or at any that the robot can take.

use super::{Kinematics, KinematicsError, OutOfReach, Solution};
use aspecta_robot::{LegIndex, Robot, Unbounded, WorkingMode};

/// Poses that are tried before giving up, and how many within reach are enough to choose from.
const TRIES: usize = 200_000;
const ENOUGH: usize = 200;

/// Why there is no configuration to start from.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NoStart {
    /// The pose does not fit the robot.
    #[error(transparent)]
    Kinematics(#[from] KinematicsError),
    /// Poses cannot be tried where nothing bounds them.
    #[error("{0}; or say at which pose to start")]
    Unbounded(#[from] Unbounded),
    /// Legs do not reach the pose.
    #[error("the pose is out of reach of {}", .0.iter().map(|leg| format!("leg {leg}")).collect::<Vec<_>>().join(", "))]
    OutOfReach(Vec<LegIndex>),
    /// The pose is within reach, but not within limits.
    #[error("the pose is beyond the robot's joint limits in {}", modes(*.0))]
    Beyond(Option<WorkingMode>),
    /// Nothing was found, which is no proof that there is nothing.
    #[error("`{robot}`: none of {TRIES} poses is within its reach and limits; say at which pose to start")]
    NotFound {
        /// The robot.
        robot: String,
    },
}

fn modes(mode: Option<WorkingMode>) -> String {
    mode.map_or("every working mode".into(), |mode| format!("working mode {mode}"))
}

/// The configuration at a pose within joint limits and farthest from singularities, in `mode` if one is
/// given. Numerical.
///
/// # Errors
/// The pose does not fit the robot, is out of reach, or beyond limits in `mode`.
pub fn at(robot: &Robot, pose: &[f64], mode: Option<WorkingMode>) -> Result<Solution, NoStart> {
    let solutions = robot.inverse(pose)?;
    if solutions.is_empty() {
        let legs = robot.out_of_reach(pose)?.iter().map(|OutOfReach { leg, .. }| *leg).collect();
        return Err(NoStart::OutOfReach(legs));
    }
    best(robot, solutions, mode)?.map(|(_, solution)| solution).ok_or(NoStart::Beyond(mode))
}

/// The configuration farthest from singularities among many that fill the window evenly. Always the same.
/// Numerical.
///
/// # Errors
/// Nothing bounds the workspace, or no pose that was tried is within reach and limits.
///
/// # Examples
/// ```
/// use aspecta_kinematics::start;
/// use aspecta_robot::Robot;
///
/// let robot = Robot::resolve("3-rrr")?;
/// let start = start::anywhere(&robot, Some("+-+".parse()?))?;
/// assert!(start.within_limits && start.mode.to_string() == "+-+");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn anywhere(robot: &Robot, mode: Option<WorkingMode>) -> Result<Solution, NoStart> {
    let window = robot.workspace_window()?;
    let mut found: Vec<(f64, Solution)> = Vec::new();
    for pose in spread(&window.ranges).take(TRIES) {
        found.extend(best(robot, robot.inverse(&pose)?, mode)?);
        if found.len() == ENOUGH {
            break;
        }
    }
    let farthest = found.into_iter().max_by(|a, b| a.0.total_cmp(&b.0));
    farthest.map(|(_, solution)| solution).ok_or_else(|| NoStart::NotFound { robot: robot.name.clone() })
}

/// Returns, of the solutions within limits (and in `mode`), the one farthest from singularities, and how far
/// it is.
fn best(
    robot: &Robot,
    solutions: Vec<Solution>,
    mode: Option<WorkingMode>,
) -> Result<Option<(f64, Solution)>, KinematicsError> {
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
