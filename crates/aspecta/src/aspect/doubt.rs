//! Where the bounds on the number of aspects are kept apart.

use super::ascent::Class;
use super::atlas::{Atlas, Leaf};
use super::count::Counted;
use super::result::{DetSign, Doubt, DoubtKind};
use super::seams::image;
use crate::kinematics::chart::Chart;
use crate::kinematics::for_platform;
use crate::kinematics::limits::margin;
use crate::kinematics::modal::ModalRows;
use crate::num::{Interval, Scalar};
use crate::paving::Paving;
use std::ops::Add;

/// What keeps the bounds of a class apart.
pub(super) fn doubts(atlas: &Atlas<'_>, class: Class, counted: &Counted) -> Vec<Doubt> {
    if counted.is_exact() {
        return Vec::new();
    }
    let hidden: Vec<Leaf> =
        counted.components.boxes.iter().copied().filter(|&leaf| atlas.open(leaf) & class.bit != 0).collect();
    [(DoubtKind::Hidden, &hidden), (DoubtKind::Unjoined, &counted.between.front)]
        .into_iter()
        .filter_map(|(kind, boxes)| doubt(atlas, class, kind, boxes))
        .collect()
}

fn doubt(atlas: &Atlas<'_>, class: Class, kind: DoubtKind, boxes: &[Leaf]) -> Option<Doubt> {
    let &(sheet, node) = boxes.iter().min_by_key(|&&leaf| (atlas.depth_of(leaf), leaf))?;
    let paving = &atlas.sheets[sheet];
    let place = coordinates(atlas, (sheet, node));
    let undecided = for_platform!(atlas.robot.platform, undecided(atlas, class, sheet, &place));
    let in_poses = boxes.iter().filter(|leaf| leaf.0 == 0);
    Some(Doubt {
        mode: class.mode,
        det_a: if class.sign > 0 { DetSign::Positive } else { DetSign::Negative },
        kind,
        boxes: boxes.len(),
        measure: in_poses.map(|&leaf| atlas.sheets[0].measure(atlas.depth_of(leaf))).fold(0.0, f64::add),
        fold: match &paving.chart {
            Chart::Pose | Chart::Chain(_) => None,
            Chart::Fold(fold) => Some(fold.leg + 1),
        },
        undecided,
        place: match &paving.chart {
            Chart::Chain(_) => poses(atlas, paving, &place),
            Chart::Pose | Chart::Fold(_) => place.into_iter().map(|i| (i.lo, i.hi)).collect(),
        },
    })
}

/// The poses of a box of a chart that holds all; a coordinate that does not stay within its range there has all of it.
fn poses(atlas: &Atlas<'_>, paving: &Paving, place: &[Interval]) -> Vec<(f64, f64)> {
    let ranges = &atlas.sheets[0].window.ranges;
    let within = |(pose, range): (Interval, &(f64, f64))| {
        if range.0 <= pose.lo && pose.hi <= range.1 { (pose.lo, pose.hi) } else { *range }
    };
    image(atlas.robot, paving, place).into_iter().zip(ranges).map(within).collect()
}

/// The ranges of all coordinates over a box.
fn coordinates(atlas: &Atlas<'_>, (sheet, node): Leaf) -> Vec<Interval> {
    let paving = &atlas.sheets[sheet];
    let (lo, hi) = paving.bounds(node);
    let mut ranges: Vec<Interval> = paving.window.ranges.iter().map(|r| Interval::point(r.0)).collect();
    for (a, &k) in paving.axes.iter().enumerate() {
        ranges[k] = Interval::new(lo[a], hi[a]);
    }
    ranges
}

/// Names of the functions that may vanish in a box.
fn undecided<const D: usize, const N: usize>(
    atlas: &Atlas<'_>,
    class: Class,
    sheet: usize,
    place: &[Interval],
) -> Vec<String> {
    let robot = atlas.robot;
    let y: [Interval; N] = std::array::from_fn(|k| place[k]);
    let chart = &atlas.sheets[sheet].chart;
    let (placement, legs) = chart.at::<Interval, D, N>(robot, &y, |k| y[k].sin_cos());
    let heights: [[Interval; 2]; N] = std::array::from_fn(|j| legs[j].heights());
    let mut names = Vec::new();
    let mut note = |name: String, value: Interval| {
        if value.sign() == 0 {
            names.push(name);
        }
    };
    let rows = ModalRows::<Interval, N>::new(robot, &legs, &std::array::from_fn(|j| heights[j][0]));
    note("det A".into(), rows.det(class.mode));
    for (j, leg) in robot.legs.iter().enumerate() {
        if leg.actuator.postures() == 2 {
            note(format!("H_{}", j + 1), legs[j].closure.reach);
        }
        let at = legs[j].limited(leg);
        for (k, limit) in leg.limits.iter().enumerate() {
            let sh = heights[j][usize::from(class.mode.sign(j) < 0)];
            note(format!("limit {} of leg {}", k + 1, j + 1), margin(limit, &at, sh, &placement));
        }
    }
    names
}
