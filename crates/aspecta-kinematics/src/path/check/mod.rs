//! Is a path free of singularities? Proved by intervals everywhere along it, not at samples.
//!
//! Paths of poses are checked in a working mode ([`check_path`], [`check_poses`]); paths of joint vectors from a direct solution on
//! ([`check_joints`]), by following it as [`Follower`](crate::follow::Follower) does.

mod clearance;
mod error;
mod join;
mod joints;
mod obstacle;
mod profile;
mod window;

pub use crate::constraints::Bound;
pub use clearance::{Clearance, Least};
pub use error::PathError;
pub use join::Joined;
pub use joints::check_joints;
pub use obstacle::{Asked, Obstacle};
pub use profile::ProfilePoint;

use crate::Kinematics;
use crate::constraints::{Demand, Margins, is_limited};
use crate::path::curve::{Along, Curve, along};
use crate::path::units;
use aspecta_robot::{LegIndex, Robot, WorkingMode};
use clearance::{PoseStretch, clearance};
use serde::Serialize;

/// Interval evaluations a segment may take before its check is given up as undecided.
const EFFORT: usize = 200_000;

/// The way in which a path's samples are joined, and the demands on it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct PathOptions {
    /// How its samples are joined.
    pub joined: Joined,
    /// How far it must stay from singularities.
    pub margins: Margins,
}

/// The result of checking a path.
#[derive(Clone, Debug, Serialize)]
#[non_exhaustive]
pub struct PathCheck {
    /// The robot.
    #[serde(skip)]
    pub robot: Robot,
    /// How many samples it was given in.
    #[serde(skip)]
    pub samples: usize,
    /// Whether these are joint vectors; else poses.
    #[serde(skip)]
    pub of_joints: bool,
    /// How its samples were joined. With [`Joined::None`] all that is said is of the samples alone.
    pub joined: Joined,
    /// The working mode: of a path of joint vectors, the one it starts in.
    pub mode: WorkingMode,
    /// `Some(true)`: proved to meet no singularity (det A keeps its sign, no B_jj vanishes) anywhere along
    /// it. `Some(false)`: proved to meet one or to leave the workspace. `None`: undecided.
    pub singularity_free: Option<bool>,
    /// Whether it is proved to keep the margins asked for. `Some(true)` if none are; `None` also where a singularity comes first.
    pub keeps_margins: Option<bool>,
    /// Whether it stays within joint limits and the robot's window, likewise; `Some(true)` if it has none.
    pub within_limits: Option<bool>,
    /// The margins asked for.
    pub margins: Margins,
    /// The first place at which something fails or cannot be decided.
    pub obstacle: Option<Obstacle>,
    /// The places where other demands fail further on, each for the first time.
    pub further: Vec<Obstacle>,
    /// How near it comes to singularities, up to the first it meets. Certified. `None` if there is no path before that.
    pub clearance: Option<Clearance>,
    /// Joint vector at the start and at the end, if they are in reach.
    pub ends: [Option<Vec<f64>>; 2],
    /// Pose at the start, and at the end if the path gets there.
    pub end_poses: [Option<Vec<f64>>; 2],
    /// Figure 11: det A and B_jj along the path, each divided by its largest modulus. Numerical.
    pub profile: Vec<ProfilePoint>,
}

impl PathCheck {
    /// Returns the check with the first obstacles to each [`Asked`], in its order, of a path of poses; the rest is empty.
    fn new(robot: &Robot, mode: WorkingMode, options: &PathOptions, found: [Option<Obstacle>; 3]) -> Self {
        let verdict = |o: &Option<Obstacle>| match o {
            None => Some(true),
            Some(o) if o.is_of_its_own(&options.margins) => o.proved.then_some(false),
            Some(_) => None,
        };
        let [singularity_free, keeps_margins, within_limits] = [0, 1, 2].map(|k| verdict(&found[k]));
        let own = found.into_iter().flatten().filter(|o| o.is_of_its_own(&options.margins));
        let mut further: Vec<_> = own.collect();
        further.sort_by(Obstacle::by_place);
        let obstacle = if further.is_empty() { None } else { Some(further.remove(0)) };
        Self {
            robot: robot.clone(),
            samples: 0,
            of_joints: false,
            joined: options.joined,
            mode,
            singularity_free,
            keeps_margins,
            within_limits,
            margins: options.margins,
            obstacle,
            further,
            clearance: None,
            ends: [None, None],
            end_poses: [None, None],
            profile: Vec::new(),
        }
    }

