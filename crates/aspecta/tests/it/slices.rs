//! Slices: held against configurations written out by hand, against pavings of the whole robot and against each other.

use aspecta::Kinematics;
use aspecta::aspect::{Analysis, AnalysisError, ClassId, DetSign, Options, Place, analyze};
use aspecta::paving::{Budget, Control, Stop};
use aspecta::robot::{Leg, Platform, Prismatic, Robot, SliceError, catalogue};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

fn attempt(robot: &Robot, depth: u32, fix: &[(usize, f64)]) -> Result<Analysis, AnalysisError> {
    let budget = Budget { depth: Some(depth), ..Budget::default() };
    let options = Options { budget, fix: fix.to_vec(), ..Options::default() };
    analyze(robot, &options, &Control::unwatched())
}

fn analyzed(robot: &Robot, depth: u32, fix: &[(usize, f64)]) -> Analysis {
    attempt(robot, depth, fix).unwrap()
}

fn robot(name: &str) -> Robot {
    catalogue::find(name).unwrap()
}

/// Spread over [0, 1): the k-th coordinate of the i-th sample.
fn part(i: u32, k: usize) -> f64 {
    (f64::from(i + 1) * [0.754_877_666, 0.569_840_291, 0.618_033_989][k]).fract()
}

/// The i-th sample of the poses an analysis is over.
fn pose(analysis: &Analysis, i: u32) -> Vec<f64> {
    let ranges = analysis.window.ranges.iter().enumerate();
    ranges.map(|(k, r)| if r.0 == r.1 { r.0 } else { r.0 + part(i, k) * (r.1 - r.0) }).collect()
}

// The 3-RRR of Table 3, by hand.

const BASE: [[f64; 2]; 3] = [[-10.0, -10.0], [10.0, -10.0], [0.0, 10.0]];
const PLATFORM: [[f64; 2]; 3] = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0]];
const LINK: f64 = 10.0;

/// det A of the eight configurations at x, y, φ by the signs of B_jj, relative to the rows of A; empty out of reach. The sides of an
/// elbow are the two points where circles about A and C meet.
fn by_hand([x, y, phi]: [f64; 3]) -> BTreeMap<String, f64> {
    let mut found = BTreeMap::from([(String::new(), Vec::<[f64; 3]>::new())]);
    for (base, platform) in BASE.iter().zip(PLATFORM) {
        let arm = [
            phi.cos() * platform[0] - phi.sin() * platform[1],
            phi.sin() * platform[0] + phi.cos() * platform[1],
        ];
        let d = [x + arm[0] - base[0], y + arm[1] - base[1]];
        let span = d[0].hypot(d[1]);
        let mut next = BTreeMap::new();
        for side in [1.0, -1.0] {
            if span >= 2.0 * LINK || span == 0.0 {
                return BTreeMap::new();
            }
            let height = side * (LINK * LINK - span * span / 4.0).sqrt() / span;
            let crank = [d[0] / 2.0 - height * d[1], d[1] / 2.0 + height * d[0]];
            let rod = [d[0] - crank[0], d[1] - crank[1]];
            // B_jj = −2 rod · ∂crank/∂q.
            let b = rod[0] * crank[1] - rod[1] * crank[0];
            let row = [rod[0], rod[1], arm[0] * rod[1] - arm[1] * rod[0]];
            for (mode, rows) in &found {
                let rows: Vec<_> = rows.iter().copied().chain([row]).collect();
                next.insert(format!("{mode}{}", if b > 0.0 { '+' } else { '-' }), rows);
            }
        }
        found = next;
    }
    let det = |a: &[[f64; 3]]| {
        let cross = |i: usize, j: usize| a[1][i] * a[2][j] - a[1][j] * a[2][i];
        let size: f64 = a.iter().map(|r| r.iter().map(|v| v * v).sum::<f64>().sqrt()).product();
        (a[0][0] * cross(1, 2) + a[0][1] * cross(2, 0) + a[0][2] * cross(0, 1)) / size
    };
    found.into_iter().map(|(mode, rows)| (mode, det(&rows))).collect()
}

