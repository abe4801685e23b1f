//! Certificates that hold, and certificates with planted faults.

mod chains;
mod planted;
mod summits;

use super::*;
use crate::certificate::{Claim, Entry, Join, Leaf};
use aspecta::aspect::{Options, Purpose, analyze};
use aspecta::paving::Budget;
use aspecta_robot::ClassSet;
use aspecta_robot::constraint::Constraint;
use aspecta_robot::num::Scalar;
use aspecta_robot::{Leg as RobotLeg, LegIndex, Limit, Platform, Revolute, Robot, WorkingMode, catalogue};
use proptest::prelude::*;
use std::sync::LazyLock;
use std::sync::atomic::AtomicBool;

/// A certificate that the library wrote, read as any other is. (Under test this crate has types of its own.)
fn written(robot: &Robot, options: &Options) -> Certificate {
    let certificate = analyze(robot, options, &Control::unwatched()).unwrap().certificate.unwrap();
    Certificate::from_json(certificate.to_json().unwrap().as_bytes()).unwrap()
}

fn parsed(modes: &[&str]) -> Vec<WorkingMode> {
    modes.iter().map(|mode| mode.parse().unwrap()).collect()
}

fn checked(certificate: &Certificate) -> Verdict {
    verify(certificate, &Control::unwatched())
}

/// A certificate of some modes (of all, if none is named) that claims the most that its leaves and links prove.
fn certify(robot: &Robot, modes: &[&str], depth: Option<u32>) -> Certificate {
    let (budget, modes) = (Budget { depth, ..Budget::default() }, parsed(modes));
    let mut certificate = written(robot, &Options { budget, modes, certificate: true, ..Options::default() });
    certificate.claims.fill(Claim { low: 0, high: None });
    let verdict = checked(&certificate);
    assert!(verdict.is_verified(), "{:?}", verdict.faults);
    certificate.claims = verdict.classes.iter().map(|c| c.proved).collect();
    certificate
}

fn five_bar() -> Robot {
    catalogue::find("five-bar").unwrap()
}

/// One mode, of which a class has two aspects: a fault is checked in a quarter of the time that it takes in all.
static FIVE_BAR: LazyLock<Certificate> = LazyLock::new(|| certify(&five_bar(), &["+-"], None));
/// Few leaves, and no upper bounds.
static COARSE: LazyLock<Certificate> = LazyLock::new(|| certify(&five_bar(), &[], Some(5)));
/// The first leg can fold up.
static FOLDED: LazyLock<Certificate> = LazyLock::new(|| {
    let legs = vec![
        RobotLeg::revolute([0.0, 0.0], [0.0, 0.0], 6.0, 6.0),
        RobotLeg::revolute([9.0, 0.0], [0.0, 0.0], 5.0, 7.0),
    ];
    certify(&Robot::new("folding", Platform::PlanePoint, legs).unwrap(), &["++"], None)
});

/// The first leaf of a sheet that fits, to be changed.
fn leaf(certificate: &mut Certificate, sheet: usize, fits: impl Fn(&Leaf) -> bool) -> &mut Leaf {
    let entries = certificate.sheets[sheet].tree.0.iter_mut();
    let leaves = entries.filter_map(|entry| if let Entry::Leaf(leaf) = entry { Some(leaf) } else { None });
    leaves.into_iter().find(|leaf| fits(leaf)).unwrap()
}

/// Claims that no inside leaf of a sheet holds a summit of these classes.
fn deny_summits(certificate: &mut Certificate, sheet: usize, classes: ClassSet) {
    for entry in &mut certificate.sheets[sheet].tree.0 {
        if let Entry::Leaf(leaf) = entry {
            leaf.summitless |= leaf.inside & classes;
        }
    }
}

/// The middles of the leaves of a sheet that are inside a class.
fn inside(certificate: &Certificate, sheet: usize, class: usize) -> Vec<Vec<f64>> {
    let sheet = &certificate.sheets[sheet];
    let cells = Cells::new(&sheet.tree, charts::window_of(&sheet.chart, &certificate.window));
    let is_inside = |k: &usize| cells.leaves[*k].claims.inside >> class & 1 == 1;
    let middle = |k: usize| cells.of(k)[..certificate.robot.dof()].iter().map(|x| x.mid()).collect();
    (0..cells.leaves.len()).filter(is_inside).map(middle).collect()
}

