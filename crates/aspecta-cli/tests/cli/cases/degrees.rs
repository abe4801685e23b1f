//! Degrees in, radians out.

use super::stderr;
use crate::{aspecta, json, output, stdout};

fn said(arguments: &str, stdin: &str) -> String {
    let run = aspecta(arguments).write_stdin(stdin).output().unwrap();
    assert_eq!(run.status.code(), Some(0), "{arguments}");
    String::from_utf8(run.stderr).unwrap()
}

/// What is printed as CSV is in radians: whoever asked for degrees, or reads degrees, is told.
#[test]
fn csv_in_radians_is_not_taken_for_degrees() {
    let told = "warning: angles of this CSV are in radians";
    for arguments in [
        "ik 3-rrr --file - --csv --deg",
        "state 3-rrr --file - --csv --deg --mode +++",
        "check-path 3-rrr - --mode +++ --csv --deg",
        "follow 3-rrr --inverse --mode +++ --csv --deg",
    ] {
        let message = said(arguments, "-15.468,0.781,4\n-15.468,0.781,5\n");
        assert_eq!(message.matches(told).count(), 1, "{message}");
        assert_eq!(said(&arguments.replace(" --csv", ""), "-15.468,0.781,4\n-15.468,0.781,5\n"), "");
        assert_eq!(said(&arguments.replace(" --deg", ""), "-15.468,0.781,0.07\n-15.468,0.781,0.08\n"), "");
    }
    let joints = stdout("ik 3-rrr --pose -15.468,0.781,0.07 --csv --mode +++");
    assert!(said("fk 3-rrr --file - --deg", &joints).contains("warning: stdin has a column `mode`"));
    assert_eq!(said("fk 3-rrr --file -", &joints), "");
    // Lengths are the same in both.
    assert_eq!(said("fk 3-rpr --file - --deg", &stdout("ik 3-rpr --pose 5,10,0.3 --csv")), "");
}

#[test]
fn a_held_angle_is_in_degrees_where_all_are() {
    let fixed = |arguments: &str| {
        json(&format!("analyze 3-rrr --budget depth=4 --json {arguments}"))["window"].clone()
    };
    let right = fixed("--fix phi=30deg,y=-5");
    assert_eq!(fixed("--fix phi=30,y=-5 --deg"), right);
    assert_eq!(fixed("--fix phi=30deg,y=-5 --deg"), right);
    assert_ne!(fixed("--fix phi=30rad,y=-5 --deg"), right);
    assert!(!stderr("analyze 3-rrr --fix phi=30,y=-5 --deg --budget depth=3").contains("warning"));
    let wrong = output("analyze 3-rrr --fix phi=up --deg");
    assert!(String::from_utf8(wrong.stderr).unwrap().contains("give degrees, or 0.5rad"));
}

#[test]
fn regions_are_told_in_degrees() {
    let asked = "domains 3-rrr --fix x=-10 --mode +++ --det + --cells 40 --budget depth=6";
    let (radians, degrees) = (stdout(asked), stdout(&format!("{asked} --deg")));
    assert!(radians.contains("phi [rad]") && degrees.contains("phi [deg]"), "{degrees}");
    let phi = |text: &str| -> f64 {
        let row = text.lines().find(|line| line.trim_start().starts_with("1 ")).unwrap();
        row.split_whitespace().nth(4).unwrap().parse().unwrap()
    };
    assert!((phi(&radians).to_degrees() - phi(&degrees)).abs() < 0.05, "{radians}{degrees}");
    let held = stdout("domains 3-rrr --fix phi=30 --deg --mode +++ --det + --cells 40 --budget depth=6");
    assert!(held.contains("phi = 30.000000 deg"), "{held}");
}
