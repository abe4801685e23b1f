//! `aspecta explore` where nothing is found.

use crate::{aspecta, output};
use std::fs;

/// Legs that are short and long in turn never meet: there is no bound to speak of, and no component.
#[test]
fn no_pose_found_is_no_bound() {
    let text = String::from_utf8(output("robots show gough-stewart").stdout).unwrap();
    let mut ranges = ["[0.2, 0.2001]", "[1.9999, 2]"].into_iter().cycle();
    let parts: Vec<&str> = text.split("[0.2, 2]").collect();
    assert_eq!(parts.len(), 7);
    let (first, others) = parts.split_first().unwrap();
    let legs = others.iter().map(|part| format!("{}{part}", ranges.next().unwrap()));
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("apart.toml");
    fs::write(&path, format!("{first}{}", legs.collect::<String>())).unwrap();
    let explored = aspecta("explore --samples 4 --budget 2s").arg(&path).output().unwrap();
    let text = String::from_utf8(explored.stdout).unwrap();
    assert_eq!(explored.status.code(), Some(0), "{text}");
    assert!(text.contains("gough-stewart: no pose was found in 2 classes, which does not prove"), "{text}");
    assert!(!text.contains("at least") && !text.contains("poses of one component"), "{text}");
}
