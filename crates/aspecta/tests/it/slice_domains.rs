//! Basic regions and characteristic surfaces on slices: held against those of the whole workspace, and against the direct model.

use aspecta::Kinematics;
use aspecta::aspect::{Analysis, AspectId, DetSign, Options, analyze};
use aspecta::domain::boundary::Face;
use aspecta::domain::{DomainOptions, Domains, Mesh, RegionId, domains, slice};
use aspecta::kinematics::constraints::Constraint;
use aspecta::paving::{Budget, Control};
use aspecta::robot::{Robot, catalogue};

fn robot(name: &str) -> Robot {
    catalogue::find(name).unwrap()
}

fn analyzed(robot: &Robot, fix: &[(usize, f64)], modes: &[&str], depth: u32) -> Analysis {
    let budget = Budget { depth: Some(depth), ..Budget::default() };
    let modes = modes.iter().map(|mode| mode.parse().unwrap()).collect();
    analyze(robot, &Options { budget, fix: fix.to_vec(), modes, ..Options::default() }, &Control::unwatched())
        .unwrap()
}

fn partitioned(analysis: &Analysis, id: AspectId, cells: usize, samples: usize) -> Domains {
    domains(analysis, id, &DomainOptions { cells, samples }, &Control::unwatched()).unwrap()
}

/// The number of the first aspect of a class.
fn first_of(analysis: &Analysis, mode: &str, det_a: DetSign) -> AspectId {
    let class = analysis.classes.iter().find(|c| c.mode.to_string() == mode && c.det_a == det_a).unwrap();
    class.aspects[0].id
}

/// Direct solutions of the class with the joint vector of a pose, by the certified direct model.
fn solutions(analysis: &Analysis, found: &Domains, pose: &[f64]) -> usize {
    let q = analysis.robot.inverse_in(pose, found.mode).unwrap().unwrap();
    let of_class = |s: &&aspecta::kinematics::Solution| {
        s.mode == found.mode && (s.det_a > 0.0) == (found.det_a == DetSign::Positive)
    };
    analysis.robot.direct(&q).unwrap().iter().filter(of_class).count()
}

/// What is said of regions on a slice, against what is known of the whole aspect.
#[test]
fn slices_agree_with_the_whole() {
    agree_with_the_whole(&[-0.32, 0.46]);
}

#[test]
#[ignore = "half a minute: more slices"]
fn slices_at_other_heights_agree_with_the_whole() {
    agree_with_the_whole(&[-0.62, 0.3, 0.7]);
}

/// At (−17.615863, −9.118162) the tip of a region with two solutions is 0.003 wide, a twentieth of a cell:
/// poses there are said to lie in no region, and no list of regions to be complete.
#[test]
fn what_passes_between_the_nodes_is_part_of_no_region() {
    let robot = robot("3-rrr");
    let analysis = analyzed(&robot, &[(2, 0.0)], &["+++"], 11);
    let found = partitioned(&analysis, first_of(&analysis, "+++", DetSign::Positive), 500, 100);
    let pose = [-17.615863, -9.118162, 0.0];
    assert_eq!(solutions(&analysis, &found, &pose), 2);
    let region = |pose: &[f64]| found.labels.region_round(pose).and_then(|k| found.regions.get(k as usize));
    assert!(region(&pose).is_none(), "{:?}", region(&pose));
    // The wedge along its length, and beside it.
    for t in 0..40 {
        let x = -17.615863 + 0.012 * f64::from(t);
        let along: Vec<f64> =
            (0..200).map(|k| -9.118162 + 0.6 * (x + 17.615863) - 0.2 + 0.004 * f64::from(k)).collect();
        for y in along {
            if let Some(region) = region(&[x, y, 0.0]) {
                assert_eq!(
                    usize::from(region.solutions),
                    solutions(&analysis, &found, &[x, y, 0.0]),
                    "{x} {y}"
                );
            }
        }
    }
    assert!(!found.complete && found.unresolved.parts > 1, "{:?}", found.unresolved);
}