/// The verdict on a changed certificate is that it is wrong, for a reason that holds these words.
#[track_caller]
fn refuted(original: &Certificate, words: &str, change: impl FnOnce(&mut Certificate)) {
    all_refuted(original, &[words], change);
}

/// The verdict on a certificate with several faults holds these words of each: one check instead of many.
#[track_caller]
fn all_refuted(original: &Certificate, words: &[&str], change: impl FnOnce(&mut Certificate)) {
    let mut certificate = original.clone();
    change(&mut certificate);
    let read = Certificate::from_json(certificate.to_json().unwrap().as_bytes()).unwrap();
    let verdict = checked(&read);
    assert!(verdict.complete && !verdict.is_verified());
    let found: Vec<String> = verdict.faults.iter().map(|f| f.in_words(&read.modes)).collect();
    for words in words {
        assert!(found.iter().any(|fault| fault.contains(words)), "{words}: {found:#?}");
    }
}

#[test]
fn ten_aspects_of_the_five_bar() {
    let exact = |n: usize| Claim { low: n, high: Some(n) };
    let certificate = certify(&five_bar(), &[], None);
    assert_eq!(certificate.claims, [1, 1, 1, 2, 1, 1, 2, 1].map(exact));
    assert_eq!(FIVE_BAR.claims, [1, 2].map(exact));
    let read = Certificate::from_json(certificate.to_json().unwrap().as_bytes()).unwrap();
    assert_eq!(read, certificate);
    let verdict = checked(&read);
    assert!(verdict.is_verified());
    assert!(verdict.claims.inside > 1000 && verdict.claims.summitless > 1000, "{:?}", verdict.claims);
}

#[test]
fn the_sign_of_a_leaf_is_checked() {
    refuted(&COARSE, "claimed", |c| leaf(c, 0, |leaf| leaf.inside & 1 != 0).inside ^= 3);
    refuted(&FOLDED, "sheet 1", |c| leaf(c, 1, |leaf| leaf.inside & 3 == 2).inside ^= 3);
}

#[test]
fn inside_and_outside_are_checked() {
    refuted(&COARSE, "sheet 0, leaf 0, class 4 (--, det A > 0): claimed inside, but it is not", |c| {
        leaf(c, 0, |leaf| leaf.undecided == 0).inside |= 1 << 4;
    });
    refuted(&COARSE, "claimed outside, but", |c| {
        leaf(c, 0, |leaf| leaf.undecided & 4 != 0 && leaf.inside == 0).undecided &= !4;
    });
    refuted(&COARSE, "claimed inside, but", |c| {
        leaf(c, 0, |leaf| leaf.undecided & 4 != 0).inside |= 4;
    });
    refuted(&FOLDED, "sheet 1", |c| {
        leaf(c, 1, |leaf| leaf.inside & 1 != 0).inside &= !1;
    });
}

/// A whole quarter of the window replaced by one leaf outside of everything.
#[test]
fn a_subtree_that_is_cut_is_missed() {
    let cut = |c: &mut Certificate| {
        let entries = &mut c.sheets[0].tree.0;
        let (mut open, mut end) = (1, 1);
        while open > 0 {
            open = if entries[end] == Entry::Split { open + 3 } else { open - 1 };
            end += 1;
        }
        entries.splice(1..end, [Entry::Leaf(Leaf::default())]);
    };
    refuted(&COARSE, "claimed outside, but", cut);
    let mut shorter = COARSE.clone();
    shorter.sheets[0].tree.0.remove(5);
    assert!(Certificate::from_json(shorter.to_json().unwrap().as_bytes()).is_err());
}

#[test]
fn a_summit_cannot_be_argued_away() {
    refuted(&FIVE_BAR, "claimed summitless, but P may have a maximum here", |c| {
        deny_summits(c, 0, 1);
        c.claims[0] = Claim { low: 0, high: Some(0) };
    });
}

