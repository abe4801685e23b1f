//! Figure 11: samples along a path. Numerical.

use crate::Kinematics;
use crate::path::curve::Curve;
use crate::path::go_on_from;
use aspecta_robot::Robot;
use aspecta_robot::WorkingMode;
use serde::Serialize;

/// Samples of a path, over all its segments,
const SAMPLES: usize = 2000;
/// and of one.
const OF_SEGMENT: (usize, usize) = (4, 100);
/// A joint that turns further than this (rad) between two samples is looked at more finely, to count full
/// turns right.
const TURN: f64 = 1.0;

/// One sample of figure 11.
#[derive(Clone, Debug, Serialize)]
pub struct ProfilePoint {
    /// Segment, from 1 (the sample, where samples are not joined).
    pub segment: usize,
    /// t ∈ [0, 1] along the segment.
    pub t: f64,
    /// The pose.
    pub pose: Vec<f64>,
    /// The joint vector; angles go on past ±π without a jump.
    pub q: Vec<f64>,
    /// The working mode.
    pub mode: WorkingMode,
    /// det A over its largest modulus along the path.
    pub relative_det_a: f64,
    /// B_jj over their largest moduli.
    pub relative_b: Vec<f64>,
}

/// Into how many parts a segment of a path with so many is cut.
pub(super) fn parts(segments: usize) -> usize {
    (SAMPLES / segments.max(1)).clamp(OF_SEGMENT.0, OF_SEGMENT.1)
}

/// The profile of curves of poses in a mode; of one sample each if `apart`.
pub(super) fn profile(
    robot: &Robot,
    curves: &[Curve],
    mode: WorkingMode,
    parts: usize,
    apart: bool,
) -> Vec<ProfilePoint> {
    let mut points: Vec<ProfilePoint> = Vec::new();
    for (k, curve) in curves.iter().enumerate() {
        let joints = |t: f64| robot.inverse_in(&curve.at(t)[..robot.dof()], mode).ok().flatten();
        // What comes before is joined to it.
        let mut before = points.last().filter(|p| p.segment == k && p.t == 1.0).map(|p| p.q.clone());
        let mut from = 0.0;
        for i in 0..=if apart { 0 } else { parts } {
            let t = i as f64 / parts as f64;
            let q = match &before {
                Some(q) => continued(robot, &joints, q, [from, t], 20),
                None => joints(t),
            };
            let point = q.as_ref().and_then(|q| {
                ProfilePoint::new(robot, (k + 1, t), curve.at(t)[..robot.dof()].to_vec(), q.clone(), mode)
            });
            points.extend(point);
            (before, from) = (q, t);
        }
    }
    points
}

/// The joint vector at `to`, its angles continuous from `q` at `from`.
fn continued(
    robot: &Robot,
    joints: &impl Fn(f64) -> Option<Vec<f64>>,
    q: &[f64],
    [from, to]: [f64; 2],
    depth: usize,
) -> Option<Vec<f64>> {
    let mut next = joints(to)?;
    let furthest = go_on_from(robot, q, &mut next);
    if furthest < TURN || depth == 0 {
        return Some(next);
    }
    let middle = 0.5 * (from + to);
    let halfway = continued(robot, joints, q, [from, middle], depth - 1)?;
    continued(robot, joints, &halfway, [middle, to], depth - 1)
}

impl ProfilePoint {
    /// A sample of the configuration (`pose`, `q`), not yet normalised.
    pub(super) fn new(
        robot: &Robot,
        (segment, t): (usize, f64),
        pose: Vec<f64>,
        q: Vec<f64>,
        mode: WorkingMode,
    ) -> Option<Self> {
        let jacobians = robot.jacobians(&pose, &q).ok()?;
        let relative_det_a = jacobians.det_a();
        Some(Self { segment, t, pose, q, mode, relative_det_a, relative_b: jacobians.b })
    }
}

/// Divides det A and the B_jj by their largest moduli.
pub(super) fn normalised(mut points: Vec<ProfilePoint>) -> Vec<ProfilePoint> {
    let largest = |f: &dyn Fn(&ProfilePoint) -> f64| {
        let most = points.iter().map(|p| f(p).abs()).fold(0.0, f64::max);
        if most > 0.0 { most } else { 1.0 }
    };
    let det = largest(&|p| p.relative_det_a);
    let legs = points.first().map_or(0, |p| p.relative_b.len());
    let b: Vec<f64> = (0..legs).map(|j| largest(&|p| p.relative_b[j])).collect();
    for p in &mut points {
        p.relative_det_a /= det;
        p.relative_b.iter_mut().zip(&b).for_each(|(x, most)| *x /= most);
    }
    points
}
