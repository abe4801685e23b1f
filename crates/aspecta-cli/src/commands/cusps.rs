//! `aspecta cusps`: where three direct solutions meet.

use crate::args::budget;
use crate::args::fix::{FixArg, OF_FIX_AND_TABLES};
use crate::args::format::TableArgs;
use crate::args::help::{help, value_name};
use crate::args::mode::ModeArg;
use crate::args::robot::RobotArg;
use crate::args::threads::{self, Threads};
use crate::failure::{Answer, Failure};
use crate::output::{Align, FORMAT_VERSION, Labels, Table, json, note, number};
use crate::work::watch::{watched, within_seconds};
use aspecta::domain::cusps::{
    self, CurveEnd, Cusp, CuspCurve, CuspCurves, Doubt, Options, Proof, Undecided, cusp_curves, cusps,
};
use aspecta::num::Interval;
use aspecta::paving::Control;
use aspecta::robot::Robot;
use aspecta_view::words::count;
use clap::Args;
use serde::Serialize;
use std::io::Write;
use std::time::Duration;

/// Arguments of `cusps`.
///
/// A cusp lets the platform change its assembly mode without meeting a singularity, by a loop of the joints
/// round it.
#[derive(Args)]
#[command(mut_args(help("fix", FIX)))]
#[command(mut_args(value_name("fix", "JOINT=VALUE")))]
#[command(mut_args(help("deg", OF_FIX_AND_TABLES)))]
#[command(mut_args(help("mode", "Only the cusps in this working mode, such as `+-+`")))]
#[command(mut_args(help("threads", threads::OF_NO_WEIGHT)))]
#[command(after_help = EXAMPLE)]
pub struct Cusps {
    #[command(flatten)]
    robot: RobotArg,
    #[command(flatten)]
    fix: FixArg,
    #[command(flatten)]
    mode: ModeArg,
    /// Greatest number of boxes to look at [default: 1000000 for each slice]; what is left is undecided
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    boxes: Option<u64>,
    /// How long to look, as 30s or 5min: what is left then is undecided
    #[arg(long, value_name = "TIME", value_parser = budget::parse_time)]
    budget: Option<Duration>,
    #[command(flatten)]
    shown: TableArgs,
    #[command(flatten)]
    threads: Threads,
}

const EXAMPLE: &str = "\
Example: aspecta cusps 3-rpr --fix q1=14.98
lists the six cusps of that slice; that these are all is proved by intervals. `nearby` is how many direct solutions
there are near the cusp for a joint vector on either side of it.
Exit status: 0 cusps, proved to be all; 1 none, or boxes are left undecided; 2 bad input.";

#[derive(Serialize)]
struct Document<'a, T> {
    format_version: u32,
    #[serde(flatten)]
    found: &'a T,
}

const FIX: &str = "\
    The joint that is held: q1=14.98, q2=0.5 (radians) or q2=30deg. Without it, the curves of cusps \
    of a robot with three degrees of freedom, followed numerically";

impl Cusps {
    pub fn run(&self, out: &mut dyn Write) -> Result<Answer, Failure> {
        let robot = self.robot.load()?;
        let mode = self.mode.of(&robot)?;
        let options = Options { fix: self.fix.joints(&robot, self.shown.deg)?, mode, boxes: self.boxes };
        if options.fix.is_empty() && robot.dof() == 3 {
            let found = self.within_budget(|control| cusp_curves(&robot, &options, control))??;
            if self.shown.json() {
                json(out, &Document { format_version: FORMAT_VERSION, found: &found })?;
            } else {
                print_curves(out, &robot, &found, self.shown.deg)?;
            }
            if found.stopped {
                note("stopped: this is the result so far");
            }
            return Ok(Answer::from(!found.curves.is_empty() && !found.stopped));
        }
        let found = self.within_budget(|control| cusps(&robot, &options, control))??;
        if self.shown.json() {
            json(out, &Document { format_version: FORMAT_VERSION, found: &found })?;
        } else {
            print(out, &robot, &found, self.shown.deg)?;
        }
        if found.undecided.iter().any(|u| u.why == Doubt::Cancelled) {
            note("stopped: this is the result so far");
        }
        Ok(Answer::from(found.complete && !found.cusps.is_empty()))
    }

