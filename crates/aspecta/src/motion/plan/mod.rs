//! Planning within a working mode: from one pose to another through one generalized aspect.
//!
//! The boxes that the analysis proved to lie in a class are a graph; the cheapest way over it becomes a polyline, whose waypoints are
//! then left out and moved. What is returned is proved segment by segment ([`aspecta_kinematics::path::curve::along`]), margins included; how
//! it was found is no part of the proof.
//!
//! That no path exists is proved too, where it is so: det A is continuous along any motion in a working mode, so two signs of it cannot
//! be joined without a zero; and poses that lie in two aspects of a class ([`Analysis::aspect_at`]) cannot be joined within the class by
//! Definition 8.

mod around;
pub(super) mod cost;
pub(super) mod refusal;
mod roadmap;
mod search;
pub(super) mod shorten;

pub use refusal::{End, Refusal};

use crate::aspect::{Analysis, AspectId, ClassId, DetSign};
use aspecta_kinematics::constraints::{Demand, Margins};
use aspecta_kinematics::path::curve::Along;
use aspecta_robot::num::padded;
use aspecta_robot::{Robot, Window, WorkingMode};
use cost::Cost;
use roadmap::Roadmap;
use search::Search;
use serde::Serialize;
use std::collections::HashSet;

/// Up to three coordinates, of which the first n count.
type Pose = [f64; 3];

/// The kind of path that is wanted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanOptions {
    /// How much nearness to singularities counts: a unit of length costs c^−w where the clearance c is the smaller of |det Â| and
    /// the |B_jj| / max |B_jj|. 0 looks for the shortest path; 8 as good as only at the least clearance.
    pub weight: f64,
    /// The margins from singularities that the whole path keeps, proved.
    pub margins: Margins,
}

impl Default for PlanOptions {
    fn default() -> Self {
        Self { weight: 1.0, margins: Margins::default() }
    }
}

/// A path within one aspect: straight segments in pose coordinates, each proved to stay in it and to keep the margins.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Plan {
    /// The robot.
    #[serde(skip)]
    pub robot: Robot,
    /// The working mode.
    pub mode: WorkingMode,
    /// The sign of det A.
    pub det_a: DetSign,
    /// The aspect, where it is known.
    pub aspect: Option<AspectId>,
    /// The poses it goes through, the ends included. Angles go on past ±π; the last pose may be full turns from the one asked for.
    pub waypoints: Vec<Vec<f64>>,
    /// Its length: translations, and angles times the robot's characteristic length. Numerical.
    pub length: f64,
    /// The margins proved.
    pub margins: Margins,
}

/// Plans paths through the aspects of an analysed robot.
pub struct Planner<'a> {
    analysis: &'a Analysis,
    /// The roadmaps made so far: per class, the coarsest first.
    roadmaps: Vec<Vec<Roadmap>>,
}

/// Interval evaluations for a segment that is only tried.
const TRIAL: usize = 200;
/// For one that is to be returned.
pub(super) const FINAL: usize = 100_000;
/// How often a way is looked for again because a segment of it does not keep the margins.
const DETOURS: usize = 200;

/// The proof of segments by intervals.
pub(super) struct Proof<'a> {
    pub robot: &'a Robot,
    pub window: &'a Window,
    pub demand: &'a Demand,
}

impl Proof<'_> {
    fn axes(&self) -> usize {
        self.robot.dof()
    }

    /// Whether the segment between two poses meets the demand, within the window.
    pub fn holds<const K: usize>(&self, a: &[f64; K], b: &[f64; K]) -> bool {
        self.holds_within(a, b, TRIAL)
    }

    /// [`Proof::holds`], with more or less effort.
    pub fn holds_within<const K: usize>(&self, a: &[f64; K], b: &[f64; K], effort: usize) -> bool {
        let n = self.axes();
        self.window.holds(&a[..n])
            && self.window.holds(&b[..n])
            && Along::is_inside(self.robot, self.demand, [&a[..n], &b[..n]], effort)
    }
}

impl<'a> Planner<'a> {
    /// A planner over a whole robot of two or three degrees of freedom (no slice of it).
    pub fn new(analysis: &'a Analysis) -> Self {
        Self { analysis, roadmaps: analysis.classes.iter().map(|_| Vec::new()).collect() }
    }

    /// Returns the sign of det A that both ends of a path in `mode` have, which is known before any aspects
    /// are.
    ///
    /// # Errors
    /// [`Refusal`]: what is wrong with an end, or that signs of det A differ, which proves that there is no path.
    pub fn check_ends(
        robot: &Robot,
        window: &Window,
        ends: [&[f64]; 2],
        mode: WorkingMode,
        options: &PlanOptions,
    ) -> Result<DetSign, Refusal> {
        refusal::common_sign(robot, window, ends, mode, options.margins)
    }

