//! Is a path free of singularities? Proved by intervals along every segment, not at samples.

use crate::kinematics::demand::Demand;
use crate::kinematics::modal::Constraint;
use crate::kinematics::path::{Along, Curve, along};
use crate::kinematics::{KinematicsError, WorkingMode};
use crate::robot::Robot;
use serde::Serialize;

/// Interval evaluations a segment may take before its check is given up as undecided.
const EFFORT: usize = 200_000;
/// Samples of a segment's profile.
const SAMPLES: usize = 100;

/// What was found of a path.
#[derive(Clone, Debug, Serialize)]
pub struct PathCheck {
    /// The working mode it was checked in.
    pub mode: WorkingMode,
    /// `Some(true)`: proved to meet no singularity (det A keeps its sign, no B_jj vanishes) anywhere along
    /// it. `Some(false)`: proved to meet one or to leave the workspace. `None`: undecided.
    pub singularity_free: Option<bool>,
    /// The same for joint limits; `Some(true)` if the robot has none.
    pub within_limits: Option<bool>,
    /// The first place at which something fails or cannot be decided.
    pub obstacle: Option<Obstacle>,
    /// The smallest |det A| met (numerical: sampled, then refined), up to the obstacle's segment.
    pub min_abs_det_a: Extreme,
    /// Joint vector at the start and at the end, if they are in reach.
    pub ends: [Option<Vec<f64>>; 2],
    /// Figure 11: det A and B_jj along the path, each divided by its largest modulus. Numerical.
    pub profile: Vec<ProfilePoint>,
}

/// Where a path fails, or is in doubt.
#[derive(Clone, Debug, Serialize)]
pub struct Obstacle {
    /// Segment, from 1.
    pub segment: usize,
    /// Start and end of the stretch, t ∈ [0, 1] along the segment.
    pub t: (f64, f64),
    /// Pose at the middle of the stretch.
    pub pose: Vec<f64>,
    /// What fails there.
    pub constraint: Constraint,
    /// Whether the failure is proved (else undecided).
    pub proved: bool,
}

/// The smallest |det A| along a path.
#[derive(Clone, Debug, Serialize)]
pub struct Extreme {
    /// |det A|.
    pub value: f64,
    /// Where: the pose,
    pub pose: Vec<f64>,
    /// the segment, from 1,
    pub segment: usize,
    /// and t ∈ [0, 1] along it.
    pub t: f64,
}

/// One sample of figure 11.
#[derive(Clone, Debug, Serialize)]
pub struct ProfilePoint {
    /// Segment, from 1.
    pub segment: usize,
    /// t ∈ [0, 1] along the segment.
    pub t: f64,
    /// The pose.
    pub pose: Vec<f64>,
    /// The joint vector.
    pub q: Vec<f64>,
    /// det A over its largest modulus along the path.
    pub relative_det_a: f64,
    /// B_jj over their largest moduli.
    pub relative_b: Vec<f64>,
}

/// Why a path cannot be checked at all.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PathError {
    /// Fewer than two poses.
    #[error("a path needs at least two poses, but {0} given")]
    TooShort(usize),
    /// A pose does not fit the robot.
    #[error("pose {row} of the path: {error}")]
    Pose {
        /// Row, from 1.
        row: usize,
        /// What is wrong.
        error: KinematicsError,
    },
    /// The mode does not fit the robot.
    #[error("`{mode}` is not a working mode of robot `{robot}`: its modes are {known}")]
    Mode {
        /// The mode asked for.
        mode: WorkingMode,
        /// The robot.
        robot: String,
        /// Its modes.
        known: String,
    },
    /// The first pose is out of reach.
    #[error("the path starts out of reach: leg {leg} cannot close at pose 1")]
    StartOutOfReach {
        /// Leg number, from 1.
        leg: usize,
    },
    /// The first pose is singular, as far as intervals can tell.
    #[error("the path starts in a singularity, or too near to one to tell the sign of det A or of a B_jj")]
    StartSingular,
}

/// Checks the path of straight segments (in pose coordinates; angles as real numbers, so a turn from 3 to −3 rad goes
/// the long way) through `poses` in `mode`.
///
/// *Proved* rests on [`along`]: the constraints are > 0 in intervals over stretches that cover every segment. The path is
/// followed up to its first obstacle.
///
/// # Errors
/// [`PathError`] if the poses or the mode do not fit the robot, or if the start is out of reach or singular.
pub fn check_path(robot: &Robot, poses: &[Vec<f64>], mode: WorkingMode) -> Result<PathCheck, PathError> {
    check_input(robot, poses, mode)?;
    let mut unlimited = robot.clone();
    unlimited.legs.iter_mut().for_each(|leg| leg.limits.clear());
    let sign = sign_at(&unlimited, mode, &poses[0]).ok_or(PathError::StartSingular)?;
    let (singular, sound) = first_obstacle(&unlimited, poses, mode, sign);
    let limited = robot.legs.iter().any(|leg| !leg.limits.is_empty());
    let (limit, within) = if limited { first_obstacle(robot, poses, mode, sign) } else { (None, Some(true)) };
    let within = match &limit {
        Some(o) if !matches!(o.constraint, Constraint::Limit(..)) => None,
        _ => within,
    };
    let last = singular.as_ref().map_or(poses.len() - 1, |o| o.segment);
    let ends =
        [poses.first(), poses.last()].map(|p| p.and_then(|p| robot.inverse_in(p, mode).ok().flatten()));
    Ok(PathCheck {
        mode,
        singularity_free: sound,
        within_limits: within,
        obstacle: singular.or(limit),
        min_abs_det_a: smallest_det(robot, &poses[..=last], mode),
        ends,
        profile: profile(robot, &poses[..=last], mode),
    })
}

