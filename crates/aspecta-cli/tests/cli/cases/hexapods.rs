//! Hexapods as they are built: their direct solutions are all found, and it is proved that they are all.

use super::case;
use crate::{aspecta, json, numbers};
use serde_json::Value;

/// Poses near one in the middle of the workspace: always the same, from multiples of irrational numbers.
fn poses(middle: [f64; 6], reach: f64) -> String {
    let mut rows = "x,y,z,roll,pitch,yaw\n".to_owned();
    for k in 1..=20 {
        let part = |j: usize| (f64::from(k) * (2.0 + j as f64).sqrt()).fract() - 0.5;
        let row: Vec<String> =
            (0..6).map(|j| (middle[j] + part(j) * if j < 3 { reach } else { 0.4 }).to_string()).collect();
        rows += &(row.join(",") + "\n");
    }
    rows
}

/// Runs a command on rows of stdin.
fn results(arguments: &str, rows: String) -> Vec<Value> {
    let run = aspecta(arguments).write_stdin(rows).output().unwrap();
    let found: Value = serde_json::from_slice(&run.stdout).unwrap();
    found["results"].as_array().unwrap().clone()
}

/// A row as CSV.
fn row(values: &Value) -> String {
    numbers(values).iter().map(f64::to_string).collect::<Vec<_>>().join(",") + "\n"
}

/// `fk` at the joint vectors of poses: complete each time, and the pose is in the list.
#[test]
fn lists_of_drawn_hexapods_are_complete() {
    for (name, middle, reach) in [
        ("semi-regular-hexapod", 130.0, 30.0),
        ("cnc-hexapod", 30.0, 6.0),
        ("symmetric-6-6", 480.0, 80.0),
        ("threefold-hexapod", 1.8, 0.4),
        ("three-pairs-at-base", 2.0, 0.4),
    ] {
        let robot = case(name);
        let placed =
            results(&format!("ik {robot} --file - --json"), poses([0.0, 0.0, middle, 0.0, 0.0, 0.0], reach));
        let mut lengths = "q1,q2,q3,q4,q5,q6\n".to_owned();
        lengths.extend(placed.iter().map(|found| row(&found["solutions"][0]["q"])));
        let found = results(&format!("fk {robot} --file - --json"), lengths);
        assert_eq!(found.len(), 20);
        for (pose, found) in placed.iter().zip(&found) {
            assert_eq!(found["complete"], true, "{name}: {found}");
            let here = numbers(&pose["solutions"][0]["pose"]);
            let gap = |s: &Value| {
                numbers(&s["pose"]).iter().zip(&here).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
            };
            let nearest =
                found["solutions"].as_array().unwrap().iter().map(gap).fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-6 * middle, "{name}: {nearest:e}");
        }
    }
}

/// The neck at rest has sixteen poses, the six motors standing alike.
#[test]
fn a_rotary_hexapod_at_rest() {
    let robot = case("desk-robot-neck");
    let at_rest = json(&format!("ik {robot} --pose 0,0,177,0,0,0 --json"));
    let within = |s: &&Value| s["within_limits"] == true;
    let q = &at_rest["solutions"].as_array().unwrap().iter().find(within).unwrap()["q"];
    let found = json(&format!("fk {robot} --q={} --json", row(q).trim()));
    assert_eq!((found["solutions"].as_array().unwrap().len(), &found["complete"]), (16, &Value::Bool(true)));
    for q in ["0,0,0,0,0,0", "0.5,0.5,0.5,0.5,0.5,0.5", "1,1,1,1,1,1"] {
        let found = json(&format!("fk hexa --q={q} --json"));
        assert_eq!(
            (found["solutions"].as_array().unwrap().len(), &found["complete"]),
            (16, &Value::Bool(true)),
            "{q}"
        );
    }
}
