//! The main job: a robot in, its working modes and generalized aspects out.

use super::ascent::{Class, merge};
use super::components::{Components, Piece, UnionFind};
use super::earlier::{parallel_aspects, serial_aspects};
use super::measure::{Held, Measure};
use super::project::{q_bounds, w_bounds};
use super::result::*;
use crate::kinematics::WorkingMode;
use crate::paving::{Budget, Control, Mark, Node, Paving, Progress};
use crate::robot::{Actuator, Leg, Robot, SliceError};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::time::Instant;

/// How an analysis is done.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// How far the paving goes.
    pub budget: Budget,
    /// Coordinates to hold (index, value), as in [`Robot::slice`]: what is analysed are the poses that have these values.
    pub fix: Vec<(usize, f64)>,
}

/// Why a robot cannot be analysed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum AnalysisError {
    /// The workspace, or the slice of it, has no window.
    #[error(transparent)]
    Slice(#[from] SliceError),
    /// Too many degrees of freedom to be paved whole.
    #[error("robot `{robot}` has {dof} degrees of freedom: aspects are computed for 2 and 3")]
    Dimension {
        /// Robot name.
        robot: String,
        /// Its degrees of freedom.
        dof: usize,
    },
}

/// Working modes (Def. 7) and generalized aspects (Def. 8) of a robot of dimension 2 or 3.
///
/// The workspace is paved once for all modes; per mode and sign of det A the aspects are bounded by
///
/// - **low** (certified): the number of components of G⁺, the graph of inside and undecided boxes that share a
///   point, which hold an inside box. A component of S_{s,σ} is connected and covered by those closed
///   boxes, so it lies in one component of G⁺; distinct such components hold distinct aspects.
/// - **pieces** of an aspect (certified): inside boxes joined by touching, or by certified ascent paths.
///
/// No upper bound is proved while undecided boxes are left (an aspect could hide in them): `high` is then
/// `None`. If nothing is left undecided, G⁻ = G⁺ and the count is exact.
///
/// In a slice ([`Options::fix`]) S_{s,σ} is cut by the slice; det A remains that of the whole robot. Each aspect of the slice
/// lies in one aspect of the robot; several may lie in the same.
///
/// # Errors
/// [`AnalysisError`] if the workspace is unbounded or empty, its dimension is not 2 or 3, or there is no such slice.
pub fn analyze(robot: &Robot, options: &Options, control: &Control<'_>) -> Result<Analysis, AnalysisError> {
    let start = Instant::now();
    if robot.dof() > 3 {
        return Err(AnalysisError::Dimension { robot: robot.name.clone(), dof: robot.dof() });
    }
    let window = robot.slice(&options.fix)?;
    let modes = robot.working_modes();
    let paving = Paving::new(robot, &window, &modes, &options.budget, control);
    let keys: Vec<(usize, DetSign)> =
        (0..modes.len()).flat_map(|m| [(m, DetSign::Positive), (m, DetSign::Negative)]).collect();
    let found: Vec<Found> =
        keys.par_iter().map(|&(m, sign)| find(robot, &paving, m, sign, control)).collect();
    let (classes, labels) = number(found);
    let low = classes.iter().map(|c| c.low).sum();
    let high = classes.iter().map(|c| c.high).sum::<Option<usize>>();
    (control.progress)(Progress { stage: "definitions 5 and 6", done: 0, total: 1 });
    let (parallel, serial) =
        rayon::join(|| parallel_aspects(robot, &paving), || serial_aspects(robot, &paving));
    Ok(Analysis {
        format_version: FORMAT_VERSION,
        fixed: Held::all(robot, &window),
        measure: Measure::over(robot, &window),
        aspects: Count { low, high, certified: high == Some(low) },
        legs: robot.leg_reports(),
        modes: modes.iter().enumerate().map(|(m, mode)| mode_report(robot, &paving, m, *mode)).collect(),
        classes,
        parallel_aspects: parallel,
        serial_aspects: serial,
        run: Run {
            boxes: paving.boxes,
            depth: paving.depth,
            resolution: window.ranges.iter().map(|r| (r.1 - r.0) / f64::from(1u32 << paving.depth)).collect(),
            stop: paving.stop,
            seconds: start.elapsed().as_secs_f64(),
        },
        robot: robot.clone(),
        window,
        labels,
        paving,
    })
}

/// One class, its aspects not yet numbered: label k + 1 stands for `class.aspects[k]`.
struct Found {
    class: AspectClass,
    labels: Vec<(u32, u32)>,
}

