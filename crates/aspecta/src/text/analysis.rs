//! The result of an analysis for people, in 100 columns.

use super::{Align, Labels, Table, between, brief, doubts, paragraph, remarks};
use crate::aspect::{
    Analysis, Aspect, AspectClass, Count, DetSign, EarlierAspects, Held, Measure, Reachable, Run,
};
use crate::paving::Stop;
use aspecta_kinematics::WorkingMode;
use aspecta_robot::Robot;
use aspecta_robot::num::count;
use std::fmt::{self, Write};

/// Aspects listed; the rest is in the analysis.
const LISTED: usize = 40;

/// Columns of ranges that fit side by side.
const WIDEST: usize = 4;

/// What Definitions 5 and 6 need.
pub const EARLIER_NEED: &str =
    "they are made of all working modes, of up to 8, together, by a run that was not stopped";

/// What is said after `… and 3 more`: where a program shows the rest.
#[derive(Clone, Copy, Debug, Default)]
pub struct AnalysisAdvice {
    /// Of aspects.
    pub on_aspects: &'static str,
    /// Of doubts.
    pub on_doubts: &'static str,
}

/// An analysis as a summary that a person reads, with a program's advice.
#[derive(Clone, Copy, Debug)]
pub struct AnalysisSummary<'a> {
    /// The analysis.
    pub analysis: &'a Analysis,
    /// Whether angles are in degrees; else in radians.
    pub degrees: bool,
    /// The advice.
    pub advice: AnalysisAdvice,
}

/// Prints Theorem 1, Table 1, Definitions 5 and 6, the aspects and their ranges, the run, and last Table 2, the
/// number of aspects and where its bounds are apart, in 100 columns.
///
/// # Examples
/// ```
/// use aspecta::{Budget, Control, Options, Robot, analyze};
///
/// # fn main() -> Result<(), aspecta::Error> {
/// let robot = Robot::resolve("five-bar")?;
/// let budget = Budget { depth: Some(7), ..Budget::default() };
/// let options = Options { budget, ..Options::default() };
/// let summary = analyze(&robot, &options, &Control::unwatched())?.to_string();
/// assert!(summary.contains("Table 2: generalized aspects (Def. 8), area in unit^2"));
/// # Ok(())
/// # }
/// ```
impl fmt::Display for Analysis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        AnalysisSummary { analysis: self, degrees: false, advice: AnalysisAdvice::default() }.fmt(f)
    }
}

impl fmt::Display for AnalysisSummary<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write(f, *self)
    }
}

fn write(out: &mut dyn Write, summary: AnalysisSummary<'_>) -> fmt::Result {
    let AnalysisSummary { analysis, degrees, .. } = summary;
    let robot = &analysis.robot;
    let title = if robot.title.is_empty() { String::new() } else { format!(": {}", robot.title) };
    writeln!(
        out,
        "{}",
        paragraph(&format!("{}{title} ({}, {} legs)", robot.name, robot.platform, robot.dof()))
    )?;
    if let Some(slice) = slice(analysis) {
        writeln!(out, "{}", paragraph(&slice))?;
    }
    theorem_1(out, analysis)?;
    table_1(out, analysis, degrees)?;
    let earlier_sets = [
        ("Def. 5, parallel aspects", &analysis.parallel_aspects),
        ("Def. 6, serial aspects", &analysis.serial_aspects),
    ];
    writeln!(out)?;
    for (name, sets) in earlier_sets.into_iter().filter(|(_, sets)| !sets.is_empty()) {
        writeln!(out, "{}", paragraph(&earlier(name, sets, &analysis.measure)))?;
    }
    if analysis.parallel_aspects.is_empty() {
        writeln!(out, "{}", paragraph(&format!("Defs 5 and 6: left out, {EARLIER_NEED}.")))?;
    }
    aspects(out, summary)?;
    ranges(out, analysis, degrees)?;
    writeln!(out, "\n{}", paragraph(&run(analysis, degrees)))?;
    // Last, where a terminal shows it: how many there are, and why that is not known better.
    table_2(out, analysis)?;
    doubts::write(out, summary)
}

