//! Within a working mode.

use super::*;
use crate::obstacles;
use crate::random::{self, Spread};
use aspecta::Kinematics;
use aspecta::kinematics::constraints::Margins;
use aspecta::motion::plan::{End, PlanOptions, Planner, Refusal};
use aspecta::motion::{Joined, PathOptions, check_poses};
use aspecta::robot::{LegIndex, Platform};

/// How many random pairs of poses were planned, proved apart, and left undecided.
fn pairs(robot: &Robot, depth: u32, signs: &str, count: usize) -> [usize; 3] {
    let analysis = analysed(robot, depth, &[signs]);
    let mode = mode(signs);
    let mut planner = Planner::new(&analysis);
    let mut random = Random(7);
    let mut seen = [0; 3];
    for _ in 0..count {
        let [start, goal] = [(); 2].map(|()| pose_in(&analysis, mode, &mut random).unwrap());
        match planner.plan(&start, &goal, mode, &PlanOptions::default()) {
            Ok(plan) => {
                seen[0] += 1;
                assert_sound(robot, &plan);
                assert!(same_pose(robot, &plan.waypoints[0], &start), "{start:?} {plan:?}");
                assert!(
                    same_pose(robot, &plan.waypoints[plan.waypoints.len() - 1], &goal),
                    "{goal:?} {plan:?}"
                );
            }
            Err(refusal) if refusal.is_proof() => {
                seen[1] += 1;
                assert_explained(&analysis, mode, [&start, &goal], &refusal);
            }
            Err(_) => seen[2] += 1,
        }
    }
    seen
}

/// A proof names what samples see too.
fn assert_explained(analysis: &Analysis, mode: WorkingMode, ends: [&[f64]; 2], refusal: &Refusal) {
    let det = |pose: &[f64]| {
        analysis.robot.inverse(pose).unwrap().into_iter().find(|s| s.mode == mode).map(|s| s.det_a)
    };
    match refusal {
        Refusal::OppositeSigns(sign) => {
            assert_eq!(det(ends[0]).unwrap() > 0.0, sign.factor() > 0);
            assert!(det(ends[0]).unwrap() * det(ends[1]).unwrap() < 0.0);
        }
        Refusal::DifferentAspects { start, goal, .. } => {
            assert_ne!(start, goal);
            assert!(det(ends[0]).unwrap() * det(ends[1]).unwrap() > 0.0);
        }
        other => panic!("poses within reach and limits: {other}"),
    }
}

#[test]
fn random_pairs_are_planned_or_proved_apart() {
    for (name, depth, signs) in [
        ("five-bar", 10, "++"),
        ("five-bar", 10, "+-"),
        ("symmetric-five-bar", 10, "-+"),
        ("2-prr", 10, "++"),
        ("3-rpr", 6, "---"),
        ("linear-delta", 6, "+++"),
        ("irb-360", 6, "---"),
    ] {
        let [planned, apart, undecided] = pairs(&robot(name), depth, signs, 60);
        println!("{name} {signs}: {planned} planned, {apart} proved apart, {undecided} undecided");
        assert!(planned > 0, "{name} {signs}");
        assert_eq!(undecided, 0, "{name} {signs}");
    }
}

#[test]
#[ignore = "minutes: ten thousand pairs in the aspects of the 3-RRR"]
fn ten_thousand_pairs_of_the_3_rrr() {
    for signs in ["+++", "++-", "+--", "+-+"] {
        let [planned, apart, undecided] = pairs(&robot("3-rrr"), 7, signs, 2500);
        println!("{signs}: {planned} planned, {apart} proved apart, {undecided} undecided");
        assert!(undecided * 100 < planned, "{signs}: {undecided} undecided");
    }
}

/// Round a disc, and with links that keep clear of one another.
fn cells() -> [Robot; 2] {
    let links = "[bodies]\nradius = 0.3\n";
    [obstacles::disc([4.5, 0.0], 1.0), format!("{links}{}", obstacles::disc([3.0, 7.0], 0.4))]
        .map(|tables| obstacles::with("five-bar", &tables))
}

#[test]
fn round_obstacles_pairs_are_planned_or_proved_apart() {
    for robot in cells() {
        let [planned, apart, undecided] = pairs(&robot, 10, "+-", 60);
        println!("{planned} planned, {apart} proved apart, {undecided} undecided");
        assert!(planned > 0 && undecided < 12);
    }
}

#[test]
#[ignore = "a minute: eight thousand pairs"]
fn a_thousand_pairs_round_obstacles() {
    for (k, robot) in cells().iter().enumerate() {
        for signs in ["++", "+-", "-+", "--"] {
            let [planned, apart, undecided] = pairs(robot, 11, signs, 1000);
            println!("{k} {signs}: {planned} planned, {apart} proved apart, {undecided} undecided");
            assert!(undecided * 100 < planned, "{k} {signs}: {undecided} undecided");
        }
    }
}

