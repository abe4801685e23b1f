//! A uniform grid of poses.

use crate::robot::Window;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Nodes at the centres of equal cells that fill a box of poses, up to three coordinates.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Grid {
    lo: [f64; 3],
    /// Width of a cell, per coordinate.
    pub step: [f64; 3],
    /// Cells, per coordinate.
    pub count: [usize; 3],
    /// Which coordinates close up on themselves.
    wraps: [bool; 3],
    glued: [bool; 3],
    axes: usize,
}

impl Grid {
    /// Cells of about 1/`cells` of the window's width over `bounds`.
    pub fn new(window: &Window, bounds: &[(f64, f64)], cells: usize) -> Self {
        let mut grid = Self {
            lo: [0.0; 3],
            step: [1.0; 3],
            count: [1; 3],
            wraps: [false; 3],
            glued: [false; 3],
            axes: bounds.len(),
        };
        for (k, &(lo, hi)) in bounds.iter().enumerate() {
            let whole = window.ranges[k].1 - window.ranges[k].0;
            grid.count[k] = (((hi - lo) / whole * cells as f64).ceil() as usize).max(1);
            (grid.lo[k], grid.step[k]) = (lo, (hi - lo) / grid.count[k] as f64);
            grid.glued[k] = window.glued[k];
            grid.wraps[k] = window.glued[k] && hi - lo > TAU - 1e-9;
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

    /// The pose at a node: the first coordinates, as many as there are.
    pub fn pose(&self, node: usize) -> [f64; 3] {
        let at = self.indices(node);
        std::array::from_fn(|k| self.lo[k] + self.step[k] * (at[k] as f64 + 0.5))
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
    pub fn turned_to(&self, near: &[f64; 3], node: usize) -> [f64; 3] {
        let pose = self.pose(node);
        std::array::from_fn(|k| {
            let turns = if self.glued[k] { ((near[k] - pose[k]) / TAU).round() } else { 0.0 };
            pose[k] + turns * TAU
        })
    }

    /// Coordinates.
    pub fn axes(&self) -> usize {
        self.axes
    }

    /// The nodes round a pose: the corners of the box of neighbouring nodes that holds it. Fewer at the edge of the grid.
    pub fn around(&self, pose: &[f64], mut visit: impl FnMut(usize)) {
        let mut low = [0i64; 3];
        for k in 0..self.axes {
            let mut x = pose[k] - self.lo[k];
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
