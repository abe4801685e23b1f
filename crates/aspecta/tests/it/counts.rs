//! Certified numbers of aspects: known ones, those of a robot seen in other ways, those of random robots against brute force.
//!
//! `ASPECTA_CASES` sets the number of random five-bars (10 by default).

use crate::random::Random;
use crate::sweep::{Finesse, FiveBar, MODES, Table};
use aspecta::Kinematics;
use aspecta::aspect::{
    Analysis, AnalysisError, AspectClass, ClassId, DetSign, Options, Place, Purpose, Sample, analyze,
};
use aspecta::certificate::Claim;
use aspecta::paving::{Budget, Control, Stop};
use aspecta::robot::{Leg, Platform, Robot, SliceError, catalogue};
use aspecta::verify::verify;

fn analyzed(robot: &Robot, options: &Options) -> Analysis {
    analyze(robot, options, &Control::unwatched()).unwrap()
}

fn find(name: &str) -> Robot {
    catalogue::find(name).unwrap()
}

/// The entry of a class of a five-bar in a table of numbers.
fn entry(class: &AspectClass, number: usize) -> (([i8; 2], i8), usize) {
    (([class.mode.sign(0), class.mode.sign(1)], class.det_a.factor()), number)
}

/// What must hold of any result: bounds in order, and doubts just where they do not meet, that say where and what.
fn check_bounds(analysis: &Analysis) {
    let Analysis { aspects, classes, doubts, .. } = analysis;
    assert_eq!(aspects.certified, aspects.high == Some(aspects.low));
    assert!(aspects.high.is_none_or(|high| aspects.low <= high));
    assert_eq!(aspects.low, classes.iter().map(|c| c.low).sum::<usize>());
    assert_eq!(aspects.high, classes.iter().map(|c| c.high).sum::<Option<usize>>());
    assert_eq!(
        aspects.certified,
        doubts.is_empty(),
        "{aspects:?} {doubts:?} {:?}",
        classes.iter().map(|c| (c.low, c.high)).collect::<Vec<_>>()
    );
    for class in classes {
        assert!(class.high.is_none_or(|high| class.low <= high));
        let doubted = doubts.iter().any(|d| (d.mode, d.det_a) == (class.mode, class.det_a));
        assert_eq!(doubted, class.high != Some(class.low), "{class:?}");
    }
    for doubt in doubts {
        assert_eq!(doubt.place.len(), analysis.robot.dof(), "{doubt:?}");
        assert!(doubt.boxes > 0 && !doubt.undecided.is_empty(), "{doubt:?}");
        if doubt.fold.is_none() {
            let within = doubt.place.iter().zip(&analysis.window.ranges);
            assert!(within.into_iter().all(|(p, w)| w.0 <= p.0 && p.0 <= p.1 && p.1 <= w.1), "{doubt:?}");
        }
    }
}

/// The certified numbers of a five-bar's classes.
fn certified(robot: &Robot) -> Table {
    let analysis = analyzed(robot, &Options::default());
    check_bounds(&analysis);
    assert!(analysis.aspects.certified, "{:?} {:?}", analysis.aspects, analysis.doubts);
    analysis.classes.iter().map(|c| entry(c, c.low)).collect()
}

// The catalogue.

fn assert_exactly(count: usize, name: &str, options: &Options) -> Analysis {
    let analysis = analyzed(&find(name), options);
    check_bounds(&analysis);
    assert_eq!((analysis.aspects.low, analysis.aspects.high), (count, Some(count)), "{name}");
    assert_eq!(analysis.run.stop, Stop::Exact);
    analysis
}

/// The slice of figure 13, of which the paper counts 25 aspects after a filter by size.
fn figure_13() -> Options {
    Options { fix: vec![(2, 0.0)], ..Options::default() }
}

#[test]
fn robots_of_the_catalogue() {
    for (name, count) in [("2-prr", 6), ("3-rpr", 2), ("linear-delta", 14), ("orthoglide", 9)] {
        assert_exactly(count, name, &Options::default());
    }
    assert_exactly(27, "3-rrr", &figure_13());
}

/// So many, and the certificate, checked, proves it.
fn assert_verified(count: usize, name: &str, options: Options) {
    let analysis =
        assert_exactly(count, name, &Options { certificate: true, purpose: Purpose::Numbers, ..options });
    let verdict = verify(&analysis.certificate.unwrap(), &Control::unwatched());
    assert!(verdict.is_verified(), "{name}: {:?}", verdict.faults);
    let proved: (usize, Option<usize>) = (
        verdict.classes.iter().map(|c| c.proved.low).sum(),
        verdict.classes.iter().map(|c| c.proved.high).sum(),
    );
    assert_eq!(proved, (count, Some(count)), "{name}");
}

