//! The curves that bound the aspects of a mode in a plane slice of the pose space, and their images in Q.

use super::barrier::{Barriers, Kind};
use super::level::{Grid, contours, project};
use aspecta::kinematics::WorkingMode;
use aspecta::num::turned_to;
use aspecta::robot::{LegIndex, Robot};
use std::f64::consts::PI;

/// A plane of poses: all coordinates fixed but two.
#[derive(Clone, Debug)]
pub struct Plane {
    /// A pose in the plane.
    pub through: Vec<f64>,
    /// The two coordinates that vary.
    pub axes: [usize; 2],
}

impl Plane {
    /// The pose at a point of the plane.
    pub fn pose(&self, p: [f64; 2]) -> Vec<f64> {
        let mut pose = self.through.clone();
        (pose[self.axes[0]], pose[self.axes[1]]) = (p[0], p[1]);
        pose
    }
}

/// A piece of the boundary of a mode's aspects.
#[derive(Clone, Debug)]
pub struct Curve {
    /// Which function vanishes.
    pub kind: Kind,
    /// Points of the plane, each on the curve to about 1e-12 of the grid's width.
    pub points: Vec<[f64; 2]>,
    which: Which,
}

/// A line in Q, and the kind of singularity or limit that it shows.
pub type Image = (Kind, Vec<Vec<f64>>);

/// A step between two points of a curve is halved at most so often before it counts as a jump.
const HALVINGS: u32 = 20;

/// What is below zero by no more than this share of its mean magnitude may be zero on a line.
const TOUCHING: f64 = 1e-9;

/// Which barrier: det A, or one of [`Barriers::margins`].
#[derive(Clone, Copy, Debug, PartialEq)]
enum Which {
    Det,
    Margin(usize),
}

/// A robot in a mode, over a plane.
#[derive(Clone, Copy, Debug)]
pub struct Sheet<'a> {
    /// The robot.
    pub robot: &'a Robot,
    /// The working mode.
    pub mode: WorkingMode,
    /// The plane.
    pub plane: &'a Plane,
}

