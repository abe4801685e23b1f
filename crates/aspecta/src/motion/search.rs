//! The cheapest way through a graph (Hart, Nilsson, Raphael 1968).

use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// The way from `start` to `goal`, both included, over `count` spots. `edges` names the neighbours of a spot
/// and what it costs to go there, `ahead` what the rest of the way is taken to cost: the way is the cheapest
/// if it is never more than that. `None` if there is no way.
pub(super) fn cheapest_way(
    count: usize,
    [start, goal]: [u32; 2],
    ahead: impl Fn(u32) -> f64,
    edges: impl Fn(u32, &mut dyn FnMut(u32, f64)),
) -> Option<Vec<u32>> {
    let mut best = vec![(f64::INFINITY, u32::MAX); count];
    best[start as usize] = (0.0, start);
    let mut open = BinaryHeap::from([Open { estimate: 0.0, cost: 0.0, spot: start }]);
    while let Some(Open { cost, spot, .. }) = open.pop() {
        if spot == goal {
            let mut way = vec![goal];
            while way[way.len() - 1] != start {
                way.push(best[way[way.len() - 1] as usize].1);
            }
            way.reverse();
            return Some(way);
        }
        if cost > best[spot as usize].0 {
            continue;
        }
        edges(spot, &mut |next, length| {
            let total = cost + length;
            if total < best[next as usize].0 {
                best[next as usize] = (total, spot);
                open.push(Open { estimate: total + ahead(next), cost: total, spot: next });
            }
        });
    }
    None
}

/// A spot to go on from, the cheapest first.
struct Open {
    estimate: f64,
    cost: f64,
    spot: u32,
}

impl Ord for Open {
    fn cmp(&self, other: &Self) -> Ordering {
        other.estimate.total_cmp(&self.estimate).then(other.spot.cmp(&self.spot))
    }
}

impl PartialOrd for Open {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Open {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Open {}
