//! Through changes of working mode.

use super::*;
use aspecta::Kinematics;
use aspecta::aspect::{AspectId, ClassId, DetSign, Place};
use aspecta::kinematics::constraints::Margins;
use aspecta::motion::modes::{Configuration, ModeGraph, NoRoute};
use aspecta::motion::plan::{PlanOptions, Planner};
use aspecta::motion::time::{JointLimits, trajectory};
use aspecta::robot::LegIndex;

/// The paper's, with its ten aspects and their graph.
fn five_bar() -> (Robot, Analysis, ModeGraph) {
    let robot = robot("five-bar");
    let analysis = analysed(&robot, 10, &[]);
    let graph = ModeGraph::new(&analysis, &Control::unwatched());
    (robot, analysis, graph)
}

/// A pose in mode ++, and in −−.
fn ends(pose: &[f64]) -> [Configuration<'_>; 2] {
    ["++", "--"].map(|signs| Configuration { pose, mode: mode(signs) })
}

/// det A in a working mode.
fn det(robot: &Robot, pose: &[f64], mode: WorkingMode) -> Option<f64> {
    robot.inverse(pose).unwrap().into_iter().find(|s| s.mode == mode).map(|s| s.det_a)
}

#[test]
fn the_five_bars_ten_aspects_are_two_sets_of_five() {
    let (robot, _, graph) = five_bar();
    assert_eq!(graph.aspects.len(), 10);
    let signs = |group: &Vec<AspectId>| -> Vec<DetSign> {
        graph.aspects.iter().filter(|a| group.contains(&a.id)).map(|a| a.det_a).collect()
    };
    assert_eq!(graph.groups.len(), 2);
    assert_eq!(signs(&graph.groups[0]), [DetSign::Positive; 5]);
    assert_eq!(signs(&graph.groups[1]), [DetSign::Negative; 5]);
    assert!(graph.groups.iter().all(|group| graph.is_proved(group)));
    for crossing in &graph.crossings {
        assert!(crossing.is_proved(&robot, Margins::default()));
        // At the crossing the leg is stretched or folded: its two postures are one.
        let leg = &robot.leg_solutions(&crossing.pose).unwrap()[crossing.leg.index()];
        assert!(leg.reach.abs() < 1e-9, "{crossing:?}");
        // On the way there both modes have the same sign of det A.
        for i in 0..40 {
            let t = f64::from(i) / 40.0;
            let pose: Vec<f64> =
                crossing.inside.iter().zip(&crossing.pose).map(|(a, b)| a + t * (b - a)).collect();
            for mode in crossing.modes {
                let det = det(&robot, &pose, mode).unwrap();
                assert_eq!(det > 0.0, crossing.det_a == DetSign::Positive, "{crossing:?} {t}");
            }
        }
    }
}

/// Numbers that nothing has are answered, and never a panic.
#[test]
fn numbers_that_nothing_has_lead_nowhere() {
    let (_, analysis, graph) = five_bar();
    let (first, class) = (AspectId::new(1), ClassId::new(8));
    for none in [0, 11].map(AspectId::new) {
        assert!(analysis.aspect(none).is_none() && analysis.rank(none).is_none() && !analysis.is_one(none));
        assert_eq!(
            [graph.way(none, first), graph.way(first, none), graph.way(none, none)],
            [None, None, None]
        );
    }
    assert_eq!(graph.way(first, first), Some(Vec::new()));
    let pose = [4.0, 7.0];
    assert_eq!((analysis.locate(&pose, class), analysis.aspect_at(&pose, class)), (Place::Outside, None));
    assert!(analysis.cells(class).is_empty() && analysis.paving_of(class).is_none());
}

/// Mirroring the five-bar's plane turns det A and both modes about: its graph is symmetric.
#[test]
fn the_five_bars_graph_is_its_own_mirror_image() {
    let (_, _, graph) = five_bar();
    for crossing in &graph.crossings {
        let mirrored = |pose: &[f64]| [pose[0], -pose[1]];
        let twin = graph.crossings.iter().find(|other| {
            other.leg == crossing.leg
                && other.modes.contains(&crossing.modes[0].opposite())
                && other.det_a != crossing.det_a
                && (0..2).all(|k| (mirrored(&other.pose)[k] - crossing.pose[k]).abs() < 0.1)
        });
        assert!(twin.is_some(), "{crossing:?}");
    }
}

#[test]
fn a_planted_fault_is_not_proved() {
    let (robot, _, graph) = five_bar();
    for crossing in &graph.crossings {
        let mut wrong_sign = crossing.clone();
        wrong_sign.det_a = crossing.det_a.opposite();
        let mut wrong_leg = crossing.clone();
        wrong_leg.leg = LegIndex::new(1 - crossing.leg.index());
        let mut too_short = crossing.clone();
        too_short.beyond.clone_from(&crossing.inside);
        let mut out_of_reach = crossing.clone();
        out_of_reach.inside.clone_from(&crossing.beyond);
        for fault in [wrong_sign, wrong_leg, too_short, out_of_reach] {
            assert!(!fault.is_proved(&robot, Margins::default()), "{fault:?}");
        }
    }
}

