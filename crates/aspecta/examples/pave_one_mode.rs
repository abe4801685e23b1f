//! Paves one working mode of the paper's five-bar and prints what `benches/peers` compares, as JSON:
//! `cargo run --release -p aspecta --example pave_one_mode -- ++ 9 20` (mode, depth, repetitions; these if none are given).

use aspecta::Kinematics;
use aspecta::kinematics::{KinematicsError, WorkingMode};
use aspecta::paving::{Budget, Control, Mark, Paving, Shares};
use aspecta::robot::Robot;
use aspecta::robot::work::Stopwatch;
use serde_json::json;
use std::error::Error;
use std::sync::atomic::AtomicBool;

/// Class bit of det A > 0 of the only mode paved.
const DET_A_POSITIVE: u16 = 1;
/// Poses along each side of the window at which the sign of det A is printed.
const SAMPLES: usize = 40;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let usual = ["++", "9", "20"].map(String::from);
    let [mode, depth, repetitions] = (if arguments.is_empty() { &usual[..] } else { &arguments }) else {
        return Err("usage: pave_one_mode [MODE DEPTH REPETITIONS]".into());
    };
    let mode: WorkingMode = mode.parse()?;
    let robot = Robot::resolve("five-bar")?;
    let window = robot.workspace_window()?;
    let budget = Budget { depth: Some(depth.parse()?), ..Budget::default() };
    let control = Control { cancelled: &AtomicBool::new(false), progress: &|_| {} };
    let pave = || {
        let start = Stopwatch::start();
        let paving = Paving::new(&robot, &window, &[mode], &budget, &control);
        let mut shares = Shares::default();
        shares.update(&paving, &robot);
        (start.seconds(), paving, shares)
    };
    let (mut seconds, paving, shares) = pave();
    for _ in 1..repetitions.parse::<usize>()? {
        seconds = seconds.min(pave().0);
    }
    let (certified, undecided) = areas(&paving, &shares);
    let report = json!({
        "seconds": seconds, "boxes": paving.boxes, "depth": paving.depth, "window": window.ranges,
        "certified": certified, "undecided": undecided, "samples": samples(&robot, mode, &window.ranges)?,
    });
    println!("{report}");
    Ok(())
}

/// The area proved to be inside the set det A > 0, and that of which neither is proved.
fn areas(paving: &Paving, shares: &Shares) -> (f64, f64) {
    let (mut certified, mut undecided) = (0.0, 0.0);
    paving.boxes_of(&|node| node.of_classes(DET_A_POSITIVE), &mut |at| {
        let area = paving.measure(paving.depth_of(at));
        match paving.nodes[at as usize].of_classes(DET_A_POSITIVE) {
            Mark::Inside => certified += area,
            _ => undecided += area,
        }
    });
    for &(node, share) in shares.of(0) {
        let [inside, outside] = share.of(paving.measure(paving.depth_of(node)));
        certified += inside;
        undecided -= inside + outside;
    }
    (certified, undecided)
}

/// Poses (x, y) on a lattice in the window, with the sign of det A in `mode`; 0 where the mode does not exist.
fn samples(
    robot: &Robot,
    mode: WorkingMode,
    ranges: &[(f64, f64)],
) -> Result<Vec<(f64, f64, i8)>, KinematicsError> {
    let at = |k: usize, i: usize| {
        let (lo, hi) = ranges[k];
        lo + (hi - lo) * (i as f64 + 0.5) / SAMPLES as f64
    };
    let mut samples = Vec::new();
    for (i, j) in (0..SAMPLES).flat_map(|i| (0..SAMPLES).map(move |j| (i, j))) {
        let pose = [at(0, i), at(1, j)];
        let sign = match robot.inverse_in(&pose, mode)? {
            Some(q) => robot.jacobians(&pose, &q)?.det_a().signum() as i8,
            None => 0,
        };
        samples.push((pose[0], pose[1], sign));
    }
    Ok(samples)
}
