//! Basic regions of one aspect, and where a pose lies among them. Run `cargo bench --bench domains`.

use aspecta::aspect::{Analysis, AspectId, Options, analyze};
use aspecta::domain::{DomainOptions, Domains, Map, MappedAspect, domains};
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
            b.iter(|| domains(&analysis, AspectId::new(1), &options, &control));
        });
    }
    group.finish();
    let found = domains(&analysis, AspectId::new(1), &DomainOptions::default(), &control).expect("an aspect");
    c.bench_function("domains/region at a pose", |b| {
        b.iter(|| found.region_at(&analysis, black_box(&[-15.468, 0.781, 0.073])));
    });
    locate(c, &analysis, found);
}

/// A pose at a time, near surfaces or not, after a journey through the file.
fn locate(c: &mut Criterion, analysis: &Analysis, found: Domains) {
    let mode = found.mode;
    let grid = found.labels.grid.clone();
    let map = Map::new(analysis, vec![MappedAspect { domains: found, surfaces: None }]);
    let file = map.to_bytes().expect("a file");
    c.bench_function("locate/load", |b| b.iter(|| Map::from_bytes(black_box(&file))));
    let map = Map::from_bytes(&file).expect("a map");
    let nodes = |every: usize| (0..grid.len()).step_by(every).map(|node| grid.pose(node)[..3].to_vec());
    let some: Vec<_> = nodes(9973).collect();
    let mut poses = some.iter().cycle();
    c.bench_function("locate/anywhere", |b| {
        b.iter(|| poses.next().map(|pose| map.locate(black_box(pose), mode)))
    });
    let inside = |pose: &Vec<f64>| map.locate(pose, mode).is_ok_and(|l| l.region.is_some());
    let within: Vec<_> = nodes(997).filter(inside).collect();
    let mut poses = within.iter().cycle();
    c.bench_function("locate/in the aspect", |b| {
        b.iter(|| poses.next().map(|pose| map.locate(black_box(pose), mode)))
    });
    for (name, pose) in
        [("in a region", [-15.468, 0.781, 0.073]), ("near a surface", [-9.902, -7.091, 1.081])]
    {
        c.bench_function(&format!("locate/{name}"), |b| b.iter(|| map.locate(black_box(&pose), mode)));
    }
}

criterion_group!(benches, partition);
criterion_main!(benches);
