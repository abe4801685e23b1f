//! The direct model of bodies that turn in space, against independent methods, the literature and random robots.
//!
//! `ASPECTA_CASES` sets the number of random platforms (300 by default).

use crate::random::Random;
use aspecta::Kinematics;
use aspecta::kinematics::{DirectSolutions, KinematicsError};
use aspecta::num::Interval;
use aspecta::robot::{Actuator, Leg, Platform, Prismatic, Revolute, Robot, Spherical};
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::{PI, TAU};

fn cases() -> u64 {
    std::env::var("ASPECTA_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(300)
}

pub fn vector(random: &mut Random) -> [f64; 3] {
    std::array::from_fn(|_| random.within(-1.0, 1.0))
}

/// Six struts between points of the base and of the platform.
pub fn hexapod(base: &[[f64; 3]; 6], platform: &[[f64; 3]; 6]) -> Robot {
    let leg = |k: usize| {
        let mut leg = Leg::strut([0.0, 0.0], [0.0, 0.0]);
        leg.anchor = base[k].map(Interval::point);
        leg.attachment = platform[k].map(Interval::point);
        leg
    };
    Robot::new("hexapod", Platform::FreeBody, (0..6).map(leg).collect()).unwrap()
}

fn random_points(random: &mut Random) -> [[f64; 3]; 6] {
    std::array::from_fn(|_| vector(random))
}

pub fn random_pose(random: &mut Random) -> Vec<f64> {
    let mut pose: Vec<f64> = vector(random).into();
    pose.extend([random.within(-PI, PI), random.within(-1.5, 1.5), random.within(-PI, PI)]);
    pose
}

/// R_z(yaw) R_y(pitch) R_x(roll).
fn rotation(angles: &[f64]) -> Matrix3<f64> {
    *nalgebra::Rotation3::from_euler_angles(angles[0], angles[1], angles[2]).matrix()
}

/// Greatest difference of two poses, in lengths or in entries of R.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    let lengths = a.len() - 3;
    let moved = (0..lengths).map(|k| (a[k] - b[k]).abs()).fold(0.0, f64::max);
    moved.max((rotation(&a[lengths..]) - rotation(&b[lengths..])).amax())
}

pub fn nearest(found: &DirectSolutions, pose: &[f64]) -> f64 {
    found.solutions.iter().map(|s| apart(&s.pose, pose)).fold(f64::INFINITY, f64::min)
}

/// All different, certified, true to the leg lengths as the inverse model has them.
pub fn assert_sound(robot: &Robot, q: &[f64], found: &DirectSolutions) {
    for (k, s) in found.solutions.iter().enumerate() {
        assert!(s.certified && s.residual < 1e-10, "{s:?}");
        assert!(found.solutions[..k].iter().all(|other| apart(&other.pose, &s.pose) > 1e-9));
        let back = robot.inverse_in(&s.pose, s.mode).unwrap().unwrap();
        let gap = |(a, b): (&f64, &f64)| (a - b).abs().min(TAU - (a - b).abs()).abs();
        let worst = back.iter().zip(q).map(gap).fold(0.0, f64::max);
        // Where a leg is nearly folded only half the digits of its q are left.
        assert!(worst < 1e-6, "{worst:e} {s:?}");
    }
}

/// Dietmaier 1998: 40 real poses.
#[test]
fn dietmaiers_platform() {
    let robot = Robot::resolve("gough-stewart").unwrap();
    let q = [1.0, 0.645275, 1.086284, 1.503439, 1.281933, 0.771071];
    let found = robot.direct_certified(&q).unwrap();
    assert_eq!((found.solutions.len(), found.complete), (40, true));
    assert_sound(&robot, &q, &found);
    assert!(found.solutions.iter().all(|s| s.residual < 1e-13 && s.within_limits));
    assert_eq!(robot.direct_poses(&q).unwrap().len(), 40);
}

