//! Every kind of bad input: exit status 2, a message that says what and where, nothing on stdout.

use crate::{aspecta, output};
use std::fs;

#[track_caller]
fn refused(arguments: &str, complaints: &[&str]) {
    let output = output(arguments);
    let messages = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "aspecta {arguments}: {messages}");
    assert!(output.stdout.is_empty(), "aspecta {arguments}");
    for complaint in complaints {
        assert!(messages.contains(complaint), "aspecta {arguments}\nwanted: {complaint}\nfound: {messages}");
    }
}

#[test]
fn unknown_command_and_option() {
    refused("analyse five-bar", &["unrecognized subcommand 'analyse'", "analyze"]);
    refused("ik five-bar --poses 1,2", &["unexpected argument '--poses'", "--pose"]);
}

#[test]
fn unknown_robot() {
    refused("ik fivebar --pose 1,2", &["`fivebar` is neither", "five-bar", "3-rrr"]);
    refused("robots show fivebar", &["fivebar", "five-bar"]);
    refused("analyze no-such-file.toml", &["no-such-file.toml"]);
}

#[test]
fn missing_or_contradictory_arguments() {
    refused("ik five-bar", &["--pose <LIST>", "--file <CSV>"]);
    refused("ik five-bar --pose 1,2 --file x.csv", &["cannot be used with"]);
    refused("ik five-bar --pose 1,2 --json --csv", &["cannot be used with"]);
    refused("state five-bar --pose 1,2 --q 1,2 --mode ++", &["cannot be used with"]);
    refused("check-path five-bar path.csv", &["--mode"]);
}

#[test]
fn choices_of_drawings() {
    refused("domains 3-rpr --out d --meshes ply,stl", &["invalid value 'stl'", "ply, glb, vtp"]);
    refused("domains 3-rpr --out d --hold q4", &["invalid value 'q4'", "q1, q2, q3"]);
    refused("domains 3-rpr --meshes ply", &["--out <DIR>"]);
}

#[test]
fn lists_that_are_not_numbers() {
    refused("ik five-bar --pose 1,abc", &["--pose: number 2 of `1,abc`, `abc`, is not a number; write x,y"]);
    refused("ik five-bar --pose 1,,2", &["number 2 of `1,,2`, ``, is not a number"]);
    refused("fk five-bar --q --json", &["--q: number 1 of `--json`"]);
    refused("ik five-bar --pose nan,2", &["pose coordinate 1 is NaN: give a finite number"]);
    refused("fk five-bar --q 1,-inf", &["joint coordinate 2 is -inf: give a finite number"]);
    refused("fk five-bar --q 1e300,1", &["joint coordinate 1 is 1e300: beyond"]);
}

#[test]
fn lists_of_the_wrong_length() {
    refused("ik five-bar --pose 1,2,3", &["robot `five-bar` has 2 pose coordinates (x, y), not 3"]);
    refused("fk 3-rrr --q 1", &["robot `3-rrr` has 3 joint coordinates (q1, q2, q3), not 1"]);
    refused("state five-bar --pose 1", &["has 2 pose coordinates"]);
    refused("state five-bar --pose 4,7 --q 1,2,3", &["has 2 joint coordinates"]);
}

#[test]
fn working_modes_the_robot_does_not_have() {
    refused(
        "ik five-bar --pose 4,7 --mode +",
        &["`+` is not a working mode of `five-bar`; it has ++, +-, --, -+"],
    );
    refused("ik five-bar --pose 4,7 --mode up", &["`up` is not a working mode"]);
    refused("state 3-rpr --pose 3,4,0 --mode +++", &["it has ---"]);
}

/// Which leg, and by how much: |A1C1| = 20, 7 beyond 8 + 5; |A2C1| = 29, 16 beyond.
#[test]
fn unreachable_poses() {
    for (arguments, words) in [
        ("ik five-bar --pose -20,0", &["out of reach: leg 1 by 7.000000", "leg 2 by 16.000000"][..]),
        ("state five-bar --pose -20,0", &["out of reach: leg 1 by 7.000000"]),
        // |A1C1| = 1 is 2 short of 8 − 5; leg 2 reaches.
        ("ik five-bar --pose 1,0", &["out of reach: leg 1 by 2.000000"]),
    ] {
        // An answer, and so one in JSON too.
        let run = output(&format!("{arguments} --json"));
        let message = String::from_utf8(run.stderr).unwrap();
        assert_eq!(run.status.code(), Some(1), "{arguments}: {message}");
        assert!(words.iter().all(|part| message.contains(part)), "{message}");
        let answer: serde_json::Value = serde_json::from_slice(&run.stdout).unwrap();
        let found = answer.get("solutions").or(answer.get("states")).unwrap_or_else(|| panic!("{answer}"));
        assert_eq!(found.as_array().unwrap().len(), 0, "{answer}");
    }
}

#[test]
fn six_dimensions_at_once() {
    refused("analyze hexa", &["6 degrees of freedom, 6 of them free", "`--fix roll=0,pitch=0,yaw=0`"]);
}

