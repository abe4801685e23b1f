//! Planning through a class of aspects of a free body, over a roadmap that grows until it joins both ends.

use super::body::Pose;
use super::growth::Growth;
use super::roadmap::Roadmap;
use super::territory::Territory;
use super::{Effort, End, ExploreError, roaming};
use crate::aspect::DetSign;
use crate::motion::plan::refusal::common_sign;
use crate::motion::plan::shorten::improve;
use crate::motion::plan::{FINAL, Plan, PlanOptions, Refusal};
use crate::paving::Control;
use aspecta_kinematics::constraints::Demand;
use aspecta_robot::Robot;
use aspecta_robot::WorkingMode;
use aspecta_robot::num::padded;
use aspecta_robot::work::Stopwatch;

/// A path from `start` to `goal` in `mode`, proved segment by segment. Angles count modulo full turns, and (roll, pitch, yaw) means the same as
/// (roll + π, π − pitch, yaw + π): the last waypoint is the goal in coordinates that the motion arrives with.
///
/// # Errors
/// [`NoWay::Robot`] if roadmaps are not for this robot; else [`NoWay::Refused`]: [`Refusal::OppositeSigns`] proves that there is no path,
/// [`Refusal::NotJoined`] says that none was found.
///
/// # Examples
/// ```
/// use aspecta::motion::explore::{Effort, plan};
/// use aspecta::{Control, PlanOptions, Robot};
///
/// # fn main() -> Result<(), aspecta::Error> {
/// let robot = Robot::resolve("gough-stewart")?;
/// let mode = robot.working_modes()[0];
/// let pose = [0.535, -0.75, -0.39, -2.785, -0.973, 1.06];
/// let goal = [0.55, -0.75, -0.39, -2.785, -0.973, 1.06];
/// let effort = Effort { samples: 100, ..Effort::default() };
/// let found = plan(&robot, [&pose, &goal], mode, &PlanOptions::default(), &effort, &Control::unwatched())?;
/// assert!(aspecta::check_path(&robot, &found.waypoints, mode)?.is_sound());
/// # Ok(())
/// # }
/// ```
pub fn plan(
    robot: &Robot,
    [start, goal]: [&[f64]; 2],
    mode: WorkingMode,
    options: &PlanOptions,
    effort: &Effort,
    control: &Control<'_>,
) -> Result<Plan, NoWay> {
    let (begin, window) = (Stopwatch::start(), roaming(robot)?);
    if !robot.working_modes().contains(&mode) {
        return Err(Refusal::Mode(mode).into());
    }
    let det_a = common_sign(robot, &window, [start, goal], mode, options.margins)?;
    let demand = Demand { margins: options.margins, ..Demand::class(mode, det_a.factor()) };
    let territory = Territory::new(robot, &window, &demand, options.weight);
    let ends: [Pose; 2] = [start, goal].map(|pose| padded(&window.turned(pose)));
    let mut growth = Growth::new(territory, &ends);
    let end = growth.run(effort, begin, control);
    let way = if end == End::Joined { growth.roadmap.way(&growth.territory, 0, 1) } else { None };
    let Some(way) = way else {
        let (samples, seconds) = (growth.samples, begin.seconds());
        return Err(Refusal::NotJoined { samples, seconds, margins: options.margins }.into());
    };
    growth.territory.plan(&growth.roadmap, &way, mode, det_a).map_err(NoWay::from)
}

/// Why there is no path.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NoWay {
    /// Roadmaps are not for this robot.
    #[error(transparent)]
    Robot(#[from] ExploreError),
    /// A refusal: the poses are wrong, no path exists, or it could not be decided.
    #[error(transparent)]
    Refused(#[from] Refusal),
}

impl Territory<'_> {
    /// The way over a roadmap made worth driving, and proved once more.
    pub(super) fn plan(
        &self,
        roadmap: &Roadmap,
        way: &[u32],
        mode: WorkingMode,
        det_a: DetSign,
    ) -> Result<Plan, Refusal> {
        let poses: Vec<Pose> = way.iter().map(|&k| roadmap.spot(k).pose).collect();
        let path = improve(&self.proof, &self.cost, self.unrolled(&self.cut_short(poses)));
        if let Some(k) = path.windows(2).position(|w| !self.proof.holds_within(&w[0], &w[1], FINAL)) {
            return Err(Refusal::Unproved { pose: path[k].to_vec() });
        }
        Ok(Plan {
            robot: self.proof.robot.clone(),
            mode,
            det_a,
            aspect: None,
            length: path.windows(2).map(|ends| self.cost.distance(&ends[0], &ends[1])).sum(),
            waypoints: path.iter().map(|x| x.to_vec()).collect(),
            margins: self.proof.demand.margins,
        })
    }

    /// Leaves out detours: from each pose straight to the last one that is joined to it and no dearer so. Poses may be in any coordinates.
    fn cut_short(&self, mut path: Vec<Pose>) -> Vec<Pose> {
        let mut at = 0;
        while at + 2 < path.len() {
            let dear = |k: usize| {
                let all = path[at..=k].windows(2);
                all.map(|w| self.cost.of(&w[0], &self.beside(&w[0], &w[1]))).sum::<f64>()
            };
            let is_better = |&k: &usize| {
                let straight = self.beside(&path[at], &path[k]);
                self.cost.of(&path[at], &straight) <= dear(k) && self.joins(&path[at], &path[k])
            };
            if let Some(next) = (at + 2..path.len()).rev().find(is_better) {
                path.drain(at + 1..next);
            }
            at += 1;
        }
        path
    }

    /// Returns the path in coordinates that go on from each pose to the next.
    fn unrolled(&self, path: &[Pose]) -> Vec<Pose> {
        let mut all: Vec<Pose> = Vec::new();
        for pose in path {
            let next = all.last().map_or(*pose, |last| self.beside(last, pose));
            all.push(next);
        }
        all
    }
}