/// A tool goes over a bar that the aspects of a Delta need not be known for.
#[test]
fn ways_round_are_found_without_aspects() {
    let tool =
        "[bodies]\nradius = 15\n[[bodies.platform]]\nends = [[0, 0, -60], [0, 0, -150]]\nradius = 25\n";
    let bar = "[[obstacles]]\nends = [[0, -600, -1150], [0, 600, -1150]]\nradius = 50\n";
    let robot = obstacles::with("irb-360", &format!("{tool}{bar}"));
    let window = robot.slice(&[]).unwrap();
    let ends = [&[-200.0, 50.0, -1050.0][..], &[250.0, 0.0, -1020.0]];
    let options = PlanOptions::default();
    let find = |weight| {
        Planner::without_aspects(&robot, &window, ends, mode("---"), &PlanOptions { weight, ..options })
            .unwrap()
    };
    let plan = find(1.0).unwrap();
    assert!(plan.waypoints.len() > 2 && plan.aspect.is_none(), "{plan:?}");
    assert!((&plan.waypoints[0][..], &plan.waypoints[plan.waypoints.len() - 1][..]) == (ends[0], ends[1]));
    assert_sound(&robot, &plan);
    // The tool reaches from 150 to 60 mm below the platform, and must stay 75 mm away from the bar's axis.
    for pair in plan.waypoints.windows(2) {
        for t in (0..=50).map(|i| f64::from(i) / 50.0) {
            let [x, z] = [0, 2].map(|k| pair[0][k] + t * (pair[1][k] - pair[0][k]));
            let below = (z - 150.0 + 1150.0).max(0.0).max(-1150.0 - (z - 60.0));
            assert!(x.hypot(below) > 75.0, "{x} {z}");
        }
    }
    assert_eq!(find(8.0), None, "clearance counts: the aspect must tell");
    assert!(matches!(
        Planner::without_aspects(&robot, &window, [&[0.0, 0.0, -1100.0], ends[1]], mode("---"), &options),
        Err(Refusal::BeyondLimit { .. })
    ));
}

/// Points 1 and 3 of Table 4.
const TABLE_4: [[f64; 3]; 2] = [[-15.468, 0.781, 0.073], [-9.902, -7.091, 1.081]];

#[test]
fn a_better_path_than_that_of_table_4() {
    let robot = robot("3-rrr");
    let analysis = analysed(&robot, 7, &["+++"]);
    let mut planner = Planner::new(&analysis);
    let mut plan = |weight| {
        let options = PlanOptions { weight, ..PlanOptions::default() };
        let plan = planner.plan(&TABLE_4[0], &TABLE_4[1], mode("+++"), &options).unwrap();
        assert_sound(&robot, &plan);
        (least_det(&robot, &plan), plan.length)
    };
    let (shortest, clearest) = (plan(0.0), plan(8.0));
    // The paper's path comes down to |det A| = 6842; at its start |det A| is 25 054.
    assert!(clearest.0 > 20_000.0, "{clearest:?}");
    assert!(shortest.0 < clearest.0 && shortest.1 < clearest.1, "{shortest:?} {clearest:?}");
}

#[test]
fn margins_are_kept_all_along() {
    let robot = robot("five-bar");
    let analysis = analysed(&robot, 10, &["+-"]);
    let mut planner = Planner::new(&analysis);
    let margins = Margins { parallel: 0.4, serial: 0.3 };
    let options = PlanOptions { weight: 0.0, margins };
    let mut random = Random(3);
    let mut planned = 0;
    for _ in 0..60 {
        let [start, goal] = [(); 2].map(|()| pose_in(&analysis, mode("+-"), &mut random).unwrap());
        let Ok(plan) = planner.plan(&start, &goal, mode("+-"), &options) else { continue };
        planned += 1;
        assert_sound(&robot, &plan);
        for (det_a, serial) in sampled(&robot, &plan) {
            // Rows of A are 2 M long: 2·5 and 2·8.
            let parallel = det_a.abs() / 160.0;
            assert!(parallel >= 0.4 - 1e-9 && serial >= 0.3 - 1e-9, "{parallel} {serial} {plan:?}");
        }
    }
    assert!(planned > 3, "{planned}");
    let near = planner.plan(&[0.5858, 9.9], &[0.59, 9.8], mode("+-"), &options);
    assert_eq!(near, Err(Refusal::Margins(End::Start)));
}

