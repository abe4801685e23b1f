//! Every built-in robot is a working robot with the figures it claims.

use aspecta::Kinematics;
use aspecta::kinematics::Solution;
use aspecta::num::Interval;
use aspecta::robot::{Actuator, BASE_FRAME, Platform, Revolute, Robot, catalogue};
use nalgebra::{Matrix6, Rotation3, Vector6};
use proptest::prelude::RngExt;
use proptest::test_runner::{RngAlgorithm, TestRng};

fn robot(name: &str) -> Robot {
    catalogue::find(name).unwrap_or_else(|| panic!("no robot {name}"))
}

/// The poses among `tries` random ones in the robot's window that are within reach of all legs.
fn reachable(robot: &Robot, tries: usize) -> Vec<Vec<Solution>> {
    let window = robot.workspace_window().unwrap();
    let mut rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let mut found = Vec::new();
    for _ in 0..tries {
        let pose: Vec<_> = window.ranges.iter().map(|&(lo, hi)| rng.random_range(lo..hi)).collect();
        let solutions = robot.inverse(&pose).unwrap();
        if !solutions.is_empty() {
            found.push(solutions);
        }
    }
    found
}

#[test]
fn names_are_those_of_the_contract() {
    let mut names: Vec<_> = catalogue::all().iter().map(|e| e.name).collect();
    names.sort_unstable();
    let mut wanted = [
        "five-bar",
        "3-rrr",
        "3-rpr",
        "symmetric-five-bar",
        "2-prr",
        "3-prr",
        "delta",
        "irb-360",
        "linear-delta",
        "orthoglide",
        "spherical-3-rrr",
        "hexa",
        "gough-stewart",
    ];
    wanted.sort_unstable();
    assert_eq!(names, wanted);
    let directory = concat!(env!("CARGO_MANIFEST_DIR"), "/../../robots");
    let files = std::fs::read_dir(directory).unwrap().map(|f| f.unwrap().path());
    assert_eq!(files.filter(|f| f.extension().is_some_and(|e| e == "toml")).count(), wanted.len());
}

#[test]
fn every_file_is_a_robot_and_names_its_source() {
    for entry in catalogue::all() {
        let robot = Robot::from_toml(entry.text, entry.name).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(robot.name, entry.name);
        assert!(!robot.title.is_empty() && !robot.source.is_empty(), "{}", entry.name);
        assert_eq!(Some(robot), catalogue::find(entry.name));
    }
    assert!(catalogue::find("no-such-robot").is_none());
}

#[test]
fn windows_are_bounded() {
    for entry in catalogue::all() {
        let window = robot(entry.name).workspace_window().unwrap_or_else(|e| panic!("{e}"));
        assert!(window.ranges.iter().all(|(lo, hi)| lo < hi), "{}: {window:?}", entry.name);
    }
}

#[test]
fn frames_are_orthonormal_and_exact_where_they_can_be() {
    for entry in catalogue::all() {
        for leg in robot(entry.name).legs {
            for i in 0..3 {
                for j in 0..3 {
                    let dot = (0..3).map(|k| leg.frame[i][k] * leg.frame[j][k]);
                    let error = dot.fold(Interval::point(-f64::from(i == j)), |s, t| s + t);
                    assert!(error.contains(0.0) && error.width() < 1e-14, "{}: {i} {j}", entry.name);
                }
            }
            if matches!(entry.name, "five-bar" | "3-rrr" | "3-rpr" | "gough-stewart") {
                assert_eq!(leg.frame, BASE_FRAME, "{}", entry.name);
            }
            if matches!(entry.name, "2-prr" | "linear-delta" | "orthoglide" | "spherical-3-rrr") {
                let exact = |x: &Interval| x.lo == x.hi && [-1.0, 0.0, 1.0].contains(&x.lo);
                assert!(leg.frame.concat().iter().all(exact), "{}", entry.name);
            }
        }
    }
}

/// Inverse solutions satisfy the leg equations, in as many modes as the legs have postures, and some pose
/// respects the joint limits.
#[test]
fn every_robot_has_poses_and_their_solutions_close_the_legs() {
    for entry in catalogue::all() {
        let robot = robot(entry.name);
        let tries = if robot.dof() == 6 { 20_000 } else { 2_000 };
        let poses = reachable(&robot, tries);
        assert!(!poses.is_empty(), "{}: nothing within reach", entry.name);
        let modes: usize = robot.legs.iter().map(|l| l.actuator.postures()).product();
        for solutions in &poses {
            assert_eq!(solutions.len(), modes, "{}", entry.name);
            for s in solutions {
                assert!(s.residual < 1e-12, "{}: {s:?}", entry.name);
                assert_eq!(robot.jacobians(&s.pose, &s.q).unwrap().mode(), s.mode, "{}", entry.name);
            }
        }
        assert!(poses.iter().flatten().any(|s| s.within_limits), "{}: limits exclude all", entry.name);
    }
}

