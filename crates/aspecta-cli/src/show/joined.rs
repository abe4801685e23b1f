//! How the direct solutions of a free body are shown, by what a roadmap joins.

use super::numbered::{self, IN_ONE, Numbered, list};
use crate::args::format::ShownArgs;
use crate::failure::{Answer, Failure};
use crate::output::{About, Format, json};
use aspecta::motion::explore::{JoinedSolutions, SharedClass};
use aspecta::robot::Robot;
use aspecta_view::words::count;
use serde::Serialize;
use std::io::Write;

#[derive(Serialize)]
struct Document<'a> {
    #[serde(flatten)]
    about: About<'a>,
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
            json(out, &Document { about: About::of(robot), found })?;
        }
        Format::Csv => numbered::print_csv(out, robot, "joined_set", &numbered(found))?,
        Format::Table => print_list(out, robot, found, shown.deg)?,
    }
    let joined = found.classes.iter().all(|class| class.joined.len() == 1);
    Ok(Answer::from(found.complete && joined && !found.solutions.is_empty()))
}

/// Each with the set it is in: `1` is the first of all sets.
fn numbered(found: &JoinedSolutions) -> Vec<Numbered<'_>> {
    let set_of = |number: usize| {
        let mut sets = found.classes.iter().flat_map(|class| &class.joined);
        sets.position(|set| set.contains(&number)).map(|k| (k + 1).to_string())
    };
    let solutions = found.solutions.iter();
    solutions.map(|s| Numbered { number: s.number, solution: &s.solution, group: set_of(s.number) }).collect()
}

fn print_list(
    out: &mut dyn Write,
    robot: &Robot,
    found: &JoinedSolutions,
    degrees: bool,
) -> Result<(), Failure> {
    let at = (&found.q[..], found.complete);
    numbered::print_table(out, robot, at, "joined set", &numbered(found), degrees)?;
    found.classes.iter().try_for_each(|class| print_class(out, class))?;
    if found.classes.len() > 1 {
        writeln!(out, "solutions of different modes or signs of det A lie in different aspects (certified)")?;
    }
    Ok(())
}

fn print_class(out: &mut dyn Write, class: &SharedClass) -> Result<(), Failure> {
    writeln!(out, "mode {}, det A {}:", class.mode, class.det_a)?;
    for set in &class.joined {
        match &set[..] {
            [alone] => writeln!(out, "  solution {alone} alone")?,
            _ => writeln!(out, "  solutions {} {IN_ONE}", list(set))?,
        }
    }
    if class.joined.len() > 1 {
        writeln!(
            out,
            "  these {} could not be joined within the budget ({}); that they lie in different aspects is not proved",
            class.joined.len(),
            count(class.samples, "sample", "samples")
        )?;
    }
    Ok(())
}
