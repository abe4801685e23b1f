//! Areas and volumes of aspects: bounds on both sides, sharp to second order in the size of the boxes.

use crate::random::Random;
use aspecta::Kinematics;
use aspecta::aspect::{Analysis, AspectClass, DetSign, Options, Purpose, analyze};
use aspecta::paving::{Budget, Control};
use aspecta::robot::{Robot, catalogue};

/// A robot, what is held of it, and how deep a paving of it begins to tell.
type Case = (Robot, Vec<(usize, f64)>, u32);

/// Robots of every kind of platform that is paved, with limits, bodies and none, and what is held of each.
fn robots() -> Vec<Case> {
    let catalogue = |name: &str| catalogue::find(name).unwrap();
    let example = |name: &str| Robot::load(format!("../../examples/{name}.toml").as_ref()).unwrap();
    vec![
        (catalogue("five-bar"), vec![], 7),
        (catalogue("2-prr"), vec![], 6),
        (example("five-bar-cell"), vec![], 7),
        (catalogue("3-rrr"), vec![(2, 0.0)], 7),
        (catalogue("3-rrr"), vec![(0, 1.0), (2, 0.3)], 9),
        (catalogue("3-rpr"), vec![], 4),
        (catalogue("irb-360"), vec![], 4),
        (catalogue("orthoglide"), vec![], 4),
        (catalogue("gough-stewart"), vec![(3, 0.1), (4, 0.2), (5, 0.0), (2, 1.0)], 8),
    ]
}

fn to_depth(robot: &Robot, fix: &[(usize, f64)], depth: u32) -> Analysis {
    let budget = Budget { depth: Some(depth), ..Budget::default() };
    analyze(robot, &Options { budget, fix: fix.to_vec(), ..Options::default() }, &Control::unwatched())
        .unwrap()
}

/// What is certain of a class: it measures at least this, and at most that.
fn bounds(class: &AspectClass) -> (f64, f64) {
    (class.measure, class.measure + class.undecided)
}

#[test]
fn bounds_of_finer_boxes_lie_within_those_of_coarser_ones() {
    for (robot, fix, depth) in robots() {
        let [coarse, fine, finest] = [0, 1, 2].map(|more| to_depth(&robot, &fix, depth + more));
        for (coarse, finer) in [(&coarse, &fine), (&fine, &finest), (&coarse, &finest)] {
            let mut left = [0.0; 2];
            for (a, b) in coarse.classes.iter().zip(&finer.classes) {
                let ((low, high), (lower, higher)) = (bounds(a), bounds(b));
                let rounding = 1e-9 * high;
                assert!(low <= higher + rounding && lower <= high + rounding, "{}: {a:?} {b:?}", robot.name);
                // A box that is cut into finer ones is not less certain than these.
                assert!(a.undecided >= b.undecided - rounding, "{}: {a:?} {b:?}", robot.name);
                left[0] += a.undecided;
                left[1] += b.undecided;
            }
            assert!(left[1] < 0.7 * left[0], "{}: {left:?}", robot.name);
        }
    }
}

/// Poses drawn in the window lie in a class as often as its measure says.
#[test]
fn measures_are_those_of_drawn_poses() {
    let random = &mut Random(24);
    const DRAWN: usize = 40_000;
    for (robot, fix, depth) in robots() {
        let analysis = to_depth(&robot, &fix, depth + 1);
        let window = &analysis.window;
        let whole: f64 = window.axes().iter().map(|&k| window.ranges[k].1 - window.ranges[k].0).product();
        let mut seen = vec![0usize; analysis.classes.len()];
        for _ in 0..DRAWN {
            let pose: Vec<f64> = window.ranges.iter().map(|&(lo, hi)| random.within(lo, hi)).collect();
            for found in robot.inverse(&pose).unwrap().into_iter().filter(|found| found.within_limits) {
                let is_class = |class: &&AspectClass| {
                    class.mode == found.mode && (class.det_a == DetSign::Positive) == (found.det_a > 0.0)
                };
                let position = analysis.classes.iter().position(|class| is_class(&class));
                if let Some(k) = position {
                    seen[k] += 1;
                }
            }
        }
        for (class, seen) in analysis.classes.iter().zip(seen) {
            let share = seen as f64 / DRAWN as f64;
            let spread = 5.0 * (share.max(1e-4) * (1.0 - share) / DRAWN as f64).sqrt();
            let (low, high) = bounds(class);
            assert!(
                low / whole <= share + spread && share - spread <= high / whole,
                "{}: {class:?} {share}",
                robot.name
            );
        }
    }
}

/// The measures of a class are those of its aspects, where all are known.
#[test]
fn aspects_add_up_to_their_class() {
    for name in ["five-bar", "3-rpr", "linear-delta", "spherical-3-rrr"] {
        let options = Options { purpose: Purpose::Numbers, ..Options::default() };
        let analysis = analyze(&catalogue::find(name).unwrap(), &options, &Control::unwatched()).unwrap();
        assert!(analysis.aspects.certified);
        for class in &analysis.classes {
            let sum: f64 = class.aspects.iter().map(|aspect| aspect.measure).sum();
            assert!((sum - class.measure).abs() <= 1e-12 * sum, "{name}: {sum} {class:?}");
            assert!(class.undecided <= 0.07 * class.measure, "{name}: {class:?}");
        }
    }
}

/// Numbers alone take few boxes, count the same, and leave little undecided.
#[test]
fn numbers_take_few_boxes() {
    for (name, most) in [("five-bar", 20_000), ("symmetric-five-bar", 20_000), ("2-prr", 10_000)] {
        let of = |purpose| {
            let options = Options { purpose, ..Options::default() };
            analyze(&catalogue::find(name).unwrap(), &options, &Control::unwatched()).unwrap()
        };
        let [numbers, pictures] = [of(Purpose::Numbers), of(Purpose::Pictures)];
        assert!(numbers.run.boxes < most && 5 * numbers.run.boxes < pictures.run.boxes, "{name}");
        for (a, b) in numbers.classes.iter().zip(&pictures.classes) {
            assert_eq!((a.low, a.high), (b.low, b.high), "{name}");
            let ((low, high), (lower, higher)) = (bounds(a), bounds(b));
            assert!(low <= higher && lower <= high, "{name}");
        }
        let sum = |f: fn(&AspectClass) -> f64| numbers.classes.iter().map(f).sum::<f64>();
        // What is inside, but not known in which aspect, comes on top of 0.3 %.
        assert!(sum(|class| class.undecided) <= 0.004 * sum(|class| class.measure), "{name}");
    }
}
