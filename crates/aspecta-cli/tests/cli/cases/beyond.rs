//! Which limits are broken.

use super::case;
use crate::{aspecta, json, numbers, stdout};
use serde_json::{Value, json};

/// The sliders of `2-prr` go from 0 to 800, its rods are 300: at (20, 100) one of each pair of solutions is
/// below.
#[test]
fn limits_that_are_broken_are_named() {
    let found = json("ik 2-prr --pose 20,100 --json");
    let named = |mode: &str| {
        let solutions = found["solutions"].as_array().unwrap();
        solutions.iter().find(|s| s["mode"] == mode).unwrap()["beyond"].clone()
    };
    assert_eq!(named("++"), json!([]));
    assert_eq!(named("+-"), json!(["actuator limit of leg 2"]));
    assert_eq!(named("--"), json!(["actuator limit of leg 1", "actuator limit of leg 2"]));
    let table = stdout("ik 2-prr --pose 20,100");
    assert!(table.contains("  beyond: actuator limit of leg 1, actuator limit of leg 2\n"), "{table}");
    let low = found["solutions"].as_array().unwrap().iter().find(|s| s["mode"] == "+-").unwrap();
    let q: Vec<String> = numbers(&low["q"]).iter().map(f64::to_string).collect();
    let back = json(&format!("fk 2-prr --q {} --json", q.join(",")));
    let back = back["solutions"].as_array().unwrap().iter().find(|s| s["mode"] == "+-").unwrap().clone();
    assert_eq!(back["beyond"], json!(["actuator limit of leg 2"]), "{back}");
    let state = json("state 2-prr --pose 20,100 --mode +- --json");
    assert_eq!(state["states"][0]["beyond"], json!(["actuator limit of leg 2"]));
    let state = stdout("state 2-prr --pose 20,100 --mode +-");
    assert!(state.contains(" (beyond limits: actuator limit of leg 2)\n"), "{state}");
}

/// `five-bar-window` is a five-bar for y from 40 to 130 only.
#[test]
fn the_window_is_among_the_limits() {
    let robot = case("five-bar-window");
    let found = json(&format!("ik {robot} --pose 59,131 --mode +- --json"));
    assert_eq!(found["solutions"][0]["beyond"], json!(["window of y"]));
    let rows = aspecta(&format!("state {robot} --file -")).write_stdin("59,120\n59,131\n").output().unwrap();
    assert!(String::from_utf8(rows.stdout).unwrap().contains("beyond: window of y"));
    let follow = |format: &str| {
        let run = aspecta(&format!("follow {robot} --inverse --mode=+- {format}"));
        let run = { run }.write_stdin("59,129\n59,131\n").output().unwrap();
        String::from_utf8(run.stdout).unwrap()
    };
    assert!(follow("").contains(", beyond limits: window of y\n"), "{}", follow(""));
    let lines: Vec<Value> = follow("--json").lines().map(|l| serde_json::from_str(l).unwrap()).collect();
    assert_eq!((&lines[0]["beyond"], &lines[1]["beyond"]), (&json!([]), &json!(["window of y"])));
}

/// What is said to be within limits goes beyond none, and the other way round.
#[test]
fn nothing_is_beyond_where_all_is_within() {
    for robot in ["2-prr", "irb-360", "3-rpr", "gough-stewart"]
        .map(String::from)
        .into_iter()
        .chain([case("five-bar-elbow")])
    {
        let poses: String = (0..40)
            .map(|k| {
                let k = f64::from(k);
                match robot.as_str() {
                    "2-prr" => format!("{},{}\n", 3.0 * k - 60.0, 20.0 * k),
                    "irb-360" => format!("{},{},{}\n", 20.0 * k - 400.0, 10.0 * k, -800.0 - 10.0 * k),
                    "3-rpr" => format!("{},{},{}\n", k, 12.0 - 0.2 * k, 0.1 * k),
                    "gough-stewart" => format!("{},0,{},0.1,{},0\n", 0.1 * k, 0.2 + 0.1 * k, 0.02 * k),
                    _ => format!("{},{}\n", 3.0 * k, 130.0 - k),
                }
            })
            .collect();
        let run = aspecta(&format!("ik {robot} --file - --json")).write_stdin(poses).output().unwrap();
        let found: Value = serde_json::from_slice(&run.stdout).unwrap();
        let solutions =
            || found["results"].as_array().unwrap().iter().flat_map(|r| r["solutions"].as_array().unwrap());
        assert!(solutions().any(|s| s["within_limits"] == true), "{robot}");
        assert!(solutions().any(|s| s["within_limits"] == false), "{robot}");
        for s in solutions() {
            assert_eq!(
                s["within_limits"] == true,
                s["beyond"].as_array().unwrap().is_empty(),
                "{robot}: {s}"
            );
        }
    }
}
