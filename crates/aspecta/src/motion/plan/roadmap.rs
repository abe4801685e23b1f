//! The boxes of a class as a graph: the coarse boxes first, finer ones where these do not connect.

use super::Pose;
use super::cost::Cost;
use crate::aspect::{Analysis, ClassId};
use crate::motion::search::cheapest_way;
use crate::paving::{ClassSet, Mark, Node};
use aspecta_kinematics::constraints::Margins;
use aspecta_robot::num::padded;
use aspecta_robot::work;
use std::collections::{HashMap, HashSet};

/// The cost that is assumed of a unit of length on the rest of a way. A unit costs 1 at least, seldom less
/// than twice that; looking ahead so a search sees a third of the boxes, and what it gives away the way gets
/// back when it is made shorter.
const AHEAD: f64 = 2.5;

/// A box that is proved to lie in the class.
pub(super) struct Spot {
    pub centre: Pose,
    /// Half its widths.
    half: Pose,
    /// How far from singularities its centre is.
    measures: Margins,
    /// Which spots hang together with it.
    pub piece: u32,
}

/// The boxes of a class down to a depth, and which touch.
pub(super) struct Roadmap {
    pub depth: u32,
    spots: Vec<Spot>,
    /// Nodes of the paving, ascending: spot i is node `nodes[i]`.
    nodes: Vec<u32>,
    /// The neighbours of spot i: `next[first[i]..first[i + 1]]`.
    first: Vec<u32>,
    next: Vec<u32>,
    pub class: ClassId,
    /// Proved paths between pieces, by the spots at their ends.
    bridges: Option<HashMap<[u32; 2], Vec<Pose>>>,
}

/// A climb from one piece to another.
struct Bridge {
    ends: [u32; 2],
    path: Vec<Pose>,
}

impl Roadmap {
    /// The boxes of a class that lie in it, not deeper than `depth`.
    pub fn new(analysis: &Analysis, class: ClassId, depth: u32, cost: &Cost<'_, 3>) -> Self {
        let (paving, bit) = analysis.paving_behind(class);
        let classify = classify(bit, depth);
        let mut nodes = Vec::new();
        paving.boxes_of(&classify, &mut |node| nodes.push(node));
        nodes.sort_unstable();
        let spot = |&node: &u32| {
            let (lo, hi) = paving.bounds(node);
            let centre: Pose = padded(&paving.centre(node));
            let half = std::array::from_fn(|k| 0.5 * (hi[k] - lo[k]));
            Spot { centre, half, measures: cost.measures(&centre), piece: u32::MAX }
        };
        let spots: Vec<Spot> = nodes.iter().map(spot).collect();
        let mut pairs = Vec::new();
        let place = |node: u32| nodes.binary_search(&node).unwrap_or(0) as u32;
        paving.touching(&classify, &mut |a, b| {
            let (a, b) = (place(a), place(b));
            pairs.extend([(a, b), (b, a)]);
        });
        let mut roadmap =
            Self { depth, spots, nodes, first: Vec::new(), next: Vec::new(), class, bridges: None };
        roadmap.join(pairs);
        roadmap
    }

    /// Takes the pairs for the edges.
    fn join(&mut self, mut pairs: Vec<(u32, u32)>) {
        pairs.sort_unstable();
        pairs.dedup();
        let count = self.spots.len() as u32;
        self.first = (0..=count).map(|i| pairs.partition_point(|pair| pair.0 < i) as u32).collect();
        self.next = pairs.into_iter().map(|pair| pair.1).collect();
        self.spots.iter_mut().for_each(|spot| spot.piece = u32::MAX);
        self.name_pieces();
    }

    /// Joins pieces by climbs: from the largest box of each, until another piece is met. False if that was
    /// done before.
    pub fn build_bridges(&mut self, analysis: &Analysis) -> bool {
        if self.bridges.is_some() {
            return false;
        }
        let mut largest: HashMap<u32, u32> = HashMap::new();
        for i in 0..self.spots.len() as u32 {
            let best = largest.entry(self.spot(i).piece).or_insert(i);
            if self.spot(i).half > self.spot(*best).half {
                *best = i;
            }
        }
        let starts: Vec<u32> = largest.into_values().collect();
        let bridges: Vec<Bridge> = work::flat_map(&starts, |&from| self.bridge_from(analysis, from));
        let mut pairs: Vec<(u32, u32)> = Vec::new();
        for from in 0..self.spots.len() as u32 {
            pairs.extend(self.around(from).iter().map(|&to| (from, to)));
        }
        pairs.extend(bridges.iter().flat_map(|b| [(b.ends[0], b.ends[1]), (b.ends[1], b.ends[0])]));
        self.bridges = Some(bridges.into_iter().map(|bridge| (bridge.ends, bridge.path)).collect());
        self.join(pairs);
        true
    }

