//! `aspecta assembly`: the poses of a joint vector by aspects, and how to change from one to another.

use crate::args::planning::Planning;
use crate::args::robot::RobotArg;
use crate::failure::{Answer, Failure};
use crate::input::{self, Columns};
use crate::output::{About, Format, Labels, json, note, number};
use crate::show::numbered::{self, IN_ONE, Numbered, list};
use crate::show::{joined, motion};
use crate::work::planning::{Planned, plan_over_roadmap, route};
use aspecta::Kinematics;
use aspecta::kinematics::{DirectSolutions, WorkingMode};
use aspecta::motion::assembly::{
    AssemblyMode, AssemblyModes, CuspRound, Fold, assembly_modes, cusps_round, folds,
};
use aspecta::motion::explore::join_solutions;
use aspecta::motion::modes::{Configuration, NoRoute};
use aspecta::motion::plan::{Plan, PlanOptions};
use aspecta::robot::{Platform, Robot};
use clap::Args;
use serde::Serialize;
use std::io::Write;

/// Arguments of `assembly`.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Assembly {
    #[command(flatten)]
    robot: RobotArg,
    /// The joint vector, one number per leg
    #[arg(long, value_name = "LIST", allow_hyphen_values = true)]
    q: String,
    /// Plan a change from this direct solution, by its number in the list …
    #[arg(long, value_name = "I", requires = "to", value_parser = clap::value_parser!(u8).range(1..))]
    from: Option<u8>,
    /// … to this one
    #[arg(long, value_name = "J", requires = "from", value_parser = clap::value_parser!(u8).range(1..))]
    to: Option<u8>,
    /// Say what the change goes round: where direct solutions vanish and appear on the way, and cusps
    #[arg(long, requires = "to")]
    explain: bool,
    #[command(flatten)]
    planning: Planning,
}

const EXAMPLES: &str = "\
Examples:
  aspecta assembly 3-rpr --q 14.98,15.38,12
  aspecta assembly 3-rpr --q 14.98,15.38,12 --from 2 --to 3 --explain
  aspecta assembly gough-stewart --q 1,0.645275,1.086284,1.503439,1.281933,0.771071
Solutions in one aspect can be changed into each other without meeting a singularity; those whose det A differs in sign cannot.
Of robots with six coordinates a roadmap says which are joined (aspecta explore); that two could not be joined proves nothing.
Exit status: 0 listed, or planned; 1 no such change (it says whether that is proved), or the list is not proved complete; 2 bad input.";

#[derive(Serialize)]
struct Document<'a> {
    #[serde(flatten)]
    about: About<'a>,
    #[serde(flatten)]
    found: &'a AssemblyModes,
}

/// The assembly modes that were found.
struct Found {
    modes: AssemblyModes,
    change: Option<Planned>,
    explained: Option<(Vec<Fold>, Vec<CuspRound>)>,
}

impl Assembly {
    pub fn run(&self, out: &mut dyn Write) -> Result<Answer, Failure> {
        let robot = self.robot.load()?;
        let options = self.planning.options()?;
        let q = input::list("--q", &self.q, &Columns::joints(&robot), self.planning.shown.deg)?;
        let DirectSolutions { solutions, complete } = robot.direct_certified(&q)?;
        let chosen = self.from.zip(self.to).map(|(i, j)| [usize::from(i), usize::from(j)]);
        if let Some(wrong) = chosen.into_iter().flatten().find(|&k| k > solutions.len()) {
            let count = solutions.len();
            return Err(Failure::Input(format!(
                "solution {wrong}: this joint vector has {count} direct solutions"
            )));
        }
        if robot.platform == Platform::FreeBody {
            let found = DirectSolutions { solutions, complete };
            return self.over_roadmap(out, &robot, &q, found, chosen, &options);
        }
        let through = chosen.is_some_and(|[i, j]| solutions[i - 1].mode != solutions[j - 1].mode);
        let mut modes: Vec<WorkingMode> = solutions.iter().map(|s| s.mode).collect();
        modes.sort_unstable();
        modes.dedup();
        if solutions.is_empty() {
            let (solutions, numbered_among, shared) = Default::default();
            let modes = AssemblyModes { q, complete, solutions, numbered_among, shared };
            return self.print(out, &robot, &Found { modes, change: None, explained: None });
        }
        if let Some(pair) = chosen {
            let end = |k: usize| Configuration { pose: &solutions[k - 1].pose, mode: solutions[k - 1].mode };
            if let Some(refused) = self.planning.refused(&robot, pair.map(end), through, &options)? {
                return motion::print(out, &robot, &refused, &self.planning);
            }
        }
        if through {
            modes.clear();
        }
        let found = self.planning.paved(&robot)?.with_finer(&robot, &modes, |analysis, control| {
            let modes = assembly_modes(analysis, &q)?;
            let Some([from, to]) = chosen else {
                return Ok((Found { modes, change: None, explained: None }, false));
            };
            let [start, goal] = [from, to].map(|k| {
                let solution = &modes.solutions[k - 1].solution;
                Configuration { pose: &solution.pose, mode: solution.mode }
            });
            let change = route(analysis, [start, goal], through, &options, control);
            let more = change.as_ref().is_err_and(NoRoute::is_of_resolution);
            let change = self.planning.film(&robot, Some(analysis), change)?;
            let explicable = change.result.as_ref().ok().filter(|_| self.explain && !through);
            let plan = explicable.map(|route| &route.stretches[0]);
            let explain = |plan: &Plan| {
                let round = if robot.dof() == 3 { cusps_round(&robot, plan, control)? } else { Vec::new() };
                Ok::<_, Failure>((folds(&robot, plan), round))
            };
            let explained = plan.map(explain).transpose()?;
            Ok((Found { modes, change: Some(change), explained }, more))
        })?;
        self.print(out, &robot, &found)
    }

