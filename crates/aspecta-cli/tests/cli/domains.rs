//! `aspecta domains --out`.

use crate::{aspecta, output};
use std::fs;

#[test]
fn pictures_are_written_and_named() {
    let directory = tempfile::tempdir().unwrap();
    let arguments = "domains five-bar --aspect 1 --cells 60 --budget depth=7 --out";
    let output = aspecta(arguments).arg(directory.path()).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).unwrap();
    let mut names: Vec<String> = fs::read_dir(directory.path())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    assert_eq!(names, ["aspect-1-regions.svg", "aspect-1-uniqueness.svg"]);
    for name in names {
        let line = format!("written: {}", directory.path().join(&name).display());
        assert!(text.lines().any(|l| l == line), "{line}\n{text}");
    }
    // With --json stdout holds nothing but JSON.
    let output = aspecta(arguments).arg(directory.path()).arg("--json").output().unwrap();
    assert!(serde_json::from_slice::<serde_json::Value>(&output.stdout).is_ok());
    assert!(String::from_utf8_lossy(&output.stderr).contains("written: "));
}

/// Before the long work: the depth asked for would take hours.
#[test]
fn a_directory_that_cannot_be_written_is_refused() {
    let directory = tempfile::tempdir().unwrap();
    let taken = directory.path().join("taken");
    fs::write(&taken, "a file").unwrap();
    let output = aspecta("domains 3-rrr --budget depth=12 --out")
        .arg(&taken)
        .timeout(std::time::Duration::from_secs(20))
        .output()
        .unwrap();
    let messages = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{messages}");
    assert!(
        output.stdout.is_empty() && messages.contains("--out ") && messages.contains("taken"),
        "{messages}"
    );
}

#[test]
fn without_out_nothing_is_written() {
    let text = output("domains five-bar --aspect 1 --cells 60 --budget depth=7");
    assert!(text.status.success() && !String::from_utf8_lossy(&text.stdout).contains("written"));
}
