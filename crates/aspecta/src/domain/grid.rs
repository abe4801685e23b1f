//! A uniform grid of poses.

use aspecta_robot::Window;
use aspecta_robot::num::without_turns;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Pose coordinates; those beyond the robot's are 0.
pub type Pose = [f64; 6];

/// How near the held coordinates of a pose are to their values if it lies on the slice: rad or length units,
/// relative to values greater than 1.
const ON_SLICE: f64 = 1e-9;

/// Nodes at the centres of equal cells that fill a box of poses, with up to three coordinates that vary
/// (axes).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Grid {
    lo: [f64; 3],
    /// Width of a cell, per axis.
    pub step: [f64; 3],
    /// Cells, per axis.
    pub count: [usize; 3],
    /// Which axes close up on themselves.
    wraps: [bool; 3],
    glued: [bool; 3],
    axes: usize,
    /// The coordinates that a slice fixes; empty for whole workspaces, which alone are kept in files.
    #[serde(skip)]
    held: Vec<Held>,
}

/// A coordinate that is held.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Held {
    coordinate: usize,
    value: f64,
    angle: bool,
    /// The width that counts as a cell along it, for poses that leave the slice.
    cell: f64,
}

impl Grid {
    /// Cells of about 1/`cells` of the window's width over `bounds`, where the window does not hold the
    /// coordinate. `whole` is the window without anything held.
    pub fn new(window: &Window, whole: &Window, bounds: &[(f64, f64)], cells: usize) -> Self {
        let width = |(lo, hi): (f64, f64)| hi - lo;
        let held = |(coordinate, value): (usize, f64)| {
            let cell = width(whole.ranges[coordinate]) / cells as f64;
            Held { coordinate, value, angle: window.angles[coordinate], cell }
        };
        let coordinates = window.axes();
        let mut grid = Self {
            lo: [0.0; 3],
            step: [1.0; 3],
            count: [1; 3],
            wraps: [false; 3],
            glued: [false; 3],
            axes: coordinates.len(),
            held: window.held().map(held).collect(),
        };
        for (axis, k) in coordinates.into_iter().enumerate() {
            let (lo, hi) = bounds[k];
            grid.count[axis] = (((hi - lo) / width(window.ranges[k]) * cells as f64).ceil() as usize).max(1);
            (grid.lo[axis], grid.step[axis]) = (lo, (hi - lo) / grid.count[axis] as f64);
            grid.glued[axis] = window.glued[k];
            grid.wraps[axis] = window.glued[k] && hi - lo > TAU - 1e-9;
        }
        grid
    }

    /// Whether it is a grid over poses with so many coordinates: one that is read may be anything.
    pub(super) fn is_sound(&self, axes: usize) -> bool {
        let positive = |k: usize| self.step[k] > 0.0 && self.step[k].is_finite() && self.lo[k].is_finite();
        self.axes == axes && axes <= 3 && (0..3).all(|k| positive(k) && self.count[k] > 0)
    }

    /// Number of nodes.
    pub fn len(&self) -> usize {
        self.count.iter().fold(1, |nodes, &count| nodes.saturating_mul(count))
    }

    /// Length, area or volume of a cell.
    pub fn measure(&self) -> f64 {
        self.step[..self.axes].iter().product()
    }

    /// The pose at a node.
    pub fn pose(&self, node: usize) -> Pose {
        let at = self.indices(node);
        let along = |axis: usize| self.lo[axis] + self.step[axis] * (at[axis] as f64 + 0.5);
        let mut pose = [0.0; 6];
        (0..self.axes).for_each(|axis| pose[self.coordinate(axis)] = along(axis));
        self.held.iter().for_each(|held| pose[held.coordinate] = held.value);
        pose
    }

    /// The coordinate that an axis is.
    pub fn coordinate(&self, axis: usize) -> usize {
        // Held coordinates ascend: each at or before the one looked for moves it on.
        self.held.iter().fold(axis, |k, held| k + usize::from(held.coordinate <= k))
    }

