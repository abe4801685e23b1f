//! Theorem 3: unions of adjacent basic regions in which a joint vector means one pose.

use std::collections::BTreeSet;

/// Most sets looked at: beyond it the list is not complete.
const MOST: usize = 100_000;

/// Returns all maximal connected sets of regions no two of which are in conflict, each in ascending order,
/// and whether these are all.
///
/// A region in conflict with itself is in none. A maximal such set is a connected component of some maximal
/// set without conflicts: enlarge it to one; its component that holds the set is connected and without
/// conflicts, hence no greater. So the components of all maximal sets without conflicts are formed (Bron and
/// Kerbosch's search, with Tomita's pivots), and those that lie in another dropped.
pub fn maximal_sets(
    regions: usize,
    adjacent: &BTreeSet<(usize, usize)>,
    conflict: &BTreeSet<(usize, usize)>,
) -> (Vec<Vec<usize>>, bool) {
    let has = |set: &BTreeSet<(usize, usize)>, a: usize, b: usize| set.contains(&(a.min(b), a.max(b)));
    let all: BTreeSet<usize> = (0..regions).filter(|&r| !has(conflict, r, r)).collect();
    let neighbours = |r: usize| -> BTreeSet<usize> {
        all.iter().copied().filter(|&other| other != r && !has(conflict, r, other)).collect()
    };
    let agreeing: Vec<BTreeSet<usize>> = (0..regions).map(neighbours).collect();
    let mut search = Search { agreeing: &agreeing, found: Vec::new(), left: MOST };
    search.extend(&mut Vec::new(), all.clone(), BTreeSet::new());
    let complete = search.left > 0;
    let mut parts = BTreeSet::new();
    for set in search.found {
        parts.extend(components(&set, |a, b| has(adjacent, a, b)));
    }
    let parts: Vec<BTreeSet<usize>> = parts.into_iter().collect();
    let is_within_another =
        |part: &BTreeSet<usize>| parts.iter().any(|other| other.len() > part.len() && part.is_subset(other));
    let maximal = parts.iter().filter(|part| !is_within_another(part));
    (maximal.map(|part| part.iter().copied().collect()).collect(), complete)
}

struct Search<'a> {
    agreeing: &'a [BTreeSet<usize>],
    found: Vec<Vec<usize>>,
    left: usize,
}

impl Search<'_> {
    fn extend(&mut self, set: &mut Vec<usize>, mut may: BTreeSet<usize>, mut seen: BTreeSet<usize>) {
        if self.left == 0 {
            return;
        }
        self.left -= 1;
        let Some(pivot) = may.union(&seen).max_by_key(|&&r| self.agreeing[r].intersection(&may).count())
        else {
            if !set.is_empty() {
                self.found.push(set.clone());
            }
            return;
        };
        let branches: Vec<usize> = may.difference(&self.agreeing[*pivot]).copied().collect();
        for r in branches {
            let agree = &self.agreeing[r];
            set.push(r);
            self.extend(
                set,
                may.intersection(agree).copied().collect(),
                seen.intersection(agree).copied().collect(),
            );
            set.pop();
            may.remove(&r);
            seen.insert(r);
        }
    }
}

/// The connected components of a set.
fn components(set: &[usize], adjacent: impl Fn(usize, usize) -> bool) -> Vec<BTreeSet<usize>> {
    let mut left: BTreeSet<usize> = set.iter().copied().collect();
    let mut parts = Vec::new();
    while let Some(first) = left.pop_first() {
        let (mut part, mut front) = (BTreeSet::from([first]), vec![first]);
        while let Some(a) = front.pop() {
            let near: Vec<usize> = left.iter().copied().filter(|&b| adjacent(a, b)).collect();
            for b in near {
                left.remove(&b);
                part.insert(b);
                front.push(b);
            }
        }
        parts.push(part);
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Figure 15: regions 1-2-3-4 in a row, the images of 1 and 3 coincide, 4 does not touch the others.
    #[test]
    fn figure_15() {
        let (sets, complete) = maximal_sets(4, &BTreeSet::from([(0, 1), (1, 2)]), &BTreeSet::from([(0, 2)]));
        assert_eq!(sets, [vec![0, 1], vec![1, 2], vec![3]]);
        assert!(complete);
    }

    #[test]
    fn a_region_in_conflict_with_itself_is_in_none() {
        let (sets, _) = maximal_sets(2, &BTreeSet::from([(0, 1)]), &BTreeSet::from([(0, 0)]));
        assert_eq!(sets, [vec![1]]);
    }

    fn pairs(regions: usize) -> impl Strategy<Value = BTreeSet<(usize, usize)>> {
        proptest::collection::btree_set((0..regions, 0..regions), 0..12)
            .prop_map(|set| set.into_iter().map(|(a, b)| (a.min(b), a.max(b))).collect())
    }

    proptest! {
        /// Against all subsets of up to seven regions.
        #[test]
        fn as_by_trying_all_subsets(adjacent in pairs(7), conflict in pairs(7)) {
            let sets: Vec<Vec<usize>> = (1usize..1 << 7)
                .map(|bits| (0..7).filter(|r| bits >> r & 1 == 1).collect::<Vec<_>>())
                .filter(|set| set.iter().all(|&a| set.iter().all(|&b| !conflict.contains(&(a.min(b), a.max(b))))))
                .filter(|set| components(set, |a, b| adjacent.contains(&(a.min(b), a.max(b)))).len() == 1)
                .collect();
            let within = |a: &[usize], b: &[usize]| b.len() > a.len() && a.iter().all(|x| b.contains(x));
            let mut maximal: Vec<_> =
                sets.iter().filter(|a| !sets.iter().any(|b| within(a, b))).cloned().collect();
            let (mut found, complete) = maximal_sets(7, &adjacent, &conflict);
            maximal.sort();
            found.sort();
            prop_assert_eq!(found, maximal);
            prop_assert!(complete);
        }
    }
}
