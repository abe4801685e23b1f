//! Singularities (Definitions 3 and 4) against the geometry that defines them.

use aspecta::Kinematics;
use aspecta::kinematics::KinematicsError;
use aspecta::kinematics::placement::Placement;
use aspecta::kinematics::{SINGULAR, Singularity, State};
use aspecta::num::Interval;
use aspecta::robot::{
    Actuator, BASE_FRAME, Leg, LegIndex, Platform, Prismatic, Revolute, Robot, Spherical, Strut, point,
};
use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI};

fn five_bar() -> Robot {
    let legs = vec![
        Leg::revolute([0.0, 0.0], [0.0, 0.0], 8.0, 5.0),
        Leg::revolute([9.0, 0.0], [0.0, 0.0], 5.0, 8.0),
    ];
    Robot::new("five-bar", Platform::PlanePoint, legs).unwrap()
}

/// Table 3, moved by (dx, dy), turned by `turn`, scaled, its legs in the order given.
fn three_rrr(shift: [f64; 2], turn: f64, scale: f64, order: [usize; 3]) -> Robot {
    let base = [[-10.0, -10.0], [10.0, -10.0], [0.0, 10.0]];
    let platform = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0]];
    let (s, c) = turn.sin_cos();
    let leg = |k: usize| {
        let [x, y] = base[k];
        let anchor = [scale * (c * x - s * y + shift[0]), scale * (s * x + c * y + shift[1])];
        Leg::revolute(anchor, platform[k].map(|p| scale * p), 10.0 * scale, 10.0 * scale)
    };
    Robot::new("3-rrr", Platform::PlaneBody, order.map(leg).to_vec()).unwrap()
}

/// A small rotation, so that nothing in a test is special by being aligned with the axes.
fn tilted(k: usize) -> [[Interval; 3]; 3] {
    let (s, c) = (0.3 + k as f64).sin_cos();
    [[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]].map(point)
}

fn spatial(platform: Platform, actuator: impl Fn(usize) -> Actuator) -> Robot {
    let leg = |k: usize| {
        let t = k as f64 * 1.1;
        let attachment = match platform {
            Platform::TurningBody => [t.cos() * 0.8, t.sin() * 0.8, 0.6],
            _ => [0.5 * t.cos(), 0.5 * t.sin(), 0.1 * t],
        };
        Leg {
            anchor: if platform == Platform::TurningBody {
                point([0.0; 3])
            } else {
                point([2.0 * t.sin(), 2.0 * t.cos(), 0.2 * t])
            },
            attachment: point(attachment),
            frame: if k == 0 { BASE_FRAME } else { tilted(k) },
            actuator: actuator(k),
            limits: Vec::new(),
        }
    };
    Robot::new(platform.name(), platform, (0..platform.dof()).map(leg).collect()).unwrap()
}

/// One robot of each platform, with every kind of actuator.
fn one_of_each() -> Vec<Robot> {
    let length = Interval::decimal;
    let revolute = Actuator::Revolute(Revolute { crank: length(1.5), rod: length(2.5) });
    let prismatic = Actuator::Prismatic(Prismatic { rod: length(2.0) });
    let spherical =
        Actuator::Spherical(Spherical { proximal: (length(0.6), length(0.8)), distal_cos: length(0.28) });
    vec![
        five_bar(),
        three_rrr([0.0; 2], 0.0, 1.0, [0, 1, 2]),
        spatial(Platform::TranslatingBody, |k| if k == 0 { revolute } else { prismatic }),
        spatial(Platform::TurningBody, |_| spherical),
        spatial(Platform::FreeBody, |k| [Actuator::Strut(Strut), revolute, prismatic][k % 3]),
    ]
}

/// The left sides of the leg equations.
fn closure(robot: &Robot, pose: &[f64], q: &[f64]) -> Vec<f64> {
    fn at<const D: usize>(robot: &Robot, pose: &[f64], q: &[f64]) -> Vec<f64> {
        let placement = Placement::<f64, D>::at(robot.platform, pose);
        let f = |(leg, q): (&Leg, &f64)| leg.actuator.equation(&placement.span(leg, &placement.arm(leg)), *q);
        robot.legs.iter().zip(q).map(f).collect()
    }
    if robot.platform.space() == 2 { at::<2>(robot, pose, q) } else { at::<3>(robot, pose, q) }
}