    /// A path between two poses that is found without aspects, and proved: for robots whose aspects take long. It goes straight, or nearly, if
    /// on the straight segment the robot is nowhere nearer to singularities than at one of its ends; or round what is in between, if such a
    /// way is soon found. `None` says nothing: no path may have been found, or nearness to singularities counts so much
    /// ([`PlanOptions::weight`] above 1) that a way through the whole aspect may be better.
    ///
    /// # Errors
    /// As [`Planner::check_ends`].
    ///
    /// # Examples
    /// ```
    /// use aspecta::{Kinematics, PlanOptions, Planner, Robot};
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let robot = Robot::resolve("delta")?;
    /// let window = robot.slice(&[])?;
    /// let ends = [&[0.0, 0.0, -900.0][..], &[50.0, 0.0, -900.0]];
    /// let mode = robot.inverse(ends[0])?[0].mode;
    /// let plan = Planner::without_aspects(&robot, &window, ends, mode, &PlanOptions::default())?;
    /// assert!(plan.is_some_and(|plan| plan.aspect.is_none() && plan.waypoints.len() == 2));
    /// # Ok(())
    /// # }
    /// ```
    pub fn without_aspects(
        robot: &Robot,
        window: &Window,
        ends: [&[f64]; 2],
        mode: WorkingMode,
        options: &PlanOptions,
    ) -> Result<Option<Plan>, Refusal> {
        let det_a = Self::check_ends(robot, window, ends, mode, options)?;
        let search = Search::new(robot, window, mode, det_a, options);
        let ends = ends.map(|pose| -> Pose { padded(&window.turned(pose)) });
        let path = search.straight(ends).or_else(|| search.around(ends));
        path.map(|path| search.finish(path, None)).transpose()
    }

    /// Returns the analysis that it plans over.
    pub fn analysis(&self) -> &'a Analysis {
        self.analysis
    }

    /// A path from `start` to `goal` (angles modulo 2π) in `mode`.
    ///
    /// # Errors
    /// [`Refusal`]: what is wrong with the poses, why no path exists, or what could not be decided.
    ///
    /// # Examples
    /// ```
    /// use aspecta::{Budget, Control, Options, PlanOptions, Planner, Robot, analyze};
    ///
    /// # fn main() -> Result<(), aspecta::Error> {
    /// let robot = Robot::resolve("five-bar")?;
    /// let budget = Budget { depth: Some(8), ..Budget::default() };
    /// let modes = vec!["++".parse()?];
    /// let options = Options { budget, modes, ..Options::default() };
    /// let analysis = analyze(&robot, &options, &Control::unwatched())?;
    ///
    /// let mut planner = Planner::new(&analysis);
    /// let plan = planner.plan(&[4.0, 7.0], &[5.0, 6.0], "++".parse()?, &PlanOptions::default())?;
    /// assert_eq!(plan.waypoints[0], [4.0, 7.0]);
    /// assert!(aspecta::check_path(&robot, &plan.waypoints, plan.mode)?.is_sound());
    /// # Ok(())
    /// # }
    /// ```
    pub fn plan(
        &mut self,
        start: &[f64],
        goal: &[f64],
        mode: WorkingMode,
        options: &PlanOptions,
    ) -> Result<Plan, Refusal> {
        let analysis = self.analysis;
        let (robot, window) = (&analysis.robot, &analysis.window);
        if !analysis.classes.iter().any(|class| class.mode == mode) {
            return Err(Refusal::Mode(mode));
        }
        let det_a = Self::check_ends(robot, window, [start, goal], mode, options)?;
        let (class, aspect) = refusal::common_aspect(analysis, [start, goal], mode, det_a)?;
        let search = Search::new(robot, window, mode, det_a, options);
        let ends = [start, goal].map(|pose| -> Pose { padded(&analysis.window.turned(pose)) });
        let path = match search.straight(ends) {
            Some(path) => path,
            None => self.sound_path(class, &search, ends)?,
        };
        search.finish(path, aspect)
    }

    /// Some path, proved.
    fn sound_path(
        &mut self,
        class: ClassId,
        search: &Search<'_>,
        ends: [Pose; 2],
    ) -> Result<Vec<Pose>, Refusal> {
        let (cost, proof) = (&search.cost(), &search.proof());
        let analysis = self.analysis;
        let deepest = analysis.paving_behind(class).0.depth;
        for depth in coarsest(analysis.robot.dof()).min(deepest)..=deepest {
            let roadmap = self.roadmap(class, depth, cost);
            if let Some(path) = roadmap.path(analysis, proof, cost, ends) {
                return Ok(path);
            }
        }
        // Climbs join what boxes alone do not.
        let roadmap = self.roadmap(class, deepest, cost);
        if roadmap.build_bridges(analysis)
            && let Some(path) = roadmap.path(analysis, proof, cost, ends)
        {
            return Ok(path);
        }
        let straight = [ends[0], cost.beside(&ends[0], &ends[1])];
        if proof.holds(&straight[0], &straight[1]) {
            return Ok(straight.to_vec());
        }
        Err(Refusal::NotFound { depth: deepest, margins: proof.demand.margins })
    }

    fn roadmap(&mut self, class: ClassId, depth: u32, cost: &Cost<'_, 3>) -> &mut Roadmap {
        let made = &mut self.roadmaps[class.index()];
        match made.iter().position(|roadmap| roadmap.depth == depth) {
            Some(k) => &mut made[k],
            None => {
                made.push(Roadmap::new(self.analysis, class, depth, cost));
                let last = made.len() - 1;
                &mut made[last]
            }
        }
    }
}

