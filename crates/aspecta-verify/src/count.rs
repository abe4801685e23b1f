//! The bounds that leaves and links prove.

use super::graph::Sets;
use super::links::Link;
use super::place::Place;
use super::{Checked, Fault, Sheet, Verdict, charts, right_angles};
use crate::certificate::{Certificate, Claim, Leaf};
use aspecta_robot::ClassSet;
use aspecta_robot::chart::Chart;
use aspecta_robot::num::{self, Interval};
use aspecta_robot::work;
use aspecta_robot::work::{Control, Progress};
use std::f64::consts::FRAC_PI_2;

/// All leaves, numbered through the sheets, and which pairs touch.
struct Leaves<'a> {
    sheets: &'a [Sheet<'a>],
    /// The sheet whose leaves, and those that replace some of them, hold all configurations.
    base: usize,
    /// The number of the first leaf of each sheet.
    first: Vec<usize>,
    all: Vec<Leaf>,
    /// Pairs of one sheet whose boxes share a point.
    touching: Vec<(u32, u32)>,
    /// Pairs of a leaf of a later sheet and one of the base that may share a configuration.
    across: Vec<(u32, u32)>,
    /// Leaves at pitch −π/2 and at π/2, where roll and yaw are one.
    poles: [Vec<usize>; 2],
}

