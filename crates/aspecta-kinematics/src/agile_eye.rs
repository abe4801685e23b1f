//! The Agile Eye: a spherical 3-RRR with right angles only, of which det A is known in closed form.

use aspecta_robot::num::{Interval, cross, dot};
use aspecta_robot::{Leg, Platform, Robot, Window, WorkingMode};

/// A platform that turns about a point on three spherical legs, each with two links of 90°, the three motors' axes being perpendicular to
/// one another and the three joints of the platform too: Gosselin's Agile Eye, however it is mounted.
///
/// With M_ij = e_i·v_j the cosines between motors' axes and platform joints, M is a rotation or its negative; let w, x, y, z be the unit
/// quaternion of that rotation. In the mode s (docs/theory.md, 6)
///
/// > det A = −s_1 s_2 s_3 ε 16 e₃/√(H_1 H_2 H_3),  e₃ = w²x²y² + w²x²z² + w²y²z² + x²y²z²,
///
/// ε = ±1 being the handedness of the motors' axes: it keeps one sign in all of a mode. It vanishes only where a leg is folded, on six curves
/// (two of w, x, y, z are 0), and curves part nothing in a space of three dimensions.
///
/// # Source
/// Bonev, Chablat & Wenger, *Working and assembly modes of the Agile Eye*, 2006, found the curves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AgileEye {
    /// ε.
    handedness: i8,
}

impl AgileEye {
    /// Returns the robot as an Agile Eye, if it is one: told by the numbers of its file, so 90 in degrees, and axes whose products cancel
    /// term by term, as those of (3, 4, 0) and (−4, 3, 0).
    ///
    /// # Examples
    /// ```
    /// use aspecta_kinematics::AgileEye;
    /// use aspecta_robot::catalogue;
    ///
    /// let eye = AgileEye::of(&catalogue::find("spherical-3-rrr").unwrap()).expect("is one");
    /// assert_eq!(eye.sign_of_det_a("+++".parse()?), -1);
    /// # Ok::<(), aspecta_kinematics::NotAMode>(())
    /// ```
    pub fn of(robot: &Robot) -> Option<Self> {
        let [first, second, third] = &robot.legs[..] else { return None };
        let axes = |of: fn(&Leg) -> &[Interval; 3]| [of(first), of(second), of(third)];
        let motors = axes(|leg| &leg.frame[2]);
        let is_one = robot.platform == Platform::TurningBody
            && robot.legs.iter().all(has_right_angles)
            && are_perpendicular(motors)
            && are_perpendicular(axes(|leg| &leg.attachment));
        let [a, b, c] = motors.map(|axis| axis.map(Interval::mid));
        let handedness = if dot(&a, &cross(&b, &c)) > 0.0 { 1 } else { -1 };
        is_one.then_some(Self { handedness })
    }

    /// The sign of det A all over a working mode.
    pub fn sign_of_det_a(self, mode: WorkingMode) -> i8 {
        -self.handedness * mode.sign(0) * mode.sign(1) * mode.sign(2)
    }

    /// Whether every working mode of the robot is one generalized aspect: nothing but serial singularities bounds them, and the window
    /// holds all orientations.
    pub fn has_an_aspect_a_mode(robot: &Robot, window: &Window) -> bool {
        let whole = !window.is_cut() && window.held().next().is_none();
        let free = robot.legs.iter().all(|leg| leg.limits.is_empty()) && robot.rod_angles.is_empty();
        whole && free && Self::of(robot).is_some()
    }
}

fn has_right_angles(leg: &Leg) -> bool {
    let zero = Interval::point(0.0);
    leg.actuator.as_spherical().is_some_and(|links| links.proximal.0 == zero && links.distal_cos == zero)
}

fn are_perpendicular([a, b, c]: [&[Interval; 3]; 3]) -> bool {
    [(a, b), (b, c), (c, a)].into_iter().all(|(a, b)| cancels(a, b))
}

