//! How far something is known to hold over a box: all over it or not, or over what share of it.

use super::classify::Classifier;
use super::refine::{CHUNK, for_paving};
use super::tree::Paving;
use arrayvec::ArrayVec;
use aspecta_robot::num::{Affine, LANES, Mask};
use aspecta_robot::{Robot, work};

/// What is certain of a box that is undecided as a whole.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Share {
    /// At least this share of it lies in the set.
    pub inside: f32,
    /// At least this share of it lies outside.
    pub outside: f32,
}

impl Share {
    /// What lies inside and what lies outside, of a box of this measure.
    pub fn of(self, measure: f64) -> [f64; 2] {
        [self.inside, self.outside].map(|share| f64::from(share) * measure)
    }
}

/// How far something is proved to hold over each of eight boxes.
pub(super) trait Known: Copy {
    /// All over the boxes.
    const EVERYWHERE: Self;
    /// Nothing is proved.
    const NOWHERE: Self;

    /// All over some of the boxes.
    fn where_all(mask: Mask) -> Self;

    /// How far f > 0, and how far f < 0.
    fn signs<const M: usize>(f: &Affine<M>) -> [Self; 2];

    /// How far both hold.
    fn and(self, other: Self) -> Self;

    /// How far one of them holds.
    fn or(self, other: Self) -> Self;

    /// Whether it holds all over one of the boxes.
    fn is_all(&self, lane: usize) -> bool;
}

/// Whether it holds all over a box.
impl Known for Mask {
    const EVERYWHERE: Self = [true; LANES];
    const NOWHERE: Self = [false; LANES];

    fn where_all(mask: Mask) -> Self {
        mask
    }

    fn signs<const M: usize>(f: &Affine<M>) -> [Self; 2] {
        let range = f.range();
        [range.positive(), range.negative()]
    }

    fn and(self, other: Self) -> Self {
        std::array::from_fn(|l| self[l] & other[l])
    }

    fn or(self, other: Self) -> Self {
        std::array::from_fn(|l| self[l] | other[l])
    }

    fn is_all(&self, lane: usize) -> bool {
        self[lane]
    }
}

/// A share of each box over which it holds, in [0, 1].
#[derive(Clone, Copy, Debug)]
pub(super) struct Part(pub [f64; LANES]);

impl Known for Part {
    const EVERYWHERE: Self = Self([1.0; LANES]);
    const NOWHERE: Self = Self([0.0; LANES]);

    fn where_all(mask: Mask) -> Self {
        Self(mask.map(|all| f64::from(u8::from(all))))
    }

    /// f(t) ≥ c + Σ sₖ tₖ − r: f is positive on a part of the box, cut off by a plane, and negative on another.
    /// What lies between the two planes shrinks like the square of the box.
    fn signs<const M: usize>(f: &Affine<M>) -> [Self; 2] {
        let range = f.range();
        let (positive, negative) = (range.positive(), range.negative());
        let shares = |l: usize| {
            if positive[l] || negative[l] {
                return [positive[l], negative[l]].map(|all| f64::from(u8::from(all)));
            }
            let (centre, slope, radius) = f.lane(l);
            [share_above(centre - radius, &slope), share_above(-centre - radius, &slope)]
        };
        let both: [[f64; 2]; LANES] = std::array::from_fn(shares);
        [0, 1].map(|sign| Self(both.map(|shares| shares[sign])))
    }

    /// At least what is left if they fail in different places.
    fn and(self, other: Self) -> Self {
        Self(std::array::from_fn(|l| (self.0[l] + other.0[l] - 1.0).max(0.0)))
    }

    fn or(self, other: Self) -> Self {
        Self(std::array::from_fn(|l| self.0[l].max(other.0[l])))
    }

    fn is_all(&self, lane: usize) -> bool {
        self.0[lane] == 1.0
    }
}

/// More than all roundings of a share take, that to `f32` included.
const SLACK: f64 = 1e-7;

/// Slopes less than this part of the greatest are looked at as 0, lest others be divided by them.
const FLAT: f64 = 1e-3;