/// Below this a sign says nothing.
const NOISE: f64 = 1e-9;

/// Every cell of the slice φ = 0 says what configurations worked out in doubles say.
#[test]
fn the_slice_of_the_3_rrr_has_the_signs_of_its_configurations() {
    let robot = robot("3-rrr");
    for fix in [(2, 0.0), (2, 2.0), (0, -5.0), (1, 0.3)] {
        let analysis = analyzed(&robot, 9, &[fix]);
        let (mut decided, mut members) = (0, 0);
        for i in 0..4000 {
            let x = pose(&analysis, i);
            let configurations = by_hand([x[0], x[1], x[2]]);
            for (k, class) in analysis.classes.iter().enumerate() {
                let det = configurations.get(&class.mode.to_string()).copied();
                let depth = det.map_or(-1.0, |det| det * f64::from(class.det_a.factor()));
                members += usize::from(depth > NOISE);
                match analysis.locate(&x, ClassId::new(k)) {
                    Place::Inside(id) => {
                        decided += 1;
                        assert!(depth > -NOISE, "{} {} {x:?}", class.mode, class.det_a);
                        assert!(class.aspects.iter().any(|a| a.id == id));
                    }
                    Place::Outside => assert!(depth < NOISE, "{} {} {x:?}", class.mode, class.det_a),
                    Place::Undecided => {}
                }
            }
        }
        assert!(members > 3000 && decided as f64 > 0.93 * members as f64, "{fix:?}: {decided} of {members}");
    }
}

/// The count published for the slice φ = 0, there after leaving out what is small: here each of the 25 is proved.
#[test]
fn the_slice_phi_0_of_the_3_rrr_has_25_aspects() {
    let analysis = analyzed(&robot("3-rrr"), 9, &[(2, 0.0)]);
    assert_eq!(analysis.aspects.low, 25);
    for class in &analysis.classes {
        for aspect in &class.aspects {
            let sample = &aspect.sample;
            assert_eq!((sample.pose[2], aspect.w_bounds[2]), (0.0, (0.0, 0.0)));
            let j = analysis.robot.jacobians(&sample.pose, &sample.q).unwrap();
            assert_eq!((j.mode(), j.det_a() > 0.0), (class.mode, class.det_a == DetSign::Positive));
        }
    }
}

/// One coordinate free: the sign of det A along a line, sample by sample. Returns the number of stretches and the share of the line
/// they cover; `closed` lines are circles.
fn stretches(inside: &[bool], closed: bool) -> (usize, f64) {
    let n = inside.len();
    let starts = (0..n).filter(|&i| inside[i] && (i == 0 && !closed || !inside[(i + n - 1) % n])).count();
    (starts, inside.iter().filter(|&&x| x).count() as f64 / n as f64)
}

fn check_line(analysis: &Analysis, axis: usize, signs: impl Fn(&[f64]) -> BTreeMap<String, f64>) -> usize {
    const SAMPLES: usize = 20_000;
    let (lo, hi) = analysis.window.ranges[axis];
    let at = |i: usize| {
        let mut x: Vec<f64> = analysis.window.ranges.iter().map(|r| r.0).collect();
        x[axis] = lo + (hi - lo) * (i as f64 + 0.5) / SAMPLES as f64;
        signs(&x)
    };
    let dets: Vec<_> = (0..SAMPLES).map(at).collect();
    for class in &analysis.classes {
        let mode = class.mode.to_string();
        let inside: Vec<bool> = dets
            .iter()
            .map(|d| d.get(&mode).is_some_and(|d| d * f64::from(class.det_a.factor()) > 0.0))
            .collect();
        let (count, share) = stretches(&inside, analysis.window.glued[axis]);
        assert_eq!(class.low, count, "{mode} {}", class.det_a);
        let (least, most) = (class.measure / (hi - lo), (class.measure + class.undecided) / (hi - lo));
        let slack = (count + 1) as f64 / SAMPLES as f64;
        assert!(least < share + slack && share - slack < most, "{mode}: {least} {share} {most}");
    }
    analysis.aspects.low
}

