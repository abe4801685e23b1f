//! The charts of a robot, paved.

use super::scale::Scale;
use super::summit::summitless;
use crate::kinematics::WorkingMode;
use crate::kinematics::chart::{Chart, Fold, folds};
use crate::num::LANES;
use crate::paving::{Budget, ClassSet, Control, Paving, for_paving};
use crate::robot::{Robot, Window};
use rayon::prelude::*;

/// A leaf: sheet and node.
pub(crate) type Leaf = (usize, u32);

/// The pavings of all charts. Sheet 0 is in pose coordinates; sheet i + 1 is that of fold i and replaces the boxes of
/// sheet 0 that it covers.
pub(crate) struct Atlas<'a> {
    pub robot: &'a Robot,
    pub folds: Vec<Fold>,
    pub sheets: Vec<Paving>,
    pub scale: Scale,
}

impl<'a> Atlas<'a> {
    pub(crate) fn new(
        robot: &'a Robot,
        window: &Window,
        modes: &[WorkingMode],
        budget: &Budget,
        control: &Control<'_>,
    ) -> Self {
        let folds = folds(robot, window);
        let mut sheets = vec![Paving::new(robot, window, modes, budget, control)];
        let charts = folds.iter().map(|fold| Chart::Fold(fold.clone()));
        sheets.extend(charts.map(|chart| {
            let window = chart.window(window);
            Paving::blank(chart, window, modes)
        }));
        Self { scale: Scale::of(robot, window, modes), robot, folds, sheets }
    }

    /// Classes of which nothing is settled in a box: it is neither inside nor outside, and might hide a whole aspect.
    pub(crate) fn open(&self, (sheet, node): Leaf) -> ClassSet {
        let node = &self.sheets[sheet].nodes[node as usize];
        if node.covered || node.first_child != 0 { 0 } else { node.undecided & !node.summitless }
    }

    /// All leaves in which something might hide.
    pub(crate) fn open_leaves(&self) -> Vec<Leaf> {
        let all =
            self.sheets.iter().enumerate().flat_map(|(s, p)| (0..p.nodes.len() as u32).map(move |n| (s, n)));
        all.filter(|&leaf| self.open(leaf) != 0).collect()
    }

    /// Looks for summits in leaves, and returns those in which some might be.
    pub(crate) fn survey(&mut self, leaves: &[Leaf]) -> Vec<Leaf> {
        for sheet in 0..self.sheets.len() {
            let asked: Vec<(u32, ClassSet)> = leaves
                .iter()
                .filter(|leaf| leaf.0 == sheet)
                .map(|&leaf| (leaf.1, self.open(leaf)))
                .filter(|asked| asked.1 != 0)
                .collect();
            let proved = self.summitless(sheet, &asked);
            for (&(node, _), proved) in asked.iter().zip(proved) {
                self.sheets[sheet].nodes[node as usize].summitless |= proved;
            }
        }
        leaves.iter().copied().filter(|&leaf| self.open(leaf) != 0).collect()
    }

    /// Of the classes asked of each box of a sheet, those that surely have no summit in it.
    pub(crate) fn summitless(&self, sheet: usize, asked: &[(u32, ClassSet)]) -> Vec<ClassSet> {
        let paving = &self.sheets[sheet];
        let eight = |boxes: &[(u32, ClassSet)]| {
            let (robot, scale) = (self.robot, &self.scale);
            let proved = for_paving!(robot, paving.axes.len(), summitless(robot, paving, scale, boxes));
            proved[..boxes.len()].to_vec()
        };
        asked.par_chunks(LANES).flat_map_iter(eight).collect()
    }

    /// Splits leaves; returns their children.
    pub(crate) fn split(&mut self, leaves: &[Leaf], control: &Control<'_>) -> Vec<Leaf> {
        let mut children = Vec::new();
        for (s, sheet) in self.sheets.iter_mut().enumerate() {
            let here: Vec<u32> = leaves.iter().filter(|l| l.0 == s).map(|l| l.1).collect();
            let first = sheet.nodes.len() as u32;
            let folds = if s == 0 { self.folds.as_slice() } else { &[] };
            sheet.split(self.robot, folds, &here, &|| control.is_cancelled());
            children.extend((first..sheet.nodes.len() as u32).map(|n| (s, n)));
        }
        children
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::catalogue;

    use std::sync::atomic::AtomicBool;
    use std::time::Instant;

    #[test]
    fn experiment() {
        let name = std::env::var("R").unwrap_or("five-bar".into());
        let depth: u32 = std::env::var("DEPTH").map_or(6, |d| d.parse().unwrap());
        let most: u32 = std::env::var("MOSTD").map_or(12, |d| d.parse().unwrap());
        let robot = catalogue::find(&name).unwrap();
        let robot = &robot;
        let window = robot.workspace_window().unwrap();
        let no = AtomicBool::new(false);
        let control = Control { cancelled: &no, progress: &|_| {} };
        let t = Instant::now();
        let budget = Budget { depth: Some(depth), ..Budget::default() };
        let mut atlas = Atlas::new(robot, &window, &robot.working_modes(), &budget, &control);
        println!("folds {:?}", atlas.folds);
        println!("scale {:?}", atlas.scale);
        println!("base {:?} boxes {}", t.elapsed(), atlas.sheets[0].boxes);
        let mut leaves = atlas.open_leaves();
        for round in 0.. {
            let t = Instant::now();
            let n = leaves.len();
            let open = atlas.survey(&leaves);
            let s = t.elapsed();
            let deepest = open.iter().map(|&(s, n)| atlas.sheets[s].depth_of(n)).max();
            let per: Vec<usize> =
                (0..atlas.sheets.len()).map(|s| open.iter().filter(|l| l.0 == s).count()).collect();
            println!("round {round}: {n} tested in {s:?}, open {} {per:?}, depth {deepest:?}", open.len());
            let todo: Vec<Leaf> =
                open.iter().copied().filter(|&(s, n)| atlas.sheets[s].depth_of(n) < most).collect();
            if todo.is_empty() {
                for &(s, n) in open.iter().step_by(1 + open.len() / 20) {
                    let b = atlas.sheets[s].bounds(n);
                    println!("  sheet {s} {:?} classes {:016b}", b, atlas.open((s, n)));
                }
                break;
            }
            leaves = atlas.split(&todo, &control);
        }
        println!("total {:?} boxes {}", t.elapsed(), atlas.sheets.iter().map(|p| p.boxes).sum::<u64>());
    }
}
