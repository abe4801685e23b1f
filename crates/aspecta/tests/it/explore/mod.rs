//! Roadmaps of free bodies: what is joined is joined by segments that hold when looked at again.

use crate::random::Random;
use aspecta::Kinematics;
use aspecta::aspect::DetSign;
use aspecta::kinematics::constraints::{Demand, Margins};
use aspecta::kinematics::path::curve::{Along, Curve, along};
use aspecta::kinematics::{DirectSolutions, Solution, WorkingMode};
use aspecta::motion::explore::{Effort, End, ExploreError, NoWay, explore, join_solutions, plan};
use aspecta::motion::plan::{Plan, PlanOptions, Refusal};
use aspecta::motion::{PathOptions, check_path, check_poses};
use aspecta::paving::Control;
use aspecta::robot::{Robot, catalogue};
use nalgebra::{DMatrix, DVector, Rotation3, Vector3};
use std::f64::consts::PI;

fn robot(name: &str) -> Robot {
    catalogue::find(name).unwrap()
}

/// The strut lengths at which all 40 direct solutions of Dietmaier's platform are real.
const DIETMAIER: [f64; 6] = [1.0, 0.645275, 1.086284, 1.503439, 1.281933, 0.771071];

/// Direct solutions by Newton's method on differences, from random poses: sorted by roll, each once.
fn direct(robot: &Robot, q: &[f64], starts: usize) -> Vec<Solution> {
    let mut random = Random(7);
    let mut found: Vec<Solution> = Vec::new();
    let mode = robot.working_modes()[0];
    let residual = |x: &[f64]| -> Option<DVector<f64>> {
        let at = robot.inverse_in(x, mode).ok()??;
        Some(DVector::from_fn(6, |j, _| at[j] - q[j]))
    };
    for _ in 0..starts {
        let draw = |k: usize, random: &mut Random| {
            if k < 3 { random.within(-2.0, 2.0) } else { random.within(-PI, PI) }
        };
        let mut x: Vec<f64> = (0..6).map(|k| draw(k, &mut random)).collect();
        for _ in 0..40 {
            let Some(f) = residual(&x) else { break };
            if f.norm() < 1e-13 {
                break;
            }
            let column = |k: usize| {
                let (mut a, mut b) = (x.clone(), x.clone());
                (a[k], b[k]) = (a[k] - 1e-6, b[k] + 1e-6);
                Some((residual(&b)? - residual(&a)?) / 2e-6)
            };
            let Some(columns) = (0..6).map(column).collect::<Option<Vec<_>>>() else { break };
            let Some(step) = DMatrix::from_columns(&columns).lu().solve(&f) else { break };
            let size = (0.5 / step.norm()).min(1.0);
            (0..6).for_each(|k| x[k] -= size * step[k]);
        }
        if !residual(&x).is_some_and(|f| f.norm() < 1e-12) {
            continue;
        }
        // In coordinates with the pitch within ±π/2.
        let turn = Rotation3::from_euler_angles(x[3], x[4], x[5]).euler_angles();
        (x[3], x[4], x[5]) = turn;
        if found.iter().all(|s| apart(&s.pose, &x) > 1e-6) {
            found.extend(robot.inverse(&x).unwrap());
        }
    }
    found.sort_by(|a, b| a.pose[3].total_cmp(&b.pose[3]));
    found
}

/// The distance between two poses of a free body, whatever their coordinates.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    let turn = |x: &[f64]| Rotation3::from_euler_angles(x[3], x[4], x[5]);
    let far = (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt();
    far + (turn(a).matrix() - turn(b).matrix()).norm()
}

/// det A and the lengths of the legs at a pose of a hexapod whose struts have these anchors and attachments, from the vectors themselves:
/// row j of A is (2d, 2r × d).
fn by_vectors(robot: &Robot, pose: &[f64]) -> (f64, Vec<f64>) {
    let vector = |x: &[aspecta::num::Interval; 3]| Vector3::new(x[0].mid(), x[1].mid(), x[2].mid());
    let (turn, origin) =
        (Rotation3::from_euler_angles(pose[3], pose[4], pose[5]), Vector3::from_column_slice(&pose[..3]));
    let legs = robot.legs.iter().map(|leg| {
        let arm = turn * vector(&leg.attachment);
        (origin + arm - vector(&leg.anchor), arm)
    });
    let legs: Vec<_> = legs.collect();
    let a = DMatrix::from_fn(6, 6, |j, k| {
        let (d, arm) = legs[j];
        2.0 * if k < 3 { d[k] } else { arm.cross(&d)[k - 3] }
    });
    (a.determinant(), legs.iter().map(|(d, _)| d.norm()).collect())
}

