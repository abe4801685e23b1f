//! Input without end, or larger than any use: what is answered, and that it is done in little memory.

use crate::{aspecta, output};
use assert_cmd::cargo::CommandCargoExt;
use serde_json::Value;
use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::thread;
use tempfile::TempDir;

/// `aspecta` with these arguments, to be fed.
fn spawn(arguments: &str) -> (Child, ChildStdin, BufReader<ChildStdout>) {
    let mut command = Command::cargo_bin("aspecta").unwrap();
    command.args(arguments.split_whitespace()).stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = command.stderr(Stdio::piped()).spawn().unwrap();
    let (stdin, stdout) = (child.stdin.take().unwrap(), child.stdout.take().unwrap());
    (child, stdin, BufReader::new(stdout))
}

/// How it ends and what it says, once it is fed with `chunk` until it takes no more, or `times`.
fn fed(arguments: &str, chunk: &[u8], times: usize) -> (Option<i32>, String, String) {
    let (child, mut stdin, mut stdout) = spawn(arguments);
    let chunk = chunk.to_owned();
    let feeder = thread::spawn(move || (0..times).all(|_| stdin.write_all(&chunk).is_ok()));
    let mut answer = String::new();
    stdout.read_to_string(&mut answer).unwrap();
    let ended = child.wait_with_output().unwrap();
    feeder.join().unwrap();
    (ended.status.code(), answer, String::from_utf8(ended.stderr).unwrap())
}

/// A map of one class of the five-bar.
fn map() -> (TempDir, String) {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("five-bar.aspecta").display().to_string();
    let made = output(&format!("domains five-bar --mode ++ --budget depth=4 --cells 6 --save {path}"));
    assert!(fs::exists(&path).unwrap(), "{}", String::from_utf8_lossy(&made.stderr));
    (directory, path)
}

/// Each command that takes many rows, in each format that it streams, with a row and the last words of its
/// answer.
fn streams(map: &str) -> Vec<(String, &'static str, &'static str)> {
    let mut streams = Vec::new();
    for (command, row, csv, json) in [
        ("ik five-bar --mode ++".to_owned(), "4,7\n", ",++,", "\"certified\""),
        ("fk five-bar --mode ++".to_owned(), "2,-3\n", ",++,", "\"certified\""),
        ("state five-bar --mode ++".to_owned(), "4,7\n", ",++,", "\"residual\""),
        (format!("locate {map} --mode ++"), "4,7\n", ",++,", "\"uniqueness\""),
    ] {
        streams.push((format!("{command} --file - --csv"), row, csv));
        streams.push((format!("{command} --file - --json"), row, json));
    }
    streams.push(("follow five-bar --inverse --mode ++ --json".into(), "4,7\n", "\"mode\""));
    streams
}

/// The most memory that a process has had so far, in KiB.
#[cfg(target_os = "linux")]
fn peak(child: &Child) -> u64 {
    let status = fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap();
    let line = status.lines().find(|line| line.starts_with("VmHWM:")).unwrap();
    line.split_whitespace().nth(1).unwrap().parse().unwrap()
}

/// A row is answered before the next one comes, and none is kept.
#[cfg(target_os = "linux")]
#[test]
fn rows_stream_in_constant_memory() {
    const ROWS: usize = 20_000;
    let (_directory, map) = map();
    for (arguments, row, last) in streams(&map) {
        let (mut child, mut stdin, stdout) = spawn(&arguments);
        let mut answers = stdout.lines().filter(|line| line.as_ref().unwrap().contains(last));
        for _ in 0..100 {
            stdin.write_all(row.as_bytes()).unwrap();
            assert!(answers.next().is_some(), "{arguments}");
        }
        let before = peak(&child);
        let feeder = thread::spawn(move || {
            stdin.write_all(row.repeat(ROWS).as_bytes()).unwrap();
            stdin
        });
        assert_eq!(answers.by_ref().take(ROWS).count(), ROWS, "{arguments}");
        let stdin = feeder.join().unwrap();
        let grown = peak(&child) - before;
        assert!(grown < 1024, "{arguments}: {grown} KiB more for {ROWS} rows");
        drop((stdin, answers));
        // 1: the map is too coarse to name a region.
        assert!(matches!(child.wait().unwrap().code(), Some(0 | 1)), "{arguments}");
    }
}

