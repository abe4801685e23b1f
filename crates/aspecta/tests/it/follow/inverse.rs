//! The inverse problem followed: the same mode, no jumps of angles, a refusal where a leg's reach ends.

use super::{closed_path, robot, start};
use crate::random::Random;
use aspecta::Kinematics;
use aspecta::motion::follow::{InverseFollower, Refusal, StartError};
use aspecta::robot::LegIndex;
use std::f64::consts::TAU;

/// Along random paths q is the inverse solution of the mode, but for full turns, and changes little from step to step.
#[test]
fn the_joint_vector_is_continuous_and_of_the_mode() {
    let random = &mut Random(3);
    for name in ["five-bar", "2-prr", "3-rrr", "3-rpr", "delta", "spherical-3-rrr", "hexa", "gough-stewart"] {
        let robot = robot(name);
        let mut steps = 0;
        while steps < 3000 {
            let (middle, mode) = start(&robot, random);
            let poses = closed_path(&robot, &middle, 0.3, 500, random);
            let Ok(mut follower) = InverseFollower::new(&robot, &poses[0], mode) else { continue };
            for pose in &poses {
                let before = follower.q().to_vec();
                let Ok(step) = follower.step(pose) else { break };
                let plain = robot.inverse_in(pose, mode).unwrap().expect("in reach");
                for (j, leg) in robot.legs.iter().enumerate() {
                    let turns = (step.q()[j] - plain[j]) / TAU;
                    let off = if leg.actuator.is_angle() { turns - turns.round() } else { turns };
                    assert!(off.abs() < 1e-12 * plain[j].abs().max(1.0), "{name}: {:?}, {plain:?}", step.q());
                    assert!(!leg.actuator.is_angle() || (step.q()[j] - before[j]).abs() < 2.0);
                }
                steps += 1;
            }
        }
    }
}

/// A point carried round the first motor takes its crank with it: one full turn.
#[test]
fn a_full_turn_is_a_full_turn() {
    let robot = robot("five-bar");
    // Round (0, 0), within the reach of both legs, 3 < |A1 C| < 13 and 3 < |A2 C| < 13.
    let pose = |i: usize| {
        let (s, c) = (TAU * i as f64 / 1000.0).sin_cos();
        [3.5 * c, 3.5 * s]
    };
    let mut follower = InverseFollower::new(&robot, &pose(0), "++".parse().unwrap()).unwrap();
    let start = follower.q().to_vec();
    for i in 0..=1000 {
        follower.step(&pose(i)).unwrap();
    }
    let q = follower.q();
    assert!((q[0] - start[0] - TAU).abs() < 1e-9 && (q[1] - start[1]).abs() < 1e-9, "{start:?} to {q:?}");
}

/// Leg 1 reaches from 3 to 13 about the origin.
#[test]
fn the_end_of_reach_is_refused() {
    let robot = robot("five-bar");
    for steps in [3, 100, 5000] {
        let mut follower = InverseFollower::new(&robot, &[8.0, 6.0], "++".parse().unwrap()).unwrap();
        let pose = |i: usize| {
            let r = 10.0 + 3.5 * i as f64 / steps as f64;
            [0.8 * r, 0.6 * r]
        };
        let refusal = (1..=steps).find_map(|i| follower.step(&pose(i)).err()).expect("a leg of length 13");
        let Refusal::Serial { leg, proved, singular_at, distance } = refusal else { panic!("{refusal}") };
        assert_eq!(leg, LegIndex::new(0));
        let (x, y) = (follower.pose()[0], follower.pose()[1]);
        let step = 3.5 / steps as f64;
        let reach = |t: f64| x.hypot(y) + t * step;
        assert!(reach(proved) < 13.0 && (reach(singular_at) - 13.0).abs() < 0.02, "{refusal}");
        assert!(distance < 0.1 && proved < singular_at, "{refusal}");
    }
}

/// A path across a parallel singularity is no obstacle to the inverse problem, but it is said.
#[test]
fn parallel_singularities_are_told() {
    let robot = robot("five-bar");
    let mode = "+-".parse().unwrap();
    let pose = |i: usize| [4.0 - 0.001 * i as f64, 7.0 - 0.001 * i as f64];
    let mut follower = InverseFollower::new(&robot, &pose(0), mode).unwrap();
    let det = |pose: &[f64], q: &[f64]| robot.jacobians(pose, q).unwrap().det_a();
    let mut last = det(&pose(0), follower.q());
    let mut crossings = 0;
    for i in 1..2000 {
        let step = follower.step(&pose(i)).unwrap();
        let now = det(&pose(i), step.q());
        if now * last < 0.0 {
            crossings += 1;
            assert!(!step.regular);
        }
        last = now;
    }
    assert!(crossings > 0);
}

#[test]
fn a_start_out_of_reach_is_refused() {
    let robot = robot("five-bar");
    let at =
        |pose: &[f64], mode: &str| InverseFollower::new(&robot, pose, mode.parse().unwrap()).unwrap_err();
    assert_eq!(at(&[-20.0, 0.0], "++"), StartError::OutOfReach { leg: LegIndex::new(0) });
    assert!(matches!(at(&[4.0, 7.0], "+++"), StartError::Mode { .. }));
    assert!(matches!(at(&[4.0, f64::NAN], "++"), StartError::Kinematics(_)));
}

/// A long step of a hexapod, over which one enclosure of its 6 × 6 determinant says nothing.
#[test]
fn that_det_a_keeps_its_sign_is_proved_in_parts() {
    let robot = robot("gough-stewart");
    let mode = robot.working_modes()[0];
    let start = vec![0.636112, 0.771452, 0.014956, 1.398979, 0.796866, -0.954519];
    let goal: Vec<f64> = start.iter().map(|x| x + 0.05).collect();
    let free = aspecta::motion::check_path(&robot, &[start.clone(), goal.clone()], mode).unwrap();
    assert_eq!(free.singularity_free, Some(true));
    let mut follower = InverseFollower::new(&robot, &start, mode).unwrap();
    assert!(follower.step(&goal).unwrap().regular);
}
