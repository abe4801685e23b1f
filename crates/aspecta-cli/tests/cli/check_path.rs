//! `aspecta check-path`: Table 4 and its opposite.

use crate::{aspecta, numbers};
use serde_json::Value;
use std::fs;
use std::path::PathBuf;
use tempfile::TempDir;

const TABLE_4: &str = "x,y,phi\n-15.468,0.781,0.073\n-15.468,-7.091,0.500\n-9.902,-7.091,1.081\n";

fn file(content: &str) -> (TempDir, PathBuf) {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("path.csv");
    fs::write(&path, content).unwrap();
    (directory, path)
}

fn check(robot: &str, content: &str, mode: &str) -> (Value, Option<i32>) {
    let (_directory, path) = file(content);
    let output =
        aspecta(&format!("check-path {robot}")).arg(&path).args(["--mode", mode, "--json"]).output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout);
    let complaint = String::from_utf8_lossy(&output.stderr);
    let document = serde_json::from_str(&text).unwrap_or_else(|e| panic!("{e}: {text}{complaint}"));
    (document, output.status.code())
}

/// Table 4: an assembly-mode change with no singularity in mode +++.
#[test]
fn table_4_is_free_of_singularities() {
    let (document, code) = check("3-rrr", TABLE_4, "+++");
    assert_eq!((&document["singularity_free"], code), (&Value::from(true), Some(0)));
    let least = &document["min_abs_det_a"];
    assert!(least["value"].as_f64().unwrap() > 0.0);
    assert_eq!(numbers(&least["pose"]).len(), 3);
    assert!([1, 2].contains(&least["segment"].as_u64().unwrap()));
    assert!((0.0..=1.0).contains(&least["t"].as_f64().unwrap()));
}

/// Table 4's ends have the same joint vector, and figure 11's curves reach 1 somewhere.
#[test]
fn table_4_ends_meet_and_figure_11_is_normalised() {
    let (document, _) = check("3-rrr", TABLE_4, "+++");
    let ends: Vec<_> = document["ends"].as_array().unwrap().iter().map(numbers).collect();
    for (a, b) in ends[0].iter().zip(&ends[1]) {
        assert!((a - b).abs().to_degrees() < 0.02, "{ends:?}");
    }
    let (_directory, path) = file(TABLE_4);
    let output = aspecta("check-path 3-rrr --mode +++ --csv").arg(&path).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("segment,t,x,y,phi,q1,q2,q3,det_a,b_11,b_22,b_33"));
    let rows: Vec<Vec<f64>> = lines.map(|l| l.split(',').map(|x| x.parse().unwrap()).collect()).collect();
    for column in 8..12 {
        // Mode +++: B_jj > 0; det A keeps its sign.
        let values: Vec<f64> = rows.iter().map(|r| r[column].abs()).collect();
        let signs = rows.iter().map(|r| r[column].signum()).sum::<f64>().abs();
        assert_eq!(signs, rows.len() as f64);
        assert!((values.iter().copied().fold(0.0, f64::max) - 1.0).abs() < 1e-12);
    }
}

#[test]
fn people_read_the_verdict() {
    let (_directory, path) = file(TABLE_4);
    let output = aspecta("check-path 3-rrr --mode +++").arg(&path).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("singularity-free  yes, certified") && text.contains("min |det A|"), "{text}");
}

/// The sign of det A at both ends tells that it vanishes between them.
#[test]
fn a_change_of_sign_of_det_a_is_not_free() {
    // Mode +-: det A = 24.2 at (4, 7) and −87.0 at (3, 5).
    let (document, code) = check("five-bar", "4,7\n3,5\n", "+-");
    assert_eq!((&document["singularity_free"], code), (&Value::from(false), Some(1)));
}

#[test]
fn bad_paths() {
    for (content, complaint) in [
        ("4,7\n", "at least two"),
        ("-20,0\n4,7\n", "starts out of reach: leg 1"),
        ("4,7\n4,x\n", "path.csv:2: column 2, y: `x` is not a number"),
        ("1,2,3\n4,5,6\n", "path.csv:1: 3 fields; `x,y` wanted"),
    ] {
        let (_directory, path) = file(content);
        let output = aspecta("check-path five-bar --mode ++").arg(&path).output().unwrap();
        let messages = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{messages}");
        assert!(messages.contains(complaint), "{messages}");
    }
}