fn check_input(robot: &Robot, poses: &[Vec<f64>], mode: WorkingMode) -> Result<(), PathError> {
    if poses.len() < 2 {
        return Err(PathError::TooShort(poses.len()));
    }
    for (k, pose) in poses.iter().enumerate() {
        robot.check_pose(pose).map_err(|error| PathError::Pose { row: k + 1, error })?;
    }
    let modes = robot.working_modes();
    if !modes.contains(&mode) {
        let known = modes.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
        return Err(PathError::Mode { mode, robot: robot.name.clone(), known });
    }
    let legs = robot.leg_solutions(&poses[0]).map_err(|error| PathError::Pose { row: 1, error })?;
    match legs.iter().position(|leg| leg.q.iter().all(Option::is_none)) {
        Some(k) => Err(PathError::StartOutOfReach { leg: k + 1 }),
        None => Ok(()),
    }
}

/// The proved sign of det A at a pose inside the mode.
fn sign_at(robot: &Robot, mode: WorkingMode, pose: &[f64]) -> Option<i8> {
    [1, -1].into_iter().find(|&sign| Along::is_inside(robot, &Demand::class(mode, sign), [pose, pose], 1))
}

/// The first obstacle, and whether the path is proved sound.
fn first_obstacle(
    robot: &Robot,
    poses: &[Vec<f64>],
    mode: WorkingMode,
    sign: i8,
) -> (Option<Obstacle>, Option<bool>) {
    for (k, ends) in poses.windows(2).enumerate() {
        let (constraint, from, to, proved) =
            match along(robot, &Demand::class(mode, sign), &Curve::segment(&ends[0], &ends[1]), EFFORT) {
                Along::Inside | Along::Crossed { .. } => continue,
                Along::Outside { constraint, from, to } => (constraint, from, to, true),
                Along::Undecided { constraint, from, to } => (constraint, from, to, false),
            };
        let pose = at(&ends[0], &ends[1], 0.5 * (from + to));
        let obstacle = Obstacle { segment: k + 1, t: (from, to), pose, constraint, proved };
        return (Some(obstacle), proved.then_some(false));
    }
    (None, Some(true))
}

fn at(start: &[f64], end: &[f64], t: f64) -> Vec<f64> {
    start.iter().zip(end).map(|(a, b)| a + t * (b - a)).collect()
}

/// det A at a pose, if in reach.
fn det_at(robot: &Robot, pose: &[f64], mode: WorkingMode) -> Option<f64> {
    let q = robot.inverse_in(pose, mode).ok()??;
    robot.jacobians(pose, &q).ok().map(|j| j.det_a())
}

/// Sampled along each segment, then refined between the neighbours of the best sample.
fn smallest_det(robot: &Robot, poses: &[Vec<f64>], mode: WorkingMode) -> Extreme {
    let mut best = Extreme { value: f64::INFINITY, pose: poses[0].clone(), segment: 1, t: 0.0 };
    for (k, ends) in poses.windows(2).enumerate() {
        let value = |t: f64| det_at(robot, &at(&ends[0], &ends[1], t), mode).map_or(f64::INFINITY, f64::abs);
        let step = 1.0 / SAMPLES as f64;
        let sampled = (0..=SAMPLES).map(|i| i as f64 * step).min_by(|a, b| value(*a).total_cmp(&value(*b)));
        let Some(t) = sampled.map(|t| refine(&value, t, step)) else { continue };
        if value(t) < best.value {
            best = Extreme { value: value(t), pose: at(&ends[0], &ends[1], t), segment: k + 1, t };
        }
    }
    best
}

/// The minimum near `t`, by thirds.
fn refine(value: &impl Fn(f64) -> f64, t: f64, step: f64) -> f64 {
    let (mut lo, mut hi) = ((t - step).max(0.0), (t + step).min(1.0));
    for _ in 0..60 {
        let (a, b) = (lo + (hi - lo) / 3.0, hi - (hi - lo) / 3.0);
        if value(a) <= value(b) { hi = b } else { lo = a }
    }
    let middle = 0.5 * (lo + hi);
    if value(middle) <= value(t) { middle } else { t }
}

fn profile(robot: &Robot, poses: &[Vec<f64>], mode: WorkingMode) -> Vec<ProfilePoint> {
    let mut points = Vec::new();
    for (k, ends) in poses.windows(2).enumerate() {
        for i in 0..=SAMPLES {
            let t = i as f64 / SAMPLES as f64;
            let pose = at(&ends[0], &ends[1], t);
            let Some(q) = robot.inverse_in(&pose, mode).ok().flatten() else { continue };
            let Ok(jacobians) = robot.jacobians(&pose, &q) else { continue };
            let relative_det_a = jacobians.det_a();
            points.push(ProfilePoint { segment: k + 1, t, pose, q, relative_det_a, relative_b: jacobians.b });
        }
    }
    normalise(&mut points);
    points
}

fn normalise(points: &mut [ProfilePoint]) {
    let largest = |f: &dyn Fn(&ProfilePoint) -> f64| {
        let most = points.iter().map(|p| f(p).abs()).fold(0.0, f64::max);
        if most > 0.0 { most } else { 1.0 }
    };
    let det = largest(&|p| p.relative_det_a);
    let legs = points.first().map_or(0, |p| p.relative_b.len());
    let b: Vec<f64> = (0..legs).map(|j| largest(&|p| p.relative_b[j])).collect();
    for p in points {
        p.relative_det_a /= det;
        p.relative_b.iter_mut().zip(&b).for_each(|(x, most)| *x /= most);
    }
}
