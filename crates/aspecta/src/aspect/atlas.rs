//! The charts of a robot, paved.

use super::scale::Scale;
use super::summit::summitless;
use crate::kinematics::WorkingMode;
use crate::kinematics::chart::{Chart, Fold, folds};
use crate::kinematics::for_platform;
use crate::num::{Interval, LANES, Scalar};
use crate::paving::{Budget, ClassSet, Control, Mark, Node, Paving, Progress, for_paving};
use crate::robot::{Robot, Window};
use rayon::prelude::*;

/// A box: sheet and node.
pub(super) type Leaf = (usize, u32);

/// How far an atlas may be refined.
pub(super) struct Limits<'a> {
    /// Greatest depth of a box.
    pub depth: u32,
    /// Greatest number of boxes.
    pub boxes: u64,
    /// Whether the time is up.
    pub late: &'a (dyn Fn() -> bool + Sync),
}

/// What [`Atlas::even_out`] did.
pub(super) struct Even {
    /// Whether anything was split.
    pub changed: bool,
    /// Whether the depth was reached everywhere.
    pub reached: bool,
}

impl Limits<'_> {
    /// How many boxes may still be split.
    pub(super) fn affordable(&self, atlas: &Atlas<'_>) -> usize {
        (self.boxes.saturating_sub(atlas.boxes()) >> atlas.sheets[0].axes.len()) as usize
    }

    pub(super) fn is_over(&self, control: &Control<'_>) -> bool {
        (self.late)() || control.is_cancelled()
    }
}

/// The pavings of all charts. Sheet 0 is in pose coordinates; sheet i + 1 is that of fold i and replaces the boxes of
/// sheet 0 that it covers.
pub(super) struct Atlas<'a> {
    pub robot: &'a Robot,
    pub folds: Vec<Fold>,
    pub sheets: Vec<Paving>,
    pub scale: Scale,
}

