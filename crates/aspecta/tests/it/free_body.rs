//! Slices of robots with six degrees of freedom: held against matrices written out by hand, dense sampling, and themselves.

use aspecta::Kinematics;
use aspecta::aspect::{Analysis, AnalysisError, AspectId, ClassId, Options, Place, analyze};
use aspecta::kinematics::{Solution, WorkingMode};
use aspecta::paving::{Budget, Control};
use aspecta::robot::{Actuator, Revolute, Robot, catalogue};
use nalgebra::{DMatrix, Rotation3, Vector3};
use std::f64::consts::FRAC_PI_2;

fn analyzed(robot: &Robot, fix: &[(usize, f64)], modes: &[&str], budget: Budget) -> Analysis {
    let modes = modes.iter().map(|mode| mode.parse().unwrap()).collect();
    let options = Options { budget, fix: fix.to_vec(), modes, ..Options::default() };
    analyze(robot, &options, &Control::unwatched()).unwrap()
}

fn boxes(count: u64) -> Budget {
    Budget { boxes: Some(count), ..Budget::default() }
}

fn depth(depth: u32) -> Budget {
    Budget { depth: Some(depth), ..Budget::default() }
}

fn robot(name: &str) -> Robot {
    catalogue::find(name).unwrap()
}

/// Orientation, position, both in part, a line.
const GOUGH_SLICES: [&[(usize, f64)]; 5] = [
    &[(3, 0.0), (4, 0.0), (5, 0.0)],
    &[(0, 0.4), (1, 0.3), (2, 0.6)],
    &[(1, 0.2), (3, 0.3), (5, -0.4)],
    &[(0, 0.5), (3, 0.1), (4, -0.2), (5, 0.4)],
    &[(0, 0.1), (1, 0.2), (2, 0.9), (3, 0.2), (4, 0.3)],
];
const HEXA_SLICES: [&[(usize, f64)]; 4] = [
    &[(3, 0.1), (4, -0.2), (5, 0.3)],
    &[(0, 0.0), (1, 0.0), (2, -600.0)],
    &[(2, -550.0), (3, 0.1), (4, 0.0), (5, 0.2)],
    &[(0, 30.0), (1, -20.0), (3, 0.1), (4, 0.2), (5, 0.0)],
];

/// The i-th sample of the poses an analysis is over.
fn pose(analysis: &Analysis, i: u32) -> Vec<f64> {
    const STEP: [f64; 6] =
        [0.754_877_666, 0.569_840_291, 0.430_159_709, 0.618_033_989, 0.847_179_244, 0.381_966_011];
    let part = |k: usize| (f64::from(i + 1) * STEP[k]).fract();
    let ranges = analysis.window.ranges.iter().enumerate();
    ranges.map(|(k, r)| if r.0 == r.1 { r.0 } else { r.0 + part(k) * (r.1 - r.0) }).collect()
}

/// det A relative to its rows, from points and rods worked out here: a leg's row is the wrench of its rod.
fn det_by_hand(robot: &Robot, pose: &[f64], q: &[f64]) -> f64 {
    let turn = Rotation3::from_euler_angles(pose[3], pose[4], pose[5]);
    let origin = Vector3::new(pose[0], pose[1], pose[2]);
    let vector = |v: &[aspecta::num::Interval; 3]| Vector3::from(v.map(|x| x.mid()));
    let mut rows = DMatrix::zeros(6, 6);
    for (j, leg) in robot.legs.iter().enumerate() {
        let arm = turn * vector(&leg.attachment);
        let [u, v, _] = leg.frame.each_ref().map(vector);
        let elbow = match leg.actuator {
            Actuator::Revolute(Revolute { crank, .. }) => crank.mid() * (q[j].cos() * u + q[j].sin() * v),
            Actuator::Prismatic(_) => q[j] * u,
            _ => Vector3::zeros(),
        };
        let rod = (origin + arm - vector(&leg.anchor) - elbow).normalize();
        let moment = arm.cross(&rod);
        for k in 0..3 {
            (rows[(j, k)], rows[(j, 3 + k)]) = (rod[k], moment[k]);
        }
    }
    let size: f64 = rows.row_iter().map(|row| row.norm()).product();
    rows.determinant() / size
}

/// Below this a sign says nothing.
const NOISE: f64 = 1e-11;