/// det ∂f/∂X by central differences in the pose coordinates. For roll, pitch and yaw the angular velocity is
/// E · rates with det E = cos(pitch).
fn det_by_differences(robot: &Robot, pose: &[f64], q: &[f64]) -> f64 {
    let n = robot.dof();
    let h = 1e-5;
    let derivative = |k: usize| {
        let moved = |by: f64| {
            let mut x = pose.to_vec();
            x[k] += by;
            closure(robot, &x, q)
        };
        let (fore, back) = (moved(h), moved(-h));
        fore.iter().zip(&back).map(|(a, b)| (a - b) / (2.0 * h)).collect::<Vec<_>>()
    };
    let columns: Vec<_> = (0..n).map(derivative).collect();
    let det = nalgebra::DMatrix::from_fn(n, n, |j, k| columns[k][j]).determinant();
    match robot.platform.coordinates().iter().position(|c| c.name == "pitch") {
        Some(k) => det / pose[k].cos(),
        None => det,
    }
}

proptest! {
    #[test]
    fn det_a_by_finite_differences(which in 0usize..5, x in prop::array::uniform6(-1.2f64..1.2),
                                   q in prop::array::uniform6(0.3f64..3.0)) {
        let robot = &one_of_each()[which];
        let (pose, q) = (&x[..robot.dof()], &q[..robot.dof()]);
        let state = robot.state(pose, q).unwrap();
        let det = det_by_differences(robot, pose, q);
        // Terms of det A are products of row norms: judge the difference by them.
        let size: f64 = state.a.iter().map(|r| r.iter().map(|x| x * x).sum::<f64>().sqrt()).product();
        prop_assert!((state.det_a - det).abs() < 1e-7 * size.max(1.0), "{}: {} {}", robot.name, state.det_a, det);
    }

    /// The measures are numbers of the geometry, not of the coordinates it is written in.
    #[test]
    fn state_does_not_depend_on_place_scale_and_numbering(
        x in -12.0f64..2.0, y in -9.0f64..5.0, phi in -3.0f64..3.0,
        shift in prop::array::uniform2(-30.0f64..30.0), turn in -3.0f64..3.0,
        scale in prop::sample::select(vec![1e-3, 0.7, 1e3]), mode in 0usize..8,
    ) {
        let robot = three_rrr([0.0; 2], 0.0, 1.0, [0, 1, 2]);
        let solutions = robot.inverse(&[x, y, phi]).unwrap();
        prop_assume!(!solutions.is_empty());
        let here = robot.state(&[x, y, phi], &solutions[mode].q).unwrap();
        let order = [2, 0, 1];
        let there = three_rrr(shift, turn, scale, order);
        let (s, c) = turn.sin_cos();
        let pose = [scale * (c * x - s * y + shift[0]), scale * (s * x + c * y + shift[1]), phi + turn];
        let q: Vec<_> = order.iter().map(|&k| here.q[k] + turn).collect();
        let moved = there.state(&pose, &q).unwrap();
        prop_assert!((here.parallel_measure - moved.parallel_measure).abs() < 1e-9);
        for (k, &old) in order.iter().enumerate() {
            prop_assert!((here.serial_measures[old] - moved.serial_measures[k]).abs() < 1e-9);
        }
        prop_assert!((1.0 - moved.condition_a / here.condition_a).abs() < 1e-9 * here.condition_a);
        // det A has units: length⁴ for two force rows and a moment row, times the sign of the permutation (+).
        prop_assert!((moved.det_a / scale.powi(4) - here.det_a).abs() < 1e-8 * 10f64.powi(4));
    }

    /// The geometric gap and the algebraic reach agree on who is out of reach.
    #[test]
    fn gap_is_positive_where_reach_is_negative(which in 0usize..5, x in prop::array::uniform6(-4.0f64..4.0)) {
        let robot = &one_of_each()[which];
        let pose = &x[..robot.dof()];
        let unreached = robot.out_of_reach(pose).unwrap();
        prop_assert!(unreached.iter().all(|o| o.gap > 0.0));
        for (k, leg) in robot.leg_solutions(pose).unwrap().iter().enumerate() {
            prop_assert_eq!(leg.reach < 0.0, unreached.iter().any(|o| o.leg == LegIndex::new(k)));
        }
    }

    /// On a configuration the measure from B is the root of the reach from X alone.
    #[test]
    fn serial_measure_is_the_root_of_reach(which in 0usize..5, x in prop::array::uniform6(-1.5f64..1.5)) {
        let robot = &one_of_each()[which];
        let pose = &x[..robot.dof()];
        let legs = robot.leg_solutions(pose).unwrap();
        for solution in robot.inverse(pose).unwrap() {
            let state = robot.state(pose, &solution.q).unwrap();
            for (measure, leg) in state.serial_measures.iter().zip(&legs) {
                prop_assert!((measure * measure - leg.reach).abs() < 1e-12, "{}: {measure} {leg:?}", robot.name);
            }
            if state.singularity == Singularity::Regular {
                prop_assert_eq!(state.mode, Some(solution.mode));
            }
        }
    }
}

