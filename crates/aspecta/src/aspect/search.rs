//! The search: refinement where it pays, until the bounds meet or the budget ends.

use super::ascent::Class;
use super::atlas::{Atlas, Leaf, Limits};
use super::count::{Counted, count};
use crate::kinematics::WorkingMode;
use crate::paving::{Budget, Control, MAX_BOXES, Progress, Stop};
use crate::robot::{Robot, Window};
use rayon::prelude::*;
use std::collections::BTreeSet;
use std::time::Instant;

/// All classes, counted over one atlas.
pub(super) struct Search<'a> {
    pub atlas: Atlas<'a>,
    pub counted: Vec<(Class, Counted)>,
    pub stop: Stop,
}

impl<'a> Search<'a> {
    /// Paves evenly to a moderate depth; then splits the boxes in which an aspect could hide until none could; then, class by
    /// class, those that lie between pieces not proved to be one, until they are joined or parted. At last everything undecided is
    /// split to the resolution asked for.
    pub(super) fn run(
        robot: &'a Robot,
        window: &Window,
        modes: &[WorkingMode],
        budget: &Budget,
        control: &Control<'_>,
    ) -> Self {
        let start = Instant::now();
        let late = || budget.seconds.is_some_and(|s| start.elapsed().as_secs_f64() > SHARE * s);
        let limits = Limits {
            depth: budget.finest(window).unwrap_or(DEEPEST),
            boxes: budget.boxes.unwrap_or(MAX_BOXES).min(MAX_BOXES),
            late: &late,
        };
        let mut atlas = Atlas::new(robot, window, modes, &budget.start(window), control);
        let classes = modes.iter().enumerate().flat_map(|(m, &mode)| {
            [(1, 1 << (2 * m)), (-1, 2 << (2 * m))].map(|(sign, bit)| Class { mode, sign, bit })
        });
        let mut complete = atlas.sheets[0].stop == Stop::Resolution;
        let leaves = atlas.undecided_leaves();
        complete &= atlas.uncover(leaves, &limits, control);
        let mut counted: Vec<(Class, Counted)> = classes
            .collect::<Vec<_>>()
            .into_par_iter()
            .map(|class| (class, count(&atlas, class, control)))
            .collect();
        loop {
            for leaf in
                counted.iter().flat_map(|(class, c)| c.summitless.iter().map(|&leaf| (leaf, class.bit)))
            {
                atlas.remember(leaf.0, leaf.1);
            }
            let gather = |boxes: fn(&Counted) -> &[Leaf]| -> Vec<Leaf> {
                let all: BTreeSet<Leaf> =
                    counted.iter().flat_map(|(_, c)| boxes(c).iter().copied()).collect();
                all.into_iter().filter(|&leaf| atlas.depth_of(leaf) < limits.depth).collect()
            };
            let ways = gather(|c| &c.between.ways);
            let mut split = gather(|c| &c.between.front);
            split.extend(
                ways.iter().filter(|leaf| split.binary_search(leaf).is_err()).copied().collect::<Vec<_>>(),
            );
            split.sort_unstable();
            if split.is_empty() || split.len() > limits.affordable(&atlas) || limits.is_over(control) {
                complete &= counted.iter().all(|(_, c)| c.is_exact());
                break;
            }
            let exact = counted.iter().filter(|(_, c)| c.is_exact()).count() as u64;
            (control.progress)(Progress {
                stage: "joining pieces",
                done: exact,
                total: counted.len() as u64,
            });
            let mut fresh = atlas.split(&split, control);
            // Ways are few: they are followed several levels down before the pieces are counted again.
            let torn =
                counted.iter().filter(|(_, c)| !c.is_exact()).fold(0, |torn, (class, _)| torn | class.bit);
            let mut tips = ways;
            for _ in 0..AHEAD {
                tips = atlas.undecided_children(&tips, torn);
                if tips.len() > limits.affordable(&atlas) {
                    break;
                }
                fresh.extend(atlas.split(&tips, control));
            }
            complete &= atlas.uncover(fresh, &limits, control);
            counted = counted
                .into_par_iter()
                .map(
                    |(class, old)| {
                        if old.is_exact() { (class, old) } else { (class, count(&atlas, class, control)) }
                    },
                )
                .collect();
        }
        let even = atlas.even_out(budget.even(window), &limits, control);
        complete &= even.reached;
        if even.changed {
            counted = counted
                .into_par_iter()
                .map(|(class, old)| {
                    let new = count(&atlas, class, control);
                    (class, if old.is_exact() && !new.is_exact() { old } else { new })
                })
                .collect();
            for leaf in
                counted.iter().flat_map(|(class, c)| c.summitless.iter().map(|&leaf| (leaf, class.bit)))
            {
                atlas.remember(leaf.0, leaf.1);
            }
        }
        let stop = match () {
            () if counted.iter().all(|(_, c)| c.is_exact()) => Stop::Exact,
            () if control.is_cancelled() => Stop::Cancelled,
            () if late() || atlas.sheets[0].stop == Stop::Time => Stop::Time,
            () if complete || limits.depth < DEEPEST => Stop::Resolution,
            () => Stop::Boxes,
        };
        Self { atlas, counted, stop }
    }
}

/// How many levels further ways are followed at once.
const AHEAD: usize = 2;

/// The share of a time budget after which the search ends; the last count and the report take the rest.
const SHARE: f64 = 0.7;

/// The depth at which a search ends if the budget names none: boxes are then some 10⁻⁸ of the window wide, still a million times
/// the spacing of doubles.
const DEEPEST: u32 = 26;
