//! Many rows: CSV in, CSV, JSON or a table out.

use crate::{aspecta, numbers};
use serde_json::Value;
use std::fs;

fn fed(arguments: &str, stdin: &str) -> (String, String, Option<i32>) {
    let output = aspecta(arguments).write_stdin(stdin).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (text(output.stdout), text(output.stderr), output.status.code())
}

#[test]
fn a_header_names_the_columns_in_any_order() {
    let (plain, _, _) = fed("ik five-bar --file - --csv", "4,7\n3,5\n");
    let spreadsheet = "\u{feff}\"Y\", note, X\r\n\r\n# poses\r\n7, a, 4\r\n5, b, 3\r\n";
    let (headed, _, code) = fed("ik five-bar --file - --csv", spreadsheet);
    assert_eq!(code, Some(0));
    let without_line = |text: &str| -> Vec<String> {
        text.lines().skip(1).map(|l| l.split_once(',').unwrap().1.to_owned()).collect()
    };
    assert_eq!(without_line(&plain), without_line(&headed));
    assert_eq!(plain.lines().next(), Some("line,x,y,q1,q2,mode,det_a,residual,certified,within_limits"));
    // Line numbers are those of the file.
    assert!(headed.lines().nth(1).unwrap().starts_with("4,4.0,7.0,"));
}

/// What `ik` prints, `fk` reads; every pose comes back.
#[test]
fn ik_feeds_fk_feeds_state() {
    let (joints, _, _) = fed("ik five-bar --file - --csv", "4,7\n3.25,-5\n");
    let (poses, _, code) = fed("fk five-bar --file - --json", &joints);
    assert_eq!(code, Some(0));
    let document: Value = serde_json::from_str(&poses).unwrap();
    let results = document["results"].as_array().unwrap();
    assert_eq!(results.len(), 8);
    for (k, result) in results.iter().enumerate() {
        let wanted = if k < 4 { [4.0, 7.0] } else { [3.25, -5.0] };
        let near = |s: &Value| numbers(&s["pose"]).iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-9);
        assert!(result["solutions"].as_array().unwrap().iter().any(near), "{result}");
        assert_eq!((result["line"].as_u64(), numbers(&result["q"]).len()), (Some(k as u64 + 2), 2));
    }
    let (states, _, code) = fed("state five-bar --file - --csv", &joints);
    assert_eq!((states.lines().count(), code), (9, Some(0)));
    assert!(states.starts_with("line,x,y,q1,q2,mode,singularity,det_a,det_b,"));
}

#[test]
fn rows_out_of_reach_are_named_and_make_the_answer_negative() {
    let (out, messages, code) = fed("ik five-bar --file - --json", "4,7\n-20,0\n");
    assert_eq!(code, Some(1));
    assert!(messages.contains("line 2: out of reach: leg 1 by 7.000000"), "{messages}");
    let document: Value = serde_json::from_str(&out).unwrap();
    assert_eq!(document["results"][0]["solutions"].as_array().unwrap().len(), 4);
    assert_eq!(document["results"][1]["solutions"].as_array().unwrap().len(), 0);
    assert_eq!(numbers(&document["results"][1]["pose"]), [-20.0, 0.0]);
}

#[test]
fn degrees_apply_to_angles_of_a_file_only() {
    let (radians, _, _) = fed("ik 3-rrr --file - --csv", "-15.468,0.781,0.5\n");
    let (degrees, _, _) = fed("ik 3-rrr --file - --csv --deg", "-15.468,0.781,28.64788975654116\n");
    assert_eq!(radians, degrees);
}

/// Each kind of bad file: what is said, file and line included.
#[test]
fn bad_files() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("poses.csv");
    let cases: [(&[u8], &str); 13] = [
        (b"4,7\n4,seven\n", "poses.csv:2: column 2, y: `seven` is not a number"),
        (b"x,y\n4,7\n4,nan\n", "poses.csv:3: column 2, y: NaN is not a finite number"),
        (b"4,7\n\n4,inf\n", "poses.csv:3: column 2, y: inf is not a finite number"),
        (b"4,7\n4,7,1\n", "poses.csv:2: 3 fields, but the first line has 2"),
        (b"1,2,3\n", "poses.csv:1: 3 fields; `x,y` wanted"),
        (b"4,7\n4\n", "poses.csv:2: 1 field, but the first line has 2"),
        (b"4;7\n", "poses.csv:1: `4;7` has semicolons and no commas: separate the fields by commas"),
        (b"x;y\n4;7\n", "poses.csv:1: `x;y` has semicolons"),
        (b"4,7\n4\t7\n", "poses.csv:2: `4\t7` has tabs and no commas"),
        (b"a,b\n1,2\n", "poses.csv:1: the header `a,b` lacks a column; `x,y` wanted"),
        (b"", "poses.csv holds no rows"),
        (b"x,y\n", "poses.csv holds no rows"),
        (b"4,7\n\xff,1\n", "poses.csv:2: stream did not contain valid UTF-8"),
    ];
    for (content, complaint) in cases {
        fs::write(&path, content).unwrap();
        let output = aspecta("ik five-bar --file").arg(&path).output().unwrap();
        let messages = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{messages}");
        assert!(messages.contains(complaint), "wanted: {complaint}\nfound: {messages}");
        let has_answers = content.starts_with(b"4,7\n") || content.starts_with(b"x,y\n4,7\n");
        assert_eq!(output.stdout.is_empty(), !has_answers);
    }
}