pub(super) fn check<const D: usize>(
    certificate: &Certificate,
    sheets: &[Sheet<'_>],
    charts: &[&Chart],
    links: &[Link],
    control: &Control<'_>,
    verdict: &mut Verdict,
) {
    (control.progress)(Progress { stage: "adjacency", done: 0, total: 1 });
    let leaves = Leaves::new::<D>(certificate, sheets, charts);
    let classes = 2 * certificate.modes.len();
    let is_known = right_angles::modes_are_aspects(&certificate.robot, &certificate.window);
    let count = |class: usize| {
        (control.progress)(Progress { stage: "counting", done: class as u64, total: classes as u64 });
        let low = leaves.low::<D>(class, charts);
        let high = leaves.high(class, links);
        let high = if is_known { Some(high.map_or(1, |high| high.min(1))) } else { high };
        Claim { low, high }
    };
    let counted: Vec<Claim> = work::map_range(classes, count);
    for (class, (&proved, &claimed)) in counted.iter().zip(&certificate.claims).enumerate() {
        let (mode, det_a) = (certificate.modes[class / 2], if class % 2 == 0 { 1 } else { -1 });
        verdict.classes.push(Checked { mode, det_a, claimed, proved });
        verdict.faults.extend(faults(class, claimed, proved));
    }
}

/// Returns the claims about the number of aspects that go beyond what is proved; one is wrong if the other
/// proved bound contradicts it.
fn faults(class: usize, claimed: Claim, proved: Claim) -> Vec<Fault> {
    let aspects = |n: usize| num::count(n, "aspect", "aspects");
    let mut faults = Vec::new();
    if let Some(high) = proved.high.filter(|high| *high < proved.low) {
        let low = proved.low;
        let reason = format!(
            "both at least {low} and at most {high} aspects are proved: robot or checker are not sound"
        );
        return vec![Fault::of_class(class, reason)];
    }
    if claimed.low > proved.low {
        let reason = format!(
            "claimed to have at least {}, but proved to have at least {}",
            aspects(claimed.low),
            proved.low
        );
        let is_wrong = proved.high.is_some_and(|high| claimed.low > high);
        faults.push(Fault { is_wrong, ..Fault::of_class(class, reason) });
    }
    let reason = match (claimed.high, proved.high) {
        (Some(high), None) => {
            format!(
                "claimed to have at most {}, but leaves are undecided, not covered and not summitless",
                aspects(high)
            )
        }
        (Some(high), Some(found)) if high < found => {
            format!("claimed to have at most {}, but proved to have at most {found}", aspects(high))
        }
        _ => return faults,
    };
    let is_wrong = claimed.high.is_some_and(|high| high < proved.low);
    faults.push(Fault { is_wrong, ..Fault::of_class(class, reason) });
    faults
}

impl<'a> Leaves<'a> {
    fn new<const D: usize>(certificate: &Certificate, sheets: &'a [Sheet<'a>], charts: &[&Chart]) -> Self {
        let base = charts::base_of(charts);
        let mut first = Vec::new();
        let mut all: Vec<Leaf> = Vec::new();
        for sheet in sheets {
            first.push(all.len());
            all.extend(sheet.cells.leaves.iter().map(|cell| cell.claims));
        }
        let mut leaves =
            Self { sheets, base, first, all, touching: vec![], across: vec![], poles: Default::default() };
        leaves.touching = leaves.pairs(|s, leaf| leaves.neighbours(s, leaf));
        let later = charts.iter().skip(base);
        let partly: Vec<Vec<bool>> =
            later.map(|chart| charts::partly_in::<D>(&sheets[base], chart)).collect();
        leaves.across = leaves.pairs(|s, leaf| {
            let Some(partly) = s.checked_sub(base + 1).map(|k| &partly[k]) else { return Vec::new() };
            let met = charts::met_outside::<D>(&sheets[s], leaf, &sheets[base], partly);
            met.into_iter().map(|other| leaves.first[base] + other).collect()
        });
        let varies = |k: usize| certificate.window.ranges[k].0 < certificate.window.ranges[k].1;
        if let Some([roll, pitch, yaw]) = certificate.robot.platform.turns()
            && varies(roll)
            && varies(yaw)
        {
            for leaf in 0..sheets[0].cells.leaves.len() {
                let pitch = sheets[0].cells.of(leaf)[pitch];
                for (pole, there) in [pitch.lo <= -FRAC_PI_2, pitch.hi >= FRAC_PI_2].into_iter().enumerate() {
                    leaves.poles[pole].extend(there.then_some(leaf));
                }
            }
        }
        leaves
    }

    /// Pairs of a leaf and what `others` gives for it, of leaves that are not outside all classes.
    fn pairs(&self, others: impl Fn(usize, usize) -> Vec<usize> + Sync) -> Vec<(u32, u32)> {
        let of_sheet = |s: usize| {
            let (first, cells) = (self.first[s], &self.sheets[s].cells.leaves);
            let matters = |leaf: usize| cells[leaf].claims.inside | cells[leaf].claims.undecided != 0;
            work::flat_map_range(cells.len(), |leaf| {
                let others = if matters(leaf) { others(s, leaf) } else { Vec::new() };
                others.into_iter().map(move |other| ((first + leaf) as u32, other as u32))
            })
        };
        (0..self.sheets.len()).flat_map(of_sheet).collect()
    }

    /// The leaves after this one in its sheet that touch it and have a class in common with it, numbered
    /// through the sheets.
    fn neighbours(&self, s: usize, leaf: usize) -> Vec<usize> {
        let cells = &self.sheets[s].cells;
        let classes = |leaf: usize| cells.leaves[leaf].claims.inside | cells.leaves[leaf].claims.undecided;
        let mut found = Vec::new();
        cells.touching(leaf, &mut |other| {
            if other > leaf && classes(leaf) & classes(other) != 0 {
                found.push(self.first[s] + other);
            }
        });
        found
    }

    /// Components of G⁺ that certainly hold an aspect.
    fn low<const D: usize>(&self, class: usize, charts: &[&Chart]) -> usize {
        let bit: ClassSet = 1 << class;
        let is_member = |i: usize| {
            let leaf = &self.all[i];
            (leaf.inside | leaf.undecided) & bit != 0 && !leaf.covered
        };
        let mut sets = Sets::new(self.all.len());
        for &(a, b) in self.touching.iter().chain(&self.across) {
            if is_member(a as usize) && is_member(b as usize) {
                sets.union(a as usize, b as usize);
            }
        }
        for pole in &self.poles {
            let members: Vec<usize> = pole.iter().copied().filter(|&i| is_member(i)).collect();
            members.windows(2).for_each(|pair| sets.union(pair[0], pair[1]));
        }
        let inside = (0..self.all.len()).filter(|&i| self.all[i].inside & bit != 0 && is_member(i));
        sets.count(inside, |i| self.is_clear::<D>(i, charts))
    }

    /// Whether the middle of a leaf is in no chart of a later sheet, as those of sheets after the base are,
    /// which are disjoint.
    fn is_clear<const D: usize>(&self, leaf: usize, charts: &[&Chart]) -> bool {
        let sheet = self.first.partition_point(|&first| first <= leaf) - 1;
        let later = &charts[sheet..];
        sheet > self.base || later.is_empty() || {
            let Sheet { setting, cells } = &self.sheets[sheet];
            let middle = cells.of(leaf - self.first[sheet]).map(|x| Interval::point(x.mid()));
            let place = Place::<D>::new(setting, middle);
            later.iter().all(|chart| place.is_clear_of(chart))
        }
    }

    /// Pieces of inside leaves in which an aspect may be highest, if all aspects are highest in an inside
    /// leaf.
    fn high(&self, class: usize, links: &[Link]) -> Option<usize> {
        let bit: ClassSet = 1 << class;
        let hides =
            |leaf: &Leaf| leaf.undecided & !leaf.summitless & !leaf.inside & bit != 0 && !leaf.covered;
        if self.all.iter().any(hides) {
            return None;
        }
        let is_inside = |i: usize| self.all[i].inside & bit != 0;
        let mut sets = Sets::new(self.all.len());
        for &(a, b) in &self.touching {
            if is_inside(a as usize) && is_inside(b as usize) {
                sets.union(a as usize, b as usize);
            }
        }
        for link in links.iter().filter(|link| link.class == class) {
            let numbers: Vec<usize> = link.leaves.iter().map(|&(s, leaf)| self.first[s] + leaf).collect();
            numbers.windows(2).for_each(|pair| sets.union(pair[0], pair[1]));
        }
        let counts = |i: &usize| {
            let leaf = &self.all[*i];
            is_inside(*i) && leaf.summitless & bit == 0 && !leaf.covered
        };
        Some(sets.count((0..self.all.len()).filter(counts), |_| true))
    }
}
