//! How the process ends when its reader or its user has had enough.

use assert_cmd::cargo::CommandCargoExt;
use std::io::{Read, Write};
use std::process::{Child, Command, Stdio};

fn spawn(arguments: &[&str]) -> Child {
    let mut command = Command::cargo_bin("aspecta").unwrap();
    command.args(arguments).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    command.spawn().unwrap()
}

fn messages(child: &mut Child) -> String {
    let mut text = String::new();
    child.stderr.take().unwrap().read_to_string(&mut text).unwrap();
    text
}

/// `aspecta … | head -1`: the reader goes away before anything is written.
#[test]
fn a_broken_pipe_is_not_an_error() {
    for format in ["--csv", "--json", ""] {
        let arguments = ["ik", "five-bar", "--file", "-", format];
        let mut child = spawn(&arguments[..if format.is_empty() { 4 } else { 5 }]);
        drop(child.stdout.take());
        let mut stdin = child.stdin.take().unwrap();
        // It may have ended by then.
        let _ = stdin.write_all(&b"4,7\n".repeat(2000));
        drop(stdin);
        assert_eq!(messages(&mut child), "", "{format}");
        assert!(child.wait().unwrap().success());
    }
}

/// The first interrupt ends the work with the result so far.
#[cfg(unix)]
#[test]
fn an_interrupt_keeps_the_result_so_far() {
    use serde_json::Value;
    use std::time::Duration;
    let mut child = spawn(&["analyze", "3-rrr", "--budget", "1h", "--json"]);
    std::thread::sleep(Duration::from_millis(500));
    let interrupt = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(interrupt.success());
    let mut text = String::new();
    child.stdout.take().unwrap().read_to_string(&mut text).unwrap();
    let said = messages(&mut child);
    assert_eq!(child.wait().unwrap().code(), Some(1), "{said}");
    let document: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(document["run"]["stop"], "cancelled");
    assert!(said.contains("stopping") && said.contains("result so far"), "{said}");
}
