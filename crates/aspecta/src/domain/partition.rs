//! Basic regions on a grid, and which of their images coincide.

use super::grid::{Grid, Pose};
use super::labels::{Labels, OUTSIDE};
use super::sheet::{Match, Sheet};
use crate::aspect::UnionFind;
use crate::paving::{Control, Progress};
use aspecta_robot::num::padded;
use aspecta_robot::work;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Nodes a task looks at.
const CHUNK: usize = 1 << 12;

/// The nodes of a grid that lie in an aspect, cut into basic regions.
#[derive(Clone, Debug)]
pub struct Partition {
    /// The region of each node of the grid over the aspect's box.
    pub labels: Labels,
    /// n(X) per node: direct solutions of g(X) in the aspect, X among them; 0 outside the aspect.
    pub solutions: Vec<u8>,
    /// The indices in `others` at which the other poses of each node begin and end.
    first: Vec<u32>,
    others: Vec<Pose>,
    /// Nodes at which the direct model failed: they count as having one solution.
    pub failed: usize,
    /// Nodes next to which another part of the aspect passes that is thinner than a cell: they are in no
    /// region.
    pub thin: BTreeSet<usize>,
}

/// A connected set of nodes with the same count.
#[derive(Clone, Debug)]
pub struct Region {
    /// Nodes in it.
    pub nodes: usize,
    /// Nodes in it all of whose neighbours are too. None: the set is thinner than two cells, and may be part
    /// of another region, which it touches between the nodes.
    pub inner: usize,
    /// n(X) there.
    pub solutions: u8,
    /// An inner node, if there is one.
    pub sample: usize,
}

impl Region {
    /// Whether the grid is fine enough to tell it from others.
    pub fn is_resolved(&self) -> bool {
        self.inner > 0
    }
}

impl Partition {
    /// Finds the direct solutions at every node, and joins the nodes that are one region: neighbours whose
    /// other poses with the same joint vector move continuously from one node's to the other's, so that none
    /// enters or leaves the aspect between them.
    pub fn new(sheet: &Sheet<'_>, grid: Grid, control: &Control<'_>) -> Self {
        let nodes = grid.len();
        let mut partition = Self {
            solutions: vec![0; nodes],
            first: Vec::with_capacity(nodes + 1),
            others: Vec::new(),
            failed: 0,
            thin: BTreeSet::new(),
            labels: Labels { grid, region: vec![OUTSIDE; nodes] },
        };
        partition.solve(sheet, control);
        let thin = partition.thin(sheet, control);
        // Nodes, and after them their other poses.
        let mut sets = UnionFind::new(nodes + partition.others.len());
        partition.join_neighbours(sheet, &mut sets, control);
        partition.label(&mut sets);
        partition.join_others(&mut sets);
        partition.label(&mut sets);
        partition.join_slivers(sheet, &mut sets, control);
        partition.label(&mut sets);
        partition.leave_out(thin);
        partition.label(&mut sets);
        partition
    }

    /// Takes nodes out of their regions, but for those regions of which no inner node would be left.
    fn leave_out(&mut self, mut nodes: BTreeSet<usize>) {
        let region = &self.labels.region;
        let is_left = |node: usize| region[node] != OUTSIDE && !nodes.contains(&node);
        let is_inner = |&node: &usize| {
            let mut inner = is_left(node) && self.labels.is_inner(node);
            self.labels.grid.within(node, 1, |other| inner &= is_left(other));
            inner
        };
        let resolved: BTreeSet<u32> = (0..region.len()).filter(is_inner).map(|node| region[node]).collect();
        nodes.retain(|&node| resolved.contains(&region[node]));
        for &node in &nodes {
            (self.solutions[node], self.labels.region[node]) = (0, OUTSIDE);
        }
        self.thin = nodes;
    }

    fn solve(&mut self, sheet: &Sheet<'_>, control: &Control<'_>) {
        let (grid, nodes) = (&self.labels.grid, self.labels.grid.len());
        let done = AtomicUsize::new(0);
        let of_chunk = |chunk: usize| {
            let chunk = chunk * CHUNK..((chunk + 1) * CHUNK).min(nodes);
            let mut solved = (Vec::with_capacity(CHUNK), Vec::new(), 0);
            for node in chunk.clone() {
                let pose = &grid.pose(node)[..grid.dof()];
                let joints = sheet.joints(pose).filter(|_| !control.is_cancelled());
                let before = solved.1.len();
                if let Some(joints) = &joints {
                    solved.2 +=
                        usize::from(!sheet.others(pose, joints, |other| solved.1.push(padded(other))));
                }
                solved.0.push(joints.map_or(0, |_| 1 + (solved.1.len() - before) as u8));
            }
            let done = done.fetch_add(chunk.len(), Ordering::Relaxed) as u64;
            (control.progress)(Progress { stage: "direct solutions", done, total: nodes as u64 });
            solved
        };
        let solved: Vec<_> = work::map_range(nodes.div_ceil(CHUNK), of_chunk);
        let mut node = 0;
        for (counts, others, failed) in solved {
            let mut first = self.others.len() as u32;
            for count in counts {
                self.first.push(first);
                first += u32::from(count.max(1) - 1);
                self.solutions[node] = count;
                node += 1;
            }
            self.others.extend(others);
            self.failed += failed;
        }
        self.first.push(self.others.len() as u32);
    }

    /// The other poses of the aspect with a node's joint vector.
    pub fn others(&self, node: usize) -> &[Pose] {
        &self.others[self.first[node] as usize..self.first[node + 1] as usize]
    }