    fn within_budget<T>(&self, work: impl FnOnce(&Control<'_>) -> T) -> Result<T, Failure> {
        let seconds = self.budget.map(|time| time.as_secs_f64());
        watched(self.threads, |control| within_seconds(seconds, control, work))
    }
}

fn print(out: &mut dyn Write, robot: &Robot, found: &cusps::Cusps, degrees: bool) -> Result<(), Failure> {
    let held = found.fixed.iter().map(|h| format!(" at {} = {} {}", h.joint, number(h.value), h.unit));
    let cusps = count(found.cusps.len(), "cusp", "cusps");
    let proof = match (found.complete, found.proof) {
        (false, _) => "not proved to be all",
        (true, Proof::Intervals) => "proved to be all",
        (true, Proof::Quadratic) => "proved: without turning, at most two direct solutions are isolated",
    };
    writeln!(out, "{}: {cusps}{} ({proof})", found.robot, held.collect::<String>())?;
    if !found.cusps.is_empty() {
        write!(out, "{}", table(robot, &found.cusps, degrees))?;
    }
    for (modes, what) in undecided(robot, &found.undecided, degrees) {
        match &modes[..] {
            [mode] => writeln!(out, "undecided, mode {mode}: {what}")?,
            _ => writeln!(out, "undecided, {} modes ({}): {what}", modes.len(), modes.join(", "))?,
        }
    }
    Ok(())
}

/// Undecided boxes of one mode and one reason that are told one by one; more are told together.
const FEW: usize = 3;

/// Returns the undecided boxes, or what holds many of them, each with the modes it is undecided in: a budget
/// that is spent leaves the same in many.
fn undecided(robot: &Robot, boxes: &[Undecided], degrees: bool) -> Vec<(Vec<String>, String)> {
    let mut all: Vec<(Vec<String>, String)> = Vec::new();
    let mut clusters: Vec<Vec<&Undecided>> = Vec::new();
    for u in boxes {
        match clusters.iter_mut().find(|cluster| (cluster[0].mode, cluster[0].why) == (u.mode, u.why)) {
            Some(cluster) => cluster.push(u),
            None => clusters.push(vec![u]),
        }
    }
    for cluster in &clusters {
        let told = if cluster.len() > FEW { vec![&cluster[..]] } else { cluster.chunks(1).collect() };
        for some in told {
            let (mode, place) = (some[0].mode.to_string(), place(robot, some, degrees));
            let many = if some.len() > 1 { format!("{} boxes, ", some.len()) } else { String::new() };
            let what = format!("{many}{place}: {}", reason(some[0].why));
            match all.iter_mut().find(|(_, known)| *known == what) {
                Some((modes, _)) => modes.push(mode),
                None => all.push((vec![mode], what)),
            }
        }
    }
    all
}

fn table(robot: &Robot, cusps: &[Cusp], degrees: bool) -> Table {
    let (pose, joints) = (Labels::pose(robot, degrees), Labels::joints(robot, degrees));
    let right = |name: String| (name, Align::Right);
    let mut headings = vec![("mode".into(), Align::Left)];
    headings.extend(joints.headings().map(right));
    headings.extend(pose.headings().map(right));
    headings.extend([("nearby".into(), Align::Left), ("limits".into(), Align::Left)]);
    let mut table = Table::new(headings);
    for cusp in cusps {
        // What the direct model says on both sides.
        let nearby = if cusp.unfolding.is_some() { "3 | 1" } else { "not seen" };
        let limits = if cusp.within_limits { "within" } else { "beyond" };
        let cells = joints.numbers(&cusp.q).chain(pose.numbers(&cusp.pose));
        table.row(std::iter::once(cusp.mode.to_string()).chain(cells).chain([nearby.into(), limits.into()]));
    }
    table
}

fn print_curves(
    out: &mut dyn Write,
    robot: &Robot,
    found: &CuspCurves,
    degrees: bool,
) -> Result<(), Failure> {
    let (curves, slices) =
        (count(found.curves.len(), "curve", "curves"), count(found.slices.len(), "slice", "slices"));
    writeln!(
        out,
        "{}: {curves} of cusps through {slices} of {} (numerical; curves between slices are not seen)",
        found.robot, found.joint
    )?;
    if !found.slices_complete {
        writeln!(out, "not all slices were searched completely: `--fix {}=VALUE` tells more", found.joint)?;
    }
    if found.curves.is_empty() {
        return Ok(());
    }
    let joints = Labels::joints(robot, degrees);
    let right = |name: String| (name, Align::Right);
    let mut headings = vec![("mode".into(), Align::Left), right("points".into())];
    headings.extend(joints.headings().flat_map(|h| [right(format!("{h} from")), right("to".into())]));
    headings.extend(["first end", "last end"].map(|h| (h.into(), Align::Left)));
    let mut table = Table::new(headings);
    for curve in &found.curves {
        let [least, greatest] = [f64::min as fn(f64, f64) -> f64, f64::max].map(|pick| extremes(curve, pick));
        let ranges = joints.numbers(&least).zip(joints.numbers(&greatest)).flat_map(|(a, b)| [a, b]);
        let ends = curve.ends.map(|end| end_name(end).to_owned());
        table.row(
            [curve.mode.to_string(), curve.points.len().to_string()].into_iter().chain(ranges).chain(ends),
        );
    }
    write!(out, "{table}")?;
    Ok(())
}

/// The least or the greatest value of every joint on a curve.
fn extremes(curve: &CuspCurve, pick: fn(f64, f64) -> f64) -> Vec<f64> {
    let joints = curve.points.iter().map(|p| p.q.clone());
    joints.reduce(|a, b| a.iter().zip(&b).map(|(a, b)| pick(*a, *b)).collect()).unwrap_or_default()
}

fn end_name(end: CurveEnd) -> &'static str {
    match end {
        CurveEnd::Closed => "closed",
        CurveEnd::Window => "window",
        CurveEnd::Serial => "serial singularity",
        CurveEnd::FreeJoint => "free joint",
        CurveEnd::Lost => "lost",
    }
}

