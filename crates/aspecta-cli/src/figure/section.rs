//! Boundaries, characteristic surfaces and their images in joint space as curves in the plane of a figure.

use super::barrier::Kind;
use super::level::chain;
use super::survey::Lines;
use aspecta::domain;
use aspecta::domain::boundary::{Face, Simplex};
use aspecta::kinematics::modal::Constraint;
use aspecta::num::without_turns;
use std::f64::consts::PI;

/// Segments or triangles over poses.
#[derive(Clone, Debug)]
pub struct Mesh<'a> {
    /// Poses or joint vectors of two or three coordinates.
    pub vertices: Vec<&'a [f64]>,
    /// What joins them.
    pub simplices: &'a [Simplex],
    /// Which of the first two coordinates are angles that close up on themselves: lines then go the short way round and are unwound.
    pub turns: [bool; 2],
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
        let vertices = mesh.vertices.iter().map(Vec::as_slice).collect();
        Self { vertices, simplices: &mesh.simplices, turns: [false; 2] }
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
            let points = |ends: Vec<u32>| self.unwound(ends.into_iter().map(|v| self.flat(v)).collect());
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
            [0, 1].map(|k| from[k] + t * self.short(k, to[k] - from[k]))
        };
        let line = |edges: Vec<_>| self.unwound(edges.into_iter().map(point).collect());
        chain(&segments).into_iter().map(line).collect()
    }

    /// The lines of every kind.
    pub fn kinds(&self, plane: Option<Plane>) -> Lines {
        let of_kind = |of| self.lines(of, plane).into_iter().map(move |line| (of, line));
        [Kind::Limit, Kind::Serial, Kind::Parallel].into_iter().flat_map(of_kind).collect()
    }

    /// A difference in a coordinate, the short way round.
    fn short(&self, axis: usize, gap: f64) -> f64 {
        if self.turns[axis] { without_turns(gap) } else { gap }
    }

    /// A line without jumps of a full turn.
    fn unwound(&self, mut line: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
        for at in 1..line.len() {
            let last = line[at - 1];
            line[at] = [0, 1].map(|k| last[k] + self.short(k, line[at][k] - last[k]));
        }
        line
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
