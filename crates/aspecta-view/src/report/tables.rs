//! The tables of the page and the words for its numbers.

use crate::figure::palette;
use crate::figure::robot::signs;
use crate::figure::survey::coordinate_name;
use crate::words::{measure_unit, number};
use aspecta::aspect::{Analysis, AspectClass, DetSign, Reachable};
use aspecta::kinematics::WorkingMode;
use aspecta::legs::{Dimension, Size};
use aspecta::robot::{Leg, Platform, Robot};
use aspecta::text::subscript;
use maud::{Markup, html};

/// The robot's data: one row a leg.
pub fn legs(analysis: &Analysis) -> Markup {
    let robot = &analysis.robot;
    html! {
        table {
            caption {
                "The robot: " (robot.legs.len()) " legs, platform “" (robot.platform) "”"
                @if robot.platform != Platform::TurningBody { ", lengths in " (robot.length_unit) } "."
            }
            thead { tr {
                th scope="col" { "leg" } th scope="col" { "actuator" } th scope="col" { "anchor A" }
                th scope="col" { "attachment C" } th scope="col" { "lengths" } th scope="col" { "limits" }
                th scope="col" { "inverse solutions" } th scope="col" { "cuspidal (Theorem 1)" }
            } }
            tbody { @for (leg, report) in robot.legs.iter().zip(&analysis.legs) { tr {
                th scope="row" { (report.leg) }
                td { (report.actuator) }
                td { (point(&leg.anchor.map(|x| x.mid()), robot)) }
                td { (point(&leg.attachment.map(|x| x.mid()), robot)) }
                td { (lengths(leg)) }
                td { @if leg.limits.is_empty() { "none" } @else { (limits(leg, robot)) } }
                td { (report.postures) }
                td.reason { @if report.cuspidal { "yes: " } @else { "no: " } (report.reason) }
            } } }
        }
        @for limit in &robot.rod_angles { p { "Limit: " (limit.in_words()) "." } }
        @for capsule in &robot.bodies { p { "Body: " (capsule.in_words(&robot.length_unit)) "." } }
        @if !robot.bodies.is_empty() { p { "Kept apart: " (robot.kept_apart()) "." } }
    }
}

/// The limits of a leg, in words.
fn limits(leg: &Leg, robot: &Robot) -> String {
    leg.limits.iter().map(|limit| limit.in_words(&robot.length_unit)).collect::<Vec<_>>().join("; ")
}

fn lengths(leg: &Leg) -> String {
    let describe = |Dimension { name, size }| match size {
        None => String::from(name),
        Some(Size::Length(length)) => format!("{name} {}", number(length)),
        Some(Size::Lengths(least, greatest)) => format!("{name} {} to {}", number(least), number(greatest)),
        Some(Size::Angle(angle)) => format!("{name} {}°", number(angle.to_degrees())),
    };
    leg.actuator.dimensions(leg).into_iter().map(describe).collect::<Vec<_>>().join(", ")
}

fn point(p: &[f64; 3], robot: &Robot) -> String {
    vector(&p[..robot.platform.space()])
}

/// Table 1: the working modes.
pub fn modes(analysis: &Analysis) -> Markup {
    let n = analysis.robot.dof();
    html! {
        table {
            caption { "Table 1. Working modes: the signs of the B" sub { "jj" } ", which name the inverse solutions." }
            thead { tr {
                th scope="col" { "mode" }
                @for k in 1..=n { th scope="col" { "B" sub { (k) (k) } } }
                th scope="col" { "reachable" } th scope="col" { "sample pose (" (pose_names(&analysis.robot)) ")" }
                th scope="col" { "joints q" sub { "1" } "…q" sub { (n) } }
            } }
            tbody { @for m in &analysis.modes { tr {
                th scope="row" { "Mf" sub { (m.number) } }
                @for s in m.mode.signs() { td.sign { @if s > 0 { "+" } @else { "−" } } }
                td { (reachable(m.reachable)) }
                @match &m.sample {
                    Some(s) => { td { (vector(&s.pose)) } td { (vector(&s.q)) } }
                    None => { td { "—" } td { "—" } }
                }
            } } }
        }
    }
}

fn reachable(r: Reachable) -> &'static str {
    match r {
        Reachable::Yes => "yes",
        Reachable::No => "no (proved)",
        Reachable::Undecided => "undecided",
    }
}

/// Table 2: the numbers of generalized aspects, in the paper's order: all modes with det A > 0, then all with
/// det A < 0.
pub fn classes(analysis: &Analysis) -> Markup {
    let n = analysis.robot.dof();
    let in_order = [DetSign::Positive, DetSign::Negative]
        .into_iter()
        .flat_map(|sign| analysis.classes.iter().filter(move |c| c.det_a == sign));
    let what = analysis.measure.name;
    html! {
        table {
            caption {
                "Table 2. Generalized aspects of each working mode and sign of det A: certified bounds on their number, and \
                 the " (what) " of their projections on the workspace in " (measure_unit(&analysis.measure)) "."
            }
            thead { tr {
                th scope="col" { "det A" } th scope="col" { "mode" }
                @for k in 1..=n { th scope="col" { "B" sub { (k) (k) } } }
                th scope="col" { "aspects" }
                th scope="col" { "certified " (what) } th scope="col" { "undecided " (what) } th scope="col" { "undecided share" }
            } }
            tbody { @for c in in_order { tr {
                td.sign { (sign(c.det_a)) }
                th.name scope="row" { (mode_name(analysis, c.mode)) }
                @for s in c.mode.signs() { td.sign { @if s > 0 { "+" } @else { "−" } } }
                td { strong { (bounds(c.low, c.high)) } }
                td.number { (number(c.measure)) } td.number { (number(c.undecided)) } td.number { (share(c)) }
            } } }
            tfoot { tr {
                th colspan=(n + 2) scope="row" { "all together" }
                td colspan="4" { strong { (bounds(analysis.aspects.low, analysis.aspects.high)) } }
            } }
        }
    }
}

