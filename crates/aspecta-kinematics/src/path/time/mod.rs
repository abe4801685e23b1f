//! From a path to a motion: as fast as joint speeds and accelerations allow. Numerical.
//!
//! A path is a list of smooth [`Piece`]s; the robot stops at the ends of each. The joints follow the spline through its samples, q(s) with s
//! the length of its chords in joint space, so a piece may pass a serial singularity, where the pose turns round but the joints go on. On it
//!
//! > q̇ = q′ ṡ, q̈ = q″ ṡ² + q′ s̈
//!
//! are linear in (s̈, ṡ²): with s̈ constant on each step of a fine grid, the greatest ṡ² from which the end can still be reached is found
//! step by step from the end, and then the greatest s̈ step by step from the start (Pham & Pham 2018, *TOPP-RA*).

mod grid;
mod trajectory;

pub use trajectory::{Binding, Limited, Row, Sampled, Trajectory};

use crate::path::PathCheck;
use crate::path::check::Joined;
use aspecta_robot::WorkingMode;
use aspecta_robot::num::{count, written};

/// A configuration on a path.
#[derive(Clone, Debug, PartialEq)]
pub struct Waypoint {
    /// The pose; angles go on past ±π without a jump.
    pub pose: Vec<f64>,
    /// The joint vector; angles go on past ±π without a jump.
    pub q: Vec<f64>,
    /// The working mode.
    pub mode: WorkingMode,
}

/// A smooth piece of path, given by samples so dense that the spline through their joint vectors is the path. Where pieces meet the robot
/// stops.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// The samples, in order.
    pub samples: Vec<Waypoint>,
}

/// Limits of the joints' speed and acceleration, each > 0, one per joint.
#[derive(Clone, Debug, PartialEq)]
pub struct JointLimits {
    /// The greatest |q̇|, in the unit of the joint per second.
    pub speed: Vec<f64>,
    /// The greatest |q̈|, in the unit of the joint per second squared.
    pub acceleration: Vec<f64>,
}

/// Why there is no trajectory.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TimeError {
    /// A limit is not a positive number.
    #[error("the {what} limit of joint {joint} is {}: give a positive number", written(*.value))]
    Limit {
        /// `speed` or `acceleration`.
        what: &'static str,
        /// From 1.
        joint: usize,
        /// The value given.
        value: f64,
    },
    /// Wrong number of limits.
    #[error("{} of {what} given, but there are {wanted} joints", count(*.found, "limit", "limits"))]
    Count {
        /// `speed` or `acceleration`.
        what: &'static str,
        /// Joints.
        wanted: usize,
        /// Limits.
        found: usize,
    },
    /// Nothing moves.
    #[error("the path has no length: all its joint vectors are the same")]
    NoMotion,
    /// A piece does not begin where the one before ends.
    #[error("piece {piece} of the path does not begin at the joint vector where the piece before it ends")]
    Gap {
        /// From 1.
        piece: usize,
    },
}

/// Joint vectors that are further apart than this, relative to their size, are not the same.
const SAME: f64 = 1e-6;

/// The fastest motion along the pieces, from rest to rest on each.
///
/// On each piece the limits hold everywhere: where the grid lets them be exceeded between its nodes the piece is slowed down. It is the fastest but for
/// the grid, a thousand steps a piece or more: relative errors of time are about 10⁻⁶ on straight lines of joint vectors, 10⁻³ elsewhere.
///
/// # Errors
/// [`TimeError`] if limits are not positive, if pieces do not fit together, or if nothing moves.
///
/// # Examples
/// ```
/// use aspecta_kinematics::path::check_path;
/// use aspecta_kinematics::path::time::{JointLimits, trajectory};
/// use aspecta_robot::catalogue;
///
/// let robot = catalogue::find("five-bar").unwrap();
/// let check = check_path(&robot, &[vec![4.0, 7.0], vec![4.5, 7.5]], "++".parse().unwrap()).unwrap();
/// let limits = JointLimits { speed: vec![2.0; 2], acceleration: vec![10.0; 2] }; // rad/s, rad/s²
/// let motion = trajectory(&check.pieces(), &limits)?;
/// let half = motion.at(0.5 * motion.total_time());
/// assert!(half.velocity.iter().all(|v| v.abs() <= 2.0 + 1e-9));
/// # Ok::<(), aspecta_kinematics::path::time::TimeError>(())
/// ```
pub fn trajectory(pieces: &[Piece], limits: &JointLimits) -> Result<Trajectory, TimeError> {
    let joints = pieces.iter().flat_map(|p| &p.samples).next().map_or(0, |w| w.q.len());
    check_limits(limits, joints)?;
    for (k, w) in pieces.windows(2).enumerate() {
        let (Some(end), Some(start)) = (w[0].samples.last(), w[1].samples.first()) else { continue };
        if end.q.iter().zip(&start.q).any(|(a, b)| (a - b).abs() > SAME * (1.0 + a.abs())) {
            return Err(TimeError::Gap { piece: k + 2 });
        }
    }
    Trajectory::new(pieces, limits).ok_or(TimeError::NoMotion)
}

fn check_limits(limits: &JointLimits, joints: usize) -> Result<(), TimeError> {
    for (what, values) in [("speed", &limits.speed), ("acceleration", &limits.acceleration)] {
        if values.len() != joints {
            return Err(TimeError::Count { what, wanted: joints, found: values.len() });
        }
        let bad = |v: &f64| !(v.is_finite() && *v > 0.0);
        if let Some(k) = values.iter().position(bad) {
            return Err(TimeError::Limit { what, joint: k + 1, value: values[k] });
        }
    }
    Ok(())
}

impl PathCheck {
    /// The path as far as it was followed, ready for [`trajectory()`]: one piece a straight segment, one for a spline.
    pub fn pieces(&self) -> Vec<Piece> {
        let together = self.joined == Joined::Spline;
        let segments = self.profile.chunk_by(|a, b| together || a.segment == b.segment);
        let waypoint =
            |p: &super::ProfilePoint| Waypoint { pose: p.pose.clone(), q: p.q.clone(), mode: p.mode };
        segments.map(|points| Piece { samples: points.iter().map(waypoint).collect() }).collect()
    }
}
