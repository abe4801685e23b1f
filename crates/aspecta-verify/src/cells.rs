//! The boxes of a sheet and which of them touch.

use super::place::Coordinates;
use crate::certificate::{DEEPEST, Entry, Leaf, Tree};
use aspecta_robot::AXES;
use aspecta_robot::Window;
use aspecta_robot::num::Interval;

/// A leaf: cell `corner` of the grid window / 2^depth. Entries beyond the axes are 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cell {
    pub claims: Leaf,
    corner: [u32; AXES],
    depth: u32,
}

/// The leaves of a sheet, in the order of the certificate.
pub(super) struct Cells {
    window: Window,
    axes: Vec<usize>,
    pub leaves: Vec<Cell>,
    /// Per entry of the tree: how many entries its subtree has, and how many leaves come before it.
    entries: Vec<(u32, u32)>,
}

impl Cells {
    /// The boxes of a tree that has been checked ([`Tree::check`]).
    pub(super) fn new(tree: &Tree, window: Window) -> Self {
        let axes = window.axes();
        let mut cells = Self { window, axes, leaves: Vec::new(), entries: Vec::with_capacity(tree.0.len()) };
        cells.grow(tree, [0; AXES], 0);
        cells
    }

    fn grow(&mut self, tree: &Tree, corner: [u32; AXES], depth: u32) {
        let at = self.entries.len();
        self.entries.push((1, self.leaves.len() as u32));
        match tree.0[at] {
            Entry::Leaf(claims) => self.leaves.push(Cell { claims, corner, depth }),
            Entry::Split => {
                for child in 0..1u32 << self.axes.len() {
                    let half = |a: usize| if a < self.axes.len() { child >> a & 1 } else { 0 };
                    self.grow(tree, std::array::from_fn(|a| 2 * corner[a] + half(a)), depth + 1);
                }
                self.entries[at].0 = (self.entries.len() - at) as u32;
            }
        }
    }

    /// Line `index` of 2^depth equal parts of a range. The same line is the same double at every depth, so
    /// cells fit without gaps.
    fn line(&self, k: usize, index: u32, depth: u32) -> f64 {
        let (lo, hi) = self.window.ranges[k];
        let parts = 1u32 << depth;
        if index == parts { hi } else { lo + (hi - lo) * (f64::from(index) / f64::from(parts)) }
    }

    fn bounds(&self, corner: &[u32; AXES], depth: u32) -> Coordinates {
        std::array::from_fn(|k| match self.axes.iter().position(|&axis| axis == k) {
            Some(a) => Interval::new(self.line(k, corner[a], depth), self.line(k, corner[a] + 1, depth)),
            None => Interval::point(self.window.ranges.get(k).map_or(0.0, |r| r.0)),
        })
    }

    /// The closed box of a leaf.
    pub(super) fn of(&self, leaf: usize) -> Coordinates {
        self.bounds(&self.leaves[leaf].corner, self.leaves[leaf].depth)
    }

    /// Whether a leaf reaches the lower and the upper end of coordinate k.
    pub(super) fn at_ends(&self, leaf: usize, k: usize) -> [bool; 2] {
        let Some(a) = self.axes.iter().position(|&axis| axis == k) else { return [true; 2] };
        let cell = &self.leaves[leaf];
        [cell.corner[a] == 0, cell.corner[a] + 1 == 1 << cell.depth]
    }

    /// Visits the leaves below an entry in all of whose ancestors, and in which, `meets` holds.
    fn search(
        &self,
        at: usize,
        (corner, depth): ([u32; AXES], u32),
        meets: &impl Fn(&[u32; AXES], u32) -> bool,
        visit: &mut impl FnMut(usize),
    ) {
        if !meets(&corner, depth) {
            return;
        }
        let (size, leaf) = self.entries[at];
        if size == 1 {
            return visit(leaf as usize);
        }
        let mut child_at = at + 1;
        for child in 0..1u32 << self.axes.len() {
            let half = |a: usize| if a < self.axes.len() { child >> a & 1 } else { 0 };
            let finer = std::array::from_fn(|a| 2 * corner[a] + half(a));
            self.search(child_at, (finer, depth + 1), meets, visit);
            child_at += self.entries[child_at].0 as usize;
        }
    }

