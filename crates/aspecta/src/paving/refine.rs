//! Subdivision, level by level.

use super::budget::{Budget, PAVING_SHARE, Stop};
use super::classify::Classifier;
use super::tree::{Node, Paving};
use super::{Control, MAX_BOXES, MODES, Progress};
use aspecta_kinematics::AgileEye;
use aspecta_kinematics::chart::Chart;
use aspecta_robot::WorkingMode;
use aspecta_robot::num::LANES;
use aspecta_robot::work;
use aspecta_robot::work::Stopwatch;
use aspecta_robot::{Robot, Window};

/// Parents one task subdivides.
pub(super) const CHUNK: usize = 256;

/// Runs a function generic over (D, N, M) — the dimension of space, the degrees of freedom, the coordinates
/// that vary.
macro_rules! for_paving {
    ($robot:expr, $axes:expr, $f:ident ( $($arg:expr),* $(,)? )) => {
        match ($robot.platform.space(), $robot.dof(), $axes) {
            (2, 2, 1) => $f::<2, 2, 1>($($arg),*),
            (2, 2, 2) => $f::<2, 2, 2>($($arg),*),
            (2, 3, 1) => $f::<2, 3, 1>($($arg),*),
            (2, 3, 2) => $f::<2, 3, 2>($($arg),*),
            (2, 3, 3) => $f::<2, 3, 3>($($arg),*),
            (3, 3, 1) => $f::<3, 3, 1>($($arg),*),
            (3, 3, 2) => $f::<3, 3, 2>($($arg),*),
            (3, 3, 3) => $f::<3, 3, 3>($($arg),*),
            (3, 6, 1) => $f::<3, 6, 1>($($arg),*),
            (3, 6, 2) => $f::<3, 6, 2>($($arg),*),
            (3, 6, 3) => $f::<3, 6, 3>($($arg),*),
            (_, n, m) => panic!("a paving of {m} axes of a robot with {n} degrees of freedom"),
        }
    };
}
pub(crate) use for_paving;

impl Paving {
    /// Paves `window`, in pose coordinates, for up to [`MODES`] working modes of a robot, up to 3 of whose
    /// coordinates vary: every box in which something is undecided is subdivided, to the depth of the budget.
    ///
    /// Deterministic, whatever the number of threads, unless a time budget or a cancellation ends it.
    ///
    /// # Panics
    /// If there are more modes than that, or the window does not have 1 to 3 axes.
    pub fn new(
        robot: &Robot,
        window: &Window,
        modes: &[WorkingMode],
        budget: &Budget,
        control: &Control<'_>,
    ) -> Self {
        let mut paving = Self::blank(robot, Chart::Pose, window.clone(), modes);
        let deadline = budget.seconds.map(|s| (Stopwatch::start(), s));
        let late = || deadline.is_some_and(|(start, seconds)| start.seconds() > PAVING_SHARE * seconds);
        let allowed = budget.boxes.unwrap_or(MAX_BOXES).min(MAX_BOXES);
        let depths = budget.even(window);
        let mut level = 0..1;
        for depth in 1..=depths {
            let mut parents: Vec<u32> = level.filter(|&i| paving.nodes[i as usize].undecided != 0).collect();
            let affordable = ((allowed - paving.boxes) >> paving.axes.len()) as usize;
            let enough = parents.len() <= affordable;
            parents.truncate(affordable);
            if parents.is_empty() && enough {
                break;
            }
            let total = u64::from(depths);
            (control.progress)(Progress { stage: "paving", done: u64::from(depth) - 1, total });
            let first = paving.nodes.len() as u32;
            let all = paving.split(robot, &[], &parents, &|| control.is_cancelled() || late());
            level = first..paving.nodes.len() as u32;
            if !all || !enough {
                paving.stop = match (all, control.is_cancelled()) {
                    (true, _) => Stop::Boxes,
                    (false, true) => Stop::Cancelled,
                    (false, false) => Stop::Time,
                };
                break;
            }
        }
        paving
    }

    /// A paving of one box in which nothing is known.
    pub fn blank(robot: &Robot, chart: Chart, window: Window, modes: &[WorkingMode]) -> Self {
        assert!(modes.len() <= MODES, "a pass takes up to {MODES} working modes");
        let mut paving = Self {
            axes: window.axes(),
            modes: modes.to_vec(),
            twins: robot.twins(),
            eye: AgileEye::of(robot),
            nodes: vec![Node { partly: !0, ..Node::default() }],
            depth: 0,
            boxes: 0,
            stop: Stop::Resolution,
            chart,
            window,
        };
        let classes = |m: usize| match paving.known_sign(m) {
            None => 3,
            Some(sign) if sign > 0 => 1,
            Some(_) => 2,
        };
        paving.nodes[0].undecided = (0..modes.len()).fold(0, |all, m| all | classes(m) << (2 * m));
        paving
    }

    /// Subdivides leaves, given in the order of their indices, and classifies their children; `charts` are
    /// those that cover part of this one. False if `stop` ended it before all were done.
    pub fn split(
        &mut self,
        robot: &Robot,
        charts: &[Chart],
        leaves: &[u32],
        stop: &(impl Fn() -> bool + Sync),
    ) -> bool {
        let mut all = true;
        for (depth, parents) in self.by_depth(leaves.iter().copied()) {
            let children = (depth + 1, parents.as_slice());
            all &= for_paving!(robot, self.axes.len(), split_level(self, robot, charts, children, stop));
        }
        all
    }
}

fn split_level<const D: usize, const N: usize, const M: usize>(
    paving: &mut Paving,
    robot: &Robot,
    charts: &[Chart],
    (depth, parents): (u32, &[u32]),
    stop: &(impl Fn() -> bool + Sync),
) -> bool {
    let classifier = Classifier::<D, N, M>::new(robot, paving, charts, depth, parents.len() << M);
    let chunks: Vec<_> = parents.chunks(CHUNK).collect();
    let families: Vec<Option<Vec<Node>>> = work::map(&chunks, |chunk| {
        (!stop()).then(|| subdivide::<D, N, M>(&paving.nodes, chunk, &classifier))
    });
    let mut all = true;
    for (chunk, children) in chunks.into_iter().zip(families) {
        let Some(children) = children else {
            all = false;
            continue;
        };
        paving.depth = paving.depth.max(depth);
        paving.boxes += children.len() as u64;
        for (k, &parent) in chunk.iter().enumerate() {
            paving.nodes[parent as usize].first_child = (paving.nodes.len() + (k << M)) as u32;
        }
        paving.nodes.extend(children);
    }
    all
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
            children.push(Node { corner, first_child: 0, depth: parent.depth + 1, ..*parent });
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
