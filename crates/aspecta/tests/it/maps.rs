//! Maps: where configurations lie, and the file that keeps it.

use aspecta::Kinematics;
use aspecta::aspect::{Analysis, AspectId, ClassId, Options, Place, analyze};
use aspecta::domain::{DomainOptions, Map, MapError, MappedAspect, Nowhere, RegionId, domains};
use aspecta::kinematics::constraints::Constraint;
use aspecta::paving::{Budget, Control};
use aspecta::robot::{LegIndex, catalogue};
use flate2::Compression;
use flate2::read::GzDecoder;
use flate2::write::GzEncoder;
use std::io::{Read, Write};

use crate::random::Random;

/// The map of all aspects of a robot.
fn mapped(robot: &str, depth: u32, cells: usize) -> (Analysis, Map) {
    let budget = Budget { depth: Some(depth), ..Budget::default() };
    let options = Options { budget, ..Options::default() };
    let analysis = analyze(&catalogue::find(robot).unwrap(), &options, &Control::unwatched()).unwrap();
    let sheet = |id: AspectId| {
        let options = DomainOptions { cells, samples: 1000 };
        MappedAspect {
            domains: domains(&analysis, id, &options, &Control::unwatched()).unwrap(),
            surfaces: None,
        }
    };
    let ids: Vec<AspectId> = analysis.classes.iter().flat_map(|c| c.aspects.iter().map(|a| a.id)).collect();
    let map = Map::new(&analysis, ids.into_iter().map(sheet).collect());
    (analysis, map)
}

fn unpacked(file: &[u8]) -> String {
    let mut text = String::new();
    GzDecoder::new(file).read_to_string(&mut text).unwrap();
    text
}

fn packed(text: &str) -> Vec<u8> {
    let mut file = GzEncoder::new(Vec::new(), Compression::fast());
    file.write_all(text.as_bytes()).unwrap();
    file.finish().unwrap()
}

/// A few bytes that unpack to many.
#[test]
#[ignore = "10 s and 1 GiB of memory: unpacks as much as a map may hold, and more"]
fn no_more_is_unpacked_than_a_map_may_hold() {
    let bomb = packed(&" ".repeat((1 << 30) + 1));
    assert!(bomb.len() < 1 << 23 && matches!(Map::from_bytes(&bomb), Err(MapError::TooLarge)));
}

/// Random poses: the map names the aspect in whose certified cell the pose lies, after a journey through its file too.
#[test]
fn a_pose_lies_in_the_aspect_that_the_analysis_says() {
    let (analysis, map) = mapped("five-bar", 10, 200);
    let read = Map::from_bytes(&map.to_bytes().unwrap()).unwrap();
    let mut random = Random(7);
    let mut found = [0; 11];
    for _ in 0..20_000 {
        let pose: Vec<f64> = analysis.window.ranges.iter().map(|r| random.within(r.0, r.1)).collect();
        for (k, class) in analysis.classes.iter().enumerate() {
            let Place::Inside(id) = analysis.locate(&pose, ClassId::new(k)) else { continue };
            let location = map.locate(&pose, class.mode).unwrap();
            assert_eq!((location.det_a, location.aspect), (class.det_a, Some(id)), "{pose:?}");
            assert_eq!(read.locate(&pose, class.mode), Ok(location));
            // Every aspect is its own uniqueness domain; its tips are thinner than cells.
            if let Some(region) = location.region {
                assert_eq!(
                    (region, map.uniqueness(id, region).collect::<Vec<_>>()),
                    (RegionId::new(1), vec![1])
                );
                found[id.number()] += 1;
            }
        }
    }
    assert!(found[1..].iter().all(|&n| n > 0), "{found:?}");
}

/// The three direct solutions in one aspect of the 3-RPR lie in three regions whose components coincide, so any two in no common
/// uniqueness domain.
#[test]
fn direct_solutions_in_one_aspect_share_no_uniqueness_domain() {
    let (_, map) = mapped("3-rpr", 6, 60);
    let solutions = map.robot.direct(&[14.98, 15.38, 12.0]).unwrap();
    assert_eq!(solutions.len(), 6);
    let places: Vec<_> = solutions.iter().map(|s| map.locate(&s.pose, s.mode).unwrap()).collect();
    let domains = |k: usize| {
        let place = places[k];
        map.uniqueness(place.aspect.unwrap(), place.region.unwrap()).collect::<Vec<_>>()
    };
    for i in 0..6 {
        assert!(!domains(i).is_empty());
        let of = map.domains(places[i].aspect.unwrap()).unwrap();
        assert_eq!(of.regions[places[i].region.unwrap().number() - 1].solutions, 3);
        for j in (0..i).filter(|&j| places[j].aspect == places[i].aspect) {
            assert!(of.coincide(places[i].region.unwrap(), places[j].region.unwrap()));
            assert!(domains(i).iter().all(|domain| !domains(j).contains(domain)));
        }
    }
}