    /// Of a free body: the list by what a roadmap joins, or the change that was chosen.
    fn over_roadmap(
        &self,
        out: &mut dyn Write,
        robot: &Robot,
        q: &[f64],
        found: DirectSolutions,
        chosen: Option<[usize; 2]>,
        options: &PlanOptions,
    ) -> Result<Answer, Failure> {
        if self.explain {
            return Err(Failure::Input(format!(
                "--explain: what a change goes round is told of robots with up to three coordinates; `{}` has six",
                robot.name
            )));
        }
        let Some(pair) = chosen else {
            let joined = self
                .planning
                .explore(|effort, control| Ok(join_solutions(robot, q, found, effort, control)?))?;
            return joined::print(out, robot, &joined, self.planning.shown);
        };
        let [from, to] = pair.map(|k| &found.solutions[k - 1]);
        if from.mode != to.mode {
            return Err(Failure::Input(format!(
                "solutions {} and {} are in working modes {} and {}: changes of working mode are not planned for free bodies",
                pair[0], pair[1], from.mode, to.mode
            )));
        }
        let ends = [&from.pose[..], &to.pose[..]];
        let change = self.planning.explore(|effort, control| {
            let change = plan_over_roadmap(robot, ends, from.mode, options, (effort, control))?;
            self.planning.film(robot, None, change)
        })?;
        motion::print(out, robot, &change, &self.planning)
    }

    fn print(&self, out: &mut dyn Write, robot: &Robot, found: &Found) -> Result<Answer, Failure> {
        let Some(change) = &found.change else {
            match self.planning.shown.format() {
                Format::Json => {
                    json(out, &Document { about: About::of(robot), found: &found.modes })?;
                }
                Format::Csv => {
                    let id = |s: &AssemblyMode| s.aspect.map(|id| id.to_string());
                    numbered::print_csv(out, robot, "aspect", &numbered(&found.modes, id))?;
                }
                Format::Table => print_list(out, robot, &found.modes, self.planning.shown.deg)?,
            }
            return Ok(Answer::from(found.modes.complete && !found.modes.solutions.is_empty()));
        };
        let answer = motion::print(out, robot, change, &self.planning)?;
        if let (Format::Table, Some((folds, cusps))) = (self.planning.shown.format(), &found.explained) {
            explain(out, robot, folds, cusps, self.planning.shown.deg)?;
        } else if self.explain && self.planning.shown.format() != Format::Table {
            note("--explain is for people: it is left out of JSON and CSV");
        }
        Ok(answer)
    }
}

/// Each with a group, as `group` names it.
fn numbered(found: &AssemblyModes, group: impl Fn(&AssemblyMode) -> Option<String>) -> Vec<Numbered<'_>> {
    let solutions = found.solutions.iter();
    solutions.map(|s| Numbered { number: s.number, solution: &s.solution, group: group(s) }).collect()
}

fn print_list(
    out: &mut dyn Write,
    robot: &Robot,
    found: &AssemblyModes,
    degrees: bool,
) -> Result<(), Failure> {
    let rank = |s: &AssemblyMode| s.rank.map(|(k, of)| format!("{k} of {of}"));
    let at = (&found.q[..], found.complete);
    numbered::print_table(out, robot, at, "aspect", &numbered(found, rank), degrees)?;
    for shared in &found.shared {
        let word = if shared.certified {
            IN_ONE
        } else {
            "may lie in one aspect, which is not proved to be one in boxes as fine as these, and no path was found that would join them"
        };
        writeln!(out, "solutions {} {word}", list(&shared.solutions))?;
    }
    if found.shared.is_empty() && found.solutions.len() > 1 {
        let known = found.solutions.iter().all(|s| s.aspect.is_some());
        let word = if known {
            "no two of them lie in one aspect (certified)"
        } else {
            "no two of them are known to lie in one aspect"
        };
        writeln!(out, "{word}")?;
    }
    Ok(())
}

fn explain(
    out: &mut dyn Write,
    robot: &Robot,
    folds: &[Fold],
    cusps: &[CuspRound],
    degrees: bool,
) -> Result<(), Failure> {
    let (pose, joints) = (Labels::pose(robot, degrees), Labels::joints(robot, degrees));
    writeln!(out, "\nWhat it goes round (numerical)")?;
    for fold in folds {
        let (before, after) = fold.solutions;
        let what = if before > after { "vanish" } else { "appear" };
        writeln!(
            out,
            "  segment {}, t = {}: two other poses of the joint vector {what} ({before} -> {after}); they meet at {}",
            fold.segment,
            number(fold.t),
            pose.sentence(&fold.meeting)
        )?;
    }
    if folds.is_empty() {
        writeln!(out, "  the number of direct solutions is the same all along")?;
    }
    for round in cusps {
        let times =
            if round.turns.abs() == 1 { String::new() } else { format!(" {} times", round.turns.abs()) };
        let way = if round.turns > 0 { "counter-clockwise" } else { "clockwise" };
        writeln!(
            out,
            "  round{times} the cusp at {} ({way}, seen along q{}; three poses meet there, at {})",
            joints.sentence(&round.cusp.q),
            round.held,
            pose.sentence(&round.cusp.pose)
        )?;
    }
    if cusps.is_empty() {
        writeln!(
            out,
            "  round no cusp of the slice in which the joint that varies least is held at its mean"
        )?;
    }
    Ok(())
}