/// What holds all of these boxes, from its least to its greatest coordinates.
fn place(robot: &Robot, boxes: &[&Undecided], degrees: bool) -> String {
    let labels = Labels::pose(robot, degrees);
    let bounds = |end: fn(&Interval) -> f64, pick: fn(f64, f64) -> f64| -> Vec<f64> {
        let ends = |k: usize| boxes.iter().map(|u| end(&u.enclosure[k])).reduce(pick).unwrap_or(f64::NAN);
        (0..robot.dof()).map(ends).collect()
    };
    let (lo, hi) = (bounds(|e| e.lo, f64::min), bounds(|e| e.hi, f64::max));
    format!("from {} to {}", labels.sentence(&lo), labels.sentence(&hi))
}

fn reason(why: Doubt) -> String {
    match why {
        Doubt::Serial { leg } => format!("a serial singularity of leg {leg}"),
        Doubt::FreeJoint { leg } => format!("leg {leg} folds onto its crank's axis, its joint is free"),
        Doubt::Rank => "A all but loses two ranks".into(),
        Doubt::Degenerate => "a degenerate cusp, or several that cannot be told apart".into(),
        Doubt::Boxes => "the budget of boxes was spent (--boxes)".into(),
        Doubt::Cancelled => "it was stopped, or its time was over".into(),
    }
}
