//! Singularities (Definitions 3 and 4): of which kind a configuration is, and how near it is to one.

use super::{KinematicsError, LegIndex, WorkingMode};
use crate::Kinematics;
use crate::constraints::within_limits;
use crate::for_platform;
use crate::homogeneous::Homogeneous;
use aspecta_robot::{Actuator, Robot};
use nalgebra::DMatrix;
use serde::Serialize;

/// At or below this measure ([`State::parallel_measure`], [`State::serial_measures`], both without unit)
/// a configuration is called singular.
///
/// A serial singularity is a double root: rounding of relative size ε = 2⁻⁵² moves its measure by
/// √ε ≈ 1.5·10⁻⁸, so no smaller measure means anything in `f64`; two decades are left for poses that were
/// themselves computed. *Numerical*: to prove the absence of singularities is the work of intervals.
pub const SINGULAR: f64 = 1e-6;

/// The kind of singularity of a configuration (Definitions 3 and 4), at the tolerance [`SINGULAR`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Singularity {
    /// Neither.
    Regular,
    /// Definition 3: det A = 0. The platform can move while the actuators are locked.
    Parallel,
    /// Definition 4: det B = 0. The platform has lost a velocity; a leg's two postures meet.
    Serial,
    /// The third kind: both at once.
    Both,
}

impl Singularity {
    const fn of(parallel: bool, serial: bool) -> Self {
        match (parallel, serial) {
            (false, false) => Self::Regular,
            (true, false) => Self::Parallel,
            (false, true) => Self::Serial,
            (true, true) => Self::Both,
        }
    }

    /// The name in results: `regular`, `parallel`, `serial`, `both`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Regular => "regular",
            Self::Parallel => "parallel",
            Self::Serial => "serial",
            Self::Both => "both",
        }
    }
}

/// A configuration (X, q) with its Jacobians and its distance from the singularities. Numerical
/// throughout.
///
/// The measures do not change when the robot is moved, scaled or its legs are renumbered. The moments
/// in A are taken about the platform's origin, so they do depend on which point of a turning
/// platform is its origin.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct State {
    /// X; angles in rad.
    pub pose: Vec<f64>,
    /// q; angles in rad, turned by full turns into the ranges of their joints.
    pub q: Vec<f64>,
    /// The working mode (Definition 7); `None` at a serial singularity, which belongs to none.
    pub mode: Option<WorkingMode>,
    /// Largest |f_j| relative to the squares of the leg's lengths: 0 on a true configuration.
    pub residual: f64,
    /// A = ∂f/∂X, row by row (one row per leg); columns: translations, then the angular velocity.
    pub a: Vec<Vec<f64>>,
    /// B_jj = ∂f_j/∂q_j.
    pub b: Vec<f64>,
    /// det A.
    pub det_a: f64,
    /// det B, the product of the B_jj.
    pub det_b: f64,
    /// Condition number of the homogeneous A ([`State::parallel_measure`]): ≥ 1, infinite (JSON `null`)
    /// where it has a zero singular value.
    pub condition_a: f64,
    /// Condition number of the homogeneous B, diag([`State::serial_measures`]): greatest by smallest.
    pub condition_b: f64,
    /// The kind of singularity.
    pub singularity: Singularity,
    /// The smallest singular value of the homogeneous A: its distance (2-norm) from the nearest
    /// singular matrix. 0 at a parallel singularity, at most 1.
    ///
    /// Row j of the homogeneous A, Â, is the wrench of leg j, moments divided by
    /// [`Robot::characteristic_length`] (unless the platform only turns), divided by its norm.
    pub parallel_measure: f64,
    /// Per leg |B_jj| / max |B_jj|, in [0, 1]: √ of [`LegSolutions::reach`](super::LegSolutions::reach). For
    /// revolute legs of the plane |sin| of the elbow angle, for prismatic legs |sin| of the angle between rail and
    /// rod. 0 at a serial singularity; 1 for struts.
    pub serial_measures: Vec<f64>,
    /// The legs in serial singularity.
    pub serial_legs: Vec<LegIndex>,
    /// Whether it keeps all joint limits strictly and lies in the robot's window; where a leg is at a serial
    /// singularity, to rounding.
    pub within_limits: bool,
    /// The measure at or below which a configuration is called singular: [`SINGULAR`].
    pub tolerance: f64,
}

/// [`Kinematics::state`](crate::Kinematics::state).
pub(crate) fn state(robot: &Robot, pose: &[f64], q: &[f64]) -> Result<State, KinematicsError> {
    let jacobians = robot.jacobians(pose, q)?;
    let values = singular_values(&Homogeneous::of(robot).matrix(&jacobians.a));
    let serial_measures: Vec<f64> = serial_measures(robot, &jacobians.b).collect();
    let serial_legs = serial_legs(robot, &jacobians.b);
    let parallel_measure = values.smallest;
    let mode = jacobians.mode();
    Ok(State {
        within_limits: for_platform!(robot.platform, keeps_limits(robot, pose, mode)),
        pose: pose.to_vec(),
        q: robot.legs.iter().zip(q).map(|(leg, q)| leg.in_range(*q)).collect(),
        mode: serial_legs.is_empty().then_some(mode),
        residual: jacobians.residual,
        det_a: jacobians.det_a(),
        det_b: jacobians.det_b(),
        condition_a: values.condition(),
        condition_b: Extremes::of(serial_measures.iter().copied()).condition(),
        singularity: Singularity::of(parallel_measure <= SINGULAR, !serial_legs.is_empty()),
        parallel_measure,
        serial_measures,
        serial_legs,
        tolerance: SINGULAR,
        a: jacobians.a,
        b: jacobians.b,
    })
}

fn keeps_limits<const D: usize, const N: usize>(robot: &Robot, pose: &[f64], mode: WorkingMode) -> bool {
    within_limits::<D, N>(robot, pose)(mode)
}

/// The legs that are at a serial singularity.
pub(crate) fn serial_legs(robot: &Robot, b: &[f64]) -> Vec<LegIndex> {
    let near = serial_measures(robot, b).enumerate().filter(|(_, m)| *m <= SINGULAR);
    near.map(|(j, _)| LegIndex::new(j)).collect()
}

fn serial_measures(robot: &Robot, b: &[f64]) -> impl Iterator<Item = f64> {
    let measure = |(actuator, b): (&Actuator, &f64)| match actuator.greatest_reach() {
        Some(reach) => actuator.signed_height(b.abs()) / reach.mid().sqrt(),
        None => f64::from(*b != 0.0),
    };
    robot.legs.iter().map(|l| &l.actuator).zip(b).map(measure)
}

/// The extreme singular values of a matrix.
struct Extremes {
    smallest: f64,
    greatest: f64,
}

impl Extremes {
    fn of(values: impl Iterator<Item = f64>) -> Self {
        let all = Self { smallest: f64::INFINITY, greatest: 0.0 };
        values.fold(all, |e, v| Self { smallest: e.smallest.min(v), greatest: e.greatest.max(v) })
    }

    fn condition(&self) -> f64 {
        if self.smallest == 0.0 { f64::INFINITY } else { self.greatest / self.smallest }
    }
}

/// NaN where the matrix overflowed.
fn singular_values(matrix: &DMatrix<f64>) -> Extremes {
    if matrix.iter().any(|x| !x.is_finite()) {
        return Extremes { smallest: f64::NAN, greatest: f64::NAN };
    }
    Extremes::of(matrix.singular_values().iter().copied())
}
