//! Streams of joint vectors and of poses.

use crate::{aspecta, numbers};
use assert_cmd::cargo::CommandCargoExt;
use serde_json::Value;
use std::io::{BufRead, BufReader, Write};
use std::process::{Command, Stdio};

fn fed(arguments: &str, stdin: &str) -> (String, String, Option<i32>) {
    let output = aspecta(arguments).write_stdin(stdin).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (text(output.stdout), text(output.stderr), output.status.code())
}

fn records(text: &str) -> Vec<Value> {
    text.lines().map(|line| serde_json::from_str(line).unwrap_or_else(|e| panic!("{e}: {line}"))).collect()
}

/// A circle of radius 1 about (4, 7).
fn circle(steps: usize) -> String {
    let at = |i: usize| (i as f64 / steps as f64 * std::f64::consts::TAU).sin_cos();
    (0..=steps).map(|i| format!("{},{}\n", 4.0 + at(i).1, 7.0 + at(i).0)).collect()
}

/// Poses to joints by `--inverse`, back to poses: what went in comes out, and CSV of the one is input of the other.
#[test]
fn there_and_back() {
    let poses = circle(500);
    let (joints, messages, code) = fed("follow five-bar --inverse --mode ++ --csv", &poses);
    assert_eq!((messages.as_str(), code), ("", Some(0)));
    assert!(joints.starts_with("line,x,y,q1,q2,mode,regular,within_limits,stretches,refused,"));
    let (back, messages, code) = fed("follow five-bar --pose 5,7 --json", &joints);
    assert_eq!((messages.as_str(), code), ("", Some(0)));
    let back = records(&back);
    assert_eq!(back.len(), 501);
    for (record, pose) in back.iter().zip(poses.lines()) {
        let wanted: Vec<f64> = pose.split(',').map(|x| x.parse().unwrap()).collect();
        let found = numbers(&record["pose"]);
        assert!(found.iter().zip(&wanted).all(|(a, b)| (a - b).abs() < 1e-12), "{record}");
        assert_eq!((record["mode"].as_str(), record["mode_kept"].as_bool()), (Some("++"), Some(true)));
        assert!(record["length_error"].as_f64().unwrap() < 1e-12);
    }
}

/// Each line is answered before the next is given.
#[test]
fn an_answer_does_not_wait_for_the_next_line() {
    let mut child = Command::cargo_bin("aspecta")
        .unwrap()
        .args(["follow", "five-bar", "--inverse", "--mode", "++", "--json"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut input = child.stdin.take().unwrap();
    let mut output = BufReader::new(child.stdout.take().unwrap());
    for (k, line) in circle(50).lines().enumerate() {
        writeln!(input, "{line}").unwrap();
        let mut answer = String::new();
        output.read_line(&mut answer).unwrap();
        let record: Value = serde_json::from_str(&answer).unwrap();
        assert_eq!(record["line"].as_u64(), Some(k as u64 + 1));
    }
    drop(input);
    assert!(child.wait().unwrap().success());
}

/// A line over a singularity is refused and the robot waits for a better one: exit status 1.
#[test]
fn refusals_say_why_and_where() {
    let (joints, _, _) = fed("ik five-bar --pose 4,7 --mode ++ --csv", "");
    let q: Vec<f64> =
        joints.lines().nth(1).unwrap().split(',').skip(3).take(2).map(|x| x.parse().unwrap()).collect();
    let lines = format!("{},{}\n{},{}\n{},{}\n", q[0], q[1], q[0] + 1.5, q[1] - 1.5, q[0] + 0.01, q[1]);
    let (out, messages, code) = fed("follow five-bar --pose 4,7 --json", &lines);
    assert_eq!((messages.as_str(), code), ("", Some(1)));
    let found = records(&out);
    assert_eq!(found.len(), 3);
    let refused = &found[1]["refused"];
    assert_eq!(refused["reason"], "parallel");
    assert!(refused["proved"].as_f64() < refused["singular_at"].as_f64());
    assert!(found[1]["message"].as_str().unwrap().contains("parallel singularity is ahead"));
    assert!(found[1].get("pose").is_none() && found[2].get("pose").is_some());
    let (table, _, _) = fed("follow five-bar --pose 4,7", &lines);
    assert!(table.contains("     2  refused: a parallel singularity is ahead"), "{table}");
    assert!(table.ends_with("3 lines: 2 certified, 1 refused\n"), "{table}");
    let (csv, _, _) = fed("follow five-bar --pose 4,7 --csv", &lines);
    let fields: Vec<usize> = csv.lines().map(|line| line.split(',').count()).collect();
    assert_eq!(fields, [13; 4], "{csv}");
}

#[test]
fn bad_input_ends_with_status_2() {
    let cases = [
        ("follow five-bar --pose 4,7", "0.5,3\n", "stdin:1: no solution for this joint vector is proved"),
        ("follow five-bar --pose 4,7", "0.5,one\n", "stdin:1: column 2, q2: `one` is not a number"),
        ("follow five-bar --pose 4", "0.5,1\n", "stdin:1: robot `five-bar` has 2 pose coordinates (x, y)"),
        ("follow five-bar --inverse --mode ++", "40,7\n", "stdin:1: leg 1 cannot close at the pose"),
        ("follow five-bar --inverse --mode ++", "", "stdin holds no rows"),
        ("follow five-bar --inverse --mode +++", "4,7\n", "`+++` is not a working mode"),
        ("follow 3-rpr --pose 5,10,0.3", "11,0,23\n", "leg 2 is a strut, whose length must be positive"),
        ("follow five-bar --inverse --mode ++", "4,nan\n", "stdin:1: pose coordinate 2 is NaN"),
        ("follow five-bar", "4,7\n", "--pose"),
        ("follow five-bar --pose 4,7 --inverse", "4,7\n", "cannot be used with"),
    ];
    for (arguments, stdin, complaint) in cases {
        let (_, messages, code) = fed(arguments, stdin);
        assert_eq!(code, Some(2), "{arguments}: {messages}");
        assert!(messages.contains(complaint), "{arguments}\nwanted: {complaint}\nfound: {messages}");
    }
}

#[test]
fn degrees_are_those_of_angles() {
    let (radians, _, _) = fed("follow 3-rrr --inverse --mode +++ --csv", "-14,-5,0.5\n");
    let (degrees, _, code) =
        fed("follow 3-rrr --inverse --mode +++ --csv --deg", "-14,-5,28.64788975654116\n");
    assert_eq!((radians, code), (degrees, Some(0)));
}
