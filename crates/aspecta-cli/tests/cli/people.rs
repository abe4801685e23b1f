//! What people read.

use crate::{aspecta, stdout};

#[test]
fn tables_have_headings_with_units_and_no_colours() {
    let text = stdout("ik five-bar --pose 4,7");
    let mut lines = text.lines();
    assert!(lines.next().unwrap().starts_with("five-bar: 4 inverse solutions at x = 4.000000 "));
    let heading = lines.next().unwrap();
    assert!(["mode", "q1 [rad]", "q2 [rad]", "det A"].iter().all(|name| heading.contains(name)), "{heading}");
    // Right-aligned numbers end where their heading ends.
    let end = heading.find("q1 [rad]").unwrap() + "q1 [rad]".len();
    assert!(lines.all(|line| line.as_bytes()[end - 1].is_ascii_digit() && line.as_bytes()[end] == b' '));
    assert!(!text.contains('\u{1b}'));
}

#[test]
fn degrees_are_shown_on_request() {
    let text = stdout("fk five-bar --q 90,180 --deg");
    assert!(text.contains("q1 = 90.000000 deg"), "{text}");
    let text = stdout("ik 3-rrr --pose -15.468,0.781,0.073 --mode +++");
    assert!(text.contains("phi = 0.073000 rad"), "{text}");
}

#[test]
fn zeros_have_no_sign() {
    let text = stdout("ik linear-delta --pose -0.0,0,-0.0");
    assert!(text.contains("x = 0.000000 mm, y = 0.000000 mm, z = 0.000000 mm"), "{text}");
    let rows = aspecta("ik linear-delta --json --file -").write_stdin("-0.0,0,-0.0\n").output().unwrap();
    let text = String::from_utf8(rows.stdout).unwrap();
    assert!(text.contains(" 0.0") && !text.contains("-0.0\n") && !text.contains("-0.0,"), "{text}");
    let rows = aspecta("ik linear-delta --csv --file -").write_stdin("-0.0,0,-0.0\n").output().unwrap();
    let text = String::from_utf8(rows.stdout).unwrap();
    assert!(text.lines().nth(1).unwrap().starts_with("1,0.0,0.0,0.0,"), "{text}");
}

#[test]
fn robots_lists_the_catalogue_and_shows_files() {
    let text = stdout("robots");
    for name in [
        "five-bar",
        "3-rrr",
        "3-rpr",
        "symmetric-five-bar",
        "2-prr",
        "3-prr",
        "delta",
        "irb-360",
        "linear-delta",
        "orthoglide",
        "spherical-3-rrr",
        "hexa",
        "gough-stewart",
    ] {
        assert!(text.lines().any(|line| line.trim_start().starts_with(name)), "{name} in\n{text}");
    }
    assert!(stdout("robots show five-bar").contains("platform"));
}

#[test]
fn completions_name_the_commands() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        assert!(stdout(&format!("completions {shell}")).contains("check-path"), "{shell}");
    }
}

#[test]
fn help_lists_the_commands_and_exit_statuses() {
    let text = stdout("--help");
    for word in ["analyze", "ik", "fk", "state", "check-path", "robots", "check", "schema", "Exit status"] {
        assert!(text.contains(word), "{word} in\n{text}");
    }
}

#[test]
fn state_shows_jacobians_of_a_single_configuration() {
    let text = stdout("state five-bar --pose 4,7 --mode ++");
    for word in [
        "working mode  ++",
        "det A",
        "condition",
        "singularity   regular (a measure ≤ 1e-6 counts as singular)",
        "leg 2",
    ] {
        assert!(text.contains(word), "{word} in\n{text}");
    }
}
