//! Connected components of the boxes of a class: the two graphs of the sandwich.

use super::atlas::Leaf;
use super::seams;
use crate::paving::{Mark, Node, Paving};
use aspecta_robot::Robot;

/// Disjoint sets, by path halving and union by index.
pub(crate) struct UnionFind(Vec<u32>);

impl UnionFind {
    pub(crate) fn new(count: usize) -> Self {
        Self((0..count as u32).collect())
    }

    pub(crate) fn root(&mut self, mut i: u32) -> u32 {
        while self.0[i as usize] != i {
            let above = self.0[self.0[i as usize] as usize];
            self.0[i as usize] = above;
            i = above;
        }
        i
    }

    /// The smaller root becomes the root of both, so that results do not depend on the order of unions.
    pub(crate) fn union(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b) as usize] = a.min(b);
    }
}

/// A connected set of inside boxes.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    /// Certified measure, in pose coordinates.
    pub measure: f64,
    /// Its largest box in pose coordinates, the first of its size, or a box of another sheet if it has none.
    pub largest: Leaf,
    /// Which component of G⁺ (index of its root box) it lies in.
    pub component: u32,
}

/// The boxes of a set of configurations and how they hang together.
pub(super) struct Components {
    /// The inside and undecided boxes of all sheets, ascending; those that a fold's chart covers only if they
    /// are inside.
    pub boxes: Vec<Leaf>,
    /// The piece of each box (component of G⁻), or `None` if undecided, or covered and connected to none
    /// that is not.
    pub piece_of: Vec<Option<u32>>,
    /// The component of G⁺ of each box, named by what was the box index of its root; `None` for covered boxes.
    pub component_of: Vec<Option<u32>>,
    /// The pieces, in the order of their first box.
    pub pieces: Vec<Piece>,
    /// Boxes of sheets from 1 on whose centres lie in a box of the sheet beneath, so that what touches the
    /// one and what touches the other are one piece; no more than that takes.
    pub seams: Vec<Leaf>,
}

impl Components {
    /// Components of a set of configurations, given over the sheets of an atlas (or one sheet alone).
    ///
    /// G⁺ joins inside and undecided boxes that share a point; G⁻ joins inside boxes that do. A connected
    /// component of the set is covered by the closed boxes of the first kind, so it lies in one component of
    /// G⁺; closed inside boxes that share a point lie in one component of the set (`docs/theory.md`, the
    /// sandwich). Boxes that may touch where coordinates fold up, or in another chart, join G⁺ only, which
    /// keeps the lower bound a lower bound. Boxes that a fold's chart covers are not in G⁺, its own boxes
    /// stand for them; but inside they are, so they do connect in G⁻.
    pub(super) fn new(robot: &Robot, sheets: &[Paving], classify: &impl Fn(&Node) -> Mark) -> Self {
        Self::with_links(robot, sheets, classify, &mut |_, _| {})
    }

    /// [`Components::new`], and a visit of every pair of boxes (by index) that G⁺ joins and G⁻ need not.
    pub(super) fn with_links(
        robot: &Robot,
        sheets: &[Paving],
        classify: &impl Fn(&Node) -> Mark,
        visit: &mut impl FnMut(u32, u32),
    ) -> Self {
        // One sheet alone has nothing to cover it. Covered boxes count only where they are inside.
        let is_covered = |node: &Node| node.covered && sheets.len() > 1;
        let kept = |node: &Node| match classify(node) {
            Mark::Open if is_covered(node) && node.first_child == 0 => Mark::Outside,
            mark @ (Mark::Inside | Mark::Outside | Mark::Open) => mark,
        };
        let mut boxes: Vec<Leaf> = Vec::new();
        for (s, paving) in sheets.iter().enumerate() {
            let first = boxes.len();
            paving.boxes_of(&kept, &mut |at| boxes.push((s, at)));
            boxes[first..].sort_unstable();
        }
        let index = Index::new(sheets, &boxes);
        let node = |(s, at): Leaf| &sheets[s].nodes[at as usize];
        let is_inside = |leaf: Leaf| classify(node(leaf)) == Mark::Inside;
        let inside: Vec<bool> = boxes.iter().map(|&leaf| is_inside(leaf)).collect();
        let covered: Vec<bool> = boxes.iter().map(|&leaf| is_covered(node(leaf))).collect();
        let mut all = UnionFind::new(boxes.len());
        let mut inner = UnionFind::new(boxes.len());
        let mut may_touch = |i: u32, j: u32, surely: bool| {
            if !covered[i as usize] && !covered[j as usize] {
                all.union(i, j);
                if !surely {
                    visit(i, j);
                }
            }
        };
        for (s, paving) in sheets.iter().enumerate() {
            paving.touching_by(&kept, &|at| index.of((s, at)), &mut |i, j| {
                let surely = inside[i as usize] && inside[j as usize];
                may_touch(i, j, surely);
                if surely {
                    inner.union(i, j);
                }
            });
        }
        for (a, b) in folds(robot, &sheets[0], &kept) {
            may_touch(index.of((0, a)), index.of((0, b)), false);
        }
        seams::outer(robot, sheets, &kept, &mut |a, b| may_touch(index.of(a), index.of(b), false));
        let mut met = Vec::new();
        seams::inner(robot, sheets, &kept, &mut |a, b, surely| {
            let (i, j) = (index.of(a), index.of(b));
            if inner.root(i) != inner.root(j) && surely() {
                inner.union(i, j);
                met.push(b);
            }
        });
        let mut root = |i: u32| (!covered[i as usize]).then(|| all.root(i));
        let component_of = (0..boxes.len() as u32).map(&mut root).collect();
        let mut components =
            Self { piece_of: vec![None; boxes.len()], component_of, pieces: Vec::new(), seams: met, boxes };
        components.gather(sheets, &inside, &mut inner);
        components
    }

