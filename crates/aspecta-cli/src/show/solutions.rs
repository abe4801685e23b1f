//! Prints the solutions of `ik` and `fk`.

use super::beyond::{WithBeyond, entry, of_solution};
use crate::args::given::Query;
use crate::failure::Failure;
use crate::input::Columns;
use crate::output::{Align, Labels, Shown, Table, det_a_unit, exact, number};
use crate::work::solve::Found;
use aspecta::kinematics::{Solution, WorkingMode};
use aspecta::robot::{LegIndex, Robot};
use aspecta_view::words::count;
use serde::Serialize;
use std::io::Write;

/// Which of a solution's vectors was asked for.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Unknown {
    /// The joint vector: `ik`.
    Joints,
    /// The pose: `fk`.
    Pose,
}

/// The solutions of vectors, as they are shown.
pub struct Solutions<'a> {
    /// The robot.
    pub robot: &'a Robot,
    /// What is looked for.
    pub unknown: Unknown,
    /// Whether people read angles in degrees.
    pub degrees: bool,
}

/// The JSON answer to a vector; for vectors of a file it repeats the vector, `pose` for `ik`, `q` for `fk`.
#[derive(Serialize)]
struct Answer<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    pose: Option<&'a [f64]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    q: Option<&'a [f64]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    complete: Option<bool>,
    solutions: Vec<WithBeyond<'a, Solution>>,
}

impl Shown for Solutions<'_> {
    type Found = Found;

    fn robot(&self) -> &Robot {
        self.robot
    }

    fn line(&self, found: &Found) -> Option<u64> {
        found.query.line
    }

    fn is_positive(&self, found: &Found) -> bool {
        !found.solutions.is_empty() && found.complete != Some(false)
    }

    fn json(&self, found: &Found) -> impl Serialize {
        let given = found.query.line.map(|_| found.query.values.as_slice());
        let (pose, q) = if self.unknown == Unknown::Joints { (given, None) } else { (None, given) };
        let solutions = found.solutions.iter().map(|s| WithBeyond::of(self.robot, s)).collect();
        Answer { pose, q, complete: found.complete, solutions }
    }

    fn columns(&self) -> Vec<String> {
        let labels = ["mode", "det_a", "residual", "certified", "within_limits"].map(String::from);
        Columns::pose(self.robot).and(&Columns::joints(self.robot)).names.into_iter().chain(labels).collect()
    }

    fn records(&self, found: &Found) -> Vec<Vec<String>> {
        let record = |s: &Solution| {
            let numbers = s.pose.iter().chain(&s.q).map(|x| exact(*x));
            let labels = [
                s.mode.to_string(),
                exact(s.det_a),
                exact(s.residual),
                s.certified.to_string(),
                s.within_limits.to_string(),
            ];
            numbers.chain(labels).collect()
        };
        found.solutions.iter().map(record).collect()
    }

    fn lines(&self, found: &Found) -> usize {
        found.solutions.len()
    }

    fn table(&self, out: &mut dyn Write, found: &[Found]) -> Result<(), Failure> {
        print_table(out, self, found)
    }
}

fn print_table(out: &mut dyn Write, shown: &Solutions<'_>, found: &[Found]) -> Result<(), Failure> {
    let Solutions { robot, unknown, degrees } = *shown;
    let (pose, joints) = (Labels::pose(robot, degrees), Labels::joints(robot, degrees));
    let (given, model) = if unknown == Unknown::Joints { (pose, "inverse") } else { (joints, "direct") };
    let total: usize = found.iter().map(|f| f.solutions.len()).sum();
    let solutions = count(total, &format!("{model} solution"), &format!("{model} solutions"));
    match found {
        [Found { query: query @ Query { line: None, .. }, .. }] => {
            writeln!(out, "{}: {solutions} at {}", robot.name, given.sentence(&query.values))?;
        }
        _ => writeln!(out, "{}: {solutions} of {}", robot.name, count(found.len(), "row", "rows"))?,
    }
    if total > 0 {
        write!(out, "{}", table(shown, found))?;
    }
    let open: Vec<&Found> = found.iter().filter(|f| f.complete == Some(false)).collect();
    if !open.is_empty() {
        let reason = if robot.platform.turns_in_space() {
            "fewer complex solutions are proved than such robots have: two may be too close to be told apart, or the geometry is special"
        } else {
            "two are too close to be told apart"
        };
        let lines: Vec<String> =
            open.iter().filter_map(|f| f.query.line).map(|line| line.to_string()).collect();
        let of = if lines.is_empty() { String::new() } else { format!(" of line {}", lines.join(", ")) };
        writeln!(out, "not proved to be all solutions{of}: {reason}")?;
    }
    if found.iter().flat_map(|f| &f.solutions).any(|s| !s.serial_legs.is_empty()) {
        writeln!(out, "{SERIAL}")?;
    }
    Ok(())
}

fn table(shown: &Solutions<'_>, found: &[Found]) -> Table {
    let Solutions { robot, unknown, degrees } = *shown;
    let (pose, joints) = (Labels::pose(robot, degrees), Labels::joints(robot, degrees));
    let wanted = if unknown == Unknown::Joints { &joints } else { &pose };
    let numbered = found.iter().any(|f| f.query.line.is_some());
    let right = |name: String| (name, Align::Right);
    let mut headings = Vec::new();
    if numbered {
        headings.push(right("line".into()));
    }
    headings.push(("mode".into(), Align::Left));
    headings.extend(wanted.headings().map(right));
    headings.push(right(format!("det A{}", det_a_unit(robot))));
    headings.push(right("residual".into()));
    headings.push(("certified".into(), Align::Left));
    headings.push(("limits".into(), Align::Left));
    let mut table = Table::new(headings);
    for f in found {
        for s in &f.solutions {
            let unknowns = if unknown == Unknown::Joints { &s.q } else { &s.pose };
            let line = f.query.line.map(|l| l.to_string());
            let labels = [
                number(s.det_a),
                format!("{:.0e}", s.residual),
                if s.certified { "yes" } else { "no" }.into(),
                entry(&of_solution(robot, s)),
            ];
            table.row(line.into_iter().chain([mode(s)]).chain(wanted.numbers(unknowns)).chain(labels));
        }
    }
    table
}

/// The explanation of a 0 in a mode.
pub const SERIAL: &str =
    "0 in a mode: the leg is at a serial singularity, where its postures meet (or its joint is free)";

/// The working mode, with 0 for legs at a serial singularity.
pub fn mode(solution: &Solution) -> String {
    signs(solution.mode, &solution.serial_legs)
}

/// The signs of a mode, with 0 for these legs.
pub fn signs(mode: WorkingMode, serial_legs: &[LegIndex]) -> String {
    let sign = |(j, sign)| if serial_legs.contains(&LegIndex::new(j)) { '0' } else { sign };
    mode.to_string().chars().enumerate().map(sign).collect()
}
