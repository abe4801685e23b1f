//! Planning within an aspect. Run `cargo bench -p aspecta --bench plan`.
//!
//! Random pairs of poses in one mode, those that can be joined; aspects and boxes are loaded.

use aspecta::Kinematics;
use aspecta::aspect::{Options, analyze};
use aspecta::kinematics::WorkingMode;
use aspecta::motion::explore::{self, Effort};
use aspecta::motion::modes::ModeGraph;
use aspecta::motion::plan::{PlanOptions, Planner};
use aspecta::paving::{Budget, Control};
use aspecta::robot::work::Stopwatch;
use aspecta::robot::{Robot, catalogue};
use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;

/// Pairs per robot.
const PAIRS: usize = 300;

/// A low-discrepancy sequence in [0, 1).
fn share(i: usize, k: usize) -> f64 {
    (i as f64 * [0.754_877_7, 0.569_840_3, 0.430_159_7][k % 3]).fract()
}

fn plan(c: &mut Criterion) {
    let find = |name: &str| catalogue::find(name).expect("a robot of the catalogue");
    let five_bar = &catalogue::all()[0].text;
    let disc = format!("{five_bar}\n[[obstacles]]\ncentre = [4.5, 0]\nradius = 1\n");
    let disc = Robot::from_toml(&disc, "disc.toml").expect("a robot file");
    let robots = [
        ("five-bar", find("five-bar"), "+-", 11),
        ("five-bar round a disc", disc, "+-", 11),
        ("3-rpr", find("3-rpr"), "---", 7),
        ("3-rrr", find("3-rrr"), "+++", 7),
    ];
    for (name, robot, mode, depth) in robots {
        let mode: WorkingMode = mode.parse().expect("a mode");
        let budget = Budget { depth: Some(depth), ..Budget::default() };
        let control = Control::unwatched();
        let options = Options { budget, modes: vec![mode], ..Options::default() };
        let analysis = analyze(&robot, &options, &control).expect("a bounded robot");
        let ranges = &analysis.window.ranges;
        let pose = |i: usize| -> Vec<f64> {
            ranges.iter().enumerate().map(|(k, r)| r.0 + share(i, k) * (r.1 - r.0)).collect()
        };
        let in_reach = |pose: &Vec<f64>| {
            let solutions = robot.inverse(pose).expect("a pose");
            solutions.iter().any(|s| s.mode == mode && s.within_limits)
        };
        let poses: Vec<Vec<f64>> = (1..).map(pose).filter(in_reach).take(2 * PAIRS).collect();
        let mut planner = Planner::new(&analysis);
        let mut times = Vec::new();
        let mut joined = Vec::new();
        for pair in poses.chunks(2) {
            let start = Stopwatch::start();
            if planner.plan(&pair[0], &pair[1], mode, &PlanOptions::default()).is_ok() {
                times.push(start.seconds() * 1e3);
                joined.push(pair);
            }
        }
        times.sort_by(f64::total_cmp);
        let at = |part: usize| times[(times.len() - 1) * part / 100];
        println!(
            "{name}: {} of {PAIRS} pairs planned; ms: median {:.2}, 90 % {:.2}",
            times.len(),
            at(50),
            at(90)
        );
        let mut i = 0;
        c.bench_function(&format!("{name}/plan, mean of pairs"), |b| {
            b.iter(|| {
                i = (i + 1) % joined.len();
                planner.plan(black_box(&joined[i][0]), &joined[i][1], mode, &PlanOptions::default()).is_ok()
            })
        });
    }
    let robot = catalogue::find("five-bar").expect("a robot of the catalogue");
    let budget = Budget { depth: Some(11), ..Budget::default() };
    let control = Control::unwatched();
    let analysis = analyze(&robot, &Options { budget, ..Options::default() }, &control).expect("bounded");
    c.bench_function("five-bar/graph of working-mode changes", |b| {
        b.iter(|| ModeGraph::new(&analysis, &Control::unwatched()))
    });
}

/// Random pairs of poses of Dietmaier's platform with one sign of det A, over a roadmap that is grown for each; and an exploration.
fn free_body(c: &mut Criterion) {
    let robot = catalogue::find("gough-stewart").expect("a robot of the catalogue");
    let mode = robot.working_modes()[0];
    let ranges = robot.workspace_window().expect("a bounded robot").ranges;
    let pose = |i: usize| -> Vec<f64> {
        let share = |k: usize| (share(i, k) + 0.37 * (k / 3) as f64).fract();
        ranges.iter().enumerate().map(|(k, r)| r.0 + share(k) * (r.1 - r.0)).collect()
    };
    let in_class = |pose: &Vec<f64>| {
        let solutions = robot.inverse(pose).expect("a pose");
        solutions.iter().any(|s| s.within_limits && s.det_a > 0.1)
    };
    let poses: Vec<Vec<f64>> = (1..).map(pose).filter(in_class).take(40).collect();
    let control = Control::unwatched();
    let effort = Effort { samples: 20_000, seconds: None };
    let mut i = 0;
    c.bench_function("gough-stewart/plan, mean of pairs", |b| {
        b.iter(|| {
            i = (i + 2) % poses.len();
            let ends = [&poses[i][..], black_box(&poses[i + 1])];
            explore::plan(&robot, ends, mode, &PlanOptions::default(), &effort, &control).is_ok()
        })
    });
    let effort = Effort { samples: 512, seconds: None };
    c.bench_function("gough-stewart/explore, 512 samples a class", |b| {
        b.iter(|| explore::explore(&robot, &[], &effort, &control).is_ok())
    });
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20);
    targets = plan, free_body
}
criterion_main!(benches);