#[test]
fn a_route_through_three_modes() {
    let (robot, analysis, graph) = five_bar();
    let pose = [4.0, 7.0];
    let [start, goal] = ends(&pose);
    let route = Planner::new(&analysis).route(&graph, start, goal, &PlanOptions::default()).unwrap();
    assert!(route.stretches.len() >= 3 && route.crossings.len() + 1 == route.stretches.len());
    let (first, last) = (&route.stretches[0], &route.stretches[route.stretches.len() - 1]);
    assert!(first.mode == mode("++") && last.mode == mode("--"));
    assert!(same_pose(&robot, &first.waypoints[0], &pose));
    assert!(same_pose(&robot, &last.waypoints[last.waypoints.len() - 1], &pose));
    for stretch in &route.stretches {
        assert_sound(&robot, stretch);
        assert_eq!(stretch.det_a, first.det_a);
    }
    for (k, crossing) in route.crossings.iter().enumerate() {
        assert!(crossing.is_proved(&robot, Margins::default()));
        let [before, after] = [&route.stretches[k], &route.stretches[k + 1]];
        assert_eq!(before.mode.with_other_posture(crossing.leg), after.mode);
        assert_eq!(before.waypoints[before.waypoints.len() - 1], crossing.inside);
        assert_eq!(after.waypoints[0], crossing.inside);
    }
}

#[test]
fn no_route_joins_two_signs_of_det_a() {
    let (robot, analysis, graph) = five_bar();
    let pose = [4.0, 7.0];
    let of = |signs: &str| Configuration { pose: &pose, mode: mode(signs) };
    let [plus, minus] = [of("++"), of("-+")];
    assert!(det(&robot, &pose, plus.mode).unwrap() > 0.0 && det(&robot, &pose, minus.mode).unwrap() < 0.0);
    let refusal = Planner::new(&analysis).route(&graph, plus, minus, &PlanOptions::default()).unwrap_err();
    assert_eq!(refusal, NoRoute::OppositeSigns(DetSign::Positive));
    assert!(refusal.is_proof());
}

/// In coarse boxes an aspect may hide, so what is shown as one aspect is not proved to be one: nothing is certified of their groups.
#[test]
fn groups_of_aspects_that_may_be_several_are_not_proved() {
    let robot = robot("five-bar");
    let coarse = analysed(&robot, 5, &[]);
    assert!(coarse.classes.iter().any(|class| class.high.is_none()));
    let graph = ModeGraph::new(&coarse, &Control::unwatched());
    assert!(graph.groups.iter().any(|group| !graph.is_proved(group)));
    for aspect in &graph.aspects {
        let (class, found) = coarse.aspect(aspect.id).unwrap();
        assert_eq!(aspect.is_one, coarse.classes[class.index()].high.is_some() && found.pieces == 1);
    }
}

/// The gaps between its cranks' ranges leave the IRB 360 one mode: there is nothing to cross to.
#[test]
fn limits_can_leave_nothing_to_cross_to() {
    let graph = ModeGraph::new(&analysed(&robot("irb-360"), 5, &[]), &Control::unwatched());
    assert!(graph.crossings.is_empty());
    assert_eq!(graph.groups.len(), graph.aspects.len());
}

/// Driven through its serial singularities the joints go on smoothly, within their limits, while the platform turns round there.
#[test]
fn a_route_is_timed_through_its_crossings() {
    let (robot, analysis, graph) = five_bar();
    let pose = [4.0, 7.0];
    let [start, goal] = ends(&pose);
    let route = Planner::new(&analysis).route(&graph, start, goal, &PlanOptions::default()).unwrap();
    let limits = JointLimits { speed: vec![2.0; 2], acceleration: vec![8.0; 2] };
    let motion = trajectory(&route.pieces(&robot), &limits).unwrap();
    let rows: Vec<_> = motion.rows(1000.0).collect();
    for row in &rows {
        assert!(row.velocity.iter().all(|v| v.abs() <= 2.0 + 1e-5), "{row:?}");
        assert!(row.acceleration.iter().all(|a| a.abs() <= 8.0 + 1e-4), "{row:?}");
        // Pose and joints belong together, on the branch that the crossing leads to.
        assert!(robot.state(&row.pose, &row.q).unwrap().residual < 1e-5, "{row:?}");
    }
    for pair in rows.windows(2) {
        let step = |k: usize| (pair[1].q[k] - pair[0].q[k]).abs();
        assert!((0..2).all(|k| step(k) <= 2.1e-3), "{pair:?}");
    }
    let end = robot.inverse_in(&pose, mode("--")).unwrap().unwrap();
    let last = &rows[rows.len() - 1].q;
    let apart = |k: usize| (last[k] - end[k]) / TAU;
    assert!((0..2).all(|k| (apart(k) - apart(k).round()).abs() < 1e-6), "{last:?} {end:?}");
}

#[test]
fn margins_hold_through_crossings() {
    let (robot, analysis, graph) = five_bar();
    let pose = [4.0, 10.5];
    let [start, goal] = ends(&pose);
    let route = |parallel, serial| {
        let options = PlanOptions { margins: Margins { parallel, serial }, ..PlanOptions::default() };
        Planner::new(&analysis).route(&graph, start, goal, &options)
    };
    let wide = route(0.4, 0.0).unwrap();
    assert!(wide.crossings.iter().all(|c| c.clearance >= 0.4));
    for stretch in &wide.stretches {
        // Rows of A are 2 M long: 2·5 and 2·8.
        assert!(sampled(&robot, stretch).iter().all(|(det, _)| det.abs() / 160.0 > 0.4 - 1e-9));
    }
    assert_eq!(route(0.1, 0.1).unwrap_err(), NoRoute::SerialMargin);
}
