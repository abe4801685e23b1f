//! How the direct solutions of a free body are shown, by what a roadmap joins.

use super::queries::{Labels, det_a_unit};
use crate::failure::{Answer, Failure};
use crate::input::Columns;
use crate::output::{Align, FORMAT_VERSION, Format, ShownArgs, Table, exact, json, number};
use aspecta::motion::explore::{JoinedSolutions, SharedClass};
use aspecta::robot::Robot;
use serde::Serialize;
use std::io::Write;

#[derive(Serialize)]
struct Document<'a> {
    format_version: u32,
    robot: &'a str,
    #[serde(flatten)]
    found: &'a JoinedSolutions,
}

/// Prints them. The answer is yes if they are proved to be all, and all that could be joined are.
pub fn print(
    out: &mut dyn Write,
    robot: &Robot,
    found: &JoinedSolutions,
    shown: ShownArgs,
) -> Result<Answer, Failure> {
    match shown.format() {
        Format::Json => {
            json(out, &Document { format_version: FORMAT_VERSION, robot: &robot.name, found })?;
        }
        Format::Csv => print_csv(out, robot, found)?,
        Format::Table => print_list(out, robot, found, shown.deg)?,
    }
    let joined = found.classes.iter().all(|class| class.joined.len() == 1);
    Ok(Answer::from(found.complete && joined && !found.solutions.is_empty()))
}

/// The name of the set a solution is in: `1` for the first of all sets.
fn set_of(found: &JoinedSolutions, number: usize) -> Option<usize> {
    let mut sets = found.classes.iter().flat_map(|class| &class.joined);
    sets.position(|set| set.contains(&number)).map(|k| k + 1)
}

fn print_list(
    out: &mut dyn Write,
    robot: &Robot,
    found: &JoinedSolutions,
    degrees: bool,
) -> Result<(), Failure> {
    let (pose, joints) = (Labels::pose(robot, degrees), Labels::joints(robot, degrees));
    let all = if found.complete { "proved to be all" } else { "not proved to be all" };
    let count = found.solutions.len();
    writeln!(out, "{}: {count} direct solutions at {} ({all})", robot.name, joints.sentence(&found.q))?;
    let right = |name: String| (name, Align::Right);
    let headings = [right("solution".into())].into_iter().chain(pose.headings().map(right));
    let last = [
        ("mode".to_owned(), Align::Left),
        right(format!("det A{}", det_a_unit(robot))),
        right("joined set".into()),
    ];
    let mut table = Table::new(headings.chain(last));
    for s in &found.solutions {
        let set = match (set_of(found, s.number), s.solution.within_limits) {
            (Some(set), _) => set.to_string(),
            (None, false) => "beyond limits".into(),
            (None, true) => "undecided".into(),
        };
        let last = [s.solution.mode.to_string(), number(s.solution.det_a), set];
        table.row([s.number.to_string()].into_iter().chain(pose.numbers(&s.solution.pose)).chain(last));
    }
    if count > 0 {
        write!(out, "{table}")?;
    }
    found.classes.iter().try_for_each(|class| print_class(out, class))?;
    if found.classes.len() > 1 {
        writeln!(out, "solutions of different modes or signs of det A lie in different aspects (certified)")?;
    }
    Ok(())
}

fn print_class(out: &mut dyn Write, class: &SharedClass) -> Result<(), Failure> {
    writeln!(out, "mode {}, det A {}:", class.mode, class.det_a)?;
    for set in &class.joined {
        let list = set.iter().map(usize::to_string).collect::<Vec<_>>().join(", ");
        match set.len() {
            1 => writeln!(out, "  solution {list} alone")?,
            _ => writeln!(
                out,
                "  solutions {list} lie in one aspect: they can be changed into one another without a singularity (certified)"
            )?,
        }
    }
    if class.joined.len() > 1 {
        writeln!(
            out,
            "  these {} could not be joined within the budget ({} samples); that they lie in different aspects is not proved",
            class.joined.len(),
            class.samples
        )?;
    }
    Ok(())
}

fn print_csv(out: &mut dyn Write, robot: &Robot, found: &JoinedSolutions) -> Result<(), Failure> {
    let mut csv = csv::Writer::from_writer(out);
    let names = Columns::pose(robot).names;
    let last = ["mode", "det_a", "joined_set"].map(String::from);
    csv.write_record(["solution".to_owned()].into_iter().chain(names).chain(last))?;
    for s in &found.solutions {
        let set = set_of(found, s.number).map_or(String::new(), |set| set.to_string());
        let last = [s.solution.mode.to_string(), exact(s.solution.det_a), set];
        let pose = s.solution.pose.iter().map(|x| exact(*x));
        csv.write_record([s.number.to_string()].into_iter().chain(pose).chain(last))?;
    }
    csv.flush()?;
    Ok(())
}
