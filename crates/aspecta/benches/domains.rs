//! Basic regions of one aspect, and where a pose lies among them. Run `cargo bench --bench domains`.

use aspecta::aspect::{Options, analyze};
use aspecta::domain::{DomainOptions, domains};
use aspecta::paving::{Budget, Control};
use aspecta::robot::catalogue;
use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

fn partition(c: &mut Criterion) {
    let never = AtomicBool::new(false);
    let control = Control { cancelled: &never, progress: &|_| {} };
    let robot = catalogue::find("3-rrr").expect("a robot of the catalogue");
    let budget = Budget { depth: Some(6), ..Budget::default() };
    let analysis =
        analyze(&robot, &Options { budget, ..Options::default() }, &control).expect("a bounded robot");
    let mut group = c.benchmark_group("domains");
    group.sample_size(10).measurement_time(Duration::from_secs(60));
    for cells in [100, 200] {
        let options = DomainOptions { cells, ..DomainOptions::default() };
        group.bench_function(format!("3-rrr, aspect 1, 1/{cells}"), |b| {
            b.iter(|| domains(&analysis, 1, options, &control));
        });
    }
    group.finish();
    let found = domains(&analysis, 1, DomainOptions::default(), &control).expect("an aspect");
    c.bench_function("domains/region at a pose", |b| {
        b.iter(|| found.region_at(&analysis, black_box(&[-15.468, 0.781, 0.073])));
    });
}

criterion_group!(benches, partition);
criterion_main!(benches);