/// B1, C1 and B2 in line: a parallel singularity and no serial one.
#[test]
fn five_bar_with_distal_links_in_line_is_parallel_singular() {
    // B1 = (0, 8); C1 5 beyond it towards B2, 8 from it: |B1B2| = 13 with B2 = (9 + 5 cos t, 5 sin t).
    let robot = five_bar();
    let b1 = |t1: f64| [8.0 * t1.cos(), 8.0 * t1.sin()];
    let b2 = |t2: f64| [9.0 + 5.0 * t2.cos(), 5.0 * t2.sin()];
    let gap = |t1: f64, t2: f64| (b2(t2)[0] - b1(t1)[0]).hypot(b2(t2)[1] - b1(t1)[1]) - 13.0;
    for t2 in [-0.9, -0.2, 0.4, 1.0] {
        let t1 = bisect(|t| gap(t, t2), 0.7, 0.7 + PI);
        let (p, r) = (b1(t1), b2(t2));
        let pose = [p[0] + (r[0] - p[0]) * 5.0 / 13.0, p[1] + (r[1] - p[1]) * 5.0 / 13.0];
        let state = robot.state(&pose, &[t1, t2]).unwrap();
        assert!(state.residual < 1e-14);
        assert_eq!(state.singularity, Singularity::Parallel, "{state:?}");
        assert!(state.parallel_measure < 1e-13 && state.condition_a > 1e12);
        assert!(state.serial_legs.is_empty() && state.mode.is_some());
    }
}

/// A1, B1, C1 in line: |A1C1| = 8 + 5 or 8 − 5. The pose is turned about A1 so that nothing is axis-aligned.
#[test]
fn five_bar_with_a_stretched_or_folded_leg_is_serial_singular() {
    let robot = five_bar();
    for (distance, turn) in [(13.0, 0.7f64), (13.0, 0.1), (3.0, 0.3), (3.0, -0.5)] {
        let pose = [distance * turn.cos(), distance * turn.sin()];
        let q2 = robot.leg_solutions(&pose).unwrap()[1].q[0].expect("leg 2 reaches the pose");
        let state = robot.state(&pose, &[turn, q2]).unwrap();
        assert_eq!(state.serial_legs, [LegIndex::new(0)], "{state:?}");
        assert_eq!((state.singularity, state.mode), (Singularity::Serial, None));
        assert!(state.residual < 1e-14 && state.serial_measures[1] > 0.1 && state.parallel_measure > 0.01);
        assert!(state.condition_b > 1e6 && state.det_b.abs() < 1e-10);
    }
}

/// Both legs stretched along one line: A1, B1, C1, B2, A2 in line needs |A1A2| = 13 + 13.
#[test]
fn everything_in_line_is_the_third_kind() {
    let legs = vec![
        Leg::revolute([0.0, 0.0], [0.0, 0.0], 8.0, 5.0),
        Leg::revolute([26.0, 0.0], [0.0, 0.0], 5.0, 8.0),
    ];
    let robot = Robot::new("stretched", Platform::PlanePoint, legs).unwrap();
    let state = robot.state(&[13.0, 0.0], &[0.0, PI]).unwrap();
    assert_eq!(state.singularity, Singularity::Both);
    assert_eq!((state.serial_legs, state.mode), ([0, 1].map(LegIndex::new).to_vec(), None));
}

/// A 3-RRR built so that its rods point to one given point, or are parallel: its A is singular.
fn with_rods(directions: [f64; 3]) -> State {
    let platform = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0]];
    let cranks = [0.4, 1.9, -2.2];
    let legs = (0..3).map(|k| {
        let anchor = std::array::from_fn(|i| {
            let part = |t: f64| if i == 0 { t.cos() } else { t.sin() };
            platform[k][i] - 10.0 * part(directions[k]) - 7.0 * part(cranks[k])
        });
        Leg::revolute(anchor, platform[k], 7.0, 10.0)
    });
    let robot = Robot::new("aimed", Platform::PlaneBody, legs.collect()).unwrap();
    robot.state(&[0.0, 0.0, 0.0], &cranks).unwrap()
}

