//! Platforms as they are built, symmetric or with joints in common: they have fewer than forty solutions, and the list is complete.
//!
//! `ASPECTA_CASES` sets the number of random platforms of each kind (12 by default) and, times 100, that of Newton starts.

use crate::catalogue::newton;
use crate::random::Random;
use crate::spatial::{assert_sound, hexapod, nearest, random_pose, vector};
use aspecta::Kinematics;
use aspecta::robot::Robot;
use nalgebra::Vector6;
use std::f64::consts::PI;

type Points = [[f64; 3]; 6];

fn cases() -> u64 {
    std::env::var("ASPECTA_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(12)
}

fn turned([x, y, z]: [f64; 3], angle: f64) -> [f64; 3] {
    let (s, c) = angle.sin_cos();
    [c * x - s * y, s * x + c * y, z]
}

/// Six points, the images of some random ones under one motion after the other.
fn orbit<const K: usize>(random: &mut Random, flat: bool, motions: [fn([f64; 3]) -> [f64; 3]; K]) -> Points {
    let mut points = Vec::new();
    while points.len() < 6 {
        let [x, y, z] = vector(random);
        points.extend(motions.map(|motion| motion([x, y, if flat { 0.0 } else { z }])));
    }
    points.try_into().unwrap()
}

fn mirrored([x, y, z]: [f64; 3]) -> [f64; 3] {
    [x, -y, z]
}

fn opposite(p: [f64; 3]) -> [f64; 3] {
    p.map(|x| -x)
}

fn half_turned(p: [f64; 3]) -> [f64; 3] {
    [-p[0], -p[1], p[2]]
}

fn third(p: [f64; 3]) -> [f64; 3] {
    turned(p, 2.0 * PI / 3.0)
}

fn same(p: [f64; 3]) -> [f64; 3] {
    p
}

/// On a circle at angles to either side of three axes.
fn semi_regular(radius: f64, half: f64) -> Points {
    std::array::from_fn(|k| {
        let side = if k % 2 == 0 { -half } else { half };
        turned([radius, 0.0, 0.0], 2.0 * PI / 3.0 * (k / 2) as f64 + side)
    })
}

/// Each joint twice: legs 2k and 2k + 1 share it, or with a shift 2k + 1 and 2k + 2.
fn in_pairs(mut points: Points, shift: usize, pairs: usize) -> Points {
    (0..pairs).for_each(|k| points[(2 * k + 1 + shift) % 6] = points[2 * k + shift]);
    points
}

/// Of each kind of platform a random one.
fn kinds(random: &mut Random) -> Vec<(&'static str, Points, Points)> {
    let mut both = |flat, motions: [fn([f64; 3]) -> [f64; 3]; 2]| {
        (orbit(random, flat, motions), orbit(random, flat, motions))
    };
    let (plane, other_plane) = both(true, [same, mirrored]);
    let (space, other_space) = both(false, [same, mirrored]);
    let (half, other_half) = both(true, [same, half_turned]);
    let (point, other_point) = both(false, [same, opposite]);
    let threes = [same, third, |p| third(third(p))];
    let [three, other_three] = [0; 2].map(|_| orbit(random, true, threes));
    let mut angles = || [0; 2].map(|_| random.within(0.1, 0.9));
    let (regular, other_regular) = (angles(), angles());
    let ring = |random: &mut Random| -> Points {
        std::array::from_fn(|_| turned([1.0, 0.0, 0.0], random.within(-PI, PI)))
    };
    let (circle, other_circle) = (ring(random), ring(random));
    let any = |random: &mut Random| orbit(random, false, [same]);
    let [a, b, c, d, e, f] = [0; 6].map(|_| any(random));
    vec![
        ("a plane of symmetry, flat", plane, other_plane),
        ("a plane of symmetry", space, other_space),
        ("half a turn, flat", half, other_half),
        ("point symmetry", point, other_point),
        ("a third of a turn", three, other_three),
        (
            "three planes of symmetry",
            semi_regular(1.0 + regular[1], regular[0]),
            semi_regular(0.5 + other_regular[1], 0.05 + other_regular[0]),
        ),
        ("on two circles", circle, other_circle),
        ("three pairs at the base", in_pairs(a, 0, 3), b),
        ("three pairs at the platform", c, in_pairs(d, 0, 3)),
        ("three pairs at both", in_pairs(e, 1, 3), in_pairs(f, 0, 3)),
        ("two pairs", in_pairs(b, 0, 2), c),
    ]
}

/// The pose is among the solutions, and all others are proved too.
fn assert_complete(name: &str, robot: &Robot, pose: &[f64]) -> Vec<f64> {
    let q = robot.inverse(pose).unwrap()[0].q.clone();
    let found = robot.direct_certified(&q).unwrap();
    assert!(found.complete, "{name}: {} solutions", found.solutions.len());
    assert!(nearest(&found, pose) < 1e-7, "{name}: {:e}", nearest(&found, pose));
    assert_sound(robot, &q, &found);
    q
}

#[test]
fn lists_of_special_platforms_are_complete() {
    let mut random = Random(41);
    for _ in 0..cases() {
        for (name, base, platform) in kinds(&mut random) {
            assert_complete(name, &hexapod(&base, &platform), &random_pose(&mut random));
        }
    }
}

/// Whatever Newton's method finds from random starts is in the list.
#[test]
fn no_start_finds_another_solution() {
    let mut random = Random(42);
    for (name, base, platform) in kinds(&mut random) {
        let robot = hexapod(&base, &platform);
        let q = assert_complete(name, &robot, &random_pose(&mut random));
        let found = robot.direct_certified(&q).unwrap();
        let wanted = Vector6::from_column_slice(&q);
        let mut came = 0;
        for _ in 0..100 * cases() {
            let start = random_pose(&mut random).into_iter().map(|x| 1.5 * x);
            let Some(pose) = newton(&robot, Vector6::from_iterator(start), &wanted) else { continue };
            came += 1;
            assert!(nearest(&found, pose.as_slice()) < 1e-5, "{name}: {pose}");
        }
        assert!(came > 50, "{name}: {came} starts came to a solution");
    }
}

/// Joints a little off: the points at infinity are not quite there, and the list is complete all the same, or not said to be.
#[test]
fn slightly_asymmetric_platforms_lose_nothing() {
    let mut random = Random(43);
    let mut complete = 0;
    for case in 0..12 {
        let off = 10f64.powi(-3 - case);
        for (name, mut base, platform) in kinds(&mut random) {
            base.iter_mut().flatten().for_each(|x| *x += off * random.within(-1.0, 1.0));
            let robot = hexapod(&base, &platform);
            let pose = random_pose(&mut random);
            let q = robot.inverse(&pose).unwrap()[0].q.clone();
            let found = robot.direct_certified(&q).unwrap();
            assert!(nearest(&found, &pose) < 1e-6, "{name}, {off:e}: {:e}", nearest(&found, &pose));
            assert!(found.solutions.len() <= 40);
            complete += usize::from(found.complete);
        }
    }
    assert!(complete > 90, "{complete} of 132");
}