#[track_caller]
fn agree_with_the_whole(heights: &[f64]) {
    let robot = robot("3-rrr");
    let whole = analyzed(&robot, &[], &["+++"], 7);
    let id = first_of(&whole, "+++", DetSign::Positive);
    let all = partitioned(&whole, id, 100, 0);
    assert_eq!(all.regions.len(), 7);
    let mut coincident = 0;
    for &phi in heights {
        let on = analyzed(&robot, &[(2, phi)], &["+++"], 9);
        let found = partitioned(&on, first_of(&on, "+++", DetSign::Positive), 120, 2_000);
        let agreement = &found.agreement;
        assert!(agreement.agree as f64 > 0.995 * agreement.away as f64, "{agreement:?}");
        assert!(agreement.away > agreement.samples / 2, "{agreement:?}");
        let of: Vec<RegionId> = found
            .regions
            .iter()
            .map(|r| all.region_at(&whole, &r.pose).expect("a region of the whole"))
            .collect();
        for (region, &of) in found.regions.iter().zip(&of) {
            assert_eq!(region.solutions, all.regions[of.number() - 1].solutions, "φ = {phi}: {region:?}");
        }
        let of = |(a, b): (RegionId, RegionId)| (of[a.number() - 1], of[b.number() - 1]);
        for pair in found.joined.iter().map(|&pair| of(pair)) {
            assert_eq!(pair.0, pair.1, "φ = {phi}");
        }
        for pair in found.coincidences.iter().map(|c| of(c.regions)) {
            assert!(all.coincide(pair.0, pair.1), "φ = {phi}: {pair:?}");
            coincident += 1;
        }
        for domain in &found.uniqueness {
            let pairs = domain.regions.iter().flat_map(|&a| domain.regions.iter().map(move |&b| (a, b)));
            assert!(pairs.map(of).all(|(a, b)| !all.coincide(a, b)), "φ = {phi}: {domain:?}");
        }
        // Every pair that may be in conflict is said to be, or not to be known.
        let regions = found.regions.iter().map(|r| r.number);
        let pairs = regions.clone().flat_map(|a| regions.clone().map(move |b| (a, b))).filter(|(a, b)| a < b);
        for pair in pairs.filter(|&pair| all.coincide(of(pair).0, of(pair).1)) {
            assert!(found.coincide(pair.0, pair.1) || found.undecided.contains(&pair), "φ = {phi}: {pair:?}");
        }
    }
    assert!(coincident > 0, "no coincident images were seen");
}

const LEVEL: [(usize, f64); 4] = [(1, 0.1), (3, 0.1), (4, 0.3), (5, 0.8)];
const HEXA: [(usize, f64); 4] = [(2, -600.0), (3, 0.1), (4, 0.05), (5, 0.02)];

#[test]
fn regions_of_a_free_body_hold_as_many_solutions_as_they_say() {
    hold_as_many_as_they_say(&analyzed(&robot("gough-stewart"), &LEVEL, &[], 9), 50);
}

#[test]
#[ignore = "a minute: finer, and a robot with cranks"]
fn regions_of_free_bodies_in_finer_cells_hold_as_many_solutions_as_they_say() {
    hold_as_many_as_they_say(&analyzed(&robot("gough-stewart"), &LEVEL, &[], 9), 70);
    hold_as_many_as_they_say(&analyzed(&robot("hexa"), &HEXA, &["------"], 7), 50);
}

