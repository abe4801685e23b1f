//! The charts of a robot, paved.

use super::scale;
use super::seams::{base_of, middle};
use super::summit::summitless;
use crate::paving::{Budget, ClassSet, Control, Node, Paving, Progress, for_paving};
use aspecta_kinematics::AgileEye;
use aspecta_kinematics::chart::Coordinates;
use aspecta_kinematics::chart::{Chart, charts};
use aspecta_kinematics::constraints::Scale;
use aspecta_kinematics::for_platform;
use aspecta_robot::WorkingMode;
use aspecta_robot::num::{Interval, Scalar};
use aspecta_robot::work::Stopwatch;
use aspecta_robot::{Robot, Window};
use std::sync::atomic::{AtomicBool, Ordering};

/// A box: sheet and node.
pub(super) type Leaf = (usize, u32);

/// How far an atlas may be refined.
pub(super) struct Limits<'a> {
    /// Greatest depth of a box.
    pub depth: u32,
    /// Greatest number of boxes.
    pub boxes: u64,
    /// When it began, and how many seconds it may take with all that follows.
    pub time: Option<(Stopwatch, f64)>,
    /// How long, in seconds, each box takes in what follows: the last count and the report.
    pub rest: f64,
    /// Whether all boxes are to be found in which an aspect could hide, though one is enough to keep the bounds of its class apart.
    pub names_doubts: bool,
    /// Whether the time has kept anything from being done.
    pub late: AtomicBool,
    pub control: &'a Control<'a>,
}

/// What a sample of leaves says of all.
#[derive(Clone, Copy)]
struct Sampled {
    are_worth_it: bool,
    /// Classes that stay open in some that are as small as they may be: nothing will close them.
    lost: ClassSet,
}

/// The result of [`Atlas::even_out`].
pub(super) struct Even {
    /// Whether anything was split.
    pub changed: bool,
    /// Whether the depth was reached everywhere.
    pub reached: bool,
}

impl Limits<'_> {
    /// Returns how many boxes may still be split.
    pub(super) fn affordable(&self, atlas: &Atlas<'_>) -> usize {
        (self.boxes.saturating_sub(atlas.boxes()) >> atlas.sheets[0].axes.len()) as usize
    }

    /// Whether so many boxes are to be left as they are, because what follows takes the time that is left.
    pub(super) fn is_over(&self, boxes: u64) -> bool {
        self.has_less_than(self.rest * boxes as f64)
    }

    /// Whether nothing is to be begun any more that can be left out.
    pub(super) fn is_spent(&self) -> bool {
        self.has_less_than(self.time.map_or(0.0, |(_, seconds)| 0.15 * seconds))
    }

    fn has_less_than(&self, needed: f64) -> bool {
        let late = |(start, seconds): (Stopwatch, f64)| start.seconds() + needed > seconds;
        let late = self.time.is_some_and(late);
        self.late.fetch_or(late, Ordering::Relaxed);
        late || self.control.is_cancelled()
    }
}

/// The pavings of all charts. Sheet 0 is in pose coordinates; sheet i + 1 is that of chart i and replaces the
/// boxes of sheet 0 that it covers. If the first chart holds all configurations it replaces them all, and the
/// others replace what they cover of it: it is the base.
pub(super) struct Atlas<'a> {
    pub robot: &'a Robot,
    /// The charts of the sheets from 1 on.
    pub charts: Vec<Chart>,
    pub sheets: Vec<Paving>,
    pub scale: Scale,
    /// Whether every mode is known to be one aspect ([`AgileEye::has_an_aspect_a_mode`]): then nothing is to be searched for.
    pub is_known: bool,
}

impl<'a> Atlas<'a> {
    /// Sheet 0 paved evenly, the others not at all: coarsely, to be refined where the search needs it, or, if
    /// a chart replaces all its boxes, as finely as measures, pictures and plans want it, for up to half of
    /// the boxes.
    pub(super) fn new(
        robot: &'a Robot,
        window: &Window,
        modes: &[WorkingMode],
        budget: &Budget,
        control: &Control<'_>,
    ) -> Self {
        let charts = charts(robot, window);
        let replaced = charts.iter().any(Chart::is_whole);
        let half = Budget { boxes: budget.boxes.map(|boxes| boxes / 2), ..*budget };
        let first = if replaced { half } else { budget.start(window) };
        let mut poses = Paving::new(robot, window, modes, &first, control);
        poses.nodes.iter_mut().for_each(|node| node.covered = replaced);
        let blank =
            charts.iter().map(|chart| Paving::blank(robot, chart.clone(), chart.window(window), modes));
        let sheets = std::iter::once(poses).chain(blank).collect();
        let is_known = AgileEye::has_an_aspect_a_mode(robot, window);
        Self { scale: scale::typical(robot, window, modes), robot, charts, sheets, is_known }
    }

