//! Robots of which two legs are one and the same: modes in which det A vanishes everywhere, and the others, counted.

use crate::random::Random;
use aspecta::Kinematics;
use aspecta::aspect::{Analysis, Options, Purpose, SingularMode, analyze};
use aspecta::num::{Interval, Scalar};
use aspecta::paving::{Budget, Control};
use aspecta::robot::{Leg, LegIndex, Limit, Platform, Robot, RodAngle, catalogue};
use aspecta::verify::verify;
use std::f64::consts::PI;

/// A five-bar with both motors on one axis.
fn coaxial(crank: f64, rod: f64) -> Robot {
    let leg = Leg::revolute([0.0, 0.0], [0.0, 0.0], crank, rod);
    Robot::new("coaxial", Platform::PlanePoint, vec![leg.clone(), leg]).unwrap()
}

/// The analysis of a robot, the certificate of which holds.
fn analyzed(robot: &Robot, fix: &[(usize, f64)]) -> Analysis {
    let modes = robot.working_modes().len();
    let budget = Budget { boxes: Some(2_000_000), ..Budget::default() };
    let options = Options {
        budget,
        fix: fix.to_vec(),
        certificate: modes <= 8,
        purpose: Purpose::Numbers,
        ..Options::default()
    };
    let analysis = analyze(robot, &options, &Control::unwatched()).unwrap();
    if let Some(certificate) = &analysis.certificate {
        let verdict = verify(certificate, &Control::unwatched());
        assert!(verdict.is_verified(), "{}: {:?}", robot.name, verdict.faults);
    }
    analysis
}

/// The number of aspects of each class, if it is certain.
fn exact(analysis: &Analysis) -> Vec<usize> {
    assert!(analysis.aspects.certified, "{:?} {:?}", analysis.aspects, analysis.doubts);
    analysis.classes.iter().map(|class| class.low).collect()
}

fn holds(low: f64, undecided: f64, right: f64) -> bool {
    low <= right && right <= low + undecided && undecided < 0.02 * right
}

/// A leg of a quadruped: the paper's Definition 5 excepts what is "zero everywhere", and the two other modes have an aspect each, the ring
/// between the circles of radius M − L and M + L.
#[test]
fn the_leg_of_a_quadruped() {
    let analysis = analyzed(&coaxial(0.1, 0.2), &[]);
    assert_eq!(exact(&analysis), [0, 0, 1, 0, 0, 0, 0, 1]);
    let ring = PI * (0.3f64.powi(2) - 0.1f64.powi(2));
    let regular = analysis.classes.iter().filter(|class| class.low > 0);
    assert!(regular.into_iter().all(|class| holds(class.measure, class.undecided, ring)));
    let modes: Vec<String> = analysis.singular_modes.iter().map(|found| found.mode.to_string()).collect();
    assert_eq!(modes, ["++", "--"]);
    for SingularMode { legs, low, high, measure, undecided, domains, .. } in &analysis.singular_modes {
        assert_eq!(
            (legs, *low, *high, domains.len()),
            (&[LegIndex::new(0), LegIndex::new(1)], 1, Some(1), 1)
        );
        assert!(holds(*measure, *undecided, ring));
        assert_eq!(domains[0].sample.q[0], domains[0].sample.q[1]);
    }
}

/// The ranks of A fall where the rods are in one line, ‖X‖² = L² − M²: with L > M the ring has such a circle within it.
#[test]
fn rods_in_one_line_part_the_ring() {
    let analysis = analyzed(&coaxial(0.2, 0.1), &[]);
    assert_eq!(exact(&analysis), [0, 0, 1, 1, 0, 0, 1, 1]);
    let [near, far] = [0.03 - 0.01, 0.09 - 0.03].map(|square| square * PI);
    let areas = analysis.classes.iter().filter(|class| class.low > 0).zip([far, near, near, far]);
    assert!(areas.into_iter().all(|(class, area)| holds(class.measure, class.undecided, area)));
}

/// Four equal links: where both legs fold up, in the middle, neither motor's angle is determined.
#[test]
fn equal_links() {
    let analysis = analyzed(&coaxial(0.15, 0.15), &[]);
    assert_eq!(exact(&analysis), [0, 0, 1, 0, 0, 0, 0, 1]);
    let regular = analysis.classes.iter().filter(|class| class.low > 0);
    assert!(regular.into_iter().all(|class| holds(class.measure, class.undecided, PI * 0.09)));
    // Rods that may not be in line keep it from the middle: the cosine of their angle is r²/2L² − 1.
    let mut printer = coaxial(0.15, 0.15);
    let cosines = [15.0f64, 165.0].map(|angle| Some(Interval::decimal(angle.to_radians().cos())));
    let legs = [LegIndex::new(0), LegIndex::new(1)];
    printer.rod_angles.push(RodAngle { legs, min_cos: cosines[0], max_cos: cosines[1] });
    let analysis = analyzed(&printer, &[]);
    assert_eq!(exact(&analysis), [0, 0, 1, 0, 0, 0, 0, 1]);
    assert!(analysis.singular_modes.iter().all(|found| (found.low, found.high) == (0, Some(0))));
    let ring = 2.0 * PI * 0.15f64.powi(2) * (15.0f64.to_radians().cos() - 165.0f64.to_radians().cos());
    let regular = analysis.classes.iter().filter(|class| class.low > 0);
    assert!(regular.into_iter().all(|class| holds(class.measure, class.undecided, ring)));
    // Limits of a motor can end in the middle: then nothing is said of it.
    let mut limited = coaxial(0.15, 0.15);
    let middle = (Interval::point(1.0), Interval::point(0.0));
    limited.legs[0].limits.push(Limit::ActuatorAngle { middle, half_cos: Interval::point(0.0), turns: 0 });
    let budget = Budget { boxes: Some(100_000), ..Budget::default() };
    let open = analyze(&limited, &Options { budget, ..Options::default() }, &Control::unwatched()).unwrap();
    assert!(open.aspects.low >= 2 && open.aspects.high.is_none(), "{:?}", open.aspects);
}