#[test]
fn paths_are_checked() {
    // The two aspects of +- with det A < 0 are parted by singularities.
    let class = 1;
    let all = inside(&FIVE_BAR, 0, class);
    let (first, last) = (all[0].clone(), all[all.len() - 1].clone());
    let join = |path: Vec<Vec<f64>>| move |c: &mut Certificate| c.joins.push(Join { class, sheet: 0, path });
    refuted(&FIVE_BAR, "is not proved to lie inside the class", join(vec![first.clone(), last.clone()]));
    let nowhere = vec![FIVE_BAR.window.ranges[0].0, 0.0];
    refuted(&FIVE_BAR, "lies in no inside leaf", join(vec![nowhere, last.clone()]));
    refuted(&FIVE_BAR, "beyond the window", join(vec![first, vec![1e3, 0.0], last]));
}

#[test]
fn good_paths_are_accepted() {
    let all = inside(&COARSE, 0, 0);
    let mut longer = COARSE.clone();
    longer.joins.push(Join { class: 0, sheet: 0, path: all[..2].to_vec() });
    let verdict = checked(&longer);
    assert!(verdict.is_verified(), "{:?}", verdict.faults);
}

#[test]
fn seams_are_checked() {
    refuted(&FOLDED, "but proved to have at most", |c| c.seams.clear());
    refuted(&FOLDED, "seam 0: the point lies in no inside leaf", |c| c.seams[0].class ^= 1);
    refuted(&FOLDED, "it is not proved to lie in an inside leaf of sheet 0 as well", |c| {
        let bit = 1 << c.seams[0].class;
        for entry in &mut c.sheets[0].tree.0 {
            if let Entry::Leaf(leaf) = entry {
                leaf.undecided |= leaf.inside & bit;
                leaf.inside &= !bit;
            }
        }
    });
}

#[test]
fn bounds_are_checked() {
    let few = "claimed to have at least 3 aspects, but proved to have at least 2";
    refuted(&FIVE_BAR, few, |c| c.claims[1].low = 3);
    refuted(&FIVE_BAR, "claimed to have at most 1 aspect, but proved to have at most 2", |c| {
        c.claims[1].high = Some(1)
    });
    refuted(&COARSE, "but leaves are undecided", |c| c.claims[0].high = Some(1));
    let mut weaker = FIVE_BAR.clone();
    weaker.claims[1] = Claim { low: 1, high: Some(7) };
    assert!(checked(&weaker).is_verified());
}

/// A claim that is proved wrong is told from one that is only not proved.
#[test]
fn wrong_claims_are_told_from_unproved_ones() {
    let verdict = |original: &Certificate, change: fn(&mut Certificate)| {
        let mut certificate = original.clone();
        change(&mut certificate);
        let verdict = checked(&certificate);
        assert!(!verdict.faults.is_empty());
        verdict
    };
    let wrong = |original, change| assert!(verdict(original, change).is_refuted());
    let unproved = |original, change| assert!(!verdict(original, change).is_refuted());
    // Class 1 has two aspects.
    wrong(&FIVE_BAR, |c| c.claims[1].low = 3);
    wrong(&FIVE_BAR, |c| c.claims[1].high = Some(1));
    wrong(&COARSE, |c| leaf(c, 0, |leaf| leaf.undecided == 0).inside |= 1 << 4);
    wrong(&COARSE, |c| c.window.ranges[0].0 += 1.0);
    unproved(&COARSE, |c| c.claims[0].low = 3);
    unproved(&COARSE, |c| c.claims[0].high = Some(1));
    unproved(&FOLDED, |c| c.seams.clear());
    unproved(&FIVE_BAR, |c| deny_summits(c, 0, 1));
}

#[test]
fn covered_leaves_are_covered() {
    refuted(&COARSE, "claimed covered, but", |c| {
        leaf(c, 0, |leaf| leaf.inside != 0).covered = true;
    });
    refuted(&FOLDED, "claimed covered, but", |c| {
        leaf(c, 0, |leaf| !leaf.covered && leaf.inside != 0).covered = true;
    });
}

