//! Near singularities, over them, and after jumps: refused, never guessed.

use super::{apart, follower, robot, start};
use crate::random::{self, Random, Spread};
use aspecta::Kinematics;
use aspecta::motion::follow::{BadInput, Follower, Refusal, StartError};
use aspecta::robot::{LegIndex, Platform, Robot};
use proptest::prelude::*;

/// Steps towards `goal` until one is refused; the refusal, and the joint vector that was refused.
fn until_refused(follower: &mut Follower, goal: &[f64], steps: usize) -> Option<(Refusal, Vec<f64>)> {
    let start = follower.q().to_vec();
    for i in 1..=steps {
        let t = i as f64 / steps as f64;
        let q: Vec<f64> = start.iter().zip(goal).map(|(a, b)| a + t * (b - a)).collect();
        let before = (follower.pose().to_vec(), follower.q().to_vec(), follower.mode());
        if let Err(refusal) = follower.step(&q) {
            let after = (follower.pose().to_vec(), follower.q().to_vec(), follower.mode());
            assert_eq!(before, after, "a refusal leaves the state as it was");
            return Some((refusal, q));
        }
    }
    None
}

/// The elbows of the five-bar move apart until both rods, 5 and 8, are in line: at a distance of 13.
#[test]
fn the_five_bar_stops_where_its_rods_are_in_line() {
    let robot = robot("five-bar");
    let elbows = |q: &[f64]| {
        let b1 = [8.0 * q[0].cos(), 8.0 * q[0].sin()];
        let b2 = [9.0 + 5.0 * q[1].cos(), 5.0 * q[1].sin()];
        (b1[0] - b2[0]).hypot(b1[1] - b2[1])
    };
    for steps in [7, 100, 1000, 20_000] {
        let mut follower = follower(&robot, &[4.0, 7.0], "++");
        let goal = [follower.q()[0] + 1.5, follower.q()[1] - 1.5];
        let (refusal, q) = until_refused(&mut follower, &goal, steps).expect("rods of length 13");
        assert!(
            elbows(follower.q()) < 13.0 && 12.9 < elbows(&q),
            "{refusal}, {} {}",
            elbows(follower.q()),
            elbows(&q)
        );
        let Refusal::Parallel { proved, singular_at, distance } = refusal else { panic!("{refusal}") };
        assert!(proved < singular_at && distance < 0.1, "{refusal}");
        let last = follower.q();
        let at = |t: f64| [last[0] + t * (q[0] - last[0]), last[1] + t * (q[1] - last[1])];
        assert!((elbows(&at(singular_at)) - 13.0).abs() < 1e-2, "{refusal}: {}", elbows(&at(singular_at)));
        assert!(elbows(&at(proved)) < 13.0);
        if steps > 50 {
            assert!(elbows(&at(proved)) > 12.99, "given up too early: {refusal}");
        }
    }
}

/// The first strut of the 3-RPR changes its length until the direct solution followed meets another one: then the number
/// of direct solutions falls by two just beyond.
#[test]
fn the_3_rpr_stops_where_two_solutions_meet() {
    let robot = robot("3-rpr");
    let number = |q1: f64| robot.direct(&[q1, 15.38, 12.0]).unwrap().len();
    let mut refusals = 0;
    for solution in robot.direct(&[14.98, 15.38, 12.0]).unwrap() {
        for towards in [-1.0, 1.0] {
            let mut follower = Follower::new(&robot, &solution.pose, &solution.q).unwrap();
            let goal = [14.98 + towards * 14.0, 15.38, 12.0];
            let stop = until_refused(&mut follower, &goal, 3000);
            let jacobians = robot.jacobians(follower.pose(), follower.q()).unwrap();
            assert!(jacobians.residual < 1e-12 && jacobians.det_a() * solution.det_a > 0.0);
            let Some((refusal, q)) = stop else { continue };
            refusals += 1;
            let Refusal::Parallel { distance, singular_at, .. } = refusal else { panic!("{refusal}") };
            assert!(distance < 0.02, "{refusal} at {:?}", follower.pose());
            let at = |t: f64| follower.q()[0] + t * (q[0] - follower.q()[0]);
            assert_eq!(number(at(0.0)), number(at(singular_at + 0.3)) + 2, "{refusal}");
        }
    }
    println!("{refusals} of 12 ways end at a singularity");
    assert!(refusals >= 6);
}