/// In one dimension brute force can be trusted: as many aspects as there are stretches of one sign, and as long.
#[test]
fn lines_are_cut_where_the_sign_changes() {
    let three_rrr = robot("3-rrr");
    let mut counts = Vec::new();
    for (free, fix) in [(0, [(1, -5.0), (2, 0.3)]), (1, [(0, -4.0), (2, 1.0)]), (2, [(0, -6.0), (1, -4.5)])] {
        let analysis = analyzed(&three_rrr, 14, &fix);
        counts.push(check_line(&analysis, free, |x| by_hand([x[0], x[1], x[2]])));
    }
    assert!(counts.iter().all(|&n| n > 10), "{counts:?}");
    // The five-bar along A₁A₂: C within [3, 13] of both ends, 9 apart.
    let analysis = analyzed(&robot("five-bar"), 14, &[(1, 0.0)]);
    for serial in &analysis.serial_aspects {
        let mut lengths: Vec<f64> = serial.domains.iter().map(|d| d.measure).collect();
        lengths.sort_by(f64::total_cmp);
        assert_eq!(lengths.len(), 3);
        assert!(lengths.iter().zip([1.0, 1.0, 3.0]).all(|(l, exact)| *l < exact && *l > exact - 0.01));
    }
}

/// A platform so small that it can turn right round: one aspect runs over φ = ±π and is not cut there.
#[test]
fn a_line_of_angles_closes_up_on_itself() {
    let mut robot = robot("3-rpr");
    robot.legs.iter_mut().zip([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]).for_each(|(leg, c)| {
        leg.attachment = aspecta::robot::point([c[0], c[1], 0.0]);
        leg.limits.clear();
    });
    robot.window = vec![Some((-20.0, 20.0)), Some((-20.0, 20.0)), None];
    let analysis = analyzed(&robot, 12, &[(0, 5.0), (1, 4.0)]);
    let signs = |x: &[f64]| {
        let (sin, cos) = x[2].sin_cos();
        let rows = [([0.0, 0.0], [0.0, 0.0]), ([15.91, 0.0], [cos, sin]), ([0.0, 10.0], [-sin, cos])];
        let [a, b, c] = rows.map(|(base, arm): ([f64; 2], [f64; 2])| {
            let d = [x[0] + arm[0] - base[0], x[1] + arm[1] - base[1]];
            [d[0], d[1], arm[0] * d[1] - arm[1] * d[0]]
        });
        let cross = |i: usize, j: usize| b[i] * c[j] - b[j] * c[i];
        BTreeMap::from([("---".to_owned(), a[0] * cross(1, 2) + a[1] * cross(2, 0) + a[2] * cross(0, 1))])
    };
    assert!(analysis.window.glued[2]);
    assert_eq!(check_line(&analysis, 2, signs), 2);
    let over = |a: &&aspecta::aspect::Aspect| a.w_bounds[2].1 > PI;
    assert_eq!(analysis.classes.iter().flat_map(|c| &c.aspects).filter(over).count(), 1);
}

