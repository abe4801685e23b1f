//! A uniform grid over an aspect, which of its nodes lie in the aspect, and the simplices that cross the
//! aspect's boundary.
//!
//! Every cell is cut into M! simplices along its diagonal (Kuhn), one for each order in which its axes can be
//! walked. All edges run from a node to the node one step further along some of the axes, a bit set `step`:
//! an edge is (node, step), and neighbours agree on it, so that the simplices of the boundary fit without
//! gaps.

use crate::aspect::{Analysis, Aspect, AspectId, ClassId, Place};
use crate::domain::field::Field;
use aspecta_robot::work;
use std::collections::VecDeque;
use std::f64::consts::TAU;

/// The position of a node with respect to the aspect.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tag {
    /// Outside the class.
    Outside,
    /// In the aspect.
    Member,
    /// In another aspect of its class.
    Other,
    /// In the class, in which aspect is not known.
    Unknown,
}

/// The grid.
#[derive(Clone, Debug)]
pub struct Lattice {
    /// The coordinates that vary.
    pub axes: Vec<usize>,
    /// First node, per axis.
    lo: [f64; 3],
    /// Distance of nodes, per axis.
    spacing: [f64; 3],
    /// Number of nodes, per axis; 1 beyond the last axis.
    nodes: [usize; 3],
    /// Whether the last node of an axis is followed by the first.
    wraps: [bool; 3],
    /// Whether the coordinate counts modulo 2π.
    turns: [bool; 3],
    /// A pose that has the values of the coordinates that are held.
    base: Vec<f64>,
    /// Node by node.
    pub tags: Vec<Tag>,
}

/// An edge of the grid: its first node and the axes it steps along.
pub type Edge = (usize, usize);

/// A simplex in which the boundary cuts the grid: the edges it cuts, in an order that turns the outward side
/// to the right (2-D) or up (3-D: counter-clockwise seen from outside).
pub type Cut = [Edge; 3];

impl Lattice {
    /// A grid of `cells` per axis that holds the aspect, all nodes outside.
    pub fn new(analysis: &Analysis, aspect: &Aspect, cells: usize) -> Self {
        let axes = analysis.window.axes();
        let (mut lo, mut spacing) = ([0.0; 3], [0.0; 3]);
        let (mut nodes, mut wraps, mut turns) = ([1; 3], [false; 3], [false; 3]);
        for (a, &k) in axes.iter().enumerate() {
            let (from, to) = aspect.w_bounds[k];
            let step = (to - from) / cells as f64;
            turns[a] = analysis.window.glued[k];
            if turns[a] && to - from + 2.0 * step >= TAU {
                (lo[a], spacing[a], nodes[a], wraps[a]) = (from, TAU / cells as f64, cells, true);
            } else {
                // One cell more all round, and off the planes of symmetry that robots have.
                (lo[a], spacing[a], nodes[a]) = (from - 0.618 * step, step, cells + 3);
            }
        }
        let base = aspect.w_bounds.iter().map(|r| r.0).collect();
        let count = nodes.iter().product();
        Self { axes, lo, spacing, nodes, wraps, turns, base, tags: vec![Tag::Outside; count] }
    }

    /// The pose of a node; a glued coordinate may lie beyond ±π.
    pub fn pose<const N: usize>(&self, node: usize) -> [f64; N] {
        let mut pose: [f64; N] = std::array::from_fn(|k| self.base[k]);
        for (a, index) in self.split(node).into_iter().enumerate().take(self.axes.len()) {
            pose[self.axes[a]] = self.lo[a] + self.spacing[a] * index as f64;
        }
        pose
    }

    /// The length of a cell's diagonal, in widths of the window.
    pub fn diagonal<const D: usize, const N: usize>(&self, field: &Field<'_, D, N>) -> f64 {
        let side = |(a, &k): (usize, &usize)| (self.spacing[a] / field.width(k)).powi(2);
        self.axes.iter().enumerate().map(side).sum::<f64>().sqrt()
    }