    /// Classes of which nothing is settled in a box: it is neither inside nor outside, and might hide a whole
    /// aspect.
    pub(super) fn open(&self, (sheet, node): Leaf) -> ClassSet {
        let node = &self.sheets[sheet].nodes[node as usize];
        if node.covered || node.first_child != 0 { 0 } else { node.undecided & !node.summitless }
    }

    /// Returns all leaves in which something is undecided.
    pub(super) fn undecided_leaves(&self) -> Vec<Leaf> {
        let all =
            self.sheets.iter().enumerate().flat_map(|(s, p)| (0..p.nodes.len() as u32).map(move |n| (s, n)));
        all.filter(|&leaf| self.open(leaf) != 0).collect()
    }

    /// Remembers that a box, and all that it was split into, has no summit of some classes.
    pub(super) fn remember(&mut self, leaf: Leaf, classes: ClassSet) {
        self.note(leaf, |node| node.summitless |= classes);
    }

    /// Remembers that charts hold a box of the base, and all that it was split into.
    pub(super) fn cover(&mut self, leaf: Leaf) {
        self.note(leaf, |node| node.covered = true);
    }

    fn note(&mut self, (sheet, node): Leaf, fact: impl Fn(&mut Node)) {
        let paving = &mut self.sheets[sheet];
        let mut stack = vec![node];
        while let Some(at) = stack.pop() {
            fact(&mut paving.nodes[at as usize]);
            stack.extend(paving.children(at));
        }
    }

    /// The sheet that holds all configurations, and the charts that replace parts of it.
    fn base(&self) -> (usize, &[Chart]) {
        let base = base_of(&self.sheets);
        (base, &self.charts[base..])
    }

    /// Whether one of the charts surely holds a box of the base on which all legs close; it is cut up where
    /// that helps.
    pub(super) fn is_within_a_chart(&self, (sheet, node): Leaf) -> bool {
        let (base, charts) = self.base();
        let paving = &self.sheets[base];
        sheet == base && for_platform!(self.robot.platform, within_a_chart(self.robot, charts, paving, node))
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

    /// Whether the box belongs to a later sheet than the base, or its centre surely lies in no other chart: a
    /// set of configurations that holds it has a point that no other boxes than those of its component of G⁺
    /// can cover.
    pub(super) fn is_anchor(&self, (sheet, node): Leaf) -> bool {
        let (base, charts) = self.base();
        if sheet > base || charts.is_empty() {
            return true;
        }
        let paving = &self.sheets[base];
        for_platform!(
            self.robot.platform,
            outside_charts(self.robot, charts, &paving.chart, &middle(paving, node))
        )
    }

    /// Boxes classified so far.
    pub(super) fn boxes(&self) -> u64 {
        self.sheets.iter().map(|paving| paving.boxes).sum()
    }

    pub(super) fn depth_of(&self, (sheet, node): Leaf) -> u32 {
        self.sheets[sheet].depth_of(node)
    }

    /// Splits and searches boxes until no aspect can hide in any or they are as small as they may be; `fresh`
    /// are the leaves not searched yet. False if boxes or time ended it.
    pub(super) fn uncover(&mut self, mut fresh: Vec<Leaf>, limits: &Limits<'_>) -> bool {
        loop {
            let sampled = self.sampled(&fresh, limits.depth);
            let worth = sampled.is_none_or(|sampled| sampled.are_worth_it);
            let open = if worth { self.survey(&fresh, !0, limits) } else { fresh };
            let (split, deepest): (Vec<Leaf>, Vec<Leaf>) =
                open.into_iter().partition(|&leaf| self.depth_of(leaf) < limits.depth);
            if !worth {
                // What cannot be split is searched all the same, for the classes that may be closed or are asked about.
                let lost = sampled.filter(|_| !limits.names_doubts).map_or(0, |sampled| sampled.lost);
                self.survey(&deepest, !lost, limits);
            }
            if split.is_empty() {
                return true;
            }
            if split.len() > limits.affordable(self) {
                return false;
            }
            let Some(children) = self.split(&split, limits) else { return false };
            fresh = children;
        }
    }

    /// Splits every undecided box of sheet 0 down to `depth`.
    pub(super) fn even_out(&mut self, depth: u32, limits: &Limits<'_>) -> Even {
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
            if split.len() > limits.affordable(self) {
                return Even { reached: false, ..even };
            }
            (first, even.changed) = (all, true);
            let total = self.boxes() + split.len() as u64;
            for some in split.chunks(SOME) {
                (limits.control.progress)(Progress { stage: "paving evenly", done: self.boxes(), total });
                if limits.is_over(self.boxes()) || self.split(some, limits).is_none() {
                    return Even { reached: false, ..even };
                }
            }
        }
    }