/// Sizes of the components of det A ≠ 0 in every class, by flood fill over a grid of the plane, through the Jacobians.
fn flood_fill(slice: &Analysis, n: usize) -> Vec<Vec<usize>> {
    let axes = slice.window.axes();
    let at = |cell: usize| {
        let mut x: Vec<f64> = slice.window.ranges.iter().map(|r| r.0).collect();
        for (&k, i) in axes.iter().zip([cell % n, cell / n]) {
            let (lo, hi) = slice.window.ranges[k];
            x[k] = lo + (hi - lo) * (i as f64 + 0.5) / n as f64;
        }
        x
    };
    let step = |i: usize, by: isize, a: usize| match i as isize + by {
        j if slice.window.glued[axes[a]] => Some(j.rem_euclid(n as isize) as usize),
        j => usize::try_from(j).ok().filter(|&j| j < n),
    };
    let class = |class: &aspecta::aspect::AspectClass| {
        let is_inside = |cell: usize| {
            let q = slice.robot.inverse_in(&at(cell), class.mode).unwrap();
            let det = q.map(|q| slice.robot.jacobians(&at(cell), &q).unwrap().det_a());
            det.is_some_and(|det| det * f64::from(class.det_a.factor()) > 0.0)
        };
        let mut open: Vec<bool> = (0..n * n).map(is_inside).collect();
        let mut sizes = Vec::new();
        for start in 0..n * n {
            let mut size = 0;
            let mut stack = if std::mem::take(&mut open[start]) { vec![start] } else { vec![] };
            while let Some(cell) = stack.pop() {
                size += 1;
                let (i, j) = (cell % n, cell / n);
                let across = [-1, 1].into_iter().filter_map(|by| Some(step(i, by, 0)? + n * j));
                let up = [-1, 1].into_iter().filter_map(|by| Some(i + n * step(j, by, 1)?));
                stack.extend(across.chain(up).filter(|&next| std::mem::take(&mut open[next])));
            }
            sizes.extend((size > 0).then_some(size));
        }
        sizes
    };
    slice.classes.par_iter().map(class).collect()
}

/// At pitch = ±90° roll and yaw turn about the same axis, but where one of them is held the other tells poses apart: nothing is
/// joined there that brute force keeps apart.
#[test]
fn slices_of_a_turning_body_do_not_fold() {
    let text = catalogue::all().iter().find(|e| e.name == "spherical-3-rrr").unwrap().text;
    let robot = Robot::from_toml(&text.replace("deg = 90", "deg = 80"), "text").unwrap();
    for (held, value) in [(2, 2.9), (0, 0.4)] {
        let slice = analyzed(&robot, 9, &[(held, value)]);
        for (class, sizes) in slice.classes.iter().zip(flood_fill(&slice, 240)) {
            // The grid cuts a few cells off in sharp edges.
            let sure = sizes.iter().filter(|&&cells| cells > 36).count();
            let told = format!("{held} = {value}, {} {}: {sizes:?}", class.mode, class.det_a);
            assert!(sure <= class.low && class.low <= sizes.len(), "{} {told}", class.low);
        }
    }
}

// Slices and the whole.

/// What a slice and a paving that holds it say of the same poses never contradicts; poses of one aspect of the slice are never in two
/// aspects of the robot that are proved distinct.
fn check_consistency(whole: &Analysis, slice: &Analysis) -> [usize; 2] {
    let mut agree = [0; 2];
    let mut home = BTreeMap::new();
    for i in 0..3000 {
        let x = pose(slice, i);
        for k in 0..whole.classes.len() {
            match (slice.locate(&x, ClassId::new(k)), whole.locate(&x, ClassId::new(k))) {
                (Place::Inside(id), Place::Inside(whole)) => {
                    agree[0] += 1;
                    assert_eq!(*home.entry(id).or_insert(whole), whole, "aspect {id} at {x:?}");
                }
                (Place::Outside, Place::Outside) => agree[1] += 1,
                (Place::Inside(_), Place::Outside) | (Place::Outside, Place::Inside(_)) => {
                    panic!("{} {} at {x:?}", whole.classes[k].mode, whole.classes[k].det_a)
                }
                _ => {}
            }
        }
    }
    agree
}

#[test]
fn slices_agree_with_the_whole() {
    agree_with_the_whole(5);
}

#[test]
#[ignore = "two minutes: finer boxes of the whole"]
fn slices_agree_with_the_whole_in_finer_boxes() {
    agree_with_the_whole(6);
}