impl<'a> Atlas<'a> {
    pub(super) fn new(
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
    pub(super) fn open(&self, (sheet, node): Leaf) -> ClassSet {
        let node = &self.sheets[sheet].nodes[node as usize];
        if node.covered || node.first_child != 0 { 0 } else { node.undecided & !node.summitless }
    }

    /// All leaves in which something is undecided.
    pub(super) fn undecided_leaves(&self) -> Vec<Leaf> {
        let all =
            self.sheets.iter().enumerate().flat_map(|(s, p)| (0..p.nodes.len() as u32).map(move |n| (s, n)));
        all.filter(|&leaf| self.open(leaf) != 0).collect()
    }

    /// Remembers that a box, and all that it was split into, has no summit of some classes.
    pub(super) fn remember(&mut self, (sheet, node): Leaf, classes: ClassSet) {
        let paving = &mut self.sheets[sheet];
        let mut stack = vec![node];
        while let Some(at) = stack.pop() {
            paving.nodes[at as usize].summitless |= classes;
            stack.extend(paving.children(at));
        }
    }

    /// Points, in the coordinates of a fold's sheet, at which a box there that is inside a class meets one of sheet 0 that is.
    pub(super) fn seam_points(&self, class: ClassSet) -> Vec<(usize, Vec<f64>)> {
        let mut points = Vec::new();
        let sight = |node: &Node| node.of_classes(class);
        let inside = |(s, at): Leaf| sight(&self.sheets[s].nodes[at as usize]) == Mark::Inside;
        seams(self.robot, &self.sheets, &sight, &mut |a, b, surely| {
            if surely && inside(a) {
                points.push((b.0, self.sheets[b.0].centre(b.1)));
            }
        });
        points
    }

    /// The children of boxes in which one of some classes is undecided.
    pub(super) fn undecided_children(&self, boxes: &[Leaf], classes: ClassSet) -> Vec<Leaf> {
        let children = |&(s, at): &Leaf| self.sheets[s].children(at).map(move |child| (s, child));
        let undecided = |&(s, at): &Leaf| {
            let node = &self.sheets[s].nodes[at as usize];
            node.undecided & classes != 0 && node.first_child == 0
        };
        boxes.iter().flat_map(children).filter(undecided).collect()
    }

    /// Whether the box belongs to a fold's sheet, or its centre surely lies in no fold's chart: a set of configurations that holds it
    /// has a point that no other boxes than those of its component of G⁺ can cover.
    pub(super) fn is_anchor(&self, (sheet, node): Leaf) -> bool {
        if sheet > 0 || self.folds.is_empty() {
            return true;
        }
        let pose: Vec<Interval> = self.sheets[0].centre(node).into_iter().map(Interval::point).collect();
        for_platform!(self.robot.platform, outside_folds(self.robot, &self.folds, &pose))
    }

    /// Boxes classified so far.
    pub(super) fn boxes(&self) -> u64 {
        self.sheets.iter().map(|paving| paving.boxes).sum()
    }

    pub(super) fn depth_of(&self, (sheet, node): Leaf) -> u32 {
        self.sheets[sheet].depth_of(node)
    }

    /// Splits and searches boxes until no aspect can hide in any or they are as small as they may be; `fresh` are the leaves not
    /// searched yet. False if boxes or time ended it.
    pub(super) fn uncover(
        &mut self,
        mut fresh: Vec<Leaf>,
        limits: &Limits<'_>,
        control: &Control<'_>,
    ) -> bool {
        loop {
            let worth = self.is_worth_searching(&fresh);
            let open = if worth { self.survey(&fresh, limits, control) } else { fresh };
            let (split, deepest): (Vec<Leaf>, Vec<Leaf>) =
                open.into_iter().partition(|&leaf| self.depth_of(leaf) < limits.depth);
            if !worth {
                // What cannot be split is searched all the same.
                self.survey(&deepest, limits, control);
            }
            if split.is_empty() {
                return true;
            }
            if split.len() > limits.affordable(self) || limits.is_over(control) {
                return false;
            }
            fresh = self.split(&split, control);
        }
    }

    /// Splits every undecided box of sheet 0 down to `depth`.
    pub(super) fn even_out(&mut self, depth: u32, limits: &Limits<'_>, control: &Control<'_>) -> Even {
        let coarse = |paving: &Paving, at: u32| {
            let node = &paving.nodes[at as usize];
            node.first_child == 0 && node.undecided != 0 && u32::from(node.depth) < depth
        };
        let mut even = Even { changed: false, reached: true };
        let mut first = 0;
        loop {
            let all = self.sheets[0].nodes.len() as u32;
            let split: Vec<Leaf> =
                (first..all).filter(|&at| coarse(&self.sheets[0], at)).map(|at| (0, at)).collect();
            if split.is_empty() {
                return even;
            }
            if split.len() > limits.affordable(self) || limits.is_over(control) {
                return Even { reached: false, ..even };
            }
            let done = self.boxes();
            (control.progress)(Progress { stage: "paving evenly", done, total: done + split.len() as u64 });
            self.split(&split, control);
            (first, even.changed) = (all, true);
        }
    }

    /// Whether enough leaves have no summit to make a search worth its time, judged by a sample; if not, it is better to
    /// split them all first.
    fn is_worth_searching(&self, leaves: &[Leaf]) -> bool {
        const SAMPLE: usize = 512;
        if leaves.len() < 8 * SAMPLE {
            return true;
        }
        let sheet = leaves[0].0;
        let sample: Vec<(u32, ClassSet)> = leaves
            .iter()
            .filter(|leaf| leaf.0 == sheet)
            .step_by(leaves.len() / SAMPLE)
            .map(|&leaf| (leaf.1, self.open(leaf)))
            .collect();
        let settled =
            sample.iter().zip(self.summitless(sheet, &sample)).filter(|(s, proved)| s.1 & !proved == 0);
        10 * settled.count() > 3 * sample.len()
    }

    /// Looks for summits in leaves, as long as the limits allow, and returns those in which some might be.
    pub(super) fn survey(
        &mut self,
        leaves: &[Leaf],
        limits: &Limits<'_>,
        control: &Control<'_>,
    ) -> Vec<Leaf> {
        const SOME: usize = 1 << 15;
        for (done, some) in leaves.chunks(SOME).enumerate() {
            if limits.is_over(control) {
                break;
            }
            let (done, total) = ((done * SOME) as u64, leaves.len() as u64);
            (control.progress)(Progress { stage: "looking for hidden aspects", done, total });
            for sheet in 0..self.sheets.len() {
                let asked: Vec<(u32, ClassSet)> = some
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
        }
        leaves.iter().copied().filter(|&leaf| self.open(leaf) != 0).collect()
    }

    /// Of the classes asked of each box of a sheet, those that surely have no summit in it.
    pub(super) fn summitless(&self, sheet: usize, asked: &[(u32, ClassSet)]) -> Vec<ClassSet> {
        let paving = &self.sheets[sheet];
        let eight = |boxes: &[(u32, ClassSet)]| {
            let (robot, scale) = (self.robot, &self.scale);
            let proved = for_paving!(robot, paving.axes.len(), summitless(robot, paving, scale, boxes));
            proved[..boxes.len()].to_vec()
        };
        asked.par_chunks(LANES).flat_map_iter(eight).collect()
    }

    /// Splits leaves; returns their children.
    pub(super) fn split(&mut self, leaves: &[Leaf], control: &Control<'_>) -> Vec<Leaf> {
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

/// Whether a pose surely lies in none of the folds' charts.
fn outside_folds<const D: usize, const N: usize>(robot: &Robot, folds: &[Fold], pose: &[Interval]) -> bool {
    let x: [Interval; N] = std::array::from_fn(|k| pose[k]);
    let (_, legs) = Chart::Pose.at::<Interval, D, N>(robot, &x, |k| x[k].sin_cos());
    folds.iter().all(|fold| fold.cover(&legs[fold.leg]).iter().any(|margin| margin.is_negative()))
}

/// Visits the pairs of boxes of sheet 0 and of a fold's sheet that meet: `join(a, b, surely)`.
///
/// The boxes of a fold's sheet and those boxes of sheet 0 that it does not cover, cut to the poses the chart does not hold, cover
/// all configurations. The two kinds meet only in the chart's outer faces, so every box at such a face is joined with all
/// that its image may meet. `surely`: the centre of a box of the fold has a pose that lies in the box of sheet 0.
pub(super) fn seams(
    robot: &Robot,
    sheets: &[Paving],
    sight: &impl Fn(&Node) -> Mark,
    join: &mut impl FnMut(Leaf, Leaf, bool),
) {
    for (s, sheet) in sheets.iter().enumerate().skip(1) {
        let mut boxes = Vec::new();
        sheet.boxes_of(sight, &mut |at| boxes.push(at));
        for at in boxes {
            for face in outer_faces(robot, sheet, at) {
                sheets[0].meeting(sight, &image(robot, sheet, &face), &mut |other| {
                    join((0, other), (s, at), false)
                });
            }
            if sight(&sheet.nodes[at as usize]) == Mark::Inside {
                let centre = sheet.centre(at).into_iter().map(Interval::point).collect::<Vec<_>>();
                let pose = image(robot, sheet, &centre);
                sheets[0].meeting(sight, &pose, &mut |other| {
                    if sheets[0].holds(other, &pose) {
                        join((0, other), (s, at), true);
                    }
                });
            }
        }
    }
}

/// The outer faces of a fold's chart that a box lies at: its coordinates, one of them at its end.
fn outer_faces(robot: &Robot, sheet: &Paving, at: u32) -> Vec<Vec<Interval>> {
    let node = &sheet.nodes[at as usize];
    let last = (1u32 << node.depth) - 1;
    let (lo, hi) = sheet.bounds(at);
    let mut coordinates: Vec<Interval> = sheet.window.ranges.iter().map(|r| Interval::point(r.0)).collect();
    for (a, &k) in sheet.axes.iter().enumerate() {
        coordinates[k] = Interval::new(lo[a], hi[a]);
    }
    let mut faces = Vec::new();
    for (a, &k) in sheet.axes.iter().enumerate().filter(|(_, k)| (1..robot.platform.space()).contains(*k)) {
        for (is_outer, end) in [(node.corner[a] == 0, lo[a]), (node.corner[a] == last, hi[a])] {
            if is_outer {
                let mut face = coordinates.clone();
                face[k] = Interval::point(end);
                faces.push(face);
            }
        }
    }
    faces
}

/// Poses that hold the configurations with the given coordinates.
fn image(robot: &Robot, sheet: &Paving, y: &[Interval]) -> Vec<Interval> {
    for_platform!(robot.platform, image_in(robot, sheet, y))
}

fn image_in<const D: usize, const N: usize>(robot: &Robot, sheet: &Paving, y: &[Interval]) -> Vec<Interval> {
    sheet.chart.pose::<D, N>(robot, &std::array::from_fn(|k| y[k])).to_vec()
}
