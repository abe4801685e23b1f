//! Projections of an aspect: bounds of its W-aspect and of its Q-aspect.

use super::atlas::Leaf;
use super::seams::poses;
use crate::kinematics::leg::Drive;
use crate::kinematics::modal::closures;
use crate::kinematics::placement::Placement;
use crate::kinematics::{WorkingMode, for_platform};
use crate::num::Interval;
use crate::paving::Paving;
use crate::robot::Robot;

/// The smallest range that holds all the intervals; on a circle of 2π, the complement of the widest gap
/// (its upper end may lie beyond π), or (−π, π) if there is none.
pub(super) fn hull(mut ranges: Vec<Interval>, circular: bool) -> (f64, f64) {
    use std::f64::consts::{PI, TAU};
    let whole = ranges.iter().fold(None, |h: Option<Interval>, &r| Some(h.map_or(r, |h| h.hull(r))));
    let Some(whole) = whole else { return (0.0, 0.0) };
    if !circular {
        return (whole.lo, whole.hi);
    }
    ranges.sort_by(|a, b| a.lo.total_cmp(&b.lo));
    // Ranges may run over ±π: what lies beyond one end covers the other.
    let (start, end) = (whole.lo, whole.hi);
    let (mut widest, mut hull) = (start - (end - TAU), (start, end));
    let mut covered = ranges[0].hi.max(end - TAU);
    for r in &ranges[1..] {
        let next = r.lo.min(start + TAU);
        if next - covered > widest {
            (widest, hull) = (next - covered, (next, covered + TAU));
        }
        covered = covered.max(r.hi);
    }
    if widest > 0.0 { hull } else { (-PI, PI) }
}

/// Bounds, per pose coordinate, of the poses of the given boxes of all sheets.
pub(super) fn w_bounds(robot: &Robot, sheets: &[Paving], boxes: &[Leaf]) -> Vec<(f64, f64)> {
    let window = &sheets[0].window;
    let mut all: Vec<Vec<Interval>> = vec![Vec::with_capacity(boxes.len()); window.axes().len()];
    for &(sheet, node) in boxes {
        if sheet == 0 {
            let (lo, hi) = sheets[0].bounds(node);
            all.iter_mut().enumerate().for_each(|(a, all)| all.push(Interval::new(lo[a], hi[a])));
        } else {
            let pose = poses(robot, sheets, (sheet, node));
            all.iter_mut().zip(&sheets[0].axes).for_each(|(all, &k)| all.push(pose[k]));
        }
    }
    let mut bounds = window.ranges.clone();
    for (mut all, &k) in all.into_iter().zip(&sheets[0].axes) {
        let (lo, hi) = window.ranges[k];
        for x in &mut all {
            match window.glued[k] {
                // Near a pole of the pitch roll and yaw may be anything.
                _ if x.width() >= hi - lo => *x = Interval::new(lo, hi),
                true => {}
                false => *x = Interval::new(x.lo.max(lo), x.hi.min(hi)),
            }
        }
        bounds[k] = hull(all, window.glued[k]);
    }
    bounds
}

/// A box by its grid coordinates and depth.
type Cell = ([u32; 3], u32);

/// The given boxes, the finest replaced by the boxes one level up that hold them: a cover of as good as the same
/// extent with far fewer members.
fn cover(paving: &Paving, boxes: &[u32]) -> Vec<Cell> {
    let finest = paving.depth.saturating_sub(1);
    let coarse = |&node: &u32| {
        let (corner, depth) = (paving.nodes[node as usize].corner, paving.depth_of(node));
        let up = depth.saturating_sub(finest);
        (corner.map(|i| i >> up), depth - up)
    };
    let mut cells: Vec<Cell> = boxes.iter().map(coarse).collect();
    cells.sort_unstable();
    cells.dedup();
    cells
}

/// Bounds, per joint coordinate, that certainly hold g_s over the given boxes, all inside mode `mode`.
pub(super) fn q_bounds(robot: &Robot, paving: &Paving, mode: WorkingMode, boxes: &[u32]) -> Vec<(f64, f64)> {
    let cells = cover(paving, boxes);
    let mut ranges: Vec<Vec<Interval>> = vec![Vec::with_capacity(cells.len()); robot.dof()];
    for cell in &cells {
        for_platform!(robot.platform, joints_over(robot, paving, mode, cell, &mut ranges));
    }
    ranges.into_iter().zip(&robot.legs).map(|(r, leg)| hull(r, leg.actuator.is_angle())).collect()
}

/// Appends enclosures of the joints over a box, wherever the legs close in it.
fn joints_over<const D: usize, const N: usize>(
    robot: &Robot,
    paving: &Paving,
    mode: WorkingMode,
    (corner, depth): &Cell,
    ranges: &mut [Vec<Interval>],
) {
    let mut x: [Interval; N] = std::array::from_fn(|k| Interval::point(paving.window.ranges[k].0));
    for (a, &k) in paving.axes.iter().enumerate() {
        let line = |i| paving.window.grid_line(k, i, *depth);
        x[k] = Interval::new(line(corner[a]), line(corner[a] + 1));
    }
    let legs = closures::<Interval, D, N>(robot, &Placement::at(robot.platform, &x));
    let joint = |j: usize| match legs[j].drive(&robot.legs[j], mode.sign(j)) {
        Drive::Angle { cos, sin, .. } => {
            Interval::angle(cos, sin).unwrap_or(Interval::PI.hull(-Interval::PI))
        }
        Drive::Length(q) => q,
    };
    for (j, all) in ranges.iter_mut().enumerate() {
        all.push(joint(j));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_circular_hull_leaves_out_the_widest_gap() {
        let arcs = vec![Interval::new(-3.0, -2.5), Interval::new(2.0, 3.1)];
        let (lo, hi) = hull(arcs.clone(), true);
        assert_eq!(lo, 2.0);
        assert!((hi - (std::f64::consts::TAU - 2.5)).abs() < 1e-12);
        assert_eq!(hull(arcs, false), (-3.0, 3.1));
        // The second arc runs over π, past the end of the first.
        let (lo, hi) = hull(vec![Interval::new(-3.0, -2.9), Interval::new(2.0, 3.5)], true);
        assert!(lo == 2.0 && (hi - 3.5).abs() < 1e-12, "{lo} {hi}");
        assert_eq!(
            hull(vec![Interval::new(-3.2, 0.0), Interval::new(-0.1, 3.2)], true).1,
            std::f64::consts::PI
        );
    }
}