/// A lower bound of the share of the cube [−1, 1]^M on which c + Σ mₖ tₖ > 0.
///
/// The cube's corners cut from the simplex: with wₖ = 2 |mₖ| and s = Σ |mₖ| − c, the share on which it is less than 0 is
/// Σ_S (−1)^|S| (s − Σ_S wₖ)₊^n / (n! Π wₖ) over all sets S of coordinates.
fn share_above<const M: usize>(c: f64, slopes: &[f64; M]) -> f64 {
    let most = slopes.iter().fold(0.0, |most: f64, m| most.max(m.abs()));
    let (mut steep, mut flat) = (ArrayVec::<f64, M>::new(), 0.0);
    for slope in slopes.map(f64::abs) {
        if slope > FLAT * most { steep.push(2.0 * slope) } else { flat += slope }
    }
    let total: f64 = steep.iter().sum();
    let below = 0.5 * total - (c - flat);
    // The smaller part is added up of fewer corners.
    let share = match () {
        () if below < 0.0 => 1.0,
        () if below < 0.5 * total => 1.0 - corner(below, &steep),
        () if below < total => corner(total - below, &steep),
        () => 0.0,
    };
    (share - SLACK).max(0.0)
}

/// The share of [0, 1]^n on which Σ wₖ uₖ < s, for s > 0.
fn corner(s: f64, w: &[f64]) -> f64 {
    let sets = 0..1u32 << w.len();
    let beyond = |set: u32| {
        let over = w.iter().enumerate().filter(|(k, _)| set >> k & 1 == 1).fold(s, |over, (_, w)| over - w);
        let sign = if set.count_ones().is_multiple_of(2) { 1.0 } else { -1.0 };
        sign * over.max(0.0).powi(w.len() as i32)
    };
    let volume = w.iter().enumerate().fold(1.0, |volume, (k, w)| volume * w * (k + 1) as f64);
    sets.map(beyond).sum::<f64>() / volume
}

/// What is certain of the boxes of a paving in which a class is undecided.
#[derive(Clone, Debug, Default)]
pub struct Shares {
    /// Per class: such leaves and their shares, ascending.
    of_class: Vec<Vec<(u32, Share)>>,
    /// How many nodes of the paving are taken account of.
    nodes: u32,
}

impl Shares {
    /// The leaves in which a class is undecided and their shares, ascending; none before the first [`Shares::update`].
    pub fn of(&self, class: usize) -> &[(u32, Share)] {
        self.of_class.get(class).map_or(&[], Vec::as_slice)
    }

    /// Takes account of what the paving was split into since it was looked at last.
    pub fn update(&mut self, paving: &Paving, robot: &Robot) {
        let first = std::mem::replace(&mut self.nodes, paving.nodes.len() as u32);
        if first == self.nodes {
            return;
        }
        self.of_class.resize(2 * paving.modes.len(), Vec::new());
        let is_leaf = |node: u32| paving.nodes[node as usize].first_child == 0;
        self.of_class.iter_mut().for_each(|shares| shares.retain(|share| is_leaf(share.0)));
        let is_open = |&node: &u32| is_leaf(node) && paving.nodes[node as usize].undecided != 0;
        for (depth, leaves) in paving.by_depth((first..self.nodes).filter(is_open)) {
            let fresh = for_paving!(robot, paving.axes.len(), shares_of_level(paving, robot, depth, &leaves));
            self.of_class.iter_mut().zip(fresh).for_each(|(shares, more)| shares.extend(more));
        }
        self.of_class.iter_mut().for_each(|shares| shares.sort_unstable_by_key(|share| share.0));
    }

    /// Leaves that leave most undecided, all classes added up: the fewest that hold three quarters of it, the worst first.
    pub fn worst(&self, paving: &Paving) -> Vec<u32> {
        let mut undecided: Vec<(u32, f64)> = self
            .parts(paving)
            .map(|(node, whole, [inside, outside])| (node, whole - inside - outside))
            .collect();
        undecided.sort_unstable_by_key(|leaf| leaf.0);
        undecided.dedup_by(|next, first| {
            let is_same = next.0 == first.0;
            first.1 += if is_same { next.1 } else { 0.0 };
            is_same
        });
        undecided.sort_by(|a, b| b.1.total_cmp(&a.1));
        let mut left = 0.75 * undecided.iter().map(|leaf| leaf.1).sum::<f64>();
        let holds_more = |leaf: &(u32, f64)| {
            left -= leaf.1;
            left + leaf.1 > 0.0
        };
        undecided.into_iter().take_while(holds_more).map(|leaf| leaf.0).collect()
    }

