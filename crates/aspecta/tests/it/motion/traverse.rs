//! Which aspects hold a set.

use super::*;
use aspecta::Kinematics;
use aspecta::aspect::{AspectId, ClassId, Place};
use aspecta::motion::modes::ModeGraph;
use aspecta::motion::traverse::{Holds, PoseSet, traversability};

/// Whether a pose is in class `k`, by doubles.
fn is_in(analysis: &Analysis, k: usize, pose: &[f64]) -> bool {
    let class = &analysis.classes[k];
    let solutions = analysis.robot.inverse(pose).unwrap();
    let of_mode = solutions.into_iter().find(|s| s.mode == class.mode && s.within_limits);
    of_mode.is_some_and(|s| s.det_a * f64::from(class.det_a.factor()) > 0.0)
}

#[test]
fn boxes_are_held_as_samples_are() {
    for (name, depth) in [("five-bar", 9), ("3-rpr", 5), ("linear-delta", 5)] {
        let robot = robot(name);
        let analysis = analysed(&robot, depth, &[]);
        let mut random = Random(11);
        let mut seen = [0; 3];
        for trial in 0..60 {
            // Small boxes about poses of the robot, and larger ones.
            let modes = robot.working_modes();
            let centre = pose_in(&analysis, modes[modes.len() - 1], &mut random).unwrap();
            let size = if trial % 2 == 0 { 0.01 } else { 0.05 };
            let range = |k: usize| {
                let (lo, hi) = analysis.window.ranges[k];
                (centre[k] - size * (hi - lo), centre[k] + size * (hi - lo))
            };
            let ranges: Vec<(f64, f64)> = (0..robot.dof()).map(range).collect();
            let found = traversability(&analysis, None, PoseSet::Box(ranges.clone())).unwrap();
            for (k, class) in found.classes.iter().enumerate() {
                match &class.holds {
                    Holds::Whole { aspect } => {
                        seen[0] += 1;
                        for _ in 0..200 {
                            let pose: Vec<f64> =
                                ranges.iter().map(|(lo, hi)| random.within(*lo, *hi)).collect();
                            assert!(is_in(&analysis, k, &pose), "{name} {pose:?} {class:?}");
                            if let (Some(id), Place::Inside(other)) =
                                (aspect, analysis.locate(&pose, ClassId::new(k)))
                            {
                                assert_eq!(*id, other);
                            }
                        }
                    }
                    Holds::NotWhole { pose, .. } => {
                        seen[1] += 1;
                        assert!(!is_in(&analysis, k, pose), "{name} {class:?}");
                    }
                    Holds::Undecided { .. } => seen[2] += 1,
                }
            }
        }
        assert!(seen[0] > 5 && seen[1] > 5 && seen[2] < 5, "{name} {seen:?}");
    }
}

#[test]
fn separate_poses_may_need_changes_of_mode() {
    let robot = robot("five-bar");
    let analysis = analysed(&robot, 10, &[]);
    let graph = ModeGraph::new(&analysis, &Control::unwatched());
    let whole = |poses: &[[f64; 2]]| {
        let set = PoseSet::Poses(poses.iter().map(|p| p.to_vec()).collect());
        let found = traversability(&analysis, Some(&graph), set).unwrap();
        let held = found.classes.iter().filter(|c| matches!(c.holds, Holds::Whole { .. })).count();
        (held, found.groups.iter().filter(|group| group.certified).count())
    };
    // Table 2's two aspects of mode (−, +) with det A > 0, and a pose of each.
    let of = |id: AspectId| analysis.aspect(id).unwrap().1.sample.pose.clone();
    let class = analysis.classes.iter().find(|c| c.aspects.len() == 2).unwrap();
    let samples: Vec<[f64; 2]> = class.aspects.iter().map(|a| [of(a.id)[0], of(a.id)[1]]).collect();
    let k = analysis.class_of(class.mode, class.det_a).unwrap();
    let set = PoseSet::Poses(samples.iter().map(|p| p.to_vec()).collect());
    let found = traversability(&analysis, None, set).unwrap();
    assert!(
        matches!(found.classes[k.index()].holds, Holds::NotWhole { constraint: None, .. }),
        "{:?}",
        found.classes[k.index()]
    );
    assert!(whole(&samples).1 > 0);
    assert_eq!(whole(&[[4.0, 7.0], [40.0, 7.0]]), (0, 0));
}

