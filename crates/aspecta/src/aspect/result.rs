//! The result of an analysis: plain values that know the robot they came from.

use super::ascent::{Class, ascend};
use super::measure::{Held, Measure};
use super::{AspectId, ClassId, SingularMode};
use crate::paving::{BoxOf, ClassSet, MODES, Paving, Stop};
use aspecta_kinematics::parallel_rods::ParallelRods;
use aspecta_kinematics::{WorkingMode, for_platform};
use aspecta_robot::{LegIndex, Robot, Window};
use aspecta_verify::certificate::Certificate;
use serde::{Deserialize, Serialize};

/// Version of the JSON layout of [`Analysis`]; raised when a field changes its meaning or goes away.
pub const FORMAT_VERSION: u32 = 1;

/// The generalized aspects of a robot (Definition 8) with all that was proved of them.
///
/// Serialises to the JSON of `aspecta analyze --json`. The cells behind it stay in memory:
/// [`Analysis::cells`].
#[derive(Clone, Debug, Serialize)]
#[non_exhaustive]
pub struct Analysis {
    /// [`FORMAT_VERSION`].
    pub format_version: u32,
    /// The robot.
    pub robot: Robot,
    /// The box of poses that was paved; it holds the whole workspace, or its slice.
    pub window: Window,
    /// The coordinates that were held: empty unless a slice was analysed.
    pub fixed: Vec<Held>,
    /// The quantity that is measured, and its unit.
    pub measure: Measure,
    /// Certified bounds on the number of generalized aspects, all modes and both signs together.
    pub aspects: Count,
    /// Theorem 1's hypothesis, leg by leg.
    pub legs: Vec<LegReport>,
    /// Table 1: the working modes.
    pub modes: Vec<ModeReport>,
    /// Table 2: one class per working mode and sign of det A, in the order of the modes, + before −.
    pub classes: Vec<AspectClass>,
    /// The working modes in which det A vanishes at every pose: they have no aspects.
    pub singular_modes: Vec<SingularMode>,
    /// The doubts that keep the bounds apart; empty if the bounds meet.
    pub doubts: Vec<Doubt>,
    /// Whether the robot seems to be singular wherever it goes ([`aspecta_kinematics::architecture`], numerical): then nothing is
    /// ever decided.
    pub architecturally_singular: bool,
    /// Whether the robot is an Agile Eye ([`aspecta_kinematics::AgileEye`]): det A then keeps its sign in each working mode, and where
    /// neither limits nor a window bound it each mode is exactly one aspect, which needs no search.
    pub agile_eye: bool,
    /// Surfaces on which det A vanishes to higher order: a reason for doubts that no refinement removes.
    pub parallel_rods: Vec<ParallelRods>,
    /// The legs, of a platform that turns about a point, that can fold two at once: the platform's
    /// joint then lies on the motor's axis, the motor's angle is free, and the bounds may stay apart near
    /// such orientations.
    pub uncharted_folds: Vec<LegIndex>,
    /// Definition 5 applied to this robot: what figures 6 and 7 show. Two entries, det A > 0 and < 0.
    pub parallel_aspects: Vec<EarlierAspects>,
    /// Definition 6 applied to this robot: domains of constant sign of the B_jj, one entry a mode.
    pub serial_aspects: Vec<EarlierAspects>,
    /// The run itself.
    pub run: Run,
    /// The proof, if it was asked for ([`super::Options::certificate`]).
    #[serde(skip)]
    pub certificate: Option<Certificate>,
    /// The pavings behind it, in pose coordinates, each of [`crate::paving::MODES`] modes (the last of the rest):
    /// [`Analysis::paving_of`].
    #[serde(skip)]
    pub pavings: Vec<Paving>,
    /// Per class, the boxes of its paving in which it ends and is not outside, in the order of node indices, with the
    /// [`Aspect::id`] they lie in (0: undecided).
    #[serde(skip)]
    pub(crate) labels: Vec<Vec<(u32, u32)>>,
}

/// The place of a pose with respect to one class.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// In this aspect (certified).
    Inside(AspectId),
    /// In a cell where membership is undecided.
    Undecided,
    /// In none of the class's aspects (certified).
    Outside,
}

impl Analysis {
    /// The cells of a class that are not outside it; none of a class that there is not.
    pub fn cells(&self, class: ClassId) -> Vec<Cell> {
        let Some((paving, _)) = self.paving_of(class) else { return Vec::new() };
        let cell = |&(node, id): &(u32, u32)| {
            let (lo, hi): BoxOf = paving.bounds(node);
            Cell { lo, hi, aspect: labelled(id) }
        };
        self.labels[class.index()].iter().map(cell).collect()
    }