#[test]
fn certificates_are_verified() {
    for name in ["five-bar", "symmetric-five-bar"] {
        assert_verified(10, name, Options::default());
    }
}

#[test]
fn the_certificate_of_a_mode_of_a_slice_is_verified() {
    assert_verified(3, "3-rrr", Options { modes: vec!["+-+".parse().unwrap()], ..figure_13() });
}

#[test]
#[ignore = "a minute: eight modes"]
fn the_certificate_of_a_slice_is_verified() {
    assert_verified(27, "3-rrr", figure_13());
}

#[test]
#[ignore = "a quarter of a minute; the checker's tests look at a Delta in coarser boxes"]
fn the_certificate_of_a_delta_is_verified() {
    assert_verified(2, "irb-360", Options::default());
}

// A platform that turns about a point: all orientations, in the joint angles of a leg.

/// A robot with its legs from `first` on.
fn from_leg(first: usize, text: &str) -> Robot {
    let mut robot = Robot::from_toml(text, "a fixture").unwrap();
    robot.legs.rotate_left(first);
    robot
}

/// The generic spherical robot with the ranges of its motors.
fn sphere(first: usize) -> Robot {
    from_leg(first, include_str!("../fixtures/limited_sphere.toml"))
}

/// A spherical robot whose last leg can fold.
fn folding_sphere(first: usize) -> Robot {
    from_leg(first, include_str!("../fixtures/folding_sphere.toml"))
}

/// The numbers of the aspects of some modes, det A > 0 and < 0.
fn in_modes(robot: &Robot, modes: &[&str]) -> Vec<usize> {
    let modes = modes.iter().map(|mode| mode.parse().unwrap()).collect();
    let analysis = analyzed(robot, &Options { modes, ..Options::default() });
    check_bounds(&analysis);
    assert!(analysis.aspects.certified, "{:?}", analysis.doubts);
    analysis.classes.iter().map(|class| class.low).collect()
}

/// In the joint angles of the second and of the third leg; those of the first are the certificate's below.
#[test]
fn a_spherical_robot() {
    assert_eq!(in_modes(&sphere(1), &["+++"]), [1, 1]);
    assert_eq!(in_modes(&sphere(2), &["+++"]), [1, 1]);
}

#[test]
#[ignore = "minutes: ten modes of a spherical robot"]
fn a_spherical_robot_in_the_joint_angles_of_each_leg() {
    let modes = ["+++", "---", "+-+", "--+"];
    assert_eq!(in_modes(&sphere(0), &modes), [1, 1, 2, 2, 1, 1, 1, 1]);
    // The same with the joint angles of other legs. det A keeps its sign as rows are moved round.
    assert_eq!(in_modes(&sphere(1), &["+++", "---", "-++", "-+-"]), [1, 1, 2, 2, 1, 1, 1, 1]);
    assert_eq!(in_modes(&sphere(2), &["+++", "---"]), [1, 1, 2, 2]);
}

/// A fold is opened up by the leg's own joint angles: by those of all configurations, if it is the first leg, or by a chart of its own.
#[test]
fn a_spherical_robot_whose_leg_folds() {
    assert_eq!(in_modes(&folding_sphere(2), &["+-+"]), [1, 1]);
}

#[test]
#[ignore = "a few seconds: its joint angles chart all configurations, as those of any first leg do"]
fn a_spherical_robot_whose_first_leg_folds() {
    assert_eq!(in_modes(&folding_sphere(0), &["-++"]), [1, 1]);
}

#[test]
fn the_certificate_of_a_spherical_robot_is_verified() {
    let modes = vec!["---".parse().unwrap()];
    let analysis = analyzed(
        &sphere(0),
        &Options { modes, certificate: true, purpose: Purpose::Numbers, ..Options::default() },
    );
    let verdict = verify(&analysis.certificate.unwrap(), &Control::unwatched());
    assert!(verdict.is_verified(), "{:?}", verdict.faults);
    assert!(verdict.classes.iter().all(|class| class.proved == Claim { low: 2, high: Some(2) }));
    assert!(verdict.claims.covered > 1000 && verdict.claims.summitless > 1000, "{:?}", verdict.claims);
}

