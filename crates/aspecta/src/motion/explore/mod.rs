//! The whole pose space of a free body, six coordinates, explored by a roadmap.
//!
//! Six dimensions are too many for a paving. A roadmap draws poses of a class of aspects (a working mode and a sign of det A) and joins them by
//! straight segments in pose coordinates.
//!
//! | what is said | what it rests on |
//! |---|---|
//! | a pose lies in a class | certified: all constraints are > 0 in intervals ([`along`](aspecta_kinematics::path::curve::along) of a point) |
//! | two poses of a component lie in one aspect | certified: every edge is proved by [`along`](aspecta_kinematics::path::curve::along), so the component is a connected subset of the class |
//! | two poses of different classes lie in different aspects | certified: working modes, and the sign of det A in a mode, are constant on an aspect |
//! | there are at least as many aspects as classes with a pose | certified, by the lines above |
//! | a class has k components | what was seen within the budget, numerical: their aspects may be one, which no segment tried has shown, and aspects that no pose was drawn in may exist. It bounds nothing |
//!
//! Rotations are compared, drawn and interpolated as such (quaternions); only the segments that are proved are straight in roll, pitch and yaw. A
//! way is followed along the shortest rotation in short segments. It passes the poles of the pitch, which no open set of poses is cut by, at the side, or
//! straight through, the pitch going on past ±π/2 (the same orientation has other coordinates there).
//!
//! Where no pose drawn at random lies in a class, direct solutions of joint vectors drawn within the actuators' limits are tried.
//!
//! Growth is in rounds of tasks, each with random numbers of its own, that see the roadmap as it was before the round: without a time budget the result does not
//! depend on the number of threads.

mod assembly;
mod body;
mod growth;
mod plan;
mod roadmap;
mod seeds;
mod territory;

pub use assembly::{JoinedSolutions, NumberedSolution, SharedClass, join_solutions};
pub use plan::{NoWay, plan};

use crate::aspect::DetSign;
use crate::paving::Control;
use aspecta_kinematics::constraints::Demand;
use aspecta_robot::WorkingMode;
use aspecta_robot::work::Stopwatch;
use aspecta_robot::{Platform, Robot, Unbounded, Window};
use growth::Growth;
use seeds::Seeds;
use serde::Serialize;
use std::cell::LazyCell;
use territory::{Territory, roaming_window};

/// How long a roadmap grows. Whatever is met first ends it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// Poses drawn in a class, and steps into the unknown, together. Deterministic.
    pub samples: usize,
    /// Wall-clock seconds. Results then depend on the machine's speed.
    pub seconds: Option<f64>,
}

impl Effort {
    /// Returns the effort of the k-th (from 0) of `count` tasks: all samples, and its part of the time with
    /// what those before it left of theirs.
    fn part(self, k: usize, count: usize) -> Self {
        Self { seconds: self.seconds.map(|most| most * (k + 1) as f64 / count as f64), ..self }
    }

    /// Whether the time since `begin` is all it may take.
    fn is_spent(self, begin: Stopwatch) -> bool {
        self.seconds.is_some_and(|most| begin.seconds() >= most)
    }
}

/// The classes of some modes, mode by mode, + before −.
fn classes_of(modes: &[WorkingMode]) -> Vec<(WorkingMode, DetSign)> {
    modes.iter().flat_map(|&mode| [(mode, DetSign::Positive), (mode, DetSign::Negative)]).collect()
}

impl Default for Effort {
    fn default() -> Self {
        Self { samples: 4096, seconds: None }
    }
}

/// Why a roadmap grew no further.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum End {
    /// All poses that were to be joined are.
    Joined,
    /// All samples were drawn.
    Samples,
    /// The time was over.
    Time,
    /// Cancelled by the user.
    Cancelled,
}

/// Why a robot cannot be explored.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ExploreError {
    /// Other platforms have few enough coordinates for boxes.
    #[error(
        "robot `{robot}` has a `{platform}` platform: roadmaps are for `free-body` ones; the aspects of this one are \
         found in full by an analysis"
    )]
    NotFree {
        /// The robot.
        robot: String,
        /// Its platform.
        platform: Platform,
    },
    /// Nothing bounds a coordinate.
    #[error(transparent)]
    Unbounded(#[from] Unbounded),
    /// It has no such mode.
    #[error("`{mode}` is not a working mode of robot `{robot}`")]
    Mode {
        /// The mode asked for.
        mode: WorkingMode,
        /// The robot.
        robot: String,
    },
}

/// The result of exploring a robot's pose space.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Exploration {
    /// The robot's name.
    pub robot: String,
    /// Certified: there are at least as many generalized aspects, for so many classes have a proved member.
    pub at_least: usize,
    /// The classes, mode by mode, + before −.
    pub classes: Vec<ExploredClass>,
}