    /// The paving that decides a class, and the class's bit in it; `None` if there is no such class.
    pub fn paving_of(&self, class: ClassId) -> Option<(&Paving, ClassSet)> {
        (class.index() < self.classes.len()).then(|| self.paving_behind(class))
    }

    /// [`Analysis::paving_of`] a class that there is.
    pub(crate) fn paving_behind(&self, class: ClassId) -> (&Paving, ClassSet) {
        let k = class.index();
        (&self.pavings[k / (2 * MODES)], 1 << (k % (2 * MODES)))
    }

    /// Returns the place of `pose` with respect to a class; angles count modulo 2π. A pose on the boundary of
    /// two cells may get the answer of either; one off the slice is outside, as is every one of a class that
    /// there is not.
    ///
    /// # Examples
    /// ```
    /// use aspecta::aspect::Place;
    /// use aspecta::{Budget, Control, DetSign, Options, Robot, analyze};
    ///
    /// # fn main() -> Result<(), aspecta::Error> {
    /// let robot = Robot::resolve("five-bar")?;
    /// let budget = Budget { depth: Some(7), ..Budget::default() };
    /// let modes = vec!["++".parse()?];
    /// let options = Options { budget, modes, ..Options::default() };
    /// let analysis = analyze(&robot, &options, &Control::unwatched())?;
    ///
    /// let class = analysis.class_of("++".parse()?, DetSign::Positive).expect("analysed");
    /// assert!(matches!(analysis.locate(&[4.0, 7.0], class), Place::Inside(_)));
    /// assert_eq!(analysis.locate(&[40.0, 0.0], class), Place::Outside);
    /// # Ok(())
    /// # }
    /// ```
    pub fn locate(&self, pose: &[f64], class: ClassId) -> Place {
        let Some((paving, _)) = self.paving_of(class) else { return Place::Outside };
        let pose = self.window.turned(pose);
        let labels = &self.labels[class.index()];
        let label = |node: u32| labels.binary_search_by_key(&node, |l| l.0).ok().map(|k| labels[k].1);
        let found = paving.descend_to(&pose, &mut |node| label(node).is_some());
        match found.and_then(|(node, _)| label(node)).map(labelled) {
            Some(Some(id)) => Place::Inside(id),
            Some(None) => Place::Undecided,
            None => Place::Outside,
        }
    }
}

impl Analysis {
    /// The class and the entry of an aspect.
    pub fn aspect(&self, id: AspectId) -> Option<(ClassId, &Aspect)> {
        let found = |(k, class): (usize, &'_ AspectClass)| {
            class.aspects.iter().position(|a| a.id == id).map(|i| (k, i))
        };
        let (class, i) = self.classes.iter().enumerate().find_map(found)?;
        Some((ClassId::new(class), &self.classes[class].aspects[i]))
    }

    /// The class of a mode and a sign of det A, if it was analysed.
    pub fn class_of(&self, mode: WorkingMode, det_a: DetSign) -> Option<ClassId> {
        let class = self.classes.iter().position(|class| class.mode == mode && class.det_a == det_a);
        class.map(ClassId::new)
    }

    /// Whether what is shown as an aspect is proved to be one: no aspect can hide in undecided boxes, and all its
    /// summits lie in one connected piece (`docs/theory.md`, 4). Else two poses in it may lie in two aspects.
    pub fn is_one(&self, id: AspectId) -> bool {
        self.aspect(id)
            .is_some_and(|(class, aspect)| self.classes[class.index()].high.is_some() && aspect.pieces == 1)
    }

    /// Which of its class's aspects, the largest first, an aspect is, from 1, and how many the class has. Unlike its number this
    /// does not depend on which modes were analysed.
    pub fn rank(&self, id: AspectId) -> Option<(usize, usize)> {
        let (class, _) = self.aspect(id)?;
        let aspects = &self.classes[class.index()].aspects;
        Some((1 + aspects.iter().position(|aspect| aspect.id == id)?, aspects.len()))
    }