    fn gather(&mut self, sheets: &[Paving], inside: &[bool], inner: &mut UnionFind) {
        let mut piece_at_root = vec![u32::MAX; self.boxes.len()];
        for i in 0..self.boxes.len() {
            let (s, at) = self.boxes[i];
            if !inside[i] {
                continue;
            }
            let Some(component) = self.component_of[i] else { continue };
            let root = inner.root(i as u32) as usize;
            if piece_at_root[root] == u32::MAX {
                piece_at_root[root] = self.pieces.len() as u32;
                self.pieces.push(Piece { measure: 0.0, largest: (s, at), component });
            }
            let piece = &mut self.pieces[piece_at_root[root] as usize];
            if piece.largest.0 == s {
                piece.largest.1 = sheets[s].larger(piece.largest.1, at);
            }
        }
        for i in (0..self.boxes.len()).filter(|&i| inside[i]) {
            let piece = piece_at_root[inner.root(i as u32) as usize];
            self.piece_of[i] = (piece != u32::MAX).then_some(piece);
            let (s, at) = self.boxes[i];
            if let (0, Some(piece)) = (s, self.piece_of[i]) {
                self.pieces[piece as usize].measure += sheets[0].measure(sheets[0].depth_of(at));
            }
        }
    }

    /// Puts in the place of undecided boxes of poses that were split what they became: boxes of the same component, those inside of the
    /// piece that `owner` names for it. What is inside where no box was, as covered, belongs to no component.
    pub(super) fn refine(
        &mut self,
        poses: &Paving,
        classify: &impl Fn(&Node) -> Mark,
        owner: &impl Fn(Option<u32>) -> Option<u32>,
    ) {
        let mut whose: Vec<Option<Whose>> = vec![None; poses.nodes.len()];
        let later = self.boxes.partition_point(|leaf| leaf.0 == 0);
        for i in 0..later {
            let is = Whose { component: self.component_of[i], piece: self.piece_of[i] };
            whose[self.boxes[i].1 as usize] = Some(is);
        }
        // Children come after their parent.
        for at in 0..poses.nodes.len() {
            let undecided = whose[at].filter(|whose| whose.piece.is_none());
            poses.children(at as u32).for_each(|child| {
                whose[child as usize] = whose[child as usize].or(undecided);
            });
        }
        let mut found: Vec<(u32, Whose)> = Vec::with_capacity(later);
        poses.boxes_of(classify, &mut |at| {
            let is_inside = classify(&poses.nodes[at as usize]) == Mark::Inside;
            let mut is = match whose[at as usize] {
                Some(is) => is,
                None if is_inside => Whose::default(),
                None => return,
            };
            if is_inside && is.piece.is_none() {
                is.piece = owner(is.component);
                let piece = is.piece.map(|piece| &mut self.pieces[piece as usize]);
                piece.into_iter().for_each(|piece| piece.measure += poses.measure(poses.depth_of(at)));
            }
            found.push((at, is));
        });
        found.sort_unstable_by_key(|(at, _)| *at);
        self.boxes.splice(..later, found.iter().map(|(at, _)| (0, *at)));
        self.component_of.splice(..later, found.iter().map(|(_, is)| is.component));
        self.piece_of.splice(..later, found.iter().map(|(_, is)| is.piece));
    }

    /// The piece that holds a box.
    pub(super) fn piece_at(&self, leaf: Leaf) -> Option<u32> {
        self.boxes.binary_search(&leaf).ok().and_then(|i| self.piece_of[i])
    }
}

/// The component of G⁺ and the piece that a box belongs to.
#[derive(Clone, Copy, Default)]
struct Whose {
    component: Option<u32>,
    piece: Option<u32>,
}

/// The position of each box in the list of boxes.
struct Index(Vec<Vec<u32>>);

impl Index {
    fn new(sheets: &[Paving], boxes: &[Leaf]) -> Self {
        let mut of: Vec<Vec<u32>> = sheets.iter().map(|p| vec![u32::MAX; p.nodes.len()]).collect();
        for (i, &(s, at)) in boxes.iter().enumerate() {
            of[s][at as usize] = i as u32;
        }
        Self(of)
    }

    fn of(&self, (s, at): Leaf) -> u32 {
        self.0[s][at as usize]
    }
}

/// Pairs of boxes of a set that may touch where the coordinates fold up: at pitch = ±π/2 roll and yaw turn
/// about the same axis, so boxes there may touch whatever their roll and yaw. Where one of the two is held
/// the other tells all poses apart.
fn folds(robot: &Robot, paving: &Paving, classify: &impl Fn(&Node) -> Mark) -> Vec<(u32, u32)> {
    let Some([roll, pitch, yaw]) = robot.platform.turns() else { return Vec::new() };
    let varies = |k: usize| paving.axes.contains(&k);
    if !varies(roll) || !varies(yaw) {
        return Vec::new();
    }
    let half_turn = std::f64::consts::FRAC_PI_2;
    let axis = paving.axes.iter().position(|&k| k == pitch);
    let mut pairs = Vec::new();
    let mut at_pole: [Option<u32>; 2] = [None; 2];
    paving.boxes_of(classify, &mut |at| {
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
