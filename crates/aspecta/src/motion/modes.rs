//! The graph of aspects joined through serial singularities, and plans across it.

use super::crossing::{Crossing, crossings};
use super::plan::refusal::{aspect_at, sign_at, word};
use super::plan::{End, PlanOptions, Planner, Refusal};
use crate::aspect::{Analysis, AspectId, Count, DetSign};
use crate::paving::Control;
use aspecta_kinematics::constraints::Margins;
use aspecta_robot::{Robot, Window, WorkingMode};
use serde::Serialize;
use std::collections::{BTreeMap, VecDeque};

pub use super::route::Route;

/// The aspects of a robot and the crossings between them.
#[derive(Clone, Debug, Serialize)]
#[non_exhaustive]
pub struct ModeGraph {
    /// The aspects.
    pub aspects: Vec<GraphAspect>,
    /// How many aspects the robot has. Numbers of aspects ([`GraphAspect::id`]) are those of this analysis; a finer one may see more.
    pub count: Count,
    /// Modes and signs of det A in which no aspect was seen, and none is excluded.
    pub unseen: Vec<(WorkingMode, DetSign)>,
    /// The crossings found (each proved): at most one between two aspects and leg, that with the most clearance found.
    pub crossings: Vec<Crossing>,
    /// Which aspects can be reached from one another: sets of [`GraphAspect::id`], ascending. That the members of a set are joined is
    /// proved where each of them is proved to be one ([`ModeGraph::is_proved`]). Aspects of different signs of det A are in different sets: proved too. That sets of one sign are not joined is not.
    pub groups: Vec<Vec<AspectId>>,
    /// Whether crossings were looked for everywhere; false if that was cancelled.
    pub searched: bool,
}

/// An aspect in the graph.
#[derive(Clone, Debug, Serialize)]
pub struct GraphAspect {
    /// Its number in the analysis.
    pub id: AspectId,
    /// The working mode.
    pub mode: WorkingMode,
    /// The sign of det A.
    pub det_a: DetSign,
    /// Certified inner measure.
    pub measure: f64,
    /// Whether it is proved to be one: [`Analysis::is_one`].
    pub is_one: bool,
}

impl ModeGraph {
    /// The graph of an analysis of all modes. Once cancelled, with the crossings found so far.
    ///
    /// # Examples
    /// ```
    /// use aspecta::{Budget, Control, ModeGraph, Options, Robot, analyze};
    ///
    /// # fn main() -> Result<(), aspecta::Error> {
    /// let robot = Robot::resolve("five-bar")?;
    /// let budget = Budget { depth: Some(7), ..Budget::default() };
    /// let options = Options { budget, ..Options::default() };
    /// let analysis = analyze(&robot, &options, &Control::unwatched())?;
    ///
    /// let graph = ModeGraph::new(&analysis, &Control::unwatched());
    /// // det A keeps its sign through every change of posture.
    /// assert!(graph.groups.len() >= 2);
    /// assert!(graph.crossings.iter().all(|crossing| crossing.clearance > 0.0));
    /// # Ok(())
    /// # }
    /// ```
    pub fn new(analysis: &Analysis, control: &Control<'_>) -> Self {
        let entries = analysis.classes.iter().flat_map(|class| {
            class.aspects.iter().map(|aspect| GraphAspect {
                id: aspect.id,
                mode: class.mode,
                det_a: class.det_a,
                measure: aspect.measure,
                is_one: analysis.is_one(aspect.id),
            })
        });
        let unseen = analysis.classes.iter().filter(|class| class.low == 0 && class.high != Some(0));
        let mut graph = Self {
            aspects: entries.collect(),
            count: analysis.aspects,
            unseen: unseen.map(|class| (class.mode, class.det_a)).collect(),
            crossings: crossings(analysis, control),
            groups: Vec::new(),
            searched: !control.is_cancelled(),
        };
        let mut left: Vec<AspectId> = graph.aspects.iter().map(|aspect| aspect.id).collect();
        while let Some(&first) = left.first() {
            let group: Vec<AspectId> =
                left.iter().copied().filter(|&id| graph.way(first, id).is_some()).collect();
            left.retain(|id| !group.contains(id));
            graph.groups.push(group);
        }
        graph
    }

    /// Whether it is proved that a group hangs together: its aspects are joined by proved crossings, and each of them is proved to be one.
    pub fn is_proved(&self, group: &[AspectId]) -> bool {
        self.aspects.iter().filter(|aspect| group.contains(&aspect.id)).all(|aspect| aspect.is_one)
    }

