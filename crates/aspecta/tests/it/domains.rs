//! Basic regions, coincident components and uniqueness domains.

use aspecta::Kinematics;
use aspecta::aspect::{Analysis, AspectId, ClassId, DetSign, Options, analyze};
use aspecta::domain::{DomainError, DomainOptions, Domains, RegionId, domains};
use aspecta::paving::{Budget, Control};
use aspecta::robot::{Robot, catalogue};

fn analyzed(robot: &Robot, depth: u32) -> Analysis {
    let budget = Budget { depth: Some(depth), ..Budget::default() };
    analyze(robot, &Options { budget, ..Options::default() }, &Control::unwatched()).unwrap()
}

fn partitioned(analysis: &Analysis, id: AspectId, cells: usize) -> Domains {
    let options = DomainOptions { cells, samples: 20_000 };
    domains(analysis, id, &options, &Control::unwatched()).unwrap()
}

/// What must hold of any partition: Consequence 1 and Theorem 3, on what was computed.
fn check(analysis: &Analysis, found: &Domains) {
    assert!(found.violations.is_empty(), "{:?}", found.violations);
    assert!(found.complete);
    for c in &found.coincidences {
        let solutions = |region: RegionId| found.regions[region.number() - 1].solutions;
        assert_eq!(solutions(c.regions.0), solutions(c.regions.1));
        assert!(
            c.shares.is_some_and(|(a, b)| a > 0.95 && b > 0.95),
            "neither disjoint nor coincident: {c:?}"
        );
    }
    for region in &found.regions {
        let images =
            found.coincidences.iter().filter(|c| [c.regions.0, c.regions.1].contains(&region.number));
        assert_eq!(images.count() + 1, usize::from(region.solutions), "region {}", region.number);
        assert_eq!(found.region_at(analysis, &region.pose), Some(region.number));
    }
    for domain in &found.uniqueness {
        let pairs = domain.regions.iter().flat_map(|a| domain.regions.iter().map(move |b| (*a, *b)));
        assert!(pairs.clone().all(|(a, b)| !found.coincide(a, b)), "{domain:?}");
        // No region can be added: each that touches the domain has its image in it already.
        for region in found.regions.iter().filter(|r| !domain.regions.contains(&r.number)) {
            let touches = domain
                .regions
                .iter()
                .any(|&d| found.adjacent.contains(&(d.min(region.number), d.max(region.number))));
            let meets = domain.regions.iter().any(|&d| found.coincide(d, region.number));
            assert!(!touches || meets, "{domain:?} could have {}", region.number);
        }
    }
    let Domains { agreement, .. } = found;
    assert_eq!(agreement.agree + agreement.disagreements.len(), agreement.away);
    // Surfaces pass between nodes too, but seldom.
    assert!(agreement.agree as f64 > 0.995 * agreement.away as f64, "{agreement:?}");
    assert!(agreement.away > agreement.samples / 4, "{agreement:?}");
}

/// The two direct solutions have opposite det A: no characteristic surface, every aspect is its own uniqueness domain.
#[test]
fn aspects_of_the_five_bar_are_uniqueness_domains() {
    let analysis = analyzed(&catalogue::find("five-bar").unwrap(), 11);
    assert_eq!(analysis.aspects.low, 10);
    for id in (1..=10).map(AspectId::new) {
        let found = partitioned(&analysis, id, 300);
        check(&analysis, &found);
        assert_eq!(found.regions.len(), 1);
        assert_eq!(found.regions[0].solutions, 1);
        assert_eq!(found.uniqueness.len(), 1);
        let (class, aspect) = analysis.aspect(id).unwrap();
        let most = aspect.measure + analysis.classes[class.index()].undecided;
        assert!(0.99 * aspect.measure < found.measure && found.measure < 1.01 * most, "{}", found.measure);
        assert!(found.unresolved.measure < 1e-2 * found.measure, "{:?}", found.unresolved);
    }
}

