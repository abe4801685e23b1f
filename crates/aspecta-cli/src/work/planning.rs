//! The common part of commands that plan motions: what they plan over, and what is written of a plan.

use super::timing;
use super::watch::{abandoned_if_cancelled, unkept, watched, within_seconds};
use crate::args::budget;
use crate::args::planning::{Analysing, Moving, Planning};
use crate::failure::Failure;
use crate::output::{Labels, brief, note};
use aspecta::Kinematics;
use aspecta::aspect::{Analysis, Options, Purpose, analyze};
use aspecta::kinematics::WorkingMode;
use aspecta::motion::ProfilePoint;
use aspecta::motion::explore::{self, Effort, NoWay};
use aspecta::motion::modes::{Configuration, ModeGraph, NoRoute, Route, check_ends};
use aspecta::motion::plan::{Plan, PlanOptions, Planner, Refusal};
use aspecta::motion::time::{Piece, Row, Trajectory, Waypoint, trajectory};
use aspecta::paving::{Budget, Control, Stop};
use aspecta::robot::Robot;
use aspecta_view::Motion;
use std::sync::Arc;

/// How often finer boxes are tried where they may tell more and no budget is given.
const FINER: u32 = 2;

impl Analysing {
    /// The aspects of a robot, or of some of its modes (none: all), and what `work` makes of them. A time
    /// budget is for both: what the aspects leave of it, half at least, is for the rest.
    pub fn with<T>(
        &self,
        robot: &Robot,
        modes: &[WorkingMode],
        mut work: impl FnMut(&Arc<Analysis>, &Control<'_>) -> Result<T, Failure>,
    ) -> Result<T, Failure> {
        self.with_finer(robot, modes, |analysis, control| Ok((work(analysis, control)?, false)))
    }

    /// [`Analysing::with`], once more over finer boxes where `work` says that they may tell more, [`FINER`]
    /// times at most and only if no budget is given.
    pub fn with_finer<T>(
        &self,
        robot: &Robot,
        modes: &[WorkingMode],
        mut work: impl FnMut(&Arc<Analysis>, &Control<'_>) -> Result<(T, bool), Failure>,
    ) -> Result<T, Failure> {
        let mut budget = self.budget.unwrap_or_else(|| Budget::coarse(robot.dof()));
        let seconds = budget.seconds;
        budget.seconds = seconds.map(|seconds| 0.5 * seconds);
        // In the plane all modes cost nothing to speak of, and aspects then have the numbers of `analyze`.
        let modes = if robot.dof() == 2 { &[] } else { modes };
        let mut finer = if self.budget.is_none() { FINER } else { 0 };
        let mut all = |control: &Control<'_>| loop {
            let options =
                Options { budget, modes: modes.to_vec(), purpose: Purpose::Boxes, ..Options::default() };
            let analysis = unkept(|| analyze(robot, &options, control))?;
            if analysis.run.stop == Stop::Cancelled {
                note("the time was over: what follows rests on the aspects found so far");
            }
            let (result, more) = work(&Arc::new(analysis), control)?;
            if !more || finer == 0 || control.is_cancelled() {
                return Ok(result);
            }
            finer -= 1;
            budget.depth = budget.depth.map(|depth| depth + 1);
        };
        watched(self.threads, |control| within_seconds(seconds, control, &mut all))?
    }
}

/// The plan that is found without aspects, where that is good enough.
pub fn without_aspects(
    robot: &Robot,
    ends: [&[f64]; 2],
    mode: WorkingMode,
    options: &PlanOptions,
) -> Option<Plan> {
    let window = robot.slice(&[]).ok()?;
    Planner::without_aspects(robot, &window, ends, mode, options).ok().flatten()
}

/// The route between two configurations within their working mode, or through changes of it.
///
/// # Errors
/// Why there is none: also that its search, of which nothing can be kept, was cancelled.
pub fn route(
    analysis: &Arc<Analysis>,
    ends: [Configuration<'_>; 2],
    through: bool,
    options: &PlanOptions,
    control: &Control<'_>,
) -> Result<Route, NoRoute> {
    let (analysis, options) = (Arc::clone(analysis), *options);
    let ends = ends.map(|end| (end.pose.to_vec(), end.mode));
    let look = move || {
        let [start, goal] = ends.each_ref().map(|(pose, mode)| Configuration { pose, mode: *mode });
        let mut planner = Planner::new(&analysis);
        if through {
            let graph = ModeGraph::new(&analysis, &Control::unwatched());
            return planner.route(&graph, start, goal, &options);
        }
        Ok(planner.plan(start.pose, goal.pose, start.mode, &options)?.into())
    };
    abandoned_if_cancelled(control, look).unwrap_or(Err(Refusal::Stopped.into()))
}

/// Samples of a roadmap that is to join given poses, if no number is given.
const SAMPLES: u32 = 20_000;

impl Planning {
    /// Returns the reason why there is no motion, if the two ends alone give one, before aspects are looked
    /// for. Not for free bodies.
    pub fn refused(
        &self,
        robot: &Robot,
        [start, goal]: [Configuration<'_>; 2],
        through: bool,
        options: &PlanOptions,
    ) -> Result<Option<Planned>, Failure> {
        self.paved(robot)?;
        let refusal = robot.slice(&[]).ok().and_then(|window| {
            if through {
                return check_ends(robot, &window, [start, goal]).err();
            }
            let ends = [start.pose, goal.pose];
            Planner::check_ends(robot, &window, ends, start.mode, options).err().map(NoRoute::from)
        });
        Ok(refusal.map(Planned::from))
    }

    /// Returns how a robot that is no free body is analysed.
    pub fn paved(&self, robot: &Robot) -> Result<&Analysing, Failure> {
        match self.samples {
            None => Ok(&self.analysing),
            Some(samples) => Err(Failure::Input(format!(
                "--samples {samples}: `{}` is no free body, its aspects are paved with boxes (--budget)",
                robot.name
            ))),
        }
    }

    /// Returns the result of `work` on a free body, with the effort its roadmaps may take.
    pub fn explore<T>(
        &self,
        work: impl FnOnce(&Effort, &Control<'_>) -> Result<T, Failure>,
    ) -> Result<T, Failure> {
        let effort = budget::effort(self.analysing.budget, self.samples.unwrap_or(SAMPLES))?;
        watched(self.analysing.threads, |control| work(&effort, control))?
    }
}

/// The path over a roadmap of a free body, or why there is none.
///
/// # Errors
/// [`Failure::Explore`].
pub fn plan_over_roadmap(
    robot: &Robot,
    ends: [&[f64]; 2],
    mode: WorkingMode,
    options: &PlanOptions,
    (effort, control): (&Effort, &Control<'_>),
) -> Result<Result<Route, NoRoute>, Failure> {
    match explore::plan(robot, ends, mode, options, effort, control) {
        Ok(plan) => Ok(Ok(plan.into())),
        Err(NoWay::Refused(refusal)) => Ok(Err(refusal.into())),
        Err(NoWay::Robot(error)) => Err(error.into()),
    }
}

/// The outcome of planning.
pub struct Planned {
    /// The route, or why there is none.
    pub result: Result<Route, NoRoute>,
    /// The motion under joint limits, if it was asked for.
    motion: Option<Trajectory>,
    /// The page that plays it, if it was asked for.
    pub page: Option<String>,
}

impl From<NoRoute> for Planned {
    fn from(refusal: NoRoute) -> Self {
        Self { result: Err(refusal), motion: None, page: None }
    }
}

impl Planning {
    /// The result with what is wanted besides: the motion under joint limits, and the page that plays it, with the
    /// aspects that were analysed, and in its own time where the motion has one.
    pub fn film(
        &self,
        robot: &Robot,
        analysis: Option<&Analysis>,
        result: Result<Route, NoRoute>,
    ) -> Result<Planned, Failure> {
        let route = match result {
            Ok(route) => route,
            Err(refusal) => return Ok(refusal.into()),
        };
        let timed = self.moving.motion(robot, &route, self.shown.deg)?;
        let page = || {
            let mut motion = Motion::new(robot);
            if let Some(analysis) = analysis {
                motion = motion.within(analysis);
            }
            let samples = match &timed {
                Some(trajectory) => vec![timed_samples(robot, trajectory)?],
                None => untimed_samples(&route.pieces(robot)),
            };
            for piece in samples.iter().flat_map(|piece| piece.chunk_by(|a, b| a.0.mode == b.0.mode)) {
                motion = motion.then(piece[0].0.mode, &profile(piece));
            }
            if timed.is_some() {
                motion = motion.timed(&samples.iter().flatten().map(|sample| sample.1).collect::<Vec<_>>());
            }
            Ok::<_, Failure>(motion.page())
        };
        let page = self.moving.out.directory().map(|_| page()).transpose()?;
        Ok(Planned { result: Ok(route), motion: timed, page })
    }
}

/// Frames a second of a page that plays a motion in its own time, and the most of all.
const FRAMES: (f64, f64) = (50.0, 2000.0);

/// The samples of each piece.
fn untimed_samples(pieces: &[Piece]) -> Vec<Vec<(Waypoint, f64)>> {
    pieces.iter().map(|piece| piece.samples.iter().map(|sample| (sample.clone(), 0.0)).collect()).collect()
}

/// The motion from frame to frame, each with its time.
fn timed_samples(robot: &Robot, motion: &Trajectory) -> Result<Vec<(Waypoint, f64)>, Failure> {
    let rate = FRAMES.0.min(FRAMES.1 / motion.total_time());
    let sample = |row: Row| {
        let mode = robot.jacobians(&row.pose, &row.q)?.mode();
        Ok((Waypoint { mode, pose: row.pose, q: row.q }, row.time))
    };
    motion.rows(rate).map(sample).collect()
}

impl Moving {
    /// The motion under joint limits, if it is wanted.
    fn motion(&self, robot: &Robot, route: &Route, degrees: bool) -> Result<Option<Trajectory>, Failure> {
        let (Some(_), Some(speed), Some(acceleration)) = (&self.trajectory, &self.speed, &self.acceleration)
        else {
            return Ok(None);
        };
        self.rate.check()?;
        let limits = timing::limits(robot, speed, acceleration, degrees)?;
        let motion = trajectory(&route.pieces(robot), &limits)?;
        timing::check_length(&motion, self.rate.rate)?;
        Ok(Some(motion))
    }

    /// Writes what was asked for, and says so.
    pub fn write(&self, robot: &Robot, planned: &Planned, degrees: bool) -> Result<Option<String>, Failure> {
        let (Some(path), Some(motion)) = (&self.trajectory, &planned.motion) else { return Ok(None) };
        let written = timing::write("--trajectory", path, robot, motion, self.rate.rate)?;
        let (time, strays) =
            (brief(motion.total_time()), Labels::joints(robot, degrees).sentence(motion.path_error()));
        Ok(Some(format!("{written}\ntotal time: {time} s; joints stray from the plan by about {strays}")))
    }
}

/// Samples as the page of a motion takes them, which computes the determinants itself.
fn profile(samples: &[(Waypoint, f64)]) -> Vec<ProfilePoint> {
    let last = samples.len().saturating_sub(1).max(1) as f64;
    let point = |(k, (at, _)): (usize, &(Waypoint, f64))| ProfilePoint {
        segment: 1,
        t: k as f64 / last,
        pose: at.pose.clone(),
        q: at.q.clone(),
        mode: at.mode,
        relative_det_a: 0.0,
        relative_b: Vec::new(),
    };
    samples.iter().enumerate().map(point).collect()
}