/// What was held, if anything.
fn slice(analysis: &Analysis) -> Option<String> {
    let held: Vec<_> = analysis.fixed.iter().map(Held::to_string).collect();
    let robot = &analysis.robot;
    let free = analysis.window.axes().into_iter().map(|k| robot.platform.coordinates()[k].name);
    let free = free.collect::<Vec<_>>().join(", ");
    let note = "det A is that of the whole robot";
    (!held.is_empty()).then(|| format!("slice {} (free: {free}; {note})", held.join(", ")))
}

/// One line for all legs of the same answer.
fn theorem_1(out: &mut dyn Write, analysis: &Analysis) -> fmt::Result {
    let holds = analysis.legs.iter().all(|l| !l.cuspidal && l.postures <= 2);
    let verdict = if holds { "separate" } else { "do not separate" };
    writeln!(out, "\nTheorem 1: working modes {verdict} the inverse solutions")?;
    for same in analysis
        .legs
        .chunk_by(|a, b| (a.actuator, a.cuspidal, a.reason) == (b.actuator, b.cuspidal, b.reason))
    {
        let (first, last) = (&same[0], &same[same.len() - 1]);
        let legs = if same.len() == 1 {
            format!("leg {}", first.leg)
        } else {
            format!("legs {}-{}", first.leg, last.leg)
        };
        let cuspidal = if first.cuspidal { "cuspidal" } else { "not cuspidal" };
        writeln!(
            out,
            "{}",
            paragraph(&format!("  {legs} ({}): {cuspidal}: {}", first.actuator, first.reason))
        )?;
    }
    Ok(())
}

fn table_1(out: &mut dyn Write, analysis: &Analysis, degrees: bool) -> fmt::Result {
    writeln!(out, "\nTable 1: working modes (Def. 7)")?;
    let shown = shown(analysis);
    let labels = Labels::pose(&analysis.robot, degrees).only(&shown);
    let signs = sign_headings(&analysis.robot);
    let last = [("reachable".into(), Align::Left), ("for example at".into(), Align::Left)];
    let mut table = Table::new([("mode".to_owned(), Align::Left)].into_iter().chain(signs).chain(last));
    for report in &analysis.modes {
        let signs = signs_of(report.mode);
        let reachable = match report.reachable {
            Reachable::Yes => "yes",
            Reachable::No => "no",
            Reachable::Undecided => "undecided",
        };
        let example = report.sample.as_ref().map_or(String::new(), |s| labels.brief(&at(&s.pose, &shown)));
        let number = format!("Mf{}", report.number);
        table.row([number].into_iter().chain(signs).chain([reachable.into(), example]));
    }
    write!(out, "{table}")
}

/// Whether the coordinates of a robot are too many for a line of the terminal: those that are held, and the joints, are left to the JSON.
fn is_wide(robot: &Robot) -> bool {
    robot.dof() > 3
}

/// The pose coordinates that are listed.
fn shown(analysis: &Analysis) -> Vec<usize> {
    if is_wide(&analysis.robot) { analysis.window.axes() } else { (0..analysis.robot.dof()).collect() }
}

fn at(values: &[f64], which: &[usize]) -> Vec<f64> {
    which.iter().filter_map(|&k| values.get(k).copied()).collect()
}

/// A column a sign, or one for all if they are many.
fn sign_headings(robot: &Robot) -> impl Iterator<Item = (String, Align)> {
    let n = robot.dof();
    let headings: Vec<String> = if is_wide(robot) {
        vec![format!("B_11 … B_{n}{n}")]
    } else {
        (1..=n).map(|j| format!("B_{j}{j}")).collect()
    };
    headings.into_iter().map(|heading| (heading, Align::Left))
}

/// The signs of a mode, as [`sign_headings`] arranges them.
fn signs_of(mode: WorkingMode) -> Vec<String> {
    if mode.legs() > 3 {
        return vec![mode.to_string()];
    }
    mode.signs().map(|s| if s > 0 { " +" } else { " -" }.to_owned()).collect()
}