/// The path check accepts a plan of a hexapod, and so do samples of it.
fn assert_sound(robot: &Robot, plan: &Plan, ends: [&[f64]; 2]) {
    let check = check_path(robot, &plan.waypoints, plan.mode).unwrap();
    assert!(check.is_sound(), "{plan:?}");
    for pair in plan.waypoints.windows(2) {
        for i in 0..=400 {
            let t = f64::from(i) / 400.0;
            let pose: Vec<f64> = pair[0].iter().zip(&pair[1]).map(|(a, b)| a + t * (b - a)).collect();
            let (det, lengths) = by_vectors(robot, &pose);
            assert!(det * f64::from(plan.det_a.factor()) > 0.0, "{pose:?} of {plan:?}");
            assert!(lengths.iter().all(|q| (0.2..=2.0).contains(q)), "{pose:?} of {plan:?}");
        }
    }
    let (first, last) = (&plan.waypoints[0], &plan.waypoints[plan.waypoints.len() - 1]);
    assert!(apart(first, ends[0]) < 1e-7 && apart(last, ends[1]) < 1e-7, "{plan:?}");
}

fn effort(samples: usize) -> Effort {
    Effort { samples, seconds: None }
}

fn planned(robot: &Robot, ends: [&[f64]; 2], options: &PlanOptions) -> Result<Plan, NoWay> {
    plan(robot, ends, robot.working_modes()[0], options, &effort(20_000), &Control::unwatched())
}

/// Non-singular changes of assembly mode: all direct solutions with one sign of det A lie in one aspect, 20 of each.
#[test]
fn dietmaiers_forty_solutions_lie_in_two_aspects() {
    let robot = robot("gough-stewart");
    let solutions = direct(&robot, &DIETMAIER, 3000);
    assert_eq!(solutions.len(), 40);
    let found = DirectSolutions { solutions: solutions.clone(), complete: false };
    let joined = join_solutions(&robot, &DIETMAIER, found, &effort(20_000), &Control::unwatched()).unwrap();
    assert_eq!(joined.classes.len(), 2);
    for class in &joined.classes {
        assert_eq!((class.end, class.joined.len()), (End::Joined, 1), "{class:?}");
        let set = &class.joined[0];
        assert_eq!(set.len(), 20);
        let same = |k: &usize| solutions[k - 1].det_a * f64::from(class.det_a.factor()) > 0.0;
        assert!(set.iter().all(same), "{class:?}");
    }
    for class in &joined.classes {
        for pair in class.joined[0].windows(2).step_by(4) {
            let [a, b] = [&solutions[pair[0] - 1].pose, &solutions[pair[1] - 1].pose];
            let plan = planned(&robot, [a, b], &PlanOptions::default()).unwrap();
            assert_sound(&robot, &plan, [a, b]);
            let end = &plan.waypoints[plan.waypoints.len() - 1];
            let q = by_vectors(&robot, end).1;
            assert!(q.iter().zip(DIETMAIER).all(|(a, b)| (a - b).abs() < 1e-9), "{q:?}");
        }
    }
    let [plus, minus] = [&joined.classes[0].joined[0], &joined.classes[1].joined[0]];
    let ends = [&solutions[plus[0] - 1].pose[..], &solutions[minus[0] - 1].pose];
    let refused = planned(&robot, ends, &PlanOptions::default());
    assert_eq!(refused, Err(NoWay::Refused(Refusal::OppositeSigns(DetSign::Positive))));
}

/// Poses of a class of the hexapod whose |det Â| is not small.
fn poses(robot: &Robot, sign: f64, least: f64, count: usize) -> Vec<Vec<f64>> {
    let mut random = Random(11);
    let ranges = robot.workspace_window().unwrap().ranges;
    let mut draw = || -> Vec<f64> { ranges.iter().map(|r| random.within(r.0, r.1)).collect() };
    let is_in = |pose: &Vec<f64>| {
        let (det, lengths) = by_vectors(robot, pose);
        let length: f64 = lengths.iter().product();
        let unit = 64.0 * length * robot.characteristic_length().powi(3);
        det * sign / unit > least && lengths.iter().all(|q| (0.2..=2.0).contains(q))
    };
    std::iter::repeat_with(&mut draw).filter(is_in).take(count).collect()
}

