//! The search: refinement where it pays, until the bounds meet or the budget ends.

use super::ascent::Class;
use super::atlas::{Atlas, Even, Leaf, Limits};
use super::count::{Counted, count};
use super::options::Purpose;
use crate::paving::{Budget, Control, MAX_BOXES, MAX_DEPTH, Progress, Shares, Stop};
use aspecta_robot::work;
use aspecta_robot::work::Stopwatch;
use aspecta_robot::{Robot, Window, WorkingMode};
use std::collections::BTreeSet;
use std::sync::atomic::{AtomicBool, Ordering};

/// All classes, counted over one atlas.
pub(super) struct Search<'a> {
    pub atlas: Atlas<'a>,
    pub counted: Vec<(Class, Counted)>,
    /// What is certain of the undecided boxes of poses.
    pub shares: Shares,
    pub stop: Stop,
}

impl<'a> Search<'a> {
    /// Paves evenly to a moderate depth; then splits the boxes in which an aspect could hide until none
    /// could; then, class by class, those that lie between pieces not proved to be one, until they are joined
    /// or parted. At last everything undecided is split to the resolution asked for.
    pub(super) fn run(
        robot: &'a Robot,
        window: &Window,
        modes: &[WorkingMode],
        (budget, purpose): (&Budget, Purpose),
        control: &Control<'_>,
    ) -> Self {
        let start = Stopwatch::start();
        let mut limits = Limits {
            depth: budget.finest(window).unwrap_or(MAX_DEPTH),
            boxes: budget.boxes.unwrap_or(MAX_BOXES).min(MAX_BOXES),
            time: budget.seconds.map(|seconds| (start, seconds)),
            rest: AFTER * modes.len() as f64 * PER_BOX / work::thread_count() as f64,
            late: AtomicBool::new(false),
            names_doubts: purpose != Purpose::Boxes,
            control,
        };
        let atlas = Atlas::new(robot, window, modes, budget, control);
        let paved = atlas.sheets[0].stop;
        let mut search = Self { atlas, counted: Vec::new(), shares: Shares::default(), stop: paved };
        let leaves = if search.atlas.is_known { Vec::new() } else { search.atlas.undecided_leaves() };
        let mut afforded = search.atlas.uncover(leaves, &limits);
        let counting = Stopwatch::start();
        search.count_all(&limits);
        limits.rest = limits.rest.max(AFTER * counting.seconds() / search.atlas.boxes() as f64);
        afforded &= search.join(&limits);
        let even = search.even_out(budget, purpose, &limits);
        afforded &= even.reached;
        if even.changed {
            search.take_over(&limits);
        }
        if purpose != Purpose::Boxes {
            search.shares.update(&search.atlas.sheets[0], robot);
        }
        search.stop = match () {
            () if search.is_exact() => Stop::Exact,
            () if control.is_cancelled() => Stop::Cancelled,
            () if limits.late.load(Ordering::Relaxed) || paved == Stop::Time => Stop::Time,
            () if afforded && paved == Stop::Resolution => Stop::Resolution,
            () => Stop::Boxes,
        };
        search
    }

    /// Splits everything undecided to the depth asked for, or else as finely as pictures or measures want it.
    fn even_out(&mut self, budget: &Budget, purpose: Purpose, limits: &Limits<'_>) -> Even {
        let window = &self.atlas.sheets[0].window;
        let (asked, usual) = (budget.finest(window), Budget::default().even(window));
        if !self.is_exact() {
            return self.atlas.even_out(asked.unwrap_or(usual), limits);
        }
        // Nothing is left to be found by going on as finely as was allowed.
        let finest = asked.map_or(usual, |asked| asked.min(usual));
        if purpose != Purpose::Numbers || asked.is_some() {
            return self.atlas.even_out(finest, limits);
        }
        self.measure(limits)
    }

    /// Splits the boxes that leave most of the measures undecided, until that is little or it has taken many boxes.
    fn measure(&mut self, limits: &Limits<'_>) -> Even {
        let counted = self.atlas.boxes();
        let most = counted + MEASURING.max(counted / 4);
        let mut even = Even { changed: false, reached: true };
        loop {
            let paving = &self.atlas.sheets[0];
            self.shares.update(paving, self.atlas.robot);
            let [inside, undecided] = self.shares.measures(paving);
            let left = most.saturating_sub(self.atlas.boxes()) >> paving.axes.len();
            if undecided <= FINE * inside || left == 0 {
                return even;
            }
            let mut worst = self.shares.worst(paving);
            worst.retain(|&node| paving.depth_of(node) < limits.depth);
            worst.truncate(left as usize);
            if worst.is_empty() {
                return even;
            }
            let split: Vec<Leaf> = worst.into_iter().map(|node| (0, node)).collect();
            let is_over = split.len() > limits.affordable(&self.atlas) || limits.is_over(self.atlas.boxes());
            (limits.control.progress)(Progress {
                stage: "measuring",
                done: self.atlas.boxes() - counted,
                total: most - counted,
            });
            if is_over {
                return Even { reached: false, ..even };
            }
            even.changed = true;
            if self.atlas.split(&split, limits).is_none() {
                return Even { reached: false, ..even };
            }
        }
    }

