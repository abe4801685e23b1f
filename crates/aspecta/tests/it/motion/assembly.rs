//! From one assembly mode to another.

use super::*;
use aspecta::Kinematics;
use aspecta::motion::assembly::{assembly_modes, cusps_round, folds};
use aspecta::motion::plan::{PlanOptions, Planner, Refusal};

/// The 3-RPR of the catalogue at (14.98, 15.38, 12): six solutions, three in each of its two aspects.
#[test]
fn solutions_in_one_aspect_can_be_changed_into_each_other() {
    let robot = robot("3-rpr");
    let analysis = analysed(&robot, 6, &[]);
    let found = assembly_modes(&analysis, &[14.98, 15.38, 12.0]).unwrap();
    assert!(found.complete && found.solutions.len() == 6);
    assert_eq!(found.shared.iter().map(|s| s.solutions.len()).collect::<Vec<_>>(), [3, 3]);
    // No box is fine enough here to prove that aspects are one: paths prove it of the solutions.
    assert!(found.shared.iter().all(|s| !analysis.is_one(s.aspect) && s.certified));
    let mut planner = Planner::new(&analysis);
    for a in &found.solutions {
        for b in found.solutions.iter().filter(|b| b.number != a.number) {
            let (from, to) = (&a.solution, &b.solution);
            let result = planner.plan(&from.pose, &to.pose, from.mode, &PlanOptions::default());
            if a.aspect == b.aspect {
                let plan = result.unwrap();
                assert_sound(&robot, &plan);
                let end = &plan.waypoints[plan.waypoints.len() - 1];
                let q = robot.inverse_in(end, plan.mode).unwrap().unwrap();
                assert!(q.iter().zip([14.98, 15.38, 12.0]).all(|(a, b)| (a - b).abs() < 1e-9), "{q:?}");
            } else {
                assert!(matches!(result, Err(Refusal::OppositeSigns(_))), "{result:?}");
            }
        }
    }
}

#[test]
fn a_change_goes_round_a_cusp() {
    let robot = robot("3-rpr");
    let analysis = analysed(&robot, 6, &[]);
    let found = assembly_modes(&analysis, &[14.98, 15.38, 12.0]).unwrap();
    let [a, b] = [&found.solutions[1].solution, &found.solutions[2].solution];
    let plan = Planner::new(&analysis).plan(&a.pose, &b.pose, a.mode, &PlanOptions::default()).unwrap();
    let folds = folds(&robot, &plan);
    assert!(!folds.is_empty());
    for fold in &folds {
        assert_eq!(fold.solutions.0.abs_diff(fold.solutions.1), 2, "{fold:?}");
        // Two poses meet there: det A is next to nothing against that of the way.
        let q = robot.inverse_in(&fold.meeting, plan.mode).unwrap().unwrap();
        let det = robot.state(&fold.meeting, &q).unwrap().parallel_measure;
        assert!(det < 1e-3, "{det} {fold:?}");
        assert!(q.iter().zip(&fold.q).all(|(a, b)| (a - b).abs() < 1e-3), "{fold:?}");
    }
    let ends = [&folds[0].solutions.0, &folds[folds.len() - 1].solutions.1];
    assert_eq!(ends, [&6, &6]);
    assert!(!cusps_round(&robot, &plan, &Control::unwatched()).unwrap().is_empty());
}

/// With locked actuators a five-bar has two poses, of opposite det A.
#[test]
fn the_five_bars_two_solutions_share_no_aspect() {
    let robot = robot("five-bar");
    let analysis = analysed(&robot, 9, &[]);
    let q = robot.inverse_in(&[4.0, 7.0], mode("+-")).unwrap().unwrap();
    let found = assembly_modes(&analysis, &q).unwrap();
    assert_eq!(found.solutions.len(), 2);
    assert!(found.solutions.iter().all(|s| s.aspect.is_some()) && found.shared.is_empty());
}