/// Whatever ends a run: poses are measured, and each aspect has a pose in it, joints to go with it, and bounds that hold both.
#[test]
fn aspects_of_a_spherical_robot_have_poses() {
    let text = include_str!("../fixtures/sphere.toml");
    let robot = Robot::from_toml(text, "sphere.toml").unwrap();
    let modes = vec!["+++".parse().unwrap()];
    let budget = Budget { boxes: Some(1_000_000), ..Budget::default() };
    let analysis = analyzed(&robot, &Options { modes, budget, ..Options::default() });
    check_bounds(&analysis);
    assert_eq!((analysis.run.stop, analysis.aspects.low), (Stop::Boxes, 2));
    // The measure by chance.
    let mut random = Random(5);
    let volume: f64 = analysis.window.ranges.iter().map(|r| r.1 - r.0).product();
    let mut hits = [0; 2];
    const DRAWS: usize = 20_000;
    for _ in 0..DRAWS {
        let pose: Vec<f64> = analysis.window.ranges.iter().map(|r| random.within(r.0, r.1)).collect();
        let Some(q) = robot.inverse_in(&pose, analysis.classes[0].mode).unwrap() else { continue };
        hits[usize::from(robot.state(&pose, &q).unwrap().det_a < 0.0)] += 1;
    }
    for (k, class) in analysis.classes.iter().enumerate() {
        let aspect = &class.aspects[0];
        let measure = volume * hits[k] as f64 / DRAWS as f64;
        let (least, most) = (aspect.measure, aspect.measure + class.undecided);
        assert!(0.25 * measure < least && least < measure && measure < most, "{least} {measure} {most}");
        let Sample { pose, q } = &aspect.sample;
        assert_eq!(analysis.locate(pose, ClassId::new(k)), Place::Inside(aspect.id));
        let state = robot.state(pose, q).unwrap();
        assert_eq!((state.mode, DetSign::of(state.det_a)), (Some(class.mode), class.det_a));
        let within = |(x, (lo, hi)): (&f64, &(f64, f64))| lo <= x && x <= hi;
        assert!(pose.iter().zip(&aspect.w_bounds).all(within) && q.iter().zip(&aspect.q_bounds).all(within));
    }
}

// The five-bar of the paper.

const PAPER: FiveBar = FiveBar { links: [[8.0, 5.0], [5.0, 8.0]], base: 9.0, missing: 0.0 };

/// Table 2 with the signs of modes and of det A changed by `change`.
fn table_2(change: impl Fn([i8; 2], i8) -> ([i8; 2], i8)) -> Table {
    let rows = [(1, [1, 1, 1, 2]), (-1, [1, 2, 1, 1])];
    let row = |(sign, row): (i8, [usize; 4])| MODES.into_iter().zip(row).map(move |(m, n)| ((m, sign), n));
    rows.into_iter().flat_map(row).map(|((mode, sign), n)| (change(mode, sign), n)).collect()
}

fn same(mode: [i8; 2], sign: i8) -> ([i8; 2], i8) {
    (mode, sign)
}

fn paper_at(anchors: [[f64; 2]; 2], scale: f64) -> Robot {
    let leg = |k: usize, l: f64, m: f64| {
        Leg::revolute(anchors[k].map(|x| x * scale), [0.0, 0.0], l * scale, m * scale)
    };
    Robot::new("five-bar", Platform::PlanePoint, vec![leg(0, 8.0, 5.0), leg(1, 5.0, 8.0)]).unwrap()
}

#[test]
fn place_direction_and_unit_do_not_matter() {
    let (sin, cos) = 0.3f64.sin_cos();
    for (anchors, scale) in [
        ([[0.0, 0.0], [9.0, 0.0]], 1.0),
        ([[17.3, -4.1], [26.3, -4.1]], 1.0),
        ([[1.0, 2.0], [1.0 + 9.0 * cos, 2.0 + 9.0 * sin]], 1.0),
        ([[0.0, 0.0], [-9.0 * sin, 9.0 * cos]], 1.0),
        ([[0.0, 0.0], [9.0, 0.0]], 1e-3),
        ([[0.0, 0.0], [9.0, 0.0]], 1e3),
    ] {
        assert_eq!(certified(&paper_at(anchors, scale)), table_2(same), "{anchors:?} {scale}");
    }
}

/// A mirror changes all signs. A five-bar is its own image in A₁A₂, so Table 2 has to be the same with all of them changed.
#[test]
fn a_mirror_changes_all_signs() {
    let mirrored = certified(&paper_at([[0.0, 0.0], [-9.0, 0.0]], 1.0));
    assert_eq!(mirrored, table_2(|mode, sign| (mode.map(|s| -s), -sign)));
    assert_eq!(mirrored, table_2(same));
}