/// The result of exploring a class of aspects.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ExploredClass {
    /// The working mode.
    pub mode: WorkingMode,
    /// The sign of det A.
    pub det_a: DetSign,
    /// Poses drawn, and steps into the unknown.
    pub samples: usize,
    /// Why it ended.
    pub end: End,
    /// The components of its roadmap, the largest first. None: no pose of the class was found, which does not prove that there is none.
    pub components: Vec<Component>,
    /// The proved segments between the poses, each from the first to the second as straight as they stand.
    #[serde(skip)]
    pub edges: Vec<[Vec<f64>; 2]>,
}

/// Poses that are proved to lie in one aspect.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Component {
    /// Poses, those met on the way included.
    pub poses: usize,
    /// Poses of them that were drawn.
    pub samples: usize,
    /// The pose among them with the greatest |det Â|.
    pub representative: Vec<f64>,
    /// Its |det Â| ([`Margins`](aspecta_kinematics::constraints::Margins)). Numerical.
    pub clearance: f64,
}

/// Explores the classes of some working modes (none: all), one after another. Each may take all samples, and its part of the time.
///
/// # Errors
/// [`ExploreError`].
///
/// # Examples
/// ```
/// use aspecta::{Control, Effort, Robot, explore};
///
/// # fn main() -> Result<(), aspecta::Error> {
/// let robot = Robot::resolve("gough-stewart")?;
/// let effort = Effort { samples: 10, ..Effort::default() };
/// let found = explore(&robot, &[], &effort, &Control::unwatched())?;
/// assert_eq!(found.classes.len(), 2); // one working mode, two signs of det A
/// assert!(found.at_least <= 2);
/// # Ok(())
/// # }
/// ```
pub fn explore(
    robot: &Robot,
    modes: &[WorkingMode],
    effort: &Effort,
    control: &Control<'_>,
) -> Result<Exploration, ExploreError> {
    let window = roaming(robot)?;
    let known = robot.working_modes();
    if let Some(&mode) = modes.iter().find(|mode| !known.contains(mode)) {
        return Err(ExploreError::Mode { mode, robot: robot.name.clone() });
    }
    let modes = if modes.is_empty() { &known[..] } else { modes };
    let (classes, begin) = (classes_of(modes), Stopwatch::start());
    let seeds = LazyCell::new(|| Seeds::draw(robot, || control.is_cancelled() || effort.is_spent(begin)));
    let explored = |(k, &(mode, det_a)): (usize, &(WorkingMode, DetSign))| {
        let effort = effort.part(k, classes.len());
        let demand = Demand::class(mode, det_a.factor());
        let mut growth = Growth::new(Territory::new(robot, &window, &demand, 0.0), &[]);
        let mut end = growth.run(&effort, begin, control);
        if end == End::Samples && growth.roadmap.len() == 0 && growth.plant(seeds.of(mode, det_a)) {
            end = growth.run(&effort, begin, control);
        }
        growth.summary(mode, det_a, end)
    };
    let classes: Vec<ExploredClass> = classes.iter().enumerate().map(explored).collect();
    let at_least = classes.iter().filter(|class| !class.components.is_empty()).count();
    Ok(Exploration { robot: robot.name.clone(), at_least, classes })
}

/// The window of a robot that can be explored.
fn roaming(robot: &Robot) -> Result<Window, ExploreError> {
    if robot.platform != Platform::FreeBody {
        return Err(ExploreError::NotFree { robot: robot.name.clone(), platform: robot.platform });
    }
    Ok(roaming_window(robot)?)
}

impl Growth<'_> {
    /// Returns the summary of the class.
    fn summary(&self, mode: WorkingMode, det_a: DetSign, end: End) -> ExploredClass {
        let roadmap = &self.roadmap;
        let clearance = |spot: u32| self.territory.cost.measures(&roadmap.spot(spot).pose).parallel;
        let component = |spots: &Vec<u32>| {
            let best = spots.iter().map(|&k| (clearance(k), k)).max_by(|a, b| a.0.total_cmp(&b.0))?;
            let samples = spots.iter().filter(|&&k| roadmap.spot(k).is_sample).count();
            let representative = roadmap.spot(best.1).pose.to_vec();
            Some(Component { poses: spots.len(), samples, representative, clearance: best.0 })
        };
        let edge = |&[a, b]: &[u32; 2]| {
            let (a, b) = (&roadmap.spot(a).pose, &roadmap.spot(b).pose);
            [a.to_vec(), self.territory.beside(a, b).to_vec()]
        };
        ExploredClass {
            mode,
            det_a,
            samples: self.samples,
            end,
            components: roadmap.components().iter().filter_map(component).collect(),
            edges: roadmap.edges.iter().map(edge).collect(),
        }
    }
}
