//! Changes of working mode: a leg goes through its serial singularity while det A ≠ 0.
//!
//! Where H_j = 0 the two postures of leg j are one configuration, so the aspects of two modes that differ in
//! leg j alone may meet there. A [`Crossing`] is proved by [`along`] with a leg that crosses: from a pose
//! inside both aspects the platform goes straight to where the leg is stretched (or folded) and comes back in
//! the other posture, and det A keeps its sign all the while, which det A does with every crossing: aspects
//! of different signs are never joined so.

use crate::aspect::{Analysis, AspectId, ClassId, DetSign, Place};
use crate::paving::Control;
use aspecta_kinematics::constraints::{Demand, Margins, measures};
use aspecta_kinematics::modal::closures;
use aspecta_kinematics::path::curve::{Along, Curve, along};
use aspecta_kinematics::placement::Placement;
use aspecta_kinematics::{WorkingMode, for_platform};
use aspecta_robot::num::Jet;
use aspecta_robot::{LegIndex, Robot, work};
use serde::Serialize;
use std::collections::BTreeMap;

/// Interval evaluations for the proof of a crossing.
const EFFORT: usize = 2_000;
/// How far inside the crossing is proved from, as shares of the window, the nearest first.
const INSETS: [f64; 6] = [1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 3e-2];
/// Candidates between two aspects that are tried.
const TRIED: usize = 40;

/// A configuration in which the robot can change one leg's posture.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Crossing {
    /// The leg.
    pub leg: LegIndex,
    /// The modes on both sides.
    pub modes: [WorkingMode; 2],
    /// The sign of det A on both.
    pub det_a: DetSign,
    /// The aspects on both (certified).
    pub aspects: [AspectId; 2],
    /// The pose at which the leg is in its serial singularity. Numerical.
    pub pose: Vec<f64>,
    /// A pose in both aspects; on the straight segment from here to `beyond`, which runs through `pose`, the
    /// crossing is proved.
    pub inside: Vec<f64>,
    /// A pose that the leg does not reach (proved).
    pub beyond: Vec<f64>,
    /// The smallest of |det Â| and the other legs' |B_jj| / max |B_jj| at `pose`. Numerical.
    pub clearance: f64,
}

/// The best crossing found between every two aspects of an analysis that differ in one leg's posture, by
/// aspect numbers and leg; once cancelled, those found so far. That there is no other is not proved.
pub fn crossings(analysis: &Analysis, control: &Control<'_>) -> Vec<Crossing> {
    let classes = &analysis.classes;
    let pairs = |leg: LegIndex| {
        (0..classes.len()).flat_map(move |a| (a + 1..classes.len()).map(move |b| (a, b))).filter(
            move |&(a, b)| {
                classes[a].mode.with_other_posture(leg) == classes[b].mode
                    && classes[a].det_a == classes[b].det_a
            },
        )
    };
    let legs = (0..analysis.robot.dof()).filter(|&j| analysis.robot.legs[j].actuator.postures() == 2);
    let legs = legs.map(LegIndex::new);
    let all: Vec<Side> = legs
        .flat_map(|leg| {
            pairs(leg).map(move |(a, b)| Side { analysis, leg, classes: (ClassId::new(a), ClassId::new(b)) })
        })
        .collect();
    let mut found: Vec<Crossing> =
        work::flat_map(&all, |side| for_platform!(analysis.robot.platform, between(side, control)));
    found.sort_by_key(|crossing| (crossing.aspects, crossing.leg));
    found
}

impl Crossing {
    /// Whether intervals prove it: from `inside` towards `beyond` det A keeps its sign, and limits are kept,
    /// in both postures of the leg, until it comes to its serial singularity ([`along`]); and the margins,
    /// but for that leg's own.
    pub fn is_proved(&self, robot: &Robot, margins: Margins) -> bool {
        let class = Demand::class(self.modes[0], self.det_a.factor());
        let demand = Demand { crossing: Some(self.leg), margins, ..class };
        let way = Curve::segment(&self.inside, &self.beyond);
        matches!(along(robot, &demand, &way, EFFORT), Along::Crossed { .. })
    }
}