/// Every decided cell says what configurations worked out in doubles say; returns how many samples in a class lay in cells of it.
fn check_cells(analysis: &Analysis, samples: u32) -> (usize, usize) {
    let robot = &analysis.robot;
    let (mut decided, mut members) = (0, 0);
    for i in 0..samples {
        let x = pose(analysis, i);
        let solutions: Vec<_> = robot.inverse(&x).unwrap().into_iter().filter(|s| s.within_limits).collect();
        for (k, class) in analysis.classes.iter().enumerate() {
            let found = solutions.iter().find(|s| s.mode == class.mode);
            let det = found.map_or(-1.0, |s| det_by_hand(robot, &x, &s.q) * f64::from(class.det_a.factor()));
            members += usize::from(det > NOISE);
            let place = analysis.locate(&x, ClassId::new(k));
            let said = format!("{} {} {x:?}: {place:?}, {det}", class.mode, class.det_a);
            match place {
                Place::Inside(id) => {
                    decided += 1;
                    assert!(det > -NOISE, "{said}");
                    assert!(class.aspects.iter().any(|aspect| aspect.id == id), "{said}");
                }
                Place::Outside => assert!(det < NOISE, "{said}"),
                Place::Undecided => {}
            }
        }
    }
    (decided, members)
}

#[test]
fn cells_of_slices_of_the_gough_stewart_platform_have_the_signs_of_its_matrices() {
    let mut robot = robot("gough-stewart");
    robot.window =
        [(0.0, 0.8), (-0.4, 0.4), (-1.6, -0.8), (-0.5, 0.5), (-0.5, 0.5), (-0.5, 0.5)].map(Some).to_vec();
    for fix in GOUGH_SLICES {
        let fix: Vec<_> = fix.iter().map(|&(k, x)| (k, if k == 2 { -1.2 } else { x })).collect();
        let analysis = analyzed(&robot, &fix, &[], boxes(40_000));
        let (decided, members) = check_cells(&analysis, 3000);
        assert!(members > 100 && 3 * decided > members, "{fix:?}: {decided} of {members}");
    }
}

#[test]
fn cells_of_slices_of_the_hexa_have_the_signs_of_its_matrices() {
    let mut robot = robot("hexa");
    robot.window =
        [(-150.0, 150.0), (-150.0, 150.0), (-750.0, -500.0), (-0.4, 0.4), (-0.4, 0.4), (-0.4, 0.4)]
            .map(Some)
            .to_vec();
    for fix in HEXA_SLICES {
        let analysis = analyzed(&robot, fix, &["------", "-+-+-+", "++++++"], boxes(20_000));
        let (decided, members) = check_cells(&analysis, 1000);
        assert!(members > 100 && 3 * decided > members, "{fix:?}: {decided} of {members}");
    }
}

/// The stretches of one sign along a line, sampled; a line that is `closed` has none at its ends.
fn stretches(inside: &[bool], closed: bool) -> usize {
    let n = inside.len();
    (0..n).filter(|&i| inside[i] && (i == 0 && !closed || !inside[(i + n - 1) % n])).count()
}

/// In one dimension brute force can be trusted: no fewer aspects than there are stretches of one sign, each where its sample lies, and
/// between two of them a pose that is in none.
#[test]
fn lines_are_cut_where_the_sign_changes() {
    const SAMPLES: usize = 2000;
    let (mut total, mut equal, mut classes) = (0, 0, 0);
    for (name, free, start) in [
        ("gough-stewart", 2, [0.3, 0.2, 0.9, 0.2, 0.3, 0.1]),
        ("gough-stewart", 3, [0.3, 0.2, 0.6, 0.0, 0.3, 0.1]),
        ("gough-stewart", 4, [0.3, 0.2, 0.6, 0.4, 0.0, 0.1]),
        ("hexa", 0, [0.0, 20.0, -600.0, 0.1, 0.2, 0.3]),
        ("hexa", 5, [10.0, 20.0, -600.0, 0.1, 0.2, 0.0]),
    ] {
        let robot = robot(name);
        let fix: Vec<_> = (0..6).filter(|&k| k != free).map(|k| (k, start[k])).collect();
        let analysis = analyzed(&robot, &fix, &[], Budget::default());
        assert!(analysis.aspects.certified, "{name} {free}: {:?}", analysis.doubts);
        let pose = |x: f64| {
            let mut pose = start.to_vec();
            pose[free] = x;
            pose
        };
        let (lo, hi) = analysis.window.ranges[free];
        let grid =
            |lo: f64, hi: f64| (0..SAMPLES).map(move |i| lo + (hi - lo) * (i as f64 + 0.5) / SAMPLES as f64);
        let solutions: Vec<_> = grid(lo, hi).map(|x| robot.inverse(&pose(x)).unwrap()).collect();
        for class in &analysis.classes {
            let holds = |solutions: &[Solution]| {
                let sign = f64::from(class.det_a.factor());
                solutions.iter().any(|s| s.within_limits && s.mode == class.mode && s.det_a * sign > 0.0)
            };
            let said = format!("{name} {free}: {} {}", class.mode, class.det_a);
            let inside: Vec<bool> = solutions.iter().map(|s| holds(s)).collect();
            let count = stretches(&inside, analysis.window.glued[free]);
            assert!(count <= class.low, "{said}: {count} stretches, {} aspects", class.low);
            (equal, classes, total) =
                (equal + usize::from(count == class.low), classes + 1, total + class.low);
            let mut samples: Vec<f64> = class.aspects.iter().map(|aspect| aspect.sample.pose[free]).collect();
            samples.sort_by(f64::total_cmp);
            assert!(samples.iter().all(|&x| holds(&robot.inverse(&pose(x)).unwrap())), "{said}");
            for pair in samples.windows(2) {
                let apart = grid(pair[0], pair[1]).any(|x| !holds(&robot.inverse(&pose(x)).unwrap()));
                assert!(apart, "{said}: {pair:?}");
            }
        }
    }
    assert!(total > 100 && 10 * equal > 9 * classes, "{total} aspects, {equal} of {classes}");
}

