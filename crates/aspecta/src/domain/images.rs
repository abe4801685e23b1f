//! Which basic components coincide: regions whose poses share joint vectors.

use super::labels::OUTSIDE;
use super::partition::{Partition, Region};
use aspecta_robot::work;
use std::collections::{BTreeMap, BTreeSet};

/// Nodes a task looks at.
const CHUNK: usize = 1 << 12;

impl Partition {
    /// For each region, the regions that poses with the same joint vector lie in.
    ///
    /// Evidence are the nodes that lie, with all those poses, away from the characteristic surfaces by a
    /// cell; where a region has none, all its nodes.
    pub fn images(&self, regions: &[Region]) -> Images {
        let nodes = self.labels.grid.len();
        let look = |mut tallies: [Tally; 2], chunk: usize| {
            let chunk = chunk * CHUNK..((chunk + 1) * CHUNK).min(nodes);
            for node in chunk.filter(|&node| self.solutions[node] > 1) {
                let (images, sure) = self.images_of(regions, node);
                tallies[usize::from(!sure)].entry(self.labels.region[node]).or_default().add(node, &images);
            }
            tallies
        };
        let join = |mut a: [Tally; 2], b: [Tally; 2]| {
            for (a, b) in a.iter_mut().zip(b) {
                b.into_iter().for_each(|(region, seen)| a.entry(region).or_default().merge(seen));
            }
            a
        };
        let chunks = work::map_range(nodes.div_ceil(CHUNK), |chunk| look(Default::default(), chunk));
        let [sure, mut unsure] = chunks.into_iter().fold(Default::default(), join);
        unsure.retain(|region, _| !sure.contains_key(region));
        Images { seen: sure.into_iter().chain(unsure).collect() }
    }

    /// The regions of the other poses with a node's joint vector, and whether these are sure.
    fn images_of(&self, regions: &[Region], node: usize) -> (BTreeSet<u32>, bool) {
        let (mut images, mut sure) = (BTreeSet::new(), self.labels.is_inner(node));
        for other in self.others(node) {
            let other = &other[..self.labels.grid.dof()];
            // A pose with the same joint vector has the same count; if the nodes round it do not, it lies in
            // a sliver between them.
            let alike = |r: &u32| *r != OUTSIDE && regions[*r as usize].solutions == self.solutions[node];
            let round = self.labels.region_round(other).filter(alike);
            sure &= round.is_some();
            images.extend(round.or_else(|| self.labels.region_beside(other, alike)));
        }
        (images, sure)
    }
}

type Tally = BTreeMap<u32, Seen>;

/// The images seen at the nodes of a region.
#[derive(Clone, Debug, Default)]
struct Seen {
    nodes: usize,
    /// Per region: how many of the nodes have a joint vector with a pose in it, and the first that has.
    images: BTreeMap<u32, (usize, usize)>,
}

impl Seen {
    fn add(&mut self, node: usize, images: &BTreeSet<u32>) {
        self.nodes += 1;
        for &region in images {
            let entry = self.images.entry(region).or_insert((0, node));
            *entry = (entry.0 + 1, entry.1.min(node));
        }
    }

    fn merge(&mut self, other: Self) {
        self.nodes += other.nodes;
        for (region, (nodes, first)) in other.images {
            let entry = self.images.entry(region).or_insert((0, first));
            *entry = (entry.0 + nodes, entry.1.min(first));
        }
    }
}

/// Which regions' images meet.
pub struct Images {
    seen: Tally,
}

impl Images {
    /// Pairs of regions (the lesser first; a region with itself too) with a joint vector in common.
    pub fn meeting(&self) -> BTreeSet<(usize, usize)> {
        let pairs = self
            .seen
            .iter()
            .flat_map(|(&a, seen)| seen.images.keys().map(move |&b| (a as usize, b as usize)));
        pairs.map(|(a, b)| (a.min(b), a.max(b))).collect()
    }

    /// A node of a region whose joint vector has a second pose in it: a violation of Theorem 2.
    pub fn within(&self, region: usize) -> Option<usize> {
        let seen = self.seen.get(&(region as u32))?;
        seen.images.get(&(region as u32)).map(|(_, first)| *first)
    }

    /// The share of the nodes of region `a` whose joint vectors have a pose in region `b`.
    pub fn share(&self, a: usize, b: usize) -> f64 {
        let Some(seen) = self.seen.get(&(a as u32)) else { return 0.0 };
        let nodes = seen.images.get(&(b as u32)).map_or(0, |(nodes, _)| *nodes);
        nodes as f64 / seen.nodes as f64
    }
}