    fn split(&self, node: usize) -> [usize; 3] {
        let [n, m, _] = self.nodes;
        [node % n, node / n % m, node / (n * m)]
    }

    fn join(&self, index: [usize; 3]) -> usize {
        index[0] + self.nodes[0] * (index[1] + self.nodes[1] * index[2])
    }

    /// The node one step further along the axes in `step`, if the grid has it.
    pub fn ahead(&self, node: usize, step: usize) -> Option<usize> {
        self.shifted(node, step, 1)
    }

    fn shifted(&self, node: usize, step: usize, by: isize) -> Option<usize> {
        let mut index = self.split(node);
        for a in (0..self.axes.len()).filter(|a| step >> a & 1 == 1) {
            let (at, count) = (index[a] as isize + by, self.nodes[a] as isize);
            index[a] = match self.wraps[a] {
                true => at.rem_euclid(count) as usize,
                false if (0..count).contains(&at) => at as usize,
                false => return None,
            };
        }
        Some(self.join(index))
    }

    /// Every step there is: non-empty sets of axes.
    pub fn steps(&self) -> std::ops::Range<usize> {
        1..1 << self.axes.len()
    }

    /// Finds out which nodes lie in the aspect: those of the class that the analysis locates there, and those
    /// it leaves undecided that are joined to one of them by steps within the class (to the nearest) or by a
    /// way inward. If the class is proved to have one aspect, all its nodes do. Returns how many nodes of the
    /// class could not be assigned.
    pub fn tag<const D: usize, const N: usize>(
        &mut self,
        analysis: &Analysis,
        class: ClassId,
        aspect: AspectId,
        field: &Field<'_, D, N>,
    ) -> usize {
        let of = &analysis.classes[class.index()];
        let only = of.low == 1 && of.high == Some(1);
        let tag = |node: usize| {
            let pose = self.pose::<N>(node);
            match field.violated(&pose, &[]) {
                Some(_) => Tag::Outside,
                None if only => Tag::Member,
                None => match analysis.locate(&pose, class) {
                    Place::Inside(id) if id == aspect => Tag::Member,
                    Place::Inside(_) => Tag::Other,
                    Place::Undecided | Place::Outside => Tag::Unknown,
                },
            }
        };
        self.tags = work::map_range(self.tags.len(), tag);
        self.flood();
        let cell = self.diagonal(field);
        let unknown: Vec<usize> =
            (0..self.tags.len()).filter(|&node| self.tags[node] == Tag::Unknown).collect();
        let mut left = 0;
        for node in unknown {
            match field.aspect_of(analysis, class, &self.pose::<N>(node), cell) {
                Some(id) => self.tags[node] = if id == aspect { Tag::Member } else { Tag::Other },
                None => left += 1,
            }
        }
        left
    }

    /// Spreads known tags to unknown nodes, nearest first.
    fn flood(&mut self) {
        let known = |tag: Tag| tag == Tag::Member || tag == Tag::Other;
        let mut front: VecDeque<usize> = (0..self.tags.len()).filter(|&n| known(self.tags[n])).collect();
        while let Some(node) = front.pop_front() {
            for (step, by) in self.steps().flat_map(|step| [(step, 1), (step, -1)]) {
                if let Some(next) = self.shifted(node, step, by)
                    && self.tags[next] == Tag::Unknown
                {
                    self.tags[next] = self.tags[node];
                    front.push_back(next);
                }
            }
        }
    }

    /// Whether the node lies in the aspect.
    pub fn is_member(&self, node: usize) -> bool {
        self.tags[node] == Tag::Member
    }

    /// The nodes of the cell that holds a pose of the window; none if it lies off the grid.
    pub fn around<const N: usize>(&self, pose: &[f64; N]) -> Vec<usize> {
        let mut index = [0; 3];
        for (a, &k) in self.axes.iter().enumerate() {
            let end = if self.wraps[a] { self.nodes[a] } else { self.nodes[a] - 1 } as f64;
            let at = |x: f64| ((x - self.lo[a]) / self.spacing[a]).floor();
            // An axis may run over ±π.
            let turns = [0.0, TAU, -TAU].map(|turn| at(pose[k] + turn));
            match turns.into_iter().take(if self.turns[a] { 3 } else { 1 }).find(|i| (0.0..end).contains(i)) {
                Some(at) => index[a] = at as usize,
                None => return Vec::new(),
            }
        }
        let first = self.join(index);
        std::iter::once(first).chain(self.steps().filter_map(|step| self.ahead(first, step))).collect()
    }