    /// Whether all that was asked is proved.
    pub fn is_sound(&self) -> bool {
        [self.singularity_free, self.keeps_margins, self.within_limits] == [Some(true); 3]
    }
}

impl PathOptions {
    fn check(&self) -> Result<(), PathError> {
        let Margins { parallel, serial } = self.margins;
        let asked = [(parallel, "|det Â|"), (serial, "|B_jj| / max")];
        match asked.into_iter().find(|(value, _)| !(0.0..1.0).contains(value)) {
            Some((value, of)) => Err(PathError::Margin { value, of }),
            None => Ok(()),
        }
    }
}

/// Checks the path of straight segments (in pose coordinates; angles as real numbers, so a turn from 3 to −3 rad goes
/// the long way) through `poses` in `mode`: [`check_poses`] with nothing else asked.
///
/// # Errors
/// As [`check_poses`].
///
/// # Examples
/// ```
/// use aspecta_kinematics::path::check_path;
/// use aspecta_robot::catalogue;
///
/// let robot = catalogue::find("five-bar").unwrap();
/// let mode = "++".parse().unwrap();
/// let check = check_path(&robot, &[vec![4.0, 7.0], vec![4.5, 7.5]], mode)?;
/// assert!(check.is_sound());
///
/// // Straight up, leg 2 is stretched 5/7 of the way.
/// let check = check_path(&robot, &[vec![4.0, 7.0], vec![4.0, 14.0]], mode)?;
/// assert_eq!(check.singularity_free, Some(false));
/// assert!((check.obstacle.unwrap().t.0 - 5.0 / 7.0).abs() < 1e-6);
/// # Ok::<(), aspecta_kinematics::path::PathError>(())
/// ```
pub fn check_path(robot: &Robot, poses: &[Vec<f64>], mode: WorkingMode) -> Result<PathCheck, PathError> {
    check_poses(robot, poses, mode, &PathOptions::default())
}

/// Checks the path through `poses` in `mode`.
///
/// *Proved* rests on [`along`]: the constraints are > 0 in intervals over stretches that cover every segment, or at every sample
/// if they are not joined. The path is followed up to the first place at which it meets a singularity or leaves the workspace.
///
/// # Errors
/// [`PathError`] if the poses or the mode do not fit the robot, or if the start is out of reach or singular.
///
/// # Examples
/// ```
/// use aspecta_kinematics::constraints::Margins;
/// use aspecta_kinematics::path::{Joined, PathOptions, check_poses};
/// use aspecta_robot::catalogue;
///
/// let robot = catalogue::find("five-bar").unwrap();
/// let poses = [vec![4.0, 7.0], vec![4.5, 7.5], vec![5.0, 7.0]];
/// let margins = Margins { parallel: 0.01, serial: 0.01 };
/// let options = PathOptions { joined: Joined::Spline, margins };
/// let check = check_poses(&robot, &poses, "++".parse().unwrap(), &options)?;
/// assert_eq!(check.keeps_margins, Some(true));
/// let clearance = check.clearance.unwrap();
/// assert!(clearance.parallel.at_least > 0.01 && clearance.parallel.at_least <= clearance.parallel.at_most);
/// # Ok::<(), aspecta_kinematics::path::PathError>(())
/// ```
pub fn check_poses(
    robot: &Robot,
    poses: &[Vec<f64>],
    mode: WorkingMode,
    options: &PathOptions,
) -> Result<PathCheck, PathError> {
    check_input(robot, poses, mode, options)?;
    let sign = sign_at(robot, mode, &poses[0]).ok_or(PathError::StartSingular)?;
    let PathOptions { joined, margins } = *options;
    let curves = join::join(poses, &units(robot)[..robot.dof()], joined);
    let regular = Demand { limits: false, ..Demand::class(mode, sign) };
    let effort = if joined == Joined::None { 1 } else { EFFORT };
    let found = |demand: Demand, asked: Asked| first_obstacle(robot, &demand, &curves, effort, asked);
    let singular = found(regular, Asked::Regular);
    let near = margins.are_any().then(|| found(Demand { margins, ..regular }, Asked::Margin)).flatten();
    let limits = Demand { limits: true, ..regular };
    let limit = is_limited(robot).then(|| found(limits, Asked::Limit)).flatten();
    let window = window::first_beyond(robot, poses, &curves, joined);
    let limit = limit.into_iter().chain(window).min_by(Obstacle::by_place);

    let walked = singular.as_ref().map_or(curves.len(), |o| o.segment);
    let until = |k: usize| match &singular {
        _ if joined == Joined::None => 0.0,
        Some(o) if o.segment == k + 1 => o.t.0,
        _ => 1.0,
    };
    let known = if joined == Joined::None && singular.is_some() { walked - 1 } else { walked };
    let stretch = |k| PoseStretch { robot, mode, curve: &curves[k], segment: k + 1, from: 0.0, to: until(k) };
    let stretches: Vec<_> = (0..known).map(stretch).collect();
    let parts = profile::parts(curves.len());
    let profile = profile::profile(robot, &curves[..walked], mode, parts, joined == Joined::None);
    let end_poses = [poses.first(), poses.last()].map(|p| p.cloned());
    let joints = |p: &Option<Vec<f64>>| p.as_ref().and_then(|p| robot.inverse_in(p, mode).ok().flatten());
    let ends = [joints(&end_poses[0]), joints(&end_poses[1])];
    let clearance = clearance(&stretches, robot.dof());
    let profile = profile::normalised(profile);
    let check = PathCheck::new(robot, mode, options, [singular, near, limit]);
    Ok(PathCheck { samples: poses.len(), clearance, ends, end_poses, profile, ..check })
}

