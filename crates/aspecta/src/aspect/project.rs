//! Projections of an aspect: bounds of its W-aspect and of its Q-aspect.

use super::atlas::Leaf;
use super::seams::poses;
use crate::paving::Paving;
use arrayvec::ArrayVec;
use aspecta_kinematics::modal::closures;
use aspecta_kinematics::placement::Placement;
use aspecta_kinematics::{WorkingMode, for_platform};
use aspecta_robot::legs::Drive;
use aspecta_robot::num::Interval;
use aspecta_robot::{Leg, Robot};
use std::f64::consts::TAU;

/// The smallest range that holds all the intervals; on a circle of 2π, the complement of the widest gap
/// (its upper end may lie beyond π), or (−π, π) if there is none.
pub(super) fn hull(mut ranges: Vec<Interval>, circular: bool) -> (f64, f64) {
    use std::f64::consts::PI;
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

/// A union of intervals, disjoint and ascending.
#[derive(Clone, Default)]
struct Union(Vec<Interval>);

impl Union {
    fn holds(&self, x: Interval) -> bool {
        let next = self.0.partition_point(|r| r.hi < x.lo);
        self.0.get(next).is_some_and(|r| r.lo <= x.lo && x.hi <= r.hi)
    }

    fn add(&mut self, x: Interval) {
        let first = self.0.partition_point(|r| r.hi < x.lo);
        let last = self.0.partition_point(|r| r.lo <= x.hi);
        let joined = self.0[first..last].iter().fold(x, |all, &r| all.hull(r));
        self.0.splice(first..last, [joined]);
    }
}

/// Enclosures, one a coordinate.
type Image = ArrayVec<Interval, 6>;

/// Adds the images of the given boxes to a union per coordinate. The image of a box that holds several of
/// them is looked at first: if it adds nothing, neither do theirs.
fn add_images(paving: &Paving, boxes: &[u32], unions: &mut [Union], image: &impl Fn(u32) -> Image) {
    let mut mine = vec![Holds::Nothing; paving.nodes.len()];
    boxes.iter().for_each(|&node| mine[node as usize] = Holds::Itself);
    // Children come after their parent.
    for at in (0..paving.nodes.len()).rev().filter(|&at| paving.nodes[at].first_child != 0) {
        let below = paving.children(at as u32).any(|child| mine[child as usize] != Holds::Nothing);
        if below && mine[at] == Holds::Nothing {
            mine[at] = Holds::Below;
        }
    }
    let mut stack = vec![0];
    while let Some(at) = stack.pop() {
        if mine[at as usize] == Holds::Nothing {
            continue;
        }
        let ranges = image(at);
        if unions.iter().zip(&ranges).all(|(union, &x)| union.holds(x)) {
            continue;
        }
        match mine[at as usize] {
            Holds::Itself => unions.iter_mut().zip(ranges).for_each(|(union, x)| union.add(x)),
            Holds::Nothing | Holds::Below => stack.extend(paving.children(at)),
        }
    }
}

/// Which boxes of a set a node holds.
#[derive(Clone, Copy, PartialEq)]
enum Holds {
    /// None of them.
    Nothing,
    /// Some of those it was split into.
    Below,
    /// It is one of them.
    Itself,
}

/// Bounds, per pose coordinate, of the poses of the given boxes of all sheets.
pub(super) fn w_bounds(robot: &Robot, sheets: &[Paving], boxes: &[Leaf]) -> Vec<(f64, f64)> {
    let window = &sheets[0].window;
    let mut unions = vec![Union::default(); window.ranges.len()];
    for sheet in 0..sheets.len() {
        let within = |(k, x): (usize, Interval)| match window.ranges[k] {
            // Near a pole of the pitch roll and yaw may be anything.
            (lo, hi) if x.width() >= hi - lo => Interval::new(lo, hi),
            _ if window.glued[k] => x,
            range => clamped(x, range),
        };
        let image = |node| poses(robot, sheets, (sheet, node)).into_iter().enumerate().map(within).collect();
        let here: Vec<u32> = boxes.iter().filter(|leaf| leaf.0 == sheet).map(|leaf| leaf.1).collect();
        add_images(&sheets[sheet], &here, &mut unions, &image);
    }
    unions.into_iter().zip(&window.glued).map(|(union, &glued)| hull(union.0, glued)).collect()
}

/// Bounds, per joint coordinate, that certainly hold g_s over the given boxes, all inside mode `mode`.
pub(super) fn q_bounds(robot: &Robot, paving: &Paving, mode: WorkingMode, boxes: &[u32]) -> Vec<(f64, f64)> {
    let mut unions = vec![Union::default(); robot.dof()];
    let limits: Vec<Option<Interval>> = robot.legs.iter().map(Leg::drive_enclosure).collect();
    let within = |(j, x): (usize, Interval)| limits[j].map_or(x, |limit| common(limit, x, &robot.legs[j]));
    let image = |node| {
        let joints: Image = for_platform!(robot.platform, joints_over(robot, paving, mode, node));
        joints.into_iter().enumerate().map(within).collect()
    };
    add_images(paving, boxes, &mut unions, &image);
    // Angles with limits are in the range of these, which is no circle.
    let turns = |j: usize| limits[j].is_none() && robot.legs[j].actuator.is_angle();
    unions.into_iter().enumerate().map(|(j, union)| hull(union.0, turns(j))).collect()
}

/// Enclosures of the joints over a box, wherever the legs close in it.
fn joints_over<const D: usize, const N: usize>(
    robot: &Robot,
    paving: &Paving,
    mode: WorkingMode,
    node: u32,
) -> Image {
    let extent = paving.extent(node);
    let x: [Interval; N] = std::array::from_fn(|k| extent[k]);
    let legs = closures::<Interval, D, N>(robot, &Placement::at(robot.platform, &x));
    let joint = |j: usize| match legs[j].drive(&robot.legs[j], mode.sign(j)) {
        Drive::Angle { cos, sin, .. } => {
            Interval::angle(cos, sin).unwrap_or(Interval::PI.hull(-Interval::PI))
        }
        Drive::Length(q) => q,
    };
    (0..N).map(joint).collect()
}

/// The part of an interval within a range that it reaches into.
fn clamped(x: Interval, (lo, hi): (f64, f64)) -> Interval {
    Interval::new(x.lo.clamp(lo, hi), x.hi.clamp(lo, hi))
}

/// Returns the common part of a range and a limit: of angles, which may lie full turns apart, what holds all of
/// it in the turns of the limit.
fn common(limit: Interval, x: Interval, leg: &Leg) -> Interval {
    if !leg.actuator.is_angle() {
        return clamped(x, (limit.lo, limit.hi));
    }
    if x.width() >= TAU {
        return limit;
    }
    let nearest = ((limit.mid() - x.mid()) / TAU).round();
    let turned = |k: f64| x + Interval::PI * Interval::point(2.0 * (nearest + k));
    let shared = [-1.0, 0.0, 1.0].map(turned).into_iter().filter(|x| limit.lo <= x.hi && x.lo <= limit.hi);
    shared.map(|x| limit.meet(x)).reduce(Interval::hull).unwrap_or(limit)
}

#[cfg(test)]
mod tests {
    use super::*;
    use aspecta_robot::Limit;

    #[test]
    fn unions_are_disjoint() {
        let mut union = Union::default();
        for (lo, hi) in [(4.0, 5.0), (0.0, 1.0), (2.0, 3.0), (0.5, 2.5), (7.0, 8.0)] {
            union.add(Interval::new(lo, hi));
        }
        assert_eq!(union.0, [(0.0, 3.0), (4.0, 5.0), (7.0, 8.0)].map(|(lo, hi)| Interval::new(lo, hi)));
        let held = |lo, hi| union.holds(Interval::new(lo, hi));
        assert!(held(0.5, 2.9) && held(7.0, 8.0));
        assert!(!held(2.9, 4.1) && !held(3.2, 3.5) && !held(-1.0, 0.5) && !held(9.0, 9.5));
    }

    #[test]
    fn driven_joints_keep_their_limits() {
        let mut leg = Leg::revolute([0.0, 0.0], [0.0, 0.0], 1.0, 1.0);
        let arc = |middle: f64, half: f64| Limit::ActuatorAngle {
            middle: (Interval::point(middle.cos()), Interval::point(middle.sin())),
            half_cos: Interval::point(half.cos()),
            turns: 0,
        };
        leg.limits = vec![arc(3.0, 0.5)];
        let limit = leg.drive_enclosure().unwrap();
        assert!((limit.lo - 2.5).abs() < 1e-12 && (limit.hi - 3.5).abs() < 1e-12);
        // The same angles, a full turn further on.
        let shared = common(limit, Interval::new(-3.9, -2.9), &leg);
        assert!((shared.lo - 2.5).abs() < 1e-12 && (shared.hi - (TAU - 2.9)).abs() < 1e-12);
        assert_eq!(common(limit, Interval::new(-4.0, 4.0), &leg), limit);
        // Two parts, at both ends of the range.
        leg.limits = vec![arc(3.0, 3.0)];
        let limit = leg.drive_enclosure().unwrap();
        assert_eq!(common(limit, Interval::new(-1.0, 1.0), &leg), limit);
    }

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