fn find(robot: &Robot, paving: &Paving, m: usize, det_a: DetSign, control: &Control<'_>) -> Found {
    let mode = paving.modes[m];
    let bit = 1 << (2 * m + usize::from(det_a == DetSign::Negative));
    let sight = |node: &Node| node.of_classes(bit);
    let components = Components::new(robot, paving, &sight);
    let class = Class { mode, sign: det_a.factor(), bit };
    let mut joined = merge(robot, paving, class, &components, control);
    // Pieces by component of G⁺, and those components by measure.
    let mut groups = BTreeMap::<u32, Vec<u32>>::new();
    for (k, piece) in components.pieces.iter().enumerate() {
        groups.entry(piece.component).or_default().push(k as u32);
    }
    let total = |group: &[u32]| group.iter().map(|&k| components.pieces[k as usize].measure).sum::<f64>();
    let mut groups: Vec<Vec<u32>> = groups.into_values().collect();
    groups.sort_by(|a, b| total(b).total_cmp(&total(a)));
    let mut label_of_piece = vec![0; components.pieces.len()];
    for (k, group) in groups.iter().enumerate() {
        group.iter().for_each(|&piece| label_of_piece[piece as usize] = k as u32 + 1);
    }
    let label = |i: usize| components.piece_of[i].map_or(0, |piece| label_of_piece[piece as usize]);
    let labels = components.boxes.iter().enumerate().map(|(i, &node)| (node, label(i))).collect();
    let aspects: Vec<Aspect> =
        groups.iter().map(|g| aspect(robot, paving, mode, &components, &mut joined, g)).collect();
    let low = aspects.len();
    let high = (components.undecided == 0.0).then(|| aspects.iter().map(|a| a.pieces).sum());
    let measure = aspects.iter().map(|a| a.measure).sum();
    let class = AspectClass { mode, det_a, low, high, measure, undecided: components.undecided, aspects };
    Found { class, labels }
}

fn aspect(
    robot: &Robot,
    paving: &Paving,
    mode: WorkingMode,
    components: &Components,
    joined: &mut UnionFind,
    group: &[u32],
) -> Aspect {
    let pieces: Vec<&Piece> = group.iter().map(|&k| &components.pieces[k as usize]).collect();
    let mut roots: Vec<u32> = group.iter().map(|&k| joined.root(k)).collect();
    roots.sort_unstable();
    roots.dedup();
    let component = pieces[0].component;
    let of_component = |i: &usize| components.component_of[*i] == component;
    let covering: Vec<usize> = (0..components.boxes.len()).filter(of_component).collect();
    let all: Vec<u32> = covering.iter().map(|&i| components.boxes[i]).collect();
    let inner: Vec<u32> = covering
        .iter()
        .filter(|&&i| components.piece_of[i].is_some())
        .map(|&i| components.boxes[i])
        .collect();
    let pose =
        paving.centre(pieces.iter().map(|p| p.largest).reduce(|a, b| paving.larger(a, b)).unwrap_or(0));
    let q = robot.inverse_in(&pose, mode).ok().flatten().unwrap_or_default();
    Aspect {
        id: 0,
        measure: pieces.iter().map(|p| p.measure).sum(),
        pieces: roots.len(),
        sample: Sample { pose, q },
        w_bounds: w_bounds(paving, &all),
        q_bounds: q_bounds(robot, paving, mode, &inner),
    }
}

/// Numbers the aspects of all classes from 1.
fn number(found: Vec<Found>) -> (Vec<AspectClass>, Vec<Vec<(u32, u32)>>) {
    let mut next = 1;
    let mut classes = Vec::new();
    let mut labels = Vec::new();
    for Found { mut class, labels: mut of_class } in found {
        let first = next as u32;
        for aspect in &mut class.aspects {
            aspect.id = next;
            next += 1;
        }
        of_class.iter_mut().filter(|l| l.1 > 0).for_each(|l| l.1 += first - 1);
        classes.push(class);
        labels.push(of_class);
    }
    (classes, labels)
}

fn mode_report(robot: &Robot, paving: &Paving, m: usize, mode: WorkingMode) -> ModeReport {
    let sight = |node: &Node| node.of_mode(m);
    let (mut best, mut open) = (None::<u32>, false);
    paving.boxes_of(&sight, &mut |at| {
        if sight(&paving.nodes[at as usize]) == Mark::Inside {
            best = Some(best.map_or(at, |b| paving.larger(b, at)));
        } else {
            open = true;
        }
    });
    let sample = best.and_then(|at| {
        let pose = paving.centre(at);
        let q = robot.inverse_in(&pose, mode).ok().flatten()?;
        Some(Sample { pose, q })
    });
    let reachable = match (best, open) {
        (Some(_), _) => Reachable::Yes,
        (None, true) => Reachable::Undecided,
        (None, false) => Reachable::No,
    };
    ModeReport { number: m + 1, mode, reachable, sample }
}

impl Robot {
    /// Theorem 1's hypothesis, leg by leg: working modes separate the inverse solutions if and only if no leg is
    /// cuspidal (and each has at most two postures).
    pub fn leg_reports(&self) -> Vec<LegReport> {
        let report = |(k, leg): (usize, &Leg)| LegReport {
            leg: k + 1,
            actuator: leg.actuator.kind(),
            postures: leg.actuator.postures(),
            cuspidal: false,
            reason: match leg.actuator {
                Actuator::Strut => "one posture: the strut's length is positive",
                _ => {
                    "two postures, the roots of a quadratic in closed form: the sign of B_jj names them, and they meet \
                     only where B_jj = 0"
                }
            },
        };
        self.legs.iter().enumerate().map(report).collect()
    }
}
