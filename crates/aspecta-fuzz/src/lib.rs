//! What must hold of every input, however hostile: one function a kind of input. The fuzzer (`fuzz/`) looks for
//! inputs of which it does not hold; the tests replay those that were found, and seeds.

mod certificate;
mod map;

pub use certificate::certificate;
pub use map::map;

use aspecta::{Kinematics, Robot, catalogue};
use std::fmt::Write;
use std::sync::LazyLock;

/// Robot files: one that is read makes sense, can be computed with, and is written and read again as the same
/// robot; of another it is said what is wrong.
pub fn robot_file(text: &[u8]) {
    match Robot::read(text, "fuzz.toml") {
        Err(error) => assert!(!error.to_string().is_empty()),
        Ok(robot) => {
            robot.check().expect("a robot that is read makes sense");
            let written = serde_json::to_vec(&robot).expect("a robot is written");
            let again: Robot = serde_json::from_slice(&written).expect("what is written is read");
            assert_eq!(again, robot);
            if let Ok(window) = robot.slice(&[]) {
                let pose: Vec<f64> = window.ranges.iter().map(|(lo, hi)| 0.5 * (lo + hi)).collect();
                for s in robot.inverse(&pose).expect("a pose of the window can be asked about") {
                    robot.state(&pose, &s.q).expect("so can its solutions");
                }
            }
        }
    }
}

/// CSV files: numbers are finite, and written and read again as the same; a bad line has a message with its
/// number.
pub fn csv(text: &[u8]) {
    static ROBOTS: LazyLock<Vec<Robot>> =
        LazyLock::new(|| ["five-bar", "3-rrr"].iter().filter_map(|name| catalogue::find(name)).collect());
    for robot in &*ROBOTS {
        let (rows, complaint) = aspecta_cli::fuzz::rows(robot, text);
        assert!(complaint.is_none_or(|complaint| complaint.starts_with("fuzz.csv")));
        assert!(rows.iter().flatten().all(|x| x.is_finite()));
        let mut written = String::new();
        for row in &rows {
            let fields: Vec<String> = row.iter().map(|x| format!("{x:?}")).collect();
            writeln!(written, "{}", fields.join(",")).expect("a string can be written to");
        }
        assert_eq!(aspecta_cli::fuzz::rows(robot, written.as_bytes()).0, rows);
    }
}

/// Arguments, separated by blanks: answers are text, JSON where it is asked for.
pub fn arguments(text: &[u8]) {
    let Ok(text) = str::from_utf8(text) else { return };
    let arguments: Vec<&str> = text.split_whitespace().collect();
    match aspecta_cli::fuzz::answer(&arguments) {
        None => {}
        Some(Err(complaint)) => assert!(!complaint.is_empty()),
        Some(Ok(answer)) => {
            let answer = String::from_utf8(answer).expect("answers are text");
            if arguments.contains(&"--json") {
                serde_json::from_str::<serde_json::Value>(&answer).expect("answers are JSON");
            }
        }
    }
}
