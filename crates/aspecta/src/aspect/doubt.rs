//! Doubts: the boxes that keep the bounds on the number of aspects apart, and why.

use super::ascent::Class;
use super::atlas::{Atlas, Leaf};
use super::count::Counted;
use super::result::{Doubt, DoubtKind};
use super::seams::poses;
use aspecta_kinematics::chart::{Chart, Coordinates};
use aspecta_kinematics::constraints::{Constraints, Demand};
use aspecta_kinematics::for_platform;
use aspecta_robot::num::{Interval, Scalar};

/// Returns the doubts that keep the bounds of a class apart.
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
    let extent = paving.extent(node);
    let undecided = for_platform!(atlas.robot.platform, undecided(atlas, class, sheet, &extent));
    let (place, fold) = match &paving.chart {
        Chart::Pose => (extent, None),
        Chart::Fold(fold) => (extent, Some(fold.leg)),
        Chart::Chain(_) => (poses_within(atlas, (sheet, node)), None),
    };
    let in_poses = boxes.iter().filter(|leaf| leaf.0 == 0);
    Some(Doubt {
        mode: class.mode,
        det_a: class.det_a(),
        kind,
        boxes: boxes.len(),
        // The sum of none is −0.
        measure: 0.0 + in_poses.map(|&leaf| atlas.sheets[0].measure(atlas.depth_of(leaf))).sum::<f64>(),
        place: place.into_iter().map(|range| (range.lo, range.hi)).collect(),
        fold,
        undecided,
    })
}

/// The poses of a box; a coordinate that does not stay within its range there has all of it.
fn poses_within(atlas: &Atlas<'_>, leaf: Leaf) -> Vec<Interval> {
    let within = |(pose, &(lo, hi)): (Interval, &(f64, f64))| {
        if lo <= pose.lo && pose.hi <= hi { pose } else { Interval::new(lo, hi) }
    };
    let ranges = &atlas.sheets[0].window.ranges;
    poses(atlas.robot, &atlas.sheets, leaf).into_iter().zip(ranges).map(within).collect()
}

/// Names of the functions that may vanish in a box: det A, then leg by leg.
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
    let mut undecided = Vec::new();
    let demand = Demand::class(class.mode, class.sign);
    Constraints::new(robot, &placement, &legs).visit(&demand, |constraint, value| {
        if value.sign() == 0 {
            undecided.push(constraint);
        }
        true
    });
    undecided.sort_by_key(|constraint| constraint.leg());
    undecided.into_iter().map(|constraint| constraint.named(robot)).collect()
}