    /// The crossings (by index) from an aspect to another: as few as possible, and of those ways the one whose least clearance is greatest.
    /// `None` if no crossings lead there, or an aspect is not in the graph.
    pub fn way(&self, from: AspectId, to: AspectId) -> Option<Vec<usize>> {
        self.way_over(from, to, |_| true)
    }

    /// [`ModeGraph::way`] over some crossings only, by index.
    fn way_over(&self, from: AspectId, to: AspectId, is_open: impl Fn(usize) -> bool) -> Option<Vec<usize>> {
        if [from, to].iter().any(|end| self.aspects.iter().all(|aspect| aspect.id != *end)) {
            return None;
        }
        // Per aspect: how many crossings away, the least clearance on the way, and the last crossing.
        let mut best: BTreeMap<AspectId, (usize, f64, usize)> = BTreeMap::new();
        best.insert(from, (0, f64::INFINITY, usize::MAX));
        let mut open = VecDeque::from([from]);
        while let Some(here) = open.pop_front() {
            let Some(&(count, least, _)) = best.get(&here) else { continue };
            for (k, crossing) in self.crossings.iter().enumerate() {
                let Some(there) = crossing.other_side(here).filter(|_| is_open(k)) else { continue };
                let least = least.min(crossing.clearance);
                let better =
                    best.get(&there).is_none_or(|&(n, c, _)| n > count + 1 || n == count + 1 && c < least);
                if better {
                    best.insert(there, (count + 1, least, k));
                    open.push_back(there);
                }
            }
        }
        let (mut way, mut at) = (Vec::new(), to);
        while at != from {
            let &(_, _, crossing) = best.get(&at)?;
            way.push(crossing);
            at = self.crossings[crossing].other_side(at)?;
        }
        way.reverse();
        Some(way)
    }
}

impl Crossing {
    /// The aspect on the other side of `aspect`, if it is on one.
    pub fn other_side(&self, aspect: AspectId) -> Option<AspectId> {
        match self.aspects {
            [a, b] if a == aspect => Some(b),
            [a, b] if b == aspect => Some(a),
            _ => None,
        }
    }
}

/// A configuration: a pose in a working mode.
#[derive(Clone, Copy, Debug)]
pub struct Configuration<'a> {
    /// The pose.
    pub pose: &'a [f64],
    /// The mode.
    pub mode: WorkingMode,
}

/// Why there is no route.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NoRoute {
    /// One of the motions within a mode.
    #[error("{0}")]
    Plan(#[from] Refusal),
    /// det A has two signs (proved).
    #[error(
        "no such motion exists, proved: det A is {} at the start and {} at the goal; it keeps its sign through every change of working mode, \
         so every motion between them meets a parallel singularity", word(*.0), word(.0.opposite())
    )]
    OppositeSigns(DetSign),
    /// The aspect of an end is not known.
    #[error("undecided: which aspect the {0} lies in is not known at this resolution; finer boxes may tell")]
    Unknown(End),
    /// No crossings lead there.
    #[error(
        "undecided: no way through changes of working mode was found from aspect {start} to aspect {goal}{}, and none is excluded",
        if .margins.are_any() { " with these margins" } else { "" }
    )]
    NotFound {
        /// The aspect of the start.
        start: AspectId,
        /// The aspect of the goal.
        goal: AspectId,
        /// The margins asked for.
        margins: Margins,
    },
    /// Legs would come nearer to their serial singularities than they may.
    #[error(
        "the way leads through serial singularities, which a margin of |B_jj|/max forbids: ask for none of that kind"
    )]
    SerialMargin,
}

impl NoRoute {
    /// Whether what was asked for is no question about this robot.
    pub fn is_bad_input(&self) -> bool {
        matches!(self, Self::Plan(refusal) if refusal.is_bad_input())
    }

    /// Whether it proves that there is no such motion.
    pub fn is_proof(&self) -> bool {
        match self {
            Self::Plan(refusal) => refusal.is_proof(),
            Self::OppositeSigns(_) => true,
            Self::Unknown(_) | Self::NotFound { .. } | Self::SerialMargin => false,
        }
    }

    /// Whether finer boxes may tell whether there is a motion.
    pub fn is_of_resolution(&self) -> bool {
        matches!(self, Self::Unknown(_) | Self::NotFound { .. } | Self::Plan(Refusal::NotFound { .. }))
    }
}

