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
