//! `aspecta analyze`: Tables 1 and 2.

use crate::{aspecta, json, numbers, stdout};
use serde_json::{Value, json};

/// Table 2 of the paper, by working mode (B_11, B_22) and sign of det A.
const TABLE_2: [(&str, &str, u64); 8] = [
    ("++", "+", 1),
    ("+-", "+", 1),
    ("--", "+", 1),
    ("-+", "+", 2),
    ("++", "-", 1),
    ("+-", "-", 2),
    ("--", "-", 1),
    ("-+", "-", 1),
];

#[test]
fn json_has_the_contract_and_table_2() {
    let result = json("analyze five-bar --json");
    assert_eq!((&result["format_version"], &result["robot"]["name"]), (&json!(1), &json!("five-bar")));
    assert_eq!(result["aspects"]["low"], 10);
    assert!(result["aspects"]["certified"].is_boolean());
    let classes = result["classes"].as_array().unwrap();
    assert_eq!(classes.len(), 8);
    for (mode, det_a, count) in TABLE_2 {
        let class = classes.iter().find(|c| c["mode"] == mode && c["det_a"] == det_a).unwrap();
        assert_eq!(class["low"], count, "{mode} {det_a}");
        let aspects = class["aspects"].as_array().unwrap();
        assert_eq!(aspects.len() as u64, count);
        let measure = class["measure"].as_f64().unwrap();
        assert!(measure > 0.0 && class["undecided"].as_f64().unwrap() < 0.03 * measure);
        for aspect in aspects {
            check_sample(aspect, mode, det_a);
        }
    }
    let modes: Vec<_> = result["modes"].as_array().unwrap().iter().map(|m| m["reachable"].clone()).collect();
    assert_eq!(modes, vec![json!("yes"); 4]);
}

/// The sample lies in the class: asked of another command.
fn check_sample(aspect: &Value, mode: &str, det_a: &str) {
    let list = |key: &str| {
        let values = numbers(&aspect["sample"][key]);
        values.iter().map(f64::to_string).collect::<Vec<_>>().join(",")
    };
    let state = json(&format!("state five-bar --pose {} --q {} --json", list("pose"), list("q")));
    let state = &state["states"][0];
    assert_eq!(state["mode"], mode);
    assert_eq!(state["det_a"].as_f64().unwrap() > 0.0, det_a == "+");
    assert!(state["residual"].as_f64().unwrap() < 1e-12);
}

#[test]
fn the_summary_has_both_tables_in_100_columns() {
    for robot in [
        "five-bar --budget depth=8",
        "3-rrr --budget depth=5",
        "spherical-3-rrr --budget depth=4",
        "3-rrr --budget depth=7 --fix phi=30deg",
        "3-prr --budget depth=5",
        "delta --budget 100000boxes",
    ] {
        let text = stdout(&format!("analyze {robot}"));
        for words in
            ["Theorem 1", "Table 1", "Table 2", "Mf1", "number of generalized aspects", "Def. 5", "Def. 6"]
        {
            assert!(text.contains(words), "{words} in\n{text}");
        }
        let widest = text.lines().map(|line| line.chars().count()).max();
        assert!(widest <= Some(100), "{widest:?} columns:\n{text}");
        assert!(!text.contains('\u{1b}'));
    }
}

/// `--fix`, in whatever way it is written, and what the summary and the JSON say of it.
#[test]
fn coordinates_are_held() {
    let text = stdout("analyze 3-rrr --budget depth=7 --fix phi=0");
    for words in [
        "slice phi = 0 rad (free: x, y; det A is that of the whole robot)",
        "(Def. 8), area in unit^2\n",
        "aspects of the slice, certified: at least",
    ] {
        assert!(text.contains(words), "{words} in\n{text}");
    }
    let cells = text.lines().find(|line| line.contains("finest cells")).unwrap();
    assert!(cells.matches('×').count() == 1 && !cells.contains("rad"), "{cells}");
    assert!(!stdout("analyze five-bar --budget depth=7").contains("slice"));

    let run = |fix: &str| {
        let mut result = json(&format!("analyze 3-rrr --budget depth=5 --json --fix {fix}"));
        result["run"]["seconds"].take();
        result
    };
    let result = run("phi=30deg,y=-5");
    let held =
        |name: &str, value: f64, unit: &str| json!({ "coordinate": name, "value": value, "unit": unit });
    assert_eq!(result["fixed"], json!([held("y", -5.0, "unit"), held("phi", 30f64.to_radians(), "rad")]));
    assert_eq!(result["measure"], json!({ "name": "length", "unit": "unit" }));
    assert_eq!(result, run("y=-5 --fix phi=30deg"));
    assert_eq!(result, run(&format!("y=-5.0,phi={}rad", 30f64.to_radians())));
    assert_eq!(run("phi=0.25")["fixed"], json!([held("phi", 0.25, "rad")]));
}

/// Same input, same output, whatever the threads; only the time taken differs.
#[test]
fn threads_do_not_change_the_result() {
    let run = |threads: usize| {
        let mut result = json(&format!("analyze five-bar --budget depth=8 --json --threads {threads}"));
        result["run"]["seconds"].take();
        result
    };
    assert_eq!(run(1), run(3));
}

