//! The numbers of the paper.

use aspecta::Kinematics;
use aspecta::motion::{ProfilePoint, check_path};
use aspecta::robot::{Leg, Platform, Robot};

fn five_bar() -> Robot {
    let legs = vec![
        Leg::revolute([0.0, 0.0], [0.0, 0.0], 8.0, 5.0),
        Leg::revolute([9.0, 0.0], [0.0, 0.0], 5.0, 8.0),
    ];
    Robot::new("five-bar", Platform::PlanePoint, legs).unwrap()
}

fn three_rrr() -> Robot {
    let legs = vec![
        Leg::revolute([-10.0, -10.0], [0.0, 0.0], 10.0, 10.0),
        Leg::revolute([10.0, -10.0], [10.0, 0.0], 10.0, 10.0),
        Leg::revolute([0.0, 10.0], [10.0, 10.0], 10.0, 10.0),
    ];
    Robot::new("3-rrr", Platform::PlaneBody, legs).unwrap()
}

/// Table 1: B_11 and B_22 as the paper writes them have the signs of the working mode.
#[test]
fn table_1_signs_of_b() {
    let robot = five_bar();
    let (x, y) = (4.0, 7.0);
    let solutions = robot.inverse(&[x, y]).unwrap();
    let names: Vec<_> = solutions.iter().map(|s| s.mode.to_string()).collect();
    assert_eq!(names, ["++", "+-", "--", "-+"]);
    for s in &solutions {
        let (t1, t2) = (s.q[0], s.q[1]);
        let b11 = 8.0 * t1.sin() * (x - 8.0 * t1.cos()) - 8.0 * t1.cos() * (y - 8.0 * t1.sin());
        let b22 = 5.0 * t2.sin() * (x - 5.0 * t2.cos() - 9.0) - 5.0 * t2.cos() * (y - 5.0 * t2.sin());
        let det =
            (x - 8.0 * t1.cos()) * (y - 5.0 * t2.sin()) - (x - 5.0 * t2.cos() - 9.0) * (y - 8.0 * t1.sin());
        assert_eq!([b11 > 0.0, b22 > 0.0], [s.mode.sign(0) > 0, s.mode.sign(1) > 0]);
        assert!((s.det_a - 4.0 * det).abs() < 1e-9);
        assert!(s.residual < 1e-14 && s.certified);
        let j = robot.jacobians(&[x, y], &s.q).unwrap();
        assert!((j.b[0] - 2.0 * b11).abs() < 1e-9 && (j.b[1] - 2.0 * b22).abs() < 1e-9);
    }
}

/// Table 4: the first and last point have the same joint vector in mode +++, to 0.02°.
#[test]
fn table_4_ends_have_the_same_joint_vector() {
    let robot = three_rrr();
    let mode = "+++".parse().unwrap();
    let q1 = robot.inverse_in(&[-15.468, 0.781, 0.073], mode).unwrap().unwrap();
    let q3 = robot.inverse_in(&[-9.902, -7.091, 1.081], mode).unwrap().unwrap();
    for (a, b) in q1.iter().zip(&q3) {
        assert!((a - b).abs().to_degrees() < 0.02, "{q1:?} {q3:?}");
    }
}

/// Section 4.1.5: along Table 4's path no determinant vanishes, proved between the samples too.
const TABLE_4: [[f64; 3]; 3] = [[-15.468, 0.781, 0.073], [-15.468, -7.091, 0.500], [-9.902, -7.091, 1.081]];

#[test]
fn table_4_path_meets_no_singularity() {
    let check = check_path(&three_rrr(), &TABLE_4.map(Vec::from), "+++".parse().unwrap()).unwrap();
    assert!(check.singularity_free == Some(true) && check.obstacle.is_none());
    let least = &check.clearance.as_ref().unwrap().det_a;
    assert!(
        least.at_least > 6842.0 && least.at_most < 6843.0 && least.at_most - least.at_least < 0.01,
        "{least:?}"
    );
    assert!(least.segment == 2 && (least.t - 0.389).abs() < 1e-3, "{least:?}");
    // Figure 11: nothing changes sign.
    let signs = |f: &dyn Fn(&ProfilePoint) -> f64| check.profile.iter().all(|p| f(p) > 0.0);
    assert!(
        (0..3).all(|j| signs(&|p| p.relative_b[j]))
            && (signs(&|p| p.relative_det_a) || signs(&|p| -p.relative_det_a))
    );
}

/// The way back in mode ++- meets a singularity, and its place is said: there det A is nought or a leg is stretched.
#[test]
fn table_4_reversed_in_another_mode_is_refused() {
    let robot = three_rrr();
    let mut poses = TABLE_4.map(Vec::from);
    poses.reverse();
    let check = check_path(&robot, &poses, "++-".parse().unwrap()).unwrap();
    assert_eq!(check.singularity_free, Some(false));
    let obstacle = check.obstacle.unwrap();
    let mode = "++-".parse().unwrap();
    let state =
        robot.inverse_in(&obstacle.pose, mode).unwrap().map(|q| robot.state(&obstacle.pose, &q).unwrap());
    let nearest = state.map_or(0.0, |s| s.serial_measures.iter().copied().fold(s.parallel_measure, f64::min));
    assert!(obstacle.proved && nearest < 1e-5, "{obstacle:?}: {nearest}");
}

/// Straight up, leg 1 stretches out before (4, 14): a serial singularity, then out of reach.
#[test]
fn a_path_through_a_singularity_is_refused_with_its_place() {
    let path = [vec![4.0, 7.0], vec![4.0, 14.0]];
    let check = check_path(&five_bar(), &path, "++".parse().unwrap()).unwrap();
    assert_eq!(check.singularity_free, Some(false));
    let obstacle = check.obstacle.unwrap();
    assert!(obstacle.proved && obstacle.segment == 1 && obstacle.t.0 > 0.0);
}