fn table_2(out: &mut dyn Write, analysis: &Analysis) -> fmt::Result {
    writeln!(
        out,
        "\nTable 2: generalized aspects (Def. 8), {} in {}",
        analysis.measure.name, analysis.measure.unit
    )?;
    let signs = sign_headings(&analysis.robot);
    let numbers = ["aspects", "certified inside", "undecided", "undecided share"];
    let numbers = numbers.map(|name| (name.to_owned(), Align::Right));
    let mut table = Table::new([("det A".to_owned(), Align::Left)].into_iter().chain(signs).chain(numbers));
    // The paper's order: all modes with det A > 0, then all with det A < 0.
    for det_a in [DetSign::Positive, DetSign::Negative] {
        for class in analysis.classes.iter().filter(|c| c.det_a == det_a) {
            let signs = signs_of(class.mode);
            let numbers =
                [bounds(class.low, class.high), brief(class.measure), brief(class.undecided), share(class)];
            table.row([format!("  {det_a}")].into_iter().chain(signs).chain(numbers));
        }
    }
    write!(out, "{table}")?;
    let count = &analysis.aspects;
    let total = match count.high {
        Some(high) if high == count.low => format!("certified: exactly {high}"),
        Some(high) => format!("certified: at least {} and at most {high}", count.low),
        None => format!("certified: at least {}; no upper bound is proved at this resolution", count.low),
    };
    let of_slice = if analysis.fixed.is_empty() { "" } else { " of the slice" };
    writeln!(out, "{}", paragraph(&format!("number of generalized aspects{of_slice}, {total}")))?;
    remarks(analysis).iter().try_for_each(|remark| writeln!(out, "{}", paragraph(remark)))
}

fn aspects(out: &mut dyn Write, summary: AnalysisSummary<'_>) -> fmt::Result {
    let AnalysisSummary { analysis, degrees, advice } = summary;
    let all: Vec<(&AspectClass, &Aspect)> =
        analysis.classes.iter().flat_map(|c| c.aspects.iter().map(move |a| (c, a))).collect();
    if all.is_empty() {
        return Ok(());
    }
    writeln!(out, "\nAspects, each with a configuration inside")?;
    let (shown, robot) = (shown(analysis), &analysis.robot);
    // More joints than three have no room.
    let joints_shown: Vec<usize> = if is_wide(robot) { Vec::new() } else { (0..robot.dof()).collect() };
    let (pose, joints) =
        (Labels::pose(robot, degrees).only(&shown), Labels::joints(robot, degrees).only(&joints_shown));
    let right = |name: &str| (name.to_owned(), Align::Right);
    let left = |name: &str| (name.to_owned(), Align::Left);
    let names = [right("id"), left("mode"), left("det A"), right(analysis.measure.name), right("pieces")];
    let vectors = pose.headings().chain(joints.headings()).map(|name| (name, Align::Right));
    let mut table = Table::new(names.into_iter().chain(vectors));
    for (class, aspect) in all.iter().take(LISTED) {
        let first = [
            aspect.id.to_string(),
            class.mode.to_string(),
            format!("  {}", class.det_a),
            brief(aspect.measure),
            aspect.pieces.to_string(),
        ];
        let (x, q) = (at(&aspect.sample.pose, &shown), at(&aspect.sample.q, &joints_shown));
        table.row(first.into_iter().chain(pose.briefly(&x)).chain(joints.briefly(&q)));
    }
    write!(out, "{table}")?;
    if all.len() > LISTED {
        writeln!(out, "  … and {} more{}", all.len() - LISTED, advice.on_aspects)?;
    }
    Ok(())
}

