//! What moves at a configuration and what does not (Definitions 3 and 4): A t + B q̇ = 0.

use super::LegIndex;
use super::singularity::{SINGULAR, State};
use crate::homogeneous::Homogeneous;
use crate::placement::Placement;
use aspecta_robot::{Robot, Spherical};
use nalgebra::{DMatrix, RowDVector, SVD};
use serde::Serialize;

/// The velocities that a configuration allows ([`State::velocities`]): twists t (translations, then the
/// angular velocity) of the platform and speeds q̇ of the joints with A t + B q̇ = 0. *Numerical*, at the
/// tolerance [`SINGULAR`].
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Velocities {
    /// The length by which moments are divided to compare them with forces; `None` for a platform that only
    /// moves without turning, or only turns.
    pub length: Option<f64>,
    /// The singular values of the homogeneous A, greatest first; empty if A has no finite ones.
    pub singular_values: Vec<f64>,
    /// The rank of A.
    pub rank_a: usize,
    /// The rank of B: legs that are not at a serial singularity.
    pub rank_b: usize,
    /// The kernel of A: twists that the platform gains, which it can have while the actuators are locked
    /// (Definition 3); of length 1 if angular velocities count by [`Velocities::length`].
    pub gained: Vec<Vec<f64>>,
    /// Per leg at a serial singularity the direction that every twist is perpendicular to, whatever the
    /// actuators do (Definition 4).
    pub lost: Vec<Lost>,
    /// −A⁻¹B, by which t = −A⁻¹B q̇, row by row; `None` at a parallel singularity.
    pub twist_of_joints: Option<Vec<Vec<f64>>>,
}

/// What a leg at a serial singularity takes from the platform.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Lost {
    /// The leg.
    pub leg: LegIndex,
    /// How it stands.
    pub posture: SerialPosture,
    /// The direction that is lost, its translations of length 1 (for a platform that only turns, its turns).
    pub twist: Vec<f64>,
}

/// How a leg stands at a serial singularity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum SerialPosture {
    /// Crank and rod (proximal and distal link) are one line, or one arc, as long as both.
    Stretched,
    /// The rod (distal link) lies back over the crank (proximal link).
    Folded,
    /// The rod stands square to what its motor moves.
    Square,
}

impl State {
    /// What moves at the configuration and what does not.
    ///
    /// # Examples
    /// ```
    /// use aspecta_kinematics::{Kinematics, SerialPosture};
    /// use aspecta_robot::Robot;
    ///
    /// // |A1 C| = 13 = 8 + 5: the first leg is stretched along x.
    /// let robot = Robot::resolve("five-bar")?;
    /// let q = robot.inverse(&[13.0, 0.0])?[0].q.clone();
    /// let velocities = robot.state(&[13.0, 0.0], &q)?.velocities(&robot);
    /// assert_eq!((velocities.rank_a, velocities.rank_b), (2, 1));
    /// assert_eq!(velocities.lost[0].posture, SerialPosture::Stretched);
    /// assert_eq!(velocities.lost[0].twist[0].abs(), 1.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn velocities(&self, robot: &Robot) -> Velocities {
        let (n, coordinates) = (robot.dof(), robot.platform.coordinates());
        let turns = coordinates.iter().filter(|c| c.angle).count();
        let length = (0 < turns && turns < n).then(|| robot.characteristic_length());
        // Column k of the homogeneous A belongs to the speed t_k times this.
        let scale = |k: usize| if coordinates[k].angle { length.unwrap_or(1.0) } else { 1.0 };
        let matrix = Homogeneous::of(robot).matrix(&self.a);
        let lost = self.serial_legs.iter().map(|&leg| Lost {
            leg,
            posture: posture(robot, &self.pose, leg),
            twist: matrix.row(leg.index()).iter().enumerate().map(|(k, x)| x * scale(k)).collect(),
        });
        let lost = lost.collect();
        let (mut singular_values, mut gained) = (Vec::new(), Vec::new());
        if matrix.iter().all(|x| x.is_finite()) {
            let SVD { singular_values: values, v_t, .. } = matrix.svd(false, true);
            let twist = |row: RowDVector<f64>| row.iter().enumerate().map(|(k, x)| x / scale(k)).collect();
            let kernel = values.iter().zip(v_t.iter().flat_map(|v| v.row_iter()));
            let kernel = kernel.filter(|(value, _)| **value <= SINGULAR);
            gained = kernel.map(|(_, row)| twist(row.into_owned())).collect();
            singular_values = values.iter().copied().collect();
        }
        let rank_a = singular_values.len() - gained.len();
        Velocities {
            length,
            lost,
            rank_b: n - self.serial_legs.len(),
            twist_of_joints: if rank_a == n { twist_of_joints(&self.a, &self.b) } else { None },
            rank_a,
            singular_values,
            gained,
        }
    }
}

