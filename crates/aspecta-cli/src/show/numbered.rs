//! Numbered direct solutions of a joint vector, each with what it belongs to.

use super::solutions::{SERIAL, mode};
use crate::failure::Failure;
use crate::input::Columns;
use crate::output::{Align, Labels, Table, det_a_unit, exact, number};
use aspecta::kinematics::Solution;
use aspecta::robot::Robot;
use aspecta_view::words::count;
use std::io::Write;

/// A solution, its number from 1, and what it belongs to, if that is known.
pub struct Numbered<'a> {
    pub number: usize,
    pub solution: &'a Solution,
    pub group: Option<String>,
}

/// Prints how many there are at `q`, and a table of them; `group` heads its last column.
pub fn print_table(
    out: &mut dyn Write,
    robot: &Robot,
    (q, complete): (&[f64], bool),
    group: &str,
    solutions: &[Numbered<'_>],
    degrees: bool,
) -> Result<(), Failure> {
    let (pose, joints) = (Labels::pose(robot, degrees), Labels::joints(robot, degrees));
    let all = if complete { "proved to be all" } else { "not proved to be all" };
    let found = count(solutions.len(), "direct solution", "direct solutions");
    writeln!(out, "{}: {found} at {} ({all})", robot.name, joints.sentence(q))?;
    if solutions.is_empty() {
        return Ok(());
    }
    let right = |name: String| (name, Align::Right);
    let headings = [right("solution".into())].into_iter().chain(pose.headings().map(right));
    let last =
        [("mode".to_owned(), Align::Left), right(format!("det A{}", det_a_unit(robot))), right(group.into())];
    let mut table = Table::new(headings.chain(last));
    for Numbered { number: place, solution, group } in solutions {
        let unknown = if solution.within_limits { "undecided" } else { "beyond limits" };
        let group = group.clone().unwrap_or_else(|| unknown.into());
        let last = [mode(solution), number(solution.det_a), group];
        table.row([place.to_string()].into_iter().chain(pose.numbers(&solution.pose)).chain(last));
    }
    write!(out, "{table}")?;
    if solutions.iter().any(|s| !s.solution.serial_legs.is_empty()) {
        writeln!(out, "{SERIAL}")?;
    }
    Ok(())
}

/// Prints the numbered solutions as CSV.
pub fn print_csv(
    out: &mut dyn Write,
    robot: &Robot,
    group: &str,
    solutions: &[Numbered<'_>],
) -> Result<(), Failure> {
    let mut csv = csv::Writer::from_writer(out);
    let names = Columns::pose(robot).names;
    let last = ["mode", "det_a", group].map(String::from);
    csv.write_record(["solution".to_owned()].into_iter().chain(names).chain(last))?;
    for Numbered { number, solution, group } in solutions {
        let last = [solution.mode.to_string(), exact(solution.det_a), group.clone().unwrap_or_default()];
        let pose = solution.pose.iter().map(|x| exact(*x));
        csv.write_record([number.to_string()].into_iter().chain(pose).chain(last))?;
    }
    csv.flush()?;
    Ok(())
}

/// `1, 2, 5`.
pub fn list(numbers: &[usize]) -> String {
    numbers.iter().map(usize::to_string).collect::<Vec<_>>().join(", ")
}

/// The message about solutions that are proved to lie in one aspect.
pub const IN_ONE: &str =
    "lie in one aspect: they can be changed into one another without a singularity (certified)";