#[test]
fn another_robot_has_other_aspects() {
    refuted(&COARSE, "the window is not the one", |c| {
        c.robot.legs[0].actuator = Revolute { crank: Interval::point(8.5), rod: Interval::point(5.0) }.into();
    });
    // As long in all as before: the same window.
    refuted(&COARSE, "claimed", |c| {
        c.robot.legs[0].actuator = Revolute { crank: Interval::point(7.5), rod: Interval::point(5.5) }.into();
    });
    refuted(&FOLDED, "lengths of the fold", |c| {
        c.robot.legs[0].actuator = Revolute { crank: Interval::point(6.5), rod: Interval::point(5.5) }.into();
    });
    refuted(&COARSE, "the window is not the one", |c| c.window.ranges[0].0 += 1.0);
}

/// All kinds of legs and platforms: two programs agree on what is inside, outside and summitless.
#[test]
fn robots_of_the_catalogue() {
    let names = catalogue::all().iter().map(|entry| entry.name);
    for robot in names.filter_map(catalogue::find).filter(|robot| robot.dof() <= 3) {
        let depth = Some(if robot.dof() == 2 { 5 } else { 3 });
        let certificate = certify(&robot, &[], depth);
        let leaves = certificate.sheets[0].tree.0.len();
        assert!(leaves > 100, "{}: {leaves}", robot.name);
    }
}

fn certified_slice(name: &str, fix: Vec<(usize, f64)>, modes: &[&str], budget: Budget) -> Certificate {
    let options = Options { budget, fix, modes: parsed(modes), certificate: true, purpose: Purpose::Numbers };
    written(&catalogue::find(name).unwrap(), &options)
}

/// Where a leg stretches out to its limit of reach and its q counts as a coordinate of its own, det A has to
/// be counted from the middle of q.
#[test]
fn leaves_at_a_limit_of_reach_are_proved() {
    let budget = Budget { depth: Some(10), ..Budget::default() };
    let verdict = checked(&certified_slice("delta", vec![(2, -900.0)], &["+-+"], budget));
    assert!(verdict.is_verified(), "{:?}", verdict.faults);
}

/// A slice of a free body, in its working modes `modes`, verified, with faults planted in it.
fn check_slice(name: &str, fix: Vec<(usize, f64)>, modes: &[&str]) -> Certificate {
    let certificate = certified_slice(name, fix, modes, Budget::default());
    assert!(checked(&certificate).is_verified());
    refuted(&certificate, "claimed", |c| leaf(c, 0, |leaf| leaf.inside & 3 == 2).inside ^= 3);
    refuted(&certificate, "the window is not the one", |c| c.window.cut[0].0 ^= true);
    certificate
}

/// Six rows in A: struts and two coordinates that vary, cranks and one.
#[test]
fn slices_of_free_bodies_are_checked() {
    let exact = |n: usize| Claim { low: n, high: Some(n) };
    let struts = check_slice("gough-stewart", vec![(2, 0.8), (3, 0.1), (4, 0.0), (5, 0.0)], &["------"]);
    assert_eq!(struts.claims, [1, 1].map(exact));
    let held = vec![(1, 20.0), (2, -600.0), (3, 0.0), (4, 0.1), (5, 0.0)];
    let cranks = check_slice("hexa", held, &["-+-+-+", "+-++++"]);
    assert_eq!(cranks.claims, [1, 2, 1, 1].map(exact));
    refuted(&cranks, "claimed summitless, but P may have a maximum here", |c| deny_summits(c, 0, 1));
}

#[test]
fn more_than_three_coordinates_are_not_boxes() {
    let mut wide = COARSE.clone();
    wide.robot = catalogue::find("gough-stewart").unwrap();
    wide.window = wide.robot.slice(&[]).unwrap();
    let error = Certificate::from_json(wide.to_json().unwrap().as_bytes()).unwrap_err();
    assert!(error.to_string().contains("more than three coordinates of the window vary"), "{error}");
}

/// A pair of narrow enclosures of the cosine and the sine.
fn direction(angle: f64) -> (Interval, Interval) {
    let (sin, cos) = Interval::point(angle).sin_cos();
    (cos, sin)
}

