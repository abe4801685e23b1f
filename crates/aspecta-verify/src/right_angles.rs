//! Spherical robots with right angles only (Agile Eyes), whose det A keeps one sign.
//!
//! Let e_i be the axes of the motors and v_i the joints of the platform, three perpendicular unit vectors each, and both links of every leg
//! right angles. The elbow's axis is perpendicular to e_i and v_i, so w_i = ∓ e_i × v_i/h_i, h_i = |e_i × v_i|; with B_ii = v_i·(e_i × w_i)
//! the posture s has w_i = −s e_i × v_i/h_i. Row i of A is v_i × w_i = −s_i r_i/h_i, r_i = e_i − (e_i·v_i) v_i. In the basis of the v the r_i are the rows of M, M_ij = e_i·v_j,
//! but for zeros on the diagonal: det (r_1, r_2, r_3) = det (v_1, v_2, v_3) (M_12 M_23 M_31 + M_13 M_21 M_32). M is orthogonal. If it is the rotation of the unit quaternion (w, x, y, z),
//! M_12 = 2(xy − wz), M_21 = 2(xy + wz) and so on, and the sum of products is 16 e₃, e₃ = w²x²y² + w²x²z² + w²y²z² + x²y²z²; if −M is one, it is −16 e₃. As det M is det (e) det (v),
//!
//! > det A = −s_1 s_2 s_3 det (e_1, e_2, e_3) 16 e₃/(h_1 h_2 h_3).
//!
//! e₃ ≥ 0 vanishes where two of w, x, y, z do, and h_1² = 4(w² + x²)(y² + z²), … vanish nowhere else. So σ det A > 0 either nowhere in a mode or wherever it exists, and
//! that is all orientations but six closed curves: a connected set.

use super::body::constants;
use super::place::{ONE, Setting, ZERO};
use aspecta_robot::num::{Interval, cross, dot};
use aspecta_robot::{Leg, Platform, Robot, Window, WorkingMode};

/// The handedness of the motors' axes, det (e_1, e_2, e_3) = ±1, of a robot with right angles only.
pub(super) fn handedness(robot: &Robot) -> Option<i8> {
    let [a, b, c] = &robot.legs[..] else { return None };
    let is_right = |leg: &Leg| constants(&leg.actuator) == [ZERO, ONE, ZERO];
    let all_right = |[a, b, c]: [&[Interval; 3]; 3]| is_zero(a, b) && is_zero(b, c) && is_zero(c, a);
    let motors = [a, b, c].map(|leg| &leg.frame[2]);
    let fits = robot.platform == Platform::TurningBody
        && robot.legs.iter().all(is_right)
        && all_right(motors)
        && all_right([a, b, c].map(|leg| &leg.attachment));
    let sign = dot(motors[0], &cross(motors[1], motors[2])).sign();
    (fits && sign != 0).then_some(sign)
}

/// Whether the products of the coordinates cancel: of each that is not zero there is another with the same two numbers and the other sign.
fn is_zero(a: &[Interval; 3], b: &[Interval; 3]) -> bool {
    let size = |x: Interval| if x.lo < 0.0 { -x } else { x };
    let product = |k: usize| {
        let (x, y) = (size(a[k]), size(b[k]));
        (x != ZERO && y != ZERO).then(|| {
            let numbers = if x.lo <= y.lo { (x, y) } else { (y, x) };
            (numbers, (a[k].lo < 0.0) != (b[k].lo < 0.0))
        })
    };
    let left: Vec<_> = (0..3).filter_map(product).collect();
    match left[..] {
        [] => true,
        [(numbers, sign), (same, other)] => numbers == same && sign != other,
        _ => false,
    }
}

/// Whether the aspects of the robot are its modes: nothing else bounds them.
pub(super) fn modes_are_aspects(robot: &Robot, window: &Window) -> bool {
    let is_whole = |k: usize| window.cut[k] == (false, false) && window.ranges[k].0 < window.ranges[k].1;
    let free = robot.legs.iter().all(|leg| leg.limits.is_empty()) && robot.rod_angles.is_empty();
    free && handedness(robot).is_some() && (0..window.ranges.len()).all(is_whole)
}

impl Setting<'_> {
    /// The sign that det A has all over a mode, where it is known.
    pub(super) fn known_sign(&self, mode: WorkingMode) -> Option<f64> {
        let signs = (0..3).map(|j| f64::from(mode.sign(j))).product::<f64>();
        self.handedness.map(|handedness| -f64::from(handedness) * signs)
    }
}
