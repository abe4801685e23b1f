//! An independent check of certificates: small, slow and plain.
//!
//! Of what computes a certificate this module uses [`Interval`] and [`Jet`](aspecta_robot::num::Jet) arithmetic, the leg equation
//! ([`aspecta_robot::Actuator::equation`]), the types that describe robots, windows ([`Robot::slice`](aspecta_robot::Robot::slice)) and charts, and
//! nothing else. It differentiates the leg equation, cuts boxes until plain enclosures and mean values decide, and counts.
//!
//! # Theorem
//! Let S be the set of configurations (X, q) of a working mode s and a sign σ: H_j > 0, limits kept, s_j B_jj > 0, σ det A > 0, X in the
//! window. Let closed boxes cover it: the leaves that are not covered, of all sheets. If all checks below
//! succeed, then for each class `low` ≤ number of components of S ≤ `high`.
//!
//! - The *base* is a sheet that holds all configurations: sheet 1 if that is a chain, else sheet 0. Sheets after the base hold parts, those near folds:
//!   the charts of folds, or bends of chains, which are disjoint.
//! - *Inside* leaves lie in S, *outside* leaves do not meet it, a *covered* leaf has all its configurations in the charts of later sheets than its own. The
//!   rest is undecided.
//! - **Low.** Of a leaf of the base take the configurations that are not in the interior of a later chart. With the leaves of the later sheets
//!   these closed sets cover S, so each component of S lies in one component of the graph G⁺ that joins any two which may share a
//!   point. Leaves of one sheet do if their boxes touch (modulo full turns; at pitch ±π/2 always, roll and yaw being one); a
//!   leaf of the base and one of a later sheet share points only on the outer faces of the latter's chart. A component of G⁺ with an inside
//!   leaf of a later sheet, or one of the base whose middle is proved to be in no later chart, holds an aspect; different ones hold different ones.
//! - **High.** P = min of σ det A, the h_j = √H_j, the limits and the distances to faces that the user's window cuts, each divided by
//!   the same positive number everywhere, is continuous and vanishes on the boundary of S, so each component has a maximum of P. In a
//!   *summitless* leaf there is none: on each part of it some tangent vector of the configurations makes every function grow that can be the
//!   least there, or σ det A alone can be and is convex along a line. So each component has its maximum in an inside leaf that is not summitless. Inside leaves that touch, or are linked
//!   by a *join* (a path in S) or a *seam* (a configuration in both), lie in one component.
//!
//! # Tangent vectors
//! Configurations are the zeros of f_j(y, q_j). With n_j = ∂f_j/∂y, a velocity (ẏ, q̇) is tangent if n_j·ẏ + B_jj q̇_j = 0. Where B_jj ≠ 0
//! this gives q̇_j. Where B_jj may vanish, ẏ = −B_jj c and q̇_j = n_j·c, or ẏ is chosen exactly perpendicular to n_j and q̇_j = 0, or to ∇H_j, so that
//! h_j is constant: det A, B_jj and the limits are smooth functions of (y, q), so nothing grows without bound. h_j = |B_jj| (|B_jj|/2 for prismatic legs)
//! grows where s_j B_jj does. Near B_jj = 0 h_j = √H_j varies like the root of the box's width, so its range is cut too, with vectors for each part.
//! ẏ has the coordinates that vary only: in a slice the others are held, and the tangent vectors are those of the slice.
//!
//! det A is expanded by minors, its gradient by cofactors, both in mean value form. Of six rows PAR is expanded, P and R being fixed matrices that make it nearly
//! diagonal: det A = det PAR / (det P det R) for any P and R that are regular (`verify::determinant`).
//!
//! # What is taken for granted
//! The arithmetic of the machine and of [`Interval`]; that the leg equation is that of the robot; that a window from
//! [`Robot::slice`](aspecta_robot::Robot::slice) holds the workspace. A strut of length 0 has det A = 0 and so belongs to no aspect.

