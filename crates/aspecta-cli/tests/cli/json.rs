//! The JSON that scripts rely on.

use crate::{json, numbers, output};
use serde_json::Value;

/// The keys of a solution, in the contract of `ik` and `fk`.
const SOLUTION: [&str; 7] = ["pose", "q", "mode", "det_a", "residual", "certified", "within_limits"];

fn solutions(document: &Value) -> &Vec<Value> {
    assert_eq!(document["format_version"], 1);
    let solutions = document["solutions"].as_array().expect("solutions");
    for s in solutions {
        let object = s.as_object().expect("an object");
        assert!(SOLUTION.iter().all(|key| object.contains_key(*key)), "{s}");
    }
    solutions
}

/// (7): both distances of the five-bar, from the angles printed.
fn five_bar_lengths(pose: &[f64], q: &[f64]) -> [f64; 2] {
    let [x, y] = [pose[0], pose[1]];
    [
        (x - 8.0 * q[0].cos()).hypot(y - 8.0 * q[0].sin()),
        (x - 9.0 - 5.0 * q[1].cos()).hypot(y - 5.0 * q[1].sin()),
    ]
}

#[test]
fn ik_of_the_five_bar() {
    let document = json("ik five-bar --pose 4,7 --json");
    assert_eq!(document["robot"], "five-bar");
    assert_eq!(
        (&document["length_unit"], &document["angle_unit"]),
        (&Value::from("unit"), &Value::from("rad"))
    );
    let found = solutions(&document);
    let modes: Vec<_> = found.iter().map(|s| s["mode"].as_str().unwrap()).collect();
    assert_eq!(modes, ["++", "+-", "--", "-+"]);
    for s in found {
        assert_eq!(numbers(&s["pose"]), [4.0, 7.0]);
        let [l3, l4] = five_bar_lengths(&[4.0, 7.0], &numbers(&s["q"]));
        assert!((l3 - 5.0).abs() < 1e-12 && (l4 - 8.0).abs() < 1e-12, "{s}");
        assert!(
            s["residual"].as_f64().unwrap() < 1e-14 && s["certified"] == true && s["within_limits"] == true
        );
    }
}

#[test]
fn ik_in_one_mode() {
    let document = json("ik five-bar --pose 4,7 --mode -- --json");
    let found = solutions(&document);
    assert_eq!((found.len(), found[0]["mode"].as_str()), (1, Some("--")));
    assert_eq!(json("ik five-bar --pose 4,7 --mode=+- --json")["solutions"][0]["mode"], "+-");
}

/// Table 4's first point: a list that starts with a negative number. The last has the same q.
#[test]
fn lists_may_start_with_a_negative_number() {
    let q = |pose: &str| {
        numbers(&json(&format!("ik 3-rrr --pose {pose} --mode +++ --json"))["solutions"][0]["q"])
    };
    let (first, last) = (q("-15.468,0.781,0.073"), q("-9.902,-7.091,1.081"));
    for (a, b) in first.iter().zip(&last) {
        assert!((a - b).abs().to_degrees() < 0.02, "{first:?} {last:?}");
    }
    let joints: Vec<_> = first.iter().map(f64::to_string).collect();
    let poses = json(&format!("fk 3-rrr --q {} --json", joints.join(",")));
    assert!(poses["solutions"].as_array().unwrap().len() >= 2);
}

#[test]
fn fk_of_the_five_bar_closes_and_has_two_solutions() {
    let document = json("fk five-bar --q 1.6847020489381233,1.0392709149768398 --json");
    let found = solutions(&document);
    assert_eq!(found.len(), 2);
    let poses: Vec<_> = found.iter().map(|s| numbers(&s["pose"])).collect();
    assert!(poses.iter().any(|p| (p[0] - 4.0).abs() < 1e-12 && (p[1] - 7.0).abs() < 1e-12), "{poses:?}");
    for s in found {
        let [l3, l4] = five_bar_lengths(&numbers(&s["pose"]), &numbers(&s["q"]));
        assert!((l3 - 5.0).abs() < 1e-12 && (l4 - 8.0).abs() < 1e-12, "{s}");
    }
}

/// Innocenti & Parenti-Castelli: six real solutions.
#[test]
fn fk_of_the_3_rpr_has_six_solutions() {
    let document = json("fk 3-rpr --q 14.98,15.38,12 --json");
    assert_eq!(solutions(&document).len(), 6);
    assert_eq!(document["complete"], true);
}