/// Faults planted in a plan: a waypoint beyond the singularity, one out of reach, margins that were not proved.
#[test]
fn a_planted_fault_is_not_proved() {
    let robot = robot("five-bar");
    let analysis = analysed(&robot, 10, &["+-"]);
    let plan = Planner::new(&analysis).plan(&[4.0, 7.0], &[5.0, -7.0], mode("+-"), &PlanOptions::default());
    let plan = plan.unwrap();
    assert!(plan.waypoints.len() > 3);
    let proved = |waypoints: &[Vec<f64>], margins: Margins| {
        let options = PathOptions { joined: Joined::Straight, margins };
        check_poses(&robot, waypoints, plan.mode, &options).unwrap().is_sound()
    };
    assert!(proved(&plan.waypoints, Margins::default()));
    // det A < 0 at (3, 2.5), and leg 1 does not reach (1, 1).
    for fault in [vec![3.0, 2.5], vec![1.0, 1.0]] {
        let mut waypoints = plan.waypoints.clone();
        waypoints[2] = fault;
        assert!(!proved(&waypoints, Margins::default()), "{waypoints:?}");
    }
    let mut shortened = plan.waypoints.clone();
    shortened.drain(1..plan.waypoints.len() - 1);
    assert!(!proved(&shortened, Margins::default()));
    let least = least_det(&robot, &plan) / 160.0;
    assert!(proved(&plan.waypoints, Margins { parallel: 0.99 * least, serial: 0.0 }));
    assert!(!proved(&plan.waypoints, Margins { parallel: 1.01 * least, serial: 0.0 }));
}

#[test]
fn the_shortest_way_is_straight_where_it_can_be() {
    let robot = robot("five-bar");
    let analysis = analysed(&robot, 9, &["+-"]);
    let shortest = PlanOptions { weight: 0.0, ..PlanOptions::default() };
    let plan = Planner::new(&analysis).plan(&[4.0, 7.0], &[1.0, 10.0], mode("+-"), &shortest).unwrap();
    assert_eq!(plan.waypoints, [[4.0, 7.0], [1.0, 10.0]]);
    assert!((plan.length - 18f64.sqrt()).abs() < 1e-12);
}

#[test]
fn refusals_name_what_is_wrong() {
    let five_bar = robot("five-bar");
    let analysis = analysed(&five_bar, 9, &["+-"]);
    let mut planner = Planner::new(&analysis);
    let mut refusal = |start: &[f64], goal: &[f64], signs: &str| {
        planner.plan(start, goal, mode(signs), &PlanOptions::default()).unwrap_err()
    };
    let inside = [4.0, 7.0];
    assert_eq!(
        refusal(&inside, &[40.0, 7.0], "+-"),
        Refusal::OutOfReach { end: End::Goal, leg: LegIndex::new(0) }
    );
    assert_eq!(refusal(&inside, &inside, "++"), Refusal::Mode(mode("++")));
    assert!(matches!(refusal(&[1.0], &inside, "+-"), Refusal::Pose { end: End::Start, .. }));
    assert!(matches!(refusal(&inside, &[f64::NAN, 0.0], "+-"), Refusal::Pose { end: End::Goal, .. }));
    // |A₁C| = 13, to rounding.
    assert_eq!(refusal(&[5.0, 12.0], &inside, "+-"), Refusal::OnBoundary(End::Start));
    let rpr = robot("3-rpr");
    let analysis = analysed(&rpr, 4, &[]);
    let beyond = Planner::new(&analysis).plan(&[0.0; 3], &[0.0; 3], mode("---"), &PlanOptions::default());
    assert!(matches!(beyond, Err(Refusal::BeyondLimit { end: End::Start, .. })), "{beyond:?}");
}

/// Robots nobody has seen: of every kind of leg and platform that can be analysed whole, in a window about a pose they can take.
#[test]
fn random_robots_are_planned_soundly() {
    let mut seen = [0; 3];
    for (platform, depth, count) in
        [(Platform::PlanePoint, 8, 24), (Platform::PlaneBody, 4, 10), (Platform::TranslatingBody, 4, 10)]
    {
        for seed in 0..count {
            let case = random::case(platform, Spread::Anywhere, seed);
            let mut robot = case.robot;
            let near = |(x, angle): (&f64, bool)| if angle { (x - 1.0, x + 1.0) } else { (x - 5.0, x + 5.0) };
            let angles = platform.coordinates().iter().map(|c| c.angle);
            robot.window = case.pose.iter().zip(angles).map(|end| Some(near(end))).collect();
            let analysis = analysed(&robot, depth, &[]);
            let mut planner = Planner::new(&analysis);
            let mut random = Random(seed);
            for mode in robot.working_modes().into_iter().take(2) {
                let drawn = [(); 2].map(|()| pose_in(&analysis, mode, &mut random));
                let [Some(start), Some(goal)] = drawn else { continue };
                match planner.plan(&start, &goal, mode, &PlanOptions::default()) {
                    Ok(plan) => {
                        seen[0] += 1;
                        assert_sound(&robot, &plan);
                        for x in plan.waypoints.iter() {
                            let within = |k: usize| analysis.window.fraction(k, x[k]).is_some();
                            assert!((0..x.len()).all(within), "{x:?} of {robot:?}");
                        }
                    }
                    Err(refusal) if refusal.is_proof() => {
                        seen[1] += 1;
                        assert_explained(&analysis, mode, [&start, &goal], &refusal);
                    }
                    Err(_) => seen[2] += 1,
                }
            }
        }
    }
    println!("{} planned, {} proved apart, {} undecided", seen[0], seen[1], seen[2]);
    assert!(seen[0] > 20 && seen[1] > 5, "{seen:?}");
}
