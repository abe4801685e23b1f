//! The section of the report on where the bounds on the number of aspects are apart, and why.

use super::tables::{mode_name, sign};
use crate::doubt::{Coordinate, largest_first, place, reasons};
use crate::figure::survey::coordinate_name;
use crate::words::{measure_unit, number};
use aspecta::aspect::{Analysis, Doubt, DoubtKind};
use maud::{Markup, html};

/// Doubts listed; the rest is in the JSON.
const LISTED: usize = 10;

/// A table of what keeps the bounds apart; nothing if they meet.
pub fn table(analysis: &Analysis) -> Markup {
    let of = |kind| analysis.doubts.iter().filter(move |d| d.kind == kind);
    let mut doubts = largest_first(of(DoubtKind::Hidden));
    doubts.extend(largest_first(of(DoubtKind::Unjoined)));
    if doubts.is_empty() {
        return html! {};
    }
    html! {
        div.scroll { table #doubts {
            caption {
                "Where the bounds are apart, and why, the largest places first. det A changes sign at parallel singularities, H"
                sub { "j" } " where leg j is stretched or folded. Of the undecided boxes the largest is given; that of a folded leg in the leg's own \
                 coordinates: q" sub { "j" } " and the direction (p, w) of its rod."
            }
            thead { tr {
                th scope="col" { "mode" } th scope="col" { "det A" } th scope="col" { "undecided boxes" }
                th scope="col" { "their number" } th scope="col" { (analysis.measure.name) " [" (measure_unit(&analysis.measure)) "]" }
                th scope="col" { "for example in" } th scope="col" { "undecided there" }
            } }
            tbody { @for doubt in doubts.iter().take(LISTED) { (row(analysis, doubt)) } }
        } }
        @if doubts.len() > LISTED {
            p { "… and " (doubts.len() - LISTED) " more: " code { "aspecta analyze --json" } " lists all." }
        }
        @for reason in reasons(analysis) { p { (reason) } }
    }
}

fn row(analysis: &Analysis, doubt: &Doubt) -> Markup {
    let what = match doubt.kind {
        DoubtKind::Hidden => "may hide a whole aspect, so there is no upper bound",
        DoubtKind::Unjoined => "may join pieces into one aspect, or part them",
    };
    html! { tr {
        th.name scope="row" { (mode_name(analysis, doubt.mode)) }
        td.sign { (sign(doubt.det_a)) }
        td.reason { (what) }
        td.number { (doubt.boxes) }
        td.number { (number(doubt.measure)) }
        td {
            @if let Some(leg) = doubt.fold { "leg " (leg) " folded, " }
            (place(&analysis.robot, doubt).iter().map(range).collect::<Vec<_>>().join(", "))
        }
        td { (doubt.undecided.join(", ")) }
    } }
}

/// `x: 5.123456 … 5.123489 mm`, unbreakable: as many digits as tell the ends apart.
fn range(c: &Coordinate) -> String {
    let width = c.range.1 - c.range.0;
    let digits = (1.0 - width.log10().floor()).clamp(0.0, 17.0) as usize;
    let [low, high] = [c.range.0, c.range.1].map(|x| format!("{x:.digits$}").replace('-', "−"));
    let unit = c.unit.as_ref().map_or(String::new(), |unit| format!("\u{a0}{unit}"));
    format!("{}:\u{a0}{low}\u{a0}…\u{a0}{high}{unit}", coordinate_name(&c.name))
}
