//! `aspecta domains --save` and `aspecta locate`.

use crate::{aspecta, output};
use serde_json::Value;
use std::fs;
use std::path::PathBuf;
use std::sync::LazyLock;

/// The map of the five-bar, made once.
static MAP: LazyLock<(tempfile::TempDir, PathBuf)> = LazyLock::new(|| {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("five-bar.aspecta");
    let made = aspecta("domains five-bar --cells 100 --budget depth=9 --save").arg(&path).output().unwrap();
    assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
    assert!(String::from_utf8_lossy(&made.stdout).contains("written: "));
    (directory, path)
});

fn locate(arguments: &str) -> (Option<i32>, String, String) {
    let mut command = aspecta("locate");
    let output = command.arg(&MAP.1).args(arguments.split(' ')).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

/// Figure 8 of the paper: the pose has four working modes, each in an aspect of its own.
#[test]
fn a_pose_is_found_in_every_mode() {
    let (status, text, messages) = locate("--pose 3,6");
    assert_eq!((status, messages.as_str()), (Some(0), ""), "{text}");
    assert_eq!(text.lines().count(), 5, "{text}");
    let (_, text, _) = locate("--pose 3,6 --json");
    let answer: Value = serde_json::from_str(&text).unwrap();
    let places = answer["places"].as_array().unwrap();
    let modes: Vec<_> = places.iter().map(|p| p["mode"].as_str().unwrap()).collect();
    assert_eq!(modes, ["++", "+-", "--", "-+"]);
    let aspects: std::collections::BTreeSet<_> =
        places.iter().map(|p| p["aspect"].as_u64().unwrap()).collect();
    assert_eq!(aspects.len(), 4);
    assert!(places.iter().all(|p| p["uniqueness"] == serde_json::json!([1]) && p["solutions"] == 1));
}

/// Two direct solutions, of opposite det A: in different aspects.
#[test]
fn a_joint_vector_is_found_in_degrees_and_in_files() {
    let (status, text, _) = locate("--q 90,180 --deg");
    assert_eq!((status, text.lines().count()), (Some(0), 3), "{text}");
    assert!(text.contains("90.000000  180.000000"), "{text}");
    let rows = MAP.0.path().join("rows.csv");
    fs::write(&rows, "q1,q2\n1.5707963267948966,3.141592653589793\n0.1,0.2\n").unwrap();
    let (_, text, _) = locate(&format!("--joints --csv --file {}", rows.display()));
    assert!(text.starts_with("line,x,y,q1,q2,mode,det_a,aspect,region,solutions,uniqueness,why\n"), "{text}");
    assert_eq!(text.lines().filter(|line| line.starts_with("2,")).count(), 2, "{text}");
}

#[test]
fn what_cannot_be_located_is_explained() {
    let (status, _, messages) = locate("--pose 30,6");
    assert!(status == Some(1) && messages.contains("out of reach: leg 1"), "{messages}");
    let (status, _, messages) = locate("--pose 3,6 --cells 30");
    assert!(status == Some(2) && messages.contains("--cells"), "{messages}");
    let (status, _, messages) = locate("--pose 3");
    assert!(status == Some(2) && messages.contains('2'), "{messages}");
    // An aspect that was not cut up is named all the same.
    let part = MAP.0.path().join("part.aspecta");
    let made =
        aspecta("domains five-bar --mode ++ --cells 50 --budget depth=9 --save").arg(&part).output().unwrap();
    assert!(made.status.success());
    let found = aspecta("locate --pose 3,6 --mode -+").arg(&part).output().unwrap();
    let text = String::from_utf8(found.stdout).unwrap();
    assert!(found.status.code() == Some(1) && text.contains("regions are not in the file"), "{text}");
}

/// A robot file is not lost to a slip, and a map is not taken for one.
#[test]
fn files_are_not_mixed_up() {
    let robot = MAP.0.path().join("robot.toml");
    let text = output("robots show irb-360").stdout;
    fs::write(&robot, &text).unwrap();
    let refused =
        aspecta("domains five-bar --cells 20 --budget depth=6 --save").arg(&robot).output().unwrap();
    let messages = String::from_utf8(refused.stderr).unwrap();
    assert!(refused.status.code() == Some(2) && messages.contains("is no map"), "{messages}");
    assert_eq!(fs::read(&robot).unwrap(), text);
    let refused = aspecta("ik --pose 3,6").arg(&MAP.1).output().unwrap();
    let messages = String::from_utf8(refused.stderr).unwrap();
    assert!(refused.status.code() == Some(2) && messages.contains("aspecta locate"), "{messages}");
    // Cranks pointing up by more than 40°.
    let beyond = aspecta("locate --pose 0,0,-760 --mode --- --cells 20 --budget depth=4")
        .arg(&robot)
        .output()
        .unwrap();
    let text = String::from_utf8(beyond.stdout).unwrap();
    assert!(text.contains("beyond the actuator limit of leg 1"), "{text}");
    let refused = output("locate hexa --pose 0,0,-600,0,0,0");
    assert_eq!(refused.status.code(), Some(2));
}

/// A file that is neither a map nor called a robot file: both are said.
#[test]
fn what_should_be_a_map_is_said() {
    let other = MAP.0.path().join("other.aspecta");
    for text in ["", "x,y\n1,2\n"] {
        fs::write(&other, text).unwrap();
        let refused = aspecta("locate --pose 3,6").arg(&other).output().unwrap();
        let messages = String::from_utf8(refused.stderr).unwrap();
        assert_eq!(refused.status.code(), Some(2));
        let wanted = "is not a map, which `aspecta domains ROBOT --save FILE` writes, and not a robot file: ";
        assert!(messages.contains(wanted), "{messages}");
    }
    let robot = MAP.0.path().join("empty.toml");
    fs::write(&robot, "").unwrap();
    let refused = aspecta("locate --pose 3,6").arg(&robot).output().unwrap();
    let messages = String::from_utf8(refused.stderr).unwrap();
    assert!(messages.contains("missing key `name`") && !messages.contains("map"), "{messages}");
}

#[test]
fn without_a_map_it_is_computed() {
    let found = output("locate five-bar --pose 3,6 --mode ++ --cells 50 --budget depth=8");
    assert!(found.status.success());
    let messages = String::from_utf8(found.stderr).unwrap();
    assert!(messages.contains("aspecta domains five-bar --save five-bar.aspecta"), "{messages}");
}

/// The map prints and draws what the computation printed and drew.
#[test]
fn a_map_is_printed_and_drawn_again() {
    let computed = output("domains five-bar --cells 100 --budget depth=9 --json").stdout;
    let read = aspecta("domains --json").arg(&MAP.1).output().unwrap();
    assert_eq!(String::from_utf8(read.stdout).unwrap(), String::from_utf8(computed).unwrap());
    let pictures = |source: &str| {
        let directory = tempfile::tempdir().unwrap();
        let mut command = aspecta("domains");
        command.args(source.split(' ')).args(["--aspect", "2", "--out"]).arg(directory.path());
        assert!(command.output().unwrap().status.success());
        let mut files: Vec<_> = fs::read_dir(directory.path()).unwrap().map(|f| f.unwrap().path()).collect();
        files.sort();
        files.iter().map(|f| fs::read_to_string(f).unwrap()).collect::<Vec<_>>()
    };
    let (computed, read) =
        (pictures("five-bar --cells 100 --budget depth=9"), pictures(MAP.1.to_str().unwrap()));
    assert!(!computed.is_empty() && computed == read);
}

#[test]
fn a_damaged_map_is_refused() {
    let damaged = MAP.0.path().join("damaged.aspecta");
    let mut file = fs::read(&MAP.1).unwrap();
    let middle = file.len() / 2;
    file[middle] ^= 16;
    fs::write(&damaged, &file).unwrap();
    for arguments in ["locate --pose 3,6", "domains"] {
        let refused = aspecta(arguments).arg(&damaged).output().unwrap();
        let messages = String::from_utf8(refused.stderr).unwrap();
        assert_eq!(refused.status.code(), Some(2));
        assert!(
            messages.contains("damaged.aspecta") && messages.contains("damaged, or not written by"),
            "{messages}"
        );
    }
    // The directory is looked at before the long work.
    let refused = aspecta("domains 3-rrr --budget depth=12 --save no/such/directory/map")
        .timeout(std::time::Duration::from_secs(20))
        .output()
        .unwrap();
    assert_eq!(refused.status.code(), Some(2), "{}", String::from_utf8_lossy(&refused.stderr));
}
