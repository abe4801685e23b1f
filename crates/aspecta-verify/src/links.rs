//! Joins and seams: what links inside leaves that do not touch.

use super::claims::sign_of;
use super::in_mode::Existence;
use super::place::{Coordinates, Place, Setting};
use super::{Fault, Sheet, Verdict, charts, point};
use crate::certificate::{Certificate, Join, Seam};
use aspecta_robot::WorkingMode;
use aspecta_robot::chart::Chart;
use aspecta_robot::num::Interval;
use std::sync::atomic::{AtomicBool, Ordering};

/// Leaves (sheet, leaf) proved to lie in one aspect of a class.
pub(super) struct Link {
    pub class: usize,
    pub leaves: Vec<(usize, usize)>,
}

pub(super) fn check<const D: usize>(
    certificate: &Certificate,
    sheets: &[Sheet<'_>],
    charts: &[&Chart],
    cancelled: &AtomicBool,
    verdict: &mut Verdict,
) -> Vec<Link> {
    let mut links = Vec::new();
    let base = charts::base_of(charts);
    let joins = certificate.joins.iter();
    let joins =
        joins.map(|join| (join.class, "join", link_of_join::<D>(certificate, sheets, join, cancelled)));
    let seams = certificate.seams.iter();
    let seams = seams.map(|seam| (seam.class, "seam", link_of_seam::<D>(sheets, base, seam)));
    let mut number = [0, 0];
    for (class, kind, link) in joins.chain(seams) {
        let index = &mut number[usize::from(kind == "seam")];
        match link {
            Ok(leaves) => links.push(Link { class, leaves }),
            Err(reason) => verdict.faults.push(Fault::of_class(class, format!("{kind} {index}: {reason}"))),
        }
        *index += 1;
    }
    links
}

/// Leaves of a sheet that are inside a class and connected by a small box, of which it is enough to know that
/// one point of it matters: one that holds all of it, or all those that it meets.
fn inside(sheets: &[Sheet<'_>], sheet: usize, y: &Coordinates, class: usize) -> Vec<(usize, usize)> {
    let Sheet { setting, cells } = &sheets[sheet];
    let is_inside = |leaf: &usize| cells.leaves[*leaf].claims.inside >> class & 1 == 1;
    let mut found: Vec<usize> = cells.holding(y).into_iter().filter(is_inside).collect();
    let window = &setting.window;
    let within = |k: usize| window.ranges[k].0 <= y[k].lo && y[k].hi <= window.ranges[k].1;
    if found.is_empty() && (0..window.ranges.len()).all(within) {
        // The leaves cover the box: if all are inside, so is the box, which is connected.
        cells.meeting(y, &mut |leaf| found.push(leaf));
        if !found.iter().all(is_inside) {
            found.clear();
        }
    }
    found.into_iter().map(|leaf| (sheet, leaf)).collect()
}

fn link_of_join<const D: usize>(
    certificate: &Certificate,
    sheets: &[Sheet<'_>],
    join: &Join,
    cancelled: &AtomicBool,
) -> Result<Vec<(usize, usize)>, String> {
    let setting = &sheets[join.sheet].setting;
    let window = &setting.window;
    let mut leaves = Vec::new();
    for (k, pose) in join.path.iter().enumerate() {
        let within =
            |(i, x): (usize, &f64)| window.glued[i] || (window.ranges[i].0..=window.ranges[i].1).contains(x);
        if !pose.iter().enumerate().all(within) {
            return Err(format!("pose {k} of the path is beyond the window"));
        }
        let here = inside(sheets, join.sheet, &point(pose), join.class);
        if here.is_empty() && (k == 0 || k + 1 == join.path.len()) {
            return Err(format!(
                "pose {k}, an end of the path, lies in no inside leaf of sheet {}",
                join.sheet
            ));
        }
        leaves.extend(here);
    }
    let mode = certificate.modes[join.class / 2];
    for (k, ends) in join.path.windows(2).enumerate() {
        if !is_inside_all_along::<D>(setting, mode, sign_of(join.class), [&ends[0], &ends[1]], cancelled) {
            return Err(format!("the segment from pose {k} is not proved to lie inside the class"));
        }
    }
    Ok(leaves)
}

/// Most pieces into which a segment is cut.
const EFFORT: usize = 50_000;

fn is_inside_all_along<const D: usize>(
    setting: &Setting<'_>,
    mode: WorkingMode,
    sign: f64,
    [start, end]: [&[f64]; 2],
    cancelled: &AtomicBool,
) -> bool {
    let mut open = vec![(0.0, 1.0)];
    for _ in 0..EFFORT {
        if cancelled.load(Ordering::Relaxed) {
            return false;
        }
        let Some((from, to)) = open.pop() else { return true };
        let (start, end) = (point(start), point(end));
        let y = std::array::from_fn(|k| {
            let reached = start[k] + Interval::new(from, to) * (end[k] - start[k]);
            if start[k] == end[k] { start[k] } else { reached }
        });
        let place = Place::<D>::new(setting, y);
        let Some(legs) = place.in_mode(mode) else { return false };
        let existence = legs.existence();
        if existence == Existence::Nowhere {
            return false;
        }
        let det = legs.determinant().range * Interval::point(sign);
        if det.is_negative() {
            return false;
        }
        if !(existence == Existence::Everywhere && det.is_positive()) {
            let middle = 0.5 * (from + to);
            open.extend([(middle, to), (from, middle)]);
        }
    }
    false
}

fn link_of_seam<const D: usize>(
    sheets: &[Sheet<'_>],
    base: usize,
    seam: &Seam,
) -> Result<Vec<(usize, usize)>, String> {
    let y = point(&seam.point);
    let mut leaves = inside(sheets, seam.sheet, &y, seam.class);
    if leaves.is_empty() {
        return Err(format!("the point lies in no inside leaf of sheet {}", seam.sheet));
    }
    let under = charts::beneath(seam.sheet, base);
    let images = charts::images::<D>(&sheets[seam.sheet].setting, &y, sheets[under].setting.chart);
    // In the other posture of a chain's leg it is in no leaf that is inside the class.
    let found: Vec<_> = images.iter().flat_map(|image| inside(sheets, under, image, seam.class)).collect();
    if found.is_empty() {
        return Err(format!("it is not proved to lie in an inside leaf of sheet {under} as well"));
    }
    leaves.extend(found);
    Ok(leaves)
}
