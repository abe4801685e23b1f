//! Subdivision, level by level.

use super::budget::{Budget, Control, MAX_BOXES, PAVING_SHARE, Progress, Stop};
use super::classify::Classifier;
use super::tree::{ClassSet, Node, Paving};
use crate::kinematics::WorkingMode;
use crate::num::LANES;
use crate::robot::{Robot, Window};
use rayon::prelude::*;
use std::time::Instant;

/// Parents one task subdivides.
const CHUNK: usize = 256;

impl Paving {
    /// Paves `window` for up to 8 working modes of a robot, 1 to 3 of whose coordinates vary; the others are held
    /// (the window is a slice, [`Robot::slice`]).
    ///
    /// Deterministic, whatever the number of threads, unless a time budget or a cancellation ends it.
    ///
    /// # Panics
    /// If there are more than 8 modes, or the window does not have 1 to 3 axes, or the robot has 6 degrees of freedom.
    pub fn new(
        robot: &Robot,
        window: &Window,
        modes: &[WorkingMode],
        budget: &Budget,
        control: &Control<'_>,
    ) -> Self {
        assert!(modes.len() <= 8, "a pass takes up to 8 working modes");
        let pave = match (robot.platform.space(), robot.dof(), window.axes().len()) {
            (2, 2, 1) => refine::<2, 2, 1>,
            (2, 2, 2) => refine::<2, 2, 2>,
            (2, 3, 1) => refine::<2, 3, 1>,
            (2, 3, 2) => refine::<2, 3, 2>,
            (2, 3, 3) => refine::<2, 3, 3>,
            (3, 3, 1) => refine::<3, 3, 1>,
            (3, 3, 2) => refine::<3, 3, 2>,
            (3, 3, 3) => refine::<3, 3, 3>,
            (_, n, m) => panic!("a paving of {m} axes of a robot with {n} degrees of freedom"),
        };
        pave(robot, window, modes, budget, control)
    }
}

fn refine<const D: usize, const N: usize, const M: usize>(
    robot: &Robot,
    window: &Window,
    modes: &[WorkingMode],
    budget: &Budget,
    control: &Control<'_>,
) -> Paving {
    let all = ((1u32 << (2 * modes.len())) - 1) as ClassSet;
    let mut paving = Paving {
        window: window.clone(),
        axes: window.axes(),
        modes: modes.to_vec(),
        nodes: vec![Node { undecided: all, ..Node::default() }],
        levels: vec![0, 1],
        boxes: 0,
        stop: Stop::Resolution,
    };
    let deadline = budget.seconds.map(|s| (Instant::now(), s));
    let late =
        || deadline.is_some_and(|(start, seconds)| start.elapsed().as_secs_f64() > PAVING_SHARE * seconds);
    let allowed = budget.boxes.unwrap_or(MAX_BOXES).min(MAX_BOXES);
    let depths = budget.depth_in(window);
    for depth in 1..=depths {
        let level = paving.levels[depth as usize - 1]..paving.levels[depth as usize];
        let mut parents: Vec<u32> =
            level.filter(|&i| paving.nodes[i].undecided != 0).map(|i| i as u32).collect();
        let affordable = ((allowed - paving.boxes) >> M) as usize;
        if parents.len() > affordable {
            parents.truncate(affordable);
            paving.stop = Stop::Boxes;
        }
        if parents.is_empty() {
            break;
        }
        let classifier = Classifier::<D, N, M>::new(robot, modes, window, depth);
        let total = u64::from(depths);
        (control.progress)(Progress { stage: "paving", done: u64::from(depth) - 1, total });
        let subdivide = |chunk: &[u32]| {
            if control.is_cancelled() || late() {
                return None;
            }
            Some(subdivide::<D, N, M>(&paving.nodes, chunk, &classifier))
        };
        let families: Vec<Option<Vec<Node>>> = parents.par_chunks(CHUNK).map(subdivide).collect();
        for (chunk, children) in parents.chunks(CHUNK).zip(families) {
            let Some(children) = children else {
                paving.stop = if control.is_cancelled() { Stop::Cancelled } else { Stop::Time };
                continue;
            };
            paving.boxes += children.len() as u64;
            for (k, &parent) in chunk.iter().enumerate() {
                paving.nodes[parent as usize].first_child = (paving.nodes.len() + (k << M)) as u32;
            }
            paving.nodes.extend(children);
        }
        if paving.levels.last() != Some(&paving.nodes.len()) {
            paving.levels.push(paving.nodes.len());
        }
        if paving.stop != Stop::Resolution {
            break;
        }
    }
    paving
}

/// The 2^M children of each parent, classified, in order.
fn subdivide<const D: usize, const N: usize, const M: usize>(
    nodes: &[Node],
    parents: &[u32],
    classifier: &Classifier<'_, D, N, M>,
) -> Vec<Node> {
    let mut children = Vec::with_capacity(parents.len() << M);
    for &p in parents {
        let parent = &nodes[p as usize];
        for child in 0..1u32 << M {
            let corner = std::array::from_fn(|a| 2 * parent.corner[a] + (child >> a & 1) * u32::from(a < M));
            children.push(Node { corner, first_child: 0, ..*parent });
        }
    }
    for eight in children.chunks_mut(LANES) {
        // The last pack of a chunk may be short: fill it up with copies.
        let mut pack = [eight[0]; LANES];
        pack[..eight.len()].copy_from_slice(eight);
        classifier.classify(&mut pack);
        let count = eight.len();
        eight.copy_from_slice(&pack[..count]);
    }
    children
}