/// Two classes that differ in one leg.
struct Side<'a> {
    analysis: &'a Analysis,
    leg: LegIndex,
    classes: (ClassId, ClassId),
}

/// A pose at the leg's serial singularity, the way out there (per coordinate), and its clearance.
struct Candidate<const N: usize> {
    pose: [f64; N],
    out: [f64; N],
    clearance: f64,
}

fn between<const D: usize, const N: usize>(side: &Side<'_>, control: &Control<'_>) -> Vec<Crossing> {
    let mut by_aspects: BTreeMap<[AspectId; 2], Vec<Candidate<N>>> = BTreeMap::new();
    let cells = side.analysis.cells(side.classes.0);
    for cell in cells.into_iter().take_while(|_| !control.is_cancelled()) {
        let centre: [f64; N] = std::array::from_fn(|k| 0.5 * (cell.lo[k] + cell.hi[k]));
        let near =
            2.0 * (0..N).map(|k| ((cell.hi[k] - cell.lo[k]) / side.width(k)).powi(2)).sum::<f64>().sqrt();
        let Some(found) = side.nearest_singularity::<D, N>(&centre, near) else { continue };
        if let Some(aspects) = side.aspects_at(&found) {
            by_aspects.entry(aspects).or_default().push(found);
        }
    }
    let best = |(aspects, mut candidates): ([AspectId; 2], Vec<Candidate<N>>)| {
        candidates.sort_by(|a, b| b.clearance.total_cmp(&a.clearance));
        let mut tried = candidates.into_iter().take(TRIED).take_while(|_| !control.is_cancelled());
        let proved = tried.find_map(|c| side.prove::<D, N>(&c, aspects));
        proved.map(|crossing| side.improve::<D, N>(crossing))
    };
    by_aspects.into_iter().filter_map(best).collect()
}

