//! Following a solution: never a wrong branch, a refusal rather than a guess.

mod inverse;
mod paths;
mod refusals;

use crate::random::Random;
use aspecta::Kinematics;
use aspecta::kinematics::WorkingMode;
use aspecta::motion::follow::{Follower, InverseFollower};
use aspecta::robot::{Platform, Robot, catalogue};
use std::f64::consts::TAU;

/// A robot of the catalogue.
pub fn robot(name: &str) -> Robot {
    catalogue::find(name).expect("a robot of the catalogue")
}

/// A closed path of poses that a random trigonometric polynomial of degree 3 describes, round `middle`.
pub fn closed_path(
    robot: &Robot,
    middle: &[f64],
    size: f64,
    steps: usize,
    random: &mut Random,
) -> Vec<Vec<f64>> {
    let length = robot.legs.iter().map(|l| l.actuator.size()).fold(robot.characteristic_length(), f64::max);
    let coordinates = robot.platform.coordinates();
    let waves: Vec<_> = coordinates
        .iter()
        .flat_map(|c| {
            (1..=3).map(|k| (k as f64, if c.angle { size } else { size * length })).collect::<Vec<_>>()
        })
        .map(|(k, amplitude)| (k, amplitude * random.within(-0.5, 0.5), random.within(0.0, TAU)))
        .collect();
    let coordinate = |i: usize, t: f64| {
        let sum: f64 = waves[3 * i..3 * i + 3].iter().map(|(k, a, phase)| a * (k * t + phase).sin()).sum();
        middle[i] + sum
    };
    let times = (0..=steps).map(|j| TAU * j as f64 / steps as f64);
    times.map(|t| (0..middle.len()).map(|i| coordinate(i, t)).collect()).collect()
}

/// A random pose in reach, and a random mode.
pub fn start(robot: &Robot, random: &mut Random) -> (Vec<f64>, WorkingMode) {
    let window = robot.workspace_window().expect("a bounded robot");
    loop {
        let pose: Vec<f64> = window.ranges.iter().map(|(lo, hi)| random.within(*lo, *hi)).collect();
        let solutions = robot.inverse(&pose).unwrap();
        if !solutions.is_empty() {
            return (pose, solutions[random.below(solutions.len())].mode);
        }
    }
}

/// The joint vectors of a path that is proved to stay in one aspect, or `None`.
pub fn joints_in_one_aspect(robot: &Robot, poses: &[Vec<f64>], mode: WorkingMode) -> Option<Vec<Vec<f64>>> {
    let mut follower = InverseFollower::new(robot, &poses[0], mode).ok()?;
    let joints = poses.iter().map(|pose| {
        let step = follower.step(pose).ok()?;
        step.regular.then(|| step.q().to_vec())
    });
    joints.collect()
}

/// The greatest difference of two poses: lengths relative to the robot's, rotations by their matrices.
pub fn apart(robot: &Robot, a: &[f64], b: &[f64]) -> f64 {
    let length = robot.characteristic_length();
    let coordinates = robot.platform.coordinates();
    let lengths = (0..a.len()).filter(|k| !coordinates[*k].angle).map(|k| (a[k] - b[k]).abs() / length);
    let turns = match robot.platform {
        Platform::PlaneBody => vec![((a[2] - b[2]) / 2.0).sin().abs() * 2.0],
        Platform::TurningBody | Platform::FreeBody => {
            let (r, s) = (rotation(&a[a.len() - 3..]), rotation(&b[b.len() - 3..]));
            (0..9).map(|k| (r[k / 3][k % 3] - s[k / 3][k % 3]).abs()).collect()
        }
        _ => vec![],
    };
    lengths.chain(turns).fold(0.0, f64::max)
}

/// R_z(yaw) R_y(pitch) R_x(roll).
fn rotation(angles: &[f64]) -> [[f64; 3]; 3] {
    let about = |k: usize, angle: f64| {
        let (s, c) = angle.sin_cos();
        let mut m = [[0.0; 3]; 3];
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        (m[k][k], m[i][i], m[i][j], m[j][i], m[j][j]) = (1.0, c, -s, s, c);
        m
    };
    let times = |a: [[f64; 3]; 3], b: [[f64; 3]; 3]| -> [[f64; 3]; 3] {
        std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum()))
    };
    times(about(2, angles[2]), times(about(1, angles[1]), about(0, angles[0])))
}

/// A follower at the pose's configuration in the mode.
pub fn follower(robot: &Robot, pose: &[f64], mode: &str) -> Follower {
    let q = robot.inverse_in(pose, mode.parse().unwrap()).unwrap().expect("in reach");
    Follower::new(robot, pose, &q).unwrap()
}
