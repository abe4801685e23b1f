//! Postures by name.

use super::stderr;
use crate::{json, output, stdout};
use serde_json::Value;

fn modes_of(analysis: &Value) -> Vec<&str> {
    let mut modes: Vec<&str> =
        analysis["classes"].as_array().unwrap().iter().map(|class| class["mode"].as_str().unwrap()).collect();
    modes.dedup();
    modes
}

#[test]
fn a_posture_can_be_given_by_its_name() {
    for (robot, pose, by_name, signs) in [
        ("five-bar", "4,7", "left,right", "+-"),
        ("five-bar", "4,7", "-,left", "-+"),
        ("2-prr", "0,400", "ahead,behind", "+-"),
        ("delta", "0,0,-900", "left, right ,+", "+-+"),
        ("spherical-3-rrr", "0.1,-0.1,0.2", "right,left,left", "+--"),
    ] {
        let named =
            json_of(&["ik", robot, &format!("--pose={pose}"), &format!("--mode={by_name}"), "--json"]);
        let signed = json_of(&["ik", robot, &format!("--pose={pose}"), &format!("--mode={signs}"), "--json"]);
        assert_eq!(named["solutions"][0]["mode"], signs, "{robot}: {named}");
        assert_eq!(named, signed);
    }
    let plan = |mode| stdout(&format!("plan five-bar --from 4,7 --to 1,10 --mode {mode}"));
    assert_eq!(plan("left,right"), plan("+-"));
    // Lists of modes have commas too.
    let both = json("analyze five-bar --mode left,-,--,right,left --budget depth=4 --json");
    assert_eq!(modes_of(&both), ["+-", "--", "-+"]);
}

fn json_of(arguments: &[&str]) -> Value {
    let run = crate::aspecta("").args(arguments).output().unwrap();
    serde_json::from_slice(&run.stdout).unwrap_or_else(|e| panic!("{arguments:?}: {e}, {run:?}"))
}

#[test]
fn names_that_are_none_are_told_which_there_are() {
    for (arguments, known) in [
        (
            "ik five-bar --pose 4,7 --mode left,up",
            "`left,up` is not a working mode of `five-bar`; it has ++, +-, --, -+",
        ),
        ("ik five-bar --pose 4,7 --mode left", "or a name for each leg, with commas: + left, - right"),
        ("ik 2-prr --pose 4,7 --mode left,left", "with commas: + ahead, - behind"),
        ("ik spherical-3-rrr --pose 0,0,0 --mode left,up,left", "with commas: + right, - left"),
        ("analyze five-bar --mode ++,left", "`left` is not a working mode"),
    ] {
        let message = stderr(arguments);
        assert_eq!(output(arguments).status.code(), Some(2), "{message}");
        assert!(message.contains(known), "{message}");
    }
    // Struts have one posture, without a name.
    let struts = stderr("ik 3-rpr --pose 1,2,0 --mode left,left,left");
    assert!(struts.trim_end().ends_with("it has ---"), "{struts}");
}

/// `state` tells a mode by its signs and by the names of its postures, as `--mode` takes both.
#[test]
fn the_mode_of_a_state_has_a_name() {
    let state = stdout("state five-bar --pose 4,7 --mode +-");
    assert!(state.contains("\nworking mode  +- (left,right)\n"), "{state}");
    assert_eq!(stdout("state five-bar --pose 4,7 --mode left,right"), state);
    let struts = stdout("state 3-rpr --pose 5,10,0.3");
    assert!(struts.contains("\nworking mode  ---\n"), "{struts}");
}