/// Complete means that 40 complex solutions were proved to be different.
#[test]
fn random_platforms_have_40_solutions() {
    let mut random = Random(1);
    for case in 0..cases() {
        let robot = hexapod(&random_points(&mut random), &random_points(&mut random));
        let pose = random_pose(&mut random);
        let q = robot.inverse(&pose).unwrap()[0].q.clone();
        let found = robot.direct_certified(&q).unwrap();
        assert!(found.complete, "case {case}");
        assert_eq!(found.solutions.len() % 2, 0, "case {case}");
        assert!(nearest(&found, &pose) < 1e-8, "case {case}");
        assert_sound(&robot, &q, &found);
    }
}

#[test]
fn cranks_and_sliders_too() {
    let mut random = Random(2);
    let mut tried = 0;
    for case in 0..cases() / 10 {
        let [base, platform, zero] = [0; 3].map(|_| random_points(&mut random));
        let mut robot = hexapod(&base, &platform);
        let pose = random_pose(&mut random);
        for (leg, zero) in robot.legs.iter_mut().zip(zero) {
            let u = Vector3::from(zero).normalize();
            let v = u.cross(&Vector3::from(vector(&mut random))).normalize();
            leg.frame = [u, v, u.cross(&v)].map(|axis| <[f64; 3]>::from(axis).map(Interval::point));
            let [one, three] = [1.0, 6.0].map(Interval::point);
            leg.actuator = match case % 2 {
                0 => Actuator::Revolute(Revolute { crank: one, rod: three }),
                _ => Actuator::Prismatic(Prismatic { rod: three }),
            };
        }
        // Cranks of length 1 and rods of 6 close almost nowhere: choose the rods by the pose.
        let placed = |leg: &Leg| {
            let c = rotation(&pose[3..]) * Vector3::from(leg.attachment.map(Interval::mid))
                + Vector3::from_row_slice(&pose[..3]);
            c - Vector3::from(leg.anchor.map(Interval::mid))
        };
        for k in 0..6 {
            let rod = Interval::point(placed(&robot.legs[k]).norm() + 0.1);
            match &mut robot.legs[k].actuator {
                Actuator::Revolute(Revolute { rod: length, .. })
                | Actuator::Prismatic(Prismatic { rod: length }) => *length = rod,
                _ => unreachable!(),
            }
        }
        let solutions = robot.inverse(&pose).unwrap();
        tried += solutions.len();
        for s in solutions.iter().step_by(17) {
            let found = robot.direct_certified(&s.q).unwrap();
            assert!(found.complete, "case {case} {found:?}");
            assert!(nearest(&found, &pose) < 1e-7, "case {case} {}", nearest(&found, &pose));
            assert_sound(&robot, &s.q, &found);
        }
    }
    assert!(tried > 100, "{tried}");
}

/// With all joints of base and platform in two planes, each solution has a mirror image in that of the base.
#[test]
fn planar_platforms_are_mirrored() {
    let mut random = Random(3);
    for case in 0..20 {
        let flat = |points: [[f64; 3]; 6]| points.map(|p| [p[0], p[1], 0.0]);
        let robot = hexapod(&flat(random_points(&mut random)), &flat(random_points(&mut random)));
        let pose = random_pose(&mut random);
        let q = robot.inverse(&pose).unwrap()[0].q.clone();
        let found = robot.direct_certified(&q).unwrap();
        assert!(found.complete && nearest(&found, &pose) < 1e-8, "case {case}");
        for s in &found.solutions {
            // Mirrored in z = 0, and in the platform's own plane: (x, y, −z), (−roll, −pitch, yaw).
            let p = &s.pose;
            assert!(nearest(&found, &[p[0], p[1], -p[2], -p[3], -p[4], p[5]]) < 1e-6, "case {case}");
        }
    }
}

/// Legs that meet in pairs: the platform is a triangle, with at most 16 solutions, complex ones included.
#[test]
fn legs_in_pairs() {
    let mut random = Random(4);
    for case in 0..60 {
        let (mut base, mut platform) = (random_points(&mut random), random_points(&mut random));
        if case % 3 != 1 {
            (0..3).for_each(|k| platform[2 * k + 1] = platform[2 * k]);
        }
        if case % 3 != 0 {
            (0..3).for_each(|k| base[2 * k] = base[(2 * k + 5) % 6]);
        }
        let robot = hexapod(&base, &platform);
        let pose = random_pose(&mut random);
        let q = robot.inverse(&pose).unwrap()[0].q.clone();
        let found = robot.direct_certified(&q).unwrap();
        assert!(found.complete && found.solutions.len() <= 16, "case {case}");
        assert!(nearest(&found, &pose) < 1e-8, "case {case}");
        assert_sound(&robot, &q, &found);
    }
}

