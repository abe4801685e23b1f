//! Parts of regions that pass between the nodes: the tips of wedges, which grow thinner than a cell.
//!
//! A wedge begins where two regions meet, so it is followed from there: edges of the grid near places where the
//! count is known to change are looked at in between, and where it changes there too, those near these.

use super::grid::Pose;
use super::partition::Partition;
use super::sheet::Sheet;
use crate::paving::Control;
use aspecta_robot::work;
use std::collections::BTreeSet;

/// Parts in which an edge is looked at.
const PARTS: usize = 16;
/// How many cells from a place where the count changes edges are looked at.
const REACH: usize = 2;

impl Partition {
    /// The nodes at both ends of edges with the same count at both ends and another one in between, as far as
    /// such edges lead from those with two counts. On grids of two axes, of robots with up to three
    /// coordinates: else there are too many edges, or a direct problem costs too much.
    pub(super) fn thin(&self, sheet: &Sheet<'_>, control: &Control<'_>) -> BTreeSet<usize> {
        let grid = &self.labels.grid;
        let mut thin = BTreeSet::new();
        if grid.axes() != 2 || grid.dof() > 3 {
            return thin;
        }
        let edges = |node: usize| (0..grid.axes()).filter_map(move |k| Some((node, grid.next(node, k)?)));
        let is_change =
            |&(a, b): &(usize, usize)| self.is_inside(a) && self.is_inside(b) && !self.are_alike(a, b);
        let mut front: BTreeSet<usize> =
            (0..grid.len()).flat_map(edges).filter(is_change).flat_map(|(a, b)| [a, b]).collect();
        let mut looked_at = BTreeSet::new();
        while !front.is_empty() {
            let mut near = BTreeSet::new();
            for &node in &front {
                near.insert(node);
                grid.within(node, REACH, |other| {
                    near.insert(other);
                });
            }
            let alike = near.into_iter().flat_map(edges).filter(|&(a, b)| self.are_alike(a, b));
            let fresh: Vec<(usize, usize)> = alike.filter(|&edge| looked_at.insert(edge)).collect();
            let cut = work::flat_map(&fresh, |&(a, b)| {
                (!control.is_cancelled() && self.changes_between(sheet, a, b)).then_some([a, b])
            });
            front = cut.into_iter().flatten().collect();
            thin.extend(&front);
        }
        thin
    }

    /// Whether the count is another one somewhere between two nodes.
    fn changes_between(&self, sheet: &Sheet<'_>, a: usize, b: usize) -> bool {
        let grid = &self.labels.grid;
        let from = grid.pose(a);
        let to = grid.turned_to(&from, b);
        (1..PARTS).any(|i| {
            let t = i as f64 / PARTS as f64;
            let pose: Pose = std::array::from_fn(|k| from[k] + t * (to[k] - from[k]));
            let pose = &pose[..grid.dof()];
            // Out of the aspect, and where the direct model fails, no count says anything.
            sheet.count(pose).is_some_and(|count| count != self.solutions[a])
        })
    }
}