    /// Visits the leaves that share a point with a leaf, across glued coordinates too; itself among them,
    /// some more than once.
    pub(super) fn touching(&self, leaf: usize, visit: &mut impl FnMut(usize)) {
        let extent = |corner: u32, depth: u32| {
            let cell = 1i64 << (DEEPEST - depth);
            (i64::from(corner) * cell, (i64::from(corner) + 1) * cell)
        };
        let turn = 1i64 << DEEPEST;
        let Cell { corner, depth, .. } = self.leaves[leaf];
        for wrap in self.wraps() {
            let mine: [(i64, i64); AXES] = std::array::from_fn(|a| {
                let (lo, hi) = extent(corner[a], depth);
                (lo + wrap[a] * turn, hi + wrap[a] * turn)
            });
            let meets = |corner: &[u32; AXES], depth: u32| {
                (0..self.axes.len()).all(|a| {
                    let (lo, hi) = extent(corner[a], depth);
                    lo <= mine[a].1 && mine[a].0 <= hi
                })
            };
            self.search(0, ([0; AXES], 0), &meets, visit);
        }
    }

    /// Visits the leaves that may share a point with a box of coordinates, angles counting modulo full turns
    /// where they are glued.
    pub(super) fn meeting(&self, y: &Coordinates, visit: &mut impl FnMut(usize)) {
        for y in self.turns(y) {
            let meets = |corner: &[u32; AXES], depth: u32| {
                let bounds = self.bounds(corner, depth);
                (0..self.window.ranges.len()).all(|k| bounds[k].lo <= y[k].hi && y[k].lo <= bounds[k].hi)
            };
            self.search(0, ([0; AXES], 0), &meets, visit);
        }
    }

    /// Leaves each of which holds all of a box of coordinates, modulo full turns as in [`Cells::meeting`].
    pub(super) fn holding(&self, y: &Coordinates) -> Vec<usize> {
        let mut found = Vec::new();
        for y in self.turns(y) {
            let holds = |corner: &[u32; AXES], depth: u32| {
                let bounds = self.bounds(corner, depth);
                (0..self.window.ranges.len()).all(|k| bounds[k].lo <= y[k].lo && y[k].hi <= bounds[k].hi)
            };
            self.search(0, ([0; AXES], 0), &holds, &mut |leaf| found.push(leaf));
        }
        found
    }

    /// Shifts by whole turns, axis by axis: −1, 0 or 1 where it is glued.
    fn wraps(&self) -> Vec<[i64; AXES]> {
        let mut all = vec![[0; AXES]];
        for (a, &k) in self.axes.iter().enumerate() {
            if self.window.glued[k] {
                let shifted = |wrap: &[i64; AXES], by: i64| {
                    let mut wrap = *wrap;
                    wrap[a] = by;
                    wrap
                };
                all = all.iter().flat_map(|wrap| [-1, 0, 1].map(|by| shifted(wrap, by))).collect();
            }
        }
        all
    }

    /// A box, and where it is after a turn forwards and back of each glued angle.
    fn turns(&self, y: &Coordinates) -> Vec<Coordinates> {
        let turn = Interval::PI * Interval::point(2.0);
        let shifted = |wrap: [i64; AXES]| {
            let mut y = *y;
            for (a, &k) in self.axes.iter().enumerate().filter(|(a, _)| wrap[*a] != 0) {
                y[k] = y[k] + turn * Interval::point(wrap[a] as f64);
            }
            y
        };
        self.wraps().into_iter().map(shifted).collect()
    }
}
