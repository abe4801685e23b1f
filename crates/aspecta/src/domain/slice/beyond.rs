//! Relations between the regions of a slice that are seen beyond the slice.
//!
//! Two regions of a slice may be parts of one basic region of the whole workspace, joined outside the slice;
//! and their images may coincide although no joint vector has a pose in both, for X′ with the joint vector of
//! X leaves the slice. Either shows in a way through the class from X, or from X′, to a pose of the other
//! region along which no pose with the same joint vector enters or leaves: *numerical*, and only straight
//! ways are tried. Images of regions with different numbers of solutions are disjoint, for the number is one
//! of the joint vector.

use crate::aspect::UnionFind;
use crate::domain::grid::Pose;
use crate::domain::partition::{Partition, Region};
use crate::domain::sheet::Sheet;
use crate::paving::Control;
use aspecta_robot::num::without_turns;
use aspecta_robot::work;
use std::collections::BTreeSet;

/// Nodes of a region that ways start and end at.
const SAMPLES: usize = 3;
/// A way is looked at in 2^[`PARTS`] parts at least.
const PARTS: u32 = 3;

/// Pairs of regions, by index, the lesser first.
type Pairs = BTreeSet<(usize, usize)>;

/// The relations known between pairs of regions with the same number of solutions, two or more.
#[derive(Clone, Debug, Default)]
pub struct Beyond {
    /// They are parts of one basic region.
    pub joined: Pairs,
    /// Their images coincide; a region paired with itself has two poses of one joint vector.
    pub coincident: Pairs,
    /// Neither has been seen.
    pub undecided: Pairs,
    /// Two poses with one joint vector in one region, with the region: Theorem 2 does not hold there.
    pub twins: Vec<(usize, [Pose; 2])>,
}

/// The relation that a way shows between two regions.
#[derive(Clone, Copy)]
enum Shown {
    Joined,
    /// Two poses with one joint vector, the first in the one region, the second joined to the other.
    Coincident([Pose; 2]),
}

impl Beyond {
    /// Tries ways between the regions of a slice; `None` for a whole workspace.
    pub fn new(
        sheet: &Sheet<'_>,
        partition: &Partition,
        regions: &[Region],
        control: &Control<'_>,
    ) -> Option<Self> {
        let class = sheet.beyond()?;
        let ways = Ways { class, partition, samples: samples(partition, regions.len()) };
        let pairs: Vec<(usize, usize)> = (0..regions.len())
            .flat_map(|a| (a..regions.len()).map(move |b| (a, b)))
            .filter(|&(a, b)| regions[a].solutions > 1 && regions[a].solutions == regions[b].solutions)
            .collect();
        let shown = |&(a, b): &(usize, usize)| if control.is_cancelled() { None } else { ways.between(a, b) };
        let shown: Vec<Option<Shown>> = work::map(&pairs, shown);
        Some(Self::concluded(regions.len(), pairs.into_iter().zip(shown)))
    }

    /// Returns the relations that follow for all pairs: regions joined to one region are one, and a relation
    /// of one holds for all of them.
    fn concluded(count: usize, shown: impl Iterator<Item = ((usize, usize), Option<Shown>)> + Clone) -> Self {
        let mut sets = UnionFind::new(count);
        for ((a, b), _) in shown.clone().filter(|(_, shown)| matches!(shown, Some(Shown::Joined))) {
            sets.union(a as u32, b as u32);
        }
        let mut roots = |(a, b): (usize, usize)| {
            let (a, b) = (sets.root(a as u32), sets.root(b as u32));
            (a.min(b), a.max(b))
        };
        let coincident: BTreeSet<(u32, u32)> = shown
            .clone()
            .filter(|(_, shown)| matches!(shown, Some(Shown::Coincident(_))))
            .map(|(pair, _)| roots(pair))
            .collect();
        let mut beyond = Self::default();
        for (pair, shown) in shown {
            if let (true, Some(Shown::Coincident(twins))) = (pair.0 == pair.1, shown) {
                beyond.twins.push((pair.0, twins));
            }
            let roots = roots(pair);
            if coincident.contains(&roots) {
                beyond.coincident.insert(pair);
            }
            if pair.0 != pair.1 && roots.0 == roots.1 {
                beyond.joined.insert(pair);
            } else if pair.0 != pair.1 && !coincident.contains(&roots) {
                beyond.undecided.insert(pair);
            }
        }
        beyond
    }
}

