//! Pictures of joint space.

use super::Case;
use super::maps::{areas, set};
use crate::common::{analysis, five_bar};
use aspecta::Kinematics;
use aspecta::aspect::{AspectId, DetSign};
use aspecta::domain::RegionId;
use aspecta::robot::LegIndex;
use aspecta_view::figure::components::{JointSpace, Section};
use aspecta_view::figure::joints::components;
use aspecta_view::figure::palette::{SINGLE, UNDECIDED};
use aspecta_view::figure::stack::stack;
use roxmltree::Document;
use std::collections::BTreeSet;
use std::sync::LazyLock;

/// Ten regions; found once for all tests.
static CASE: LazyLock<Case> = LazyLock::new(|| Case::three_rpr(80, 24));

/// The texts of a picture.
fn texts(svg: &str) -> Vec<String> {
    let document = Document::parse(svg).unwrap();
    let texts = document.descendants().filter(|n| n.has_tag_name("text"));
    texts.filter_map(|n| n.text().map(str::to_owned)).collect()
}

/// The regions of a component and its n, as the legend has it: `regions 2, 3: n = 2`.
fn component(text: &str) -> Option<(Vec<usize>, usize)> {
    let (regions, n) = text.strip_prefix("region")?.trim_start_matches('s').split_once(": n = ")?;
    Some((regions.trim().split(", ").map(|r| r.parse().unwrap()).collect(), n.parse().unwrap()))
}

/// As many direct solutions in the aspect as the direct model says.
fn count(case: &Case, q: [f64; 3]) -> usize {
    assert_eq!(case.domains.det_a, DetSign::Positive);
    let solutions = case.map.robot.direct(&q).unwrap();
    solutions.iter().filter(|s| s.within_limits && s.det_a > 0.0).count()
}

/// The joint vector at a place of the pictures, in which q₃ is held.
fn place(space: &JointSpace<'_>, column: f64, row: f64, pixels: usize, at: f64) -> [f64; 3] {
    let along = |k: usize, part: f64| space.axes[k].range.0 + space.axes[k].span() * part / pixels as f64;
    [along(0, column), along(1, row), at]
}

const PIXELS: usize = 40;

fn section(space: &JointSpace<'_>, at: f64) -> Section {
    space.section(at, PIXELS)
}

#[test]
fn coincident_components_have_one_colour_and_one_entry() {
    let cut = CASE.cut();
    let svg = components(&JointSpace::new(&cut, LegIndex::new(2)).unwrap());
    let entries: Vec<_> = texts(&svg).iter().filter_map(|text| component(text)).collect();
    let mut regions: Vec<usize> = entries.iter().flat_map(|(regions, _)| regions.clone()).collect();
    regions.sort_unstable();
    assert_eq!(regions, (1..=10).collect::<Vec<_>>());
    for (regions, n) in &entries {
        assert!(regions.iter().all(|r| usize::from(CASE.domains.regions[r - 1].solutions) == *n));
        let together = |a: &usize| {
            regions.iter().all(|b| a == b || CASE.domains.coincide(RegionId::new(*a), RegionId::new(*b)))
        };
        assert!(regions.iter().all(together) && regions.len() == *n, "{regions:?}: n = {n}");
    }
    let colours: BTreeSet<String> = &areas(&svg) - &set([UNDECIDED]);
    assert_eq!(colours.len(), entries.len());
    assert!(colours.contains(SINGLE));
    assert_eq!(texts(&svg).iter().filter(|text| text.starts_with("q₃ = ")).count(), 12);
}

