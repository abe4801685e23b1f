use super::*;
use crate::num::{Jet, Random, dot};
use std::fs;
use std::path::Path;

/// A leg of each kind.
fn sample(kind: Kind) -> Actuator {
    let length = Interval::decimal;
    match kind {
        Kind::Revolute => Revolute { crank: length(0.75), rod: length(1.25) }.into(),
        Kind::Prismatic => Prismatic { rod: length(1.5) }.into(),
        Kind::Strut => Strut.into(),
        Kind::Spherical => {
            Spherical { proximal: (length(0.6), length(0.8)), distal_cos: length(0.28) }.into()
        }
    }
}

fn norm<const D: usize>(v: &[f64; D]) -> f64 {
    dot(v, v).sqrt()
}

/// Asserts that the answers of a kind agree: equation, elimination, drive, norms and places.
fn check<const D: usize>(kind: Kind, random: &mut Random) -> usize {
    let actuator = sample(kind);
    let near = |what: &str, a: f64, b: f64| assert!((a - b).abs() < 1e-9, "{kind:?} {what}: {a} {b}");
    let mut compared = 0;
    for _ in 0..200 {
        let mut d: [f64; D] = std::array::from_fn(|_| random.within((-2.0, 2.0)));
        if kind.facts().is_on_sphere {
            let length = norm(&d);
            d = d.map(|x| x / length);
        }
        let closure = actuator.eliminate(&d);
        // Near the fold the posture is lost in rounding.
        if closure.reach < 1e-3 || closure.weight < 1e-3 {
            assert!(closure.reach > 1e-3 || kind.facts().postures == 2);
            continue;
        }
        for s in if kind.facts().postures == 2 { vec![1.0, -1.0] } else { vec![-1.0] } {
            let sh = s * closure.reach.sqrt();
            let drive = actuator.drive(&d, &closure, sh);
            assert_eq!(matches!(drive, Drive::Angle { .. }), actuator.is_angle());
            let q = drive.value();
            let jets: [Jet<f64, 4>; D] = std::array::from_fn(|k| Jet::variable(d[k], k));
            let f = actuator.equation(&jets, Jet::variable(q, 3));
            near("f", f.value, 0.0);
            near("s h", actuator.signed_height(f.gradient[3]), sh);
            let gradient: [f64; D] = std::array::from_fn(|k| f.gradient[k]);
            near("force", actuator.force(&gradient), norm(&gradient));
            near("row", actuator.row_length(&closure), closure.weight * norm(&gradient));
            for k in 0..D {
                let row = closure.fixed[k] + sh * closure.swing[k];
                near("gradient", row, closure.weight * gradient[k]);
            }
            near("gap", actuator.gap(&d), 0.0);
            match actuator.locked::<D>(Interval::point(q)) {
                LockedEnd::Sphere { centre, radius } => {
                    let rod: [f64; D] = std::array::from_fn(|k| d[k] - centre[k].mid());
                    near("radius", norm(&rod), radius.mid());
                }
                LockedEnd::Cone { axis, cosine } => {
                    near("cone", dot(&axis.map(Interval::mid), &d), cosine.mid())
                }
            }
            compared += 1;
        }
    }
    compared
}

#[test]
fn what_a_kind_says_of_itself_fits_together() {
    let mut random = Random::new(19);
    for &kind in Kind::ALL {
        assert_eq!(sample(kind).kind(), kind);
        assert!(check::<3>(kind, &mut random) > 50);
        if !kind.facts().is_on_sphere {
            assert!(check::<2>(kind, &mut random) > 50);
        }
    }
}

/// Certificates and maps hold legs in this form.
#[test]
fn actuators_are_written_with_their_kind_and_no_other_keys() {
    for &kind in Kind::ALL {
        let written = serde_json::to_value(sample(kind)).unwrap();
        assert_eq!(written["kind"], kind.name());
        assert_eq!(serde_json::to_value(kind).unwrap(), kind.name());
        let read: Actuator = serde_json::from_value(written.clone()).unwrap();
        assert_eq!(read, sample(kind));
        let mut more = written;
        more["colour"] = 1.into();
        assert!(serde_json::from_value::<Actuator>(more).is_err(), "{kind:?}");
    }
    assert_eq!(serde_json::to_string(&sample(Kind::Strut)).unwrap(), r#"{"kind":"strut"}"#);
}

fn sources(folder: &Path, visit: &mut impl FnMut(&str, &str)) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, visit);
        } else if path.extension().is_some_and(|e| e == "rs") {
            let name = path.to_string_lossy().replace('\\', "/");
            visit(&name, &fs::read_to_string(&path).unwrap());
        }
    }
}

/// A kind is added in this room and in the checker, which has formulas of its own and decides of every kind by a `match`
/// without a wildcard (`clippy::wildcard_enum_match_arm`). Nobody else names one.
#[test]
fn kinds_are_named_here_and_by_the_checker_only() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let mut read = 0;
    for member in fs::read_dir(crates).unwrap() {
        sources(&member.unwrap().path().join("src"), &mut |name, text| {
            read += 1;
            let code: Vec<&str> = text.lines().filter(|line| !line.trim_start().starts_with("//")).collect();
            let text = code.join("\n");
            let named = Kind::ALL.iter().any(|kind| {
                [format!("Actuator::{kind:?}"), format!("Kind::{kind:?}")]
                    .iter()
                    .any(|word| text.contains(word))
            });
            let in_checker = ["/aspecta-verify/", "/sound.rs"].iter().any(|room| name.contains(room));
            assert!(!named || in_checker || name.contains("/legs/"), "{name} asks of which kind a leg is");
            let is_test = name.contains("tests") || name.ends_with("forged.rs");
            for skipping in ["let Actuator::", "matches!(leg.actuator", "matches!(actuator"] {
                let skips = in_checker && !is_test && text.contains(skipping);
                assert!(!skips, "{name}: `{skipping}` would skip a new kind of leg silently");
            }
        });
    }
    assert!(read > 200, "{read}");
}

/// Of all that a leg is asked, the checker asks for the leg equation alone: the rest is forbidden it.
#[test]
fn the_checker_may_use_the_leg_equation_alone() {
    let forbidden = Path::new(env!("CARGO_MANIFEST_DIR")).join("../aspecta-verify/clippy.toml");
    let forbidden = fs::read_to_string(forbidden).unwrap();
    let questions = include_str!("mod.rs").split("\nquestions! {").nth(1).unwrap();
    let questions = questions.split("\n}\n").next().unwrap();
    let names: Vec<_> =
        questions.lines().filter_map(|line| line.strip_prefix("    fn ")?.split(['(', '[']).next()).collect();
    assert!(names.len() > 20 && names.contains(&"eliminate"), "{names:?}");
    for name in names {
        let may = name == "equation_turned";
        assert_ne!(forbidden.contains(&format!("\"aspecta_robot::legs::Actuator::{name}\"")), may, "{name}");
    }
}