/// Limits of one leg: it bends to one side only.
#[test]
fn limits_of_one_of_the_legs() {
    let mut robot = coaxial(0.1, 0.2);
    let middle = (Interval::point(0.0), Interval::point(1.0));
    robot.legs[0].limits.push(Limit::Elbow { middle, half_cos: Interval::decimal(0.5) });
    let analysis = analyzed(&robot, &[]);
    assert_eq!(exact(&analysis).iter().sum::<usize>(), 1);
    let numbers: Vec<_> =
        analysis.singular_modes.iter().map(|m| (m.mode.to_string(), m.low, m.high)).collect();
    assert_eq!(numbers, [("++".to_owned(), 0, Some(0)), ("--".to_owned(), 1, Some(1))]);
}

/// In any robot of the catalogue with two legs made one, in a slice or as a whole: bounds are in order, certificates hold, and the classes
/// of det A < 0 are those of det A > 0 with the two legs exchanged.
#[test]
fn legs_of_the_catalogue_made_one() {
    for name in ["five-bar", "3-rrr", "2-prr", "irb-360"] {
        let mut robot = catalogue::find(name).unwrap();
        if name == "3-rrr" {
            // Equal links could fold: the bounds of two such legs need not meet.
            robot.legs[0].actuator = Leg::revolute([0.0; 2], [0.0; 2], 10.0, 9.0).actuator;
        }
        robot.legs[1] = robot.legs[0].clone();
        let fix: &[_] = match name {
            "3-rrr" => &[(2, 0.2)],
            "irb-360" => &[(2, -900.0)],
            _ => &[],
        };
        let analysis = analyzed(&robot, fix);
        let counts = exact(&analysis);
        assert!(counts.iter().sum::<usize>() >= 2, "{name}: {counts:?}");
        for class in &analysis.classes {
            if class.mode.sign(0) == class.mode.sign(1) {
                assert_eq!((class.low, class.measure, class.undecided), (0, 0.0, 0.0), "{name}");
                continue;
            }
            let [first, second] = [0, 1].map(LegIndex::new);
            let exchanged = class.mode.with_other_posture(first).with_other_posture(second);
            let other = analysis.class_of(exchanged, class.det_a.opposite()).unwrap();
            assert_eq!(analysis.classes[other.index()].low, class.low, "{name}, {}", class.mode);
        }
    }
}

/// Equal tolerances are no equal numbers, and 0.1 mm between two motors is enough.
#[test]
fn legs_that_are_nearly_one_are_two() {
    let mut robot = coaxial(0.1, 0.2);
    assert_eq!(robot.twins().len(), 1);
    robot.legs[1].anchor[0] = Interval::decimal(1e-4);
    assert!(robot.twins().is_empty());
    let mut robot = coaxial(0.1, 0.2);
    for leg in &mut robot.legs {
        leg.anchor[0] = Interval::new(-1e-9, 1e-9);
    }
    assert!(robot.twins().is_empty());
}

/// Nor does it to the counts, though the enclosures of what the two legs have in common are others then.
#[test]
fn counts_do_not_depend_on_where_a_motor_counts_from() {
    let mut robot = catalogue::find("irb-360").unwrap();
    robot.legs[1] = robot.legs[0].clone();
    robot.legs[1].limits.clear();
    let counted = |robot: &Robot| {
        let options = Options { fix: vec![(2, -900.0)], ..Options::default() };
        exact(&analyze(robot, &options, &Control::unwatched()).unwrap())
    };
    let alike = counted(&robot);
    let [u, v, _] = robot.legs[1].frame;
    let (sin, cos) = Interval::point(0.7).sin_cos();
    let turned = |a: Interval, b: Interval| [cos * a + sin * b, cos * b - sin * a];
    for k in 0..3 {
        [robot.legs[1].frame[0][k], robot.legs[1].frame[1][k]] = turned(u[k], v[k]);
    }
    assert_eq!(robot.twins().len(), 1);
    assert_eq!(counted(&robot), alike);
}

/// Where the zero of a motor's angle is does not matter.
#[test]
fn a_motor_may_count_from_elsewhere() {
    let mut robot = catalogue::find("delta").unwrap();
    robot.legs[2] = robot.legs[0].clone();
    let [u, v, _] = robot.legs[2].frame;
    (robot.legs[2].frame[0], robot.legs[2].frame[1]) = (v, u.map(|x| -x));
    assert_eq!(robot.twins(), [[LegIndex::new(0), LegIndex::new(2)]]);
    assert!(robot.check().is_ok());
    let random = &mut Random(5);
    let pose: Vec<f64> =
        [(-100.0, 100.0), (-100.0, 100.0), (-900.0, -700.0)].map(|(lo, hi)| random.within(lo, hi)).to_vec();
    for found in robot.inverse(&pose).unwrap() {
        let is_singular = found.mode.sign(0) == found.mode.sign(2);
        assert_eq!(robot.state(&pose, &found.q).unwrap().parallel_measure < 1e-9, is_singular);
    }
}
