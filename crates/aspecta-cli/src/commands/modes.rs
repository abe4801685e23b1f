//! `aspecta modes`: which aspects a robot can go between by changing the postures of its legs.

use crate::args::format::TableArgs;
use crate::args::help::help;
use crate::args::out::OutDir;
use crate::args::planning::Analysing;
use crate::args::robot::RobotArg;
use crate::failure::{Answer, Failure};
use crate::output::{About, Align, Labels, Table, brief, json, note};
use crate::show::groups::AS_FAR;
use aspecta::aspect::{AspectId, Count};
use aspecta::motion::modes::ModeGraph;
use aspecta::robot::Robot;
use aspecta_view::words::{between, count};
use aspecta_view::{file, mode_graph};
use clap::Args;
use serde::Serialize;
use std::io::Write;

/// Arguments of `modes`.
///
/// A leg changes its posture in its serial singularity (B_jj = 0). As long as det A ≠ 0 there, the robot
/// stays under control, and the aspects of two working modes become one larger domain of motion.
#[derive(Args)]
#[command(mut_args(help("out", "Draw the graph: modes.svg in this directory")))]
#[command(mut_args(help("deg", "Angles of the tables are in degrees")))]
#[command(after_help = EXAMPLES)]
pub struct Modes {
    #[command(flatten)]
    robot: RobotArg,
    #[command(flatten)]
    out: OutDir,
    #[command(flatten)]
    analysing: Analysing,
    #[command(flatten)]
    shown: TableArgs,
}

const EXAMPLES: &str = "\
Example: aspecta modes five-bar
A crossing is proved by intervals: det A keeps its sign while the leg goes through its serial singularity. Aspects of different signs of
det A are never joined, which is proved too; that there are no other crossings is not.
Exit status: 0 done; 1 stopped before all crossings were looked for; 2 bad input.";

#[derive(Serialize)]
struct Document<'a> {
    #[serde(flatten)]
    about: About<'a>,
    #[serde(flatten)]
    graph: &'a ModeGraph,
}

impl Modes {
    pub fn run(&self, out: &mut dyn Write) -> Result<Answer, Failure> {
        let robot = self.robot.load()?;
        self.out.check()?;
        let graph =
            self.analysing.with(&robot, &[], |analysis, control| Ok(ModeGraph::new(analysis, control)))?;
        if self.shown.json() {
            json(out, &Document { about: About::of(&robot), graph: &graph })?;
        } else {
            print(out, &robot, &graph, self.shown.deg)?;
        }
        if let Some(directory) = self.out.directory() {
            let drawn = file::put(directory, "modes.svg", mode_graph(&robot, &graph));
            let path = drawn.map_err(Failure::in_directory(directory))?;
            let written = format!("figure: {}", path.display());
            self.shown.format().say(out, &written)?;
        }
        if !graph.searched {
            note("the search for crossings was stopped: there may be more");
        }
        Ok(Answer::from(graph.searched))
    }
}

fn print(out: &mut dyn Write, robot: &Robot, graph: &ModeGraph, degrees: bool) -> Result<(), Failure> {
    let labels = Labels::pose(robot, degrees);
    let right = |name: &str| (name.to_owned(), Align::Right);
    let Count { low, high, .. } = graph.count;
    let found = between(low, high, "aspect", "aspects");
    let finer = if high.is_none() { " (finer boxes, --budget, may show more)" } else { "" };
    let crossings = match graph.crossings.len() {
        0 => "no crossings found".into(),
        n => format!("{} found, each proved", count(n, "crossing", "crossings")),
    };
    writeln!(out, "{}: {found}{finer}, {crossings}", robot.name)?;
    if !graph.unseen.is_empty() {
        let unseen: Vec<String> =
            graph.unseen.iter().map(|(mode, sign)| format!("{mode} det A {sign}")).collect();
        writeln!(out, "no aspect was seen, and none is excluded, in {}", unseen.join(", "))?;
    }
    if graph.crossings.is_empty() {
        return Ok(());
    }
    let headings = labels.headings().map(|name| (name, Align::Right));
    let first = [right("aspects"), right("modes"), right("det A"), right("leg")];
    let mut table = Table::new(first.into_iter().chain(headings).chain([right("clearance")]));
    for c in &graph.crossings {
        let first = [
            format!("{} - {}", c.aspects[0], c.aspects[1]),
            format!("{} {}", c.modes[0], c.modes[1]),
            c.det_a.to_string(),
            c.leg.to_string(),
        ];
        table.row(first.into_iter().chain(labels.numbers(&c.pose)).chain([brief(c.clearance)]));
    }
    write!(out, "{table}")?;
    writeln!(out, "\nAspects that can be reached from one another without a parallel singularity")?;
    for group in &graph.groups {
        let name = |id: &AspectId| {
            let mode = graph
                .aspects
                .iter()
                .find(|a| a.id == *id)
                .map(|a| format!(" ({} det A {})", a.mode, a.det_a));
            format!("{id}{}", mode.unwrap_or_default())
        };
        let word = if graph.is_proved(group) { "certified" } else { AS_FAR };
        writeln!(out, "  {}: {word}", group.iter().map(name).collect::<Vec<_>>().join(", "))?;
    }
    Ok(())
}
