//! The direct model against closed forms, the literature, brute force and random robots.
//!
//! `ASPECTA_CASES` sets the number of random cases of each kind (4000 by default).

use crate::random::{self, Case, Spread, case};
use aspecta::Kinematics;
use aspecta::kinematics::placement::Placement;
use aspecta::kinematics::{DirectSolutions, KinematicsError, Solution};
use aspecta::num::Interval;
use aspecta::robot::{
    Actuator, BASE_FRAME, Leg, LegIndex, Platform, Prismatic, Revolute, Robot, Strut, point,
};
use nalgebra::DMatrix;
use std::f64::consts::{PI, TAU};

const PLATFORMS: [Platform; 3] = [Platform::PlanePoint, Platform::PlaneBody, Platform::TranslatingBody];

fn cases() -> u64 {
    std::env::var("ASPECTA_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(4000)
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
    // Where A loses two ranks, two such parabolas follow one another: √√ε.
    if svd.singular_values.iter().filter(|s| **s < 1e-6).count() > 1 {
        return ROUNDING.sqrt().sqrt();
    }
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

/// f(X, q) of a planar robot, by the leg equations.
fn equations(robot: &Robot, x: &[f64], q: &[f64]) -> Vec<f64> {
    let placement = Placement::<f64, 2>::at(robot.platform, x);
    let f = |(leg, q): (&Leg, &f64)| leg.actuator.equation(&placement.span(leg, &placement.arm(leg)), *q);
    robot.legs.iter().zip(q).map(f).collect()
}

#[test]
fn a_is_the_derivative_of_the_leg_equations() {
    for seed in 0..200 {
        for platform in [Platform::PlanePoint, Platform::PlaneBody] {
            let Case { robot, pose, q } = case(platform, Spread::Anywhere, seed);
            let a = robot.jacobians(&pose, &q).unwrap().a;
            for k in 0..pose.len() {
                let moved = |h: f64| {
                    let mut x = pose.clone();
                    x[k] += h;
                    equations(&robot, &x, &q)
                };
                let (ahead, behind) = (moved(1e-5), moved(-1e-5));
                for i in 0..pose.len() {
                    let slope = (ahead[i] - behind[i]) / 2e-5;
                    assert!((slope - a[i][k]).abs() < 1e-6, "{seed}: {slope} {a:?}");
                }
            }
        }
    }
}

/// The circle of leg `j` when its actuator is locked: centre B_j (for struts A_j) and radius.
fn circle(leg: &Leg, q: f64) -> ([f64; 2], f64) {
    let a = [leg.anchor[0].mid(), leg.anchor[1].mid()];
    let along = |x: f64, y: f64| -> [f64; 2] {
        std::array::from_fn(|k| a[k] + x * leg.frame[0][k].mid() + y * leg.frame[1][k].mid())
    };
    match leg.actuator {
        Actuator::Revolute(Revolute { crank, rod }) => {
            (along(crank.mid() * q.cos(), crank.mid() * q.sin()), rod.mid())
        }
        Actuator::Prismatic(Prismatic { rod }) => (along(q, 0.0), rod.mid()),
        _ => (a, q),
    }
}

/// All poses by brute force: at each of many orientations the first two legs leave two positions, and where the third
/// leg's equation changes sign along a branch there is a pose. Misses pairs nearer than the steps.
fn scan(robot: &Robot, q: &[f64], steps: usize) -> Vec<f64> {
    let circles: Vec<_> = robot.legs.iter().zip(q).map(|(leg, q)| circle(leg, *q)).collect();
    let third = |phi: f64, side: f64| -> Option<f64> {
        let (s, c) = phi.sin_cos();
        let centre = |j: usize| -> [f64; 2] {
            let [x, y] = [robot.legs[j].attachment[0].mid(), robot.legs[j].attachment[1].mid()];
            [circles[j].0[0] - (c * x - s * y), circles[j].0[1] - (s * x + c * y)]
        };
        let (p, r) = (centre(0), circles[0].1);
        let d = [centre(1)[0] - p[0], centre(1)[1] - p[1]];
        let d2 = d[0] * d[0] + d[1] * d[1];
        let along = (r * r - circles[1].1.powi(2) + d2) / (2.0 * d2);
        let across = side * (r * r / d2 - along * along).sqrt();
        let x = [p[0] + along * d[0] - across * d[1], p[1] + along * d[1] + across * d[0]];
        let e = centre(2);
        let h = (x[0] - e[0]).powi(2) + (x[1] - e[1]).powi(2) - circles[2].1.powi(2);
        h.is_finite().then_some(h)
    };
    let mut roots = Vec::new();
    for side in [1.0, -1.0] {
        let at = |k: usize| -PI + TAU * k as f64 / steps as f64;
        for k in 0..steps {
            if let (Some(a), Some(b)) = (third(at(k), side), third(at(k + 1), side))
                && (a > 0.0) != (b > 0.0)
            {
                roots.push(at(k) + TAU / steps as f64 * a / (a - b));
            }
        }
    }
    roots
}

#[test]
fn no_pose_of_a_scan_over_orientations_is_missed() {
    const STEPS: usize = 20_000;
    let mut histogram = [0; 7];
    for seed in 0..300 {
        let case = case(Platform::PlaneBody, Spread::Anywhere, seed + 1_000_000);
        let found = case.robot.direct_certified(&case.q).unwrap();
        let mut angles: Vec<f64> = found.solutions.iter().map(|s| s.pose[2]).collect();
        let scanned = scan(&case.robot, &case.q, STEPS);
        assert!(scanned.len() <= angles.len(), "{seed}: {scanned:?} {angles:?}");
        histogram[angles.len()] += 1;
        for phi in scanned {
            let gap = |a: &f64| ((a - phi + PI).rem_euclid(TAU) - PI).abs();
            let nearest =
                (0..angles.len()).min_by(|&i, &j| gap(&angles[i]).total_cmp(&gap(&angles[j]))).unwrap();
            assert!(gap(&angles[nearest]) < TAU / STEPS as f64, "{seed}: {phi} {angles:?}");
            angles.swap_remove(nearest);
        }
        // What the scan did not see are pairs that it steps over, or poses at the ends of a branch.
        assert!(angles.len() <= 2, "{seed}: the scan misses {angles:?}");
    }
    assert!(histogram[2] > 0 && histogram[4] > 0 && histogram[6] > 0, "{histogram:?}");
    assert_eq!(histogram[1] + histogram[3] + histogram[5], 0, "{histogram:?}");
}

fn five_bar() -> Robot {
    let legs = vec![
        Leg::revolute([0.0, 0.0], [0.0, 0.0], 8.0, 5.0),
        Leg::revolute([9.0, 0.0], [0.0, 0.0], 5.0, 8.0),
    ];
    Robot::new("five-bar", Platform::PlanePoint, legs).unwrap()
}

#[test]
fn the_five_bar_has_two_poses_mirrored_in_the_line_of_its_elbows() {
    let robot = five_bar();
    let q = robot.inverse_in(&[4.0, 7.0], "+-".parse().unwrap()).unwrap().unwrap();
    let found = robot.direct_certified(&q).unwrap();
    assert!(found.complete && found.solutions.len() == 2);
    let [a, b] = [0, 1].map(|k| &found.solutions[k]);
    assert!(a.det_a * b.det_a < 0.0 && (a.det_a + b.det_a).abs() < 1e-9);
    let (b1, b2) = ([8.0 * q[0].cos(), 8.0 * q[0].sin()], [9.0 + 5.0 * q[1].cos(), 5.0 * q[1].sin()]);
    let (d, n) = ([b2[0] - b1[0], b2[1] - b1[1]], [a.pose[0] - b.pose[0], a.pose[1] - b.pose[1]]);
    assert!((d[0] * n[0] + d[1] * n[1]).abs() < 1e-12);
    let middle = [(a.pose[0] + b.pose[0]) / 2.0 - b1[0], (a.pose[1] + b.pose[1]) / 2.0 - b1[1]];
    assert!((d[0] * middle[1] - d[1] * middle[0]).abs() < 1e-12);
    let (gap, same) = nearest(robot.platform, &found.solutions, &[4.0, 7.0]);
    assert!(gap < 1e-15 && same.unwrap().mode.to_string() == "+-");
}

#[test]
fn locked_out_of_reach_is_proved_to_have_no_pose() {
    // The elbows are 8 + 9 + 5 apart; the rods reach 13.
    let found = five_bar().direct_certified(&[PI, 0.0]).unwrap();
    assert!(found.complete && found.solutions.is_empty());
    let found = three_rpr().direct_certified(&[1.0, 1.0, 100.0]).unwrap();
    assert!(found.complete && found.solutions.is_empty());
}

/// Table 4: points 1 and 3 are two direct solutions of one joint vector, to the rounding of the table.
#[test]
fn the_3_rrr_of_table_3_has_both_ends_of_table_4() {
    let legs = vec![
        Leg::revolute([-10.0, -10.0], [0.0, 0.0], 10.0, 10.0),
        Leg::revolute([10.0, -10.0], [10.0, 0.0], 10.0, 10.0),
        Leg::revolute([0.0, 10.0], [10.0, 10.0], 10.0, 10.0),
    ];
    let robot = Robot::new("3-rrr", Platform::PlaneBody, legs).unwrap();
    let (from, to) = ([-15.468, 0.781, 0.073], [-9.902, -7.091, 1.081]);
    let q = robot.inverse_in(&from, "+++".parse().unwrap()).unwrap().unwrap();
    let found = robot.direct_certified(&q).unwrap();
    assert!(found.complete);
    let (gap, first) = nearest(robot.platform, &found.solutions, &from);
    assert!(gap < 1e-12 && first.unwrap().mode.to_string() == "+++");
    let (gap, last) = nearest(robot.platform, &found.solutions, &to);
    // The table's rounding, 0.02°, magnified.
    assert!(gap < 2e-3 && last.unwrap().mode.to_string() == "+++");
    assert!(first.unwrap().det_a * last.unwrap().det_a > 0.0, "no singularity in between");
}

#[test]
fn six_poses_in_any_unit_and_place() {
    let unit = three_rpr();
    for (scale, shift) in [(1e-3, 0.0), (1e3, 0.0), (1e-3, 5.0), (1.0, 1e4)] {
        let mut robot = unit.clone();
        let number = Interval::point;
        for leg in &mut robot.legs {
            leg.anchor = std::array::from_fn(|k| {
                leg.anchor[k] * number(scale) + number(if k < 2 { shift } else { 0.0 })
            });
            leg.attachment = leg.attachment.map(|c| c * number(scale));
        }
        let found = robot.direct_certified(&[14.98 * scale, 15.38 * scale, 12.0 * scale]).unwrap();
        assert!(found.complete && found.solutions.len() == 6, "{scale} {shift}: {found:?}");
    }
}

/// A planar all-strut robot and the lengths of its struts at `pose`.
fn struts(anchors: [[f64; 2]; 3], attachments: [[f64; 2]; 3], pose: [f64; 3]) -> (Robot, Vec<f64>) {
    let legs = (0..3).map(|j| Leg::strut(anchors[j], attachments[j])).collect();
    let robot = Robot::new("3-rpr", Platform::PlaneBody, legs).unwrap();
    let q = robot.inverse(&pose).unwrap().remove(0).q;
    (robot, q)
}

fn assert_complete_with(robot: &Robot, q: &[f64], poses: &[[f64; 3]]) -> DirectSolutions {
    let found = robot.direct_certified(q).unwrap();
    assert!(found.complete, "{found:?}");
    for pose in poses {
        let (gap, _) = nearest(robot.platform, &found.solutions, pose);
        assert!(gap < 1e-12, "{pose:?} is missing from {found:?}");
    }
    found
}

const TRIANGLE: [[f64; 2]; 3] = [[0.0, 0.0], [10.0, 0.0], [3.0, 8.0]];

#[test]
fn special_orientations_are_found() {
    let platform = [[0.0, 0.0], [4.0, 1.0], [1.0, 5.0]];
    for phi in [PI, -PI / 2.0, PI / 2.0, 0.0, 2.0 * 0.8f64.atan2(0.6) - PI] {
        let pose = [2.5, 3.25, phi];
        let (robot, q) = struts(TRIANGLE, platform, pose);
        let found = assert_complete_with(&robot, &q, &[pose]);
        assert!(found.solutions.iter().all(|s| -PI < s.pose[2] && s.pose[2] <= PI));
    }
}

/// Base and platform in line: poses come in pairs mirrored in the base, (x, y, φ) and (x, −y, −φ); at φ = 0 both have
/// one orientation and the equations for the position are singular.
#[test]
fn aligned_base_and_platform() {
    let base = [[0.0, 0.0], [7.0, 0.0], [11.0, 0.0]];
    let platform = [[0.0, 0.0], [3.0, 0.0], [8.0, 0.0]];
    for phi in [0.7, 0.0, PI] {
        let (robot, q) = struts(base, platform, [2.0, 5.0, phi]);
        let mirrored = [2.0, -5.0, -phi];
        let found = assert_complete_with(&robot, &q, &[[2.0, 5.0, phi], mirrored]);
        assert_eq!(found.solutions.len() % 2, 0);
    }
}

/// Two legs on one platform point: two circles place it, and two more the body's orientation: up to four poses.
#[test]
fn coincident_attachments() {
    let sets = [[0, 0, 1], [0, 1, 0], [1, 0, 0]];
    let points = [[1.0, -0.5], [5.0, 2.0]];
    for set in sets {
        let pose = [3.0, 4.0, 2.0];
        let (robot, q) = struts(TRIANGLE, set.map(|k| points[k]), pose);
        let found = assert_complete_with(&robot, &q, &[pose]);
        assert!(found.solutions.len() == 2 || found.solutions.len() == 4);
    }
}

/// Platform similar to the base: the eliminant has a factor without poses. With λ = 1 and equal struts the platform
/// can translate on a circle.
#[test]
fn similar_platforms() {
    for lambda in [0.5, 1.0, 2.0] {
        let platform = TRIANGLE.map(|p| p.map(|x| x * lambda));
        let pose = [1.0, 2.0, 0.9];
        let (robot, q) = struts(TRIANGLE, platform, pose);
        let found = assert_complete_with(&robot, &q, &[pose]);
        assert!(found.solutions.len() <= 4);
    }
    let (robot, q) = struts(TRIANGLE, TRIANGLE, [3.0, 4.0, 0.0]);
    assert_self_motion(&robot, &q);
}

fn assert_self_motion(robot: &Robot, q: &[f64]) {
    let answer = robot.direct_certified(q);
    assert_eq!(answer, Err(KinematicsError::SelfMotion { robot: robot.name.clone() }));
}

#[test]
fn infinitely_many_poses_are_an_error() {
    // A free hinge: all legs on one point of the platform.
    let (robot, q) = struts(TRIANGLE, [[2.0, 1.0]; 3], [3.0, 4.0, 1.0]);
    assert_self_motion(&robot, &q);
    // One leg twice.
    let twice = ([[0.0, 0.0], [0.0, 0.0], [9.0, 1.0]], [[1.0, 0.0], [1.0, 0.0], [4.0, 3.0]]);
    let (robot, q) = struts(twice.0, twice.1, [3.0, 4.0, 1.0]);
    assert_self_motion(&robot, &q);
    // … which is none if the third is out of reach, or if the two differ in length.
    let found = robot.direct_certified(&[q[0], q[0], 100.0]).unwrap();
    assert!(found.complete && found.solutions.is_empty());
    let found = robot.direct_certified(&[q[0], q[0] + 1e-9, q[2]]).unwrap();
    assert!(found.complete && found.solutions.is_empty());
    // Concentric equal circles.
    let legs = (0..2).map(|_| Leg::strut([0.0, 0.0], [0.0, 0.0])).collect();
    let robot = Robot::new("hinge", Platform::PlanePoint, legs).unwrap();
    assert_self_motion(&robot, &[2.0, 2.0]);
    assert!(robot.direct(&[2.0, 3.0]).unwrap().is_empty());
    // Three spheres with centres in line.
    let robot = in_line([0.0, 2.0, 5.0]);
    let length = |x: f64| f64::hypot(3.0 - x, 4.0);
    assert_self_motion(&robot, &[5.0, length(2.0), length(5.0)]);
    assert!(robot.direct(&[5.0, length(2.0), 4.0]).unwrap().is_empty());
    assert!(robot.direct(&[1.0, 1.0, 3.9]).unwrap().is_empty());
}

/// A translating body on three struts from points of the x axis.
fn in_line(x: [f64; 3]) -> Robot {
    let leg = |x: f64| Leg {
        anchor: point([x, 0.0, 0.0]),
        attachment: point([0.0; 3]),
        frame: BASE_FRAME,
        actuator: Actuator::Strut(Strut),
        limits: Vec::new(),
    };
    Robot::new("in-line", Platform::TranslatingBody, x.map(leg).to_vec()).unwrap()
}

#[test]
fn both_poses_of_a_translating_body_are_mirrored_and_opposite() {
    for seed in 0..300 {
        let case = case(Platform::TranslatingBody, Spread::Anywhere, seed);
        let found = case.robot.direct_certified(&case.q).unwrap();
        assert!(found.complete && found.solutions.len() == 2);
        let sum: f64 = found.solutions.iter().map(|s| s.det_a).sum();
        assert!(sum.abs() < 1e-9 * found.solutions[0].det_a.abs().max(1.0));
    }
}

#[test]
fn input_that_cannot_be_solved_is_a_typed_error() {
    let robot = three_rpr();
    assert_eq!(
        robot.direct(&[1.0, -2.0, 3.0]),
        Err(KinematicsError::StrutLength { leg: LegIndex::new(1), value: -2.0 })
    );
    assert_eq!(
        robot.direct(&[0.0, 2.0, 3.0]),
        Err(KinematicsError::StrutLength { leg: LegIndex::new(0), value: 0.0 })
    );
    assert!(matches!(robot.direct(&[1.0, 2.0]), Err(KinematicsError::Length { wanted: 3, found: 2, .. })));
    assert!(matches!(robot.direct(&[1.0, 2.0, f64::NAN]), Err(KinematicsError::NotFinite { index: 3, .. })));
    // Absurd sizes overflow: undecided, and said so, never a panic.
    assert!(
        robot.direct(&[1e300, 1e300, 1e300]).is_ok_and(|s| s.is_empty())
            || robot.direct(&[1e300; 3]).is_err()
    );
    assert!(robot.direct(&[1e-300, 1e-300, 1e-300]).is_ok_and(|s| s.is_empty()));
}

#[test]
fn plain_and_certified_poses_are_the_same() {
    for platform in PLATFORMS {
        for seed in 0..200 {
            let case = case(platform, Spread::Anywhere, seed);
            let poses = case.robot.direct_poses(&case.q).unwrap();
            let labelled = case.robot.direct(&case.q).unwrap();
            assert!(poses.iter().eq(labelled.iter().map(|s| &s.pose[..])));
        }
    }
}

/// Robots on a small integer grid are degenerate in every way: coincident and aligned points, parallel struts, poses
/// that meet, translations and turns with locked struts.
#[test]
fn robots_on_a_grid() {
    let (mut complete, mut open, mut moving) = (0, 0, 0);
    for seed in 0..cases() {
        let random = &mut random::Random(seed + 77);
        let mut grid = || random.within(-2.0, 3.0).floor();
        let points: [[f64; 2]; 6] = std::array::from_fn(|_| [grid(), grid()]);
        let turns = [0.0, PI / 2.0, PI, -PI / 2.0, 0.8f64.atan2(0.6)];
        let pose = [grid(), grid(), turns[(grid() + 2.0) as usize]];
        let [a1, a2, a3, c1, c2, c3] = points;
        let legs = vec![Leg::strut(a1, c1), Leg::strut(a2, c2), Leg::strut(a3, c3)];
        let robot = Robot::new("grid", Platform::PlaneBody, legs).unwrap();
        let q = robot.inverse(&pose).unwrap().remove(0).q;
        // A strut of length zero, to rounding, has no direction and no relative residual.
        if q.iter().any(|&q| q < 1e-9) {
            continue;
        }
        match robot.direct_certified(&q) {
            Ok(found) => {
                let case = Case { robot, pose: pose.to_vec(), q: q.clone() };
                assert_contains(&found, &case, &q, &format!("{seed}"));
                assert_sound(&found, &case, &format!("{seed}"));
                *(if found.complete { &mut complete } else { &mut open }) += 1;
            }
            Err(KinematicsError::SelfMotion { .. }) => moving += 1,
            Err(error) => panic!("{seed}: {error}"),
        }
    }
    println!("{complete} proved complete, {open} open, {moving} with a self-motion");
}