fn check_input(
    robot: &Robot,
    poses: &[Vec<f64>],
    mode: WorkingMode,
    options: &PathOptions,
) -> Result<(), PathError> {
    options.check()?;
    let (least, wanted) = if options.joined == Joined::None { (1, "one pose") } else { (2, "two poses") };
    if poses.len() < least {
        return Err(PathError::TooShort { wanted, found: poses.len() });
    }
    for (k, pose) in poses.iter().enumerate() {
        crate::check_pose(robot, pose).map_err(|error| PathError::Sample { row: k + 1, error })?;
    }
    let modes = robot.working_modes();
    if !modes.contains(&mode) {
        let known = modes.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
        return Err(PathError::Mode { mode, robot: robot.name.clone(), known });
    }
    let legs = robot.leg_solutions(&poses[0]).map_err(|error| PathError::Sample { row: 1, error })?;
    match legs.iter().position(|leg| leg.q.iter().all(Option::is_none)) {
        Some(k) => Err(PathError::StartOutOfReach { leg: LegIndex::new(k) }),
        None => Ok(()),
    }
}

/// The proved sign of det A at a pose inside the mode, whatever the limits.
fn sign_at(robot: &Robot, mode: WorkingMode, pose: &[f64]) -> Option<i8> {
    [1, -1].into_iter().find(|&sign| {
        let regular = Demand { limits: false, ..Demand::class(mode, sign) };
        Along::is_inside(robot, &regular, [pose, pose], 1)
    })
}

/// The first obstacle to a demand.
fn first_obstacle(
    robot: &Robot,
    demand: &Demand,
    curves: &[Curve],
    effort: usize,
    asked: Asked,
) -> Option<Obstacle> {
    curves.iter().enumerate().find_map(|(k, curve)| {
        let (constraint, from, to, proved) = match along(robot, demand, curve, effort) {
            Along::Inside | Along::Crossed { .. } => return None,
            Along::Outside { constraint, from, to } => (constraint, from, to, true),
            Along::Undecided { constraint, from, to } => (constraint, from, to, false),
        };
        let pose = curve.at(0.5 * (from + to))[..robot.dof()].to_vec();
        Some(Obstacle {
            asked,
            segment: k + 1,
            t: (from, to),
            pose,
            bound: Bound::Constraint(constraint),
            proved,
        })
    })
}
