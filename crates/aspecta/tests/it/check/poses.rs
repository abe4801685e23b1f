//! Paths of poses.

use super::{clearance_holds, mode, options, robot, robots, samples};
use crate::random::Random;
use aspecta::Kinematics;
use aspecta::kinematics::constraints::{Constraint, Margins};
use aspecta::motion::{Asked, Bound, Joined, PathCheck, PathError, PathOptions, check_poses};
use aspecta::robot::{LegIndex, Robot};
use std::f64::consts::{PI, TAU};

/// Brute force: the verdict is what fine sampling shows, as far as that shows anything.
fn compare(robot: &Robot, check: &PathCheck) {
    let signs: Vec<bool> = check.profile.iter().map(|p| p.relative_det_a > 0.0).collect();
    let gone = check.profile.iter().all(|p| p.mode == check.mode);
    assert!(gone, "{}: a path of poses keeps its mode", robot.name);
    let singular = check.obstacle.iter().chain(&check.further).find(|o| o.asked == Asked::Regular);
    match (singular, check.singularity_free) {
        (_, Some(true)) => {
            assert!(signs.windows(2).all(|w| w[0] == w[1]), "{}: det A changes sign", robot.name);
            clearance_holds(robot, check, 1e-3);
        }
        (Some(obstacle), Some(false)) => {
            // Just before it all is well, and what is said to fail does so within it.
            let before = check.profile.iter().filter(|p| {
                p.segment < obstacle.segment || (p.segment == obstacle.segment && p.t <= obstacle.t.0)
            });
            assert!(
                before.map(|p| p.relative_det_a > 0.0).all(|s| s == signs[0]),
                "{}: {obstacle:?}",
                robot.name
            );
        }
        // As where det A vanishes doubly, on a surface where three rods of a Delta are parallel.
        (Some(obstacle), None) => {
            let q = robot.inverse_in(&obstacle.pose, check.mode).unwrap().expect("in reach");
            let measure = robot.state(&obstacle.pose, &q).unwrap().parallel_measure;
            assert!(measure < 1e-6, "{}: undecided {obstacle:?}", robot.name);
        }
        other => panic!("{}: {other:?}", robot.name),
    }
}

#[test]
fn random_paths_are_as_sampling_shows() {
    for (i, robot) in robots().enumerate() {
        let random = &mut Random(40 + i as u64);
        let (mut free, mut refused) = (0, 0);
        let wanted = if robot.dof() == 6 { 4 } else { 12 };
        for trial in 0.. {
            assert!(trial < 400, "{}: {free} free, {refused} refused", robot.name);
            let joined = if trial % 2 == 0 { Joined::Straight } else { Joined::Spline };
            let size = if trial % 3 == 0 { 0.2 } else { 0.03 };
            let (poses, mode) = samples(&robot, size, 5, random);
            let check = match check_poses(&robot, &poses, mode, &options(joined)) {
                Ok(check) => check,
                Err(PathError::StartSingular) => continue,
                Err(error) => panic!("{}: {error}", robot.name),
            };
            compare(&robot, &check);
            *if check.singularity_free == Some(true) { &mut free } else { &mut refused } += 1;
            if free >= wanted && refused >= wanted {
                break;
            }
        }
    }
}

/// Leg 1 reaches 13 from (0, 0), leg 2 from (9, 0). Straight from peak to peak stays below; the spline swings out between them.
#[test]
fn a_spline_that_dips_between_its_samples_is_refused() {
    let robot = robot("five-bar");
    let up = [8.0, 9.0, 10.0, 11.0, 12.03];
    let poses: Vec<_> =
        up.iter().map(|y| vec![4.1, *y]).chain(up.iter().rev().map(|y| vec![4.9, *y])).collect();
    let check = |joined| check_poses(&robot, &poses, mode("+-"), &options(joined)).unwrap();
    assert_eq!(check(Joined::Straight).singularity_free, Some(true));
    let sampled = check(Joined::None);
    assert_eq!((sampled.singularity_free, sampled.profile.len()), (Some(true), 10));
    let spline = check(Joined::Spline);
    assert_eq!(spline.singularity_free, Some(false));
    let obstacle = spline.obstacle.unwrap();
    assert!(
        matches!(obstacle.bound, Bound::Constraint(Constraint::Reach(_))) && obstacle.proved,
        "{obstacle:?}"
    );
    let reach =
        obstacle.pose[0].hypot(obstacle.pose[1]).max((obstacle.pose[0] - 9.0).hypot(obstacle.pose[1]));
    assert!((reach - 13.0).abs() < 1e-6, "{obstacle:?}");
}

