//! A way round what is in between, where no aspects are known: two trees of proved segments, one from either end, grow towards poses drawn
//! at random and towards one another (RRT-Connect, Kuffner & LaValle 2000).

use super::cost::Cost;
use super::{Pose, Proof};
use aspecta_robot::num::Random;

/// Poses drawn, at most: what they do not join is left to the aspects.
const DRAWN: usize = 1000;
/// A step of a tree, as a share of the window's diagonal.
const STEP: f64 = 1.0 / 32.0;

/// A proved path between two poses, if one is found. Deterministic.
pub(super) fn path(proof: &Proof<'_>, cost: &Cost<'_, 3>, ends: [Pose; 2]) -> Option<Vec<Pose>> {
    let mut random = Random::new(1);
    let mut trees = ends.map(Tree::new);
    for k in 0..DRAWN {
        let mut drawn: Pose = [0.0; 3];
        drawn.iter_mut().zip(&proof.window.ranges).for_each(|(x, range)| *x = random.within(*range));
        let [here, there] = [k % 2, 1 - k % 2];
        let Some(new) = trees[here].step_towards(&drawn, proof, cost) else { continue };
        let new = trees[here].poses[new];
        if trees[there].comes_to(&new, proof, cost) {
            return Some(joined(trees, cost));
        }
    }
    None
}

/// Poses that are joined to the first by proved segments.
struct Tree {
    poses: Vec<Pose>,
    /// Of each pose but the first that from which it was come to.
    parents: Vec<usize>,
}

impl Tree {
    fn new(root: Pose) -> Self {
        Self { poses: vec![root], parents: vec![0] }
    }

    /// One step from the nearest pose: the number of the pose that it leads to, if the segment is proved.
    fn step_towards(&mut self, goal: &Pose, proof: &Proof<'_>, cost: &Cost<'_, 3>) -> Option<usize> {
        let far = |k: &usize| cost.distance(&self.poses[*k], &cost.beside(&self.poses[*k], goal));
        let nearest = (0..self.poses.len()).min_by(|a, b| far(a).total_cmp(&far(b)))?;
        self.step_from(nearest, goal, proof, cost)
    }

    fn step_from(
        &mut self,
        from: usize,
        goal: &Pose,
        proof: &Proof<'_>,
        cost: &Cost<'_, 3>,
    ) -> Option<usize> {
        let start = self.poses[from];
        let goal = cost.beside(&start, goal);
        let share = (STEP * cost.size / cost.distance(&start, &goal)).min(1.0);
        let next: Pose = match share < 1.0 {
            true => std::array::from_fn(|k| start[k] + share * (goal[k] - start[k])),
            false => goal,
        };
        proof.holds(&start, &next).then(|| {
            self.poses.push(next);
            self.parents.push(from);
            self.poses.len() - 1
        })
    }

    /// Steps towards a pose as long as they are proved, and whether they come there.
    fn comes_to(&mut self, goal: &Pose, proof: &Proof<'_>, cost: &Cost<'_, 3>) -> bool {
        let mut last = self.step_towards(goal, proof, cost);
        while let Some(here) = last {
            if self.poses[here] == cost.beside(&self.poses[here], goal) {
                return true;
            }
            last = self.step_from(here, goal, proof, cost);
        }
        false
    }

    /// The way from the last pose to the first.
    fn way_back(&self) -> Vec<Pose> {
        let mut at = self.poses.len() - 1;
        let mut way = vec![self.poses[at]];
        while at > 0 {
            at = self.parents[at];
            way.push(self.poses[at]);
        }
        way
    }
}

/// The way from the first root to the other, where the last poses of both are one.
fn joined([first, second]: [Tree; 2], cost: &Cost<'_, 3>) -> Vec<Pose> {
    let mut way = first.way_back();
    way.reverse();
    for pose in &second.way_back()[1..] {
        way.push(cost.beside(&way[way.len() - 1], pose));
    }
    way
}