    /// The climb from a spot to the first other piece it meets.
    fn bridge_from(&self, analysis: &Analysis, from: u32) -> Option<Bridge> {
        let start = self.spot(from).centre;
        let (mut path, mut met) = (vec![start], None);
        analysis.climb(&start[..analysis.robot.dof()], self.class, &mut |pose| {
            path.push(padded(pose));
            let other = |&to: &u32| self.spot(to).piece != self.spot(from).piece;
            met = self.holding(analysis, pose).filter(other);
            met.is_some()
        });
        met.map(|to| Bridge { ends: [from, to], path })
    }

    /// The poses between two spots that a climb joins, if one does.
    pub fn bridge(&self, from: u32, to: u32) -> Option<Vec<Pose>> {
        let bridges = self.bridges.as_ref()?;
        let backwards = || bridges.get(&[to, from]).map(|path| path.iter().rev().copied().collect());
        bridges.get(&[from, to]).cloned().or_else(backwards)
    }

    fn name_pieces(&mut self) {
        let mut open = Vec::new();
        for start in 0..self.spots.len() {
            if self.spots[start].piece != u32::MAX {
                continue;
            }
            open.push(start as u32);
            while let Some(spot) = open.pop() {
                if self.spots[spot as usize].piece == u32::MAX {
                    self.spots[spot as usize].piece = start as u32;
                    open.extend_from_slice(self.around(spot));
                }
            }
        }
    }

    fn around(&self, spot: u32) -> &[u32] {
        let i = spot as usize;
        &self.next[self.first[i] as usize..self.first[i + 1] as usize]
    }

    pub fn spot(&self, spot: u32) -> &Spot {
        &self.spots[spot as usize]
    }

    /// The spot whose box holds a pose.
    pub fn holding(&self, analysis: &Analysis, pose: &[f64]) -> Option<u32> {
        let (paving, bit) = analysis.paving_behind(self.class);
        let (node, _) = paving.find(&classify(bit, self.depth), pose)?;
        self.nodes.binary_search(&node).ok().map(|spot| spot as u32)
    }

    /// A cheap way from a spot to another (A*; at most [`AHEAD`] times as dear as the cheapest), both ends
    /// included, over spots whose centres keep the margins; none through `blocked` pairs.
    pub fn way(
        &self,
        cost: &Cost<'_, 3>,
        margins: Margins,
        blocked: &HashSet<(u32, u32)>,
        [start, goal]: [u32; 2],
    ) -> Option<Vec<u32>> {
        let target = self.spot(goal).centre;
        let weight = if cost.is_length() { 1.0 } else { AHEAD };
        let length = |a: &Pose, b: &Pose| cost.distance(a, &cost.beside(a, b));
        let ahead = |spot: u32| weight * length(&self.spot(spot).centre, &target);
        let keeps = |spot: u32| {
            let m = self.spot(spot).measures;
            m.parallel >= margins.parallel && m.serial >= margins.serial
        };
        cheapest_way(self.spots.len(), [start, goal], ahead, |spot, visit| {
            let here = self.spot(spot);
            let density = cost.density(here.measures);
            for &next in self.around(spot) {
                if keeps(next) && !blocked.contains(&(spot, next)) {
                    let there = self.spot(next);
                    let mean = 0.5 * (density + cost.density(there.measures));
                    visit(next, length(&here.centre, &there.centre) * mean);
                }
            }
        })
    }
}

impl Spot {
    /// Returns the meeting point of this box and one that touches it: the middle of their common part, with
    /// their centres turned to be `here` and `there`.
    pub fn meeting(&self, other: &Self, here: &Pose, there: &Pose) -> Pose {
        std::array::from_fn(|k| {
            let lo = (here[k] - self.half[k]).max(there[k] - other.half[k]);
            let hi = (here[k] + self.half[k]).min(there[k] + other.half[k]);
            0.5 * (lo + hi)
        })
    }
}

/// The boxes inside a class, not deeper than `depth`.
fn classify(class: ClassSet, depth: u32) -> impl Fn(&Node) -> Mark {
    move |node| match node.of_classes(class) {
        Mark::Open if node.first_child == 0 || u32::from(node.depth) >= depth => Mark::Outside,
        mark @ (Mark::Inside | Mark::Outside | Mark::Open) => mark,
    }
}
