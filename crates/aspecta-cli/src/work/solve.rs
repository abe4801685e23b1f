//! The inverse and direct problems as commands pose them: where there is no solution, they say why.

use crate::args::given::Query;
use crate::failure::Failure;
use crate::output::{note, number};
use aspecta::Kinematics;
use aspecta::kinematics::{DirectSolutions, KinematicsError, Solution, WorkingMode};
use aspecta::robot::Robot;

/// A vector asked about and its solutions.
pub struct Found {
    /// The question.
    pub query: Query,
    /// The answers.
    pub solutions: Vec<Solution>,
    /// Whether, for a direct problem, these are proved to be all.
    pub complete: Option<bool>,
}

/// Returns all inverse solutions at a pose, given alone or in a line of a file; says why if there are none,
/// which is an answer.
pub fn inverse(robot: &Robot, pose: &[f64], line: Option<u64>) -> Result<Vec<Solution>, Failure> {
    let Some(solutions) = answered(robot.inverse(pose), line)? else { return Ok(Vec::new()) };
    if solutions.is_empty() {
        let place = line.map_or("the pose is ".to_owned(), |line| format!("line {line}: "));
        note(&format!("{place}{}", out_of_reach(robot, pose)?));
    }
    Ok(solutions)
}

/// The inverse solutions at a pose that must be within reach.
pub fn within_reach(robot: &Robot, pose: &[f64]) -> Result<Vec<Solution>, Failure> {
    let solutions = robot.inverse(pose)?;
    if solutions.is_empty() {
        return Err(Failure::Input(format!("the pose is {}", out_of_reach(robot, pose)?)));
    }
    Ok(solutions)
}

/// Returns all direct solutions of a joint vector, or those in a working mode.
pub fn direct(robot: &Robot, query: Query, mode: Option<WorkingMode>) -> Result<Found, Failure> {
    let Some(found) = answered(robot.direct_certified(&query.values), query.line)? else {
        return Ok(Found { query, solutions: Vec::new(), complete: None });
    };
    let DirectSolutions { mut solutions, complete } = found;
    solutions.retain(|s| mode.is_none_or(|m| s.mode == m));
    if solutions.is_empty() {
        let place = query.line.map_or(String::new(), |line| format!("line {line}: "));
        let which = mode.map_or(String::new(), |m| format!(" in working mode {m}"));
        let proof = if complete { "" } else { " was found (that there is none is not proved)" };
        note(&format!("{place}no direct solution{which}{proof}"));
    }
    Ok(Found { query, solutions, complete: Some(complete) })
}

/// What is found of a vector given alone or in a line of a file; there, one that cannot be asked about does not
/// cost the others: it is named, and has no answer.
pub fn answered<T>(found: Result<T, KinematicsError>, line: Option<u64>) -> Result<Option<T>, Failure> {
    match (found, line) {
        (Ok(found), _) => Ok(Some(found)),
        (Err(e), None) => Err(e.into()),
        (Err(e), Some(line)) => {
            note(&format!("line {line}: {e}"));
            Ok(None)
        }
    }
}

/// Returns which legs do not reach `pose`, in a sentence.
fn out_of_reach(robot: &Robot, pose: &[f64]) -> Result<String, Failure> {
    let legs = robot.out_of_reach(pose)?.into_iter().map(|leg| {
        let unit = if leg.angle { "rad" } else { &robot.length_unit };
        format!("leg {} by {} {unit}", leg.leg, number(leg.gap))
    });
    Ok(format!("out of reach: {}", legs.collect::<Vec<_>>().join(", ")))
}