impl Sheet<'_> {
    /// The barriers at a point.
    pub fn barriers(&self, p: [f64; 2]) -> Barriers {
        Barriers::at(self.robot, self.mode, &self.plane.pose(p))
    }

    fn value(&self, which: Which, p: [f64; 2]) -> f64 {
        let b = self.barriers(p);
        match which {
            Which::Det => b.det,
            Which::Margin(k) => b.margins[k].1,
        }
    }

    /// Whether p is within reach and limits, the barrier `except` aside. Margins may be below zero by `slack`.
    fn allowed(&self, except: Which, p: [f64; 2], slack: &[f64]) -> bool {
        let margins = self.barriers(p).margins;
        let mut margins = margins.iter().zip(slack).enumerate();
        margins.all(|(k, (margin, slack))| Which::Margin(k) == except || margin.1 >= -slack)
    }

    /// Returns all parts of the curves det A = 0, H_j = 0 and limit = 0 that lie within reach and limits of
    /// the mode.
    ///
    /// A grid finds the curves, so a loop smaller than a grid cell, or a zero without change of sign, is not
    /// seen.
    pub fn curves(&self, grid: &Grid) -> Vec<Curve> {
        let nodes = grid.sample(|p| self.barriers(p));
        let Some(first) = nodes.first() else { return Vec::new() };
        let margins = first.margins.iter().enumerate().map(|(k, m)| (m.0, Which::Margin(k)));
        let mut found = Vec::new();
        let slack: Vec<f64> = (0..first.margins.len()).map(|k| slack(&nodes, k)).collect();
        for (kind, which) in margins.chain([(Kind::Parallel, Which::Det)]) {
            let value = |b: &Barriers| if let Which::Margin(k) = which { b.margins[k].1 } else { b.det };
            let values: Vec<f64> = nodes.iter().map(value).collect();
            for line in contours(grid, &values, |p| self.value(which, p)) {
                found.extend(self.cut(which, &line, &slack).into_iter().map(|points| Curve {
                    kind,
                    points,
                    which,
                }));
            }
        }
        found
    }

    /// The parts of a contour within reach and limits; where it crosses another barrier it ends on that
    /// barrier.
    fn cut(&self, which: Which, line: &[[f64; 2]], slack: &[f64]) -> Vec<Vec<[f64; 2]>> {
        let mut parts = Vec::new();
        let mut part: Vec<[f64; 2]> = Vec::new();
        let allowed: Vec<bool> = line.iter().map(|p| self.allowed(which, *p, slack)).collect();
        for k in 0..line.len() {
            if k > 0 && allowed[k] != allowed[k - 1] {
                part.extend(self.crossing(which, [line[k - 1], line[k]], allowed[k], slack));
            }
            if allowed[k] {
                part.push(line[k]);
            } else if !part.is_empty() {
                parts.push(std::mem::take(&mut part));
            }
        }
        parts.push(part);
        parts.retain(|p| p.len() > 1);
        parts
    }

    /// Returns the point between a and b at which the curve enters (`entering`) or leaves the allowed region.
    fn crossing(
        &self,
        which: Which,
        [a, b]: [[f64; 2]; 2],
        entering: bool,
        slack: &[f64],
    ) -> Option<[f64; 2]> {
        let on_curve = |t: f64| project(a, b, t, &|p| self.value(which, p));
        let (mut low, mut high, mut best) = (0.0, 1.0, None);
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            let p = on_curve(middle)?;
            let inside = self.allowed(which, p, slack);
            if inside {
                best = Some(p);
            }
            if inside == entering { high = middle } else { low = middle }
        }
        best
    }

    /// The image g_s(curve) in Q, refined until no coordinate q_k steps by more than `step[k]`; angles are
    /// unwound, so that each line is continuous. Where a leg is folded (C on the axis of its crank) its joint
    /// is free, and all its values are the image of that serial singularity, whatever curve leads to it: lines
    /// end there, and one goes through the joint's whole range.
    pub fn images(&self, curve: &Curve, step: &[f64]) -> Vec<Image> {
        let Some(&first) = curve.points.first() else { return Vec::new() };
        let first = (first, self.barriers(first));
        let mut images =
            Images { curve, step, found: vec![(curve.kind, vec![first.1.q.clone()])], last: first };
        for &point in &curve.points[1..] {
            self.extend_images(&mut images, point, HALVINGS);
        }
        images.found.retain(|(_, line)| line.len() > 1);
        images.found
    }

    fn extend_images(&self, images: &mut Images<'_>, b: [f64; 2], depth: u32) {
        let Images { curve, step, last: (a, from), .. } = images;
        let (curve, a) = (*curve, *a);
        let mut to = self.barriers(b);
        to.q = unwind(self.robot, to.q, &from.q);
        let step_of = |k: usize| (to.q[k] - from.q[k]).abs() / step[k];
        let widest = (0..to.q.len()).max_by(|&i, &j| step_of(i).total_cmp(&step_of(j))).unwrap_or(0);
        let (far, free) = (step_of(widest) > 1.0, from.folded.and(to.folded));
        if far
            && free.is_none()
            && depth > 0
            && let Some(middle) = project(a, b, 0.5, &|p| self.value(curve.which, p))
        {
            self.extend_images(images, middle, depth - 1);
            return self.extend_images(images, b, depth - 1);
        }
        if free.is_some() || (far && depth == 0) {
            let fold = self.fold(&to.q, free.unwrap_or(LegIndex::new(widest)));
            let found = &mut images.found;
            let is_near =
                |line: &[Vec<f64>]| (0..to.q.len()).all(|k| (line[0][k] - fold[0][k]).abs() < step[k]);
            if !found.iter().any(|(kind, line)| *kind == Kind::Serial && line.len() == 2 && is_near(line)) {
                found.push((Kind::Serial, fold.to_vec()));
            }
            found.push((curve.kind, vec![to.q.clone()]));
        } else if let Some((_, line)) = images.found.last_mut() {
            line.push(to.q.clone());
        }
        images.last = (b, to);
    }

    /// The whole range of the joint of a leg that is folded at q.
    fn fold(&self, q: &[f64], leg: LegIndex) -> [Vec<f64>; 2] {
        let (low, high) = self.robot.leg(leg).drive_range().unwrap_or((-PI, PI));
        [low, high].map(|end| {
            let mut q = q.to_vec();
            q[leg.index()] = end;
            q
        })
    }
}

/// By how much margin k may be below zero on a line: where the joint of two rods touches something both do, and neither is to hide the other's line.
fn slack(nodes: &[Barriers], k: usize) -> f64 {
    // Beyond the reach of a leg a margin may be no number.
    let sizes = nodes.iter().map(|node| node.margins[k].1.abs()).filter(|size| size.is_finite());
    let sum: f64 = sizes.sum();
    match nodes.first().map(|node| node.margins[k].0) {
        Some(Kind::Contact(_)) => TOUCHING * sum / nodes.len() as f64,
        Some(Kind::Limit | Kind::Serial | Kind::Parallel) | None => 0.0,
    }
}

/// The images of a curve, as they grow.
struct Images<'a> {
    curve: &'a Curve,
    step: &'a [f64],
    found: Vec<Image>,
    /// The point of the plane that they have come to, and what is there.
    last: ([f64; 2], Barriers),
}

/// q with whole turns added to its angles so that each is within half a turn of `near`.
pub fn unwind(robot: &Robot, mut q: Vec<f64>, near: &[f64]) -> Vec<f64> {
    for ((x, n), leg) in q.iter_mut().zip(near).zip(&robot.legs) {
        if leg.actuator.is_angle() {
            *x = turned_to(*x, *n);
        }
    }
    q
}
