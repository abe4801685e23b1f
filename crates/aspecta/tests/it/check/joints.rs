//! Paths of joint vectors.

use super::{clearance_holds, minima, mode, options, robot, robots, samples};
use crate::random::Random;
use aspecta::Kinematics;
use aspecta::kinematics::constraints::Constraint;
use aspecta::motion::{Asked, Bound, Joined, PathOptions, check_joints, check_path, check_poses};
use aspecta::robot::{LegIndex, Robot};

/// How far apart two poses are, angles as numbers.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// The joint vectors of a sound path of poses lead back along it: the same mode, the same clearance, the same end.
#[test]
fn joint_paths_go_where_pose_paths_go() {
    for (i, robot) in robots().enumerate() {
        let random = &mut Random(70 + i as u64);
        let wanted = if robot.dof() == 6 { 1 } else { 3 };
        let mut done = 0;
        for trial in 0.. {
            assert!(trial < 300, "{}: {done} paths", robot.name);
            let (poses, mode) = samples(&robot, 0.02, 4, random);
            let Ok(there) = check_poses(&robot, &poses, mode, &options(Joined::Spline)) else { continue };
            let near = |at_least: f64| at_least < 1e-3;
            let tight = there
                .clearance
                .as_ref()
                .is_some_and(|c| near(c.parallel.at_least) || c.serial.iter().any(|s| near(s.at_least)));
            if !there.is_sound() || tight {
                continue;
            }
            let joints: Vec<_> =
                there.profile.iter().filter(|p| p.t < 1.0 || p.segment == 3).map(|p| p.q.clone()).collect();
            for joined in [Joined::Straight, Joined::Spline] {
                let back = check_joints(&robot, &joints, Some(&poses[0]), &options(joined)).unwrap();
                assert_eq!(back.singularity_free, Some(true), "{}: {:?}", robot.name, back.obstacle);
                assert_eq!(back.mode, mode);
                let end = back.end_poses[1].as_ref().unwrap();
                assert!(
                    apart(end, &poses[3]) < 1e-6 * (1.0 + robot.characteristic_length()),
                    "{}",
                    robot.name
                );
                clearance_holds(&robot, &back, 1e-3);
                for (a, b) in minima(&there).iter().zip(minima(&back)) {
                    assert!((a.at_most - b.at_most).abs() < 1e-3 * a.at_most, "{}: {a:?} {b:?}", robot.name);
                }
            }
            done += 1;
            if done == wanted {
                break;
            }
        }
    }
}

/// Leg 2 of the five-bar is stretched at (4, 12). Driven by its joints the robot goes on through, into the other mode.
#[test]
fn a_serial_singularity_does_not_stop_joints() {
    let robot = robot("five-bar");
    let stretched = [4.0f64, 12.0];
    let crank = stretched[1].atan2(stretched[0] - 9.0);
    let first = robot.leg_solutions(&stretched).unwrap()[0].q[0].unwrap();
    let ends = [vec![first, crank - 0.1], vec![first, crank + 0.1]];
    let starts = robot.direct(&ends[0]).unwrap();
    let near = starts.iter().min_by(|a, b| apart(&a.pose, &stretched).total_cmp(&apart(&b.pose, &stretched)));
    let start = &near.unwrap();
    let check = check_joints(&robot, &ends, Some(&start.pose), &PathOptions::default()).unwrap();
    assert_eq!(check.singularity_free, Some(false));
    let obstacle = check.obstacle.unwrap();
    assert_eq!(
        (obstacle.asked, obstacle.bound, obstacle.proved),
        (Asked::Regular, Bound::Constraint(Constraint::Reach(LegIndex::new(1))), true)
    );
    assert!(obstacle.t.0 <= 0.5 && 0.5 <= obstacle.t.1 && obstacle.t.1 - obstacle.t.0 < 1e-6, "{obstacle:?}");
    assert!(check.end_poses[1].is_some());
    let last = check.profile.last().unwrap();
    assert_eq!(last.mode, start.mode.with_other_posture(LegIndex::new(1)));
    assert!(robot.state(&last.pose, &last.q).unwrap().residual < 1e-12);
}

/// A parallel singularity does: beyond it there is no solution.
#[test]
fn a_parallel_singularity_ends_the_path() {
    let robot = robot("five-bar");
    // The elbows move apart until the rods, 5 and 8, are in line: B₁ and B₂ are 13 apart.
    let joints = [vec![1.0, 1.0], vec![3.0, 0.2]];
    let start = &robot.direct(&joints[0]).unwrap()[0];
    let check = check_joints(&robot, &joints, Some(&start.pose), &PathOptions::default()).unwrap();
    assert_ne!(check.singularity_free, Some(true));
    let obstacle = check.further.last().or(check.obstacle.as_ref()).unwrap();
    let at = |t: f64| [0, 1].map(|j| joints[0][j] + t * (joints[1][j] - joints[0][j]));
    let gap = |q: [f64; 2]| {
        let (b1, b2) = ([8.0 * q[0].cos(), 8.0 * q[0].sin()], [9.0 + 5.0 * q[1].cos(), 5.0 * q[1].sin()]);
        (b1[0] - b2[0]).hypot(b1[1] - b2[1])
    };
    assert!(gap(at(obstacle.t.0)) <= 13.0 && gap(at(obstacle.t.0)) > 13.0 - 1e-3, "{obstacle:?}");
    assert!(check.end_poses[1].is_none());
}

