//! `aspecta verify`: exit statuses and what is said.

use crate::{aspecta, json, stdout};
use aspecta::certificate::{Certificate, Claim, Entry};
use aspecta::paving::{Budget, Control, Paving};
use aspecta::robot::{Robot, catalogue};
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;
use tempfile::TempDir;

/// A certificate of the five-bar from an even paving, which claims that each class has `low` aspects at least.
fn certificate(low: usize) -> Certificate {
    let robot: Robot = catalogue::find("five-bar").unwrap();
    let (window, modes) = (robot.workspace_window().unwrap(), robot.working_modes());
    let control = Control { cancelled: &AtomicBool::new(false), progress: &|_| {} };
    let budget = Budget { depth: Some(6), ..Budget::default() };
    let paving = Paving::new(&robot, &window, &modes, &budget, &control);
    let scale = aspecta::aspect::typical(&robot, &window, &modes);
    aspecta::aspect::certify(&robot, &scale, &[paving], vec![], vec![], vec![Claim { low, high: None }; 8])
}

fn file(directory: &TempDir, text: &str) -> PathBuf {
    let path = directory.path().join("five-bar.json");
    std::fs::write(&path, text).unwrap();
    path
}

#[test]
fn what_is_proved_is_verified() {
    let directory = tempfile::tempdir().unwrap();
    let path = file(&directory, &certificate(1).to_json().unwrap());
    let output = aspecta("verify --robot five-bar").arg(&path).output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{text}");
    assert!(text.contains("verified: at least 8 generalized aspects"), "{text}");
    assert!(output.stderr.is_empty());
    let verdict = json(&format!("verify --json {}", path.display()));
    assert_eq!((&verdict["complete"], &verdict["faults"]), (&true.into(), &serde_json::json!([])));
    assert_eq!(verdict["classes"][3]["mode"], "+-");
}

#[test]
fn what_is_not_proved_is_not_verified() {
    let directory = tempfile::tempdir().unwrap();
    let path = file(&directory, &certificate(3).to_json().unwrap());
    let output = aspecta("verify").arg(&path).output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(1), "{text}");
    assert!(
        text.contains("fault: class 0 (++, det A > 0): claimed to have at least 3 aspects, but proved to have at least 1"),
        "{text}"
    );
    assert!(text.ends_with("not verified: not all claims are proved with the effort spent\n"), "{text}");
}

/// The first leaf, out of reach, is claimed inside class 0.
#[test]
fn what_is_proved_wrong_is_said_to_be() {
    let directory = tempfile::tempdir().unwrap();
    let mut wrong = certificate(1);
    let leaf = wrong.sheets[0].tree.0.iter_mut().find_map(|entry| match entry {
        Entry::Leaf(leaf) if leaf.undecided == 0 => Some(leaf),
        _ => None,
    });
    leaf.unwrap().inside = 1;
    let path = file(&directory, &wrong.to_json().unwrap());
    let output = aspecta("verify").arg(&path).output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(1), "{text}");
    assert!(text.ends_with("not verified: a claim is proved wrong\n"), "{text}");
    let output = aspecta("verify --json").arg(&path).output().unwrap();
    let verdict: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(verdict["faults"][0]["is_wrong"], true);
}

#[test]
fn a_certificate_of_another_robot_does_not_do() {
    let directory = tempfile::tempdir().unwrap();
    let path = file(&directory, &certificate(1).to_json().unwrap());
    let output = aspecta("verify --robot 2-prr").arg(&path).output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&output.stderr).contains("not the robot `2-prr`"));
}

/// A limit that two legs share is part of the robot, in whatever order they are named.
#[test]
fn a_certificate_of_a_robot_with_other_limits_does_not_do() {
    let directory = tempfile::tempdir().unwrap();
    let five_bar = stdout("robots show five-bar");
    let limited = |name: &str, legs: &str, max: u32| {
        let path = directory.path().join(name);
        let limit = format!("[[rod-angles]]\nlegs = {legs}\nangle = {{ deg = [15, {max}] }}\n");
        std::fs::write(&path, format!("{five_bar}\n{limit}")).unwrap();
        path.display().to_string()
    };
    let robot = limited("a.toml", "[1, 2]", 120);
    let path = directory.path().join("a.json");
    stdout(&format!("analyze {robot} --mode=+- --budget depth=6 --certificate {}", path.display()));
    let status =
        |robot: &str| aspecta("verify --robot").args([robot]).arg(&path).output().unwrap().status.code();
    assert_eq!(status(&robot), Some(0));
    assert_eq!(status(&limited("c.toml", "[2, 1]", 120)), Some(0));
    for other in ["five-bar", &limited("b.toml", "[1, 2]", 121)] {
        assert_eq!(status(other), Some(1), "{other}");
    }
}

#[test]
fn what_cannot_be_read_is_bad_input() {
    let directory = tempfile::tempdir().unwrap();
    let text = certificate(1).to_json().unwrap();
    let robot = stdout("robots show five-bar");
    let more = certificate(10_usize.pow(19)).to_json().unwrap();
    let version = text.replacen("\"certificate_version\":2", "\"certificate_version\":9", 1);
    let cases = [
        (&text[..text.len() / 2], "damaged"),
        ("{}", "not a certificate"),
        (version.as_str(), "version 9"),
        (more.as_str(), "class 0 counts 10000000000000000000 aspects, more than there are leaves"),
        (robot.as_str(), "five-bar.json`: a robot file, not a certificate; `aspecta analyze "),
        ("", "`aspecta analyze ROBOT --certificate FILE` writes certificates"),
    ];
    for (text, complaint) in cases {
        let output = aspecta("verify").arg(file(&directory, text)).output().unwrap();
        let message = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(message.contains(complaint) && output.stdout.is_empty(), "{message}");
    }
    let path = directory.path().join("five-bar.toml");
    std::fs::write(&path, robot.replacen("crank", "krank", 1)).unwrap();
    let mistaken = aspecta("verify").arg(&path).output().unwrap();
    assert!(
        String::from_utf8_lossy(&mistaken.stderr).contains("five-bar.toml`: a robot file, not a certificate")
    );
    let missing = aspecta("verify no-such-file.json").output().unwrap();
    assert_eq!(missing.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&missing.stderr).contains("no-such-file.json"));
}