/// A path of poses across det A = 0: whatever is answered beyond it is the other pose of that joint vector.
#[test]
fn the_pose_beyond_a_singularity_is_never_returned() {
    let robot = robot("five-bar");
    let mode = "+-";
    let pose = |i: usize| [4.0 - 0.001 * i as f64, 7.0 - 0.001 * i as f64];
    let mut follower = follower(&robot, &pose(0), mode);
    let sign = robot.jacobians(follower.pose(), follower.q()).unwrap().det_a().signum();
    let (mut crossed, mut refused) = (0, 0);
    for i in 0..4000 {
        let Some(q) = robot.inverse_in(&pose(i), mode.parse().unwrap()).unwrap() else { break };
        crossed += usize::from(robot.jacobians(&pose(i), &q).unwrap().det_a().signum() != sign);
        match follower.step(&q) {
            Ok(step) => {
                let det = robot.jacobians(step.pose(), &q).unwrap().det_a();
                assert_eq!(det.signum(), sign, "{:?} at step {i}", step.pose());
            }
            Err(_) => refused += 1,
        }
    }
    assert!(crossed > 100, "the path was to cross a singularity");
    println!("{crossed} poses beyond the singularity, {refused} steps refused");
}

/// What continuation in steps so small that only one solution is near finds, or `None` where det A changes its sign
/// or Newton's method does not settle.
fn by_fine_steps(robot: &Robot, pose: &[f64], from: &[f64], to: &[f64]) -> Option<Vec<f64>> {
    const STEPS: usize = 20_000;
    let mut x = pose.to_vec();
    let sign = robot.jacobians(pose, from).ok()?.det_a().signum();
    for i in 1..=STEPS {
        let t = i as f64 / STEPS as f64;
        let q: Vec<f64> = from.iter().zip(to).map(|(a, b)| a + t * (b - a)).collect();
        // The direct model knows all poses; the one nearest to the last is meant.
        let poses = robot.direct_poses(&q).ok()?;
        let nearest = poses.iter().min_by(|a, b| apart(robot, a, &x).total_cmp(&apart(robot, b, &x)))?;
        if apart(robot, nearest, &x) > 0.01 {
            return None;
        }
        x = nearest.to_vec();
        if robot.jacobians(&x, &q).ok()?.det_a().signum() != sign {
            return None;
        }
    }
    Some(x)
}

/// Jumps of any length: the end of the true branch or a refusal.
#[test]
fn jumps_are_followed_truly_or_refused() {
    let random = &mut Random(5);
    let (mut followed, mut refused, mut singular) = (0, 0, 0);
    for name in ["five-bar", "3-rpr", "3-rrr", "2-prr", "delta"] {
        let robot = robot(name);
        for _ in 0..40 {
            let (pose, mode) = start(&robot, random);
            let q = robot.inverse_in(&pose, mode).unwrap().unwrap();
            let length = 10f64.powf(random.within(-2.0, 0.5));
            let goal: Vec<f64> = (q.iter().zip(&robot.legs))
                .map(|(q, leg)| {
                    let unit = if leg.actuator.is_angle() { 1.0 } else { q.abs() };
                    q + length * unit * random.within(-1.0, 1.0)
                })
                .collect();
            let Ok(mut follower) = Follower::new(&robot, &pose, &q) else { continue };
            let truth = by_fine_steps(&robot, &pose, &q, &goal);
            match (follower.step(&goal), truth) {
                (Ok(step), Some(x)) => {
                    followed += 1;
                    assert!(apart(&robot, step.pose(), &x) < 1e-6, "{name}: {:?}, {x:?}", step.pose());
                }
                (Ok(step), None) => panic!("{name}: {:?} proved, but no branch goes there", step.pose()),
                (Err(Refusal::Input(_)), _) => {}
                (Err(_), Some(_)) => refused += 1,
                (Err(_), None) => singular += 1,
            }
        }
    }
    println!("{followed} jumps followed, {refused} refused, {singular} refused that end at a singularity");
    assert!(followed > 60 && singular > 20 && refused < followed / 2);
}