/// What a finite input is answered is one JSON document, as before it was streamed.
#[test]
fn json_of_rows_is_laid_out_like_other_json() {
    let (code, answer, _) = fed("ik five-bar --file - --json", b"4,7\n-20,0\n3,5\n", 1);
    let document: Value = serde_json::from_str(&answer).unwrap();
    assert_eq!((code, document["results"].as_array().unwrap().len()), (Some(1), 3));
    let keys = ["\"format_version\"", "\"robot\"", "\"length_unit\"", "\"angle_unit\"", "\"results\""];
    let places: Vec<_> = keys.map(|key| answer.find(key).unwrap()).into();
    assert!(places.is_sorted(), "{answer}");
    assert!(answer.contains("  \"results\": [\n    {\n      \"line\": 1,\n      \"pose\": [\n        4.0,"));
    assert!(answer.contains("\n      \"solutions\": []\n    },\n    {\n      \"line\": 3,"), "{answer}");
    assert!(answer.ends_with("\n      ]\n    }\n  ]\n}\n"), "{answer}");
}

/// A bad row does not take back the answers before it.
#[test]
fn answers_before_a_bad_row_come_out() {
    let rows = b"4,7\n3,5\n4,seven\n4,7\n";
    let complaint = "error: stdin:3: column 2, y: `seven` is not a number";
    for (format, mode) in [("--csv", ",++,"), ("", " ++ "), ("--json", "\"mode\": \"++\"")] {
        let (code, answer, said) = fed(&format!("ik five-bar --file - {format}"), rows, 1);
        assert_eq!(code, Some(2), "{said}");
        assert!(said.contains(complaint), "{said}");
        assert_eq!(answer.matches(mode).count(), 2, "{answer}");
        if format == "--json" {
            serde_json::from_str::<Value>(&answer).unwrap();
        }
    }
}

/// A row that is too far away for any robot is an answer, as one out of reach is.
#[test]
fn a_row_that_cannot_be_asked_about_does_not_cost_the_others() {
    for command in ["ik", "state", "fk"] {
        let rows = b"1e300,7\n2,-3\n";
        let (code, answer, said) = fed(&format!("{command} five-bar --file - --csv"), rows, 1);
        assert_eq!(code, Some(1), "{said}");
        assert!(said.contains("line 1: ") && said.contains("1e300: beyond"), "{said}");
        assert!(answer.lines().nth(1).unwrap().starts_with("2,"), "{answer}");
    }
}

#[test]
fn a_line_without_end_is_refused() {
    for command in ["ik five-bar --file -", "check-path five-bar - --mode ++", "follow five-bar --pose 4,7"] {
        let (code, answer, said) = fed(command, &[b'1'; 4096], usize::MAX);
        assert_eq!((code, answer.as_str()), (Some(2), ""), "{command}: {said}");
        assert!(said.contains("stdin:1: a line of more than 65536 bytes"), "{command}: {said}");
    }
}

/// The columns of a table are as wide as what is in them: it is held as a whole, within a bound.
#[test]
fn a_table_of_too_many_lines_ends() {
    let (code, answer, said) = fed("ik five-bar --file -", &b"4,7\n".repeat(1000), usize::MAX);
    assert_eq!(code, Some(2), "{said}");
    assert!(
        said.contains("line 25001: a table holds at most 100000 lines; --csv and --json print"),
        "{said}"
    );
    assert!(answer.starts_with("five-bar: 100000 inverse solutions of 25000 rows\n"));
}

#[test]
fn rows_of_which_all_are_needed_are_bounded() {
    for command in ["check-path five-bar - --mode ++", "traverse five-bar --poses -"] {
        let (code, answer, said) = fed(command, &b"4,7\n".repeat(1000), usize::MAX);
        assert_eq!((code, answer.as_str()), (Some(2), ""), "{command}: {said}");
        assert!(said.contains("more than 1000000 rows"), "{command}: {said}");
    }
}

