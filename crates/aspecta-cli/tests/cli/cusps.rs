//! `aspecta cusps`.

use crate::{json, numbers, output, stdout};

#[test]
fn the_slice_of_the_3_rpr_has_six_cusps() {
    let result = json("cusps 3-rpr --fix q1=14.98 --json");
    assert_eq!((&result["format_version"], &result["complete"]), (&1.into(), &true.into()));
    assert_eq!(result["fixed"][0]["joint"], "q1");
    let cusps = result["cusps"].as_array().unwrap();
    assert_eq!(cusps.len(), 6);
    for cusp in cusps {
        let (x, q) = (numbers(&cusp["pose"]), numbers(&cusp["q"]));
        assert!((x[0].hypot(x[1]) - 14.98).abs() < 1e-9 && q[0] == 14.98);
        assert_eq!(cusp["unfolding"]["poses"].as_array().unwrap().len(), 3);
        // Asked of another command: singular.
        let list = |v: &[f64]| v.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
        let state = json(&format!("state 3-rpr --pose {} --q {} --json", list(&x), list(&q)));
        assert_eq!(state["states"][0]["singularity"], "parallel");
    }
    let text = stdout("cusps 3-rpr --fix q1=14.98 --deg");
    assert!(text.starts_with("3-rpr: 6 cusps at q1 = 14.980000 unit (proved to be all)"), "{text}");
    assert!(text.contains("phi [deg]") && text.matches("3 | 1").count() == 6, "{text}");
}

#[test]
fn none_or_undecided_is_exit_status_1() {
    let none = output("cusps five-bar");
    assert_eq!(none.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&none.stdout).contains("five-bar: 0 cusps (proved"));
    let cut = output("cusps 3-rpr --fix q1=14.98 --boxes 100");
    assert_eq!(cut.status.code(), Some(1));
    let text = String::from_utf8_lossy(&cut.stdout);
    assert!(text.contains("not proved to be all") && text.contains("budget of boxes"), "{text}");
}

/// A budget that ends with the first box leaves it in all modes: one line.
#[test]
fn what_is_undecided_in_many_modes_is_said_once() {
    let cut = output("cusps spherical-3-rrr --fix q1=0.3 --boxes 100");
    let text = String::from_utf8_lossy(&cut.stdout);
    assert_eq!(text.matches("undecided, ").count(), 1, "{text}");
    assert!(text.contains("undecided, 8 modes (+++, ++-, "), "{text}");
}

#[test]
fn bad_input_is_refused() {
    for (arguments, complaint) in [
        ("cusps 3-rpr --fix q1", "--fix: `q1` is not JOINT=VALUE; write for instance q1=0.5"),
        ("cusps 3-rpr --fix x=1", "--fix: `3-rpr` has no joint `x`; it has q1, q2, q3"),
        ("cusps 3-rpr --fix q1=30deg", "`q1` is a length: give a plain number"),
        ("cusps 3-rpr --fix q1=-1", "whose length must be positive"),
        ("cusps 3-rpr --fix q1=14,q2=15", "with 1 of the 3 joints held, not 2"),
        ("cusps 3-rpr --fix q1=14 --mode +++", "--mode: `+++` is not a working mode"),
        ("cusps five-bar --fix q1=1", "with 0 of the 2 joints held, not 1"),
        ("cusps hexa", "6 degrees of freedom"),
        ("cusps 3-rpr --fix q1=14 --boxes 0", "--boxes"),
    ] {
        let output = output(arguments);
        let messages = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments}: {messages}");
        assert!(output.stdout.is_empty() && messages.contains(complaint), "{arguments}: {messages}");
    }
}