    /// A sample of leaves, if they are many: whether enough have no summit to make a search worth its time (if not, it is better to split
    /// them all first), and the classes that stay open in some as small as they may be.
    fn sampled(&self, leaves: &[Leaf], deepest: u32) -> Option<Sampled> {
        const SAMPLE: usize = 512;
        if leaves.len() < 8 * SAMPLE {
            return None;
        }
        let sheet = leaves[0].0;
        let sample: Vec<(u32, ClassSet)> = leaves
            .iter()
            .filter(|leaf| leaf.0 == sheet)
            .step_by(leaves.len() / SAMPLE)
            .map(|&leaf| (leaf.1, self.open(leaf)))
            .collect();
        let proved = self.summitless(sheet, &sample);
        let open = || sample.iter().zip(&proved).map(|(asked, proved)| (asked.0, asked.1 & !proved));
        let settled = open().filter(|open| open.1 == 0).count();
        let is_last = |node: u32| self.depth_of((sheet, node)) >= deepest;
        Some(Sampled {
            are_worth_it: 10 * settled > 3 * sample.len(),
            lost: open().filter(|open| is_last(open.0)).fold(0, |lost, open| lost | open.1),
        })
    }

    /// Looks for summits of some classes in leaves, as long as the limits allow, and returns the leaves in which there might be one of any.
    fn survey(&mut self, leaves: &[Leaf], classes: ClassSet, limits: &Limits<'_>) -> Vec<Leaf> {
        for (done, some) in leaves.chunks(SOME).enumerate() {
            if limits.is_over(self.boxes()) {
                break;
            }
            let (done, total) = ((done * SOME) as u64, leaves.len() as u64);
            (limits.control.progress)(Progress { stage: "looking for hidden aspects", done, total });
            for sheet in 0..self.sheets.len() {
                let asked: Vec<(u32, ClassSet)> = some
                    .iter()
                    .filter(|leaf| leaf.0 == sheet)
                    .map(|&leaf| (leaf.1, self.open(leaf) & classes))
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

    /// Returns, of the classes asked of each box of a sheet, those proved to have no summit in it.
    pub(super) fn summitless(&self, sheet: usize, asked: &[(u32, ClassSet)]) -> Vec<ClassSet> {
        let paving = &self.sheets[sheet];
        let (robot, scale) = (self.robot, &self.scale);
        for_paving!(robot, paving.axes.len(), summitless(robot, paving, scale, asked))
    }

    /// Splits leaves; returns their children, or `None` if the limits ended it before all were split.
    pub(super) fn split(&mut self, leaves: &[Leaf], limits: &Limits<'_>) -> Option<Vec<Leaf>> {
        let mut children = Vec::new();
        let mut all = true;
        let boxes = self.boxes() + ((leaves.len() as u64) << self.sheets[0].axes.len());
        let base = base_of(&self.sheets);
        for (s, sheet) in self.sheets.iter_mut().enumerate() {
            let here: Vec<u32> = leaves.iter().filter(|l| l.0 == s).map(|l| l.1).collect();
            let first = sheet.nodes.len() as u32;
            let charts = if s == base { &self.charts[base..] } else { &[] };
            all &= sheet.split(self.robot, charts, &here, &|| limits.is_over(boxes));
            children.extend((first..sheet.nodes.len() as u32).map(|n| (s, n)));
        }
        all.then_some(children)
    }
}

/// Boxes between two looks at the limits.
const SOME: usize = 1 << 15;

/// How often a box is halved to see whether it lies in a chart.
const HALVINGS: u32 = 12;

fn within_a_chart<const D: usize, const N: usize>(
    robot: &Robot,
    charts: &[Chart],
    paving: &Paving,
    node: u32,
) -> bool {
    let extent = paving.extent(node);
    let cell: [Interval; N] = std::array::from_fn(|k| extent[k]);
    charts.iter().any(|chart| {
        let mut open = vec![(cell, HALVINGS)];
        while let Some((cell, halvings)) = open.pop() {
            let (_, legs) = paving.chart.at::<Interval, D, N>(robot, &cell, |k| cell[k].sin_cos());
            let margins = chart.cover(robot, &legs);
            if margins.iter().all(|margin| margin.is_positive()) {
                continue;
            }
            if halvings == 0 || margins.iter().any(|margin| margin.is_negative()) {
                return false;
            }
            let widest = (0..N).max_by(|&a, &b| cell[a].width().total_cmp(&cell[b].width())).unwrap_or(0);
            let middle = cell[widest].mid();
            let (mut low, mut high) = (cell, cell);
            (low[widest].hi, high[widest].lo) = (middle, middle);
            open.extend([(low, halvings - 1), (high, halvings - 1)]);
        }
        true
    })
}

/// Whether a point of the base, whose coordinates are those of `base`, surely lies in none of the charts.
fn outside_charts<const D: usize, const N: usize>(
    robot: &Robot,
    charts: &[Chart],
    base: &Chart,
    point: &[Interval],
) -> bool {
    let y: [Interval; N] = std::array::from_fn(|k| point[k]);
    let (_, legs) = base.at::<Interval, D, N>(robot, &y, |k| y[k].sin_cos());
    charts.iter().all(|chart| chart.cover(robot, &legs).iter().any(|margin| margin.is_negative()))
}
