//! Connected components of the boxes of a class: the two graphs of the sandwich.

use crate::paving::{Mark, Node, Paving};
use crate::robot::{Platform, Robot};

/// Disjoint sets, by path halving and union by index.
pub(super) struct UnionFind(Vec<u32>);

impl UnionFind {
    pub(super) fn new(count: usize) -> Self {
        Self((0..count as u32).collect())
    }

    pub(super) fn root(&mut self, mut i: u32) -> u32 {
        while self.0[i as usize] != i {
            let above = self.0[self.0[i as usize] as usize];
            self.0[i as usize] = above;
            i = above;
        }
        i
    }

    /// The smaller root becomes the root of both, so that results do not depend on the order of unions.
    pub(super) fn union(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b) as usize] = a.min(b);
    }
}

/// A connected set of inside boxes.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    /// Certified measure.
    pub measure: f64,
    /// Its largest box, the first of its size.
    pub largest: u32,
    /// Which component of G⁺ (index of its root box) it lies in.
    pub component: u32,
}

/// The boxes of one class and how they hang together.
pub(super) struct Components {
    /// Node indices of the inside and undecided boxes, ascending.
    pub boxes: Vec<u32>,
    /// For each box its piece (component of G⁻), or `None` if undecided.
    pub piece_of: Vec<Option<u32>>,
    /// For each box its component of G⁺, named by the box index of its root.
    pub component_of: Vec<u32>,
    /// The pieces, in the order of their first box.
    pub pieces: Vec<Piece>,
    /// Measure of the undecided boxes.
    pub undecided: f64,
}

impl Components {
    /// Components of a set of poses.
    ///
    /// G⁺ joins inside and undecided boxes that share a point; G⁻ joins inside boxes that do. A connected
    /// component of the set is covered by the closed boxes of the first kind, so it lies in one component of G⁺;
    /// closed inside boxes that share a point lie in one component of the set (`docs/theory.md`, the sandwich).
    /// Boxes that may touch where coordinates fold up join G⁺ only, which keeps the lower bound a lower bound.
    pub(super) fn new(robot: &Robot, paving: &Paving, sight: &impl Fn(&Node) -> Mark) -> Self {
        let mut boxes = Vec::new();
        paving.boxes_of(sight, &mut |at| boxes.push(at));
        boxes.sort_unstable();
        let mut index_of = vec![u32::MAX; paving.nodes.len()];
        for (i, &at) in boxes.iter().enumerate() {
            index_of[at as usize] = i as u32;
        }
        let is_inside = |at: u32| sight(&paving.nodes[at as usize]) == Mark::Inside;
        let mut all = UnionFind::new(boxes.len());
        let mut inner = UnionFind::new(boxes.len());
        paving.touching(sight, &mut |a, b| {
            let (i, j) = (index_of[a as usize], index_of[b as usize]);
            all.union(i, j);
            if is_inside(a) && is_inside(b) {
                inner.union(i, j);
            }
        });
        for (a, b) in folds(robot, paving, sight) {
            all.union(index_of[a as usize], index_of[b as usize]);
        }
        let mut components = Self {
            piece_of: vec![None; boxes.len()],
            component_of: (0..boxes.len() as u32).map(|i| all.root(i)).collect(),
            pieces: Vec::new(),
            undecided: 0.0,
            boxes,
        };
        components.gather(paving, &is_inside, &mut inner);
        components
    }

    fn gather(&mut self, paving: &Paving, is_inside: &impl Fn(u32) -> bool, inner: &mut UnionFind) {
        let mut piece_at_root = vec![u32::MAX; self.boxes.len()];
        for i in 0..self.boxes.len() {
            let at = self.boxes[i];
            let measure = paving.measure(paving.depth_of(at));
            if !is_inside(at) {
                self.undecided += measure;
                continue;
            }
            let root = inner.root(i as u32) as usize;
            if piece_at_root[root] == u32::MAX {
                piece_at_root[root] = self.pieces.len() as u32;
                self.pieces.push(Piece { measure: 0.0, largest: at, component: self.component_of[i] });
            }
            let piece = piece_at_root[root];
            let piece_so_far = &mut self.pieces[piece as usize];
            piece_so_far.measure += measure;
            piece_so_far.largest = paving.larger(piece_so_far.largest, at);
            self.piece_of[i] = Some(piece);
        }
    }

    /// The piece that holds the box with this node index.
    pub(super) fn piece_at(&self, node: u32) -> Option<u32> {
        self.boxes.binary_search(&node).ok().and_then(|i| self.piece_of[i])
    }
}

/// Pairs of boxes of a set that may touch where the coordinates fold up: at pitch = ±π/2 roll and yaw turn about the same
/// axis, so boxes there may touch whatever their roll and yaw. Where one of the two is held the other tells all poses apart.
fn folds(robot: &Robot, paving: &Paving, sight: &impl Fn(&Node) -> Mark) -> Vec<(u32, u32)> {
    let (roll, pitch, yaw) = (0, 1, 2);
    let varies = |k: usize| paving.axes.contains(&k);
    if robot.platform != Platform::TurningBody || !varies(roll) || !varies(yaw) {
        return Vec::new();
    }
    let half_turn = std::f64::consts::FRAC_PI_2;
    let axis = paving.axes.iter().position(|&k| k == pitch);
    let mut pairs = Vec::new();
    let mut at_pole: [Option<u32>; 2] = [None; 2];
    paving.boxes_of(sight, &mut |at| {
        let (lo, hi) = paving.bounds(at);
        let (lo, hi) = axis.map_or(paving.window.ranges[pitch], |a| (lo[a], hi[a]));
        for (pole, touches) in [lo <= -half_turn, hi >= half_turn].into_iter().enumerate() {
            if touches {
                let first = *at_pole[pole].get_or_insert(at);
                pairs.push((first, at));
            }
        }
    });
    pairs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unions_do_not_depend_on_their_order() {
        let pairs = [(0, 4), (4, 2), (1, 3), (3, 5)];
        let roots = |order: &[usize]| {
            let mut sets = UnionFind::new(6);
            for &k in order {
                sets.union(pairs[k].0, pairs[k].1);
            }
            (0..6).map(|i| sets.root(i)).collect::<Vec<_>>()
        };
        assert_eq!(roots(&[0, 1, 2, 3]), [0, 1, 0, 1, 0, 1]);
        assert_eq!(roots(&[3, 1, 0, 2]), roots(&[0, 1, 2, 3]));
    }
}