// A variant that is added leads to every place that must decide about it.
#![warn(clippy::wildcard_enum_match_arm)]

mod body;
mod cells;
pub mod certificate;
mod charts;
mod claims;
mod contact;
mod count;
mod curvature;
mod determinant;
mod direction;
#[cfg(test)]
mod forged;
mod graph;
mod in_mode;
mod links;
mod place;
mod right_angles;
mod rods;
mod summit;
#[cfg(test)]
mod tests;
mod text;
mod turns;
mod twins;
mod verdict;
mod wall;

pub use verdict::{Checked, Counts, Fault, Verdict};

use crate::certificate::Certificate;
use aspecta_robot::chart::Chart;
use aspecta_robot::num::Interval;
use aspecta_robot::work;
use aspecta_robot::work::{Control, Progress};
use cells::Cells;
use place::{Coordinates, Setting};
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};

/// Leaves with faults after which no more are looked at.
pub const ENOUGH: usize = 10;

/// Checks a certificate that has been read ([`Certificate::from_json`]).
///
/// Faults are all real for the theorem above: a claim is wrong, or could not be proved with generous effort. If the work is
/// cancelled, the verdict is incomplete.
///
/// # Examples
/// ```
/// use aspecta::{Budget, Control, Options, Robot, analyze};
///
/// # fn main() -> Result<(), aspecta::Error> {
/// let robot = Robot::resolve("five-bar")?;
/// let budget = Budget { depth: Some(6), ..Budget::default() };
/// let modes = vec!["++".parse()?];
/// let options = Options { budget, modes, certificate: true, ..Options::default() };
/// let analysis = analyze(&robot, &options, &Control::unwatched())?;
/// let certificate = analysis.certificate.expect("asked for");
///
/// let verdict = aspecta_verify::verify(&certificate, &Control::unwatched());
/// assert!(verdict.is_verified());
/// # Ok(())
/// # }
/// ```
pub fn verify(certificate: &Certificate, control: &Control<'_>) -> Verdict {
    match certificate.robot.platform.space() {
        2 => verify_in::<2>(certificate, control),
        _ => verify_in::<3>(certificate, control),
    }
}

/// [`verify`] in D dimensions.
fn verify_in<const D: usize>(certificate: &Certificate, control: &Control<'_>) -> Verdict {
    let mut verdict = Verdict::new(certificate);
    let charts = charts::of(certificate);
    check_windows(certificate, &charts, &mut verdict);
    if verdict.faults.is_empty() {
        check_boxes::<D>(certificate, &charts, control, &mut verdict);
    }
    verdict.complete = !control.is_cancelled();
    verdict
}

fn check_boxes<const D: usize>(
    certificate: &Certificate,
    charts: &[&Chart],
    control: &Control<'_>,
    verdict: &mut Verdict,
) {
    let sheets = sheets(certificate);
    check_charts::<D>(&sheets, charts, verdict);
    if verdict.faults.is_empty() {
        check_leaves::<D>(certificate, &sheets, charts, control, verdict);
    }
    if verdict.faults.is_empty() && !control.is_cancelled() {
        let links = links::check::<D>(certificate, &sheets, charts, control.cancelled, verdict);
        if verdict.faults.is_empty() && !control.is_cancelled() {
            count::check::<D>(certificate, &sheets, charts, &links, control, verdict);
        }
    }
}

/// A sheet: its chart and its boxes.
struct Sheet<'a> {
    setting: Setting<'a>,
    cells: Cells,
}

fn sheets(certificate: &Certificate) -> Vec<Sheet<'_>> {
    let sheet = |sheet: &'_ crate::certificate::Sheet| {
        let window = charts::window_of(&sheet.chart, &certificate.window);
        (window.clone(), Cells::new(&sheet.tree, window))
    };
    let all = certificate.sheets.iter().map(|s| (s, sheet(s)));
    all.map(|(s, (window, cells))| Sheet {
        setting: Setting::new(&certificate.robot, &s.chart, window, &certificate.scale),
        cells,
    })
    .collect()
}

