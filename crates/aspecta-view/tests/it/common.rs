//! The paper's robots and their analyses.

use aspecta::aspect::{Analysis, Options, analyze};
use aspecta::paving::{Budget, Control};
use aspecta::robot::{Leg, Platform, Robot};
use std::sync::atomic::AtomicBool;

/// Section 3.
pub fn five_bar() -> Robot {
    let legs = vec![
        Leg::revolute([0.0, 0.0], [0.0, 0.0], 8.0, 5.0),
        Leg::revolute([9.0, 0.0], [0.0, 0.0], 5.0, 8.0),
    ];
    Robot::new("five-bar", Platform::PlanePoint, legs).unwrap()
}

/// Table 3.
pub fn three_rrr() -> Robot {
    let legs = vec![
        Leg::revolute([-10.0, -10.0], [0.0, 0.0], 10.0, 10.0),
        Leg::revolute([10.0, -10.0], [10.0, 0.0], 10.0, 10.0),
        Leg::revolute([0.0, 10.0], [10.0, 10.0], 10.0, 10.0),
    ];
    Robot::new("3-rrr", Platform::PlaneBody, legs).unwrap()
}

/// The analysis at a depth.
pub fn analysis(robot: &Robot, depth: u32) -> Analysis {
    slice(robot, depth, &[])
}

/// The analysis of one working mode.
pub fn analysis_in(robot: &Robot, mode: &str, depth: u32) -> Analysis {
    let budget = Budget { depth: Some(depth), ..Budget::default() };
    let options = Options { budget, modes: vec![mode.parse().unwrap()], ..Options::default() };
    analyze(robot, &options, &Control::unwatched()).unwrap()
}

/// The analysis of a slice.
pub fn slice(robot: &Robot, depth: u32, fix: &[(usize, f64)]) -> Analysis {
    let budget = Budget { depth: Some(depth), ..Budget::default() };
    let control = Control { cancelled: &AtomicBool::new(false), progress: &|_| {} };
    analyze(robot, &Options { budget, fix: fix.to_vec(), ..Options::default() }, &control).unwrap()
}