#[test]
fn why_a_pose_is_nowhere() {
    let (_, map) = mapped("five-bar", 7, 40);
    let mode = "++".parse().unwrap();
    // Legs 8 + 5 from (0, 0), 5 + 8 from (9, 0).
    assert_eq!(map.locate(&[3.0, 13.0], mode), Err(Nowhere::OutOfReach(LegIndex::new(0))));
    assert_eq!(map.locate(&[0.0, 0.5], mode), Err(Nowhere::OutOfReach(LegIndex::new(0))));
    assert!(matches!(map.locate(&[3.0], mode), Err(Nowhere::Pose(_))));
    let mut robot = catalogue::find("irb-360").unwrap();
    robot.window = vec![None, None, Some((-1500.0, -500.0))];
    let budget = Budget { depth: Some(4), ..Budget::default() };
    let analysis = analyze(&robot, &Options { budget, ..Options::default() }, &Control::unwatched()).unwrap();
    let map = Map::new(&analysis, Vec::new());
    let mode = "---".parse().unwrap();
    let place = map.locate(&[0.0, 0.0, -1100.0], mode).unwrap();
    assert_eq!(
        (place.aspect, place.region),
        (Some(analysis.classes[place_class(&analysis)].aspects[0].id), None)
    );
    assert_eq!(map.locate(&[0.0, 0.0, -1700.0], mode), Err(Nowhere::Window));
    assert!(matches!(map.locate(&[0.0, 0.0, -760.0], mode), Err(Nowhere::Limit(Constraint::Limit(_, 0)))));
}

fn place_class(analysis: &Analysis) -> usize {
    let mode = "---".parse().unwrap();
    analysis
        .classes
        .iter()
        .position(|c| c.mode == mode && c.det_a == aspecta::aspect::DetSign::Negative)
        .unwrap()
}

/// Every damage is noticed, whatever it is.
#[test]
fn damaged_and_foreign_files_are_refused() {
    let (_, map) = mapped("five-bar", 7, 40);
    let file = map.to_bytes().unwrap();
    assert!(Map::is_map(&file) && Map::from_bytes(&file).is_ok());
    let mut random = Random(3);
    for _ in 0..200 {
        let mut damaged = file.clone();
        let at = 10 + random.below(file.len() - 10);
        damaged[at] ^= 1 << random.below(8);
        assert!(Map::from_bytes(&damaged).is_err(), "bit of byte {at}");
        assert!(Map::from_bytes(&file[..at]).is_err(), "cut at {at}");
    }
    assert!(matches!(Map::from_bytes(&[&file[..], b"more"].concat()), Err(MapError::Damaged(_))));
    assert!(matches!(Map::from_bytes(b"name = \"robot\""), Err(MapError::Damaged(_))));
    assert!(matches!(Map::from_bytes(&packed("{}")), Err(MapError::Form(_))));
    let text = unpacked(&file);
    let changed = |from: &str, to: &str| {
        assert!(text.contains(from), "{from}");
        Map::from_bytes(&packed(&text.replacen(from, to, 1)))
    };
    assert!(changed("five-bar", "my-five-bar").is_ok());
    assert!(matches!(changed("\"map_version\":1", "\"map_version\":2"), Err(MapError::Version { found: 2 })));
    assert!(matches!(changed("\"number\":1", "\"number\":9"), Err(MapError::Unsound(_))));
    assert!(matches!(changed("\"runs\":[[-1,", "\"runs\":[[-1,1],[-1,"), Err(MapError::Unsound(_))));
    assert!(matches!(changed("\"runs\":[[-1,", "\"runs\":[[-2,"), Err(MapError::Unsound(_))));
    assert!(matches!(changed("\"axes\":2", "\"axes\":7"), Err(MapError::Unsound(_))));
    assert!(matches!(changed("\"aspect\":", "\"aspect\":1"), Err(MapError::Unsound(_))));
    assert!(matches!(changed("\"classes\"", "\"classy\""), Err(MapError::Form(_))));
}