#[test]
fn a_path_is_held_where_its_check_is_free() {
    let robot = robot("five-bar");
    let analysis = analysed(&robot, 9, &[]);
    let path = vec![vec![4.0, 7.0], vec![1.0, 10.0], vec![5.0, -7.0]];
    let found = traversability(&analysis, None, PoseSet::Paths(vec![path.clone()])).unwrap();
    for class in &found.classes {
        let check = check_path(&robot, &path, class.mode).unwrap();
        if matches!(class.holds, Holds::Whole { .. }) {
            assert_eq!(check.singularity_free, Some(true), "{class:?}");
        } else {
            let det =
                robot.inverse(&path[0]).unwrap().into_iter().find(|s| s.mode == class.mode).unwrap().det_a;
            let sign_fits = det * f64::from(class.det_a.factor()) > 0.0;
            assert!(!sign_fits || check.singularity_free != Some(true), "{class:?}");
        }
    }
}

/// Of poses in an aspect that is not proved to be one a path has to prove that they can be joined.
#[test]
fn poses_in_an_aspect_that_may_be_several_are_joined_by_paths() {
    let robot = robot("3-rpr");
    let analysis = analysed(&robot, 6, &[]);
    let solutions: Vec<_> = robot.direct(&[14.98, 15.38, 12.0]).unwrap();
    for (k, class) in analysis.classes.iter().enumerate() {
        let of_class = solutions.iter().filter(|s| s.det_a * f64::from(class.det_a.factor()) > 0.0);
        let poses: Vec<Vec<f64>> = of_class.map(|s| s.pose.clone()).collect();
        assert!(poses.len() == 3 && !analysis.is_one(class.aspects[0].id));
        let found = traversability(&analysis, None, PoseSet::Poses(poses)).unwrap();
        assert!(matches!(found.classes[k].holds, Holds::Whole { aspect: Some(_) }), "{:?}", found.classes[k]);
        assert!(matches!(found.classes[1 - k].holds, Holds::NotWhole { .. }), "{:?}", found.classes[1 - k]);
    }
}

/// A set leaves a window that is less than a full turn even if both its ends lie in it.
#[test]
fn a_set_that_leaves_the_window_is_not_held() {
    let mut robot = robot("3-rpr");
    let pose = robot.direct(&[14.98, 15.38, 12.0]).unwrap()[1].pose.clone();
    robot.window[2] = Some((pose[2] - 0.2, pose[2] + 0.2));
    let analysis = analysed(&robot, 5, &[]);
    let at = |phi: f64| vec![pose[0], pose[1], pose[2] + phi];
    let is_held = |set: PoseSet| {
        let found = traversability(&analysis, None, set).unwrap();
        found.classes.iter().any(|class| matches!(class.holds, Holds::Whole { .. }))
    };
    let is_out = |set: PoseSet| {
        let found = traversability(&analysis, None, set).unwrap();
        found.classes.iter().all(|class| matches!(class.holds, Holds::NotWhole { constraint: None, .. }))
    };
    let range = |phi: [f64; 2]| {
        let around = |x: f64| (x - 0.01, x + 0.01);
        PoseSet::Box(vec![around(pose[0]), around(pose[1]), (pose[2] + phi[0], pose[2] + phi[1])])
    };
    assert!(is_held(PoseSet::Paths(vec![vec![at(-0.05), at(0.05)]])));
    assert!(is_held(PoseSet::Poses(vec![at(-0.05), at(0.05 + TAU)])));
    assert!(is_held(range([TAU - 0.01, TAU + 0.01])));
    assert!(is_out(PoseSet::Paths(vec![vec![at(-0.05), at(0.05 + TAU)]])));
    assert!(is_out(range([-0.05, 0.05 + TAU])));
    assert!(is_out(PoseSet::Poses(vec![at(-0.05), at(0.3)])));
}