/// Where base and platform are equal, the other solutions are curves at infinity: none of those given is lost, and completeness is
/// not claimed.
#[test]
fn equal_platforms() {
    let mut random = Random(5);
    for case in 0..20 {
        let base = random_points(&mut random);
        let robot = hexapod(&base, &base);
        let pose = random_pose(&mut random);
        let q = robot.inverse(&pose).unwrap()[0].q.clone();
        let found = robot.direct_certified(&q).unwrap();
        assert!(!found.complete && nearest(&found, &pose) < 1e-7, "case {case}");
        assert_sound(&robot, &q, &found);
    }
}

#[test]
fn self_motions_are_named() {
    let mut random = Random(6);
    let ring = |radius: f64| -> [[f64; 3]; 6] {
        std::array::from_fn(|k| {
            let (s, c) = (k as f64 * PI / 3.0).sin_cos();
            [radius * c, radius * s, 0.0]
        })
    };
    for _ in 0..5 {
        let line = random_points(&mut random).map(|p| [p[0], 0.0, 0.0]);
        let base = random_points(&mut random);
        for robot in [hexapod(&ring(1.0), &ring(0.5)), hexapod(&base, &line)] {
            let q = robot.inverse(&random_pose(&mut random)).unwrap()[0].q.clone();
            let found = robot.direct(&q);
            assert!(matches!(found, Err(KinematicsError::SelfMotion { .. })), "{found:?}");
        }
    }
}

/// Moving the base, turning the platform's frame, scaling and renumbering legs do not change what there is.
#[test]
fn invariance() {
    let mut random = Random(7);
    for case in 0..20 {
        let (base, platform) = (random_points(&mut random), random_points(&mut random));
        let robot = hexapod(&base, &platform);
        let q = robot.inverse(&random_pose(&mut random)).unwrap()[0].q.clone();
        let count = robot.direct(&q).unwrap().len();
        let (turn, shift) = (rotation(&vector(&mut random)), Vector3::from(vector(&mut random)) * 50.0);
        let scale = 10f64.powf(random.within(-4.0, 4.0));
        let moved = |p: [f64; 3]| -> [f64; 3] { ((turn * Vector3::from(p) + shift) * scale).into() };
        let sized = |p: [f64; 3]| p.map(|x| x * scale);
        let mut other = hexapod(&base.map(moved), &platform.map(sized));
        let mut lengths: Vec<f64> = q.iter().map(|x| x * scale).collect();
        other.legs.rotate_left(case % 6);
        lengths.rotate_left(case % 6);
        let found = other.direct_certified(&lengths).unwrap();
        assert!(found.complete && found.solutions.len() == count, "case {case}");
        let swapped = hexapod(&platform, &base);
        assert_eq!(swapped.direct(&q).unwrap().len(), count, "case {case}: base and platform swapped");
    }
}

/// Struts at a pose where an instantaneous screw (v, w) changes the length of none, but for the gap.
fn singular(
    random: &mut Random,
    platform: &[[f64; 3]; 6],
    pose: &[f64],
    gap: f64,
) -> (Robot, [Vector3<f64>; 2]) {
    let [v, w] = [0; 2].map(|_| Vector3::from(vector(random)));
    let base = platform.map(|joint| {
        let arm = rotation(&pose[3..]) * Vector3::from(joint);
        let velocity = v + w.cross(&arm);
        let across = velocity.cross(&Vector3::from(vector(random)));
        let off = across + velocity * gap * random.within(-1.0, 1.0);
        (Vector3::from_row_slice(&pose[..3]) + arm - off).into()
    });
    (hexapod(&base, platform), [v, w])
}