/// A sample given twice changes nothing but the numbers of segments.
#[test]
fn repeated_samples_are_passed_over() {
    let robot = robot("3-rrr");
    let once =
        [[-15.468, 0.781, 0.073], [-15.468, -7.091, 0.500], [-9.902, -7.091, 1.081]].map(|p| p.to_vec());
    let twice = [0, 0, 1, 1, 2, 2].map(|k: usize| once[k].clone());
    let least = |poses: &[Vec<f64>]| {
        let check = check_poses(&robot, poses, mode("+++"), &options(Joined::Spline)).unwrap();
        assert!(check.is_sound());
        check.clearance.unwrap().det_a
    };
    let (a, b) = (least(&once), least(&twice));
    assert!(
        (a.at_most - b.at_most).abs() < 2e-6 * a.at_most && (a.segment, b.segment) == (2, 4),
        "{a:?} {b:?}"
    );
}

/// Nothing is claimed between samples that are not joined, and each is looked at.
#[test]
fn samples_alone() {
    let robot = robot("five-bar");
    // Between the first two the legs are stretched; the last is out of reach.
    let poses = [[4.0, 7.0], [4.0, -7.0], [4.0, 14.0], [4.0, 7.0]].map(|p| p.to_vec());
    let check = check_poses(&robot, &poses, mode("++"), &options(Joined::None)).unwrap();
    let obstacle = check.obstacle.as_ref().unwrap();
    assert!(obstacle.segment > 1 && obstacle.t == (0.0, 1.0), "{obstacle:?}");
    let alone = check_poses(&robot, &poses[..1], mode("++"), &options(Joined::None)).unwrap();
    assert_eq!((alone.singularity_free, alone.profile.len()), (Some(true), 1));
    clearance_holds(&robot, &alone, 1e-9);
}

/// Straight up from (4, 7), leg 2 (crank 5, rod 8, at (9, 0)) is bent by ψ with |B_22| / max = sin ψ, ‖d‖² = 89 + 80 cos ψ.
#[test]
fn a_margin_is_lost_where_the_closed_form_says() {
    let robot = robot("five-bar");
    let poses = [vec![4.0, 7.0], vec![4.0, 14.0]];
    for serial in [0.1f64, 0.3, 0.6] {
        let margins = Margins { parallel: 0.0, serial };
        let options = PathOptions { margins, ..PathOptions::default() };
        let check = check_poses(&robot, &poses, mode("++"), &options).unwrap();
        let height = (89.0 + 80.0 * (1.0 - serial * serial).sqrt() - 25.0f64).sqrt();
        let expected = (height - 7.0) / 7.0;
        let obstacle = check.obstacle.as_ref().unwrap();
        assert_eq!(
            (obstacle.asked, obstacle.bound),
            (Asked::Margin, Bound::Constraint(Constraint::Reach(LegIndex::new(1))))
        );
        assert!(obstacle.proved && (obstacle.t.0 - expected).abs() < 1e-8, "{expected}: {obstacle:?}");
        assert_eq!((check.keeps_margins, check.is_sound()), (Some(false), false));
        // The singularity itself comes later: (4, 12) stretches the leg.
        assert!((check.further[0].t.0 - 5.0 / 7.0).abs() < 1e-8, "{:?}", check.further);
    }
}

/// A margin below the clearance is kept, one above it is not.
#[test]
fn margins_and_clearance_agree() {
    let robot = robot("3-rrr");
    let poses =
        [[-15.468, 0.781, 0.073], [-15.468, -7.091, 0.500], [-9.902, -7.091, 1.081]].map(|p| p.to_vec());
    let with = |parallel| {
        let margins = Margins { parallel, serial: 0.0 };
        check_poses(&robot, &poses, mode("+++"), &PathOptions { margins, ..PathOptions::default() }).unwrap()
    };
    let clearance = with(0.0).clearance.unwrap().parallel;
    assert!(with(0.999 * clearance.at_least).is_sound());
    let check = with(1.001 * clearance.at_most);
    let obstacle = check.obstacle.unwrap();
    assert_eq!((obstacle.asked, obstacle.bound), (Asked::Margin, Bound::Constraint(Constraint::Det)));
    assert!(
        obstacle.segment == clearance.segment && (obstacle.t.0 - clearance.t).abs() < 0.1,
        "{obstacle:?}"
    );
    assert_eq!(check.singularity_free, Some(true));
}