#[test]
fn budgets_and_threads() {
    refused("analyze five-bar --budget soon", &["`soon` is not a budget", "30s", "depth=9", "res=0.1"]);
    refused("analyze five-bar --budget 30s,1min", &["`1min` sets again"]);
    refused("analyze five-bar --budget -3s", &["not a positive number"]);
    refused("analyze five-bar --threads 0", &["0 is not in 1..="]);
    refused("completions tcsh", &["invalid value 'tcsh'", "bash"]);
}

/// What `--fix` is given: form, coordinate, unit, value, and what is left.
#[test]
fn coordinates_that_cannot_be_held() {
    for (fix, complaints) in [
        ("phi", &["--fix: `phi` is not COORDINATE=VALUE", "x=0.5"][..]),
        ("psi=0", &["--fix: `3-rrr` has no coordinate `psi`; it has x, y, phi"]),
        ("z=0", &["no coordinate `z`; it has x, y, phi"]),
        ("phi=up", &["`phi=up`: `up` is not a value of `phi`: give radians, or 30deg"]),
        ("phi=", &["`` is not a value of `phi`"]),
        ("x=3deg", &["`x=3deg`: `x` is a length: give a plain number"]),
        ("phi=nan", &["`phi` cannot be held at NaN: give a finite number within ±1e7"]),
        ("x=inf", &["`x` cannot be held at inf"]),
        ("phi=1e300", &["`phi` cannot be held at 1e300"]),
        ("x=100", &["`x` cannot be held at 100 unit: links, limits and window keep it from -20 to 10 unit"]),
        ("phi=0,phi=1", &["`phi` is held twice"]),
        ("x=1 --fix x=2", &["`x` is held twice"]),
        ("x=0,y=0,phi=0", &["all coordinates (x, y, phi) are held: leave at least one free"]),
    ] {
        refused(&format!("analyze 3-rrr --fix {fix}"), complaints);
    }
    refused("analyze spherical-3-rrr --fix pitch=100deg", &["`pitch` cannot be held", "1.5708 rad"]);
    refused("analyze hexa --fix z=1", &["5 of them free", "--fix z=1,pitch=0,yaw=0"]);
}

#[test]
fn files_that_cannot_be_read_or_written() {
    refused("ik five-bar --file no-such-file.csv", &["cannot read `no-such-file.csv`"]);
    refused("check no-such-file.toml", &["no-such-file.toml"]);
    let directory = tempfile::tempdir().unwrap();
    let taken = directory.path().join("taken");
    fs::write(&taken, "a file").unwrap();
    let output = aspecta("analyze five-bar --budget depth=3 --out").arg(&taken).output().unwrap();
    let messages = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2));
    assert!(messages.contains("--out ") && messages.contains("taken"), "{messages}");
}

/// A mistake in a robot file: file, line, key, value. (The library's tests go through all of them.)
#[test]
fn robot_files_with_a_mistake() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("mine.toml");
    let good = crate::stdout("robots show five-bar");
    fs::write(&path, good.replace("crank", "krank")).unwrap();
    for command in ["check", "analyze", "ik --pose 4,7"] {
        let output = aspecta(command).arg(&path).output().unwrap();
        let messages = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{messages}");
        assert!(messages.contains("mine.toml:") && messages.contains("krank"), "{messages}");
        assert!(output.stdout.is_empty());
    }
    fs::write(&path, good).unwrap();
    let output = aspecta("check").arg(&path).output().unwrap();
    assert!(output.status.success());
}

#[test]
fn a_robot_file_on_stdin_is_checked() {
    let good = crate::stdout("robots show five-bar");
    let bad = aspecta("check -").write_stdin(good.replace("crank", "krank")).output().unwrap();
    let messages = String::from_utf8_lossy(&bad.stderr);
    assert_eq!(bad.status.code(), Some(2));
    assert!(messages.contains("stdin:") && messages.contains("krank"), "{messages}");
    let fine = aspecta("check -").write_stdin(good).output().unwrap();
    let text = String::from_utf8_lossy(&fine.stdout);
    assert_eq!(text, "stdin: `five-bar` is a plane-point with 2 legs and 4 working modes\n");
    let no_text = aspecta("check -").write_stdin(&b"name = \"\xff\""[..]).output().unwrap();
    let messages = String::from_utf8_lossy(&no_text.stderr);
    assert!(no_text.status.code() == Some(2) && messages.contains("stdin: cannot be read"), "{messages}");
}

/// A right file of a robot that is of no use: it is told, but not refused.
#[test]
fn two_legs_in_one_are_warned_of() {
    let leg = "[[legs]]\nanchor = [0, 0]\nattachment = [1, 0]\nactuator = { kind = \"strut\" }\n";
    let other = leg.replace("[0, 0]", "[9, 4]").replace("[1, 0]", "[2, 3]");
    let head = "name = \"mine\"\nplatform = \"plane-body\"\n";
    let checked = |third: &str| {
        let output = aspecta("check -").write_stdin([head, leg, &other, third].concat()).output().unwrap();
        assert!(output.status.success());
        String::from_utf8(output.stderr).unwrap()
    };
    assert_eq!(checked(&leg.replace("[0, 0]", "[0, 8]")), "");
    let warning = checked(leg);
    assert!(warning.starts_with("warning: det A vanishes at every pose that was looked at"), "{warning}");
}