impl Side<'_> {
    fn robot(&self) -> &Robot {
        &self.analysis.robot
    }

    fn mode(&self) -> WorkingMode {
        self.analysis.classes[self.classes.0.index()].mode
    }

    fn sign(&self) -> i8 {
        self.analysis.classes[self.classes.0.index()].det_a.factor()
    }

    /// Width of the window along coordinate k: what lengths are counted in here.
    fn width(&self, k: usize) -> f64 {
        let (lo, hi) = self.analysis.window.ranges[k];
        hi - lo
    }

    /// The pose next to `from` with H_j = 0, by Newton's method, not further than `near`, if the other
    /// constraints hold there.
    fn nearest_singularity<const D: usize, const N: usize>(
        &self,
        from: &[f64; N],
        near: f64,
    ) -> Option<Candidate<N>> {
        let mut pose = *from;
        let mut out = [0.0; N];
        for step in 0..20 {
            let (reach, gradient) = self.reach::<D, N>(&pose);
            let slope: f64 = gradient.iter().map(|g| g * g).sum();
            let scale = reach / slope;
            if !scale.is_finite() || (step == 0 && reach.abs() / slope.sqrt() > near) {
                return None;
            }
            pose = std::array::from_fn(|k| pose[k] - scale * gradient[k] * self.width(k));
            out = gradient.map(|g| -g / slope.sqrt());
            if (scale * slope.sqrt()).abs() < 1e-14 {
                break;
            }
        }
        let gone = (0..N).map(|k| ((pose[k] - from[k]) / self.width(k)).powi(2)).sum::<f64>().sqrt();
        let clearance = self.clearance::<D, N>(&pose);
        (gone <= near && clearance > 0.0).then_some(Candidate { pose, out, clearance })
    }

    /// H_j and its gradient, coordinates counted in widths of the window.
    fn reach<const D: usize, const N: usize>(&self, x: &[f64; N]) -> (f64, [f64; N]) {
        let x: [Jet<f64, N>; N] = std::array::from_fn(|k| {
            let mut x = Jet::variable(x[k], k);
            x.gradient[k] = self.width(k);
            x
        });
        let placement = Placement::<_, D>::at(self.robot().platform, &x);
        let reach = closures::<_, D, N>(self.robot(), &placement)[self.leg.index()].closure.reach;
        (reach.value, reach.gradient)
    }

    /// [`Crossing::clearance`]; 0 or less where det A has the wrong sign or another leg is out of reach.
    fn clearance<const D: usize, const N: usize>(&self, x: &[f64; N]) -> f64 {
        let placement = Placement::<f64, D>::at(self.robot().platform, x);
        let (parallel, serial) = measures::<f64, D, N>(self.robot(), &placement, self.mode());
        let others = (0..N).filter(|&j| j != self.leg.index()).map(|j| serial[j]).fold(1.0, f64::min);
        let clearance = (parallel * f64::from(self.sign())).min(others);
        if clearance.is_nan() { 0.0 } else { clearance }
    }

    /// The poses next to a candidate that may lie in both classes, the nearest first.
    fn insets<const N: usize>(&self, at: &Candidate<N>) -> impl Iterator<Item = [f64; N]> {
        INSETS
            .into_iter()
            .map(|inset| std::array::from_fn(|k| at.pose[k] - inset * at.out[k] * self.width(k)))
    }

    /// The aspects that meet at a candidate, where a pose next to it lies in cells of both.
    fn aspects_at<const N: usize>(&self, at: &Candidate<N>) -> Option<[AspectId; 2]> {
        self.insets(at).find_map(|x| self.aspects_of(&x))
    }

    /// The aspects of both classes that a pose certainly lies in.
    fn aspects_of(&self, pose: &[f64]) -> Option<[AspectId; 2]> {
        let of = |class: ClassId| match self.analysis.locate(pose, class) {
            Place::Inside(id) => Some(id),
            Place::Undecided | Place::Outside => None,
        };
        Some([of(self.classes.0)?, of(self.classes.1)?])
    }

    fn prove<const D: usize, const N: usize>(
        &self,
        at: &Candidate<N>,
        aspects: [AspectId; 2],
    ) -> Option<Crossing> {
        let inside = self.insets(at).find(|x| self.aspects_of(x) == Some(aspects))?;
        // As far out again as it was in.
        let beyond: [f64; N] = std::array::from_fn(|k| 2.0 * at.pose[k] - inside[k]);
        let window = &self.analysis.window;
        let crossing = Crossing {
            leg: self.leg,
            modes: [self.mode(), self.mode().with_other_posture(self.leg)],
            det_a: self.analysis.classes[self.classes.0.index()].det_a,
            aspects,
            pose: at.pose.to_vec(),
            inside: inside.to_vec(),
            beyond: beyond.to_vec(),
            clearance: at.clearance,
        };
        let within = window.holds(&inside) && window.holds(&at.pose);
        (within && crossing.is_proved(self.robot(), Margins::default())).then_some(crossing)
    }

    /// A crossing with more clearance next to a proved one, as far as small steps lead there.
    fn improve<const D: usize, const N: usize>(&self, mut best: Crossing) -> Crossing {
        let mut length = 0.05;
        while length > 1e-3 {
            let from: [f64; N] = std::array::from_fn(|k| best.pose[k]);
            let moved = |k: usize, way: f64| -> Option<Crossing> {
                let mut pose = from;
                pose[k] += way * length * self.width(k);
                let candidate = self.nearest_singularity::<D, N>(&pose, 2.0 * length)?;
                let better = candidate.clearance > best.clearance * 1.001;
                better.then(|| self.prove::<D, N>(&candidate, best.aspects)).flatten()
            };
            match (0..N).flat_map(|k| [(k, 1.0), (k, -1.0)]).find_map(|(k, way)| moved(k, way)) {
                Some(better) => best = better,
                None => length *= 0.5,
            }
        }
        best
    }
}