#[test]
fn what_cannot_be_checked_is_refused() {
    let robot = robot("five-bar");
    let run = |poses: &[[f64; 2]], options: PathOptions| {
        let poses: Vec<_> = poses.iter().map(|p| p.to_vec()).collect();
        check_poses(&robot, &poses, mode("++"), &options).unwrap_err().to_string()
    };
    let twice = [[4.0, 7.0], [4.0, 8.0], [4.0, 8.0]];
    assert!(run(&twice[..1], options(Joined::Spline)).contains("at least two poses"));
    let far = PathOptions { margins: Margins { parallel: 0.0, serial: 1.5 }, ..PathOptions::default() };
    assert!(run(&twice, far).contains("below 1"));
}

/// An angle leaves its window at a known place, whatever its turn, and a spline where it crosses that.
#[test]
fn a_window_is_left_where_the_path_crosses_it() {
    let mut robot = robot("3-rrr");
    robot.window[2] = Some((0.0, 0.4));
    for turn in [0.0, TAU, -TAU] {
        let poses = [[-15.468, 0.781, 0.073 + turn], [-15.468, -7.091, 0.5 + turn]].map(|p| p.to_vec());
        let check = check_poses(&robot, &poses, mode("+++"), &PathOptions::default()).unwrap();
        assert_eq!((check.singularity_free, check.within_limits), (Some(true), Some(false)));
        let left = check.obstacle.unwrap();
        let expected = (0.4 - 0.073) / (0.5 - 0.073);
        assert!(left.proved && left.bound == Bound::Window { coordinate: "phi" }, "{left:?}");
        assert!((left.t.0 - expected).abs() < 1e-9 && left.t.0 <= left.t.1, "{expected}: {left:?}");
    }
    let poses = [[-15.468, 0.781, 0.073], [-15.468, -7.091, 0.4], [-9.902, -7.091, 0.3]].map(|p| p.to_vec());
    let check = |joined| check_poses(&robot, &poses, mode("+++"), &options(joined)).unwrap();
    assert!(check(Joined::Straight).is_sound() && check(Joined::None).is_sound());
    // A spline overshoots.
    assert_eq!(check(Joined::Spline).within_limits, Some(false));
    robot.window[2] = Some((0.0, 0.5));
    assert!(check_poses(&robot, &poses, mode("+++"), &options(Joined::Spline)).unwrap().is_sound());
}

/// Poses of a body that turns in space, however they are told: what is said of a path, and of each of its
/// samples, is what is said of the same poses told within ±90° of pitch.
#[test]
fn windows_hold_poses_told_beyond_the_poles() {
    let mut random = aspecta::num::Random::new(77);
    let (mut inside, mut outside) = (0, 0);
    for _ in 0..400 {
        let mut robot = robot("spherical-3-rrr");
        let k = random.below(3);
        let (a, b) = if k == 1 { (-1.4, 1.4) } else { (-3.0, 3.0) };
        let (low, high) = (random.within((a, 0.0)), random.within((0.0, b)));
        robot.window[k] = Some((low, high));
        let start: Vec<f64> = [3.0, 1.3, 3.0].iter().map(|most| random.within((-most, *most))).collect();
        let end: Vec<f64> = start.iter().map(|x| x + random.within((-0.02, 0.02))).collect();
        let beyond = |pose: &Vec<f64>| vec![pose[0] + PI, PI - pose[1] - TAU, pose[2] + PI];
        let Some(solution) = robot.inverse(&start).unwrap().into_iter().next() else { continue };
        for joined in [Joined::None, Joined::Straight] {
            let run = |poses: [Vec<f64>; 2]| {
                let check = check_poses(&robot, &poses, solution.mode, &options(joined)).ok()?;
                (check.singularity_free == Some(true)).then_some(check.within_limits)
            };
            let told = run([start.clone(), end.clone()]);
            assert_eq!(run([beyond(&start), beyond(&end)]), told, "{start:?} {end:?} {:?}", robot.window);
            inside += usize::from(told == Some(Some(true)));
            outside += usize::from(told == Some(Some(false)));
        }
    }
    assert!(inside > 20 && outside > 20, "{inside} {outside}");
    // Samples by themselves are each in a turn of their own.
    let mut robot = robot("3-rrr");
    robot.window[2] = Some((-1.0, 1.0));
    let poses = [vec![-12.0, -3.0, 0.3], vec![-12.0, -3.0, 6.6]];
    assert_eq!(
        check_poses(&robot, &poses, mode("+++"), &options(Joined::None)).unwrap().within_limits,
        Some(true)
    );
    assert_eq!(
        check_poses(&robot, &poses, mode("+++"), &options(Joined::Straight)).unwrap().within_limits,
        Some(false)
    );
}
