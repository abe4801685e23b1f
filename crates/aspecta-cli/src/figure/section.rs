//! Boundaries and characteristic surfaces as curves in the plane of a figure.

use super::barrier::Kind;
use super::level::chain;
use aspecta::domain;
use aspecta::domain::boundary::{Face, Simplex};
use aspecta::kinematics::modal::Constraint;
use aspecta::num::without_turns;
use std::f64::consts::PI;

/// Segments or triangles over poses.
#[derive(Clone, Debug)]
pub struct Mesh<'a> {
    /// Poses of two or three coordinates.
    pub vertices: Vec<&'a [f64]>,
    /// What joins them.
    pub simplices: &'a [Simplex],
}

/// The plane of poses with a third coordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// The third coordinate.
    pub at: f64,
    /// Whether it is an angle that closes up on itself.
    pub glued: bool,
}

impl<'a> From<&'a domain::Mesh> for Mesh<'a> {
    fn from(mesh: &'a domain::Mesh) -> Self {
        Self { vertices: mesh.vertices.iter().map(Vec::as_slice).collect(), simplices: &mesh.simplices }
    }
}

/// How lines at a face are drawn: cuts of the window as limits.
pub fn kind(face: Face) -> Kind {
    match face {
        Face::Of(Constraint::Det) => Kind::Parallel,
        Face::Of(Constraint::Reach(_)) => Kind::Serial,
        Face::Of(Constraint::Limit(..)) | Face::Cut { .. } => Kind::Limit,
    }
}

impl Mesh<'_> {
    /// The segments of the simplices at a kind of face, or the segments in which these triangles meet a plane, as polylines.
    pub fn lines(&self, of: Kind, plane: Option<Plane>) -> Vec<Vec<[f64; 2]>> {
        let of_kind = self.simplices.iter().filter(|s| kind(s.face) == of);
        let Some(plane) = plane else {
            let segments: Vec<(u32, u32)> = of_kind.map(|s| (s.corners[0], s.corners[1])).collect();
            let points = |ends: Vec<u32>| ends.into_iter().map(|v| self.flat(v)).collect();
            return chain(&segments).into_iter().map(points).collect();
        };
        let height: Vec<f64> = self.vertices.iter().map(|pose| plane.height(pose)).collect();
        let height = |v: u32| height[v as usize];
        let cut = |s: &Simplex| {
            let [a, b, c] = s.corners;
            let edges = [(a, b), (b, c), (c, a)].map(|(u, v)| (u.min(v), u.max(v)));
            // A triangle on the far side of a full turn has corners at both ends of it.
            let is_far = edges.iter().any(|&(u, v)| plane.glued && (height(u) - height(v)).abs() > PI);
            let mut crossed = edges.into_iter().filter(|&(u, v)| (height(u) < 0.0) != (height(v) < 0.0));
            crossed.next().zip(crossed.next()).filter(|_| !is_far)
        };
        let segments: Vec<_> = of_kind.filter_map(cut).collect();
        let point = |(u, v): (u32, u32)| {
            let t = height(u) / (height(u) - height(v));
            let (from, to) = (self.flat(u), self.flat(v));
            [0, 1].map(|k| from[k] + t * (to[k] - from[k]))
        };
        chain(&segments).into_iter().map(|edges| edges.into_iter().map(point).collect()).collect()
    }

    fn flat(&self, vertex: u32) -> [f64; 2] {
        let pose = self.vertices[vertex as usize];
        [pose[0], pose[1]]
    }
}

impl Plane {
    /// How far above it a pose is; within half a turn, if turns do not count.
    fn height(self, pose: &[f64]) -> f64 {
        let height = pose[2] - self.at;
        if self.glued { without_turns(height) } else { height }
    }
}