#[test]
fn fk_without_a_solution_is_a_negative_answer() {
    // B1 = (−8, 0) and B2 = (14, 0) are 22 apart, more than 5 + 8.
    let output = output("fk five-bar --q 3.141592653589793,0 --json");
    assert_eq!(output.status.code(), Some(1));
    let document: Value = serde_json::from_slice(&output.stdout).expect("JSON alone on stdout");
    assert!(solutions(&document).is_empty());
    assert_eq!(document["complete"], true);
    assert!(String::from_utf8_lossy(&output.stderr).contains("no direct solution"));
}

#[test]
fn angles_are_radians_in_json_whatever_the_input() {
    let radians = json("fk five-bar --q 1.5707963267948966,3.141592653589793 --json");
    let degrees = json("fk five-bar --q 90,180 --deg --json");
    assert_eq!(radians, degrees);
    // Lengths stay lengths.
    assert_eq!(json("ik 3-rpr --pose 3,4,0.5 --json"), {
        let turned = 0.5f64.to_degrees();
        json(&format!("ik 3-rpr --pose 3,4,{turned} --deg --json"))
    });
}

#[test]
fn state_tells_kinds_of_singularity() {
    // Leg 1 stretched: A1, B1, C1 in line.
    let document = json("state five-bar --pose 13,0 --json");
    assert_eq!(
        (&document["format_version"], &document["robot"]),
        (&Value::from(1), &Value::from("five-bar"))
    );
    for state in document["states"].as_array().unwrap() {
        assert_eq!(state["singularity"], "serial");
        assert_eq!(state["serial_legs"], serde_json::json!([1]));
        assert_eq!(state["mode"], Value::Null);
    }
    let regular = json("state five-bar --pose 4,7 --mode ++ --json");
    let state = &regular["states"][0];
    assert_eq!((&state["singularity"], &state["mode"]), (&Value::from("regular"), &Value::from("++")));
    for key in ["det_a", "det_b", "condition_a", "condition_b", "parallel_measure", "tolerance", "residual"] {
        assert!(state[key].is_f64(), "{key}");
    }
    assert_eq!(numbers(&state["serial_measures"]).len(), 2);
    assert_eq!(state["a"].as_array().unwrap().len(), 2);
}

#[test]
fn state_of_joints_that_do_not_belong_to_the_pose() {
    let output = output("state five-bar --pose 4,7 --q 0,0 --json");
    assert_eq!(output.status.code(), Some(1));
    let document: Value = serde_json::from_slice(&output.stdout).expect("JSON alone on stdout");
    assert!(document["states"][0]["residual"].as_f64().unwrap() > 0.1);
    assert!(String::from_utf8_lossy(&output.stderr).contains("no configuration of the robot"));
}

#[test]
fn schema_is_json() {
    let schema = json("schema");
    assert!(schema["$schema"].as_str().unwrap().starts_with("https://json-schema.org/"));
}

/// Whatever is told of paths and motions has the units in front.
#[test]
fn paths_and_motions_name_their_units() {
    let path = "-15.468,0.781,0.073\n-15.468,0.7,0.08\n";
    for command in [
        "check-path 3-rrr - --mode +++ --json",
        "time 3-rrr - --mode +++ --speed 2 --acceleration 10 --rate 1 --json",
        "plan 3-rrr --from -15.468,0.781,0.073 --to -15.468,0.7,0.08 --mode +++ --json",
        "plan five-bar --from 4,7 --to 4,-7 --mode ++ --json",
        "traverse five-bar --box 3.9:4.1,6.9:7.1 --json",
        "modes five-bar --budget depth=6 --json",
        "assembly five-bar --q 1,2 --json",
    ] {
        let run = crate::aspecta(command).write_stdin(path).output().unwrap();
        let text = String::from_utf8(run.stdout).unwrap();
        let document: Value = serde_json::from_str(&text).unwrap_or_else(|e| panic!("{command}: {e}"));
        assert_eq!(
            (&document["length_unit"], &document["angle_unit"]),
            (&"unit".into(), &"rad".into()),
            "{command}"
        );
        assert!(
            document["robot"].is_string() && text.starts_with("{\n  \"format_version\": 1,\n  \"robot\"")
        );
    }
}