/// Three pairs of coincident components; Points 1 and 3 of Table 4, with one joint vector, lie in one aspect, in two regions
/// with coincident components, and in no common uniqueness domain.
#[test]
fn points_1_and_3_of_table_4() {
    let analysis = analyzed(&catalogue::find("3-rrr").unwrap(), 5);
    let class = analysis
        .classes
        .iter()
        .position(|c| c.mode.to_string() == "+++" && c.det_a == DetSign::Positive)
        .unwrap();
    let points = [[-15.468, 0.781, 0.073], [-9.902, -7.091, 1.081]];
    let [aspect] = analysis.classes[class].aspects.as_slice() else { panic!("one aspect was expected") };
    let found = partitioned(&analysis, aspect.id, 100);
    check(&analysis, &found);
    let [one, three] = points.map(|point| found.region_at(&analysis, &point).unwrap());
    assert_ne!(one, three);
    assert!(found.coincide(one, three));
    let both = |regions: &[RegionId]| regions.contains(&one) && regions.contains(&three);
    assert!(found.uniqueness.iter().all(|domain| !both(&domain.regions)));
    assert!(found.uniqueness.iter().any(|domain| domain.regions.contains(&one)));
    assert!(found.uniqueness.iter().any(|domain| domain.regions.contains(&three)));
}

/// Ten regions: three pairs and a triple of coincident components, hence 2·2·2·3 uniqueness domains. Three of the six direct
/// solutions at (14.98, 15.38, 12) lie in each aspect, in the triple.
#[test]
fn regions_of_the_3_rpr() {
    let robot = catalogue::find("3-rpr").unwrap();
    let analysis = analyzed(&robot, 6);
    let positive = analysis.classes.iter().position(|c| c.det_a == DetSign::Positive).unwrap();
    let six = robot.direct(&[14.98, 15.38, 12.0]).unwrap();
    assert_eq!(six.iter().filter(|s| s.det_a > 0.0).count(), 3);
    let here: Vec<_> =
        six.iter().filter_map(|s| analysis.aspect_at(&s.pose, ClassId::new(positive))).collect();
    assert!(here.len() == 3 && here.iter().all(|id| *id == here[0]));
    let found = partitioned(&analysis, here[0], 60);
    check(&analysis, &found);
    let mut solutions: Vec<u8> = found.regions.iter().map(|r| r.solutions).collect();
    solutions.sort_unstable();
    assert_eq!(solutions, [1, 2, 2, 2, 2, 2, 2, 3, 3, 3]);
    assert_eq!(found.uniqueness.len(), 24);
    for solution in six.iter().filter(|s| s.det_a > 0.0) {
        let region =
            found.region_at(&analysis, &solution.pose).map(|r| found.regions[r.number() - 1].solutions);
        assert_eq!(region, Some(3));
    }
}

#[test]
fn what_has_no_domains_is_an_error() {
    let of = |analysis: &Analysis, id| {
        domains(analysis, id, &DomainOptions::default(), &Control::unwatched()).map(|_| ())
    };
    let analysis = analyzed(&catalogue::find("five-bar").unwrap(), 5);
    let count = analysis.aspects.low;
    assert_eq!(
        of(&analysis, AspectId::new(count + 1)),
        Err(DomainError::NoAspect { id: AspectId::new(count + 1), count })
    );
}

/// A spherical robot whose direct solutions are up to eight.
#[test]
fn a_spherical_robot_is_cut_into_regions() {
    let robot = Robot::from_toml(include_str!("../fixtures/sphere.toml"), "sphere.toml").unwrap();
    let analysis = analyzed(&robot, 5);
    let largest = (1..=analysis.aspects.low).map(|id| partitioned(&analysis, AspectId::new(id), 20));
    let found = largest.max_by(|a, b| a.measure.total_cmp(&b.measure)).unwrap();
    let Domains { agreement, .. } = &found;
    assert!(agreement.agree as f64 > 0.99 * agreement.away as f64, "{agreement:?}");
    assert!(agreement.away > agreement.samples / 4, "{agreement:?}");
    for region in &found.regions {
        let q = robot.inverse_in(&region.pose, found.mode).unwrap().unwrap();
        let solutions = robot.direct(&q).unwrap();
        let alike = |s: &&aspecta::kinematics::Solution| {
            s.mode == found.mode && (s.det_a > 0.0) == (found.det_a == DetSign::Positive)
        };
        assert!(solutions.iter().filter(alike).count() >= usize::from(region.solutions), "{region:?}");
    }
}
