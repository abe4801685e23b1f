//! Planning: every path is sound, every refusal is explained.

use aspecta::aspect::{Analysis, Options, analyze};
use aspecta::kinematics::WorkingMode;
use aspecta::motion::check_path;
use aspecta::motion::plan::{Plan, PlanOptions, Planner};
use aspecta::paving::{Budget, Control};
use aspecta::robot::{Robot, catalogue};
use std::sync::atomic::AtomicBool;
use std::time::Instant;

static NEVER: AtomicBool = AtomicBool::new(false);

fn analysed(robot: &Robot, depth: u32, modes: &[&str]) -> Analysis {
    let budget = Budget { depth: Some(depth), ..Budget::default() };
    let modes = modes.iter().map(|mode| mode.parse().unwrap()).collect();
    let control = Control { cancelled: &NEVER, progress: &|_| {} };
    analyze(robot, &Options { budget, modes, ..Options::default() }, &control).unwrap()
}

/// SplitMix64 (Steele, Lea, Flood 2014), uniform in [0, 1).
struct Random(u64);

impl Random {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn pose(&mut self, analysis: &Analysis, mode: WorkingMode) -> Vec<f64> {
        loop {
            let pose: Vec<f64> =
                analysis.window.ranges.iter().map(|r| r.0 + self.uniform() * (r.1 - r.0)).collect();
            if let Ok(Some(_)) = analysis.robot.inverse_in(&pose, mode) {
                return pose;
            }
        }
    }
}

fn assert_sound(robot: &Robot, plan: &Plan) {
    let check = check_path(robot, &plan.waypoints, plan.mode).unwrap();
    assert_eq!(check.singularity_free, Some(true), "{plan:?}");
    assert_eq!(check.within_limits, Some(true), "{plan:?}");
}

/// Random pairs in one mode: how many were planned, proved apart, undecided; and the median time in ms.
fn pairs(name: &str, depth: u32, mode: &str, count: usize) -> ([usize; 3], f64) {
    let robot = catalogue::find(name).unwrap();
    let analysis = analysed(&robot, depth, &[mode]);
    let mode = mode.parse().unwrap();
    let mut planner = Planner::new(&analysis);
    let mut random = Random(7);
    let (mut times, mut seen) = (Vec::new(), [0; 3]);
    for _ in 0..count {
        let ends = [random.pose(&analysis, mode), random.pose(&analysis, mode)];
        let start = Instant::now();
        let plan = planner.plan(mode, &ends[0], &ends[1], &PlanOptions::default());
        let time = start.elapsed().as_secs_f64() * 1e3;
        match plan {
            Ok(plan) => {
                seen[0] += 1;
                times.push(time);
                assert_sound(&robot, &plan);
            }
            Err(refusal) if refusal.is_proof() => seen[1] += 1,
            Err(refusal) => {
                println!("{name} {ends:?}: {refusal}");
                seen[2] += 1;
            }
        }
    }
    times.sort_by(f64::total_cmp);
    (seen, times[times.len() / 2])
}

#[test]
fn random_pairs() {
    for (name, depth, mode) in
        [("five-bar", 10, "+-"), ("3-rpr", 7, "---"), ("3-rrr", 7, "+++"), ("irb-360", 6, "---")]
    {
        println!("{name} {:?}", pairs(name, depth, mode, 100));
    }
}

/// The least |det Â| and the least |B_jj| / max along a path: sampled.
fn least(robot: &Robot, plan: &Plan) -> [f64; 2] {
    let mut least = [f64::INFINITY; 2];
    for ends in plan.waypoints.windows(2) {
        for i in 0..=200 {
            let t = f64::from(i) / 200.0;
            let pose: Vec<f64> = ends[0].iter().zip(&ends[1]).map(|(a, b)| a + t * (b - a)).collect();
            let q = robot.inverse_in(&pose, plan.mode).unwrap().unwrap();
            let state = robot.state(&pose, &q).unwrap();
            least[0] = least[0].min(state.det_a.abs());
            least[1] = state.serial_measures.iter().copied().fold(least[1], f64::min);
        }
    }
    least
}

#[test]
fn table_4() {
    let robot = catalogue::find("3-rrr").unwrap();
    let start = Instant::now();
    let analysis = analysed(&robot, 7, &["+++"]);
    println!("{:?}", start.elapsed());
    let mut planner = Planner::new(&analysis);
    let mode = "+++".parse().unwrap();
    let points = [[-15.468, 0.781, 0.073], [-15.468, -7.091, 0.500], [-9.902, -7.091, 1.081]];
    let table = Plan {
        waypoints: points.map(|p| p.to_vec()).to_vec(),
        ..planner.plan(mode, &points[0], &points[2], &PlanOptions::default()).unwrap()
    };
    println!("table {:?}", least(&robot, &table));
    for weight in [0.0, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0] {
        let start = Instant::now();
        let plan = planner
            .plan(mode, &points[0], &points[2], &PlanOptions { weight, ..PlanOptions::default() })
            .unwrap();
        println!(
            "{weight} {:?} {:.2} {:?} {:?}",
            least(&robot, &plan),
            plan.length,
            start.elapsed(),
            plan.waypoints
        );
        assert_sound(&robot, &plan);
    }
}
#[test]
fn rpr() {
    let robot = catalogue::find("3-rpr").unwrap();
    let start = Instant::now();
    let analysis = analysed(&robot, 7, &[]);
    println!("{:?}", start.elapsed());
    let mut planner = Planner::new(&analysis);
    let mode = "---".parse().unwrap();
    let all = robot.direct(&[14.98, 15.38, 12.0]).unwrap();
    for a in all.iter() {
        for b in all.iter() {
            let start = Instant::now();
            let plan =
                planner.plan(mode, &a.pose, &b.pose, &PlanOptions { weight: 1.0, ..PlanOptions::default() });
            match plan {
                Ok(plan) => println!(
                    "{:?} {:.2} {:?} {:?}",
                    least(&robot, &plan),
                    plan.length,
                    start.elapsed(),
                    plan.waypoints
                ),
                Err(e) => println!("{e}"),
            };
        }
    }
}

#[test]
fn modes_of_the_five_bar() {
    for (name, depth) in [
        ("five-bar", 11),
        ("symmetric-five-bar", 11),
        ("2-prr", 11),
        ("irb-360", 6),
        ("delta", 6),
        ("3-rrr", 6),
    ] {
        let robot = catalogue::find(name).unwrap();
        let start = Instant::now();
        let analysis = analysed(&robot, depth, &[]);
        println!("{name} {:?}", start.elapsed());
        let start = Instant::now();
        let graph = aspecta::motion::modes::ModeGraph::new(&analysis);
        println!("{:?} {:?}", start.elapsed(), graph.groups);
        for c in &graph.crossings {
            println!("{:?} {} {:.4} {:?} {:?}", c.aspects, c.leg, c.clearance, c.pose, c.inside);
        }
    }
}