/// Slices say of a pose what the whole says, paved to this depth where there are three coordinates.
fn agree_with_the_whole(depth: u32) {
    let mut agree = [0; 2];
    for (name, fixes) in [
        ("3-rrr", vec![vec![(2, 0.3)], vec![(0, -5.0)], vec![(1, -5.0), (2, 0.3)]]),
        ("3-rpr", vec![vec![(2, -0.4)], vec![(0, 3.0)]]),
        ("delta", vec![vec![(2, -900.0)], vec![(0, 100.0), (1, 50.0)]]),
        (
            "spherical-3-rrr",
            vec![vec![(0, 0.4)], vec![(1, 0.7)], vec![(1, FRAC_PI_2)], vec![(0, 1.0), (1, 0.2)]],
        ),
        ("five-bar", vec![vec![(0, 1.0)], vec![(1, 2.0)]]),
    ] {
        let robot = robot(name);
        let whole = analyzed(&robot, if robot.dof() == 2 { 9 } else { depth }, &[]);
        for fix in fixes {
            let slice = analyzed(&robot, 8, &fix);
            let found = check_consistency(&whole, &slice);
            agree = [agree[0] + found[0], agree[1] + found[1]];
        }
    }
    assert!(agree[0] > 20_000 && agree[1] > 50_000, "{agree:?}");
}

/// A line of a slice, as a slice of the slice.
#[test]
fn lines_agree_with_the_planes_they_lie_in() {
    let robot = robot("3-rrr");
    let plane = analyzed(&robot, 10, &[(2, 0.3)]);
    let line = analyzed(&robot, 14, &[(2, 0.3), (1, -5.0)]);
    let [inside, outside] = check_consistency(&plane, &line);
    assert!(inside > 10_000 && outside > 20_000, "{inside} {outside}");
    assert!(line.aspects.low > plane.aspects.low / 2);
}

// What must not matter.

/// The 3-RRR moved: turned by `turn` about the origin, shifted, in another unit, and with the platform's frame shifted to `origin`.
fn moved(turn: f64, shift: [f64; 2], scale: f64, origin: [f64; 2]) -> Robot {
    let (sin, cos) = turn.sin_cos();
    let legs = BASE.iter().zip(PLATFORM).map(|(a, c)| {
        let anchor = [cos * a[0] - sin * a[1] + shift[0], sin * a[0] + cos * a[1] + shift[1]];
        let attachment = [c[0] - origin[0], c[1] - origin[1]];
        Leg::revolute(anchor.map(|x| x * scale), attachment.map(|x| x * scale), LINK * scale, LINK * scale)
    });
    Robot::new("moved", Platform::PlaneBody, legs.collect()).unwrap()
}

/// Slices φ = const do not depend on where the robot stands, which way it looks (φ turns with it), in which unit it is measured, and
/// which point of the platform is followed.
#[test]
fn slices_do_not_depend_on_place_direction_unit_and_frame() {
    do_not_depend_on_frames(&["+++", "-+-"]);
}

#[test]
#[ignore = "a minute: eight modes"]
fn slices_of_all_modes_do_not_depend_on_place_direction_unit_and_frame() {
    do_not_depend_on_frames(&[]);
}

/// In these modes, or all if there are none.
fn do_not_depend_on_frames(modes: &[&str]) {
    let counts = |a: &Analysis| a.classes.iter().map(|c| (c.low, c.high)).collect::<Vec<_>>();
    let analyzed = |robot: &Robot, fix: &[(usize, f64)]| {
        let modes = modes.iter().map(|mode| mode.parse().unwrap()).collect();
        let options = Options { fix: fix.to_vec(), modes, ..Options::default() };
        analyze(robot, &options, &Control::unwatched()).unwrap()
    };
    let area = |a: &Analysis| a.classes.iter().map(|c| c.measure).sum::<f64>();
    let most = |a: &Analysis| a.classes.iter().map(|c| c.measure + c.undecided).sum::<f64>();
    let reference = analyzed(&robot("3-rrr"), &[(2, 0.0)]);
    for (turn, shift, scale, origin) in [
        (0.0, [17.3, -4.1], 1.0, [0.0, 0.0]),
        (0.3, [1.0, 2.0], 1.0, [0.0, 0.0]),
        (-2.5, [0.0, 0.0], 1e-3, [0.0, 0.0]),
        (1.0, [0.0, 0.0], 1e3, [3.0, -2.0]),
    ] {
        let slice = analyzed(&moved(turn, shift, scale, origin), &[(2, turn)]);
        // Bounds may stay apart for one grid of boxes and meet for another; they never contradict each other.
        for ((low, high), (exact, _)) in counts(&slice).into_iter().zip(counts(&reference)) {
            assert!(
                low <= exact && high.is_none_or(|high| exact <= high),
                "{turn} {shift:?} {scale} {origin:?}"
            );
        }
        let unit = scale * scale;
        assert!(area(&slice) <= 1.0001 * unit * most(&reference), "{turn} {shift:?} {scale} {origin:?}");
        assert!(unit * area(&reference) <= 1.0001 * most(&slice), "{turn} {shift:?} {scale} {origin:?}");
    }
}