    /// Whether the bounds have met.
    fn is_exact(&self) -> bool {
        self.counted.iter().all(|(_, counted)| counted.is_exact())
    }

    fn count_all(&mut self, limits: &Limits<'_>) {
        let atlas = &self.atlas;
        let paving = &atlas.sheets[0];
        let classes: Vec<Class> = (0..paving.modes.len()).flat_map(|m| Class::both(paving, m)).collect();
        self.counted = work::map(&classes, |&class| (class, count(atlas, class, limits)));
        self.remember(limits);
    }

    /// Counts those that are `due` once more. What was exact stays so.
    fn recount(&mut self, limits: &Limits<'_>, due: impl Fn(&Counted) -> bool + Sync) {
        let atlas = &self.atlas;
        let again = |(class, old): &mut (Class, Counted)| {
            if due(old) {
                let new = count(atlas, *class, limits);
                if new.is_exact() || !old.is_exact() {
                    *old = new;
                }
            }
        };
        work::update(&mut self.counted, again);
        self.remember(limits);
    }

    /// Takes over what boxes of poses that were split became: classes are counted once more, but where it is clear whose they are.
    fn take_over(&mut self, limits: &Limits<'_>) {
        let alone = self.atlas.sheets.len() == 1;
        let is_clear = |counted: &Counted| counted.is_exact() && (alone || counted.low() == 1);
        let poses = &self.atlas.sheets[0];
        work::update(&mut self.counted, |(class, counted): &mut (Class, Counted)| {
            if is_clear(counted) {
                counted.refine(poses, *class);
            }
        });
        self.recount(limits, |counted| !is_clear(counted));
    }

    /// Has the atlas remember which boxes the counts found to have no summit, or to lie in a chart: then
    /// counts are due again.
    fn remember(&mut self, limits: &Limits<'_>) {
        let mut covered = false;
        for (class, counted) in &mut self.counted {
            counted.summitless.iter().for_each(|&leaf| self.atlas.remember(leaf, class.bit));
            for leaf in std::mem::take(&mut counted.covered) {
                self.atlas.cover(leaf);
                covered = true;
            }
        }
        if covered {
            self.recount(limits, |counted| !counted.is_exact());
        }
    }

    /// Splits what lies between pieces not proved to be one, until the bounds meet or the limits end it:
    /// false if boxes or time do.
    fn join(&mut self, limits: &Limits<'_>) -> bool {
        let mut afforded = true;
        loop {
            let ways = self.gather(limits, |c| &c.between.ways);
            let mut split = self.gather(limits, |c| &c.between.front);
            split.extend(ways.iter().copied());
            if split.is_empty() {
                return afforded;
            }
            if split.len() > limits.affordable(&self.atlas) || limits.is_over(self.atlas.boxes()) {
                return false;
            }
            let open = |(_, c): &&(Class, Counted)| !c.is_exact();
            let (total, left) = (self.counted.len() as u64, self.counted.iter().filter(open).count() as u64);
            (limits.control.progress)(Progress { stage: "joining pieces", done: total - left, total });
            let split: Vec<Leaf> = split.into_iter().collect();
            let Some(mut fresh) = self.atlas.split(&split, limits) else { break };
            // Ways are few: they are followed several levels down before the pieces are counted again.
            let unsettled =
                self.counted.iter().filter(open).fold(0, |unsettled, (class, _)| unsettled | class.bit);
            let mut tips: Vec<Leaf> = ways.into_iter().collect();
            for level in 0..FAR_AHEAD {
                if level >= AHEAD && fresh.len() as u64 > self.atlas.boxes() >> FEW {
                    break;
                }
                tips = self.atlas.undecided_children(&tips, unsettled);
                if tips.len() > limits.affordable(&self.atlas) {
                    break;
                }
                let Some(finer) = self.atlas.split(&tips, limits) else { break };
                fresh.extend(finer);
            }
            afforded &= self.atlas.uncover(fresh, limits);
            self.recount(limits, |counted| !counted.is_exact());
        }
        // Some boxes were split before the limits ended it.
        self.recount(limits, |counted| !counted.is_exact());
        false
    }

    /// Boxes of all classes that may still be split.
    fn gather(&self, limits: &Limits<'_>, boxes: impl Fn(&Counted) -> &[Leaf]) -> BTreeSet<Leaf> {
        let all = self.counted.iter().flat_map(|(_, counted)| boxes(counted).iter().copied());
        all.filter(|&leaf| self.atlas.depth_of(leaf) < limits.depth).collect()
    }
}

/// The share of the measures that may be left undecided where boxes are for numbers only.
const FINE: f64 = 0.003;
/// As many boxes may be taken to leave no more, or a quarter of those that the counts took.
const MEASURING: u64 = 1 << 17;

/// How many levels further ways are followed at once …
const AHEAD: usize = 2;
/// … and as long as that is little work, beside another count of all boxes …
const FAR_AHEAD: usize = 6;
/// … which it is for one box in 2^this.
const FEW: u32 = 8;

/// How long the last count and the report take, in counts.
const AFTER: f64 = 2.0;

/// About how long, in seconds, a thread takes to count and to report one class, for each box of the atlas. A
/// first guess: time budgets are kept as well as this is; nothing else depends on it.
const PER_BOX: f64 = 0.5e-6;