    /// Joins neighbours, and what their other poses become on the way.
    fn join_neighbours(&self, sheet: &Sheet<'_>, sets: &mut UnionFind, control: &Control<'_>) {
        let joined = |node: usize| {
            let next = (0..self.labels.grid.axes()).filter_map(move |k| self.labels.grid.next(node, k));
            let alike = next.filter(move |&next| !control.is_cancelled() && self.are_alike(node, next));
            alike.filter_map(move |next| Some((node, next, self.way(sheet, node, next, 0)?)))
        };
        let pairs: Vec<_> = work::flat_map_range(self.labels.grid.len(), joined);
        for (node, next, way) in pairs {
            sets.union(node as u32, next as u32);
            let other =
                |node: usize, i: usize| (self.labels.grid.len() + self.first[node] as usize + i) as u32;
            way.iter().enumerate().for_each(|(i, &j)| sets.union(other(node, i), other(next, j)));
        }
    }

    /// Joins the sets in which the other poses lie that a walk through one set leads through: where that set
    /// is wide, theirs may be too narrow for the grid.
    fn join_others(&self, sets: &mut UnionFind) {
        let nodes = self.labels.grid.len();
        let any_node: BTreeMap<u32, usize> = (0..nodes)
            .filter(|&node| self.labels.region[node] != OUTSIDE)
            .map(|node| (self.labels.region[node], node))
            .collect();
        for node in 0..nodes {
            for (i, other) in self.others(node).iter().enumerate() {
                let round = self
                    .labels
                    .region_round(&other[..self.labels.grid.dof()])
                    .and_then(|region| any_node.get(&region));
                if let Some(&at) = round.filter(|&&at| self.are_alike(node, at)) {
                    sets.union((nodes + self.first[node] as usize + i) as u32, at as u32);
                }
            }
        }
    }

    /// Whether a node lies in the aspect.
    pub(super) fn is_inside(&self, node: usize) -> bool {
        self.solutions[node] != 0
    }

    /// Whether two nodes lie in the aspect and have the same count.
    pub(super) fn are_alike(&self, a: usize, b: usize) -> bool {
        self.is_inside(a) && self.solutions[a] == self.solutions[b]
    }

    /// Names the sets.
    fn label(&mut self, sets: &mut UnionFind) {
        let inside: Vec<usize> = (0..self.labels.grid.len()).filter(|&node| self.is_inside(node)).collect();
        inside.iter().for_each(|&node| self.labels.region[node] = sets.root(node as u32));
        let mut size = BTreeMap::<u32, (bool, usize)>::new();
        for &node in &inside {
            let entry = size.entry(self.labels.region[node]).or_default();
            entry.0 = entry.0 || self.labels.is_inner(node);
            entry.1 += 1;
        }
        let mut roots: Vec<_> =
            size.into_iter().map(|(root, (resolved, nodes))| (!resolved, usize::MAX - nodes, root)).collect();
        roots.sort_unstable();
        let label: BTreeMap<u32, u32> = roots.iter().zip(0..).map(|(set, k)| (set.2, k)).collect();
        inside.iter().for_each(|&node| self.labels.region[node] = label[&self.labels.region[node]]);
    }

    /// Joins sets that are too thin to be resolved with others of the same count, where a straight segment to
    /// a node at most two cells away stays in the aspect and keeps the count.
    fn join_slivers(&self, sheet: &Sheet<'_>, sets: &mut UnionFind, control: &Control<'_>) {
        let thin: Vec<bool> = self.regions().iter().map(|region| !region.is_resolved()).collect();
        let nodes: Vec<usize> = (0..self.labels.grid.len())
            .filter(|&node| self.labels.region[node] != OUTSIDE && thin[self.labels.region[node] as usize])
            .collect();
        let near = |&node: &usize| {
            let mut joined: Vec<(usize, usize)> = Vec::new();
            self.labels.grid.within(node, 2, |other| {
                let (a, b) = (self.labels.region[node], self.labels.region[other]);
                let new = a != b && !joined.iter().any(|&(_, known)| self.labels.region[known] == b);
                if new
                    && self.are_alike(node, other)
                    && !control.is_cancelled()
                    && self.way(sheet, node, other, 5).is_some()
                {
                    joined.push((node, other));
                }
            });
            joined
        };
        let joins: Vec<(usize, usize)> = work::flat_map(&nodes, near);
        joins.into_iter().for_each(|(a, b)| sets.union(a as u32, b as u32));
    }

    /// Returns the matching of the other poses of two nodes along the segment between them, looked at in
    /// 2^`depth` parts at least; `None` if they do not move continuously.
    fn way(&self, sheet: &Sheet<'_>, from: usize, to: usize, depth: u32) -> Option<Match> {
        let start = (self.labels.grid.pose(from), self.others(from));
        let end = (self.labels.grid.turned_to(&self.labels.grid.pose(from), to), self.others(to));
        sheet.follow(&self.labels.grid, start, end, depth)
    }

    /// The regions.
    pub fn regions(&self) -> Vec<Region> {
        let mut regions: Vec<Region> = Vec::new();
        for (node, &region) in self.labels.region.iter().enumerate().filter(|(_, r)| **r != OUTSIDE) {
            let region = region as usize;
            while regions.len() <= region {
                regions.push(Region { nodes: 0, inner: 0, solutions: 0, sample: 0 });
            }
            let inner = self.labels.is_inner(node);
            let entry = &mut regions[region];
            if entry.nodes == 0 || inner && entry.inner == 0 {
                entry.sample = node;
            }
            entry.solutions = self.solutions[node];
            entry.nodes += 1;
            entry.inner += usize::from(inner);
        }
        regions
    }
}
