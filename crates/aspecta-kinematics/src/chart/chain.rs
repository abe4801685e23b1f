//! The joint angles of a spherical leg as coordinates of all configurations, or of those near its fold.

use crate::AgileEye;
use crate::modal::{Folded, LegClosure, closures};
use crate::placement::{Placement, into_frame, out_of_frame, roll_pitch_yaw};
use aspecta_robot::chart::{Bend, Chain};
use aspecta_robot::legs::{Closure, Spherical};
use aspecta_robot::num::{Interval, Scalar, dot, each};
use aspecta_robot::{Actuator, LegIndex, Platform, Robot, Window};

/// A function of leg j at an orientation: where it is positive and the leg closes, the chart covers the
/// orientation.
pub(super) fn cover<T: Scalar, const D: usize>(bend: &Bend, actuator: &Actuator, span: &[T; D]) -> T {
    let [(cos_a, sin_a), (cos_b, sin_b)] = angles_of(actuator);
    let across = sin_a * sin_b * Interval::point(bend.half_width).sin_cos().1;
    let beyond = span[D - 1] - T::constant(cos_a * cos_b);
    if bend.back { beyond - T::constant(across) } else { -beyond - T::constant(across) }
}

/// (cos, sin) of the angles of a spherical leg's links, a and b.
fn angles_of(actuator: &Actuator) -> [(Interval, Interval); 2] {
    let Some(&Spherical { proximal, distal_cos }) = actuator.as_spherical() else {
        unreachable!("a platform that turns about a point has spherical legs only");
    };
    [proximal, (distal_cos, (Interval::point(1.0) - distal_cos.square()).sqrt())]
}

/// The chart for a platform that turns about a point, if `window` holds all its orientations. Where legs are one and the same there is
/// none: of their determinant a factor is taken out that is no function of its coordinates ([`ModalRows::parted`](crate::modal::ModalRows::parted)).
/// An Agile Eye without limits needs none.
pub(super) fn of(robot: &Robot, window: &Window) -> Option<Chain> {
    let whole = !window.is_cut() && window.held().next().is_none();
    let spherical = robot.legs.first()?.actuator.as_spherical().is_some();
    let known = AgileEye::has_an_aspect_a_mode(robot, window);
    (robot.platform == Platform::TurningBody && spherical && whole && robot.twins().is_empty() && !known)
        .then_some(Chain { leg: LegIndex::new(0), bend: None })
}

/// [`super::Coordinates::at`].
pub(super) fn at<T: Scalar, const D: usize, const N: usize>(
    chain: &Chain,
    robot: &Robot,
    turn: impl Fn(usize) -> (T, T),
) -> (Placement<T, D>, [LegClosure<T, D>; N]) {
    let leg = robot.leg(chain.leg);
    let (sin, cos) = turn(0);
    let (sin_psi, cos_psi) = match chain.bend {
        Some(Bend { back: true, .. }) => (-turn(1).0, -turn(1).1),
        _ => turn(1),
    };
    let (sin_theta, cos_theta) = turn(2);
    let Links { w, m, across, v, most } = Links::new(&leg.actuator, (sin, cos), (sin_psi, cos_psi));
    let first: [T; D] = each!(|k| (cos_theta * m[k] + sin_theta * across[k]).tightened());
    let second: [T; D] = each!(|k| (cos_theta * across[k] - sin_theta * m[k]).tightened());
    let base = [first, second, v].map(|axis| out_of_frame(leg, &axis));
    let placement = Placement::taking(&chain.body(robot), &base);
    let mut legs = closures(robot, &placement);
    let b = sin_psi.scale(most);
    let weight = T::constant(Interval::point(1.0));
    legs[chain.leg.index()] = LegClosure {
        arm: base[2],
        span: v,
        closure: Closure { reach: b.square(), weight, fixed: w, swing: [T::zero(); D] },
        fold: Some(Folded { cos, sin, b }),
    };
    (placement, legs)
}

/// Coordinates, in the chart that holds all configurations, that hold those of a placement: where sin ψ ≥ 0,
/// and where sin ψ ≤ 0.
pub fn coordinates<const D: usize, const N: usize>(
    chain: &Chain,
    robot: &Robot,
    placement: &Placement<Interval, D>,
) -> [[Interval; N]; 2] {
    let leg = robot.leg(chain.leg);
    let [(cos_a, sin_a), (cos_b, sin_b)] = angles_of(&leg.actuator);
    let angle = |cos: Interval, sin: Interval| Interval::angle(cos, sin).unwrap_or(Interval::ENTIRE);
    let v: [Interval; D] = into_frame(leg, &placement.arm(leg));
    let first: [Interval; D] = into_frame(leg, &placement.turned(&chain.body(robot)[0]));
    let cos_psi = ((cos_a * cos_b - v[D - 1]) / (sin_a * sin_b)).meet(Interval::new(-1.0, 1.0));
    let side = (Interval::point(1.0) - cos_psi.square()).sqrt();
    [side, -side].map(|sin_psi| {
        // v where q = 0; the motor turns it about the third axis.
        let (x, y) = (sin_a * cos_b + cos_a * sin_b * cos_psi, sin_b * sin_psi);
        let q = angle(v[0] * x + v[1] * y, v[1] * x - v[0] * y);
        let Links { m, across, .. } = Links::new(&leg.actuator, q.sin_cos(), (sin_psi, cos_psi));
        let all = [q, angle(cos_psi, sin_psi), angle(dot(&first, &m), dot(&first, &across))];
        each!(|k| all[k])
    })
}