    /// Coordinates of a pose, the held ones too.
    pub fn dof(&self) -> usize {
        self.axes + self.held.len()
    }

    /// Returns the width that counts as a cell along each coordinate, the fixed ones too; infinite beyond the
    /// last.
    pub fn cell(&self) -> Pose {
        let mut cell = [f64::INFINITY; 6];
        (0..self.axes).for_each(|axis| cell[self.coordinate(axis)] = self.step[axis]);
        self.held.iter().for_each(|held| cell[held.coordinate] = held.cell);
        cell
    }

    /// Whether a pose lies on the slice, if it is one.
    fn is_on_slice(&self, pose: &[f64]) -> bool {
        self.held.iter().all(|held| {
            let gap = pose[held.coordinate] - held.value;
            let gap = if held.angle { without_turns(gap) } else { gap };
            gap.abs() <= ON_SLICE * held.value.abs().max(1.0)
        })
    }

    fn indices(&self, node: usize) -> [usize; 3] {
        let [a, b, _] = self.count;
        [node % a, node / a % b, node / (a * b)]
    }

    fn node(&self, at: [usize; 3]) -> usize {
        at[0] + self.count[0] * (at[1] + self.count[1] * at[2])
    }

    /// The node one cell further along coordinate `k`.
    pub fn next(&self, node: usize, k: usize) -> Option<usize> {
        let mut at = self.indices(node);
        at[k] += 1;
        if at[k] == self.count[k] {
            if !self.wraps[k] || self.count[k] < 3 {
                return None;
            }
            at[k] = 0;
        }
        Some(self.node(at))
    }

    /// The nodes at most `cells` cells away along every coordinate, but for the node itself.
    pub fn within(&self, node: usize, cells: usize, mut visit: impl FnMut(usize)) {
        let (at, wide) = (self.indices(node), 2 * cells + 1);
        for index in 0..wide.pow(self.axes as u32) {
            let mut other = [0; 3];
            let inside = (0..self.axes).all(|k| {
                let mut i = (at[k] + index / wide.pow(k as u32) % wide) as i64 - cells as i64;
                if self.wraps[k] {
                    i = i.rem_euclid(self.count[k] as i64);
                }
                other[k] = i.max(0) as usize;
                (0..self.count[k] as i64).contains(&i)
            });
            if inside && other != at {
                visit(self.node(other));
            }
        }
    }

    /// The pose at a node, turned by full turns to be next to another pose.
    pub fn turned_to(&self, near: &Pose, node: usize) -> Pose {
        self.beside(near, &self.pose(node))
    }

    /// A pose, turned by full turns to be next to another.
    pub fn beside(&self, near: &Pose, pose: &Pose) -> Pose {
        let mut pose = *pose;
        for k in (0..self.axes).filter(|&axis| self.glued[axis]).map(|axis| self.coordinate(axis)) {
            pose[k] += ((near[k] - pose[k]) / TAU).round() * TAU;
        }
        pose
    }

    /// Coordinates that vary.
    pub fn axes(&self) -> usize {
        self.axes
    }

    /// The nodes round a pose: the corners of the box of neighbouring nodes that holds it. Fewer at the edge
    /// of the grid, none off the slice.
    pub fn around(&self, pose: &[f64], mut visit: impl FnMut(usize)) {
        if !self.is_on_slice(pose) {
            return;
        }
        let mut low = [0i64; 3];
        for k in 0..self.axes {
            let mut x = pose[self.coordinate(k)] - self.lo[k];
            if self.glued[k] {
                x = x.rem_euclid(TAU);
            }
            low[k] = (x / self.step[k] - 0.5).floor() as i64;
        }
        for corner in 0..1usize << self.axes {
            let mut at = [0; 3];
            let inside = (0..self.axes).all(|k| {
                let count = self.count[k] as i64;
                let mut i = low[k] + (corner >> k & 1) as i64;
                if self.wraps[k] {
                    i = i.rem_euclid(count);
                }
                at[k] = i.max(0) as usize;
                (0..count).contains(&i)
            });
            if inside {
                visit(self.node(at));
            }
        }
    }
}
