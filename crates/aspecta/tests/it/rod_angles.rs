//! Limits that two legs share: the angle between their rods.

use crate::random::Random;
use aspecta::Kinematics;
use aspecta::aspect::{Analysis, Options, Purpose, analyze};
use aspecta::kinematics::constraints::Constraint;
use aspecta::motion::{Bound, Obstacle, PathOptions, check_poses};
use aspecta::num::Interval;
use aspecta::paving::Control;
use aspecta::robot::{Leg, LegIndex, Platform, Robot, RodAngle, catalogue};
use aspecta::verify::verify;

/// A limit of the angle between the rods of two legs, in degrees.
fn between(legs: [usize; 2], min: f64, max: f64) -> RodAngle {
    let cos = |degrees: f64| Interval::decimal(degrees.to_radians().cos());
    RodAngle {
        legs: legs.map(LegIndex::new),
        min_cos: (min > 0.0).then(|| cos(min)),
        max_cos: (max < 180.0).then(|| if max == 90.0 { Interval::point(0.0) } else { cos(max) }),
    }
}

/// The analysis of a robot, or of some of its modes (none: all), the certificate of which holds.
fn analyzed(robot: &Robot, fix: &[(usize, f64)], modes: &[&str]) -> Analysis {
    let modes = modes.iter().map(|mode| mode.parse().unwrap()).collect();
    let options = Options {
        fix: fix.to_vec(),
        modes,
        certificate: true,
        purpose: Purpose::Numbers,
        ..Options::default()
    };
    let analysis = analyze(robot, &options, &Control::unwatched()).unwrap();
    let verdict = verify(analysis.certificate.as_ref().unwrap(), &Control::unwatched());
    assert!(verdict.is_verified(), "{}: {:?}", robot.name, verdict.faults);
    analysis
}

/// The number of aspects of each class, counted without a proof to check.
fn counted(robot: &Robot) -> Vec<usize> {
    exact(&analyze(robot, &Options::default(), &Control::unwatched()).unwrap())
}

/// The number of aspects of each class, if it is certain.
fn exact(analysis: &Analysis) -> Vec<usize> {
    assert!(analysis.aspects.certified, "{:?} {:?}", analysis.aspects, analysis.doubts);
    analysis.classes.iter().map(|class| class.low).collect()
}

/// The paper's five-bar, elsewhere and in another unit, with rods at most 90° apart.
fn five_bar(at: [[f64; 2]; 2], scale: f64) -> Robot {
    let leg = |at: [f64; 2], crank: f64, rod: f64| Leg::revolute(at, [0.0; 2], crank * scale, rod * scale);
    let legs = vec![leg(at[0], 8.0, 5.0), leg(at[1], 5.0, 8.0)];
    let mut robot = Robot::new("five-bar", Platform::PlanePoint, legs).unwrap();
    robot.rod_angles.push(between([0, 1], 0.0, 90.0));
    robot
}

/// At P the directions to the two elbows are at most 90° apart, either way: twelve aspects, wherever the robot stands, whatever its unit.
#[test]
fn rods_of_the_five_bar_at_most_a_right_angle_apart() {
    let expected = exact(&analyzed(&five_bar([[0.0, 0.0], [9.0, 0.0]], 1.0), &[], &[]));
    assert_eq!(expected.iter().sum::<usize>(), 12);
    let moved = counted(&five_bar([[-3.0, 2.0], [2.4, 9.2]], 1.0));
    let scaled = counted(&five_bar([[0.0, 0.0], [0.9, 0.0]], 0.1));
    assert_eq!((&moved, &scaled), (&expected, &expected));
    // A mirror changes the postures of both legs and the sign of det A; exchanged legs exchange signs.
    let mirrored = five_bar([[0.0, 0.0], [-9.0, 0.0]], 1.0);
    assert_eq!(counted(&mirrored).iter().sum::<usize>(), 12);
    let mut renumbered = five_bar([[0.0, 0.0], [9.0, 0.0]], 1.0);
    renumbered.legs.swap(0, 1);
    assert_eq!(counted(&renumbered).iter().sum::<usize>(), 12);
}

