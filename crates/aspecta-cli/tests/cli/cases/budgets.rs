//! What ends a run, and that it is said.

use crate::output;
use serde_json::Value;

/// Of several budgets the first that is used up ends the run, and is named.
#[test]
fn the_budget_that_ends_a_run_is_named() {
    for (budget, stop, words) in [
        ("1h,depth=3", "resolution", "resolution reached"),
        ("1h,500boxes", "boxes", "box budget spent"),
        ("500boxes,depth=20", "boxes", "box budget spent"),
        ("1e9boxes,res=5", "resolution", "resolution reached"),
        ("0.000001s", "time", "time budget of"),
        ("0.000001s,depth=20", "time", "time budget of"),
        ("1e9boxes,0.000001s", "time", "time budget of"),
    ] {
        let run = |json: &str| output(&format!("analyze 3-rrr --mode +++ --budget {budget} {json}"));
        let document: Value = serde_json::from_slice(&run("--json").stdout).unwrap();
        assert_eq!(document["run"]["stop"], stop, "{budget}");
        let text = String::from_utf8(run("").stdout).unwrap();
        // Lines are folded.
        let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(text.contains(words), "{budget}: {text}");
    }
    let met = output("analyze five-bar --mode ++ --budget 1h,depth=20 --json");
    let document: Value = serde_json::from_slice(&met.stdout).unwrap();
    assert_eq!((&document["run"]["stop"], met.status.code()), (&Value::from("exact"), Some(0)));
}

/// Whatever ends a run before an aspect is found makes the answer negative.
#[test]
fn a_run_that_finds_nothing_has_status_1() {
    for budget in ["0.000001s", "1boxes", "1boxes,1h", "0.000001s,depth=9"] {
        let run = output(&format!("analyze 3-rrr --mode +++ --budget {budget}"));
        assert_eq!(run.status.code(), Some(1), "{budget}");
    }
    let depth = output("analyze 3-rrr --mode +++ --budget depth=1");
    assert_eq!(depth.status.code(), Some(0), "as fine as was asked for");
}