/// The links of a spherical leg in its frame.
struct Links<T, const D: usize> {
    /// The elbow's axis.
    w: [T; D],
    /// The platform's joint.
    v: [T; D],
    /// The two other perpendicular axes at the joint, beside v: m along the elbow's motion, and `across` = v
    /// × m.
    m: [T; D],
    across: [T; D],
    /// sin a sin b, the greatest |B_jj|.
    most: Interval,
}

impl<T: Scalar, const D: usize> Links<T, D> {
    /// At the motor's and the elbow's angles with these (sin, cos).
    fn new(actuator: &Actuator, (sin, cos): (T, T), (sin_psi, cos_psi): (T, T)) -> Self {
        let [(cos_a, sin_a), (cos_b, sin_b)] = angles_of(actuator);
        let vector = |x: T, y: T, z: T| -> [T; D] { each!(|k| [x, y, z][k]) };
        let w = vector(cos.scale(sin_a), sin.scale(sin_a), T::constant(cos_a));
        let n = vector(cos.scale(cos_a), sin.scale(cos_a), T::constant(-sin_a));
        let t = vector(-sin, cos, T::zero());
        // From the elbow to the platform's joint.
        let along: [T; D] = each!(|k| (cos_psi * n[k] + sin_psi * t[k]).tightened());
        let m = each!(|k| (cos_psi * t[k] - sin_psi * n[k]).tightened());
        let v = each!(|k| w[k].scale(cos_b) + along[k].scale(sin_b));
        let across = each!(|k| w[k].scale(sin_b) - along[k].scale(cos_b));
        Self { w, v, m, across, most: sin_a * sin_b }
    }
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
    use crate::chart::Chart;
    use crate::chart::Coordinates;
    use crate::modal::ModalRows;
    use aspecta_robot::WorkingMode;
    use aspecta_robot::num::Random;

    const SPHERE: &str = include_str!("../../../aspecta/tests/fixtures/sphere.toml");

    /// Every point of the chart is a configuration: it closes leg j in the posture that sin ψ says, and there
    /// the robot is what it is at the pose.
    #[test]
    fn points_are_configurations() {
        let robot = Robot::from_toml(SPHERE, "sphere.toml").unwrap();
        let mut random = Random::new(7);
        for leg in 0..3 {
            let chart = Chart::Chain(Chain { leg: LegIndex::new(leg), bend: None });
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
                assert!(robot.legs[leg].actuator.equation(&own.span, y[0]).abs() < 1e-14);
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

    /// A bend is the part of the whole chart next to an end of the elbow's way.
    #[test]
    fn bends_are_parts_of_the_whole() {
        let robot = Robot::from_toml(SPHERE, "sphere.toml").unwrap();
        let mut random = Random::new(9);
        for (back, end) in [(true, std::f64::consts::PI), (false, 0.0)] {
            let part =
                Chart::Chain(Chain { leg: LegIndex::new(2), bend: Some(Bend { back, half_width: 0.3 }) });
            let whole = Chart::Chain(Chain { leg: LegIndex::new(2), bend: None });
            for _ in 0..100 {
                let y = [3.1, 0.3, 3.1].map(|end| random.within((-end, end)));
                let z = [y[0], y[1] + end, y[2]];
                let (here, legs) = part.at::<f64, 3, 3>(&robot, &y, |k| y[k].sin_cos());
                let (there, same) = whole.at::<f64, 3, 3>(&robot, &z, |k| z[k].sin_cos());
                let entries = here
                    .rotation()
                    .unwrap()
                    .as_flattened()
                    .iter()
                    .zip(there.rotation().unwrap().as_flattened());
                assert!(entries.into_iter().all(|(a, b)| (a - b).abs() < 1e-14));
                assert!((legs[2].fold.unwrap().b - same[2].fold.unwrap().b).abs() < 1e-14);
            }
        }
    }

    /// The boxes' images hold the poses of their points.
    #[test]
    fn images_hold_poses() {
        let robot = Robot::from_toml(SPHERE, "sphere.toml").unwrap();
        let chart = Chart::Chain(Chain { leg: LegIndex::new(1), bend: None });
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