/// No robot is singular throughout a working mode, as one whose legs coincide would be.
#[test]
fn no_working_mode_is_singular_everywhere() {
    for entry in catalogue::all() {
        let robot = robot(entry.name);
        let poses = reachable(&robot, if robot.dof() == 6 { 5_000 } else { 500 });
        for mode in robot.working_modes() {
            let relative_det = |s: &Solution| {
                let rows = robot.jacobians(&s.pose, &s.q).unwrap().a;
                let norms: f64 = rows.iter().map(|r| r.iter().map(|x| x * x).sum::<f64>().sqrt()).product();
                s.det_a.abs() / norms
            };
            let best = poses.iter().flatten().filter(|s| s.mode == mode).map(relative_det);
            let best = best.fold(0.0, f64::max);
            // Rounding leaves 1e-15 of a determinant that is zero.
            assert!(best > 1e-9, "{} {mode}: {best}", entry.name);
        }
    }
}

fn within(x: Interval, value: f64) -> bool {
    x.contains(value) && x.width() < 1e-12
}

#[test]
fn the_papers_robots_have_the_papers_figures() {
    let five_bar = robot("five-bar");
    let links: Vec<_> = five_bar.legs.iter().map(|l| (l.anchor[0].lo, l.actuator)).collect();
    let revolute = |crank, rod| {
        Actuator::Revolute(Revolute { crank: Interval::point(crank), rod: Interval::point(rod) })
    };
    assert_eq!(links, [(0.0, revolute(8.0, 5.0)), (9.0, revolute(5.0, 8.0))]);
    let rrr = robot("3-rrr");
    let q1 = rrr.inverse_in(&[-15.468, 0.781, 0.073], "+++".parse().unwrap()).unwrap().unwrap();
    let q3 = rrr.inverse_in(&[-9.902, -7.091, 1.081], "+++".parse().unwrap()).unwrap().unwrap();
    assert!(q1.iter().zip(&q3).all(|(a, b)| (a - b).abs().to_degrees() < 0.02));
}

#[test]
fn the_3_rpr_platform_has_the_sides_of_innocenti_and_parenti_castelli() {
    let legs = robot("3-rpr").legs;
    let distance = |i: usize, j: usize| {
        let d = |k: usize| legs[i].attachment[k].mid() - legs[j].attachment[k].mid();
        d(0).hypot(d(1))
    };
    for ((i, j), side) in [((0, 1), 17.04), ((0, 2), 20.84), ((1, 2), 16.54)] {
        assert!((distance(i, j) - side).abs() < 1e-14 * side);
    }
    assert!(legs[2].attachment[1].lo > 0.0 && legs[1].attachment[1] == Interval::point(0.0));
    assert!(legs.iter().all(|l| l.length_range() == Some((Interval::point(10.0), Interval::point(32.0)))));
    assert!(within(legs[1].anchor[0], 15.91) && legs[2].anchor[1] == Interval::point(10.0));
}

/// Williams' example: at (0, 0, −0.9) m the IRB 360-1/1600 has all driven angles at −20.5°, at (0.3, 0.5, −1.1) m
/// other ones; here recomputed from his own solution E cos θ + F sin θ + G = 0 with the elbows outward.
#[test]
fn the_delta_hangs_below_its_motors() {
    let robot = robot("delta");
    let (w_b, u_p, l, m) = (164.0_f64, 44.0_f64, 524.0_f64, 1244.0_f64);
    for (x, y, z) in [(0.0, 0.0, -900.0), (300.0, 500.0, -1100.0), (-200.0, 100.0, -950.0)] {
        let q = robot.inverse(&[x, y, z]).unwrap();
        let expected = [-90.0_f64, 30.0, 150.0].map(|azimuth| {
            let (s, c) = azimuth.to_radians().sin_cos();
            let (out, across) = (x * c + y * s + u_p - w_b, -x * s + y * c);
            // ‖(out − l cos θ, across, z + l sin θ)‖ = m, of the two roots the one with the elbow farther out.
            let (e, f) = (-2.0 * l * out, 2.0 * l * z);
            let g = out * out + across * across + z * z + l * l - m * m;
            let root = |sign: f64| 2.0 * ((-f + sign * (e * e + f * f - g * g).sqrt()) / (g - e)).atan();
            let (a, b) = (root(1.0), root(-1.0));
            if a.cos() > b.cos() { a } else { b }
        });
        let close = |s: &Solution| s.q.iter().zip(&expected).all(|(a, b)| (a - b).abs() < 1e-9);
        assert_eq!(q.iter().filter(|s| close(s)).count(), 1, "{expected:?}");
    }
    let q = robot.inverse(&[0.0, 0.0, -900.0]).unwrap();
    assert!(q.iter().any(|s| s.q.iter().all(|q| (q.to_degrees() + 20.5).abs() < 0.05)), "{q:?}");
}