/// Next to parallel singularities, where two solutions meet.
#[test]
fn near_double_solutions_are_not_lost() {
    let mut random = Random(8);
    let (mut lost, mut worst) = (0, 0.0f64);
    for case in 0..cases() {
        let platform = random_points(&mut random);
        let pose = random_pose(&mut random);
        let gap = [1e-2, 1e-4, 1e-6, 1e-8, 0.0][case as usize % 5];
        let (robot, _) = singular(&mut random, &platform, &pose, gap);
        let q = robot.inverse(&pose).unwrap()[0].q.clone();
        let found = robot.direct_certified(&q).unwrap();
        let off = nearest(&found, &pose);
        worst = worst.max(off);
        // √ε, more where the two part slowly.
        lost += usize::from(off > 1e-4);
    }
    assert_eq!(lost, 0, "worst {worst:e}");
}

/// Two solutions that are next to each other, neither of which may be taken for one that is not real: a list is complete with
/// both, or it is not said to be complete.
#[test]
fn neighbours_are_not_taken_for_conjugates() {
    let mut random = Random(9);
    let (mut complete, mut near) = (0, 0);
    for case in 0..4 * cases() {
        let mut platform = random_points(&mut random);
        let mut pose = random_pose(&mut random);
        if case % 4 == 3 {
            platform = platform.map(|p| [p[0], p[1], 0.0]);
        }
        let gap = 10f64.powf(random.within(-6.0, -3.5));
        let (robot, [v, w]) = singular(&mut random, &platform, &pose, 0.0);
        // A little along the screw, away from where the two meet.
        let turned = rotation_by(w * gap) * rotation(&pose[3..]);
        let at = Vector3::from_row_slice(&pose[..3]) + v * gap;
        let (roll, pitch, yaw) = nalgebra::Rotation3::from_matrix_unchecked(turned).euler_angles();
        pose = vec![at.x, at.y, at.z, roll, pitch, yaw];
        let q = robot.inverse(&pose).unwrap()[0].q.clone();
        let found = robot.direct_certified(&q).unwrap();
        near += usize::from(nearest(&found, &pose) < 1e-3 * gap);
        if found.complete {
            complete += 1;
            assert_eq!(found.solutions.len() % 2, 0, "case {case}, gap {gap:e}");
            assert!(nearest(&found, &pose) < 1e-3 * gap, "case {case}, gap {gap:e}");
        }
    }
    assert!(complete > 100 && near > 100, "{complete} complete, {near} found");
}

/// The rotation by a vector.
fn rotation_by(vector: Vector3<f64>) -> Matrix3<f64> {
    *nalgebra::Rotation3::from_scaled_axis(vector).matrix()
}

