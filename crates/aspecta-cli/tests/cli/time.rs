//! `aspecta time`: Table 4 as a motion.

use crate::{TABLE_4, aspecta, file, stdout};
use serde_json::Value;
use std::fs;

/// Exit status, stdout, stderr.
fn run(arguments: &str, content: &str) -> (Option<i32>, String, String) {
    let (_directory, path) = file(content);
    let output = aspecta(arguments).arg(&path).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

fn rows(csv: &str) -> Vec<Vec<f64>> {
    // The last column is the working mode.
    let numbers =
        |line: &str| line.rsplit_once(',').unwrap().0.split(',').map(|x| x.parse().unwrap()).collect();
    csv.lines().skip(1).map(numbers).collect()
}

#[test]
fn a_motion_is_within_its_limits_and_on_the_path() {
    let arguments = "time 3-rrr --mode +++ --speed 2,1,1 --acceleration 10 --rate 1000 --csv";
    let (code, csv, complaint) = run(arguments, TABLE_4);
    assert_eq!(code, Some(0), "{complaint}");
    assert_eq!(csv.lines().next(), Some("time,x,y,phi,q1,q2,q3,v1,v2,v3,a1,a2,a3,mode"));
    assert!(csv.lines().skip(1).all(|line| line.ends_with(",+++")));
    let rows = rows(&csv);
    for row in &rows {
        for (j, speed) in [2.0, 1.0, 1.0].into_iter().enumerate() {
            assert!(
                row[7 + j].abs() <= speed * (1.0 + 1e-6) && row[10 + j].abs() <= 10.0 * (1.0 + 1e-6),
                "{row:?}"
            );
        }
        let on_first = (row[1] + 15.468).abs() < 1e-6;
        assert!(on_first || (row[2] + 7.091).abs() < 1e-6, "{row:?}");
    }
    let (first, last) = (&rows[0], rows.last().unwrap());
    assert!((first[1] + 15.468).abs() < 1e-9 && (last[3] - 1.081).abs() < 1e-9);
    for w in rows.windows(2) {
        let step = w[1][0] - w[0][0];
        assert!(step > 0.0 && step < 1.0001e-3);
    }
}

#[test]
fn json_says_how_long_and_why() {
    let arguments = "time 3-rrr --mode +++ --joined spline --speed 2 --acceleration 10 --json";
    let (code, text, _) = run(arguments, TABLE_4);
    let document: Value = serde_json::from_str(&text).unwrap();
    assert_eq!((code, &document["sound"]), (Some(0), &Value::from(true)));
    let rows = document["rows"].as_array().unwrap();
    assert_eq!(rows.last().unwrap()["time"], document["total_time"]);
    assert!(document["bindings"].as_array().unwrap().iter().any(|b| b["joint"] == 1));
}

/// What is not proved to be sound is not timed.
#[test]
fn an_unsound_path_is_refused() {
    let arguments = "time five-bar --mode ++ --speed 1 --acceleration 1";
    let (code, text, complaint) = run(arguments, "4,7\n4,14\n");
    assert_eq!((code, text.as_str()), (Some(1), ""));
    assert!(
        complaint.contains("leg 2 is stretched or folded (serial singularity), segment 1, t = 0.714286"),
        "{complaint}"
    );
    let (_, text, _) = run(&format!("{arguments} --json"), "4,7\n4,14\n");
    let document: Value = serde_json::from_str(&text).unwrap();
    assert!(document["sound"] == false && document.get("rows").is_none());
}

/// A straight line of joint vectors, in degrees: 30 degrees at 10 a second and 20 a second squared take 3.5 s.
#[test]
fn degrees_are_degrees() {
    let joints = "q1,q2\n100,100\n100,70\n";
    let solutions = stdout("fk five-bar --q 100,100 --deg --csv");
    let pose: Vec<_> = solutions.lines().nth(1).unwrap().split(',').skip(1).take(2).collect();
    let arguments =
        format!("time five-bar --deg --start={} --speed 10 --acceleration 20 --json", pose.join(","));
    let (code, text, complaint) = run(&arguments, joints);
    assert_eq!(code, Some(0), "{complaint}");
    let document: Value = serde_json::from_str(&text).unwrap();
    assert!((document["total_time"].as_f64().unwrap() - 3.5).abs() < 1e-4, "{}", document["total_time"]);
}

#[test]
fn the_file_is_complete_or_not_there() {
    let (directory, path) = file(TABLE_4);
    let out = directory.path().join("motion.csv");
    let mut command = aspecta("time 3-rrr --mode +++ --speed 2 --acceleration 10 --out");
    let output = command.args([&out, &path]).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success() && text.contains("total time") && text.contains("motion.csv"), "{text}");
    assert!(rows(&fs::read_to_string(&out).unwrap()).len() > 100);
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 2, "no draft is left");
    let missing = directory.path().join("missing/motion.csv");
    let mut command = aspecta("time 3-rrr --mode +++ --speed 2 --acceleration 10 --out");
    let output = command.args([&missing, &path]).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
}

#[test]
fn bad_limits() {
    for (arguments, complaint) in [
        ("--speed 0 --acceleration 1", "speed limit of joint 1 is 0"),
        ("--speed 1,2 --acceleration 1", "--speed: `1,2` has 2 numbers"),
        ("--speed 1 --acceleration fast", "--acceleration: `fast` is not a list of numbers"),
        ("--speed 1 --acceleration 1 --rate 0", "--rate"),
        ("--speed 1 --acceleration 1 --joined none", "--joined none"),
        ("--acceleration 1", "--speed"),
    ] {
        let (code, _, messages) = run(&format!("time 3-rrr --mode +++ {arguments}"), TABLE_4);
        assert!(code == Some(2) && messages.contains(complaint), "{arguments}: {messages}");
    }
}
