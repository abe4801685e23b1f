//! Text on where the bounds on the number of aspects are apart, and why, in 100 columns.

use super::doubt::{largest_first, place, reasons};
use super::{Align, AnalysisSummary, Table, brief, paragraph};
use crate::aspect::{Analysis, Doubt, DoubtKind};
use aspecta_robot::num::count;
use std::fmt;

/// Doubts listed of each kind; the rest is in the JSON.
const LISTED: usize = 8;
/// The unit of angles in doubts.
const RADIANS: &str = "rad";
/// Columns for the names of what is undecided.
const NAMES: usize = 24;

/// Writes a table for each kind of doubt there is, and what makes doubts last.
pub(super) fn write(out: &mut dyn fmt::Write, summary: AnalysisSummary<'_>) -> fmt::Result {
    let AnalysisSummary { analysis, degrees, advice } = summary;
    let hidden = "No upper bound: a whole aspect could hide in undecided boxes";
    let unjoined = "Bounds apart: undecided boxes may join pieces into one aspect, or part them";
    for (kind, title) in [(DoubtKind::Hidden, hidden), (DoubtKind::Unjoined, unjoined)] {
        let doubts = largest_first(analysis.doubts.iter().filter(|d| d.kind == kind));
        if doubts.is_empty() {
            continue;
        }
        write!(out, "\n{title}\n{}", table(analysis, &doubts, degrees))?;
        if doubts.len() > LISTED {
            writeln!(out, "  … and {} more{}", doubts.len() - LISTED, advice.on_doubts)?;
        }
    }
    for reason in reasons(analysis) {
        writeln!(out, "\n{}", paragraph(&reason))?;
    }
    Ok(())
}

fn table(analysis: &Analysis, doubts: &[&Doubt], degrees: bool) -> Table {
    let coordinates = doubts.iter().flat_map(|d| place(&analysis.robot, d));
    let mut units: Vec<String> = coordinates.filter_map(|c| c.unit).collect();
    units.sort_by_key(|unit| unit == RADIANS);
    units.dedup();
    units.iter_mut().filter(|unit| degrees && *unit == RADIANS).for_each(|unit| *unit = "deg".into());
    let left = |name: String| (name, Align::Left);
    let columns = [
        left("mode".into()),
        left("det A".into()),
        (analysis.measure.name.to_owned(), Align::Right),
        left(format!("for example about [{}]", units.join(", "))),
        left("undecided there".into()),
    ];
    let mut table = Table::new(columns);
    for doubt in doubts.iter().take(LISTED) {
        let size =
            if doubt.measure > 0.0 { brief(doubt.measure) } else { count(doubt.boxes, "box", "boxes") };
        let sign = format!("  {}", doubt.det_a);
        table.row([
            doubt.mode.to_string(),
            sign,
            size,
            about(analysis, doubt, degrees),
            names(&doubt.undecided),
        ]);
    }
    table
}

/// The middle of the largest box. How a leg is folded is left out: its number and angle say where.
fn about(analysis: &Analysis, doubt: &Doubt, degrees: bool) -> String {
    let coordinates = place(&analysis.robot, doubt).into_iter().filter(|c| c.unit.is_some());
    let middle = coordinates.map(|c| {
        let is_turned = degrees && c.unit.as_deref() == Some(RADIANS);
        let middle = if is_turned { c.middle().to_degrees() } else { c.middle() };
        format!("{} = {}", c.name, brief(middle))
    });
    let middle = middle.collect::<Vec<_>>().join(", ");
    doubt.fold.map_or(middle.clone(), |leg| format!("leg {leg} folded, {middle}"))
}

/// Returns as many names as there is room for, and the number of the others.
fn names(all: &[String]) -> String {
    let mut text = String::new();
    for (k, name) in all.iter().enumerate() {
        if k > 0 && text.len() + 2 + name.len() > NAMES {
            return format!("{text} + {}", all.len() - k);
        }
        text = if k == 0 { name.clone() } else { format!("{text}, {name}") };
    }
    text
}
