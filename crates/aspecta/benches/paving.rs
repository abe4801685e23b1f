//! Boxes per second of the paving, and whole analyses.

use aspecta::aspect::{Options, analyze};
use aspecta::paving::{Budget, Control, Paving};
use aspecta::robot::{Robot, catalogue};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use std::sync::atomic::AtomicBool;
use std::time::Duration;

fn robot(name: &str) -> Robot {
    catalogue::find(name).expect("a robot of the catalogue")
}

fn paving(c: &mut Criterion) {
    let never = AtomicBool::new(false);
    let control = Control { cancelled: &never, progress: &|_| {} };
    let mut group = c.benchmark_group("paving");
    group.sample_size(10).measurement_time(Duration::from_secs(10));
    for (name, depth) in [("five-bar", 10), ("3-rrr", 6), ("3-rpr", 6), ("delta", 6)] {
        let robot = robot(name);
        let window = robot.workspace_window().expect("a bounded robot");
        let budget = Budget { depth: Some(depth), ..Budget::default() };
        let pave = || Paving::new(&robot, &window, &robot.working_modes(), &budget, &control);
        group.throughput(Throughput::Elements(pave().boxes));
        group.bench_function(format!("{name}, depth {depth}"), |b| b.iter(pave));
    }
    group.finish();
}

fn analysis(c: &mut Criterion) {
    let never = AtomicBool::new(false);
    let control = Control { cancelled: &never, progress: &|_| {} };
    let mut group = c.benchmark_group("analysis");
    group.sample_size(10).measurement_time(Duration::from_secs(20));
    for name in ["five-bar", "3-rrr"] {
        let robot = robot(name);
        group.bench_function(name, |b| b.iter(|| analyze(&robot, &Options::default(), &control)));
    }
    group.finish();
}

criterion_group!(benches, paving, analysis);
criterion_main!(benches);