#[test]
fn margins_are_kept_all_along() {
    let robot = robot("gough-stewart");
    let margins = Margins { parallel: 0.004, serial: 0.0 };
    let poses = poses(&robot, 1.0, 0.01, 4);
    for pair in poses.windows(2) {
        let plan = planned(&robot, [&pair[0], &pair[1]], &PlanOptions { margins, weight: 1.0 }).unwrap();
        assert_sound(&robot, &plan, [&pair[0], &pair[1]]);
        let options = PathOptions { margins, ..PathOptions::default() };
        assert!(check_poses(&robot, &plan.waypoints, plan.mode, &options).unwrap().is_sound());
    }
    let none = Margins { parallel: 0.9, serial: 0.0 };
    let refused = planned(&robot, [&poses[0], &poses[1]], &PlanOptions { margins: none, weight: 1.0 });
    assert!(matches!(refused, Err(NoWay::Refused(Refusal::Margins(_)))), "{refused:?}");
}

/// Over the pole of the pitch the way is as short as elsewhere.
#[test]
fn the_pole_of_the_pitch_is_no_barrier() {
    let robot = robot("gough-stewart");
    let mode = robot.working_modes()[0];
    let mut tried = 0;
    for pose in poses(&robot, 1.0, 0.002, 100) {
        let at = |pitch: f64| vec![pose[0], pose[1], pose[2], pose[3], pitch, pose[5]];
        let straight = [at(1.4), at(1.7)];
        if !check_path(&robot, &straight, mode).is_ok_and(|check| check.is_sound()) {
            continue;
        }
        // The same orientation, its pitch within ±π/2.
        let goal = vec![pose[0], pose[1], pose[2], pose[3] + PI, PI - 1.7, pose[5] + PI];
        let shortest = PlanOptions { weight: 0.0, ..PlanOptions::default() };
        let plan = planned(&robot, [&straight[0], &goal], &shortest).unwrap();
        assert_sound(&robot, &plan, [&straight[0], &straight[1]]);
        assert!(plan.length < 1.01 * 0.3 * robot.characteristic_length(), "{plan:?}");
        tried += 1;
    }
    assert!(tried > 3, "{tried}");
}

/// In a window that cuts the pitch and the yaw all poses lie in it.
#[test]
fn a_window_is_not_left() {
    let mut robot = robot("gough-stewart");
    robot.window[4] = Some((-0.6, 1.2));
    robot.window[5] = Some((3.0, 5.5));
    let poses = poses(&robot, 1.0, 0.001, 6);
    let mut joined = 0;
    for pair in poses.windows(2) {
        let ends = [&pair[0][..], &pair[1]];
        let Ok(plan) = plan(
            &robot,
            ends,
            robot.working_modes()[0],
            &PlanOptions::default(),
            &effort(4000),
            &Control::unwatched(),
        ) else {
            continue;
        };
        assert_sound(&robot, &plan, ends);
        let inside = |x: &Vec<f64>| (-0.6..=1.2).contains(&x[4]) && (3.0..=5.5).contains(&x[5]);
        assert!(plan.waypoints.iter().all(inside), "{plan:?}");
        joined += 1;
    }
    assert!(joined > 1, "{joined}");
}

#[test]
fn what_is_not_joined_within_the_budget_is_said_to_be_undecided() {
    let robot = robot("gough-stewart");
    let poses = poses(&robot, -1.0, 0.001, 2);
    let mode = robot.working_modes()[0];
    let none = plan(
        &robot,
        [&poses[0], &poses[1]],
        mode,
        &PlanOptions::default(),
        &effort(0),
        &Control::unwatched(),
    );
    let Err(NoWay::Refused(refusal @ Refusal::NotJoined { samples: 0, .. })) = none else {
        panic!("{none:?}")
    };
    assert!(!refusal.is_proof() && !refusal.is_bad_input());
    let one = Refusal::NotJoined { samples: 1, seconds: 0.0, margins: Margins::default() };
    assert!(one.to_string().contains("within the budget (1 sample, 0.0 s)"), "{one}");
}