/// Limits, in a slice of a body that turns, of two pairs of legs at once, together with others.
#[test]
fn rods_of_a_body() {
    limit_rods_of_a_body(&["+-+", "--+"]);
}

#[test]
#[ignore = "half a minute: all modes"]
fn rods_of_a_body_in_all_modes() {
    limit_rods_of_a_body(&[]);
}

fn limit_rods_of_a_body(modes: &[&str]) {
    let mut robot = catalogue::find("3-rrr").unwrap();
    for (leg, rod) in robot.legs.iter_mut().zip([9.0, 8.0, 11.0]) {
        leg.actuator = Leg::revolute([0.0; 2], [0.0; 2], 10.0, rod).actuator;
    }
    robot.rod_angles = vec![between([0, 1], 20.0, 150.0), between([1, 2], 0.0, 120.0)];
    let limited = analyzed(&robot, &[(2, 0.3)], modes);
    exact(&limited);
    robot.rod_angles.clear();
    let free = analyzed(&robot, &[(2, 0.3)], modes);
    let area = |analysis: &Analysis| analysis.classes.iter().map(|class| class.measure).sum::<f64>();
    assert!(area(&limited) < 0.8 * area(&free));
}

/// Every solution is told to be within limits just if the angle between its rods, from B to C, is.
#[test]
fn solutions_within_limits_have_rods_within_theirs() {
    let random = &mut Random(3);
    let (mut within, mut beyond) = (0, 0);
    for name in ["five-bar", "2-prr", "3-rrr", "3-prr", "delta", "linear-delta", "orthoglide", "hexa"] {
        let mut robot = catalogue::find(name).unwrap();
        robot.legs.iter_mut().for_each(|leg| leg.limits.clear());
        let last = robot.dof() - 1;
        robot.rod_angles = vec![between([0, 1], 15.0, 110.0), between([last, 0], 0.0, 140.0)];
        let reach = 3.0 * robot.characteristic_length();
        for _ in 0..400 {
            let coordinates = robot.platform.coordinates();
            let end = |angle: bool| if angle { 1.5 } else { reach };
            let pose: Vec<f64> =
                coordinates.iter().map(|c| random.within(-end(c.angle), end(c.angle))).collect();
            for found in robot.inverse(&pose).unwrap() {
                let rods: Vec<[f64; 3]> = (0..robot.dof()).map(|j| rod(&robot, &pose, &found.q, j)).collect();
                let keeps = robot.rod_angles.iter().all(|limit| {
                    let [a, b] = limit.legs.map(|leg| rods[leg.index()]);
                    let dot: f64 = a.iter().zip(b).map(|(a, b)| a * b).sum();
                    let norm = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
                    let cos = dot / (norm(a) * norm(b));
                    limit.min_cos.is_none_or(|min| cos < min.mid())
                        && limit.max_cos.is_none_or(|max| cos > max.mid())
                });
                assert_eq!(found.within_limits, keeps, "{name} {pose:?} {:?}", found.q);
                (within, beyond) = (within + usize::from(keeps), beyond + usize::from(!keeps));
            }
        }
    }
    assert!(within > 300 && beyond > 300, "{within} {beyond}");
}

/// C − B of a leg, from the drawing of the robot.
fn rod(robot: &Robot, pose: &[f64], q: &[f64], j: usize) -> [f64; 3] {
    let a = robot.jacobians(pose, q).unwrap().a;
    // ∂f/∂C = 2 (C − B).
    let space = robot.platform.space();
    std::array::from_fn(|k| if k < space { a[j][k] } else { 0.0 })
}

/// A Delta whose rods are kept from becoming parallel has no surface on which det A vanishes twice.
#[test]
fn rods_kept_apart_are_not_parallel() {
    let robot = catalogue::find("delta").unwrap();
    let window = robot.slice(&[]).unwrap();
    assert!(!aspecta::kinematics::parallel_rods::parallel_rods(&robot, &window).is_empty());
    let mut limited = robot;
    limited.rod_angles = vec![between([0, 1], 5.0, 180.0)];
    assert!(aspecta::kinematics::parallel_rods::parallel_rods(&limited, &window).is_empty());
    limited.rod_angles = vec![between([0, 1], 0.0, 170.0)];
    assert!(!aspecta::kinematics::parallel_rods::parallel_rods(&limited, &window).is_empty());
}