    /// The measures of what is certainly inside some class, the boxes that are so as a whole included, and of what is undecided, all
    /// classes added up.
    pub fn measures(&self, paving: &Paving) -> [f64; 2] {
        let whole = |node: u32| paving.measure(paving.depth_of(node));
        let leaves = (0..).zip(&paving.nodes).filter(|(_, node)| node.first_child == 0);
        // What a box lies inside of its children do.
        let inside: f64 = leaves.map(|(at, node)| whole(at) * f64::from(node.inside.count_ones())).sum();
        let mut sum = [inside, 0.0];
        for (_, whole, [inside, outside]) in self.parts(paving) {
            sum[0] += inside;
            sum[1] += whole - inside - outside;
        }
        sum
    }

    /// The leaves, of all classes one after the other, each with its measure and what of it is inside and outside.
    fn parts(&self, paving: &Paving) -> impl Iterator<Item = (u32, f64, [f64; 2])> {
        self.of_class.iter().flatten().map(|&(node, share)| {
            let whole = paving.measure(paving.depth_of(node));
            (node, whole, share.of(whole))
        })
    }
}

/// The shares of some leaves of one depth, per class.
fn shares_of_level<const D: usize, const N: usize, const M: usize>(
    paving: &Paving,
    robot: &Robot,
    depth: u32,
    leaves: &[u32],
) -> Vec<Vec<(u32, Share)>> {
    let classifier = Classifier::<D, N, M>::new(robot, paving, &[], depth, leaves.len());
    let chunks: Vec<_> = leaves.chunks(CHUNK).collect();
    let found = work::map(&chunks, |chunk| {
        let mut found = vec![Vec::new(); 2 * paving.modes.len()];
        for eight in chunk.chunks(LANES) {
            let boxes = std::array::from_fn(|l| paving.nodes[eight[l.min(eight.len() - 1)] as usize]);
            for (&leaf, shares) in eight.iter().zip(classifier.shares(&boxes)) {
                let undecided = paving.nodes[leaf as usize].undecided;
                let of_leaf = found.iter_mut().zip(shares).enumerate();
                of_leaf
                    .filter(|(class, _)| undecided >> class & 1 == 1)
                    .for_each(|(_, (all, share))| all.push((leaf, share)));
            }
        }
        found
    });
    let mut all = vec![Vec::new(); 2 * paving.modes.len()];
    found.into_iter().for_each(|found| all.iter_mut().zip(found).for_each(|(all, more)| all.extend(more)));
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use aspecta_robot::num::Random;

    /// Against the share of a grid of points.
    #[test]
    fn shares_are_those_of_points() {
        let random = &mut Random::new(3);
        const GRID: i32 = 60;
        for case in 0..300 {
            let flat = if case % 3 == 0 { 1e-4 } else { 1.0 };
            let slopes =
                [random.within((-1.0, 1.0)), random.within((-1.0, 1.0)), flat * random.within((-1.0, 1.0))];
            let c = random.within((-2.0, 2.0));
            let at = |i: i32| f64::from(2 * i + 1) / f64::from(GRID) - 1.0;
            let above =
                |i: i32, j: i32, k: i32| c + slopes[0] * at(i) + slopes[1] * at(j) + slopes[2] * at(k) > 0.0;
            let count =
                (0..GRID.pow(3)).filter(|n| above(n % GRID, n / GRID % GRID, n / GRID / GRID)).count();
            let (found, seen) = (share_above(c, &slopes), count as f64 / f64::from(GRID.pow(3)));
            assert!((found - seen).abs() < 0.02, "{c} {slopes:?}: {found}, {seen}");
            assert!(share_above(c, &slopes) + share_above(-c, &slopes.map(|m| -m)) <= 1.0);
        }
    }

    #[test]
    fn nothing_is_certain_of_what_is_no_number() {
        assert_eq!(share_above(f64::NAN, &[1.0, 2.0]), 0.0);
        assert_eq!(share_above(-1.0, &[0.0, 0.0]), 0.0);
    }
}