/// Checks the window and the constants of the charts, before any of their boxes is looked at.
fn check_windows(certificate: &Certificate, charts: &[&Chart], verdict: &mut Verdict) {
    if let Some(reason) = charts::fault_of_window(certificate) {
        verdict.faults.push(Fault { is_wrong: true, ..Fault::of_sheet(0, reason) });
    }
    let twins = twins::of(&certificate.robot);
    for (k, chart) in charts.iter().enumerate() {
        if chart.leg().is_some_and(|leg| twins.as_flattened().contains(&leg.index())) {
            let reason = "the chart of a leg that is one and the same as another";
            verdict.faults.push(Fault::of_sheet(k + 1, reason.into()));
        }
        if let Chart::Fold(fold) = chart
            && let Some(reason) = charts::fault_of_fold(&certificate.robot, &certificate.window, fold)
        {
            verdict.faults.push(Fault::of_sheet(k + 1, reason.into()));
        }
    }
}

/// No configuration is in two charts, but for one that holds all.
fn check_charts<const D: usize>(sheets: &[Sheet<'_>], charts: &[&Chart], verdict: &mut Verdict) {
    for (k, chart) in charts.iter().enumerate().filter(|(_, chart)| !chart.is_whole()) {
        for (l, other) in charts.iter().enumerate().skip(k + 1) {
            if !charts::are_disjoint::<D>(&sheets[k + 1].setting, chart, other) {
                let reason = format!("its chart is not proved to be disjoint from that of sheet {}", l + 1);
                verdict.faults.push(Fault::of_sheet(k + 1, reason));
            }
        }
    }
}

fn check_leaves<const D: usize>(
    certificate: &Certificate,
    sheets: &[Sheet<'_>],
    charts: &[&Chart],
    control: &Control<'_>,
    verdict: &mut Verdict,
) {
    let total = verdict.leaves as u64;
    let (done, faults, boxes) = (AtomicU64::new(0), AtomicUsize::new(0), AtomicU64::new(0));
    for (s, sheet) in sheets.iter().enumerate() {
        // A sheet that could cover itself, or two each other, would leave nothing to count.
        let later = &charts[s..];
        let check = |leaf: usize| -> Option<Fault> {
            if control.is_cancelled() || faults.load(Ordering::Relaxed) >= ENOUGH {
                return None;
            }
            let so_far = done.fetch_add(1, Ordering::Relaxed);
            if so_far.is_multiple_of(256) {
                (control.progress)(Progress { stage: "proving boxes", done: so_far, total });
            }
            let (claims, y) = (sheet.cells.leaves[leaf].claims, sheet.cells.of(leaf));
            match claims::prove::<D>(
                &sheet.setting,
                &certificate.modes,
                later,
                (y, claims),
                control.cancelled,
            ) {
                Ok(spent) => {
                    boxes.fetch_add(spent as u64, Ordering::Relaxed);
                    None
                }
                Err(unproved) => {
                    faults.fetch_add(1, Ordering::Relaxed);
                    let extent = bounds(&y, certificate.robot.dof());
                    Some(Fault {
                        sheet: Some(s),
                        leaf: Some(leaf),
                        class: unproved.class,
                        bounds: extent,
                        reason: unproved.reason.into(),
                        is_wrong: unproved.is_wrong,
                    })
                }
            }
        };
        let found: Vec<Fault> = work::flat_map_range(sheet.cells.leaves.len(), check);
        verdict.faults.extend(found);
    }
    verdict.boxes = boxes.into_inner();
}

fn bounds(y: &Coordinates, count: usize) -> Vec<(f64, f64)> {
    y[..count].iter().map(|x| (x.lo, x.hi)).collect()
}

/// A point, given by up to six numbers, as a box.
fn point(x: &[f64]) -> Coordinates {
    std::array::from_fn(|k| Interval::point(x.get(k).copied().unwrap_or(0.0)))
}

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
