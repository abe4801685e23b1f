//! Robot files: what they mean, and what is said about mistakes in them.

use aspecta::robot::{FileError, Mistake, Robot};

mod limits;
mod meaning;
mod structure;
mod values;

const PLANE: &str = r#"
name = "test"
platform = "plane-point"

[[legs]]
anchor = [0, 0]
actuator = { kind = "revolute", crank = 8, rod = 5 }

[[legs]]
anchor = [9, 0]
actuator = { kind = "revolute", crank = 5, rod = 8 }
"#;

const SPACE: &str = r#"
name = "test"
platform = "translating-body"

[[legs]]
anchor = [0, 0, 0]
actuator = { kind = "revolute", crank = 8, rod = 9, axis = [0, 0, 2], zero = [1, 0, 5] }

[[legs]]
anchor = [0, 0, 0]
actuator = { kind = "prismatic", direction = [0, 3, 0], rod = 5 }
limits = { actuator = [-4, 4] }

[[legs]]
anchor = [0, 0, 0]
actuator = { kind = "strut" }
limits = { actuator = [1, 7] }
"#;

const SPHERE: &str = include_str!("../../../../../robots/spherical-3-rrr.toml");

fn invalid(text: &str) -> (Mistake, String) {
    match Robot::from_toml(text, "my.toml") {
        Err(FileError::Invalid(mistake)) => {
            let message = mistake.to_string();
            (*mistake, message)
        }
        other => panic!("expected a mistake, got {other:?}"),
    }
}

/// Replaces `from`, the first time it occurs in `text`, and returns the first line of the message, without
/// file and place.
fn says(text: &str, from: &str, to: &str) -> String {
    assert!(text.contains(from), "{from}");
    let (mistake, message) = invalid(&text.replacen(from, to, 1));
    let place = format!("my.toml:{}:{}: ", mistake.line, mistake.column);
    message.lines().next().unwrap().strip_prefix(&place).unwrap().to_owned()
}

#[track_caller]
fn assert_starts(message: &str, start: &str) {
    assert!(message.starts_with(start), "{message}\nis not\n{start}…");
}