/// A path that comes to det A = 0, where the rods of a five-bar are in line, meets the limit before, where the angle between them is at its
/// end.
#[test]
fn paths_meet_the_limit_before_the_singularity() {
    let mut robot = five_bar([[0.0, 0.0], [9.0, 0.0]], 1.0);
    robot.rod_angles = vec![between([0, 1], 15.0, 165.0)];
    let random = &mut Random(9);
    let mut met = 0;
    for _ in 0..400 {
        let mut pose = || vec![random.within(-3.0, 12.0), random.within(-8.0, 8.0)];
        let (from, to) = (pose(), pose());
        let Some(start) = robot.inverse(&from).unwrap().into_iter().find(|found| found.within_limits) else {
            continue;
        };
        let check = check_poses(&robot, &[from, to], start.mode, &PathOptions::default()).unwrap();
        let obstacles: Vec<&Obstacle> = check.obstacle.iter().chain(&check.further).collect();
        let at = |wanted: fn(&Constraint) -> bool| {
            let fits = |o: &&&Obstacle| matches!(&o.bound, Bound::Constraint(found) if wanted(found));
            obstacles.iter().find(fits).map(|o| o.t.0)
        };
        let limit = at(|found| matches!(found, Constraint::RodAngle(..)));
        let singular = at(|found| *found == Constraint::Det);
        if let Some(singular) = singular {
            assert!(limit.is_some_and(|limit| limit < singular), "{obstacles:?}");
            met += 1;
        }
        if let Some(t) = limit {
            assert_eq!(check.within_limits, Some(false));
            assert!(t > 0.0);
        }
    }
    assert!(met > 30, "{met}");
}

/// The five-bar's file with this limit.
fn with_limit(limit: &str) -> Result<Robot, String> {
    let five_bar = catalogue::all().iter().find(|entry| entry.name == "five-bar").unwrap().text;
    Robot::from_toml(&format!("{five_bar}\n[[rod-angles]]\n{limit}\n"), "printer.toml")
        .map_err(|error| error.to_string())
}

#[test]
fn in_robot_files() {
    let robot = with_limit("legs = [2, 1]\nangle = { deg = [15, 165] }").unwrap();
    assert_eq!(robot.rod_angles[0].in_words(), "rods of legs 2 and 1 from 0.2618 to 2.8798 rad apart");
    let robot = with_limit("legs = [1, 2]\nangle = { rad = [0, 1.5] }").unwrap();
    assert!(robot.rod_angles[0].min_cos.is_none() && robot.rod_angles[0].max_cos.is_some());
    for (limit, said) in [
        ("legs = [1, 3]\nangle = { deg = [15, 165] }", "two numbers from 1 to 2"),
        ("legs = [1, 1]\nangle = { deg = [15, 165] }", "two different legs"),
        ("legs = [1]\nangle = { deg = [15, 165] }", "two different legs"),
        ("legs = [1, 1.5]\nangle = { deg = [15, 165] }", "two numbers from 1 to 2"),
        ("legs = [1, 2]\nangle = { deg = [-15, 165] }", "from 0° to 180°"),
        ("legs = [1, 2]\nangle = { deg = [15, 190] }", "from 0° to 180°"),
        ("legs = [1, 2]\nangle = { deg = [0, 180] }", "limits nothing"),
        ("legs = [1, 2]\nangle = { deg = [60, 30] }", "contradictory"),
        ("legs = [1, 2]", "missing key `angle`"),
        ("angle = { deg = [15, 165] }", "missing key `legs`"),
        ("legs = [1, 2]\nangles = { deg = [15, 165] }", "unknown key"),
    ] {
        let refused = with_limit(limit).expect_err(limit);
        assert!(refused.contains(said) && refused.contains("printer.toml:"), "{limit}: {refused}");
    }
    let strut = catalogue::all().iter().find(|entry| entry.name == "3-rpr").unwrap().text;
    let text = format!("{strut}\n[[rod-angles]]\nlegs = [1, 2]\nangle = {{ deg = [15, 165] }}\n");
    assert!(Robot::from_toml(&text, "x.toml").unwrap_err().to_string().contains("has no rod"));
}