fn twist_of_joints(a: &[Vec<f64>], b: &[f64]) -> Option<Vec<Vec<f64>>> {
    let n = b.len();
    let inverse = DMatrix::from_fn(n, n, |i, k| a[i][k]).try_inverse()?;
    Some((0..n).map(|i| (0..n).map(|j| -inverse[(i, j)] * b[j]).collect()).collect())
}

/// How a leg stands whose two postures meet.
fn posture(robot: &Robot, pose: &[f64], leg: LegIndex) -> SerialPosture {
    let leg = robot.leg(leg);
    if let Some(Spherical { proximal: (cos, _), distal_cos }) = leg.actuator.as_spherical() {
        // The platform joint is at the sum or at the difference of both links' angles from the axis.
        let across = span::<3>(robot, pose, leg)[2];
        let stretched = across < cos.mid() * distal_cos.mid();
        return if stretched { SerialPosture::Stretched } else { SerialPosture::Folded };
    }
    let bend = match robot.platform.space() {
        2 => leg.actuator.bend(&span::<2>(robot, pose, leg)),
        _ => leg.actuator.bend(&span::<3>(robot, pose, leg)),
    };
    match bend {
        Some((bend, _)) if bend > 0.0 => SerialPosture::Stretched,
        Some(_) => SerialPosture::Folded,
        None => SerialPosture::Square,
    }
}

fn span<const D: usize>(robot: &Robot, pose: &[f64], leg: &aspecta_robot::Leg) -> [f64; D] {
    let placement = Placement::<f64, D>::at(robot.platform, pose);
    placement.span(leg, &placement.arm(leg))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Kinematics;

    /// With links of 60° and 30° the platform joint is 90° or 30° from the axis.
    #[test]
    fn legs_on_a_sphere_are_stretched_or_folded() {
        let others = r#"
            [[legs]]
            attachment = [-0.15, 0.3, -1.0]
            actuator = { kind = "spherical", axis = [0.0, 1.0, 0.0], zero = [1.0, 0.0, 0.0], proximal = { deg = 70 }, distal = { deg = 85 } }
            [[legs]]
            attachment = [-1.0, 0.1, 0.25]
            actuator = { kind = "spherical", axis = [0.0, 0.0, 1.0], zero = [0.0, 1.0, 0.0], proximal = { deg = 75 }, distal = { deg = 100 } }
        "#;
        for (attachment, posture) in
            [("0, 1, 0", SerialPosture::Stretched), ("0.8660254037844386, 0.5, 0", SerialPosture::Folded)]
        {
            let text = format!(
                r#"name = "sphere"
                platform = "turning-body"
                [[legs]]
                attachment = [{attachment}]
                actuator = {{ kind = "spherical", axis = [1, 0, 0], zero = [0, 1, 0], proximal = {{ deg = 60 }}, distal = {{ deg = 30 }} }}
                {others}"#
            );
            let robot = Robot::from_toml(&text, "sphere.toml").unwrap();
            let pose = [0.0; 3];
            let q = robot.inverse(&pose).unwrap()[0].q.clone();
            let lost = robot.state(&pose, &q).unwrap().velocities(&robot).lost;
            assert_eq!((lost.len(), lost[0].posture), (1, posture), "{lost:?}");
        }
    }
}
