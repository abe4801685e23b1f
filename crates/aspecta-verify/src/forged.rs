//! Files that a forger could write: each was once believed, or could have been.

use super::*;
use crate::certificate::{Claim, Entry, Leaf, Sheet as SheetOfFile, Tree};
use aspecta_robot::chart::Fold;
use aspecta_robot::constraint::Scale;
use aspecta_robot::{Actuator, Leg, LegIndex, Platform, Revolute, Robot, WorkingMode, catalogue};

fn sphere() -> Robot {
    Robot::from_toml(include_str!("../../aspecta/tests/fixtures/sphere.toml"), "sphere.toml").unwrap()
}

/// A certificate of one leaf.
fn one_leaf(robot: &Robot, fix: &[(usize, f64)], mode: WorkingMode, leaf: Leaf, claim: Claim) -> Certificate {
    Certificate {
        certificate_version: crate::certificate::FORMAT_VERSION,
        robot: robot.clone(),
        window: robot.slice(fix).unwrap(),
        modes: vec![mode],
        scale: Scale::ones(robot),
        claims: vec![claim; 2],
        sheets: vec![SheetOfFile { chart: Chart::Pose, tree: Tree(vec![Entry::Leaf(leaf)]) }],
        joins: Vec::new(),
        seams: Vec::new(),
    }
}

fn undecided(robot: &Robot) -> Certificate {
    let leaf = Leaf { undecided: 3, ..Leaf::default() };
    one_leaf(robot, &[], robot.working_modes()[0], leaf, Claim { low: 0, high: None })
}

/// Returns the message about a file that is refused.
fn refusal(certificate: &Certificate) -> String {
    Certificate::from_json(certificate.to_json().unwrap().as_bytes()).unwrap_err().to_string()
}

fn verdict(certificate: &Certificate) -> Verdict {
    let read = Certificate::from_json(certificate.to_json().unwrap().as_bytes()).unwrap();
    verify(&read, &Control::unwatched())
}

/// Where a window cuts roll and yaw it ends at the pole of the pitch too: poses beyond have other rolls and
/// yaws. An aspect may be highest there.
#[test]
fn a_wedge_ends_at_the_pole() {
    let mut robot = sphere();
    let pole = robot.slice(&[]).unwrap().ranges[1].1;
    robot.window = vec![Some((-0.05, 0.05)), Some((1.5, pole)), Some((3.15, 3.25))];
    let everywhere = Leaf { inside: 1, summitless: 1, ..Leaf::default() };
    let mut forged =
        one_leaf(&robot, &[], "+++".parse().unwrap(), everywhere, Claim { low: 0, high: Some(0) });
    // So much that all other functions are the less.
    forged.scale.det = 1e6;
    let verdict = verdict(&forged);
    let faults: Vec<String> = verdict.faults.iter().map(|f| f.in_words(&forged.modes)).collect();
    assert!(faults.iter().any(|fault| fault.contains("claimed summitless, but")), "{faults:?}");
    assert_eq!(forged.window.cut[1], (true, true));
}

/// Beyond the poles all orientations would come once more.
#[test]
fn the_pitch_goes_to_the_poles() {
    let mut robot = sphere();
    let whole = robot.slice(&[]).unwrap();
    robot.window[1] = Some((-3.0, 3.0));
    assert_eq!(robot.slice(&[]).unwrap(), whole);
}

