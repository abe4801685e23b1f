//! Where the boxes of one chart meet those of another.

use super::atlas::Leaf;
use crate::kinematics::chart::Chart;
use crate::kinematics::for_platform;
use crate::num::Interval;
use crate::paving::{Mark, Node, Paving};
use crate::robot::Robot;

/// Pairs (box of sheet 0, box of another sheet) that may share a configuration in which neither box is replaced by the other.
///
/// The boxes of a fold's sheet and those boxes of sheet 0 that it does not cover, cut to the poses the chart does not hold, cover
/// all configurations. The two kinds meet only in the chart's outer faces, so every box at such a face is joined with all
/// that its image may meet. A chart of all configurations has no such faces.
pub(super) fn outer(
    robot: &Robot,
    sheets: &[Paving],
    sight: &impl Fn(&Node) -> Mark,
    join: &mut impl FnMut(Leaf, Leaf),
) {
    for (s, sheet) in sheets.iter().enumerate().skip(1).filter(|(_, sheet)| !sheet.chart.is_whole()) {
        sheet.boxes_of(sight, &mut |at| {
            for face in outer_faces(robot, sheet, at) {
                sheets[0].meeting(sight, &image(robot, sheet, &face), &mut |other| join((0, other), (s, at)));
            }
        });
    }
}

/// Pairs (inside box of sheet 0, inside box of another sheet) that share a configuration, the centre of the latter having a pose that seems to lie in
/// the former; the third argument of `join` proves that it does.
pub(super) fn inner(
    robot: &Robot,
    sheets: &[Paving],
    sight: &impl Fn(&Node) -> Mark,
    join: &mut impl FnMut(Leaf, Leaf, &dyn Fn() -> bool),
) {
    for (s, sheet) in sheets.iter().enumerate().skip(1) {
        sheet.boxes_of(sight, &mut |at| {
            if sight(&sheet.nodes[at as usize]) != Mark::Inside {
                return;
            }
            let Some((other, true)) = sheets[0].find(sight, &centre(robot, sheets, (s, at))) else { return };
            if sight(&sheets[0].nodes[other as usize]) == Mark::Inside {
                let surely = || {
                    let centre: Vec<Interval> = sheet.centre(at).into_iter().map(Interval::point).collect();
                    sheets[0].holds(other, &image(robot, sheet, &centre))
                };
                join((0, other), (s, at), &surely);
            }
        });
    }
}

/// The outer faces of a fold's chart that a box lies at: its coordinates, one of them at its end.
fn outer_faces(robot: &Robot, sheet: &Paving, at: u32) -> Vec<Vec<Interval>> {
    let node = &sheet.nodes[at as usize];
    let last = (1u32 << node.depth) - 1;
    let coordinates = sheet.extent(at);
    let mut faces = Vec::new();
    for (a, &k) in sheet.axes.iter().enumerate().filter(|(_, k)| (1..robot.platform.space()).contains(*k)) {
        let Interval { lo, hi } = coordinates[k];
        for (is_outer, end) in [(node.corner[a] == 0, lo), (node.corner[a] == last, hi)] {
            if is_outer {
                let mut face = coordinates.clone();
                face[k] = Interval::point(end);
                faces.push(face);
            }
        }
    }
    faces
}

/// The pose at the centre of a box.
pub(super) fn centre(robot: &Robot, sheets: &[Paving], (s, at): Leaf) -> Vec<f64> {
    for_platform!(robot.platform, pose_of(robot, &sheets[s].chart, &sheets[s].centre(at)))
}

/// Poses that hold the configurations of a box.
pub(super) fn poses(robot: &Robot, sheets: &[Paving], (s, at): Leaf) -> Vec<Interval> {
    image(robot, &sheets[s], &sheets[s].extent(at))
}

/// Poses that hold the configurations with the given coordinates.
fn image(robot: &Robot, sheet: &Paving, y: &[Interval]) -> Vec<Interval> {
    for_platform!(robot.platform, image_in(robot, &sheet.chart, y))
}

fn image_in<const D: usize, const N: usize>(robot: &Robot, chart: &Chart, y: &[Interval]) -> Vec<Interval> {
    chart.pose::<D, N>(robot, &std::array::from_fn(|k| y[k])).to_vec()
}

fn pose_of<const D: usize, const N: usize>(robot: &Robot, chart: &Chart, y: &[f64]) -> Vec<f64> {
    chart.pose_at::<D, N>(robot, &std::array::from_fn(|k| y[k])).to_vec()
}
