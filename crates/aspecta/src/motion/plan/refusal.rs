//! Why there is no plan.

use crate::aspect::{Analysis, AspectId, ClassId, DetSign};
use aspecta_kinematics::constraints::{Demand, Kind, Margins};
use aspecta_kinematics::path::curve::{Along, Curve, along};
use aspecta_kinematics::{KinematicsError, WorkingMode, check_pose};
use aspecta_robot::num::count;
use aspecta_robot::{LegIndex, Robot, Window};
use serde::Serialize;
use std::fmt;

/// Which end of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum End {
    /// The start.
    Start,
    /// The goal.
    Goal,
}

impl fmt::Display for End {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if *self == Self::Start { "start" } else { "goal" })
    }
}

/// Why there is no plan. [`Refusal::is_proof`] tells which of these prove that none exists.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Refusal {
    /// No pose of this robot.
    #[error("the {end}: {error}")]
    Pose {
        /// Which.
        end: End,
        /// The error.
        error: KinematicsError,
    },
    /// No working mode that was analysed.
    #[error("working mode {0} was not analysed, or the robot has no such mode")]
    Mode(WorkingMode),
    /// Outside the window that the robot file sets.
    #[error("the {0} lies outside the [window] of the robot file")]
    Window(End),
    /// A leg does not reach it (proved).
    #[error("leg {leg} does not reach the {end}: proved")]
    OutOfReach {
        /// Which end.
        end: End,
        /// The leg.
        leg: LegIndex,
    },
    /// A limit of the machine forbids it (proved).
    #[error("the {end} is beyond the {limit}: proved")]
    BeyondLimit {
        /// Which end.
        end: End,
        /// The limit's name.
        limit: String,
    },
    /// On the boundary of an aspect, or too near to it to tell.
    #[error("the {0} is singular or on a joint limit, or too near to tell which side it is on")]
    OnBoundary(End),
    /// An end does not keep the margins (proved, or not excluded).
    #[error("the {0} itself is nearer to a singularity than the margins allow")]
    Margins(End),
    /// det A has two signs (proved): see [`super`].
    #[error(
        "no such path exists, proved: det A is {} at the start and {} at the goal, so every path between them in this working mode meets \
         a parallel singularity", word(*.0), word(.0.opposite())
    )]
    OppositeSigns(DetSign),
    /// The two poses lie in two aspects of one class (certified).
    #[error(
        "no such path exists, proved: the start and the goal lie in two aspects of mode {mode}, both with det A {}; changes of working mode \
         may lead from one to the other", word(*.det_a)
    )]
    DifferentAspects {
        /// The mode.
        mode: WorkingMode,
        /// The sign of det A.
        det_a: DetSign,
        /// The aspect of the start.
        start: AspectId,
        /// The aspect of the goal.
        goal: AspectId,
    },
    /// Neither a path nor a proof that there is none.
    #[error(
        "undecided: no path was found over boxes down to depth {depth}{}, and none is excluded; finer boxes may tell",
        if .margins.are_any() { " with these margins" } else { "" }
    )]
    NotFound {
        /// The finest boxes looked at.
        depth: u32,
        /// The margins asked for.
        margins: Margins,
    },
    /// Neither a path nor a proof that there is none, by a roadmap ([`crate::motion::explore`]).
    #[error(
        "undecided: could not be joined within the budget ({}, {seconds:.1} s){}, and no path is excluded",
        count(*.samples, "sample", "samples"),
        if .margins.are_any() { " with these margins" } else { "" }
    )]
    NotJoined {
        /// Poses drawn.
        samples: usize,
        /// How long it took.
        seconds: f64,
        /// The margins asked for.
        margins: Margins,
    },
    /// The search was stopped.
    #[error("undecided: the search was stopped before a path was found, and none is excluded")]
    Stopped,
    /// A path was found, but one of its segments could not be proved.
    #[error("undecided: a path was found, but not proved from {pose:?} on")]
    Unproved {
        /// The pose at which the segment begins.
        pose: Vec<f64>,
    },
}