/// Legs in another order are the same robot: equal bounds where they are exact, and no cell is inside here and outside there.
#[test]
fn the_order_of_the_legs_does_not_matter() {
    const ORDER: [usize; 6] = [2, 0, 1, 4, 3, 5];
    for (name, fix, modes, budget) in [
        ("gough-stewart", GOUGH_SLICES[3], vec!["------"], Budget::default()),
        ("hexa", HEXA_SLICES[2], vec!["-+-+--", "------"], depth(6)),
    ] {
        let robot = robot(name);
        let other =
            Robot::new(name, robot.platform, ORDER.iter().map(|&j| robot.legs[j].clone()).collect()).unwrap();
        let moved = |mode: &&str| ORDER.iter().map(|&j| &mode[j..=j]).collect::<String>();
        let others: Vec<String> = modes.iter().map(moved).collect();
        let here = analyzed(&robot, fix, &modes, budget);
        let there = analyzed(&other, fix, &others.iter().map(String::as_str).collect::<Vec<_>>(), budget);
        assert_eq!(here.aspects.certified, there.aspects.certified, "{name}");
        let is_odd =
            (0..6).flat_map(|i| (0..i).map(move |j| (i, j))).filter(|&(i, j)| ORDER[j] > ORDER[i]).count()
                % 2
                == 1;
        for (k, class) in here.classes.iter().enumerate() {
            let swapped = if is_odd { class.det_a.opposite() } else { class.det_a };
            let mode: WorkingMode = moved(&&*class.mode.to_string()).parse().unwrap();
            let twin = there.class_of(mode, swapped).unwrap();
            let other = &there.classes[twin.index()];
            let low = (class.low, other.low);
            let high = (class.high.unwrap_or(usize::MAX), other.high.unwrap_or(usize::MAX));
            assert!(low.0 <= high.1 && low.1 <= high.0, "{name} {mode}: {low:?} {high:?}");
            if class.high == Some(class.low) && other.high == Some(other.low) {
                assert_eq!(low.0, low.1);
            }
            for i in 0..2000 {
                let x = pose(&here, i);
                let inside = |place: Place| matches!(place, Place::Inside(_));
                let places = [here.locate(&x, ClassId::new(k)), there.locate(&x, twin)];
                for [a, b] in [places, [places[1], places[0]]] {
                    assert!(!(inside(a) && b == Place::Outside), "{name} {mode}: {x:?}");
                }
            }
        }
    }
}

