//! The direct geometric model: all real poses of a joint vector, g⁻¹(q) of (6) over all working modes.
//!
//! With its actuators locked every point-to-point leg is a strut of fixed length (`locked`), so a robot poses
//! one of a few classical problems:
//!
//! | platform | problem | poses |
//! |---|---|---|
//! | plane point | two circles (`circles`) | 2 |
//! | translating body | three spheres (`spheres`) | 2 |
//! | plane body | 3-RPR: one trigonometric polynomial of degree 3 in φ (`planar_body`) | 6 |
//! | turning body | one polynomial of degree 8 (`cone`), or three quadrics of P³ in the quaternion (`turning_body`) | 8 |
//! | free body | Gough-Stewart: seven quadrics of P⁷ in Study parameters (`free_body`) | 40 |
//!
//! Nothing is lost near double solutions: intervals decide how many poses there are, and where they cannot,
//! every pose is returned whose leg equations hold to rounding.

mod bernstein;
mod certify;
mod circles;
mod cluster;
mod cone;
mod eliminant;
mod free_body;
mod locked;
mod mirror;
mod planar_body;
mod projective;
mod spatial;
mod spheres;
mod triangle;
mod turning_body;

use super::constraints::within_limits;
use super::jacobian::Matrices;
use super::singularity::serial_legs;
use super::{KinematicsError, Solution, check_joints, for_platform};
use crate::Kinematics;
use arrayvec::ArrayVec;
use aspecta_robot::num::Interval;
use aspecta_robot::{LegIndex, Platform, Robot};
use locked::{Locked, LockedLegs};
use serde::Serialize;
use std::cmp::Ordering;

/// More than any platform has, to leave room for doubtful near-double poses.
pub const CAPACITY: usize = 48;

/// With locked actuators the platform still moves.
#[derive(Clone, Copy, Debug)]
struct SelfMotion;

/// Poses found and what is proved of their number.
#[derive(Clone, Debug)]
struct Roots<const N: usize> {
    poses: ArrayVec<[f64; N], CAPACITY>,
    /// How many of the first poses are proved already, and to differ from one another.
    proved: usize,
    /// A proved upper bound of the number of poses, for every q within rounding; `None` where there is none.
    at_most: Option<usize>,
}

impl<const N: usize> Roots<N> {
    fn none() -> Self {
        Self { poses: ArrayVec::new(), proved: 0, at_most: Some(0) }
    }

    fn push(&mut self, pose: [f64; N]) -> Result<(), SelfMotion> {
        self.poses.try_push(pose).map_err(|_| SelfMotion)
    }

    /// Adds a doubtful pose if its leg equations hold to rounding and it is not there already: nearer to
    /// another than poses that meet can be told apart, √ε of the longest leg or of a radian.
    fn push_if_solution<const D: usize>(
        &mut self,
        platform: Platform,
        legs: &[Locked],
        pose: [f64; N],
    ) -> Result<(), SelfMotion> {
        const MEET: f64 = 1.5e-8;
        let unit = locked::units::<N>(platform, legs);
        let near = |other: &[f64; N]| {
            platform.coordinates().iter().enumerate().all(|(k, c)| {
                let gap = pose[k] - other[k];
                (if c.angle { principal(gap) } else { gap }).abs() <= MEET * unit[k]
            })
        };
        if !locked::rounds_to_zero::<D, N>(platform, legs, &pose) || self.poses.iter().any(near) {
            return Ok(());
        }
        self.push(pose)
    }
}

/// The poses of a joint vector, without allocation: what [`Robot::direct_poses`] returns.
#[derive(Clone, Debug)]
pub struct Poses {
    list: ArrayVec<Listed, CAPACITY>,
    dof: usize,
    at_most: Option<usize>,
}

#[derive(Clone, Copy, Debug)]
struct Listed {
    pose: [f64; 6],
    /// Whether it is proved, and to differ from the others that are.
    proved: bool,
}

impl Poses {
    fn new<const N: usize>(platform: Platform, roots: Roots<N>) -> Self {
        let coordinates = platform.coordinates();
        let list = roots.poses.iter().enumerate().map(|(i, pose)| {
            let coordinate = |k: usize| if coordinates[k].angle { principal(pose[k]) } else { pose[k] };
            let pose = std::array::from_fn(|k| if k < N { coordinate(k) } else { 0.0 });
            Listed { pose, proved: i < roots.proved }
        });
        let mut list: ArrayVec<Listed, CAPACITY> = list.collect();
        // By angles first, then by lengths.
        let by = |a: &[f64; 6], b: &[f64; 6], angle: bool| {
            let keys = (0..N).filter(|&k| coordinates[k].angle == angle);
            keys.fold(Ordering::Equal, |o, k| o.then(a[k].total_cmp(&b[k])))
        };
        list.sort_unstable_by(|Listed { pose: a, .. }, Listed { pose: b, .. }| {
            by(a, b, true).then(by(a, b, false))
        });
        Self { list, dof: N, at_most: roots.at_most }
    }