#[test]
fn limits_of_all_kinds_in_the_plane() {
    let mut robot = five_bar();
    let (middle, half_cos) = (direction(1.2), direction(1.5).0);
    let (x, y) = direction(0.4);
    let axis = [x, y, Interval::point(0.0)];
    let wide = direction(2.0).0;
    for (leg, limits) in robot.legs.iter_mut().zip([
        vec![Limit::ActuatorAngle { middle, half_cos, turns: 0 }, Limit::BaseCone { axis, half_cos: wide }],
        vec![Limit::Elbow { middle, half_cos: wide }, Limit::PlatformCone { axis, half_cos: wide }],
    ]) {
        leg.limits = limits;
    }
    let certificate = certify(&robot, &[], Some(6));
    assert!(checked(&certificate).claims.inside > 20);
    refuted(&certificate, "claimed", |c| {
        c.robot.legs[0].limits[0] = Limit::ActuatorAngle { middle: direction(1.6), half_cos, turns: 0 };
    });
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// A leaf that is outside is not inside, and the other way round, whichever leaf and class it is.
    #[test]
    fn flipped_bits_are_found(place in any::<prop::sample::Index>(), class in 0..8usize) {
        let bit = 1 << class;
        let mut certificate = COARSE.clone();
        let decided = |entry: &&mut Entry| matches!(entry, Entry::Leaf(leaf) if leaf.undecided & bit == 0);
        let mut leaves: Vec<&mut Entry> = certificate.sheets[0].tree.0.iter_mut().filter(|e| decided(e)).collect();
        let chosen = place.index(leaves.len());
        if let Entry::Leaf(leaf) = &mut *leaves[chosen] {
            leaf.inside ^= bit;
        }
        prop_assert!(!checked(&certificate).is_verified());
    }

    /// Whatever becomes of a byte, the file is refused, or it is read and checked without a panic.
    #[test]
    fn damaged_files_are_survived(place in any::<prop::sample::Index>(), byte in any::<u8>()) {
        let mut text = COARSE.to_json().unwrap().into_bytes();
        let at = place.index(text.len());
        text[at] = byte;
        if let Ok(certificate) = Certificate::from_json(&text) {
            let _ = checked(&certificate);
        }
    }

    #[test]
    fn noise_is_refused(noise in prop::collection::vec(any::<u8>(), 0..300)) {
        prop_assert!(Certificate::from_json(&noise).is_err());
    }
}

#[test]
fn truncated_files_are_refused() {
    let text = COARSE.to_json().unwrap();
    for k in 0..20 {
        assert!(Certificate::from_json(&text.as_bytes()[..text.len() * k / 20]).is_err());
    }
}

#[test]
fn a_cancelled_check_proves_nothing() {
    let verdict = verify(&COARSE, &Control { cancelled: &AtomicBool::new(true), progress: &|_| {} });
    assert!(!verdict.complete && !verdict.is_verified());
}

/// The list that the search and this program share forgets no leg and no limit: nothing here would notice.
#[test]
fn every_leg_and_limit_is_listed() {
    let sphere = include_str!("../../aspecta/tests/fixtures/limited_sphere.toml");
    let limited = Robot::from_toml(sphere, "limited_sphere.toml").unwrap();
    let known = catalogue::all().iter().map(|entry| catalogue::find(entry.name).unwrap());
    for robot in known.chain([limited]) {
        let mut expected = vec![Constraint::Det];
        for (j, leg) in robot.legs.iter().enumerate() {
            expected.extend((leg.actuator.postures() == 2).then_some(Constraint::Reach(LegIndex::new(j))));
            expected.extend((0..leg.limits.len()).map(|k| Constraint::Limit(LegIndex::new(j), k)));
        }
        let listed: Vec<_> = Constraint::of(&robot).collect();
        assert_eq!(listed.len(), expected.len(), "{}", robot.name);
        assert!(expected.iter().all(|constraint| listed.contains(constraint)), "{}: {listed:?}", robot.name);
    }
}
