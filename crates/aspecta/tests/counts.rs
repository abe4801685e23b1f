//! Certified numbers of aspects: known ones, those of a robot seen in other ways, those of random robots against brute force.

#[path = "random/split_mix.rs"]
mod split_mix;
mod sweep;

use aspecta::aspect::{Analysis, AnalysisError, DetSign, DoubtKind, Options, analyze};
use aspecta::kinematics::WorkingMode;
use aspecta::paving::{Budget, Control};
use aspecta::robot::{Leg, Platform, Robot, SliceError, catalogue};
use aspecta::verify::verify;
use split_mix::Random;
use std::sync::atomic::AtomicBool;
use std::time::Instant;
use sweep::{Finesse, FiveBar, MODES, Table};

static NEVER: AtomicBool = AtomicBool::new(false);

fn watched() -> Control<'static> {
    Control { cancelled: &NEVER, progress: &|_| () }
}

fn analyzed(robot: &Robot, options: &Options) -> Analysis {
    analyze(robot, options, &watched()).unwrap()
}

fn find(name: &str) -> Robot {
    catalogue::find(name).unwrap()
}

fn as_signs(mode: WorkingMode) -> [i8; 2] {
    [0, 1].map(|j| mode.sign(j))
}

/// The certified numbers of a five-bar's classes.
fn certified(analysis: &Analysis) -> Table {
    assert!(analysis.aspects.certified, "{:?} {:?}", analysis.aspects, analysis.doubts);
    assert!(analysis.doubts.is_empty());
    let entry = |c: &aspecta::aspect::AspectClass| {
        assert_eq!(c.high, Some(c.low));
        ((as_signs(c.mode), c.det_a.factor()), c.low)
    };
    analysis.classes.iter().map(entry).collect()
}

// Random five-bars.

fn five_bar(&FiveBar { links, base, .. }: &FiveBar) -> Robot {
    let leg = |k: usize| Leg::revolute([base * k as f64, 0.0], [0.0, 0.0], links[k][0], links[k][1]);
    Robot::new("five-bar", Platform::PlanePoint, vec![leg(0), leg(1)]).unwrap()
}

/// Five-bar number `seed`: every tenth has L = M in leg 1, leg 2 or both, every twentieth has integer lengths.
fn random_five_bar(seed: u64) -> FiveBar {
    let mut random = Random(seed);
    let mut length = |lo: usize, hi: usize| match seed % 20 {
        7 => (lo + random.below(hi - lo + 1)) as f64,
        _ => random.within(lo as f64, hi as f64),
    };
    let mut links = [[length(1, 10), length(1, 10)], [length(1, 10), length(1, 10)]];
    let base = length(1, 12);
    if seed % 10 == 3 {
        for j in 0..2 {
            if seed / 10 % 3 != 1 - j as u64 {
                links[j][1] = links[j][0];
            }
        }
    }
    FiveBar { links, base, missing: 0.0 }
}

/// What brute force says, if it says the same twice.
fn brute(robot: &FiveBar) -> Result<Table, [Table; 2]> {
    let one = robot.count(Finesse { slices: 400, samples: 150 });
    let two = robot.count_from_behind(Finesse { slices: 570, samples: 210 });
    if one == two { Ok(one) } else { Err([one, two]) }
}

#[test]
fn random_five_bars_have_as_many_aspects_as_brute_force_finds() {
    let number = |name: &str, usual: u64| std::env::var(name).map_or(usual, |x| x.parse().unwrap());
    for seed in number("FROM", 0)..number("TO", 100) {
        let robot = random_five_bar(seed);
        let start = Instant::now();
        let table = brute(&robot);
        let brute_time = start.elapsed();
        let options = Options { budget: Budget { boxes: Some(1_000_000), ..Budget::default() }, ..Options::default() };
        let analysis = analyze(&five_bar(&robot), &options, &watched());
        match analysis {
            Err(e) => println!("{seed} {e} {table:?}"),
            Ok(a) => {
                let ours: Table = a.classes.iter().map(|c| ((as_signs(c.mode), c.det_a.factor()), c.low)).collect();
                let agree = match &table { Ok(t) => if *t == ours {"agree"} else {"DIFFER"}, Err(_) => "unstable" };
                println!("{seed} {:?} {agree} {:?} brute {brute_time:?} {:.2} s boxes {} {:?}", a.aspects, table.as_ref().map(|t| t.values().sum::<usize>()).map_err(|t| t.each_ref().map(|t| t.values().sum::<usize>())), a.run.seconds, a.run.boxes, a.run.stop);
                if agree != "agree" || !a.aspects.certified { println!("   {robot:?}\n  {ours:?}\n  {table:?}"); for d in &a.doubts { println!("    {:?} {:?} {:?} {} {:?} {:?}", d.mode, d.det_a, d.kind, d.boxes, d.place, d.undecided); } }
            }
        }
    }
}
