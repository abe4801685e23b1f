//! Boxes per second of the paving, whole analyses, and the check of their certificates.

use aspecta::aspect::{Options, analyze};
use aspecta::paving::{Budget, Control, Paving};
use aspecta::robot::{Robot, catalogue};
use aspecta::verify::verify;
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

fn verification(c: &mut Criterion) {
    let never = AtomicBool::new(false);
    let control = Control { cancelled: &never, progress: &|_| {} };
    let mut group = c.benchmark_group("verify");
    group.sample_size(10).measurement_time(Duration::from_secs(20));
    let slice = vec![(2, 0.8), (3, 0.1), (4, 0.0), (5, 0.0)];
    for (name, fix) in [("five-bar", vec![]), ("gough-stewart", slice)] {
        let options = Options { fix, certificate: true, ..Options::default() };
        let analysis = analyze(&robot(name), &options, &control).expect("an analysis");
        let certificate = analysis.certificate.expect("a certificate that was asked for");
        group.bench_function(name, |b| b.iter(|| verify(&certificate, &control)));
    }
    group.finish();
}

criterion_group!(benches, paving, analysis, verification);
criterion_main!(benches);
