//! The tables of `aspecta domains`.

use crate::failure::Failure;
use crate::output::{Align, Labels, Table, brief};
use aspecta::domain::{Domains, Map};
use aspecta::robot::Window;
use aspecta_view::words::count;
use std::io::Write;

/// Prints regions, uniqueness domains and what was checked of them.
pub fn print(out: &mut dyn Write, map: &Map, found: &Domains) -> Result<(), Failure> {
    let Domains { aspect, mode, det_a, unit, .. } = found;
    writeln!(
        out,
        "aspect {aspect} (mode {mode}, det A {det_a}): {} {} {}, numerical, in cells of {}",
        unit.name,
        brief(found.measure),
        unit.unit,
        found.cell.iter().map(|w| brief(*w)).collect::<Vec<_>>().join(" x ")
    )?;
    let (pose, held) = (Labels::pose(&map.robot, false), held(&map.window));
    if !held.is_empty() {
        let values: Vec<f64> = map.window.held().map(|(_, x)| x).collect();
        writeln!(
            out,
            "on the slice {}: solutions are counted in the whole class (mode and sign of det A), outside the slice too",
            Labels::pose(&map.robot, false).only(&held).sentence(&values)
        )?;
    }
    regions(out, &pose, &map.window, found)?;
    uniqueness(out, found)?;
    checks(out, &pose, held.is_empty(), found)
}

/// The coordinates that a slice holds.
fn held(window: &Window) -> Vec<usize> {
    window.held().map(|(k, _)| k).collect()
}

fn right(name: &str) -> (String, Align) {
    (name.to_owned(), Align::Right)
}

fn percent(share: f64) -> String {
    format!("{:.1} %", 100.0 * share)
}

fn regions(out: &mut dyn Write, pose: &Labels, window: &Window, found: &Domains) -> Result<(), Failure> {
    let (unit, axes) = (&found.unit, window.axes());
    writeln!(out, "\nBasic regions (Def. 10)")?;
    let headings: Vec<String> = pose.headings().collect();
    let vector = axes.iter().map(|&k| (headings[k].clone(), Align::Right));
    let names = [right("region"), right(unit.name), right("solutions")];
    let mut table =
        Table::new(names.into_iter().chain(vector).chain([("image meets that of".into(), Align::Left)]));
    for region in found.regions.iter().take(LISTED) {
        let first = [region.number.to_string(), brief(region.measure), region.solutions.to_string()];
        let meets = found.coincidences.iter().filter_map(|c| match c.regions {
            (a, b) if a == region.number => Some(b.to_string()),
            (a, b) if b == region.number => Some(a.to_string()),
            _ => None,
        });
        let meets = meets.take(8).collect::<Vec<_>>().join(" ");
        table.row(first.into_iter().chain(axes.iter().map(|&k| brief(region.pose[k]))).chain([meets]));
    }
    write!(out, "{table}")?;
    more(out, found.regions.len())?;
    if found.unresolved.parts > 0 {
        let share = 100.0 * found.unresolved.measure / found.measure;
        writeln!(
            out,
            "  not resolved: {} thinner than two cells somewhere, {share:.3} % of the {}; more --cells make them fewer",
            count(found.unresolved.parts, "part", "parts"),
            unit.name
        )?;
    }
    Ok(())
}

fn uniqueness(out: &mut dyn Write, found: &Domains) -> Result<(), Failure> {
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
        let listed = domain.regions.iter().take(12).map(usize::to_string).collect::<Vec<_>>().join(" ");
        let dots = if domain.regions.len() > 12 { " …" } else { "" };
        table.row([
            brief(domain.measure),
            percent(domain.of_aspect),
            of_workspace,
            format!("{listed}{dots}"),
        ]);
    }
    write!(out, "{table}")?;
    more(out, found.uniqueness.len())?;
    if !found.complete {
        writeln!(out, "  there may be more: the search for sets of regions was cut short")?;
    }
    Ok(())
}

/// Prints what was checked, and where it does not hold.
fn checks(out: &mut dyn Write, pose: &Labels, whole: bool, found: &Domains) -> Result<(), Failure> {
    let agreement = &found.agreement;
    writeln!(
        out,
        "\nchecked: {} of {} random poses away from the surfaces have as many direct solutions as their region",
        agreement.agree, agreement.away
    )?;
    let apart = agreement.disagreements.iter().filter_map(|found| found.distance).reduce(f64::max);
    if let Some(apart) = apart {
        writeln!(
            out,
            "{} at most {} cells from the characteristic surface",
            count(agreement.disagreements.len(), "other is", "others are"),
            brief(apart)
        )?;
    }
    pairs(out, "are parts of one, joined outside the slice", &found.joined)?;
    pairs(
        out,
        "may have coincident images or not, so no uniqueness domain above holds both",
        &found.undecided,
    )?;
    let incomplete = unmatched(found);
    if whole && !incomplete.is_empty() {
        let listed = incomplete.iter().take(LISTED).map(usize::to_string).collect::<Vec<_>>().join(" ");
        writeln!(
            out,
            "not as many coincident images as solutions, so the uniqueness domains are not sure (more --cells): regions {listed}"
        )?;
    }
    let shares = found.coincidences.iter().filter_map(|c| Some((c.regions, c.shares?)));
    for ((a, b), (in_b, in_a)) in shares.filter(|(_, (a, b))| a.min(*b) < WHOLE).take(LISTED) {
        writeln!(
            out,
            "images of regions {a} and {b} meet in part ({}, {}): more --cells would tell regions apart or show them whole",
            percent(in_b),
            percent(in_a)
        )?;
    }
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
fn pairs(out: &mut dyn Write, what: &str, pairs: &[(usize, usize)]) -> Result<(), Failure> {
    if pairs.is_empty() {
        return Ok(());
    }
    let listed = pairs.iter().take(LISTED).map(|(a, b)| format!("{a}-{b}")).collect::<Vec<_>>().join(" ");
    let dots = if pairs.len() > LISTED { " …" } else { "" };
    Ok(writeln!(out, "regions that {what}: {listed}{dots}")?)
}

/// The regions whose image does not meet those of just so many others that each solution has one: some are
/// not resolved, or neighbours are taken for one.
fn unmatched(found: &Domains) -> Vec<usize> {
    let partners = |number: usize| {
        found.coincidences.iter().filter(|c| [c.regions.0, c.regions.1].contains(&number)).count()
    };
    let regions = found.regions.iter().filter(|r| partners(r.number) + 1 != usize::from(r.solutions));
    regions.map(|region| region.number).collect()
}

/// Images that coincide to this share are said to coincide: the rest is as much as a grid errs near surfaces.
const WHOLE: f64 = 0.95;

/// Rows shown; the rest is in the JSON.
const LISTED: usize = 20;

fn more(out: &mut dyn Write, rows: usize) -> Result<(), Failure> {
    if rows > LISTED {
        writeln!(out, "  … and {} more (--json lists all)", rows - LISTED)?;
    }
    Ok(())
}