#[test]
fn any_joint_can_be_held() {
    let cut = CASE.cut();
    for (held, axes) in [(0, ["q₂ [unit]", "q₃ [unit]"]), (1, ["q₁ [unit]", "q₃ [unit]"])] {
        let space = JointSpace::new(&cut, LegIndex::new(held)).unwrap();
        assert_eq!([&space.axes[0].label, &space.axes[1].label], axes);
        // The same joint vector, whichever joint is held: the middle of the range of all.
        let [first, second] = [0, 1].map(|k| 0.5 * (space.axes[k].range.0 + space.axes[k].range.1));
        let at = 20.0;
        let q = if held == 0 { [at, first, second] } else { [first, at, second] };
        let around = space.section(at, 3);
        assert_eq!(around.sets[around.raster.at(1, 1) as usize].len(), count(&CASE, q));
    }
}

/// What lies over a joint vector is what the direct model finds.
#[test]
fn sections_count_direct_solutions() {
    let cut = CASE.cut();
    let space = JointSpace::new(&cut, LegIndex::new(2)).unwrap();
    let mut seen = BTreeSet::new();
    for at in [12.3, 18.2, 21.7] {
        let section = section(&space, at);
        for pixel in 0..PIXELS * PIXELS {
            let (column, row) = (pixel % PIXELS, pixel / PIXELS);
            let q = place(&space, column as f64 + 0.5, row as f64 + 0.5, PIXELS, at);
            let set = &section.sets[section.raster.at(column, row) as usize];
            assert_eq!(set.len(), count(&CASE, q), "{q:?}");
            seen.insert(set.len());
        }
    }
    assert_eq!(seen, BTreeSet::from([0, 1, 2, 3]));
}

/// Across a line the number of direct solutions changes, within a hundredth of a pixel.
#[test]
fn lines_are_where_the_count_changes() {
    let cut = CASE.cut();
    let space = JointSpace::new(&cut, LegIndex::new(2)).unwrap();
    let at = 18.2;
    let lines = space.changes(&section(&space, at), at);
    assert!(lines.iter().flatten().count() > 100);
    let width = [0, 1].map(|k| 0.01 * space.axes[k].span() / PIXELS as f64);
    for &[x, y] in lines.iter().flatten() {
        let counts = [(-1.0, 0.0), (1.0, 0.0), (0.0, -1.0), (0.0, 1.0)]
            .map(|(i, j)| count(&CASE, [x + i * width[0], y + j * width[1], at]));
        assert!(counts.iter().any(|n| *n != counts[0]), "{counts:?} at {x} {y}");
    }
}

/// A sheet for each direct solution, a dot for each sheet over a joint vector.
#[test]
fn as_many_sheets_lie_over_each_other_as_there_are_solutions() {
    let cut = CASE.cut();
    let svg = stack(&JointSpace::new(&cut, LegIndex::new(2)).unwrap());
    let texts = texts(&svg);
    let sheets = texts.iter().filter(|text| text.starts_with("sheet ") && text.len() == 7).count();
    let marked: Vec<usize> = texts.iter().filter_map(|t| t.strip_prefix("n = ")?.parse().ok()).collect();
    let most = CASE.domains.regions.iter().map(|r| usize::from(r.solutions)).max();
    assert_eq!((Some(sheets), marked.iter().copied().max()), (most, most));
    assert_eq!(svg.matches("<circle").count(), marked.iter().sum::<usize>());
}

/// It has two joints: a map, not sections; one region, one sheet.
#[test]
fn the_five_bar_has_a_map_and_one_sheet() {
    let case = Case::new(analysis(&five_bar(), 9), AspectId::new(1), 200, 200);
    let cut = case.cut();
    let space = JointSpace::new(&cut, LegIndex::new(2)).unwrap();
    assert!(space.held.is_none());
    let (map, sheets) = (components(&space), stack(&space));
    for svg in [&map, &sheets] {
        assert_eq!(&areas(svg) - &set([UNDECIDED]), set([SINGLE]));
        assert!(svg.contains("q₁ [rad]") && svg.contains("q₂ [rad]") && !svg.contains("q₃"));
    }
    assert!(texts(&map).contains(&"region 1: n = 1".to_owned()));
    assert!(sheets.contains("sheet 1<") && !sheets.contains("sheet 2<"));
}
