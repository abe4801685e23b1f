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
    pub fn touching(&self, sight: &impl Fn(&Node) -> Mark, visit: &mut impl FnMut(u32, u32)) {
        self.within(0, sight, visit);
        let axes = self.window.axes();
        let glued: Vec<usize> = (0..axes.len()).filter(|&a| self.window.glued[axes[a]]).collect();
        // The window's neighbour across each set of glued axes is the window itself.
        for wrap in offsets(axes.len()).filter(is_first) {
            if (0..3).all(|a| wrap[a] == 0 || glued.contains(&a)) {
                self.between(0, 0, wrap, sight, visit);
            }
        }
    }

    /// Pairs inside one node.
    fn within(&self, at: u32, sight: &impl Fn(&Node) -> Mark, visit: &mut impl FnMut(u32, u32)) {
        let node = &self.nodes[at as usize];
        if node.first_child == 0 || sight(node) != Mark::Open {
            return;
        }
        let first = node.first_child;
        let count = 1 << self.dimension;
        for i in 0..count {
            self.within(first + i, sight, visit);
            for j in i + 1..count {
                let offset = std::array::from_fn(|a| (j >> a & 1) as i8 - (i >> a & 1) as i8);
                self.between(first + i, first + j, offset, sight, visit);
            }
        }
    }

    /// Pairs of a box in `a` and a box in `b`, where b lies at `offset` of a.
    fn between(
        &self,
        a: u32,
        b: u32,
        offset: Offset,
        sight: &impl Fn(&Node) -> Mark,
        visit: &mut impl FnMut(u32, u32),
    ) {
        let (node_a, node_b) = (&self.nodes[a as usize], &self.nodes[b as usize]);
        let (mark_a, mark_b) = (sight(node_a), sight(node_b));
        if mark_a == Mark::Outside || mark_b == Mark::Outside {
            return;
        }
        let end_a = mark_a == Mark::Inside || node_a.first_child == 0;
        let end_b = mark_b == Mark::Inside || node_b.first_child == 0;
        if end_a && end_b {
            return visit(a, b);
        }
        let count = 1u32 << self.dimension;
        let (first_a, first_b) = (node_a.first_child, node_b.first_child);
        if end_a {
            // Only b goes down: keep its children on the side that faces a.
            for j in (0..count).filter(|&j| faces(j, offset, 0)) {
                self.between(a, first_b + j, offset, sight, visit);
            }
        } else if end_b {
            for i in (0..count).filter(|&i| faces(i, offset, 1)) {
                self.between(first_a + i, b, offset, sight, visit);
            }
        } else {
            for i in (0..count).filter(|&i| faces(i, offset, 1)) {
                for j in (0..count).filter(|&j| faces(j, offset, 0)) {
                    self.between(first_a + i, first_b + j, finer(i, j, offset), sight, visit);
                }
            }
        }
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

fn offsets(dimension: usize) -> impl Iterator<Item = Offset> {
    let count = 3usize.pow(dimension as u32);
    (0..count).map(move |n| {
        let mut offset = [n % 3, n / 3 % 3, n / 9 % 3].map(|digit| digit as i8 - 1);
        offset[dimension..].fill(0);
        offset
    })
}

/// Of an offset and its opposite, one: the first non-zero entry is +1.
fn is_first(offset: &Offset) -> bool {
    offset.iter().find(|&&x| x != 0) == Some(&1)
}