#[track_caller]
fn hold_as_many_as_they_say(analysis: &Analysis, cells: usize) {
    let mut found = partitioned(analysis, first_of(analysis, "------", DetSign::Positive), cells, 200);
    assert!(found.regions.len() >= 3, "{:?}", found.regions);
    for region in &found.regions {
        assert_eq!(solutions(analysis, &found, &region.pose), usize::from(region.solutions), "{region:?}");
        assert_eq!(found.region_at(analysis, &region.pose), Some(region.number));
    }
    let surface = slice::surfaces(analysis, &found);
    found.measure_disagreements(&surface, &analysis.window);
    let agreement = &found.agreement;
    let near = |apart: &Option<f64>| apart.is_some_and(|cells| cells < 2.0);
    assert!(agreement.disagreements.iter().all(|d| near(&d.distance)), "{agreement:?}");
    assert!(agreement.away > agreement.samples / 4, "{agreement:?}");
    assert_crossings_change_the_number(analysis, &found, &surface);
}

/// Next to the middle of a piece of a surface, on its two sides, there are different numbers of solutions.
fn assert_crossings_change_the_number(analysis: &Analysis, found: &Domains, surface: &Mesh) {
    let axes = analysis.window.axes();
    let (mut tested, mut changed) = (0, 0);
    for simplex in surface.simplices.iter().step_by(7) {
        let [p, q] = [0, 1].map(|k| &surface.vertices[simplex.corners[k] as usize]);
        let along = [0, 1].map(|k| (q[k] - p[k]) / found.cell[k]);
        let length = along[0].hypot(along[1]);
        if length < 0.3 {
            continue;
        }
        let beside = |side: f64| {
            let mut pose = found.regions[0].pose.clone();
            let normal = [-along[1], along[0]];
            for k in 0..2 {
                pose[axes[k]] = 0.5 * (p[k] + q[k]) + side * 0.2 * found.cell[k] * normal[k] / length;
            }
            solutions(analysis, found, &pose)
        };
        tested += 1;
        changed += usize::from(beside(1.0) != beside(-1.0));
    }
    assert!(tested > 15, "{tested}");
    // Chords cut corners, and regions thinner than a cell lie between: of a grid of 140 cells 69 of 78 and 99 of 100 do.
    assert!(changed as f64 > 0.7 * f64::from(tested), "{changed} of {tested}");
}

/// In three coordinates too the surfaces part what has different numbers of solutions: their corners lie between nodes of different regions.
#[test]
fn surfaces_in_space_lie_where_solutions_are_lost() {
    let analysis = analyzed(&robot("gough-stewart"), &LEVEL[1..], &[], 5);
    let found = partitioned(&analysis, first_of(&analysis, "------", DetSign::Positive), 16, 50);
    let surface = slice::surfaces(&analysis, &found);
    assert!(surface.simplices.len() > 50, "{}", surface.simplices.len());
    assert!(surface.simplices.iter().all(|s| s.face == Face::Of(Constraint::Det)));
    let mut sides = std::collections::BTreeMap::new();
    for simplex in &surface.simplices {
        let [a, b, c] = simplex.corners;
        for (u, v) in [(a, b), (b, c), (c, a)] {
            *sides.entry((u.min(v), u.max(v))).or_insert(0) += 1;
        }
    }
    // Triangles hang together, but for the rim and where three regions meet on a face.
    let single = sides.values().filter(|count| **count == 1).count();
    assert!(single < sides.len() / 3, "{single} of {}", sides.len());
}

/// Of the eight poses of a joint vector of this robot four are at a serial singularity whatever the joint vector. They bound the aspects, and
/// rounding must not put them inside: each joint vector means one pose of a class.
#[test]
fn poses_that_fold_a_leg_are_in_no_aspect() {
    let analysis = analyzed(&robot("spherical-3-rrr"), &[(1, 0.2)], &["+++"], 6);
    let id = analysis.classes.iter().find_map(|class| class.aspects.first()).unwrap().id;
    let found = partitioned(&analysis, id, 40, 2_000);
    let solutions: Vec<u8> = found.regions.iter().map(|region| region.solutions).collect();
    assert_eq!((solutions, found.unresolved.parts), (vec![1], 0));
    assert!(found.agreement.away > 1000 && found.agreement.agree == found.agreement.away);
}
