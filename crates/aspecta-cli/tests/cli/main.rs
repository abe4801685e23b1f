//! The command line as its users meet it: what it prints, and how it ends.

mod analyze;
mod bad_input;
mod cases;
mod check_path;
mod csv;
mod cusps;
mod domains;
mod explore;
mod export;
mod follow;
mod hostile;
mod json;
mod locate;
mod people;
mod plan;
mod process;
mod time;
mod verify;

use assert_cmd::Command;
use serde_json::Value;
use std::fs;
use std::path::PathBuf;
use std::process::Output;
use tempfile::TempDir;

/// `aspecta` with these arguments, separated by blanks.
pub fn aspecta(arguments: &str) -> Command {
    let mut command = Command::cargo_bin("aspecta").expect("cargo builds the binary for its tests");
    command.args(arguments.split_whitespace());
    command
}

/// Its output, whatever its exit status.
pub fn output(arguments: &str) -> Output {
    aspecta(arguments).output().expect("the binary starts")
}

/// What it prints, when it should succeed.
pub fn stdout(arguments: &str) -> String {
    let output = output(arguments);
    let complaint = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "aspecta {arguments}: {complaint}");
    String::from_utf8(output.stdout).expect("UTF-8")
}

/// The JSON it prints, when it should succeed: nothing but one document.
pub fn json(arguments: &str) -> Value {
    let text = stdout(arguments);
    serde_json::from_str(&text).unwrap_or_else(|e| panic!("aspecta {arguments}: {e}\n{text}"))
}

/// The numbers of a JSON array.
pub fn numbers(value: &Value) -> Vec<f64> {
    let array = value.as_array().unwrap_or_else(|| panic!("not an array: {value}"));
    array.iter().map(|x| x.as_f64().unwrap_or_else(|| panic!("not a number: {x}"))).collect()
}

/// The waypoints of the paper's Table 4.
pub const TABLE_4: &str = "x,y,phi\n-15.468,0.781,0.073\n-15.468,-7.091,0.500\n-9.902,-7.091,1.081\n";

/// A file `path.csv`, and the directory that it goes with.
pub fn file(content: &str) -> (TempDir, PathBuf) {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("path.csv");
    fs::write(&path, content).unwrap();
    (directory, path)
}