/// 64 working modes in one analysis are those of 64 analyses.
#[test]
fn more_modes_than_one_pass_takes_are_all_analysed() {
    let robot = robot("hexa");
    let all = analyzed(&robot, HEXA_SLICES[3], &[], Budget::default());
    assert_eq!((all.modes.len(), all.classes.len(), all.pavings.len()), (64, 128, 8));
    assert_eq!(all.modes.iter().map(|m| m.mode).collect::<Vec<_>>(), robot.working_modes());
    let mut id = 0;
    for (k, class) in all.classes.iter().enumerate() {
        for aspect in &class.aspects {
            id += 1;
            assert_eq!(aspect.id, AspectId::new(id));
            assert_eq!(all.locate(&aspect.sample.pose, ClassId::new(k)), Place::Inside(AspectId::new(id)));
        }
    }
    for name in ["++++++", "-+-+-+", "+--+-+", "------"] {
        let one = analyzed(&robot, HEXA_SLICES[3], &[name], Budget::default());
        for class in &one.classes {
            let twin = &all.classes[all.class_of(class.mode, class.det_a).unwrap().index()];
            assert_eq!((twin.low, twin.high), (class.low, class.high), "{name}");
        }
        assert_eq!(
            one.modes[0].number,
            1 + robot.working_modes().iter().position(|m| *m == one.modes[0].mode).unwrap()
        );
    }
    assert!(all.parallel_aspects.is_empty() && all.serial_aspects.is_empty());
}

/// At pitch 90° one orientation has many names: whichever is asked, it lies in the same aspect.
#[test]
fn orientations_at_the_pole_have_one_aspect_by_all_their_names() {
    let mut robot = robot("gough-stewart");
    robot.legs.iter_mut().for_each(|leg| leg.limits.clear());
    (robot.window[3], robot.window[5]) = (Some((-0.8, 0.8)), Some((-0.8, 0.8)));
    robot.window[4] = Some((1.4, FRAC_PI_2));
    let analysis = analyzed(&robot, GOUGH_SLICES[1], &[], boxes(40_000));
    assert!(analysis.aspects.high.is_none_or(|high| analysis.aspects.low <= high));
    let mut named = 0;
    for (k, class) in analysis.classes.iter().enumerate() {
        for difference in -14..=14 {
            let mut seen = std::collections::BTreeSet::new();
            for name in -14..=14 {
                let yaw = 0.05 * f64::from(name);
                let x = [0.4, 0.3, 0.6, yaw + 0.05 * f64::from(difference), FRAC_PI_2 - 1e-9, yaw];
                if let Place::Inside(id) = analysis.locate(&x, ClassId::new(k)) {
                    seen.insert(id);
                    named += 1;
                }
            }
            assert!(seen.len() <= 1, "{} {difference}: {seen:?}", class.det_a);
        }
    }
    assert!(named > 50, "{named} names at the pole were decided");
}

/// A slice that holds roll or yaw ends at pitch ±90°; one that holds neither, or both are free, goes on there.
#[test]
fn slices_that_hold_roll_or_yaw_end_at_the_poles() {
    for (name, first) in [("spherical-3-rrr", 0), ("gough-stewart", 3)] {
        let robot = robot(name);
        let position: Vec<(usize, f64)> = (0..first).map(|k| (k, 0.4)).collect();
        let cut = |held: &[(usize, f64)]| {
            let window = robot.slice(&[&position[..], held].concat()).unwrap();
            window.cut[first + 1]
        };
        assert_eq!(cut(&[]), (false, false));
        assert_eq!(cut(&[(first, 0.1)]), (true, true));
        assert_eq!(cut(&[(first + 2, 0.1)]), (true, true));
        assert_eq!(cut(&[(first, 0.1), (first + 2, 0.1)]), (true, true));
        assert_eq!(cut(&[(first + 1, 0.1)]), (false, false));
    }
}

#[test]
fn what_cannot_be_analysed_is_refused_with_a_slice_that_can() {
    let robot = robot("hexa");
    let attempt = |fix: &[(usize, f64)], certificate| {
        let options = Options { fix: fix.to_vec(), certificate, budget: boxes(100), ..Options::default() };
        analyze(&robot, &options, &Control::unwatched())
    };
    let Err(AnalysisError::Dimension { dof: 6, free: 6, hold, .. }) = attempt(&[], false) else { panic!() };
    assert_eq!(hold, "roll=0,pitch=0,yaw=0");
    let Err(AnalysisError::Dimension { free: 5, hold, .. }) = attempt(&[(2, -600.5)], false) else {
        panic!()
    };
    assert_eq!(hold, "z=-600.5,pitch=0,yaw=0");
    assert!(attempt(&[(3, 0.0), (4, 0.0), (5, 0.0)], false).is_ok());
    let slice = [(3, 0.0), (4, 0.0), (5, 0.0)];
    assert!(matches!(attempt(&slice, true), Err(AnalysisError::Certificate { modes: 64, .. })));
}
