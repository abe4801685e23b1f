//! The joint angles of a spherical leg as coordinates of all configurations.

use super::Folded;
use crate::kinematics::leg::Closure;
use crate::kinematics::modal::{LegClosure, closures};
use crate::kinematics::placement::{Placement, out_of_frame, roll_pitch_yaw};
use crate::num::{Interval, Scalar, each};
use crate::robot::{Actuator, Platform, Robot, Window};
use serde::{Deserialize, Serialize};

/// One leg j of a platform that turns about a point, from the base to the platform.
///
/// Coordinates: the motor's angle q_j, the elbow's angle ψ, the angle ϑ of the platform about its joint; all full turns. Let w be the
/// elbow's axis, t the direction in which the motor moves it and n = t × w, so that in the leg's frame
///
/// > w = (sin a cos q, sin a sin q, cos a),  n = (cos a cos q, cos a sin q, −sin a),  t = (−sin q, cos q, 0),
///
/// a and b being the angles of the proximal and the distal link. Then
///
/// > v = cos b w + sin b (cos ψ n + sin ψ t),  ∂f/∂v = w,  B_jj = ∂f/∂q = sin a sin b sin ψ.
///
/// These are coordinates of all (X, q_j), in both postures of the leg, without any singularity: no poles of the pitch, no fold, no root;
/// the leg's serial singularities are ψ = 0 and ψ = π.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Chain {
    /// Leg j, from 0.
    pub leg: usize,
}

impl Chain {
    /// Right-handed orthonormal axes of the platform: those that lie along m, sin b w − cos b (cos ψ n + sin ψ t) and v where ϑ = 0, with
    /// m = cos ψ t − sin ψ n.
    pub fn body(&self, robot: &Robot) -> [[Interval; 3]; 3] {
        axes_about(&robot.legs[self.leg].attachment)
    }

    /// The chart for a platform that turns about a point, if `window` holds all its orientations.
    pub(super) fn of(robot: &Robot, window: &Window) -> Option<Self> {
        let whole = window.cut.iter().all(|&cut| cut == (false, false)) && window.held().next().is_none();
        let spherical = matches!(robot.legs.first()?.actuator, Actuator::Spherical { .. });
        (robot.platform == Platform::TurningBody && spherical && whole).then_some(Self { leg: 0 })
    }

    pub(super) fn window() -> Window {
        let turn = (-Interval::PI.hi, Interval::PI.hi);
        Window {
            ranges: vec![turn; 3],
            glued: vec![true; 3],
            angles: vec![true; 3],
            cut: vec![(false, false); 3],
        }
    }

    /// [`super::Chart::at`].
    pub(super) fn at<T: Scalar, const D: usize, const N: usize>(
        &self,
        robot: &Robot,
        turn: impl Fn(usize) -> (T, T),
    ) -> (Placement<T, D>, [LegClosure<T, D>; N]) {
        let leg = &robot.legs[self.leg];
        let Actuator::Spherical { proximal: (cos_a, sin_a), distal_cos: cos_b } = leg.actuator else {
            unreachable!("a platform that turns about a point has spherical legs only");
        };
        let one = Interval::point(1.0);
        let sin_b = (one - cos_b.square()).sqrt();
        let ((sin, cos), (sin_psi, cos_psi), (sin_theta, cos_theta)) = (turn(0), turn(1), turn(2));
        let vector = |x: T, y: T, z: T| -> [T; D] { each!(|k| [x, y, z][k]) };
        let constant = |x: Interval| T::constant(x);
        let w = vector(cos.scale(sin_a), sin.scale(sin_a), constant(cos_a));
        let n = vector(cos.scale(cos_a), sin.scale(cos_a), constant(-sin_a));
        let t = vector(-sin, cos, T::zero());
        // From the elbow to the platform's joint; what the elbow turns about; and what is left of three perpendicular axes at the joint.
        let along: [T; D] = each!(|k| (cos_psi * n[k] + sin_psi * t[k]).tightened());
        let m: [T; D] = each!(|k| (cos_psi * t[k] - sin_psi * n[k]).tightened());
        let v: [T; D] = each!(|k| w[k].scale(cos_b) + along[k].scale(sin_b));
        let across: [T; D] = each!(|k| w[k].scale(sin_b) - along[k].scale(cos_b));
        let first: [T; D] = each!(|k| (cos_theta * m[k] + sin_theta * across[k]).tightened());
        let second: [T; D] = each!(|k| (cos_theta * across[k] - sin_theta * m[k]).tightened());
        let base = [first, second, v].map(|axis| out_of_frame(leg, &axis));
        let placement = Placement::taking(&self.body(robot), &base);
        let mut legs = closures(robot, &placement);
        let b = sin_psi.scale(sin_a * sin_b);
        legs[self.leg] = LegClosure {
            arm: base[2],
            span: v,
            closure: Closure { reach: b.square(), weight: constant(one), fixed: w, swing: [T::zero(); D] },
            fold: Some(Folded { cos, sin, b }),
        };
        (placement, legs)
    }
}

