//! The direct model against closed forms, the literature, brute force and random robots.
//!
//! `ASPECTA_CASES` sets the number of random cases of each kind (20 000 by default).

mod random;

use aspecta::kinematics::{DirectSolutions, KinematicsError, Solution};
use aspecta::num::Interval;
use aspecta::robot::{Leg, Platform, Robot};
use nalgebra::DMatrix;
use random::{Case, Spread, case};
use std::f64::consts::{PI, TAU};

const PLATFORMS: [Platform; 3] = [Platform::PlanePoint, Platform::PlaneBody, Platform::TranslatingBody];

fn cases() -> u64 {
    std::env::var("ASPECTA_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(20_000)
}

/// Lengths of the random robots are of this order.
const SIZE: f64 = 10.0;

/// What makes pose coordinate k a number of order one.
fn unit(platform: Platform, k: usize) -> f64 {
    if platform.coordinates()[k].angle { 1.0 } else { SIZE }
}

/// Distance of two poses: lengths relative to the robot, angles in rad.
fn distance(platform: Platform, a: &[f64], b: &[f64]) -> f64 {
    let gap = |(k, c): (usize, &aspecta::robot::Coordinate)| {
        let gap = (a[k] - b[k]) / unit(platform, k);
        if c.angle { (gap + PI).rem_euclid(TAU) - PI } else { gap }
    };
    platform.coordinates().iter().enumerate().map(gap).fold(0.0, |d: f64, g| d.max(g.abs()))
}

fn nearest<'a>(platform: Platform, solutions: &'a [Solution], pose: &[f64]) -> (f64, Option<&'a Solution>) {
    let of = |s: &Solution| distance(platform, &s.pose, pose);
    let best = solutions.iter().min_by(|a, b| of(a).total_cmp(&of(b)));
    (best.map_or(f64::INFINITY, of), best)
}

/// A, its rows and columns scaled to numbers of order one.
fn scaled_a(robot: &Robot, pose: &[f64], q: &[f64]) -> DMatrix<f64> {
    let a = robot.jacobians(pose, q).unwrap().a;
    DMatrix::from_fn(a.len(), a.len(), |i, k| a[i][k] * unit(robot.platform, k) / (SIZE * SIZE))
}

/// How far from X a solution may be when f carries a rounding error ε. Along the direction n that A stretches
/// least, by σ, and for the equation l · f that sees it least, l · f = σ s + κ s²/2 + …, which ε shifts by the
/// lesser of ε/σ and about √(2ε/|κ|): where two solutions meet, only √ε is left of sixteen digits.
fn reach_of_rounding(robot: &Robot, pose: &[f64], q: &[f64]) -> f64 {
    // Some twenty roundings of coordinates up to 60, times 2 R ≤ 24, over SIZE².
    const ROUNDING: f64 = 5e-14;
    const STEP: f64 = 1e-4;
    let svd = scaled_a(robot, pose, q).svd(true, true);
    let last = svd.singular_values.imin();
    let (l, n) = (svd.u.unwrap().column(last).into_owned(), svd.v_t.unwrap().row(last).transpose());
    let moved = |s: f64| -> Vec<f64> {
        pose.iter().enumerate().map(|(k, x)| x + s * n[k] * unit(robot.platform, k)).collect()
    };
    let change = scaled_a(robot, &moved(STEP), q) - scaled_a(robot, &moved(-STEP), q);
    let curvature = l.dot(&(change * n)).abs() / (2.0 * STEP);
    (ROUNDING / svd.singular_values[last]).min((4.0 * ROUNDING / curvature).sqrt())
}

fn assert_contains(found: &DirectSolutions, case: &Case, q: &[f64], context: &str) {
    let (gap, _) = nearest(case.robot.platform, &found.solutions, &case.pose);
    let allowed = reach_of_rounding(&case.robot, &case.pose, q).max(1e-9);
    if gap > allowed {
        let r = case.robot.jacobians(&case.pose, q).unwrap().residual;
        eprintln!(
            "RES {r:e} {:?}",
            found.solutions.iter().map(|s| (s.residual, s.certified)).collect::<Vec<_>>()
        );
    }
    assert!(gap <= allowed, "{context}: nearest at {gap:e}, allowed {allowed:e}\n{case:#?}\n{found:#?}");
}