/// Lists that were said to be complete while one or both of two neighbours were missing.
#[test]
fn neighbours_that_were_lost() {
    let pair = |a: [f64; 3]| [a, a];
    let flat = |of: [[f64; 2]; 6]| of.map(|[x, y]| [x, y, 0.0]);
    let integers = |of: [[i32; 3]; 6]| of.map(|p| p.map(f64::from));
    let [one, two, three] = [
        [-0.857608918253518, -0.18387449680064694, 0.018994489082462707],
        [0.8216918210667927, 0.6180134010310303, -0.9583384749136745],
        [0.9778189056637774, 0.21167471725010278, -0.4754842931015486],
    ]
    .map(pair);
    let cases = [
        (
            [one[0], one[1], two[0], two[1], three[0], three[1]],
            [
                [-0.31782433060541737, 0.41101163853692535, -0.08017129988313254],
                [-0.9660076586717434, 0.013022533844551987, 0.683804848498307],
                [0.3922767793380635, 0.4264221331106892, 0.2117475949248937],
                [-0.6351398513747899, 0.8854630936506234, -0.6967983636938078],
                [0.6143676647630503, -0.3975471007592757, -0.11086868607369404],
                [-0.42311665889961736, 0.9764184379550396, -0.2546423351168936],
            ],
            [
                1.288638099541641,
                0.7216503507473452,
                1.675973923594228,
                2.115774471008073,
                0.8881163490899423,
                2.5042219937499812,
            ],
            [
                -0.4544622219465621,
                0.6779307510518991,
                -0.4800204422746858,
                0.026253844859931125,
                -0.5351137124045932,
                0.6008130885979803,
            ],
        ),
        (
            integers([[1, 0, -6], [9, 9, 8], [-2, -7, -5], [4, 9, -3], [-8, 1, -1], [1, -4, 1]]),
            integers([[4, 6, -3], [-1, 2, -4], [-4, -1, -6], [-4, -2, 2], [-2, 4, -2], [0, -5, 1]]),
            [
                18.16938515441418,
                11.304998887240528,
                17.152998108316343,
                22.35089816697002,
                16.883678731524252,
                9.438017897567818,
            ],
            [
                0.6705818428309495,
                -1.6008543614556001,
                11.833833743188945,
                0.6381705308210621,
                0.49249540049367735,
                -0.2640939726268277,
            ],
        ),
        (
            integers([[9, 4, -8], [9, -4, -8], [4, -7, -5], [4, 7, -5], [-5, -6, 0], [-5, 6, 0]]),
            integers([[-5, 5, 4], [-5, -5, 4], [5, 5, -4], [5, -5, -4], [-4, 0, -6], [-4, 0, -6]]),
            [
                22.678278793892748,
                23.412866598178166,
                13.717102589052823,
                17.08484812459754,
                6.439765299871145,
                6.623682834649702,
            ],
            [
                -1.7909587405630258,
                -1.5687860022064837,
                6.077366787687019,
                0.18718593253085455,
                -0.4201266520992073,
                -0.33994446029881326,
            ],
        ),
        (
            flat([
                [241.28, -42.54],
                [241.28, 42.54],
                [-83.79, 230.22],
                [-157.48, 187.68],
                [-157.48, -187.68],
                [-83.79, -230.22],
            ]),
            flat([
                [105.42, -79.44],
                [105.42, 79.44],
                [16.09, 131.02],
                [-121.51, 51.58],
                [-121.51, -51.58],
                [16.09, -131.02],
            ]),
            [
                224.19256820746955,
                178.78991086305726,
                306.08146883726533,
                333.44387929708336,
                306.86919804342466,
                180.1779795231813,
            ],
            [
                8.655793278838972,
                -5.7214537472886935,
                183.7693202514466,
                0.4570048504235849,
                0.7883183200718684,
                -0.2566942202054312,
            ],
        ),
    ];
    for (k, (base, platform, q, missing)) in cases.into_iter().enumerate() {
        let found = hexapod(&base, &platform).direct_certified(&q).unwrap();
        let off = nearest(&found, &missing);
        assert!(off < 1e-5, "case {k}: {off:e}, complete {}", found.complete);
        assert!(!found.complete || found.solutions.len() % 2 == 0, "case {k}");
    }
}

/// A spherical robot with unit vectors in the base and in the platform.
fn spherical(random: &mut Random) -> Robot {
    let mut robot = Robot::resolve("spherical-3-rrr").unwrap();
    for leg in &mut robot.legs {
        let u = Vector3::from(vector(random)).normalize();
        let v = u.cross(&Vector3::from(vector(random))).normalize();
        leg.frame = [u, v, u.cross(&v)].map(|axis| <[f64; 3]>::from(axis).map(Interval::point));
        let end = Vector3::from(vector(random)).normalize();
        leg.attachment = <[f64; 3]>::from(end).map(Interval::point);
        let (s, c) = random.within(0.4, 2.7).sin_cos();
        let distal = random.within(0.4, 2.7).cos();
        leg.actuator = Actuator::Spherical(Spherical {
            proximal: (Interval::point(c), Interval::point(s)),
            distal_cos: Interval::point(distal),
        });
    }
    robot
}

