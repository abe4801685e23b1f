//! The two graphs of the sandwich.

use std::collections::BTreeSet;

/// Disjoint sets of numbers.
pub(super) struct Sets(Vec<usize>);

impl Sets {
    pub(super) fn new(count: usize) -> Self {
        Self((0..count).collect())
    }

    pub(super) fn root(&mut self, i: usize) -> usize {
        let mut top = i;
        while self.0[top] != top {
            top = self.0[top];
        }
        let mut at = i;
        while self.0[at] != top {
            at = std::mem::replace(&mut self.0[at], top);
        }
        top
    }

    pub(super) fn union(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a] = b;
    }

    /// How many sets hold one of the members for which `serves` holds: it is asked only until one is found.
    pub(super) fn count(
        &mut self,
        members: impl Iterator<Item = usize>,
        serves: impl Fn(usize) -> bool,
    ) -> usize {
        let mut found = BTreeSet::new();
        for i in members {
            let root = self.root(i);
            if !found.contains(&root) && serves(i) {
                found.insert(root);
            }
        }
        found.len()
    }
}