/// Nodes amid each region, far apart in their order.
fn samples(partition: &Partition, count: usize) -> Vec<Vec<usize>> {
    let mut inner = vec![Vec::new(); count];
    for (node, &region) in partition.labels.region.iter().enumerate() {
        if let Some(nodes) = inner.get_mut(region as usize)
            && partition.labels.is_inner(node)
        {
            nodes.push(node);
        }
    }
    let some = |nodes: Vec<usize>| {
        let step = nodes.len().div_ceil(SAMPLES).max(1);
        nodes.into_iter().skip(step / 2).step_by(step).collect()
    };
    inner.into_iter().map(some).collect()
}

/// A pose, and the others with its joint vector.
type Fibre = (Pose, Vec<Pose>);

/// Ways through the class.
struct Ways<'a> {
    class: Sheet<'a>,
    partition: &'a Partition,
    samples: Vec<Vec<usize>>,
}

impl Ways<'_> {
    /// Returns the relation that the ways from one region to another show.
    fn between(&self, a: usize, b: usize) -> Option<Shown> {
        self.samples[a].iter().find_map(|&node| {
            let fibre = self.fibre(node);
            if a != b && self.leads(&fibre, b) {
                return Some(Shown::Joined);
            }
            let other = (0..fibre.1.len()).find(|&k| self.leads(&seen_from(&fibre, k), b))?;
            Some(Shown::Coincident([fibre.0, fibre.1[other]]))
        })
    }

    /// The poses with the joint vector of a node.
    fn fibre(&self, node: usize) -> Fibre {
        (self.partition.labels.grid.pose(node), self.partition.others(node).to_vec())
    }

    /// Whether the straight way leads from a pose to the nearest sample of a region.
    fn leads(&self, (from, others): &Fibre, to: usize) -> bool {
        let grid = &self.partition.labels.grid;
        let gap = |node: &usize| self.class.gap(&from[..grid.dof()], &grid.pose(*node)[..grid.dof()]);
        let Some(&nearest) = self.samples[to].iter().min_by(|a, b| gap(a).total_cmp(&gap(b))) else {
            return false;
        };
        let (goal, there) = self.beside(from, self.fibre(nearest));
        self.class.follow(grid, (*from, others), (goal, &there), PARTS).is_some()
    }

    /// A pose with its angles turned to be next to another.
    fn beside(&self, near: &Pose, (pose, others): Fibre) -> Fibre {
        let angles = &self.class.whole().angles;
        let turned = std::array::from_fn(|k| match angles.get(k) {
            Some(true) => near[k] + without_turns(pose[k] - near[k]),
            _ => pose[k],
        });
        (turned, others)
    }
}

/// Returns the poses of a fibre seen from another of them.
fn seen_from((pose, others): &Fibre, k: usize) -> Fibre {
    let mut rest = others.clone();
    let from = std::mem::replace(&mut rest[k], *pose);
    (from, rest)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Regions 0 and 1 are one, the images of 1 and 2 coincide: so do those of 0 and 2. Of 3 nothing is
    /// known.
    #[test]
    fn what_is_known_of_a_part_holds_for_the_whole() {
        let pairs = (0..4).flat_map(|a| (a..4).map(move |b| (a, b)));
        let shown = pairs.map(|pair| match pair {
            (0, 1) => (pair, Some(Shown::Joined)),
            (1, 2) => (pair, Some(Shown::Coincident([[0.0; 6]; 2]))),
            _ => (pair, None),
        });
        let beyond = Beyond::concluded(4, shown);
        assert_eq!(beyond.joined, Pairs::from([(0, 1)]));
        assert_eq!(beyond.coincident, Pairs::from([(0, 2), (1, 2)]));
        assert_eq!(beyond.undecided, Pairs::from([(0, 3), (1, 3), (2, 3)]));
    }
}