/// The depth of the first roadmap that is tried.
fn coarsest(dof: usize) -> u32 {
    if dof == 2 { 8 } else { 5 }
}

impl Roadmap {
    /// A proved path over its boxes: from the start up to a box, from box to box, down to the goal.
    fn path(
        &self,
        analysis: &Analysis,
        proof: &Proof<'_>,
        cost: &Cost<'_, 3>,
        ends: [Pose; 2],
    ) -> Option<Vec<Pose>> {
        let [up, down] = ends.map(|end| self.access(analysis, proof, &end));
        let same = |a: &Access| down.iter().find(|b| self.spot(a.spot).piece == self.spot(b.spot).piece);
        let (a, b) = up.iter().find_map(|a| Some((a, same(a)?)))?;
        let margins = proof.demand.margins;
        let mut blocked = HashSet::new();
        for _ in 0..DETOURS {
            let way = self.way(cost, margins, &blocked, [a.spot, b.spot])?;
            let mut path = a.path.clone();
            let bad = way.windows(2).position(|pair| !self.go_on(proof, cost, &mut path, [pair[0], pair[1]]));
            match bad {
                Some(k) => blocked.extend([(way[k], way[k + 1]), (way[k + 1], way[k])]),
                None => {
                    for x in b.path.iter().rev() {
                        path.push(cost.beside(&path[path.len() - 1], x));
                    }
                    return Some(path);
                }
            }
        }
        None
    }

    /// Appends the way from a spot to its neighbour. With margins: if they are kept.
    fn go_on(
        &self,
        proof: &Proof<'_>,
        cost: &Cost<'_, 3>,
        path: &mut Vec<Pose>,
        [from, to]: [u32; 2],
    ) -> bool {
        let (here, there) = (self.spot(from), self.spot(to));
        let last = path[path.len() - 1];
        if let Some(bridge) = self.bridge(from, to) {
            let begin = path.len() - 1;
            for x in bridge {
                path.push(cost.beside(&path[path.len() - 1], &x));
            }
            return !proof.demand.margins.are_any()
                || path[begin..].windows(2).all(|ends| proof.holds(&ends[0], &ends[1]));
        }
        let (centre, next) = {
            let centre = cost.beside(&last, &here.centre);
            (centre, cost.beside(&centre, &there.centre))
        };
        let door = here.meeting(there, &centre, &next);
        path.extend([centre, door, next]);
        // Both halves lie in boxes that are proved to lie in the class; nothing is known of the margins yet.
        !proof.demand.margins.are_any() || (proof.holds(&centre, &door) && proof.holds(&door, &next))
    }

    /// Ways from a pose to boxes, by proved segments: the box it lies in, and those that a climb comes to.
    fn access(&self, analysis: &Analysis, proof: &Proof<'_>, end: &Pose) -> Vec<Access> {
        let n = proof.axes();
        let mut found: Vec<Access> = Vec::new();
        let mut path = vec![*end];
        let mut add = |path: &[Pose], pose: &[f64]| {
            if let Some(spot) = self.holding(analysis, pose)
                && found.iter().all(|access| self.spot(access.spot).piece != self.spot(spot).piece)
            {
                found.push(Access { path: path.to_vec(), spot });
            }
        };
        add(&path, &end[..n]);
        analysis.climb(&end[..n], self.class, &mut |pose| {
            let next = padded(pose);
            // The climb itself is proved to stay in the class, whatever its margins.
            if proof.demand.margins.are_any() && !proof.holds(&path[path.len() - 1], &next) {
                return true;
            }
            path.push(next);
            add(&path, pose);
            false
        });
        found
    }
}

/// A way from a pose to a box: the poses up to one that lies in it.
struct Access {
    path: Vec<Pose>,
    spot: u32,
}