    /// The simplices of the boundary, in the order of their cells.
    pub fn cuts(&self) -> Vec<Cut> {
        let orders = orders(self.axes.len());
        let of_cell =
            |node: usize| orders.iter().flat_map(move |order| self.cut(node, order)).collect::<Vec<_>>();
        work::flat_map_range(self.tags.len(), of_cell)
    }

    /// The cuts of one simplex of the cell after `node`: its corners are reached by stepping along the axes
    /// in `order`.
    fn cut(&self, node: usize, order: &[usize]) -> Vec<Cut> {
        let m = order.len();
        let mut walked = [0; 4];
        for (k, a) in order.iter().enumerate() {
            walked[k + 1] = walked[k] | 1 << a;
        }
        let corner = |k: usize| if k == 0 { Some(node) } else { self.ahead(node, walked[k]) };
        let mut corners = [0; 4];
        for k in 0..=m {
            match corner(k) {
                Some(at) => corners[k] = at,
                None => return Vec::new(),
            }
        }
        let (inner, outer): (Vec<usize>, Vec<usize>) = (0..=m).partition(|&k| self.is_member(corners[k]));
        if inner.is_empty() || outer.is_empty() {
            return Vec::new();
        }
        // The edge between two corners starts at the one walked to first.
        let edge = |i: usize, j: usize| (corners[i.min(j)], walked[i.max(j)] & !walked[i.min(j)]);
        let corner = |k: usize| -> [f64; 3] { std::array::from_fn(|a| (walked[k] >> a & 1) as f64) };
        let middle = |i: usize, j: usize| -> [f64; 3] {
            let (p, q) = (corner(i), corner(j));
            std::array::from_fn(|a| 0.5 * (p[a] + q[a]))
        };
        let outward: [f64; 3] = {
            let (p, q) = (corner(inner[0]), corner(outer[0]));
            std::array::from_fn(|a| q[a] - p[a])
        };
        let oriented = |pairs: [(usize, usize); 3]| {
            let [p, q, r] = pairs.map(|(i, j)| middle(i, j));
            let (u, v): ([f64; 3], [f64; 3]) = (minus(q, p), minus(r, p));
            let normal = match m {
                2 => [u[1], -u[0], 0.0],
                _ => [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]],
            };
            let along: f64 = (0..3).map(|a| normal[a] * outward[a]).sum();
            let cut = pairs.map(|(i, j)| edge(i, j));
            match (along > 0.0, m) {
                (true, _) => cut,
                (false, 2) => [cut[1], cut[0], cut[0]],
                (false, _) => [cut[0], cut[2], cut[1]],
            }
        };
        let pairs: Vec<(usize, usize)> =
            inner.iter().flat_map(|&i| outer.iter().map(move |&o| (i, o))).collect();
        match pairs[..] {
            [a, b] => vec![oriented([a, b, b])],
            [a, b, c] => vec![oriented([a, b, c])],
            // Two inside, two outside: (i, o), (i, p), (j, o), (j, p) round the quadrilateral.
            [a, b, c, d] => vec![oriented([a, b, d]), oriented([a, d, c])],
            _ => Vec::new(),
        }
    }
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k] - b[k])
}

/// All orders of two or three axes; none of fewer.
pub(in crate::domain) fn orders(axes: usize) -> &'static [&'static [usize]] {
    match axes {
        2 => &[&[0, 1], &[1, 0]],
        3 => &[&[0, 1, 2], &[0, 2, 1], &[1, 0, 2], &[1, 2, 0], &[2, 0, 1], &[2, 1, 0]],
        _ => &[],
    }
}