/// Orientations by brute force: R carries v₁ to the cone round w₁ (angle ψ) and turns about it (angle θ); the second leg gives θ from
/// ψ in closed form, and the sign changes of the third equation along ψ are counted.
fn sign_changes(robot: &Robot, q: &[f64], samples: usize) -> usize {
    let leg = |k: usize| {
        let leg = &robot.legs[k];
        let Actuator::Spherical(Spherical { proximal: (c, s), distal_cos }) = leg.actuator else {
            unreachable!()
        };
        let axis = |i: usize| Vector3::from(leg.frame[i].map(Interval::mid));
        let w = axis(2) * c.mid() + (axis(0) * q[k].cos() + axis(1) * q[k].sin()) * s.mid();
        (w, Vector3::from(leg.attachment.map(Interval::mid)), distal_cos.mid())
    };
    let [(w1, v1, c1), (w2, v2, c2), (w3, v3, c3)] = [leg(0), leg(1), leg(2)];
    let across = w1.cross(&Vector3::new(0.3, -0.5, 0.8)).normalize();
    let s1 = (1.0 - c1 * c1).sqrt();
    // (a cos θ + b sin θ + k) = w · R v for R = Rot(n, θ) R₀, R₀ v₁ = n.
    let residual = |psi: f64, branch: f64| -> Option<f64> {
        let n = w1 * c1 + (across * psi.cos() + w1.cross(&across) * psi.sin()) * s1;
        let first = nalgebra::Rotation3::rotation_between(&v1, &n)?;
        let parts = |w: Vector3<f64>, v: Vector3<f64>| {
            let x = first * v;
            let along = n * n.dot(&x);
            (w.dot(&(x - along)), w.dot(&n.cross(&x)), w.dot(&along))
        };
        let (a, b, k) = parts(w2, v2);
        let (rho, lag) = (a.hypot(b), b.atan2(a));
        let cosine = (c2 - k) / rho;
        let theta = (cosine.abs() <= 1.0).then(|| lag + branch * cosine.acos())?;
        let (a, b, k) = parts(w3, v3);
        Some(a * theta.cos() + b * theta.sin() + k - c3)
    };
    let mut count = 0;
    let at = |i: usize| (i as f64 + 0.37) / samples as f64 * TAU;
    for i in 0..samples {
        let ends = |branch: f64| [residual(at(i), branch), residual(at(i + 1), branch)];
        let of: Vec<_> = [1.0, -1.0].map(ends).into_iter().collect();
        for pair in &of {
            if let [Some(x), Some(y)] = pair {
                count += usize::from(x * y < 0.0);
            }
        }
        // Where the branches begin or end, they are one curve.
        let start = |pair: &[Option<f64>; 2]| if pair[0].is_none() { pair[1] } else { pair[0] };
        if of[0][0].is_none() != of[0][1].is_none()
            && let (Some(x), Some(y)) = (start(&of[0]), start(&of[1]))
        {
            count += usize::from(x * y < 0.0);
        }
    }
    count
}

#[test]
fn spherical_robots_against_brute_force() {
    let mut random = Random(9);
    let mut eights = 0;
    for case in 0..20 * cases() {
        let robot = spherical(&mut random);
        let angles = [random.within(-PI, PI), random.within(-1.5, 1.5), random.within(-PI, PI)];
        let Some(s) = robot.inverse(&angles).unwrap().first().cloned() else { continue };
        let found = robot.direct_certified(&s.q).unwrap();
        assert!(found.complete && nearest(&found, &angles) < 1e-7, "case {case}: {found:?}");
        assert_sound(&robot, &s.q, &found);
        eights += usize::from(found.solutions.len() == 8);
        if case >= cases() && found.solutions.len() < 8 {
            continue;
        }
        // Two solutions within a step are missed by the coarse count only.
        let count = found.solutions.len();
        let agrees = |samples: usize| sign_changes(&robot, &s.q, samples) == count;
        assert!(agrees(4000) || agrees(40_000), "case {case}: {count}");
    }
    assert!(eights > 0, "no spherical robot with 8 solutions among those tried");
}

/// The Agile Eye's four orientations that its motors do not change (Bonev, Chablat & Wenger 2006), and four others.
#[test]
fn the_agile_eye() {
    let robot = Robot::resolve("spherical-3-rrr").unwrap();
    let pose = [0.1, 0.2, 0.3];
    let q = robot.inverse(&pose).unwrap()[0].q.clone();
    let found = robot.direct_certified(&q).unwrap();
    assert_eq!((found.solutions.len(), found.complete), (8, true));
    assert!(nearest(&found, &pose) < 1e-12);
    let other: Vec<f64> = q.iter().map(|x| x + 0.05).collect();
    let moved = robot.direct_certified(&other).unwrap();
    let trivial = found.solutions.iter().filter(|s| nearest(&moved, &s.pose) < 1e-9).count();
    assert_eq!(trivial, 4);
}