pub(in crate::motion) fn word(sign: DetSign) -> &'static str {
    if sign == DetSign::Positive { "positive" } else { "negative" }
}

impl Refusal {
    /// Whether it proves that no such path exists.
    pub fn is_proof(&self) -> bool {
        matches!(
            self,
            Self::OppositeSigns(_)
                | Self::DifferentAspects { .. }
                | Self::OutOfReach { .. }
                | Self::BeyondLimit { .. }
                | Self::Window(_)
        )
    }

    /// Whether what was asked for is no question about this robot.
    pub fn is_bad_input(&self) -> bool {
        matches!(self, Self::Pose { .. } | Self::Mode(_))
    }
}

/// The sign of det A at both ends, proved, as is that the ends keep the margins.
pub(in crate::motion) fn common_sign(
    robot: &Robot,
    window: &Window,
    ends: [&[f64]; 2],
    mode: WorkingMode,
    margins: Margins,
) -> Result<DetSign, Refusal> {
    let [start, goal] = [(End::Start, ends[0]), (End::Goal, ends[1])];
    let signs = [sign_at(robot, window, start, mode)?, sign_at(robot, window, goal, mode)?];
    if signs[0] != signs[1] {
        return Err(Refusal::OppositeSigns(signs[0]));
    }
    let demand = Demand { margins, ..Demand::class(mode, signs[0].factor()) };
    let keeps = |pose: &[f64]| Along::is_inside(robot, &demand, [pose, pose], 1);
    match [start, goal].into_iter().find(|(_, pose)| !keeps(pose)) {
        Some((end, _)) => Err(Refusal::Margins(end)),
        None => Ok(signs[0]),
    }
}

/// The sign of det A at a pose that is proved to lie in a class.
pub(in crate::motion) fn sign_at(
    robot: &Robot,
    window: &Window,
    (end, pose): (End, &[f64]),
    mode: WorkingMode,
) -> Result<DetSign, Refusal> {
    check_pose(robot, pose).map_err(|error| Refusal::Pose { end, error })?;
    if !window.holds(&window.turned(pose)) && robot.window.iter().any(Option::is_some) {
        return Err(Refusal::Window(end));
    }
    let at =
        |sign: DetSign| along(robot, &Demand::class(mode, sign.factor()), &Curve::segment(pose, pose), 1);
    for sign in [DetSign::Positive, DetSign::Negative] {
        match at(sign) {
            Along::Inside => return Ok(sign),
            Along::Outside { constraint, .. } => match constraint.kind() {
                Kind::Serial(leg) => return Err(Refusal::OutOfReach { end, leg }),
                Kind::Limit => return Err(Refusal::BeyondLimit { end, limit: constraint.named(robot) }),
                Kind::Parallel => {}
            },
            Along::Crossed { .. } | Along::Undecided { .. } => {}
        }
    }
    Err(Refusal::OnBoundary(end))
}

/// The class that both ends lie in, and their aspect: where both are known and differ, there is no path.
pub(super) fn common_aspect(
    analysis: &Analysis,
    ends: [&[f64]; 2],
    mode: WorkingMode,
    det_a: DetSign,
) -> Result<(ClassId, Option<AspectId>), Refusal> {
    let class = analysis.class_of(mode, det_a).ok_or(Refusal::Mode(mode))?;
    let [start, goal] = ends.map(|pose| aspect_at(analysis, pose, class));
    match (start, goal) {
        (Some(start), Some(goal)) if start != goal => {
            Err(Refusal::DifferentAspects { mode, det_a, start, goal })
        }
        _ => Ok((class, start.or(goal))),
    }
}

/// The aspect of a pose that is proved to lie in a class.
pub(in crate::motion) fn aspect_at(analysis: &Analysis, pose: &[f64], class: ClassId) -> Option<AspectId> {
    let entry = &analysis.classes[class.index()];
    match (&entry.aspects[..], entry.high) {
        ([only], Some(1)) => Some(only.id),
        _ => analysis.aspect_at(pose, class),
    }
}