    /// The aspect that a pose of a class lies in; `None` if the pose is not in the class, or lies in
    /// an undecided cell from which no certified ascent leads into a cell of an aspect. Certified where `Some`.
    ///
    /// # Examples
    /// ```
    /// use aspecta::{Budget, Control, DetSign, Options, Robot, analyze};
    ///
    /// # fn main() -> Result<(), aspecta::Error> {
    /// let robot = Robot::resolve("five-bar")?;
    /// let budget = Budget { depth: Some(7), ..Budget::default() };
    /// let modes = vec!["++".parse()?];
    /// let options = Options { budget, modes, ..Options::default() };
    /// let analysis = analyze(&robot, &options, &Control::unwatched())?;
    ///
    /// let class = analysis.class_of("++".parse()?, DetSign::Positive).expect("analysed");
    /// let id = analysis.aspect_at(&[4.0, 7.0], class).expect("in an aspect");
    /// assert_eq!(analysis.aspect(id).map(|(class, _)| class), Some(class));
    /// # Ok(())
    /// # }
    /// ```
    pub fn aspect_at(&self, pose: &[f64], class: ClassId) -> Option<AspectId> {
        match self.locate(pose, class) {
            Place::Inside(id) => Some(id),
            Place::Outside => None,
            Place::Undecided => {
                let mut found = None;
                self.climb(pose, class, &mut |pose| {
                    if let Place::Inside(id) = self.locate(pose, class) {
                        found = Some(id);
                    }
                    found.is_some()
                });
                found
            }
        }
    }

    /// Climbs from a pose of a class away from the boundary of its aspect, until `reached` says so of a pose or no step can be
    /// proved any more. The straight segments between the poses visited are proved to stay in the class.
    pub(crate) fn climb(&self, pose: &[f64], class: ClassId, reached: &mut impl FnMut(&[f64]) -> bool) {
        let AspectClass { mode, det_a, .. } = self.classes[class.index()];
        let (paving, bit) = self.paving_behind(class);
        let seen = Class { mode, sign: det_a.factor(), bit };
        for_platform!(self.robot.platform, ascend(&self.robot, paving, seen, pose, reached));
    }
}

/// The aspect that a label stands for: 0 for none.
fn labelled(id: u32) -> Option<AspectId> {
    (id > 0).then(|| AspectId::new(id as usize))
}

/// Proved bounds on a number of aspects.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Count {
    /// There are at least this many.
    pub low: usize,
    /// There are at most this many; `None` if no upper bound is proved.
    pub high: Option<usize>,
    /// Whether the bounds are equal: exactly `low`.
    pub certified: bool,
}

/// Why the bounds on the number of aspects of a class do not meet.
#[derive(Clone, Debug, Serialize)]
#[non_exhaustive]
pub struct Doubt {
    /// The working mode.
    pub mode: WorkingMode,
    /// The sign of det A.
    pub det_a: DetSign,
    /// The kind of doubt.
    pub kind: DoubtKind,
    /// In how many boxes.
    pub boxes: usize,
    /// The measure of those that are boxes of poses; 0 where the boxes are in a leg's own coordinates.
    pub measure: f64,
    /// The largest of them: a range per coordinate, of the pose or, if `fold` is set, of that leg's own coordinates.
    pub place: Vec<(f64, f64)>,
    /// The leg in whose own coordinates `place` is.
    pub fold: Option<LegIndex>,
    /// The functions whose signs are not decided there: `det A`, `H_1` (serial singularity of leg 1), `actuator limit of leg 2`.
    pub undecided: Vec<String>,
}

/// Kinds of [`Doubt`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum DoubtKind {
    /// A whole aspect could hide in the boxes: no upper bound is proved.
    Hidden,
    /// Inner cells on their two sides may belong to one aspect or to two.
    Unjoined,
}

/// The sign of det A.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum DetSign {
    /// det A > 0.
    #[serde(rename = "+")]
    Positive,
    /// det A < 0.
    #[serde(rename = "-")]
    Negative,
}

impl DetSign {
    /// The sign of a determinant that is not zero.
    pub fn of(det_a: f64) -> Self {
        if det_a > 0.0 { Self::Positive } else { Self::Negative }
    }

    /// The other one.
    pub fn opposite(self) -> Self {
        match self {
            Self::Positive => Self::Negative,
            Self::Negative => Self::Positive,
        }
    }

    /// +1 or −1.
    pub fn factor(self) -> i8 {
        match self {
            Self::Positive => 1,
            Self::Negative => -1,
        }
    }
}

impl std::fmt::Display for DetSign {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.pad(if *self == Self::Positive { "+" } else { "-" })
    }
}

/// Theorem 1 for one leg.
#[derive(Clone, Debug, Serialize)]
pub struct LegReport {
    /// The leg.
    pub leg: LegIndex,
    /// Kind of actuator.
    pub actuator: &'static str,
    /// Number of inverse solutions.
    pub postures: usize,
    /// Whether the leg is cuspidal: could change posture without a serial singularity.
    pub cuspidal: bool,
    /// Why, in a sentence.
    pub reason: &'static str,
}

