//! Smooth paths whose true branch is known, because the joint vectors were made from them.

use super::{apart, closed_path, follower, joints_in_one_aspect, robot, start};
use crate::random::{self, Random, Spread};
use aspecta::Kinematics;
use aspecta::motion::follow::Follower;
use aspecta::robot::{Platform, Robot};
use proptest::prelude::*;
use std::f64::consts::PI;

/// What following a robot along random paths came to.
#[derive(Debug, Default)]
struct Tally {
    steps: usize,
    in_one_stretch: usize,
    refused: usize,
    worst: f64,
}

/// Follows at least `wanted` steps. A refused step is taken up again at the true pose; a wrong pose fails.
fn follow(robot: &Robot, wanted: usize, seed: u64) -> Tally {
    const STEPS: usize = 2000;
    let random = &mut Random(seed);
    let mut tally = Tally::default();
    while tally.steps < wanted {
        let (middle, mode) = start(robot, random);
        let poses = closed_path(robot, &middle, 0.1, STEPS, random);
        let Some(joints) = joints_in_one_aspect(robot, &poses, mode) else { continue };
        let Ok(mut follower) = Follower::new(robot, &poses[0], &joints[0]) else { continue };
        for (pose, q) in poses.iter().zip(&joints) {
            tally.steps += 1;
            match follower.step(q) {
                Ok(step) => {
                    let gap = apart(robot, step.pose(), pose);
                    assert!(gap < 1e-6, "{}: {:?} for {pose:?}", robot.name, step.pose());
                    assert!(step.mode == mode || !step.mode_kept, "{}: mode {}", robot.name, step.mode);
                    tally.in_one_stretch += usize::from(step.stretches == 1);
                    tally.worst = tally.worst.max(gap);
                }
                Err(_) => {
                    tally.refused += 1;
                    match Follower::new(robot, pose, q) {
                        Ok(anew) => follower = anew,
                        Err(_) => break,
                    }
                }
            }
        }
    }
    tally
}

const PLANAR_AND_DELTA: [&str; 7] =
    ["five-bar", "symmetric-five-bar", "2-prr", "3-rrr", "3-prr", "3-rpr", "delta"];
const OTHERS: [&str; 5] = ["linear-delta", "orthoglide", "spherical-3-rrr", "hexa", "gough-stewart"];

/// Paths within an aspect are followed all the way, but for at most `refused` of all steps, where one comes close to a singularity.
fn check(names: &[&str], wanted: usize, refused: f64) {
    std::thread::scope(|scope| {
        for (k, name) in names.iter().enumerate() {
            scope.spawn(move || {
                let tally = follow(&robot(name), wanted, 17 + k as u64);
                println!("{name}: {tally:?}");
                assert!(tally.refused as f64 <= refused * tally.steps as f64, "{name}: {tally:?}");
            });
        }
    });
}

#[test]
fn never_a_wrong_branch() {
    check(&PLANAR_AND_DELTA, 20_000, 0.0);
    check(&OTHERS, 4_000, 1e-3);
}

/// The same, a million steps in each planar robot and the Delta:
/// `cargo test -p aspecta follow -- --ignored --nocapture`.
#[test]
#[ignore = "half a minute"]
fn never_a_wrong_branch_in_a_million_steps() {
    check(&PLANAR_AND_DELTA, 1_000_000, 0.0);
    check(&OTHERS, 200_000, 1e-3);
}

/// Every pitch is as good as any other: the coordinates of the proof have no singularity.
#[test]
fn a_free_body_goes_over_pitch_90() {
    let robot = robot("gough-stewart");
    let steps = 400;
    // Beyond 90° the coordinates fold: the same rotation is that of (roll + π, π − pitch, yaw + π).
    let pose = |i: usize| {
        let (pitch, half) = (1.4 + 0.3 * i as f64 / steps as f64, std::f64::consts::FRAC_PI_2);
        let (roll, pitch, yaw) =
            if pitch <= half { (0.5, pitch, 0.2) } else { (0.5 - PI, PI - pitch, 0.2 - PI) };
        vec![0.2, 0.1, 0.9, roll, pitch, yaw]
    };
    let mut follower = follower(&robot, &pose(0), "------");
    for i in 0..=steps {
        let q = robot.inverse(&pose(i)).unwrap().remove(0).q;
        let step = follower.step(&q).unwrap_or_else(|e| panic!("{i}: {e}"));
        assert!(apart(&robot, step.pose(), &pose(i)) < 1e-9, "{i}: {:?}", step.pose());
    }
}

/// A crank that goes through its stretched position: no singularity of the direct problem, but another mode.
#[test]
fn a_leg_may_change_its_posture() {
    let robot = robot("five-bar");
    let mut changes = 0;
    for (crank, by) in [(0, 0.002), (0, -0.002), (1, 0.002), (1, -0.002)] {
        let mut follower = follower(&robot, &[4.0, 7.0], "++");
        let mut q = follower.q().to_vec();
        loop {
            let before = follower.mode();
            q[crank] += by;
            // On some ways a parallel singularity comes first.
            let Ok(step) = follower.step(&q) else { break };
            assert_eq!(step.mode, robot.jacobians(step.pose(), &q).unwrap().mode());
            if step.mode != before {
                assert!(!step.mode_kept, "a mode cannot change in a step that is proved to keep it");
                changes += 1;
                break;
            }
        }
    }
    assert!(changes >= 1);
}

/// φ is not thrown back at ±π.
#[test]
fn the_angle_of_the_platform_goes_on() {
    let robot = robot("3-rpr");
    let pose = |i: usize| vec![8.0, 5.0, 3.0 + 0.001 * i as f64];
    let start = robot.inverse(&pose(0)).unwrap().remove(0);
    let mut follower = Follower::new(&robot, &pose(0), &start.q).unwrap();
    for i in 0..=400 {
        let q = robot.inverse(&pose(i)).unwrap().remove(0).q;
        let step = follower.step(&q).unwrap();
        assert!((step.pose()[2] - pose(i)[2]).abs() < 1e-9);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// Random robots of all kinds of legs.
    #[test]
    fn random_robots_are_followed(seed in any::<u64>(), which in 0..3usize) {
        let platform = [Platform::PlanePoint, Platform::PlaneBody, Platform::TranslatingBody][which];
        let case = random::case(platform, Spread::Anywhere, seed);
        let mode = case.robot.jacobians(&case.pose, &case.q).unwrap().mode();
        let poses = closed_path(&case.robot, &case.pose, 0.02, 500, &mut Random(seed));
        let Some(joints) = joints_in_one_aspect(&case.robot, &poses, mode) else { return Ok(()) };
        let Ok(mut follower) = Follower::new(&case.robot, &poses[0], &joints[0]) else { return Ok(()) };
        for (pose, q) in poses.iter().zip(&joints) {
            // Where a step is refused the rest of the path has nothing to show.
            let Ok(step) = follower.step(q) else { break };
            prop_assert!(apart(&case.robot, step.pose(), pose) < 1e-6, "{:?} for {pose:?}", step.pose());
        }
    }
}