fn share(c: &AspectClass) -> String {
    let all = c.measure + c.undecided;
    if all > 0.0 { format!("{:.2} %", 100.0 * c.undecided / all) } else { "—".into() }
}

/// The aspects one by one.
pub fn aspects(analysis: &Analysis) -> Markup {
    let robot = &analysis.robot;
    html! {
        table {
            caption {
                "The proved aspects. “Pieces” is the number of certified connected pieces its inner cells fall into: 1 means \
                 proved connected, k > 1 leaves open whether these are one aspect or up to k. Bounds enclose the whole W-aspect; \
                 those in Q enclose the image of the inner cells. Angles in rad."
            }
            thead { tr {
                th scope="col" { "no." } th scope="col" { "mode" } th scope="col" { "det A" }
                th scope="col" { "certified " (analysis.measure.name) } th scope="col" { "pieces" }
                th scope="col" { "sample pose (" (pose_names(robot)) ")" } th scope="col" { "sample joints" }
                th scope="col" { "bounds in W" } th scope="col" { "bounds in Q" }
            } }
            tbody { @for c in &analysis.classes { @for a in &c.aspects { tr {
                th.number scope="row" { span.swatch style={ "background:" (palette::aspect(a.id)) } {} (a.id) }
                td.name { (mode_name(analysis, c.mode)) }
                td.sign { (sign(c.det_a)) }
                td.number { (number(a.measure)) } td.number { (a.pieces) }
                td { (vector(&a.sample.pose)) } td { (vector(&a.sample.q)) }
                td { (ranges(&a.w_bounds, |k| coordinate_name(robot.platform.coordinates()[k].name).to_owned())) }
                td { (ranges(&a.q_bounds, |k| format!("q{}", subscript(k + 1)))) }
            } } } }
        }
    }
}

/// Definition 5 and 6 in numbers.
pub fn earlier(analysis: &Analysis) -> Markup {
    let rows = analysis.parallel_aspects.iter().map(|e| ("5 (parallel)", e));
    let rows = rows.chain(analysis.serial_aspects.iter().map(|e| ("6 (serial)", e)));
    let what = analysis.measure.name;
    html! {
        table {
            caption {
                "The earlier definitions, in the workspace. Domains are counted at this resolution (numerical); the " (what)
                "s are certified from below. “Shared” is what the domains of this line have in common with those of the next \
                 (cyclically): above 0 it shows that the definition does not tell the solutions apart there."
            }
            thead { tr {
                th scope="col" { "definition" } th scope="col" { "sign" } th scope="col" { "domains" }
                th scope="col" { "largest" } th scope="col" { "shared with the next" }
            } }
            tbody { @for (definition, e) in rows { tr {
                th scope="row" { (definition) }
                td { (signs(&e.name)) }
                td.number { (e.domains.len()) }
                td.number { (e.domains.first().map_or("—".into(), |d| number(d.measure))) }
                td.number { (number(e.overlap)) }
            } } }
        }
    }
}

/// A certified count in words.
pub fn bounds(low: usize, high: Option<usize>) -> String {
    match high {
        Some(high) if high == low => format!("exactly {low}"),
        Some(high) => format!("{low} to {high}"),
        None => format!("at least {low}"),
    }
}

fn pose_names(robot: &Robot) -> String {
    robot.platform.coordinates().iter().map(|c| coordinate_name(c.name)).collect::<Vec<_>>().join(", ")
}

/// `(1.5, −2)`.
fn vector(v: &[f64]) -> String {
    format!("({})", v.iter().map(|&x| number(x)).collect::<Vec<_>>().join(", "))
}

/// Returns one line a coordinate.
fn ranges(all: &[(f64, f64)], name: impl Fn(usize) -> String) -> Markup {
    html! { @for (k, r) in all.iter().enumerate() {
        span.range { (name(k)) ": " (number(r.0)) " … " (number(r.1)) }
    } }
}

/// `Mf2 (+−)`.
pub fn mode_name(analysis: &Analysis, mode: WorkingMode) -> String {
    let number = analysis.modes.iter().find(|m| m.mode == mode).map_or(0, |m| m.number);
    format!("Mf{number}\u{a0}({})", signs(&mode.to_string()))
}

/// `+` or `−`.
pub fn sign(sign: DetSign) -> &'static str {
    if sign == DetSign::Positive { "+" } else { "−" }
}