/// Whether something can be reached under the limits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Reachable {
    /// Proved: a configuration is given.
    Yes,
    /// Proved: none exists.
    No,
    /// Neither is proved at this resolution.
    Undecided,
}

/// A working mode (Definition 7).
#[derive(Clone, Debug, Serialize)]
pub struct ModeReport {
    /// Mf_i, numbered from 1.
    pub number: usize,
    /// Its signs.
    pub mode: WorkingMode,
    /// Whether it can be reached under the limits (in a slice: within it).
    pub reachable: Reachable,
    /// A configuration in it, far from singularities among those found.
    pub sample: Option<Sample>,
}

/// The aspects of one working mode and one sign of det A.
#[derive(Clone, Debug, Serialize)]
#[non_exhaustive]
pub struct AspectClass {
    /// The working mode.
    pub mode: WorkingMode,
    /// The sign of det A.
    pub det_a: DetSign,
    /// At least this many aspects (certified).
    pub low: usize,
    /// At most this many (certified), `None` if not proved.
    pub high: Option<usize>,
    /// Certified inner measure, as [`Analysis::measure`] says.
    pub measure: f64,
    /// Measure of what is undecided: of the cells on the boundary all but what certainly lies on one side.
    pub undecided: f64,
    /// One entry for each of the `low` proved aspects, largest first.
    pub aspects: Vec<Aspect>,
}

/// A generalized aspect A_ij, as far as it is proved.
#[derive(Clone, Debug, Serialize)]
#[non_exhaustive]
pub struct Aspect {
    /// Its number within the whole analysis.
    pub id: AspectId,
    /// Certified inner measure.
    pub measure: f64,
    /// In how many certified connected pieces its inner cells fall: 1 if all are proved connected; k > 1
    /// leaves open whether these are one aspect or up to k.
    pub pieces: usize,
    /// A configuration inside.
    pub sample: Sample,
    /// Bounds of the W-aspect WA_ij: the box that certainly holds it, per pose coordinate (a glued
    /// coordinate may run over ±π).
    pub w_bounds: Vec<(f64, f64)>,
    /// Bounds that certainly hold the image of the inner cells in the Q-aspect QA_ij, per joint coordinate; (−π, π)
    /// for a full turn.
    pub q_bounds: Vec<(f64, f64)>,
}

/// A configuration (X, q).
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Sample {
    /// X.
    pub pose: Vec<f64>,
    /// q.
    pub q: Vec<f64>,
}

/// The aspects of Definition 5 or 6, which do not separate the solutions of this kind of robot.
#[derive(Clone, Debug, Serialize)]
pub struct EarlierAspects {
    /// `det A > 0`, `det A < 0`, or the signs of the B_jj.
    pub name: String,
    /// The domains found in the workspace, largest first (components of the inner cells; numerical at
    /// this resolution, not a certified count).
    pub domains: Vec<EarlierDomain>,
    /// Measure of the part of W that the next entry's domains cover too: > 0 shows that the definition does not
    /// separate the solutions.
    pub overlap: f64,
}

/// One domain of Definition 5 or 6.
#[derive(Clone, Debug, Serialize)]
pub struct EarlierDomain {
    /// Certified inner measure.
    pub measure: f64,
    /// A pose inside.
    pub sample: Sample,
}

/// How the run went.
#[derive(Clone, Debug, Serialize)]
#[non_exhaustive]
pub struct Run {
    /// Boxes classified (all modes of a box count once).
    pub boxes: u64,
    /// Finest subdivision: cells are window / 2^depth.
    pub depth: u32,
    /// Width of the finest cells, per coordinate; 0 where it is held.
    pub resolution: Vec<f64>,
    /// Why the run ended.
    pub stop: Stop,
    /// Wall-clock seconds.
    pub seconds: f64,
    /// The seconds that the budget allowed, if it did. The step that is under way when they are over, a count
    /// or the report, is ended; none is begun that is expected to take longer.
    pub allowed_seconds: Option<f64>,
}

/// A cell of the paving as one class sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell {
    /// Lower corner in the coordinates that vary (unused entries 0).
    pub lo: [f64; 3],
    /// Upper corner.
    pub hi: [f64; 3],
    /// The aspect the cell certainly lies in, or `None` if undecided.
    pub aspect: Option<AspectId>,
}