/// The ranges of aspects: all of each in W, certainly, and the images of its certified boxes in Q.
fn ranges(out: &mut dyn Write, analysis: &Analysis, degrees: bool) -> fmt::Result {
    let all: Vec<&Aspect> = analysis.classes.iter().flat_map(|c| &c.aspects).take(LISTED).collect();
    if all.is_empty() {
        return Ok(());
    }
    writeln!(out, "\nRanges of each aspect (certified; of the joints: where it is certified inside)")?;
    let (shown, robot) = (shown(analysis), &analysis.robot);
    let (pose, joints) = (Labels::pose(robot, degrees), Labels::joints(robot, degrees));
    let of_pose = shown.iter().map(|&k| (pose.clone().only(&[k]), true, k));
    let of_joints = (0..robot.dof()).map(|k| (joints.clone().only(&[k]), false, k));
    let columns: Vec<(Labels, bool, usize)> = of_pose.chain(of_joints).collect();
    let room = if columns.len() <= WIDEST { WIDEST } else { 3 };
    for columns in columns.chunks(room) {
        let mut table = Table::new(
            [("id".to_owned(), Align::Right)]
                .into_iter()
                .chain(columns.iter().flat_map(|c| c.0.headings().map(|name| (name, Align::Right)))),
        );
        for aspect in &all {
            let range = |(labels, of_pose, k): &(Labels, bool, usize)| {
                let (lo, hi) = if *of_pose { aspect.w_bounds[*k] } else { aspect.q_bounds[*k] };
                let brief = |x: f64| labels.briefly(&[x]).collect::<String>();
                // An aspect that is known in the chart of a fold alone has no certified boxes here.
                if lo < hi { format!("{} to {}", brief(lo), brief(hi)) } else { "-".to_owned() }
            };
            table.row([aspect.id.to_string()].into_iter().chain(columns.iter().map(range)));
        }
        write!(out, "{table}")?;
    }
    Ok(())
}

/// Definition 5 or 6 in a sentence.
fn earlier(name: &str, sets: &[EarlierAspects], measure: &Measure) -> String {
    let counts: Vec<_> = sets.iter().map(|s| format!("{} in {}", s.domains.len(), s.name)).collect();
    let overlap = sets.iter().map(|s| s.overlap).fold(0.0, f64::max);
    let verdict = if overlap > 0.0 {
        format!(
            "they overlap ({} of {} {}), so they do not separate the solutions",
            measure.name,
            brief(overlap),
            measure.unit
        )
    } else {
        "no overlap found".into()
    };
    format!("{name} (numerical): {}; {verdict}.", counts.join(", "))
}

fn run(analysis: &Analysis, degrees: bool) -> String {
    let run = &analysis.run;
    let ended = match run.stop {
        Stop::Exact => "the bounds meet".into(),
        Stop::Resolution => "resolution reached".into(),
        Stop::Boxes => "box budget spent".into(),
        Stop::Time => out_of_time(run),
        Stop::Cancelled => "cancelled".into(),
    };
    let coordinates = analysis.robot.platform.coordinates();
    let varying = run.resolution.iter().zip(coordinates).filter(|(w, _)| **w > 0.0);
    let widths = varying.map(|(w, c)| match c.angle {
        true if degrees => format!("{} deg", brief(w.to_degrees())),
        true => format!("{} rad", brief(*w)),
        false => format!("{} {}", brief(*w), analysis.robot.length_unit),
    });
    let cells = widths.collect::<Vec<_>>().join(" × ");
    format!(
        "{} in {:.2} s, finest cells {cells} (depth {}): {ended}, {}.",
        count(run.boxes, "box", "boxes"),
        run.seconds,
        run.depth,
        found(analysis)
    )
}

/// Why a run ended for want of time, and why not just then.
fn out_of_time(run: &Run) -> String {
    let allowed = run.allowed_seconds.unwrap_or(run.seconds);
    let spent = format!("time budget of {} s spent", brief(allowed));
    match run.seconds - allowed {
        over if over > 0.5 => format!("{spent}, and {over:.1} s for the step under way"),
        over if over < -0.5 => {
            format!("{spent} or kept: the next step is expected to take more than is left")
        }
        _ => spent,
    }
}

/// `exactly 10 aspects`: said once more at the end, where a terminal stands still.
fn found(analysis: &Analysis) -> String {
    let Count { low, high, certified } = analysis.aspects;
    let exactly = if certified { "exactly " } else { "" };
    format!("{exactly}{}", between(low, high, "aspect", "aspects"))
}

/// `n`, `n-m` or `≥ n`.
fn bounds(low: usize, high: Option<usize>) -> String {
    match high {
        Some(high) if high == low => low.to_string(),
        Some(high) => format!("{low}-{high}"),
        None => format!("≥ {low}"),
    }
}

fn share(class: &AspectClass) -> String {
    let whole = class.measure + class.undecided;
    if whole > 0.0 { format!("{:.2} %", 100.0 * class.undecided / whole) } else { "-".into() }
}