#[test]
fn work_is_bounded() {
    let robot = robot("3-rrr");
    let mut follower = follower(&robot, &[-14.0, -5.0, 0.5], "+++");
    let q = follower.q().to_vec();
    let goal: Vec<f64> = q.iter().map(|q| q + 1e6).collect();
    let Err(Refusal::Parallel { proved, .. } | Refusal::TooLong { proved, .. }) = follower.step(&goal) else {
        panic!("a jump of 10⁶ rad")
    };
    assert!(proved < 1e-3);
    assert_eq!(follower.q(), q);
}

#[test]
fn bad_input_is_named() {
    let robot = robot("3-rpr");
    let start = robot.direct(&[14.98, 15.38, 12.0]).unwrap().remove(0);
    let mut follower = Follower::new(&robot, &start.pose, &start.q).unwrap();
    let mut refused = |q: &[f64]| match follower.step(q) {
        Err(Refusal::Input(input)) => input,
        other => panic!("{other:?}"),
    };
    assert_eq!(refused(&[1.0, 2.0]), BadInput::Length { wanted: 3, found: 2 });
    assert_eq!(refused(&[1.0]).to_string(), "1 number given, but the robot has 3 coordinates");
    assert!(refused(&[14.98, 15.38, 1e300]).to_string().starts_with("coordinate 3 is 1e300: "));
    assert_eq!(refused(&[14.98, -1.0, 12.0]), BadInput::StrutLength { leg: LegIndex::new(1), value: -1.0 });
    for bad in [f64::NAN, f64::INFINITY, 1e8] {
        assert!(matches!(refused(&[14.98, 15.38, bad]), BadInput::Number { index: 3, .. }));
    }
    assert!(follower.step(&start.q).is_ok());
}

#[test]
fn a_start_needs_a_solution_that_is_surely_meant() {
    let robot = robot("five-bar");
    let q = robot.inverse_in(&[4.0, 7.0], "++".parse().unwrap()).unwrap().unwrap();
    // Rounded to three digits it is still clear which is meant.
    let near = Follower::new(&robot, &[4.003, 6.996], &q).unwrap();
    assert!(apart(&robot, near.pose(), &[4.0, 7.0]) < 1e-12);
    for far in [[0.0, 0.0], [4.0, -7.0], [30.0, 30.0]] {
        assert_eq!(Follower::new(&robot, &far, &q).unwrap_err(), StartError::NoSolution, "{far:?}");
    }
    assert!(matches!(Follower::new(&robot, &[4.0], &q), Err(StartError::Kinematics(_))));
    assert!(matches!(Follower::new(&robot, &[4.0, f64::NAN], &q), Err(StartError::Kinematics(_))));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// Robots that start next to a singularity: what is returned solves the equations and has kept the sign of det A.
    #[test]
    fn next_to_singularities(seed in any::<u64>(), which in 0..3usize, gap in 1..8i32) {
        let platform = [Platform::PlanePoint, Platform::PlaneBody, Platform::TranslatingBody][which];
        let case = random::case(platform, Spread::Singular(10f64.powi(-gap)), seed);
        let Ok(mut follower) = Follower::new(&case.robot, &case.pose, &case.q) else { return Ok(()) };
        let sign = case.robot.jacobians(follower.pose(), &case.q).unwrap().det_a().signum();
        let random = &mut Random(seed);
        let direction: Vec<f64> = case.q.iter().map(|_| random.within(-1e-3, 1e-3)).collect();
        for i in 1..200 {
            let q: Vec<f64> = case.q.iter().zip(&direction).map(|(q, d)| q + d * i as f64).collect();
            let Ok(step) = follower.step(&q) else { break };
            let jacobians = case.robot.jacobians(step.pose(), &q).unwrap();
            prop_assert!(jacobians.residual < 1e-9);
            prop_assert!(jacobians.det_a() * sign > 0.0, "{} at step {i}", jacobians.det_a());
        }
    }
}