#[test]
fn three_rrr_with_concurrent_or_parallel_rods_is_parallel_singular() {
    let towards = |x: f64, y: f64| [y.atan2(x), y.atan2(x - 10.0), (y - 10.0).atan2(x - 10.0)];
    for directions in [towards(4.0, 7.0), towards(-30.0, 2.0), [0.3; 3], [0.3, 0.3 + PI, 0.3]] {
        let state = with_rods(directions);
        assert!(state.residual < 1e-14);
        assert_eq!(state.singularity, Singularity::Parallel, "{state:?}");
    }
    // A nudge away from the common point is no longer singular.
    let mut nudged = towards(4.0, 7.0);
    nudged[0] += 1e-3;
    let state = with_rods(nudged);
    assert_eq!(state.singularity, Singularity::Regular);
    assert!(state.parallel_measure > SINGULAR && state.parallel_measure < 1e-3);
}

/// C_i = A_i of Table 3's robot (L = M): a serial singularity whatever α_i is.
#[test]
fn three_rrr_with_a_leg_folded_onto_its_anchor() {
    let robot = three_rrr([0.0; 2], 0.0, 1.0, [0, 1, 2]);
    let legs = robot.leg_solutions(&[-10.0, -10.0, 0.2]).unwrap();
    let rest = |k: usize| legs[k].q[0].unwrap();
    for alpha in [0.0, 1.0, -2.5] {
        let state = robot.state(&[-10.0, -10.0, 0.2], &[alpha, rest(1), rest(2)]).unwrap();
        assert_eq!(
            (state.singularity, &state.serial_legs[..]),
            (Singularity::Serial, &[LegIndex::new(0)][..])
        );
        assert!(state.residual < 1e-13);
    }
}

/// Perpendicular rods are the best a five-bar can have: homogeneous A orthogonal.
#[test]
fn perpendicular_rods_have_condition_one() {
    let legs = vec![
        Leg::revolute([-5.0, 8.0], [0.0, 0.0], 8.0, 5.0),
        Leg::revolute([-3.0, -4.0], [0.0, 0.0], 3.0, 4.0),
    ];
    let robot = Robot::new("square", Platform::PlanePoint, legs).unwrap();
    let state = robot.state(&[0.0, 0.0], &[-FRAC_PI_2, 0.0]).unwrap();
    assert!(state.residual < 1e-15);
    assert!((state.condition_a - 1.0).abs() < 1e-14 && (state.parallel_measure - 1.0).abs() < 1e-14);
    assert!(state.serial_measures.iter().all(|m| (m - 1.0).abs() < 1e-14));
}

#[test]
fn how_far_out_of_reach() {
    let robot = five_bar();
    let too_far = robot.out_of_reach(&[-20.0, 0.0]).unwrap();
    assert_eq!(too_far.iter().map(|o| o.leg).collect::<Vec<_>>(), [0, 1].map(LegIndex::new));
    assert!((too_far[0].gap - 7.0).abs() < 1e-13 && (too_far[1].gap - 16.0).abs() < 1e-13);
    let too_near = robot.out_of_reach(&[1.0, 0.0]).unwrap();
    assert_eq!(too_near.len(), 1);
    assert!((too_near[0].gap - 2.0).abs() < 1e-13 && !too_near[0].angle);
    assert!(robot.out_of_reach(&[4.0, 7.0]).unwrap().is_empty());
}

#[test]
fn numbers_too_large_for_doubles_are_refused() {
    let error = five_bar().state(&[4.0, -1e300], &[0.0, 0.0]).unwrap_err();
    assert_eq!(error, KinematicsError::TooLarge { what: "pose", index: 2, value: -1e300 });
    assert!(five_bar().direct(&[1e9, 1.0]).is_err() && five_bar().inverse(&[1e200, 7.0]).is_err());
}

fn bisect(f: impl Fn(f64) -> f64, mut lo: f64, mut hi: f64) -> f64 {
    let rising = f(lo) < 0.0;
    assert_ne!(rising, f(hi) < 0.0, "no change of sign in [{lo}, {hi}]");
    for _ in 0..80 {
        let mid = 0.5 * (lo + hi);
        if (f(mid) < 0.0) == rising { lo = mid } else { hi = mid }
    }
    lo
}
