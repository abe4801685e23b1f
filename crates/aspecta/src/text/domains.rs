//! The basic regions and uniqueness domains of an aspect for people.

use super::{Align, Labels, Table, brief};
use crate::domain::{Coincidence, Domains, RegionId};
use aspecta_robot::num::count;
use std::fmt::{self, Write};

/// Rows shown; the rest is in the result.
const LISTED: usize = 20;

/// Images that coincide to this share are said to coincide: the rest is as much as a grid errs near surfaces.
const WHOLE: f64 = 0.95;

/// The words of a program for where it shows the rest, and for the number of cells.
#[derive(Clone, Copy, Debug)]
pub struct DomainsAdvice {
    /// Follows `… and 3 more`: where the program shows the rest.
    pub on_rows: &'static str,
    /// The program's name for [`cells`](crate::domain::DomainOptions::cells), of which more may help.
    pub cells: &'static str,
}

impl Default for DomainsAdvice {
    fn default() -> Self {
        Self { on_rows: "", cells: "cells" }
    }
}

/// Regions and domains as a summary that a person reads, with a program's advice.
#[derive(Clone, Copy, Debug)]
pub struct DomainsSummary<'a> {
    /// The regions and domains.
    pub domains: &'a Domains,
    /// Whether angles of poses and cells are in degrees; else in radians.
    pub degrees: bool,
    /// The advice.
    pub advice: DomainsAdvice,
}

/// Prints the basic regions (Def. 10), the uniqueness domains (Theorem 3), and what was checked of them.
///
/// # Examples
/// ```
/// use aspecta::{AspectId, Budget, Control, DomainOptions, Options, Robot, analyze, domains};
///
/// # fn main() -> Result<(), aspecta::Error> {
/// let robot = Robot::resolve("five-bar")?;
/// let budget = Budget { depth: Some(7), ..Budget::default() };
/// let modes = vec!["++".parse()?];
/// let options = Options { budget, modes, ..Options::default() };
/// let analysis = analyze(&robot, &options, &Control::unwatched())?;
///
/// let options = DomainOptions { cells: 20, samples: 100 };
/// let summary = domains(&analysis, AspectId::new(1), &options, &Control::unwatched())?.to_string();
/// assert!(summary.contains("  region    area  solutions  x [unit]  y [unit]  image meets that of"));
/// # Ok(())
/// # }
/// ```
impl fmt::Display for Domains {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        DomainsSummary { domains: self, degrees: false, advice: DomainsAdvice::default() }.fmt(f)
    }
}

impl fmt::Display for DomainsSummary<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { domains, degrees, advice } = self;
        let pose = domains.pose.clone();
        let pose = if *degrees { pose.in_degrees() } else { pose };
        heading(f, domains, &pose)?;
        regions(f, domains, &pose, advice)?;
        uniqueness(f, domains, advice)?;
        agreement(f, domains)?;
        images(f, domains, advice)?;
        failures(f, domains, &pose)
    }
}

fn heading(out: &mut dyn Write, found: &Domains, pose: &Labels) -> fmt::Result {
    let Domains { aspect, mode, det_a, unit, window, .. } = found;
    let free = pose.clone().only(&window.axes());
    let cells: Vec<String> = free.briefly(&found.cell).collect();
    writeln!(
        out,
        "aspect {aspect} (mode {mode}, det A {det_a}): {} {} {}, numerical, in cells of {}",
        unit.name,
        brief(found.measure),
        unit.unit,
        cells.join(" x ")
    )?;
    let (held, values): (Vec<usize>, Vec<f64>) = window.held().unzip();
    if held.is_empty() {
        return Ok(());
    }
    writeln!(
        out,
        "on the slice {}: solutions are counted in the whole class (mode and sign of det A), outside the slice too",
        pose.clone().only(&held).sentence(&values)
    )
}

fn right(name: &str) -> (String, Align) {
    (name.to_owned(), Align::Right)
}

fn percent(share: f64) -> String {
    format!("{:.1} %", 100.0 * share)
}

fn regions(out: &mut dyn Write, found: &Domains, pose: &Labels, advice: &DomainsAdvice) -> fmt::Result {
    let axes = found.window.axes();
    writeln!(out, "\nBasic regions (Def. 10)")?;
    let free = pose.clone().only(&axes);
    let vector = free.headings().map(|name| (name, Align::Right));
    let names = [right("region"), right(found.unit.name), right("solutions")];
    let last = [("image meets that of".into(), Align::Left)];
    let mut table = Table::new(names.into_iter().chain(vector).chain(last));
    for region in found.regions.iter().take(LISTED) {
        let first = [region.number.to_string(), brief(region.measure), region.solutions.to_string()];
        let meets = found.coincidences.iter().filter_map(|c| match c.regions {
            (a, b) if a == region.number => Some(b),
            (a, b) if b == region.number => Some(a),
            _ => None,
        });
        let meets = first_of(meets, 8);
        let values: Vec<f64> = axes.iter().map(|&k| region.pose[k]).collect();
        table.row(first.into_iter().chain(free.briefly(&values)).chain([meets]));
    }
    write!(out, "{table}")?;
    more(out, found.regions.len(), advice)?;
    if found.unresolved.parts == 0 {
        return Ok(());
    }
    let share = 100.0 * found.unresolved.measure / found.measure;
    writeln!(
        out,
        "  not resolved: {} thinner than two cells somewhere, {share:.3} % of the {}; more {} make them fewer",
        count(found.unresolved.parts, "part", "parts"),
        found.unit.name,
        advice.cells
    )
}