    /// Returns how many there are.
    pub fn len(&self) -> usize {
        self.list.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// The poses X, as [`Platform::coordinates`] orders their coordinates, sorted by angles, then by lengths.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &[f64]> {
        self.list.iter().map(|listed| &listed.pose[..self.dof])
    }
}

/// All direct solutions, and whether they are proved to be all.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DirectSolutions {
    /// The solutions, sorted by angles, then by lengths.
    pub solutions: Vec<Solution>,
    /// Whether it is proved that these are all real solutions: intervals bound their number from above, and
    /// as many certified solutions with disjoint boxes are in the list. False near parallel singularities
    /// that double precision cannot tell from a double solution.
    pub complete: bool,
}

/// The angle within (−π, π].
fn principal(angle: f64) -> f64 {
    use std::f64::consts::{PI, TAU};
    let within = if angle.abs() < PI { angle } else { angle - TAU * ((angle - PI) / TAU).ceil() };
    // Rounding may leave it one step outside.
    if within <= -PI { PI } else { within.min(PI) }
}

/// [`Kinematics::direct`](crate::Kinematics::direct).
pub(crate) fn direct(robot: &Robot, q: &[f64]) -> Result<Vec<Solution>, KinematicsError> {
    Ok(robot.direct_certified(q)?.solutions)
}

/// [`Kinematics::direct_certified`](crate::Kinematics::direct_certified).
pub(crate) fn direct_certified(robot: &Robot, q: &[f64]) -> Result<DirectSolutions, KinematicsError> {
    let legs = locked(robot, q)?;
    let poses = poses_of(robot, &legs, true)?;
    Ok(for_platform!(robot.platform, labelled(robot, q, &legs, &poses)))
}

/// [`Kinematics::direct_poses`](crate::Kinematics::direct_poses).
pub(crate) fn direct_poses(robot: &Robot, q: &[f64]) -> Result<Poses, KinematicsError> {
    poses_of(robot, &locked(robot, q)?, false)
}

fn locked(robot: &Robot, q: &[f64]) -> Result<LockedLegs, KinematicsError> {
    check_joints(robot, q)?;
    let in_plane = robot.platform.space() == 2;
    // Pushed one by one: a collected `Result` would move each of these large values several times.
    let mut legs = LockedLegs::new();
    for (j, (leg, &q)) in robot.legs.iter().zip(q).enumerate() {
        if leg.actuator.forbids(q) {
            return Err(KinematicsError::StrutLength { leg: LegIndex::new(j), value: q });
        }
        legs.push(if in_plane { Locked::new::<2>(leg, q) } else { Locked::new::<3>(leg, q) });
    }
    Ok(legs)
}

/// `prove`: spatial platforms are proved where they are found.
fn poses_of(robot: &Robot, legs: &[Locked], prove: bool) -> Result<Poses, KinematicsError> {
    let platform = robot.platform;
    match platform {
        Platform::PlanePoint => {
            mirror::solve(platform, legs, circles::intersect).map(|r| Poses::new(platform, r))
        }
        Platform::TranslatingBody => {
            mirror::solve(platform, legs, spheres::intersect).map(|r| Poses::new(platform, r))
        }
        Platform::PlaneBody => planar_body::solve(legs).map(|r| Poses::new(platform, r)),
        Platform::TurningBody => spatial::turning(legs, prove).map(|r| Poses::new(platform, r)),
        Platform::FreeBody => spatial::free(legs, prove).map(|r| Poses::new(platform, r)),
    }
    .map_err(|SelfMotion| KinematicsError::SelfMotion { robot: robot.name.clone() })
}

/// Certifies and labels `poses`, of which all or none are proved already if they are to be complete.
fn labelled<const D: usize, const N: usize>(
    robot: &Robot,
    q: &[f64],
    legs: &[Locked],
    poses: &Poses,
) -> DirectSolutions {
    let mut solutions = Vec::with_capacity(poses.len());
    let mut boxes: ArrayVec<[Interval; N], CAPACITY> = ArrayVec::new();
    let proved = poses.list.iter().filter(|listed| listed.proved).count();
    for Listed { pose, proved } in &poses.list {
        let pose: [f64; N] = std::array::from_fn(|k| pose[k]);
        let proof = if *proved { None } else { certify::certify::<D, N>(robot.platform, legs, pose) };
        let certified = *proved || proof.is_some();
        if let Some(found) = proof
            && boxes.iter().all(|b| certify::disjoint(robot.platform, b, &found))
        {
            boxes.push(found);
        }
        let jacobians = Matrices::<N>::at::<D>(robot, &pose, q);
        let mode = jacobians.mode();
        solutions.push(Solution {
            within_limits: within_limits::<D, N>(robot, &pose)(mode),
            pose: pose.to_vec(),
            q: q.to_vec(),
            mode,
            serial_legs: serial_legs(robot, &jacobians.b),
            det_a: jacobians.det_a(),
            residual: jacobians.residual,
            certified,
        });
    }
    DirectSolutions { solutions, complete: poses.at_most == Some(proved + boxes.len()) }
}