/// Structure that every answer has.
fn assert_sound(found: &DirectSolutions, case: &Case, context: &str) {
    for s in &found.solutions {
        assert!(s.residual < 1e-11, "{context}: {s:?} {case:?}");
        for (x, c) in s.pose.iter().zip(case.robot.platform.coordinates()) {
            assert!(!c.angle || (-PI < *x && *x <= PI), "{context}: {s:?}");
        }
    }
    if found.complete {
        // q ↦ (lengths of the locked legs)² is proper and misses negative squares: its degree, the sum of
        // the signs of det A over all solutions, is zero.
        let sum: f64 = found.solutions.iter().map(|s| s.det_a.signum()).sum();
        assert!(found.solutions.iter().all(|s| s.certified), "{context}");
        assert_eq!(sum, 0.0, "{context}: {found:#?}");
    }
}

#[test]
fn direct_of_inverse_holds_the_pose() {
    for platform in PLATFORMS {
        let (mut joint_vectors, mut complete) = (0, 0);
        for seed in std::env::var("SEED").map_or(0..cases(), |s| {
            let s: u64 = s.parse().unwrap();
            s..s + 1
        }) {
            let case = case(platform, Spread::Anywhere, seed);
            for s in case.robot.inverse(&case.pose).unwrap() {
                let context = format!("{platform} {seed} {}", s.mode);
                let found = case.robot.direct_certified(&s.q).unwrap();
                assert_contains(&found, &case, &s.q, &context);
                assert_sound(&found, &case, &context);
                joint_vectors += 1;
                complete += usize::from(found.complete);
            }
        }
        println!("{platform}: {joint_vectors} joint vectors, {complete} proved complete");
        assert!(joint_vectors as u64 > cases());
        assert!(complete as f64 > 0.999 * f64::from(joint_vectors), "{complete} of {joint_vectors}");
    }
}

/// A true configuration, however near to a parallel singularity, is among the solutions.
#[test]
fn no_solution_is_lost_near_double_roots() {
    for platform in PLATFORMS {
        let (mut complete, mut uncertified) = (0, 0);
        for seed in 0..cases() {
            let gap = if seed % 17 == 0 { 0.0 } else { 10f64.powi(-((seed % 17) as i32)) };
            let case = case(platform, Spread::Singular(gap), seed);
            let context = format!("{platform} {seed} gap {gap}");
            for q in case.robot.inverse(&case.pose).unwrap().into_iter().map(|s| s.q) {
                let found = case.robot.direct_certified(&q).unwrap();
                assert_contains(&found, &case, &q, &context);
                assert_sound(&found, &case, &context);
                complete += usize::from(found.complete);
                uncertified += found.solutions.iter().filter(|s| !s.certified).count();
            }
        }
        println!("{platform}: {complete} proved complete, {uncertified} solutions uncertified");
    }
}

/// The 3-RPR of Innocenti and Parenti-Castelli.
fn three_rpr() -> Robot {
    let (b12, b13, b23): (f64, f64, f64) = (17.04, 20.84, 16.54);
    let x = (b12 * b12 + b13 * b13 - b23 * b23) / (2.0 * b12);
    let b3 = [x, (b13 * b13 - x * x).sqrt()];
    let legs = vec![
        Leg::strut([0.0, 0.0], [0.0, 0.0]),
        Leg::strut([15.91, 0.0], [b12, 0.0]),
        Leg::strut([0.0, 10.0], b3),
    ];
    Robot::new("3-rpr", Platform::PlaneBody, legs).unwrap()
}

#[test]
fn the_3_rpr_of_innocenti_and_parenti_castelli_has_six_poses() {
    let found = three_rpr().direct_certified(&[14.98, 15.38, 12.0]).unwrap();
    assert!(found.complete);
    assert_eq!(found.solutions.len(), 6);
    assert!(found.solutions.iter().all(|s| s.certified && s.residual < 1e-14 && s.mode.to_string() == "---"));
    assert!(found.solutions.is_sorted_by_key(|s| s.pose[2]));
}