#[test]
fn budgets_end_the_run() {
    let stop =
        |budget: &str| json(&format!("analyze five-bar --json --budget {budget}"))["run"]["stop"].clone();
    assert_eq!(stop("depth=6"), "resolution");
    assert_eq!(stop("res=0.5"), "resolution");
    assert_eq!(stop("1000boxes"), "boxes");
}

#[test]
fn out_writes_the_report() {
    let directory = tempfile::tempdir().unwrap();
    let out = directory.path().join("new").join("report");
    let output = aspecta("analyze five-bar --budget depth=7 --out").arg(&out).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(String::from_utf8_lossy(&output.stdout).contains("report.html"));
    assert!(out.join("report.html").metadata().unwrap().len() > 1000);
}

/// Where the bounds are apart, people are told where and why; as often as the JSON says, or how many more there are.
#[test]
fn doubts_are_listed() {
    let apart = "five-bar --budget depth=6";
    let (text, doubts) = (stdout(&format!("analyze {apart}")), json(&format!("analyze {apart} --json")));
    let doubts = doubts["doubts"].as_array().unwrap().clone();
    let (_, table) =
        text.split_once("No upper bound: a whole aspect could hide in undecided boxes\n").unwrap();
    let rows: Vec<&str> = table.lines().skip(1).take_while(|line| !line.is_empty()).collect();
    assert!(table.contains("about [unit]") && !text.contains("Bounds apart"), "{text}");
    assert_eq!(rows.len(), doubts.len());
    for doubt in doubts {
        let (mode, det_a) = (doubt["mode"].as_str().unwrap(), doubt["det_a"].as_str().unwrap());
        let row = rows.iter().find(|row| row.split_whitespace().take(2).eq([mode, det_a])).unwrap();
        let y = numbers(&doubt["place"][1]);
        let (_, shown) = row.split_once("y = ").unwrap();
        let shown: f64 = shown.split_whitespace().next().unwrap().parse().unwrap();
        assert!((shown - 0.5 * (y[0] + y[1])).abs() < 1e-3, "{row}");
        assert!(row.contains(doubt["undecided"][0].as_str().unwrap()), "{row}");
    }

    let text = stdout("analyze 3-rrr --budget 100000boxes");
    assert!(text.contains("  leg 1 folded, q1 = "), "{text}");
    assert!(text.contains(" more (--json lists all)"), "{text}");
}

#[test]
fn bounds_that_meet_leave_no_doubts() {
    let text = stdout("analyze five-bar");
    assert!(!text.contains("undecided there"), "{text}");
    let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains("the bounds meet, exactly 10 aspects. Table 2"), "{text}");
    assert!(words.ends_with("number of generalized aspects, certified: exactly 10"), "{text}");
}

/// Robots with six degrees of freedom: slices, all 64 working modes of the Hexa or those asked for, in 100 columns.
#[test]
fn slices_of_robots_with_six_degrees_of_freedom() {
    for (arguments, words) in [
        (
            "gough-stewart --fix roll=0,pitch=0,yaw=0 --budget depth=4",
            &["(free: x, y, z;", "volume in unit^3", "------", "Def. 5", "Def. 6"][..],
        ),
        (
            "gough-stewart --fix x=0.3,y=0.2,z=0.6 --budget depth=4",
            &["(free: roll, pitch, yaw;", "volume in rad^3"],
        ),
        ("hexa --fix z=-600,roll=0,pitch=0,yaw=0 --budget depth=5", &["Mf64", "area in mm^2", "left out"]),
        (
            "hexa --fix y=20,z=-600,roll=0,pitch=0.1,yaw=0 --mode ------ --mode ++++++,------",
            &["Mf43", "length in mm", "left out", "certified: exactly"],
        ),
    ] {
        let text = stdout(&format!("analyze {arguments}"));
        for words in words {
            assert!(text.contains(words), "{words} in\n{text}");
        }
        let widest = text.lines().map(|line| line.chars().count()).max();
        assert!(widest <= Some(100), "{widest:?} columns:\n{text}");
    }
    let fix = "--fix y=20,z=-600,roll=0,pitch=0.1,yaw=0 --budget depth=8 --json";
    let result = json(&format!("analyze hexa {fix} --mode -+-+-+,------"));
    let modes: Vec<_> = result["modes"].as_array().unwrap().iter().map(|mode| mode["mode"].clone()).collect();
    assert_eq!(modes, [json!("-+-+-+"), json!("------")]);
    assert_eq!(result["classes"].as_array().unwrap().len(), 4);
    for class in result["classes"].as_array().unwrap() {
        for aspect in class["aspects"].as_array().unwrap() {
            assert_eq!(numbers(&aspect["sample"]["pose"])[1..], [20.0, -600.0, 0.0, 0.1, 0.0]);
            assert_eq!(numbers(&aspect["sample"]["q"]).len(), 6);
        }
    }
    let all = json(&format!("analyze hexa {fix}"));
    assert_eq!(all["modes"].as_array().unwrap().len(), 64);
}
