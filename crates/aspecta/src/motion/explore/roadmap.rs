//! A roadmap: poses of one class, and which of them are joined by segments that are proved.

use super::body::{Body, Pose};
use super::territory::Territory;
use crate::aspect::UnionFind;
use crate::motion::search::cheapest_way;

/// Poses of one class of aspects and proved straight segments between them.
#[derive(Default)]
pub(super) struct Roadmap {
    spots: Vec<Spot>,
    pub edges: Vec<[u32; 2]>,
    /// Which spots hang together: each has the number of the first of them.
    component: Vec<u32>,
}

/// A pose that is proved to lie in the class.
pub(super) struct Spot {
    pub pose: Pose,
    body: Body,
    /// Whether it was drawn, or asked for, and not met on a way.
    pub is_sample: bool,
    around: Vec<u32>,
}

/// A way that was found: from a spot, over new poses, each joined to the one before, to a spot if it arrives
/// at one.
pub(super) struct Way {
    pub from: u32,
    pub over: Vec<Pose>,
    pub to: Option<u32>,
}

impl Roadmap {
    pub fn len(&self) -> usize {
        self.spots.len()
    }

    pub fn spot(&self, k: u32) -> &Spot {
        &self.spots[k as usize]
    }

    /// Adds a pose, alone.
    pub fn add(&mut self, pose: Pose, is_sample: bool) -> u32 {
        let k = self.spots.len() as u32;
        self.spots.push(Spot { pose, body: Body::at(&pose), is_sample, around: Vec::new() });
        self.component.push(k);
        k
    }

    /// Adds a way. Components are out of date until they are named again.
    pub fn take(&mut self, way: Way) -> u32 {
        let mut last = way.from;
        for pose in way.over {
            let next = self.add(pose, false);
            self.join(last, next);
            last = next;
        }
        if let Some(to) = way.to {
            self.join(last, to);
        }
        last
    }

    fn join(&mut self, a: u32, b: u32) {
        self.edges.push([a, b]);
        self.spots[a as usize].around.push(b);
        self.spots[b as usize].around.push(a);
    }

    /// Names the components anew.
    pub fn name_components(&mut self) {
        let mut sets = UnionFind::new(self.len());
        self.edges.iter().for_each(|&[a, b]| sets.union(a, b));
        self.component = (0..self.len() as u32).map(|k| sets.root(k)).collect();
    }

    /// The component of a spot.
    pub fn component(&self, spot: u32) -> u32 {
        self.component[spot as usize]
    }

    /// The spots of each component, the largest first.
    pub fn components(&self) -> Vec<Vec<u32>> {
        let mut all: Vec<Vec<u32>> = vec![Vec::new(); self.len()];
        (0..self.len() as u32).for_each(|k| all[self.component(k) as usize].push(k));
        all.retain(|component| !component.is_empty());
        all.sort_by(|a, b| b.len().cmp(&a.len()).then(a[0].cmp(&b[0])));
        all
    }

    /// In each component that is `wanted`, the spot next to a pose; the nearest `count` of these.
    pub fn nearest(
        &self,
        territory: &Territory<'_>,
        pose: &Pose,
        count: usize,
        wanted: impl Fn(u32) -> bool,
    ) -> Vec<u32> {
        let body = Body::at(pose);
        let mut best: Vec<(f64, u32)> = vec![(f64::INFINITY, 0); self.len()];
        for k in 0..self.len() as u32 {
            let component = self.component(k);
            if wanted(component) {
                let far = territory.distance(&body, &self.spot(k).body);
                let best = &mut best[component as usize];
                if far < best.0 {
                    *best = (far, k);
                }
            }
        }
        best.retain(|(far, _)| far.is_finite());
        best.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        best.into_iter().take(count).map(|(_, k)| k).collect()
    }

    /// The shortest way between two spots, both included.
    pub fn way(&self, territory: &Territory<'_>, from: u32, to: u32) -> Option<Vec<u32>> {
        let length = |a: u32, b: u32| territory.distance(&self.spot(a).body, &self.spot(b).body);
        cheapest_way(
            self.len(),
            [from, to],
            |_| 0.0,
            |spot, visit| {
                self.spot(spot).around.iter().for_each(|&next| visit(next, length(spot, next)));
            },
        )
    }
}
