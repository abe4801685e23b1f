//! Which boxes touch: adjacency of the closed boxes of one set, across periodic coordinates too.
//!
//! The tree is descended in pairs. A pair of nodes is known with its relative position per axis: −1 or
//! +1 where they meet in a face of that axis, 0 where one covers the other's extent. The children that
//! still touch are found by bits alone; every touching pair of boxes is met exactly once per way of
//! touching, in time linear in their number.

use super::tree::{Mark, Node, Paving};

/// Relative position of a second box with respect to a first, per axis.
type Offset = [i8; 3];

impl Paving {
    /// Visits every pair of boxes of a set (boxes as in [`Paving::boxes_of`]) that share a point.
    pub fn touching(&self, classify: &impl Fn(&Node) -> Mark, visit: &mut impl FnMut(u32, u32)) {
        self.touching_by(classify, &|node| node, visit);
    }

    /// [`Paving::touching`], with a number below 2³¹ for each box.
    pub fn touching_by(
        &self,
        classify: &impl Fn(&Node) -> Mark,
        number_of: &impl Fn(u32) -> u32,
        visit: &mut impl FnMut(u32, u32),
    ) {
        let outline = Outline::new(self, classify, number_of);
        let walk =
            Walk { words: &outline.0, children: 1 << self.axes.len(), steps: Steps::new(self.axes.len()) };
        walk.within(0, visit);
        let glued: Vec<bool> = self.axes.iter().map(|&k| self.window.glued[k]).collect();
        // The window's neighbour across each set of glued axes is the window itself.
        for wrap in offsets(self.axes.len()).filter(is_first) {
            if (0..self.axes.len()).all(|a| wrap[a] == 0 || glued[a]) {
                walk.between(0, 0, number(wrap), visit);
            }
        }
    }
}

/// The tree of a set alone, a word a node, so that walks stay in the cache: 0 where nothing of the set is, 2i + 1 for the box with number i, and 2k
/// for a node whose children begin at k.
struct Outline(Vec<u32>);

impl Outline {
    fn new(paving: &Paving, classify: &impl Fn(&Node) -> Mark, number_of: &impl Fn(u32) -> u32) -> Self {
        let mut outline = Self(vec![0]);
        outline.fill(paving, classify, number_of, (0, 0));
        outline
    }

    /// Fills in a node, whose word has a place.
    fn fill(
        &mut self,
        paving: &Paving,
        classify: &impl Fn(&Node) -> Mark,
        number_of: &impl Fn(u32) -> u32,
        (at, place): (u32, usize),
    ) {
        let node = &paving.nodes[at as usize];
        match classify(node) {
            Mark::Outside => {}
            Mark::Open if node.first_child != 0 => {
                let first = self.0.len();
                self.0[place] = 2 * first as u32;
                self.0.resize(first + (1 << paving.axes.len()), 0);
                for (child, place) in paving.children(at).zip(first..) {
                    self.fill(paving, classify, number_of, (child, place));
                }
            }
            Mark::Open | Mark::Inside => self.0[place] = 2 * number_of(at) + 1,
        }
    }
}

struct Walk<'a> {
    words: &'a [u32],
    children: u32,
    steps: Steps,
}

impl Walk<'_> {
    /// Pairs inside one node.
    fn within(&self, at: u32, visit: &mut impl FnMut(u32, u32)) {
        let word = self.words[at as usize];
        if word == 0 || word % 2 == 1 {
            return;
        }
        let first = word / 2;
        for child in 0..self.children {
            self.within(first + child, visit);
        }
        for &(i, j, offset) in &self.steps.siblings {
            self.between(first + i, first + j, offset, visit);
        }
    }

    /// Pairs of a box in `a` and a box in `b`, where b lies at `offset` of a.
    fn between(&self, a: u32, b: u32, offset: usize, visit: &mut impl FnMut(u32, u32)) {
        let (word_a, word_b) = (self.words[a as usize], self.words[b as usize]);
        if word_a == 0 || word_b == 0 {
            return;
        }
        let (first_a, first_b) = (word_a / 2, word_b / 2);
        match (word_a % 2 == 1, word_b % 2 == 1) {
            (true, true) => visit(first_a, first_b),
            // Only one goes down: its children on the side that faces the other.
            (true, false) => {
                self.steps.behind[offset].iter().for_each(|j| self.between(a, first_b + j, offset, visit));
            }
            (false, true) => {
                self.steps.ahead[offset].iter().for_each(|i| self.between(first_a + i, b, offset, visit));
            }
            (false, false) => {
                for &(i, j, finer) in &self.steps.both[offset] {
                    self.between(first_a + i, first_b + j, finer, visit);
                }
            }
        }
    }
}

/// Which children of a pair of nodes still touch, for every offset (by [`number`]).
struct Steps {
    /// Pairs of children of one node: (i, j, offset of j with respect to i).
    siblings: Vec<(u32, u32, usize)>,
    /// Children of the first node that face the second.
    ahead: Vec<Vec<u32>>,
    /// Children of the second node that face the first.
    behind: Vec<Vec<u32>>,
    /// Pairs of a child of the first and a child of the second that touch, with their offset.
    both: Vec<Vec<(u32, u32, usize)>>,
}

impl Steps {
    fn new(dimension: usize) -> Self {
        let children = 0..1u32 << dimension;
        let facing = |offset: Offset, front: u32| -> Vec<u32> {
            children.clone().filter(|&child| faces(child, offset, front)).collect()
        };
        let mut steps =
            Self { siblings: Vec::new(), ahead: Vec::new(), behind: Vec::new(), both: Vec::new() };
        for i in children.clone() {
            steps.siblings.extend((i + 1..children.end).map(|j| (i, j, number(finer(i, j, [0; 3])))));
        }
        for n in 0..27 {
            let offset = offset(n);
            let (ahead, behind) = (facing(offset, 1), facing(offset, 0));
            let pairs =
                ahead.iter().flat_map(|&i| behind.iter().map(move |&j| (i, j, number(finer(i, j, offset)))));
            steps.both.push(pairs.collect());
            steps.ahead.push(ahead);
            steps.behind.push(behind);
        }
        steps
    }
}

/// Whether a child lies on the side of its parent that looks along `offset` (`front` = 1) or against it (0).
fn faces(child: u32, offset: Offset, front: u32) -> bool {
    (0..3).all(|a| match offset[a] {
        0 => true,
        1 => child >> a & 1 == front,
        _ => child >> a & 1 == 1 - front,
    })
}

/// The offset of child j of the second box with respect to child i of the first.
fn finer(i: u32, j: u32, offset: Offset) -> Offset {
    std::array::from_fn(|a| match offset[a] {
        0 => (j >> a & 1) as i8 - (i >> a & 1) as i8,
        same => same,
    })
}

/// Offsets numbered 0 to 26 …
fn number(offset: Offset) -> usize {
    offset.iter().rev().fold(0, |n, &x| 3 * n + (x + 1) as usize)
}

/// … and back.
fn offset(n: usize) -> Offset {
    [n % 3, n / 3 % 3, n / 9].map(|digit| digit as i8 - 1)
}

/// Returns all offsets that are zero beyond the dimension.
fn offsets(dimension: usize) -> impl Iterator<Item = Offset> {
    (0..27).map(offset).filter(move |o| o[dimension..].iter().all(|&x| x == 0))
}

/// Returns one of an offset and its opposite: that whose first non-zero entry is +1.
fn is_first(offset: &Offset) -> bool {
    offset.iter().find(|&&x| x != 0) == Some(&1)
}