#[test]
fn frames_and_anchors_are_those_of_a_robot() {
    let left_handed = |robot: &mut Robot| robot.legs[0].frame[1] = robot.legs[0].frame[1].map(|x| -x);
    let elsewhere = |robot: &mut Robot| robot.legs[0].anchor[0] = Interval::point(100.0);
    let tilted = |robot: &mut Robot| {
        let (zero, one) = (Interval::point(0.0), Interval::point(1.0));
        let (cos, sin) = (Interval::decimal(0.6), Interval::decimal(0.8));
        robot.legs[0].frame = [[cos, zero, sin], [zero, one, zero], [-sin, zero, cos]];
    };
    let five_bar = catalogue::find("five-bar").unwrap();
    for (robot, change, words) in [
        (sphere(), left_handed as fn(&mut Robot), "not right-handed"),
        (sphere(), elsewhere, "anchor is not the centre"),
        (five_bar, tilted, "does not lie in the plane"),
    ] {
        let mut other = robot.clone();
        change(&mut other);
        assert!(undecided(&robot).sheets.len() == 1 && verdict(&undecided(&robot)).is_verified());
        let said = refusal(&Certificate { robot: other, ..undecided(&robot) });
        assert!(said.contains(words), "{said}");
    }
}

/// The tree of a fold has as many axes as its window: that window must be one before the tree is looked at.
#[test]
fn a_fold_in_a_slice_that_holds_a_translation() {
    let legs = [[0.0, 0.0], [9.0, 0.0]].map(|anchor| Leg::revolute(anchor, [0.0, 0.0], 6.0, 6.0));
    let robot = Robot::new("folding", Platform::PlanePoint, legs.to_vec()).unwrap();
    let Actuator::Revolute(Revolute { crank, rod }) = robot.legs[0].actuator else { unreachable!() };
    let leaf = Leaf { undecided: 3, ..Leaf::default() };
    let mut forged =
        one_leaf(&robot, &[(0, 1.0)], robot.working_modes()[0], leaf, Claim { low: 0, high: None });
    let fold = Fold { leg: LegIndex::new(0), crank, rod, half_width: 0.1, axial: None };
    let tree = Tree(vec![Entry::Split, Entry::Leaf(leaf), Entry::Leaf(leaf)]);
    forged.sheets.push(SheetOfFile { chart: Chart::Fold(fold), tree });
    let verdict = verdict(&forged);
    assert!(verdict.faults[0].reason.contains("a translation is held"), "{:?}", verdict.faults);
}

/// A key that is not known might say something that is not so.
#[test]
fn unknown_keys_are_refused() {
    let text = undecided(&catalogue::find("five-bar").unwrap()).to_json().unwrap();
    for place in
        ["\"robot\":{", "\"legs\":[{", "\"window\":{", "\"scale\":{", "\"crank\":{", "\"actuator\":{"]
    {
        let compact = text.replace([' ', '\n'], "");
        assert!(Certificate::from_json(compact.as_bytes()).is_ok());
        let changed = compact.replacen(place, &format!("{place}\"colour\":1,"), 1);
        assert_ne!(changed, compact, "{place}");
        let error = Certificate::from_json(changed.as_bytes()).unwrap_err().to_string();
        assert!(error.contains("colour"), "{place} {error}");
    }
}

/// Divided by so much, a function is all but zero, and every leaf takes as long as one can take.
#[test]
fn scales_beyond_all_magnitudes_are_refused() {
    let five_bar = undecided(&catalogue::find("five-bar").unwrap());
    // Rows of det A are 10 and 16 long at most.
    let mut forged = five_bar.clone();
    forged.scale.det = 1e308;
    let message = refusal(&forged);
    let told = "scale.det = 1e308: a scale is the mean magnitude of a function";
    assert!(
        message.contains(told) && message.contains("positive numbers up to 1.6e11 are allowed"),
        "{message}"
    );
    for change in [|scale: &mut Scale| scale.det = 1e12, |scale: &mut Scale| scale.reach[1] = 1e14] {
        let mut forged = five_bar.clone();
        change(&mut forged.scale);
        assert!(refusal(&forged).contains("a scale is the mean magnitude"));
    }
    let mut limited = undecided(&catalogue::find("2-prr").unwrap());
    limited.scale.limits[1][0] = 1e200;
    assert!(refusal(&limited).contains("scale.limits[1][0] = 1e200"));
    // What is only too large is slow, and right.
    let mut slow = five_bar;
    slow.scale.det = 1e6;
    assert!(verdict(&slow).is_verified());
}