fn uniqueness(out: &mut dyn Write, found: &Domains, advice: &DomainsAdvice) -> fmt::Result {
    writeln!(out, "\nUniqueness domains (Theorem 3)")?;
    let names = [
        right(found.unit.name),
        right("of the aspect"),
        right("of the workspace"),
        ("regions".into(), Align::Left),
    ];
    let mut table = Table::new(names);
    for domain in found.uniqueness.iter().take(LISTED) {
        let of_workspace = domain.of_workspace.map_or(String::new(), percent);
        let listed = first_of(domain.regions.iter(), 12);
        let dots = if domain.regions.len() > 12 { " …" } else { "" };
        table.row([
            brief(domain.measure),
            percent(domain.of_aspect),
            of_workspace,
            format!("{listed}{dots}"),
        ]);
    }
    write!(out, "{table}")?;
    more(out, found.uniqueness.len(), advice)?;
    if !found.complete {
        let why = "parts of regions pass between the cells, or not all sets of regions were looked at";
        writeln!(out, "  there may be more: {why}")?;
    }
    Ok(())
}

/// How often the direct model says the same.
fn agreement(out: &mut dyn Write, found: &Domains) -> fmt::Result {
    let agreement = &found.agreement;
    writeln!(
        out,
        "\nchecked: {} of {} random poses away from the surfaces have as many direct solutions as their region",
        agreement.agree, agreement.away
    )?;
    let apart = agreement.disagreements.iter().filter_map(|found| found.distance).reduce(f64::max);
    let Some(apart) = apart else { return Ok(()) };
    writeln!(
        out,
        "{} at most {} cells from the characteristic surface",
        count(agreement.disagreements.len(), "other is", "others are"),
        brief(apart)
    )
}

/// Where it is not sure which images coincide.
fn images(out: &mut dyn Write, found: &Domains, advice: &DomainsAdvice) -> fmt::Result {
    let cells = advice.cells;
    pairs(out, "are parts of one, joined outside the slice", &found.joined)?;
    pairs(
        out,
        "may have coincident images or not, so no uniqueness domain above holds both",
        &found.undecided,
    )?;
    let (unmatched, is_slice) = (unmatched(found), found.window.held().next().is_some());
    if !is_slice && !unmatched.is_empty() {
        let listed = first_of(unmatched.iter(), LISTED);
        writeln!(
            out,
            "not as many coincident images as solutions, so the uniqueness domains are not sure (more {cells}): regions {listed}"
        )?;
    }
    let shares = found.coincidences.iter().filter_map(|c| Some((c.regions, c.shares?)));
    for ((a, b), (in_b, in_a)) in shares.filter(|(_, (a, b))| a.min(*b) < WHOLE).take(LISTED) {
        writeln!(
            out,
            "images of regions {a} and {b} meet in part ({}, {}): more {cells} would tell regions apart or show them whole",
            percent(in_b),
            percent(in_a)
        )?;
    }
    Ok(())
}

/// Where Theorem 2 does not hold, or nothing is known.
fn failures(out: &mut dyn Write, found: &Domains, pose: &Labels) -> fmt::Result {
    for violation in found.violations.iter().take(LISTED) {
        let [a, b] = &violation.poses;
        writeln!(
            out,
            "Theorem 2 does not hold on region {}: {} and {} have the same joint vector",
            violation.region,
            pose.brief(a),
            pose.brief(b)
        )?;
    }
    if found.failed > 0 {
        let nodes = count(found.failed, "node", "nodes");
        writeln!(out, "at {nodes} the direct model failed: counted as one solution")?;
    }
    Ok(())
}

/// Says something of pairs of regions, if there are any.
fn pairs(out: &mut dyn Write, what: &str, pairs: &[(RegionId, RegionId)]) -> fmt::Result {
    if pairs.is_empty() {
        return Ok(());
    }
    let listed = first_of(pairs.iter().map(|(a, b)| format!("{a}-{b}")), LISTED);
    let dots = if pairs.len() > LISTED { " …" } else { "" };
    writeln!(out, "regions that {what}: {listed}{dots}")
}

/// The regions whose image does not meet those of just so many others that each solution has one: some are
/// not resolved, or neighbours are taken for one.
fn unmatched(found: &Domains) -> Vec<RegionId> {
    let holds = |c: &&Coincidence, number: RegionId| [c.regions.0, c.regions.1].contains(&number);
    let partners = |number: RegionId| found.coincidences.iter().filter(|c| holds(c, number)).count();
    let regions = found.regions.iter().filter(|r| partners(r.number) + 1 != usize::from(r.solutions));
    regions.map(|region| region.number).collect()
}

/// The first so many, side by side.
fn first_of(items: impl Iterator<Item = impl ToString>, most: usize) -> String {
    items.take(most).map(|item| item.to_string()).collect::<Vec<_>>().join(" ")
}

fn more(out: &mut dyn Write, rows: usize, advice: &DomainsAdvice) -> fmt::Result {
    if rows > LISTED {
        writeln!(out, "  … and {} more{}", rows - LISTED, advice.on_rows)?;
    }
    Ok(())
}