/// Right-handed orthonormal axes, the third being the unit vector `c`.
fn axes_about(c: &[Interval; 3]) -> [[Interval; 3]; 3] {
    let least = (0..3).min_by(|&i, &j| c[i].magnitude().total_cmp(&c[j].magnitude())).unwrap_or(0);
    let (i, j) = ((least + 1) % 3, (least + 2) % 3);
    let length = (c[i].square() + c[j].square()).sqrt();
    // e × c for the axis e that c is farthest from; then c × that.
    let mut first = [Interval::point(0.0); 3];
    (first[i], first[j]) = (-c[j] / length, c[i] / length);
    let second = std::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        c[i] * first[j] - c[j] * first[i]
    });
    [first, second, *c]
}

/// Roll, pitch and yaw of a placement, numerically.
pub(super) fn pose_at<const D: usize, const N: usize>(placement: &Placement<f64, D>) -> [f64; N] {
    let angles = placement.rotation().map_or([0.0; 3], roll_pitch_yaw);
    each!(|k| angles[k])
}

/// Roll, pitch and yaw of a placement; anything where they are not small intervals.
pub(super) fn pose<const D: usize, const N: usize>(placement: &Placement<Interval, D>) -> [Interval; N] {
    let Some(r) = placement.rotation() else { return [Interval::ENTIRE; N] };
    let angle = |cos: Interval, sin: Interval| Interval::angle(cos, sin).unwrap_or(Interval::ENTIRE);
    let (low, level) = (D - 1, (r[0][0].square() + r[1][0].square()).sqrt());
    let angles = [angle(r[low][low], r[low][1]), angle(level, -r[low][0]), angle(r[0][0], r[1][0])];
    each!(|k| angles[k])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kinematics::WorkingMode;
    use crate::kinematics::chart::Chart;
    use crate::kinematics::leg::equation;
    use crate::kinematics::modal::ModalRows;
    use crate::num::Random;

    const SPHERE: &str = include_str!("../../../tests/fixtures/sphere.toml");

    /// Every point of the chart is a configuration: it closes leg j in the posture that sin ψ says, and there the robot is what it is at the pose.
    #[test]
    fn points_are_configurations() {
        let robot = Robot::from_toml(SPHERE, "sphere.toml").unwrap();
        let mut random = Random::new(7);
        for leg in 0..3 {
            let chart = Chart::Chain(Chain { leg });
            let mut compared = 0;
            for _ in 0..1000 {
                let y: [f64; 3] = std::array::from_fn(|_| random.within((-3.1, 3.1)));
                let (placement, legs) = chart.at::<f64, 3, 3>(&robot, &y, |k| y[k].sin_cos());
                let r = placement.rotation().unwrap();
                let dots = |i: usize, j: usize| (0..3).map(|k| r[k][i] * r[k][j]).sum::<f64>();
                assert!(
                    (0..9).all(|k| (dots(k / 3, k % 3) - f64::from(u8::from(k / 3 == k % 3))).abs() < 1e-14)
                );
                let own = &legs[leg];
                assert!(equation(&robot.legs[leg].actuator, &own.span, y[0]).abs() < 1e-14);
                let b = own.fold.unwrap().b;
                assert!(b * y[1].sin() >= 0.0);
                // The same at the pose, with every q from its elimination.
                let pose = chart.pose_at::<3, 3>(&robot, &y);
                let (_, at_pose) = Chart::Pose.at::<f64, 3, 3>(&robot, &pose, |k| pose[k].sin_cos());
                if at_pose.iter().any(|leg| leg.closure.reach < 1e-3) {
                    continue;
                }
                let det = |legs: &[LegClosure<f64, 3>; 3], signs: &str| {
                    let heights: [[f64; 2]; 3] = std::array::from_fn(|j| legs[j].heights());
                    let rows = ModalRows::<f64, 3>::new(&robot, legs, &heights.map(|h| h[0]));
                    let weights: f64 = legs
                        .iter()
                        .map(|leg| if leg.fold.is_some() { 1.0 } else { leg.closure.weight })
                        .product();
                    rows.det(signs.parse::<WorkingMode>().unwrap()) / weights
                };
                let mut signs = ["+", "-", "+"];
                signs[leg] = if b > 0.0 { "+" } else { "-" };
                let (here, there) = (det(&legs, &signs.concat()), det(&at_pose, &signs.concat()));
                assert!((here - there).abs() < 1e-10 * (1.0 + there.abs()), "{leg} {y:?}: {here} {there}");
                compared += 1;
            }
            assert!(compared > 200, "{compared}");
        }
    }

    /// The boxes' images hold the poses of their points.
    #[test]
    fn images_hold_poses() {
        let robot = Robot::from_toml(SPHERE, "sphere.toml").unwrap();
        let chart = Chart::Chain(Chain { leg: 1 });
        let mut random = Random::new(8);
        let mut bounded = 0;
        for _ in 0..500 {
            let corner: [f64; 3] = std::array::from_fn(|_| random.within((-3.1, 3.1)));
            let cell = corner.map(|x| Interval::new(x, x + 0.02));
            let image = chart.pose::<3, 3>(&robot, &cell);
            let y: [f64; 3] = corner.map(|x| x + 0.02 * random.unit());
            let pose = chart.pose_at::<3, 3>(&robot, &y);
            // An angle counts but for full turns.
            let holds = |k: usize| {
                [-1.0, 0.0, 1.0]
                    .iter()
                    .any(|turns| image[k].contains(pose[k] + turns * std::f64::consts::TAU))
            };
            assert!((0..3).all(holds), "{image:?} {pose:?}");
            bounded += usize::from(image.iter().all(|i| i.width() < 0.5));
        }
        assert!(bounded > 300, "{bounded}");
    }
}