#[test]
fn renumbered_legs_swap_signs_and_rows() {
    let mut robot = find("five-bar");
    robot.legs.reverse();
    assert_eq!(certified(&robot), table_2(|[a, b], sign| ([b, a], -sign)));
}

/// The paper prints det A without − c₂ in its second row. That is no mechanism's, so it is put into the brute force: which gives
/// Table 2 with det A as it is, and something else as it is printed.
#[test]
fn the_misprinted_determinant_does_not_give_table_2() {
    for finesse in FINESSE {
        assert_eq!(PAPER.count(finesse), table_2(same));
        let misprinted = FiveBar { missing: PAPER.base, ..PAPER }.count(finesse);
        println!("as printed: {misprinted:?}");
        assert_ne!(misprinted.values().sum::<usize>(), 10);
        assert_ne!(misprinted, table_2(same));
    }
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
        for (_, link) in (0..).zip(&mut links).filter(|(j, _)| seed / 10 % 3 != *j) {
            link[1] = link[0];
        }
    }
    FiveBar { links, base, missing: 0.0 }
}

/// Fineness of two brute-force counts that must agree to be believed.
const FINESSE: [Finesse; 2] = [Finesse { slices: 400, samples: 150 }, Finesse { slices: 570, samples: 210 }];

/// What brute force says, if it says the same at two resolutions, swept over either elbow.
fn brute_force(robot: &FiveBar) -> Option<Table> {
    let one = robot.count(FINESSE[0]);
    (one == robot.count_from_behind(FINESSE[1])).then_some(one)
}

/// Without a budget nearly all are certified within a second; this one is ample and the same everywhere.
fn bounds(robot: &FiveBar) -> Option<Analysis> {
    let budget = Budget { boxes: Some(100_000), ..Budget::default() };
    match analyze(&five_bar(robot), &Options { budget, ..Options::default() }, &Control::unwatched()) {
        Ok(analysis) => Some(analysis),
        Err(AnalysisError::Slice(SliceError::Empty { .. })) => None,
        Err(error) => panic!("{robot:?}: {error}"),
    }
}

#[test]
fn random_five_bars_have_as_many_aspects_as_brute_force_finds() {
    let cases = std::env::var("ASPECTA_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(10);
    let (mut exact, mut compared) = (0, 0);
    for seed in 0..cases {
        let robot = random_five_bar(seed);
        let table = brute_force(&robot);
        if table.is_none() {
            println!("five-bar {seed}: brute force is not stable: {robot:?}");
        }
        let Some(analysis) = bounds(&robot) else {
            assert!(table.is_none_or(|table| table.values().all(|&n| n == 0)), "five-bar {seed}: {robot:?}");
            continue;
        };
        check_bounds(&analysis);
        if analysis.aspects.certified {
            exact += 1;
            compared += u64::from(table.is_some());
        } else {
            println!("five-bar {seed}: {:?} {:?} {robot:?}", analysis.aspects, analysis.doubts);
        }
        let Some(table) = table else { continue };
        for class in &analysis.classes {
            let (key, low) = entry(class, class.low);
            let found = table[&key];
            let agrees = low <= found && class.high.is_none_or(|high| found <= high);
            assert!(
                agrees,
                "five-bar {seed} {key:?}: {low}..{:?}, brute force {found}: {robot:?}",
                class.high
            );
        }
    }
    println!("{exact} of {cases} certified, {compared} of them compared with brute force");
    assert!(
        100 * exact >= 95 * cases && 100 * compared >= 90 * cases,
        "{exact} certified, {compared} compared"
    );
}

// Budgets.

#[test]
fn time_ends_a_run() {
    let budget = Budget { seconds: Some(1.0), ..Budget::default() };
    let analysis = analyzed(&find("3-rrr"), &Options { budget, ..Options::default() });
    check_bounds(&analysis);
    assert_eq!(analysis.run.stop, Stop::Time);
    assert!(!analysis.aspects.certified && analysis.aspects.low <= 16);
}

/// What ends a run is named.
#[test]
fn boxes_and_depth_end_a_run() {
    let boxes = Budget { boxes: Some(10_000), ..Budget::default() };
    let depth = Budget { depth: Some(4), ..Budget::default() };
    for (budget, stop) in [(boxes, Stop::Boxes), (depth, Stop::Resolution)] {
        let modes = vec!["+++".parse().unwrap()];
        let analysis = analyzed(&find("3-rrr"), &Options { budget, modes, ..Options::default() });
        check_bounds(&analysis);
        assert_eq!(analysis.run.stop, stop);
    }
}
