//! The direct model against closed forms, the literature and random robots.

use aspecta::kinematics::KinematicsError;
use aspecta::robot::{Leg, Platform, Robot};

/// The 3-RPR of Innocenti and Parenti-Castelli.
fn three_rpr() -> Robot {
    let (b12, b13, b23): (f64, f64, f64) = (17.04, 20.84, 16.54);
    let x = (b12 * b12 + b13 * b13 - b23 * b23) / (2.0 * b12);
    let b3 = [x, (b13 * b13 - x * x).sqrt()];
    let legs = vec![
        Leg::strut([0.0, 0.0], [0.0, 0.0]),
        Leg::strut([15.91, 0.0], [b12, 0.0]),
        Leg::strut([0.0, 10.0], b3),
    ];
    Robot::new("3-rpr", Platform::PlaneBody, legs).unwrap()
}

#[test]
fn the_3_rpr_of_innocenti_and_parenti_castelli_has_six_poses() {
    let q = [14.98, 15.38, 12.0];
    let found = three_rpr().direct_certified(&q).unwrap();
    for s in &found.solutions {
        println!("{:?} {} {} {}", s.pose, s.det_a, s.residual, s.certified);
    }
    assert!(found.complete);
    assert_eq!(found.solutions.len(), 6);
    assert!(found.solutions.iter().all(|s| s.certified && s.residual < 1e-14 && s.mode.to_string() == "---"));
    let _ = KinematicsError::StrutLength { leg: 1, value: 0.0 };
}
