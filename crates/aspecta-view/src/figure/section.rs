//! Boundaries, characteristic surfaces and their images in joint space as curves in the plane of a figure.

use super::barrier::Kind;
use super::level::chain;
use super::survey::Lines;
use aspecta::domain;
use aspecta::domain::boundary::{Face, Simplex};
use aspecta::kinematics::constraints;
use aspecta::num::without_turns;
use aspecta::robot::Window;
use std::f64::consts::PI;

/// Segments or triangles over poses.
#[derive(Clone, Debug)]
pub struct Mesh<'a> {
    /// Poses or joint vectors of two or three coordinates.
    pub vertices: Vec<&'a [f64]>,
    /// The simplices that join them.
    pub simplices: &'a [Simplex],
    /// Which of the first two coordinates are angles that close up on themselves: lines then go the short way
    /// round and are unwound.
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

impl<'a> Mesh<'a> {
    /// A mesh of poses in a window, or of their free coordinates on a slice of two or more.
    pub fn of_poses(mesh: &'a domain::Mesh, window: &Window) -> Self {
        let vertices = mesh.vertices.iter().map(Vec::as_slice).collect();
        let axes = window.axes();
        Self { vertices, simplices: &mesh.simplices, turns: [0, 1].map(|k| window.glued[axes[k]]) }
    }
}

/// Returns how lines at a face are drawn: cuts of the window as limits.
pub fn kind(face: Face) -> Kind {
    match face {
        Face::Of(constraint) => match constraint.kind() {
            constraints::Kind::Parallel => Kind::Parallel,
            constraints::Kind::Serial(_) => Kind::Serial,
            constraints::Kind::Limit => Kind::Limit,
        },
        Face::Cut { .. } => Kind::Limit,
    }
}

impl Mesh<'_> {
    /// The segments of the simplices at a kind of face, or the segments in which these triangles meet a
    /// plane, as polylines.
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
    /// Returns how far above it a pose is; within half a turn, if turns do not count.
    fn height(self, pose: &[f64]) -> f64 {
        let height = pose[2] - self.at;
        if self.glued { without_turns(height) } else { height }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A strip of triangles round a full turn of the first coordinate, cut at the middle of the third.
    #[test]
    fn lines_of_poses_go_on_across_the_seam_of_an_angle() {
        let count = 12u32;
        let pose = |i: u32| {
            let roll = without_turns(0.3 + f64::from(i) * 2.0 * PI / f64::from(count));
            vec![roll, 0.5, if i.is_multiple_of(2) { -1.0 } else { 1.0 }]
        };
        let face = Face::Of(constraints::Constraint::Det);
        let corners = (0..count).map(|i| [i, (i + 1) % count, (i + 2) % count]);
        let mesh = domain::Mesh {
            vertices: (0..count).map(pose).collect(),
            sources: Vec::new(),
            simplices: corners.map(|corners| Simplex { corners, face }).collect(),
        };
        let plane = Plane { at: 0.0, glued: false };
        let jump = |roll_is_glued: bool| -> f64 {
            let ranges = vec![(-PI, PI), (-1.0, 1.0), (-1.0, 1.0)];
            let window = Window { ranges, glued: vec![roll_is_glued, false, false], ..Window::default() };
            let lines = Mesh::of_poses(&mesh, &window).lines(Kind::Parallel, Some(plane));
            let gap = |pair: &[[f64; 2]]| (pair[1][0] - pair[0][0]).abs();
            lines.iter().flat_map(|line| line.windows(2)).map(gap).fold(0.0, f64::max)
        };
        assert!(jump(true) < 1.0, "{}", jump(true));
        // What is no angle does not wrap.
        assert!(jump(false) > 2.0, "{}", jump(false));
    }
}