/// As of what a shell runs in the background; its children ignore them too.
#[cfg(unix)]
fn interrupts_are_ignored() -> bool {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let ignored = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = ignored.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.is_some_and(|mask| mask & 1 << 1 != 0)
}

/// A stream keeps no result to be waited for.
#[cfg(unix)]
#[test]
fn an_interrupt_ends_a_stream_at_once() {
    if interrupts_are_ignored() {
        return;
    }
    let (_directory, map) = map();
    for arguments in ["ik five-bar --file - --csv".to_owned(), format!("locate {map} --file - --csv")] {
        let (mut child, mut stdin, mut stdout) = spawn(&arguments);
        stdin.write_all(b"4,7\n").unwrap();
        stdout.read_line(&mut String::new()).unwrap();
        let interrupt = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
        assert!(interrupt.success());
        assert!(!child.wait().unwrap().success(), "{arguments}");
        drop(stdin);
    }
}

/// The list and the document are closed: what was answered can be read.
#[cfg(unix)]
#[test]
fn an_interrupt_leaves_a_whole_document() {
    if interrupts_are_ignored() {
        return;
    }
    let (_directory, map) = map();
    for command in ["ik five-bar", "state five-bar --mode ++", &format!("locate {map}")] {
        let (mut child, mut stdin, mut stdout) = spawn(&format!("{command} --file - --json"));
        stdin.write_all(b"4,7\n3,5\n").unwrap();
        let mut text = String::new();
        // The end of the first answer comes with the second.
        while !text.ends_with("    },\n") {
            assert_ne!(stdout.read_line(&mut text).unwrap(), 0, "{text}");
        }
        let interrupt = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
        assert!(interrupt.success());
        stdout.read_to_string(&mut text).unwrap();
        assert_eq!(child.wait().unwrap().code(), Some(130), "{command}");
        drop(stdin);
        let document: Value =
            serde_json::from_str(&text).unwrap_or_else(|e| panic!("{command}: {e}\n{text}"));
        assert_eq!(document["results"][0]["line"], 1);
        assert!(!document["results"].as_array().unwrap().is_empty());
    }
}

#[test]
fn a_robot_file_that_is_too_large_is_refused() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("large.toml");
    fs::write(&path, "[[legs]]\n".repeat(1_600_000)).unwrap();
    for command in ["check", "analyze", "verify --robot five-bar"] {
        let output = aspecta(command).arg(&path).output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{said}");
        let complaint = "large.toml: larger than the 1024 KiB that a robot file may hold";
        assert!(command.starts_with("verify") || said.contains(complaint), "{command}: {said}");
    }
    let (code, _, said) = fed("check -", &[b' '; 4096], usize::MAX);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("stdin: larger than the 1024 KiB"), "{said}");
}

/// Devices and pipes are read no further than files.
#[cfg(unix)]
#[test]
fn a_robot_file_that_has_no_end_is_refused() {
    for command in ["check /dev/zero", "ik /dev/zero --pose 4,7", "locate /dev/zero --pose 4,7"] {
        let output = output(command);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains("/dev/zero: larger than the 1024 KiB"), "{command}: {said}");
    }
}

#[cfg(unix)]
#[test]
fn a_robot_may_come_through_a_pipe() {
    let directory = tempfile::tempdir().unwrap();
    let pipe = directory.path().join("pipe");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let text = crate::stdout("robots show five-bar");
    let writer = thread::spawn({
        let pipe = pipe.clone();
        move || fs::write(pipe, text)
    });
    let output = aspecta("ik --pose 4,7").arg(&pipe).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    writer.join().unwrap().unwrap();
    // What is no certificate is not read a second time.
    let writer = thread::spawn({
        let pipe = pipe.clone();
        move || fs::write(pipe, "no certificate")
    });
    assert_eq!(aspecta("verify").arg(&pipe).output().unwrap().status.code(), Some(2));
    writer.join().unwrap().unwrap();
}