/// An angle is what it is in any turn.
#[test]
fn held_angles_count_modulo_full_turns() {
    let robot = robot("3-rrr");
    let slice = analyzed(&robot, 7, &[(2, 5.8)]);
    let held = slice.window.ranges[2].0;
    assert!((held - (5.8 - TAU)).abs() < 1e-15 && !slice.window.glued[2], "{held}");
    let same = analyzed(&robot, 7, &[(2, held)]);
    assert_eq!(slice.classes[0].measure, same.classes[0].measure);
    let mut inside = 0;
    for i in 0..500 {
        let mut x = pose(&slice, i);
        let place = slice.locate(&x, ClassId::new(0));
        inside += usize::from(matches!(place, Place::Inside(_)));
        for turns in [-2.0, -1.0, 1.0, 3.0] {
            x[2] = held + turns * TAU;
            assert_eq!(slice.locate(&x, ClassId::new(0)), place);
        }
        // Off the slice there is nothing, however near.
        for off in [1e-12, -1e-9, 1.0] {
            x[2] = held + off;
            assert_eq!(slice.locate(&x, ClassId::new(0)), Place::Outside);
        }
    }
    assert!(inside > 20, "{inside}");
}

#[test]
fn a_slice_says_what_was_held() {
    let json = |fix: &[(usize, f64)]| serde_json::to_value(analyzed(&robot("3-rrr"), 4, fix)).unwrap();
    let slice = json(&[(2, 0.5)]);
    assert_eq!(slice["fixed"], serde_json::json!([{ "coordinate": "phi", "value": 0.5, "unit": "rad" }]));
    assert_eq!(slice["measure"], serde_json::json!({ "name": "area", "unit": "unit^2" }));
    assert_eq!(slice["run"]["resolution"][2], 0.0);
    assert_eq!(slice["window"]["ranges"][2], serde_json::json!([0.5, 0.5]));
    let measure = |fix: &[(usize, f64)]| {
        let json = json(fix);
        let text = |key: &str| json["measure"][key].as_str().unwrap().to_owned();
        format!("{} in {}", text("name"), text("unit"))
    };
    assert_eq!(measure(&[]), "volume in unit^2 rad");
    assert_eq!(measure(&[(0, 0.0)]), "area in unit rad");
    assert_eq!(measure(&[(0, 0.0), (2, 0.0)]), "length in unit");
    assert_eq!(measure(&[(0, -5.0), (1, -5.0)]), "angle in rad");
}

/// Without anything asked for, a line and a plane are paved deep enough to be of use.
#[test]
fn budgets_know_the_coordinates_that_vary() {
    let run = |fix: &[(usize, f64)], budget: Budget| {
        let options = Options { budget, fix: fix.to_vec(), ..Options::default() };
        let control = Control::unwatched();
        analyze(&robot("3-rrr"), &options, &control).unwrap().run
    };
    assert_eq!(run(&[(1, -5.0), (2, 0.3)], Budget::default()).depth, 16);
    let run = run(&[(2, 0.3)], Budget { resolution: Some(0.5), ..Budget::default() });
    assert_eq!(run.stop, Stop::Resolution);
    assert!(run.resolution[..2].iter().all(|&w| w <= 0.5 && w > 0.2), "{:?}", run.resolution);
}

// What cannot be held.