/// Whether a·b is 0 because its terms are, or are x y and −x y with the same numbers x and y. (That an enclosure of it holds 0 would say
/// less.)
fn cancels(a: &[Interval; 3], b: &[Interval; 3]) -> bool {
    let zero = Interval::point(0.0);
    let mut terms = a.iter().zip(b).filter(|(x, y)| **x != zero && **y != zero);
    match (terms.next(), terms.next(), terms.next()) {
        (None, ..) => true,
        (Some((&x, &y)), Some((&z, &w)), None) => {
            (z == x && w == -y) || (z == -x && w == y) || (z == y && w == -x) || (z == -y && w == x)
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Kinematics;
    use crate::placement::Placement;
    use aspecta_robot::catalogue;
    use aspecta_robot::num::Random;

    /// An Agile Eye with these axes and joints.
    fn eye(axes: [[f64; 3]; 3], joints: [[f64; 3]; 3]) -> Robot {
        let leg = |k: usize| {
            format!(
                "[[legs]]\nattachment = {:?}\nactuator = {{ kind = \"spherical\", axis = {:?}, zero = {:?}, proximal = {{ deg = 90 }}, distal = {{ deg = 90 }} }}\n",
                joints[k],
                axes[k],
                axes[(k + 1) % 3]
            )
        };
        let text = format!("name = \"eye\"\nplatform = \"turning-body\"\n{}{}{}", leg(0), leg(1), leg(2));
        Robot::from_toml(&text, "eye.toml").unwrap()
    }

    const STRAIGHT: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    const SKEW: [[f64; 3]; 3] = [[3.0, 4.0, 0.0], [-4.0, 3.0, 0.0], [0.0, 0.0, -2.0]];

    /// The closed form, against det A and H as the kernel computes them, in all modes, however the robot is mounted.
    #[test]
    fn det_a_is_what_the_closed_form_says() {
        let mut random = Random::new(22);
        let mirrored = [STRAIGHT[0], STRAIGHT[2], STRAIGHT[1]];
        for (axes, joints) in [(STRAIGHT, STRAIGHT), (SKEW, STRAIGHT), (mirrored, SKEW), (SKEW, mirrored)] {
            let robot = eye(axes, joints);
            let found = AgileEye::of(&robot).unwrap();
            for _ in 0..300 {
                let pose = [3.1, 1.5, 3.1].map(|end| random.within((-end, end)));
                let placement = Placement::<f64, 3>::at(robot.platform, &pose);
                let cosines = |i: usize, j: usize| {
                    dot(&robot.legs[i].frame[2].map(Interval::mid), &placement.arm(&robot.legs[j]))
                };
                // 4w², 4x², 4y², 4z² from the diagonal of the rotation ±M.
                let m: [[f64; 3]; 3] = std::array::from_fn(|i| std::array::from_fn(|j| cosines(i, j)));
                let det = dot(&m[0], &cross(&m[1], &m[2]));
                let [a, b, c] = std::array::from_fn(|i| det.signum() * m[i][i]);
                let four = [1.0 + a + b + c, 1.0 + a - b - c, 1.0 - a + b - c, 1.0 - a - b + c];
                let e3: f64 =
                    (0..4).map(|k| (0..4).filter(|&i| i != k).map(|i| four[i] / 4.0).product::<f64>()).sum();
                let reach: f64 = (0..3).map(|i| 1.0 - m[i][i] * m[i][i]).product();
                for solution in robot.inverse(&pose).unwrap() {
                    let said = f64::from(found.sign_of_det_a(solution.mode)) * 16.0 * e3 / reach.sqrt();
                    assert!((solution.det_a - said).abs() < 1e-9, "{pose:?}: {} {said}", solution.det_a);
                }
            }
        }
    }

    /// Axes that are perpendicular but for a rounding, or angles that are, are not told to be.
    #[test]
    fn what_is_nearly_an_agile_eye_is_none() {
        let tilted = [[1.0, 1e-15, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        assert_eq!(AgileEye::of(&eye(tilted, STRAIGHT)), None);
        assert_eq!(AgileEye::of(&eye(STRAIGHT, tilted)), None);
        assert_eq!(AgileEye::of(&eye([[1.0, 1.0, 1.0], [1.0, -1.0, 0.0], [1.0, 1.0, -2.0]], STRAIGHT)), None);
        let text = catalogue::all().iter().find(|entry| entry.name == "spherical-3-rrr").unwrap().text;
        for angle in ["{ deg = 90.0000001 }", "{ rad = 1.5707963267948966 }"] {
            let changed = text.replacen("{ deg = 90 }", angle, 1);
            assert_eq!(AgileEye::of(&Robot::from_toml(&changed, "eye.toml").unwrap()), None, "{angle}");
        }
        assert_eq!(AgileEye::of(&catalogue::find("delta").unwrap()), None);
    }
}