/// The cranks of the IRB 360 go from 40° up to 80° down: on a straight line of joint vectors the limit is met at a known place.
#[test]
fn limits_are_met_where_the_joints_are_told_to_go() {
    let robot = robot("irb-360");
    let pose = [0.0, 0.0, -900.0];
    let within = robot.inverse(&pose).unwrap().into_iter().find(|s| s.within_limits).unwrap();
    for (to, limit) in [(1.6, 80.0f64), (-0.9, -40.0)] {
        let mut joints = [within.q.clone(), within.q.clone()];
        joints[1][1] = to;
        let check = check_joints(&robot, &joints, Some(&pose), &PathOptions::default()).unwrap();
        let expected = (limit.to_radians() - joints[0][1]) / (to - joints[0][1]);
        assert_eq!(check.within_limits, Some(false));
        let mut obstacles = check.obstacle.iter().chain(&check.further);
        let met = obstacles.find(|o| o.asked == Asked::Limit).unwrap();
        assert!(
            met.proved && met.bound == Bound::Constraint(Constraint::Limit(LegIndex::new(1), 0)),
            "{met:?}"
        );
        assert!(
            met.t.0 <= expected && expected <= met.t.1 && met.t.1 - met.t.0 < 1e-6,
            "{expected}: {met:?}"
        );
    }
}

/// Nobody gives the poses of a path of joint vectors: where they leave the window is enclosed.
#[test]
fn a_window_is_left_where_the_pose_crosses_it() {
    for (name, pose, k) in [
        ("3-rrr", &[-15.468, 0.781, 0.073][..], 2),
        ("five-bar", &[4.0, 7.0], 1),
        ("spherical-3-rrr", &[0.1, 0.1, 0.1], 2),
        ("gough-stewart", &[0.0, 0.0, 1.0, 0.0, 0.0, 0.0], 3),
    ] {
        let mut robot = robot(name);
        robot.legs.iter_mut().for_each(|leg| leg.limits.clear());
        let Some(solution) = robot.inverse(pose).unwrap().into_iter().next() else { panic!("{name}") };
        let mut joints = [solution.q.clone(), solution.q];
        joints[1].iter_mut().zip([0.1, -0.08, 0.05, -0.06, 0.07, -0.03]).for_each(|(q, more)| *q += more);
        let check =
            |robot: &Robot| check_joints(robot, &joints, Some(pose), &PathOptions::default()).unwrap();
        let free = check(&robot);
        let samples: Vec<(f64, f64)> = free.profile.iter().map(|p| (p.t, p.pose[k])).collect();
        let (start, middle) = (samples[0].1, samples[samples.len() / 2]);
        assert!((middle.1 - start).abs() > 1e-3, "{name}");
        // Everything up to the middle, and far on the other side.
        let other = start - 1.4 * (middle.1 - start).signum();
        robot.window[k] = Some((middle.1.min(other), middle.1.max(other)));
        let met = check(&robot);
        assert_eq!(met.within_limits, Some(false), "{name}");
        let left = met.obstacle.iter().chain(&met.further).find(|o| o.asked == Asked::Limit).unwrap();
        assert!(matches!(left.bound, Bound::Window { .. }) && left.proved, "{name}: {left:?}");
        assert!(left.t.0 - 1e-6 <= middle.0 && middle.0 <= left.t.1 + 1e-6, "{name}: {middle:?} {left:?}");
    }
}

/// Which solution is meant has to be said if there are several.
#[test]
fn the_start_must_be_known() {
    let robot = robot("3-rrr");
    let poses = [vec![-15.468, 0.781, 0.073], vec![-15.468, -7.091, 0.500]];
    let check = check_path(&robot, &poses, mode("+++")).unwrap();
    let joints = check.ends.map(Option::unwrap);
    let error = check_joints(&robot, &joints, None, &PathOptions::default()).unwrap_err().to_string();
    assert!(error.contains("direct solutions") && error.contains("mode +++, pose -15.468"), "{error}");
    let unjoined = check_joints(&robot, &joints, Some(&poses[0]), &options(Joined::None)).unwrap_err();
    assert!(unjoined.to_string().contains("joined"));
}