#[test]
fn values_that_cannot_be_held_are_refused() {
    let refused = |fix: &[(usize, f64)]| match attempt(&robot("3-rrr"), 3, fix) {
        Err(AnalysisError::Slice(e)) => e,
        other => panic!("{other:?}"),
    };
    let robot = || "3-rrr".to_owned();
    assert_eq!(refused(&[(0, 1.0), (0, 1.0)]), SliceError::Twice { robot: robot(), coordinate: "x" });
    let names = || "x, y, phi".to_owned();
    assert_eq!(
        refused(&[(0, 1.0), (1, 1.0), (2, 1.0)]),
        SliceError::AllHeld { robot: robot(), names: names() }
    );
    let none = SliceError::NoSuchCoordinate { robot: robot(), index: 3, count: 3, names: names() };
    assert_eq!(refused(&[(3, 0.0)]), none);
    for value in [f64::NAN, f64::INFINITY, -1e300] {
        assert!(matches!(refused(&[(2, value)]), SliceError::Value { coordinate: "phi", .. }), "{value}");
    }
    let SliceError::Outside { coordinate, value, lo, hi, .. } = refused(&[(0, 11.0)]) else { panic!() };
    assert_eq!((coordinate, value), ("x", 11.0));
    assert!((lo + 20.0).abs() < 1e-9 && (hi - 10.0).abs() < 1e-9);
    let mut windowed = catalogue::find("3-rrr").unwrap();
    windowed.window[2] = Some((3.0, 3.5));
    assert!(windowed.slice(&[(2, 3.4 - TAU)]).is_ok());
    assert!(matches!(windowed.slice(&[(2, 0.0)]), Err(SliceError::Outside { coordinate: "phi", .. })));
    let pitch = catalogue::find("spherical-3-rrr").unwrap().slice(&[(1, 2.0)]);
    assert!(matches!(pitch, Err(SliceError::Outside { coordinate: "pitch", .. })), "{pitch:?}");
}

/// A held coordinate has one value and is no empty range; an empty range is one even if it is held.
#[test]
fn held_is_not_empty() {
    let mut robot = robot("3-rrr");
    robot.window[0] = Some((20.0, 30.0));
    for fix in [vec![], vec![(0, 25.0)], vec![(1, 0.0)]] {
        let empty = attempt(&robot, 3, &fix);
        assert!(
            matches!(empty, Err(AnalysisError::Slice(SliceError::Empty { coordinate: "x", .. }))),
            "{empty:?}"
        );
    }
    robot.window[0] = Some((-5.0, 5.0));
    assert!(analyzed(&robot, 8, &[(0, -5.0)]).aspects.low > 0);
}

/// Sliders without ends along x: the workspace has no bounds, but its slices across x have.
#[test]
fn a_held_coordinate_needs_no_bounds() {
    let leg = |y: f64| {
        let mut leg = Leg::revolute([0.0, y], [0.0, 0.0], 1.0, 5.0);
        leg.actuator =
            aspecta::robot::Actuator::Prismatic(Prismatic { rod: aspecta::num::Interval::point(5.0) });
        leg
    };
    let robot = Robot::new("sliders", Platform::PlanePoint, vec![leg(0.0), leg(4.0)]).unwrap();
    let unbounded = attempt(&robot, 3, &[]);
    assert!(matches!(unbounded, Err(AnalysisError::Slice(SliceError::Unbounded(_)))), "{unbounded:?}");
    let slice = analyzed(&robot, 10, &[(0, 7.0)]);
    let (lo, hi) = slice.window.ranges[1];
    assert!((lo + 1.0).abs() < 1e-9 && (hi - 5.0).abs() < 1e-9, "{lo} {hi}");
    // The rods are in line, det A = 0, where y is half-way: one elbow up, one down.
    let low: Vec<_> = slice.classes.iter().map(|c| (c.mode.to_string(), c.low)).collect();
    assert_eq!(low.iter().map(|c| c.1).sum::<usize>(), 6, "{low:?}");
    assert!(matches!(attempt(&robot, 3, &[(1, 2.0)]), Err(AnalysisError::Slice(SliceError::Unbounded(_)))));
}
