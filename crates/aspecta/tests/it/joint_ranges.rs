//! Joint values lie within the joints' own ranges, whatever turn `atan2` answers in.
//!
//! `ASPECTA_CASES` sets the number of random robots and poses (2000 by default).

use aspecta::Kinematics;
use aspecta::aspect::{ClassId, Options, Place, analyze};
use aspecta::kinematics::follow::InverseFollower;
use aspecta::motion::{PathCheck, check_path};
use aspecta::num::Random;
use aspecta::paving::{Budget, Control};
use aspecta::robot::{Robot, catalogue};
use std::f64::consts::TAU;

fn cases() -> usize {
    std::env::var("ASPECTA_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(2000)
}

/// Robots whose every leg has a motor that turns, and who know no other limits.
const ROBOTS: [&str; 4] = ["five-bar", "3-rrr", "delta", "hexa"];

/// The robot with the range of each motor, in degrees, and these ranges.
fn limited(name: &str, random: &mut Random) -> (Robot, Vec<(f64, f64)>) {
    let text = catalogue::all().iter().find(|entry| entry.name == name).unwrap().text;
    let mut ranges = Vec::new();
    let mut line = |line: &str| {
        if !line.starts_with("actuator") {
            return format!("{line}\n");
        }
        let (middle, half) = (random.within((-540.0, 540.0)), random.within((20.0, 179.0)));
        ranges.push((middle - half, middle + half));
        format!("{line}\nlimits = {{ actuator = {{ deg = [{}, {}] }} }}\n", middle - half, middle + half)
    };
    let text: String = text.lines().map(&mut line).collect();
    (Robot::from_toml(&text, name).unwrap(), ranges)
}

fn lies_within(q: &[f64], ranges: &[(f64, f64)]) -> bool {
    q.iter().zip(ranges).all(|(q, &(lo, hi))| (lo..=hi).contains(&q.to_degrees()))
}

#[test]
fn joint_values_lie_within_their_ranges() {
    let random = &mut Random::new(20);
    let (mut within, mut turned) = (0, 0);
    for case in 0..cases() {
        let (robot, ranges) = limited(ROBOTS[case % ROBOTS.len()], random);
        let window = robot.workspace_window().unwrap();
        let pose: Vec<f64> = window.ranges.iter().map(|&range| random.within(range)).collect();
        for solution in robot.inverse(&pose).unwrap() {
            if !solution.within_limits {
                continue;
            }
            within += 1;
            turned += usize::from(solution.q.iter().any(|q| q.abs() > 0.5 * TAU));
            assert!(lies_within(&solution.q, &ranges), "{:?} {ranges:?}", solution.q);
            // The same bits wherever they are told, from whatever turn they are asked for.
            let other: Vec<f64> = solution.q.iter().map(|q| q - TAU).collect();
            assert_eq!(robot.state(&pose, &solution.q).unwrap().q, solution.q);
            assert!(lies_within(&robot.state(&pose, &other).unwrap().q, &ranges));
            let follower = InverseFollower::new(&robot, &pose, solution.mode).unwrap();
            assert_eq!(follower.q(), solution.q);
            let step = InverseFollower::new(&robot, &pose, solution.mode).unwrap().step(&pose).unwrap();
            assert_eq!(step.q(), solution.q);
        }
    }
    assert!(within > cases() / 10 && turned > within / 4, "{within} within, {turned} of them beyond ±180°");
}

/// Along a path that keeps the limits every value does, and none is a turn away from the one before.
#[test]
fn paths_stay_within_the_ranges() {
    let random = &mut Random::new(21);
    let mut checked = 0;
    for case in 0..cases() / 10 {
        let (robot, ranges) = limited(ROBOTS[case % ROBOTS.len()], random);
        let window = robot.workspace_window().unwrap();
        let pose: Vec<f64> = window.ranges.iter().map(|&range| random.within(range)).collect();
        let size = |&(lo, hi): &(f64, f64)| 0.05 * (hi - lo);
        let next: Vec<f64> = pose
            .iter()
            .zip(&window.ranges)
            .map(|(x, range)| x + size(range) * random.within((-1.0, 1.0)))
            .collect();
        for solution in robot.inverse(&pose).unwrap().iter().filter(|solution| solution.within_limits) {
            let Ok(PathCheck { within_limits: Some(true), profile, .. }) =
                check_path(&robot, &[pose.clone(), next.clone()], solution.mode)
            else {
                continue;
            };
            checked += 1;
            assert!(profile.iter().all(|point| lies_within(&point.q, &ranges)), "{profile:?} {ranges:?}");
        }
    }
    assert!(checked > cases() / 100, "{checked} paths");
}

/// The bounds of the joints of an aspect are in the ranges of these, and hold the joint values of all its inner
/// poses.
#[test]
fn ranges_of_aspects_lie_within_the_ranges() {
    let random = &mut Random::new(22);
    let mut inside = 0;
    for _ in 0..cases() / 100 {
        let (robot, ranges) = limited("five-bar", random);
        let budget = Budget { depth: Some(7), ..Budget::default() };
        let options = Options { budget, ..Options::default() };
        let analysis = analyze(&robot, &options, &Control::unwatched()).unwrap();
        for (k, class) in analysis.classes.iter().enumerate() {
            // Of an aspect that only the chart of a fold shows there are no inner cells.
            for aspect in class.aspects.iter().filter(|a| a.q_bounds.iter().all(|b| b.0 < b.1)) {
                let within = |(&(lo, hi), &(from, to)): (&(f64, f64), &(f64, f64))| {
                    from - 1e-9 <= lo.to_degrees() && hi.to_degrees() <= to + 1e-9
                };
                assert!(aspect.q_bounds.iter().zip(&ranges).all(within), "{aspect:?} {ranges:?}");
            }
            for _ in 0..100 {
                let pose: Vec<f64> =
                    analysis.window.ranges.iter().map(|&range| random.within(range)).collect();
                let Place::Inside(id) = analysis.locate(&pose, ClassId::new(k)) else { continue };
                let q = robot.inverse_in(&pose, class.mode).unwrap().unwrap();
                let bounds = &analysis.aspect(id).unwrap().1.q_bounds;
                let holds = |(&q, &(lo, hi)): (&f64, &(f64, f64))| (lo - 1e-9..=hi + 1e-9).contains(&q);
                assert!(q.iter().zip(bounds).all(holds), "{q:?} {bounds:?} {ranges:?}");
                inside += 1;
            }
        }
    }
    assert!(inside > cases() / 4, "{inside} poses");
}
