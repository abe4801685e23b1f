//! Boxes without a summit that are near one of another kind: a pass of P, where no direction leads uphill.

use super::*;
use crate::certificate::Leaf;
use aspecta_robot::chart::Chart;
use aspecta_robot::constraint::Scale;

/// No leg can fold; the faces of the window are walls.
const WALLED: &str = r#"
name = "walled"
platform = "turning-body"

[[legs]]
attachment = [0.2, -1.0, 0.1]
actuator = { kind = "spherical", axis = [1.0, 0.0, 0.0], zero = [0.0, 0.0, 1.0], proximal = { deg = 60 }, distal = { deg = 80 } }

[[legs]]
attachment = [-0.15, 0.3, -1.0]
actuator = { kind = "spherical", axis = [0.0, 1.0, 0.0], zero = [1.0, 0.0, 0.0], proximal = { deg = 70 }, distal = { deg = 85 } }

[[legs]]
attachment = [-1.0, 0.1, 0.25]
actuator = { kind = "spherical", axis = [0.0, 0.0, 1.0], zero = [0.0, 1.0, 0.0], proximal = { deg = 75 }, distal = { deg = 100 } }

[window]
"#;

/// Whether a box has no summit of det A > 0 in the mode +++.
fn is_summitless(window: &str, bounds: [(f64, f64); 3]) -> bool {
    let robot = Robot::from_toml(&format!("{WALLED}{window}"), "walled.toml").unwrap();
    let (modes, window) = (["+++".parse().unwrap()], robot.slice(&[]).unwrap());
    let scale = Scale::ones(&robot);
    let setting = Setting::new(&robot, &Chart::Pose, window, &scale);
    let y = std::array::from_fn(|k| bounds.get(k).map_or(Interval::point(0.0), |b| Interval::new(b.0, b.1)));
    let claim = Leaf { undecided: 3, summitless: 1, ..Leaf::default() };
    claims::prove::<3>(&setting, &modes, &[], (y, claim), &AtomicBool::new(false)).is_ok()
}

/// h_1 rises as the yaw does, and the distance to the wall falls: both are least together at a pass, at a
/// roll of 0.09967 and no pitch.
#[test]
fn between_a_serial_singularity_and_a_wall() {
    let window = "roll = { deg = [-60, 60] }\npitch = { deg = [-50, 50] }\nyaw = { deg = [-30, 100] }";
    let at = |roll, pitch| is_summitless(window, [roll, pitch, (1.72317175, 1.72372569)]);
    assert!(at((0.09919742, 0.09970875), (-0.00170442, -0.00127831)));
    assert!(at((0.09970875, 0.10022007), (-0.00042610, 0.0)));
    assert!(!at((0.09945, 0.0999), (-0.0004, 0.0004)));
}

/// det A, h_1 and the distance to the wall are the least together. H_1 has been proved positive, but h_1
/// varies by a factor of three.
#[test]
fn in_a_corner_of_three() {
    let window = "roll = { deg = [-70, 50] }";
    let pitch_and_yaw = [(-0.32692553, -0.32692516), (-2.42792682, -2.42792606)];
    assert!(is_summitless(window, [(0.87093789, 0.87093815), pitch_and_yaw[0], pitch_and_yaw[1]]));
}
