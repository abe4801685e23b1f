//! The regions of an aspect as labels: one at every node of a grid.

use super::grid::{Grid, Pose};
use super::sheet::Sheet;
use aspecta_robot::num::padded;
use std::collections::BTreeSet;

/// Not in the aspect.
pub const OUTSIDE: u32 = u32::MAX;

/// How many cells round a pose its region is looked for.
const REACH: usize = 2;

/// The regions of an aspect on a grid.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Labels {
    /// The grid, over the aspect's box.
    pub grid: Grid,
    /// The region of each node, from 0: resolved ones (with a node all of whose neighbours are in it too)
    /// before others, the larger first; [`OUTSIDE`] outside the aspect.
    pub region: Vec<u32>,
}

impl Labels {
    /// Whether the nodes round a node, diagonal ones too, are in its region.
    pub(super) fn is_inner(&self, node: usize) -> bool {
        let mut alike = 0;
        self.grid.within(node, 1, |other| alike += usize::from(self.region[other] == self.region[node]));
        alike + 1 == 3usize.pow(self.grid.axes() as u32)
    }

    /// The region that all nodes round a pose lie in, if it is one and the same (or none of them in the
    /// aspect).
    pub fn region_round(&self, pose: &[f64]) -> Option<u32> {
        let (mut found, mut same, mut corners) = (None, true, 0);
        self.grid.around(pose, |node| {
            corners += 1;
            same &= *found.get_or_insert(self.region[node]) == self.region[node];
        });
        found.filter(|_| same && corners == 1 << self.grid.axes())
    }

    /// A region such as asked that a node next to a pose lies in.
    pub(super) fn region_beside(&self, pose: &[f64], is_fit: impl Fn(&u32) -> bool) -> Option<u32> {
        let mut found = None;
        self.grid.around(pose, |node| found = Some(self.region[node]).filter(&is_fit).or(found));
        found
    }

    /// The region of a pose of the aspect: that of a node at most two cells away to which a straight segment
    /// stays in the aspect with the other poses moving continuously. `solutions` says how many direct
    /// solutions a region has, if known.
    pub fn region_of(
        &self,
        sheet: &Sheet<'_>,
        solutions: impl Fn(u32) -> Option<u8>,
        pose: &[f64],
    ) -> Option<u32> {
        let others = sheet.all_others(pose)?;
        let from = padded(pose);
        let is_fit = |region: u32| solutions(region).is_none_or(|n| usize::from(n) == others.len() + 1);
        let is_open = |node: usize, to: Pose| {
            let there = sheet.all_others(&to[..self.grid.dof()])?;
            sheet.follow(&self.grid, (from, &others), (to, &there), 3).map(|_| self.region[node])
        };
        let near = self.nearest(pose).into_iter().filter(|&(node, _)| is_fit(self.region[node]));
        near.map(|(node, to)| is_open(node, to)).find_map(|region| region)
    }

    /// The nodes of the aspect at most two cells from the cell of a pose, the nearest first, with their poses
    /// next to it.
    pub(super) fn nearest(&self, pose: &[f64]) -> Vec<(usize, Pose)> {
        let (from, cell) = (padded(pose), self.grid.cell());
        let mut centre = None;
        self.grid.around(pose, |node| centre = Some(node));
        let Some(centre) = centre else { return Vec::new() };
        let mut nodes: Vec<(f64, usize, Pose)> = Vec::new();
        let mut add = |node: usize| {
            if self.region[node] != OUTSIDE {
                let to = self.grid.turned_to(&from, node);
                let gap = |k: usize| ((to[k] - from[k]) / cell[k]).powi(2);
                nodes.push(((0..self.grid.dof()).map(gap).sum(), node, to));
            }
        };
        add(centre);
        self.grid.within(centre, REACH, add);
        nodes.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        nodes.into_iter().map(|(_, node, to)| (node, to)).collect()
    }

    /// Pairs of regions (the lesser first) with neighbouring nodes.
    pub fn adjacent(&self) -> BTreeSet<(usize, usize)> {
        let mut pairs = BTreeSet::new();
        for node in 0..self.grid.len() {
            for next in (0..self.grid.axes()).filter_map(|k| self.grid.next(node, k)) {
                let (a, b) = (self.region[node], self.region[next]);
                if a != b && a != OUTSIDE && b != OUTSIDE {
                    pairs.insert((a.min(b) as usize, a.max(b) as usize));
                }
            }
        }
        pairs
    }
}
