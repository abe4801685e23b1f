//! Inverse and direct models and Jacobians. Run `cargo bench --bench kinematics`.

use aspecta::Kinematics;
use aspecta::num::Interval;
use aspecta::robot::{Actuator, Frame, Leg, Platform, Revolute, Robot, point};
use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;

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

/// Innocenti and Parenti-Castelli's, with six poses at (14.98, 15.38, 12).
fn three_rpr() -> Robot {
    let (b12, b13, b23): (f64, f64, f64) = (17.04, 20.84, 16.54);
    let x = (b12 * b12 + b13 * b13 - b23 * b23) / (2.0 * b12);
    let legs = vec![
        Leg::strut([0.0, 0.0], [0.0, 0.0]),
        Leg::strut([15.91, 0.0], [b12, 0.0]),
        Leg::strut([0.0, 10.0], [x, (b13 * b13 - x * x).sqrt()]),
    ];
    Robot::new("3-rpr", Platform::PlaneBody, legs).unwrap()
}

/// Cranks at 120°, turning in vertical planes.
fn delta() -> Robot {
    let leg = |k: usize| {
        let (s, c) = (k as f64 * std::f64::consts::TAU / 3.0).sin_cos();
        let frame: Frame = [[c, s, 0.0], [0.0, 0.0, -1.0], [-s, c, 0.0]].map(point);
        let actuator =
            Actuator::Revolute(Revolute { crank: Interval::decimal(0.2), rod: Interval::decimal(0.51) });
        let at = |r: f64| point([r * c, r * s, 0.0]);
        Leg { anchor: at(0.2), attachment: at(0.05), frame, actuator, limits: Vec::new() }
    };
    Robot::new("delta", Platform::TranslatingBody, (0..3).map(leg).collect()).unwrap()
}

fn kinematics(c: &mut Criterion) {
    let robots = [
        (five_bar(), vec![4.0, 7.0]),
        (three_rrr(), vec![-12.0, -4.0, 0.5]),
        (three_rpr(), vec![5.0, 10.0, 0.3]),
        (delta(), vec![0.05, 0.02, -0.5]),
        (Robot::resolve("spherical-3-rrr").unwrap(), vec![0.1, 0.2, 0.3]),
        (Robot::resolve("hexa").unwrap(), vec![10.0, 20.0, -600.0, 0.1, 0.2, 0.3]),
        (Robot::resolve("gough-stewart").unwrap(), vec![0.2, 0.1, 0.3, 0.1, 0.2, 0.3]),
    ];
    for (robot, pose) in &robots {
        let name = &robot.name;
        let inverse = robot.inverse(pose).unwrap();
        let q: &[f64] = match name.as_str() {
            "3-rpr" => &[14.98, 15.38, 12.0],
            // Dietmaier's, with 40 real poses.
            "gough-stewart" => &[1.0, 0.645275, 1.086284, 1.503439, 1.281933, 0.771071],
            _ => &inverse[0].q,
        };
        println!(
            "{name}: {} inverse solutions, {} direct solutions",
            inverse.len(),
            robot.direct(q).unwrap().len()
        );
        c.bench_function(&format!("{name}/leg solutions"), |b| {
            b.iter(|| robot.leg_solutions(black_box(pose)))
        });
        c.bench_function(&format!("{name}/inverse, all modes"), |b| {
            b.iter(|| robot.inverse(black_box(pose)))
        });
        c.bench_function(&format!("{name}/direct, plain"), |b| b.iter(|| robot.direct_poses(black_box(q))));
        c.bench_function(&format!("{name}/direct, certified"), |b| {
            b.iter(|| robot.direct_certified(black_box(q)))
        });
        c.bench_function(&format!("{name}/jacobians"), |b| {
            b.iter(|| robot.jacobians(black_box(pose), black_box(q)))
        });
    }
}

criterion_group!(benches, kinematics);
criterion_main!(benches);
