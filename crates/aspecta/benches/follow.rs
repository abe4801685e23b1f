//! A certified step of a control loop. Run `cargo bench -p aspecta --bench follow`.
//!
//! The robot goes round a closed path of 4000 steps, a few seconds of motion at 1 kHz.

use aspecta::kinematics::WorkingMode;
use aspecta::motion::follow::{Follower, InverseFollower};
use aspecta::robot::{Robot, catalogue};
use criterion::{Criterion, criterion_group, criterion_main};
use std::f64::consts::TAU;
use std::hint::black_box;

const STEPS: usize = 4000;

/// A robot, its mode, the middle of a path, and the path's amplitude: of lengths, of angles (rad).
fn cases() -> [(&'static str, &'static str, Vec<f64>, [f64; 2]); 6] {
    [
        ("five-bar", "++", vec![4.0, 7.0], [0.8, 0.0]),
        ("3-rrr", "+++", vec![-14.0, -5.0, 0.5], [0.4, 0.05]),
        ("3-rpr", "---", vec![5.0, 15.0, -1.2], [0.4, 0.05]),
        ("delta", "---", vec![50.0, 20.0, -900.0], [80.0, 0.0]),
        ("gough-stewart", "------", vec![0.2, 0.1, 0.9, 0.1, 0.05, -0.1], [0.01, 0.01]),
        ("hexa", "------", vec![20.0, 10.0, -650.0, 0.1, 0.05, -0.1], [30.0, 0.1]),
    ]
}

fn path(robot: &Robot, middle: &[f64], size: [f64; 2]) -> Vec<Vec<f64>> {
    let coordinates = robot.platform.coordinates();
    let coordinate = |k: usize, t: f64| {
        middle[k] + size[usize::from(coordinates[k].angle)] * (t * (k % 3 + 1) as f64 + k as f64).sin()
    };
    let times = (0..STEPS).map(|i| TAU * i as f64 / STEPS as f64);
    times.map(|t| (0..middle.len()).map(|k| coordinate(k, t)).collect()).collect()
}

fn follow(c: &mut Criterion) {
    for (name, mode, middle, size) in cases() {
        let robot = catalogue::find(name).expect("a robot of the catalogue");
        let mode: WorkingMode = mode.parse().expect("a mode");
        let poses = path(&robot, &middle, size);
        let mut inverse = InverseFollower::new(&robot, &poses[0], mode).expect("a start");
        let joints: Vec<Vec<f64>> =
            poses.iter().map(|x| inverse.step(x).expect("a path in reach").q().to_vec()).collect();
        let mut direct = Follower::new(&robot, &poses[0], &joints[0]).expect("a start");
        let alone = joints.iter().filter(|q| direct.step(q).expect("a regular path").stretches == 1).count();
        println!("{name}: {alone} of {STEPS} steps proved in one stretch");
        let mut i = STEPS - 1;
        c.bench_function(&format!("{name}/step"), |b| {
            b.iter(|| {
                i = (i + 1) % STEPS;
                direct.step(black_box(&joints[i])).expect("a path without singularities")
            })
        });
        // The dearest: a jump that is tried in all stretches and refused.
        let jump: Vec<f64> =
            joints[0].iter().enumerate().map(|(k, q)| q * (1.0 + 0.3 * (k as f64 - 0.7))).collect();
        if direct.step(&jump).is_err() {
            c.bench_function(&format!("{name}/refused jump"), |b| b.iter(|| direct.step(black_box(&jump))));
        }
        let mut i = STEPS - 1;
        let mut inverse = InverseFollower::new(&robot, &poses[0], mode).expect("a start");
        c.bench_function(&format!("{name}/inverse step"), |b| {
            b.iter(|| {
                i = (i + 1) % STEPS;
                inverse.step(black_box(&poses[i])).expect("a path in reach")
            })
        });
    }
}

criterion_group!(benches, follow);
criterion_main!(benches);