impl Planner<'_> {
    /// A motion from a configuration to another, through as few changes of working mode as the graph allows; within one aspect it is
    /// [`Planner::plan`].
    ///
    /// # Errors
    /// [`NoRoute`]. Signs of det A that differ are a proof that there is none: det A keeps its sign through every crossing.
    ///
    /// # Examples
    /// ```
    /// use aspecta::motion::modes::Configuration;
    /// use aspecta::{Budget, Control, ModeGraph, Options, PlanOptions, Planner, Robot, analyze};
    ///
    /// # fn main() -> Result<(), aspecta::Error> {
    /// let robot = Robot::resolve("five-bar")?;
    /// let budget = Budget { depth: Some(8), ..Budget::default() };
    /// let options = Options { budget, ..Options::default() };
    /// let analysis = analyze(&robot, &options, &Control::unwatched())?;
    ///
    /// let graph = ModeGraph::new(&analysis, &Control::unwatched());
    /// let pose = [4.0, 7.0];
    /// let start = Configuration { pose: &pose, mode: "++".parse()? };
    /// let goal = Configuration { mode: "--".parse()?, ..start };
    /// let route = Planner::new(&analysis).route(&graph, start, goal, &PlanOptions::default())?;
    /// assert_eq!(route.stretches.len(), route.crossings.len() + 1);
    /// # Ok(())
    /// # }
    /// ```
    pub fn route(
        &mut self,
        graph: &ModeGraph,
        start: Configuration<'_>,
        goal: Configuration<'_>,
        options: &PlanOptions,
    ) -> Result<Route, NoRoute> {
        let [from, to] = self.aspects_of(start, goal)?;
        let robot = &self.analysis().robot;
        let margins = options.margins;
        let open: Vec<bool> =
            graph.crossings.iter().map(|crossing| crossing.is_proved(robot, margins)).collect();
        let way = graph.way_over(from, to, |k| open[k]).ok_or(NoRoute::NotFound {
            start: from,
            goal: to,
            margins,
        })?;
        if !way.is_empty() && margins.serial > 0.0 {
            return Err(NoRoute::SerialMargin);
        }
        let (mut here, mut at) = (start.pose.to_vec(), start.mode);
        let mut route = Route { stretches: Vec::new(), crossings: Vec::new() };
        for crossing in way.into_iter().map(|k| &graph.crossings[k]) {
            let plan = self.plan(&here, &crossing.inside, at, options)?;
            at = at.with_other_posture(crossing.leg);
            // Angles go on where the plan has brought them.
            here = plan.waypoints[plan.waypoints.len() - 1].clone();
            let crossing = crossing.turned_to(&here);
            if !crossing.is_proved(&self.analysis().robot, margins) {
                return Err(Refusal::Unproved { pose: here }.into());
            }
            route.crossings.push(crossing);
            route.stretches.push(plan);
        }
        route.stretches.push(self.plan(&here, goal.pose, at, options)?);
        Ok(route)
    }

    /// The aspects of both ends.
    fn aspects_of(
        &self,
        start: Configuration<'_>,
        goal: Configuration<'_>,
    ) -> Result<[AspectId; 2], NoRoute> {
        let analysis = self.analysis();
        let unknown = |at: &Configuration<'_>| analysis.classes.iter().all(|class| class.mode != at.mode);
        if let Some(at) = [start, goal].iter().find(|at| unknown(at)) {
            return Err(Refusal::Mode(at.mode).into());
        }
        let sign = check_ends(&analysis.robot, &analysis.window, [start, goal])?;
        let aspect = |end, at: Configuration<'_>| {
            let class = analysis.class_of(at.mode, sign).ok_or(Refusal::Mode(at.mode))?;
            aspect_at(analysis, at.pose, class).ok_or(NoRoute::Unknown(end))
        };
        Ok([aspect(End::Start, start)?, aspect(End::Goal, goal)?])
    }
}

/// Returns what the ends of a motion through working modes show before any aspects are known: that both lie
/// in a class, and the sign of det A, which is the same at both.
///
/// # Errors
/// [`NoRoute`]: what is wrong with an end, or that signs of det A differ, which proves that there is no motion.
pub fn check_ends(
    robot: &Robot,
    window: &Window,
    [start, goal]: [Configuration<'_>; 2],
) -> Result<DetSign, NoRoute> {
    let sign = |end, at: Configuration<'_>| sign_at(robot, window, (end, at.pose), at.mode);
    let signs = [sign(End::Start, start)?, sign(End::Goal, goal)?];
    if signs[0] == signs[1] { Ok(signs[0]) } else { Err(NoRoute::OppositeSigns(signs[0])) }
}

impl Crossing {
    /// Returns the crossing with its angles turned by full turns so that `inside` is as given (a full turn
    /// from what it was).
    fn turned_to(&self, inside: &[f64]) -> Self {
        let moved = |pose: &[f64]| {
            pose.iter().zip(inside).zip(&self.inside).map(|((x, to), from)| x + (to - from)).collect()
        };
        Self { inside: inside.to_vec(), pose: moved(&self.pose), beyond: moved(&self.beyond), ..self.clone() }
    }
}