/// Every edge is proved with more effort, and by samples; components hang together by them.
#[test]
fn what_is_explored_is_proved() {
    for (name, mode) in [("gough-stewart", "------"), ("hexa", "-+-++-")] {
        let robot = robot(name);
        let mode: WorkingMode = mode.parse().unwrap();
        let found = explore(&robot, &[mode], &effort(160), &Control::unwatched()).unwrap();
        assert_eq!((found.at_least, found.classes.len()), (2, 2));
        for class in &found.classes {
            let demand = Demand::class(mode, class.det_a.factor());
            for [a, b] in &class.edges {
                assert_eq!(along(&robot, &demand, &Curve::segment(a, b), 10_000), Along::Inside, "{name}");
                let middle: Vec<f64> = a.iter().zip(b).map(|(a, b)| 0.5 * (a + b)).collect();
                for pose in [a, b, &middle] {
                    let solutions = robot.inverse(pose).unwrap();
                    let here = solutions.iter().find(|s| s.mode == mode).unwrap();
                    assert!(here.within_limits && here.det_a * f64::from(class.det_a.factor()) > 0.0);
                }
            }
            let poses: usize = class.components.iter().map(|c| c.poses).sum();
            assert!(class.edges.len() >= poses - class.components.len());
            assert!(class.components.windows(2).all(|pair| pair[0].poses >= pair[1].poses));
            for component in &class.components {
                let pose = &component.representative;
                assert!(Along::is_inside(&robot, &demand, [pose, pose], 1));
            }
        }
    }
}

/// Cranks with a range leave so little of most modes that poses drawn at random miss it; poses of joint vectors within the range do not.
#[test]
fn modes_that_limits_leave_little_of_are_found() {
    let entry = catalogue::all().iter().find(|entry| entry.name == "hexa").unwrap();
    let limited = |line: &str| match line.starts_with("actuator") {
        true => format!("{line}\nlimits = {{ actuator = {{ deg = [-40, 80] }} }}\n"),
        false => format!("{line}\n"),
    };
    let robot = Robot::from_toml(&entry.text.lines().map(limited).collect::<String>(), "hexa.toml").unwrap();
    let found = explore(&robot, &[], &effort(8), &Control::unwatched()).unwrap();
    assert_eq!(found.classes.len(), 128);
    assert!(found.at_least > 100, "{}", found.at_least);
    for class in &found.classes {
        for component in &class.components {
            let solutions = robot.inverse(&component.representative).unwrap();
            let here = solutions.iter().find(|s| s.mode == class.mode).unwrap();
            assert!(here.within_limits && here.q.iter().all(|q| (-40.0..80.0).contains(&q.to_degrees())));
            assert!(here.det_a * f64::from(class.det_a.factor()) > 0.0);
        }
    }
}

/// Equal results with one thread and with two.
#[test]
fn results_do_not_depend_on_threads() {
    let (stewart, hexa) = (robot("gough-stewart"), robot("hexa"));
    let poses = poses(&stewart, 1.0, 0.001, 2);
    let mode = hexa.working_modes()[5];
    let work = || {
        let plan = planned(&stewart, [&poses[0], &poses[1]], &PlanOptions::default()).unwrap();
        (plan, explore(&hexa, &[mode], &effort(96), &Control::unwatched()).unwrap())
    };
    let with =
        |count: usize| rayon::ThreadPoolBuilder::new().num_threads(count).build().unwrap().install(work);
    assert_eq!(with(1), with(2));
}

#[test]
fn other_robots_are_refused() {
    let refused = explore(&robot("five-bar"), &[], &effort(1), &Control::unwatched());
    assert!(matches!(refused, Err(ExploreError::NotFree { .. })));
    let refused = explore(&robot("hexa"), &["++".parse().unwrap()], &effort(1), &Control::unwatched());
    assert!(matches!(refused, Err(ExploreError::Mode { .. })));
    let mut unbounded = robot("gough-stewart");
    unbounded.legs.iter_mut().for_each(|leg| leg.limits.clear());
    assert!(matches!(
        explore(&unbounded, &[], &effort(1), &Control::unwatched()),
        Err(ExploreError::Unbounded(_))
    ));
}