#[test]
fn the_orthoglide_is_isotropic_at_its_centre() {
    let robot = robot("orthoglide");
    let q = robot.inverse_in(&[0.0; 3], "+++".parse().unwrap()).unwrap().unwrap();
    assert!(q.iter().all(|q| (q - 310.58).abs() < 1e-9));
    let a = robot.jacobians(&[0.0; 3], &q).unwrap().a;
    for i in 0..3 {
        for j in 0..3 {
            assert!((i == j) == (a[i][j].abs() > 1e-9));
        }
    }
}

#[test]
fn the_agile_eye_closes_at_its_reference_orientation() {
    let robot = robot("spherical-3-rrr");
    assert_eq!(robot.platform, Platform::TurningBody);
    let reference = robot.jacobians(&[0.0; 3], &[0.0; 3]).unwrap();
    assert_eq!(reference.residual, 0.0);
    assert!(reference.b.iter().all(|b| (b.abs() - 1.0).abs() < 1e-15));
    assert!((reference.det_a().abs() - 1.0).abs() < 1e-15);
}

/// All cranks at the same angle: the platform stands level on the z axis, below.
#[test]
fn the_hexa_hangs_level_below_its_motors() {
    let robot = robot("hexa");
    let pose = [0.0, 0.0, -600.0, 0.0, 0.0, 0.0];
    let level = |s: &Solution| s.q.iter().all(|q| (q - s.q[0]).abs() < 1e-9);
    let solutions = robot.inverse(&pose).unwrap();
    assert_eq!(solutions.len(), 64);
    assert_eq!(solutions.iter().filter(|s| level(s)).count(), 2);
    assert!(solutions.iter().filter(|s| level(s)).all(|s| s.det_a.abs() > 1.0));
}

/// Newton's method in the pose coordinates, by finite differences, from `pose` towards strut lengths `wanted`.
pub fn newton(robot: &Robot, mut pose: Vector6<f64>, wanted: &Vector6<f64>) -> Option<Vector6<f64>> {
    let lengths = |x: &Vector6<f64>| {
        let solutions = robot.inverse(x.as_slice()).ok()?;
        Some(Vector6::from_column_slice(&solutions.first()?.q))
    };
    for _ in 0..40 {
        let error = lengths(&pose)? - wanted;
        if error.norm() < 1e-13 {
            return Some(pose);
        }
        let mut slope = Matrix6::zeros();
        for k in 0..6 {
            let step = Vector6::from_fn(|i, _| if i == k { 1e-6 } else { 0.0 });
            slope.set_column(k, &((lengths(&(pose + step))? - lengths(&(pose - step))?) / 2e-6));
        }
        let step = slope.lu().solve(&error)?;
        pose -= step * (0.5 / step.norm()).min(1.0);
    }
    None
}

/// Dietmaier's figures are those with 40 real postures: a search from random poses finds them all.
#[test]
fn the_gough_stewart_platform_has_dietmaiers_40_postures() {
    let robot = robot("gough-stewart");
    let wanted = Vector6::new(1.0, 0.645275, 1.086284, 1.503439, 1.281933, 0.771071);
    let range = |k: usize| robot.legs[k].length_range().unwrap();
    assert!((0..6).all(|k| range(k).0.hi < wanted[k] && wanted[k] < range(k).1.lo));
    let mut rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let mut found: Vec<Vec<f64>> = Vec::new();
    for _ in 0..60_000 {
        let start = Vector6::from_fn(|k, _| rng.random_range(if k < 3 { -1.0..1.0 } else { -3.2..3.2 }));
        let Some(pose) = newton(&robot, start, &wanted) else { continue };
        let turned = Rotation3::from_euler_angles(pose[3], pose[4], pose[5]);
        let place: Vec<_> = pose.iter().take(3).chain(turned.matrix()).copied().collect();
        let same = |other: &Vec<f64>| other.iter().zip(&place).all(|(a, b)| (a - b).abs() < 1e-6);
        if !found.iter().any(same) {
            found.push(place);
        }
        if found.len() == 40 {
            return;
        }
    }
    panic!("only {} postures", found.len());
}
