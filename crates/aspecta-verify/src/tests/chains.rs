//! Certificates with sheets of folds, of chains and of their bends.

use super::*;
use aspecta_robot::LegIndex;
use aspecta_robot::chart::{Bend, Chain};

/// Returns one mode of a platform that turns about a point.
fn of_mode(mode: &str, text: &str) -> Certificate {
    let robot = Robot::from_toml(text, "a fixture").unwrap();
    let options = Options { modes: vec![mode.parse().unwrap()], certificate: true, ..Options::default() };
    written(&robot, &options)
}

/// All configurations in the joint angles of the first leg.
static SPHERE: LazyLock<Certificate> =
    LazyLock::new(|| of_mode("---", include_str!("../../../aspecta/tests/fixtures/limited_sphere.toml")));
/// The configurations in which the third leg is nearly folded, in its own joint angles.
static BENT: LazyLock<Certificate> =
    LazyLock::new(|| of_mode("-++", include_str!("../../../aspecta/tests/fixtures/folding_sphere.toml")));

#[test]
fn leaves_of_folds_are_checked_too() {
    let verdict = checked(&FOLDED);
    assert!(verdict.is_verified() && verdict.claims.covered > 10, "{verdict:?}");
    // One in each class: no more than it takes, and no fewer.
    assert_eq!(verdict.seams, 2);
    assert!(FOLDED.claims.iter().all(|c| c.high == Some(c.low)), "{:?}", FOLDED.claims);
}

#[test]
fn chains_are_checked() {
    let verdict = checked(&SPHERE);
    assert!(verdict.is_verified() && verdict.claims.covered > 1000, "{verdict:?}");
    assert_eq!(SPHERE.claims, [Claim { low: 2, high: Some(2) }; 2]);
    refuted(&SPHERE, "sheet 1", |c| leaf(c, 1, |leaf| leaf.inside & 3 == 2).inside ^= 3);
    let claims = [
        "claimed to have at least 3 aspects, but proved to have at least 2",
        "claimed to have at most 1 aspect, but proved to have at most 2",
    ];
    all_refuted(&SPHERE, &claims, |c| (c.claims[0].low, c.claims[1].high) = (3, Some(1)));
    let cut = |c: &mut Certificate| c.robot.window[0] = Some((-1.0, 1.0));
    refuted(&SPHERE, "the window is not the one", cut);
}

#[test]
#[ignore = "a minute: a whole check for each fault"]
fn faults_of_chains_are_found_one_by_one() {
    refuted(&SPHERE, "sheet 1", |c| leaf(c, 1, |leaf| leaf.inside & 1 != 0).inside &= !1);
    refuted(&SPHERE, "claimed", |c| {
        c.sheets[1].chart = Chart::Chain(Chain { leg: LegIndex::new(1), bend: None })
    });
    refuted(&SPHERE, "claimed covered, but", |c| c.sheets.truncate(1));
    refuted(&SPHERE, "claimed summitless, but P may have a maximum here", |c| {
        deny_summits(c, 1, !0);
    });
    covers_itself(&SPHERE);
    // Less than the leaves of sheet 1 that are covered need.
    refuted(&BENT, "claimed covered, but", |c| {
        let Chart::Chain(Chain { bend: Some(bend), .. }) = &mut c.sheets[2].chart else { unreachable!() };
        bend.half_width *= 0.5;
    });
}

#[test]
fn bends_are_checked() {
    let verdict = checked(&BENT);
    assert!(verdict.is_verified(), "{:?}", verdict.faults);
    assert_eq!(BENT.claims, [Claim { low: 1, high: Some(1) }; 2]);
    // Nothing of what covers leaves of sheet 1.
    refuted(&BENT, "claimed covered, but", |c| {
        c.sheets.truncate(2);
        c.seams.retain(|seam| seam.sheet < 2);
        c.joins.retain(|join| join.sheet < 2);
    });
    refuted(&BENT, "is not proved to be disjoint", |c| c.sheets.push(c.sheets[2].clone()));
    for (words, change) in [
        ("sheet 1 is that of a chain", (|bend| *bend = None) as fn(&mut Option<Bend>)),
        ("the half-width of a bend", |bend| *bend = Some(Bend { back: true, half_width: 1.5 })),
    ] {
        let mut unsound = BENT.clone();
        let Chart::Chain(chain) = &mut unsound.sheets[2].chart else { unreachable!() };
        change(&mut chain.bend);
        let error = Certificate::from_json(unsound.to_json().unwrap().as_bytes()).unwrap_err();
        assert!(error.to_string().contains(words), "{error}");
    }
}

/// The pieces of a bend hang together with the base by seams; what of them may touch is joined.
#[test]
fn bends_are_joined_with_the_base() {
    let counted = |change: fn(&mut Certificate)| {
        let mut certificate = BENT.clone();
        change(&mut certificate);
        let (sheets, mut verdict) = (sheets(&certificate), Verdict::new(&certificate));
        let (charts, control) = (charts::of(&certificate), Control::unwatched());
        let links = links::check::<3>(&certificate, &sheets, &charts, control.cancelled, &mut verdict);
        count::check::<3>(&certificate, &sheets, &charts, &links, &control, &mut verdict);
        verdict
    };
    let proved = |verdict: Verdict| verdict.classes.iter().map(|class| class.proved).collect::<Vec<_>>();
    assert_eq!(proved(counted(|_| {})), BENT.claims);
    let apart = proved(counted(|c| c.seams.clear()));
    assert!(apart.iter().any(|claim| claim.low == 1 && claim.high > Some(1)), "{apart:?}");
}

/// Six folds, at both ends of each motor's axis, of which the nearest two are 0.04 rad apart: so are their
/// charts.
#[test]
fn bends_are_disjoint() {
    let mut robot =
        Robot::from_toml(include_str!("../../../aspecta/tests/fixtures/folding_sphere.toml"), "").unwrap();
    for (leg, joint) in robot.legs.iter_mut().zip([[0.6, -0.8, 0.0], [0.0, 0.28, -0.96], [-0.96, 0.0, 0.28]])
    {
        let (cos, sin) = (Interval::point(0.0), Interval::point(1.0));
        leg.actuator = aspecta_robot::Spherical { proximal: (cos, sin), distal_cos: cos }.into();
        leg.attachment = joint.map(Interval::point);
    }
    let window = robot.slice(&[]).unwrap();
    let found = aspecta_kinematics::chart::charts(&robot, &window);
    assert_eq!(found.len(), 5);
    let scale = &SPHERE.scale;
    let disjoint = |chart: &Chart, other: &Chart| {
        let setting = Setting::new(&robot, chart, charts::window_of(chart, &window), scale);
        charts::are_disjoint::<3>(&setting, chart, other)
    };
    for (k, chart) in found.iter().enumerate().skip(1) {
        assert!(found[k + 1..].iter().all(|other| disjoint(chart, other)), "{chart:?}");
        assert!(!disjoint(chart, chart) && !disjoint(&found[0], chart));
    }
    let wide = |chart: &Chart| {
        let Chart::Chain(Chain { leg, bend: Some(Bend { back, .. }) }) = *chart else { unreachable!() };
        Chart::Chain(Chain { leg, bend: Some(Bend { back, half_width: 0.9 }) })
    };
    assert!(!disjoint(&wide(&found[1]), &wide(&found[3])));
}

/// Paths in the joint angles of a leg.
#[test]
fn paths_of_chains_are_checked() {
    let all = inside(&SPHERE, 1, 0);
    let (first, last) = (all[0].clone(), all[all.len() - 1].clone());
    let join = |sheet: usize, path: Vec<Vec<f64>>| {
        move |c: &mut Certificate| c.joins.push(Join { class: 0, sheet, path })
    };
    // Where sin ψ = 0 the leg is at its serial singularity.
    let faults = ["is not proved to lie inside the class", "lies in no inside leaf of sheet 1"];
    all_refuted(&SPHERE, &faults, |c| {
        join(1, vec![first.clone(), last.clone()])(c);
        join(1, vec![vec![0.0; 3], last])(c);
    });
    let mut near = SPHERE.clone();
    let beside = first.iter().map(|x| x + 1e-6).collect();
    join(1, vec![first, beside])(&mut near);
    assert!(checked(&near).is_verified());
    let mut beyond = SPHERE.clone();
    join(2, all[..2].to_vec())(&mut beyond);
    let error = Certificate::from_json(beyond.to_json().unwrap().as_bytes()).unwrap_err();
    assert!(error.to_string().contains("sheet of a join 2"), "{error}");
}

#[test]
fn a_chain_needs_all_orientations() {
    let mut cut = SPHERE.clone();
    cut.window.cut[1] = (true, false);
    let error = Certificate::from_json(cut.to_json().unwrap().as_bytes()).unwrap_err();
    assert!(error.to_string().contains("a chain holds all orientations"), "{error}");
    let mut legless = SPHERE.clone();
    legless.sheets[1].chart = Chart::Chain(Chain { leg: LegIndex::new(3), bend: None });
    let error = Certificate::from_json(legless.to_json().unwrap().as_bytes()).unwrap_err();
    assert!(error.to_string().contains("leg of a chain 3"), "{error}");
}

#[test]
fn no_chart_covers_itself() {
    covers_itself(&FOLDED);
}

/// No chart covers its own leaves, or nothing would be left to count.
#[track_caller]
fn covers_itself(certificate: &Certificate) {
    refuted(certificate, "claimed covered, but", |c| {
        for entry in c.sheets.iter_mut().skip(1).flat_map(|sheet| &mut sheet.tree.0) {
            if let Entry::Leaf(leaf) = entry {
                leaf.covered = true;
            }
        }
        c.claims.fill(Claim { low: 0, high: Some(0) });
    });
}
