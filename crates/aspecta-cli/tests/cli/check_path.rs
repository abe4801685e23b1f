//! `aspecta check-path`: Table 4 and its opposite.

use crate::{TABLE_4, aspecta, file, numbers, stdout};
use serde_json::Value;
use std::fs;

fn check(robot: &str, content: &str, mode: &str) -> (Value, Option<i32>) {
    let (_directory, path) = file(content);
    let output =
        aspecta(&format!("check-path {robot}")).arg(&path).args(["--mode", mode, "--json"]).output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout);
    let complaint = String::from_utf8_lossy(&output.stderr);
    let document = serde_json::from_str(&text).unwrap_or_else(|e| panic!("{e}: {text}{complaint}"));
    (document, output.status.code())
}

/// Table 4: an assembly-mode change with no singularity in mode +++.
#[test]
fn table_4_is_free_of_singularities() {
    let (document, code) = check("3-rrr", TABLE_4, "+++");
    assert_eq!((&document["singularity_free"], code), (&Value::from(true), Some(0)));
    let least = &document["clearance"]["det_a"];
    let number = |name: &str| least[name].as_f64().unwrap();
    assert!(
        6842.0 < number("at_least") && number("at_least") <= number("at_most") && number("at_most") < 6843.0
    );
    assert_eq!((numbers(&least["pose"]).len(), &least["segment"]), (3, &Value::from(2)));
    assert!((number("t") - 0.39).abs() < 0.01, "{least}");
    assert_eq!(document["clearance"]["serial"].as_array().unwrap().len(), 3);
}

/// Table 4's ends have the same joint vector, and figure 11's curves reach 1 somewhere.
#[test]
fn table_4_ends_meet_and_figure_11_is_normalised() {
    let (document, _) = check("3-rrr", TABLE_4, "+++");
    let ends: Vec<_> = document["ends"].as_array().unwrap().iter().map(numbers).collect();
    for (a, b) in ends[0].iter().zip(&ends[1]) {
        assert!((a - b).abs().to_degrees() < 0.02, "{ends:?}");
    }
    let (_directory, path) = file(TABLE_4);
    let output = aspecta("check-path 3-rrr --mode +++ --csv").arg(&path).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    let mut lines = text.lines();
    assert_eq!(
        lines.next(),
        Some("segment,t,x,y,phi,q1,q2,q3,relative_det_a,relative_b_11,relative_b_22,relative_b_33,mode")
    );
    let rows: Vec<Vec<f64>> =
        lines.map(|l| l.split(',').take(12).map(|x| x.parse().unwrap()).collect()).collect();
    for column in 8..12 {
        // Mode +++: B_jj > 0; det A keeps its sign.
        let values: Vec<f64> = rows.iter().map(|r| r[column].abs()).collect();
        let signs = rows.iter().map(|r| r[column].signum()).sum::<f64>().abs();
        assert_eq!(signs, rows.len() as f64);
        assert!((values.iter().copied().fold(0.0, f64::max) - 1.0).abs() < 1e-12);
    }
}

#[test]
fn people_read_the_verdict() {
    let (_directory, path) = file(TABLE_4);
    let output = aspecta("check-path 3-rrr --mode +++").arg(&path).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("singularity-free  yes, certified") && text.contains("min |det A|"), "{text}");
}

/// JSON names what fails and counts legs and limits from 1, as the text does.
#[test]
fn a_joint_limit_is_named() {
    let beyond = "x,y,phi\n5,12,1\n5,40,1\n";
    let (document, code) = check("3-rpr", beyond, "---");
    assert_eq!(code, Some(1));
    let wanted = serde_json::json!({ "kind": "limit", "leg": 2, "limit": 1 });
    assert_eq!(document["obstacle"]["constraint"], wanted);
    let (_directory, path) = file(beyond);
    let text = aspecta("check-path 3-rpr --mode ---").arg(&path).output().unwrap().stdout;
    assert!(String::from_utf8(text).unwrap().contains("beyond the actuator limit of leg 2"));
}

/// The way back in mode ++- is refused, and where it first fails is said.
#[test]
fn table_4_reversed_in_another_mode_is_refused() {
    let lines: Vec<_> = TABLE_4.lines().skip(1).collect();
    let reversed = format!("{}\n{}\n{}\n", lines[2], lines[1], lines[0]);
    let (document, code) = check("3-rrr", &reversed, "++-");
    assert_eq!((&document["singularity_free"], code), (&Value::from(false), Some(1)));
    let obstacle = &document["obstacle"];
    assert_eq!(
        (&obstacle["constraint"]["kind"], &obstacle["segment"]),
        (&Value::from("det A"), &Value::from(1))
    );
    let t = numbers(&obstacle["t"]);
    assert!((t[0] - 0.9285).abs() < 1e-4 && t[1] - t[0] < 1e-9, "{obstacle}");
    // Just before it det A is nearly nought; just after it has the other sign.
    let pose = numbers(&obstacle["pose"]);
    let det = |x: f64| {
        let text = stdout(&format!(
            "ik 3-rrr --pose {},{},{} --json",
            pose[0] + x,
            pose[1],
            pose[2] - x * 0.1043834
        ));
        let found: Value = serde_json::from_str(&text).unwrap();
        let all = found["solutions"].as_array().unwrap().clone();
        all.iter().find(|s| s["mode"] == "++-").unwrap()["det_a"].as_f64().unwrap()
    };
    assert!(det(1e-3) * det(-1e-3) < 0.0);
}

/// What is printed of a path of poses is a path of joint vectors, and back it leads to the same.
#[test]
fn joint_vectors_are_checked_too() {
    let (directory, path) = file(TABLE_4);
    let joints = directory.path().join("joints.csv");
    let csv = aspecta("check-path 3-rrr --mode +++ --csv").arg(&path).output().unwrap().stdout;
    fs::write(&joints, csv).unwrap();
    let run = |more: &str| {
        let output = aspecta(&format!("check-path 3-rrr --json {more}")).arg(&joints).output().unwrap();
        (output.status.code(), output.stdout, String::from_utf8_lossy(&output.stderr).into_owned())
    };
    for joined in ["straight", "spline"] {
        let (code, text, complaint) = run(&format!("--start=-15.468,0.781,0.073 --joined {joined}"));
        assert_eq!(code, Some(0), "{complaint}");
        let document: Value = serde_json::from_slice(&text).unwrap();
        let end = numbers(&document["end_poses"][1]);
        assert!((end[0] + 9.902).abs() < 1e-9 && (end[2] - 1.081).abs() < 1e-9, "{end:?}");
        let least = document["clearance"]["det_a"]["at_least"].as_f64().unwrap();
        assert!((least / 6842.26 - 1.0).abs() < 1e-4, "{least}");
    }
    let (code, _, complaint) = run("--joints");
    assert!(
        code == Some(2) && complaint.contains("mode +++, pose -15.468000,0.781000,0.073000"),
        "{complaint}"
    );
    assert!(complaint.contains("--start"), "{complaint}");
    let (code, _, complaint) = run("--joints --joined none");
    assert!(code == Some(2) && complaint.contains("--joined none"), "{complaint}");
}

/// A spline through the same samples swings further out; samples alone claim nothing of what lies between.
#[test]
fn what_joins_the_samples_is_said() {
    let (_directory, path) = file(TABLE_4);
    let run = |more: &str| {
        let output = aspecta(&format!("check-path 3-rrr --mode +++ {more}")).arg(&path).output().unwrap();
        String::from_utf8(output.stdout).unwrap()
    };
    let spline: Value = serde_json::from_str(&run("--joined spline --json")).unwrap();
    let least = spline["clearance"]["det_a"]["at_most"].as_f64().unwrap();
    assert!(spline["singularity_free"] == true && least < 5000.0, "{least}");
    assert!(run("--joined none").contains("nothing is claimed of what lies between"));
}

/// `--avoid`: margins that the path keeps, and margins that it does not.
#[test]
fn margins_are_kept_all_along_or_not() {
    let (_directory, path) = file(TABLE_4);
    let run = |avoid: &str| {
        let mut command = aspecta("check-path 3-rrr --mode +++ --avoid");
        let output = command.arg(avoid).arg(&path).output().unwrap();
        let text = [output.stdout, output.stderr].concat();
        (output.status.code(), String::from_utf8(text).unwrap())
    };
    let (code, text) = run("0.037,0.28");
    assert!(code == Some(0) && text.contains("keeps away        yes, certified all along"), "{text}");
    for (avoid, what) in
        [("0.038,0.28", "|det Â| falls below its margin"), ("0.037,0.29", "|B₁₁|/max falls below")]
    {
        let (code, text) = run(avoid);
        assert!(code == Some(1) && text.contains(what), "{text}");
        assert!(text.contains("singularity-free  yes"), "{text}");
    }
    for bad in ["x", "0.1,0.2,0.3", "-1", "0.1,2"] {
        let (code, text) = run(bad);
        assert_eq!(code, Some(2), "{bad}: {text}");
    }
}

/// The sign of det A at both ends tells that it vanishes between them.
#[test]
fn a_change_of_sign_of_det_a_is_not_free() {
    // Mode +-: det A = 24.2 at (4, 7) and −87.0 at (3, 5).
    let (document, code) = check("five-bar", "4,7\n3,5\n", "+-");
    assert_eq!((&document["singularity_free"], code), (&Value::from(false), Some(1)));
}

#[test]
fn bad_paths() {
    for (content, complaint) in [
        ("4,7\n", "at least two"),
        ("-20,0\n4,7\n", "starts out of reach: leg 1"),
        ("4,7\n4,x\n", "path.csv:2: column 2, y: `x` is not a number"),
        ("1,2,3\n4,5,6\n", "path.csv:1: 3 fields; `x,y` wanted"),
    ] {
        let (_directory, path) = file(content);
        let output = aspecta("check-path five-bar --mode ++").arg(&path).output().unwrap();
        let messages = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{messages}");
        assert!(messages.contains(complaint), "{messages}");
    }
}

/// The figure `--out` writes, and the JSON beside it.
fn figure_11(robot: &str, content: &str, mode: &str) -> (String, Value) {
    let (directory, path) = file(content);
    let out = directory.path().join("new/figures");
    let mut command = aspecta(&format!("check-path {robot}"));
    let output = command.arg(&path).args(["--mode", mode, "--json", "--out"]).arg(&out).output().unwrap();
    let mut names: Vec<_> = fs::read_dir(&out).unwrap().map(|e| e.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, ["figure11.svg", "motion.html"], "no draft is left");
    let messages = String::from_utf8_lossy(&output.stderr);
    assert!(messages.contains("figure11.svg") && messages.contains("motion.html"), "{messages}");
    (fs::read_to_string(out.join("figure11.svg")).unwrap(), serde_json::from_slice(&output.stdout).unwrap())
}

/// The points of all paths below the elements of a class, one list an element.
fn drawn(svg: &str, class: &str) -> Vec<Vec<[f64; 2]>> {
    let document = roxmltree::Document::parse(svg).unwrap_or_else(|e| panic!("{e}: {svg}"));
    let point = |p: &str| {
        let (x, y) = p.split_once(' ').unwrap();
        [x.parse().unwrap(), y.parse().unwrap()]
    };
    let points = |d: &str| d.split(['M', 'L']).filter(|p| !p.is_empty()).map(point).collect::<Vec<_>>();
    let groups = document.descendants().filter(|n| n.attribute("class") == Some(class));
    groups.map(|g| g.descendants().filter_map(|n| n.attribute("d")).flat_map(points).collect()).collect()
}

/// Heights of each curve above the zero line, in pixels.
fn heights(svg: &str) -> Vec<Vec<f64>> {
    let zero = drawn(svg, "zero")[0][0][1];
    drawn(svg, "curve").iter().map(|c| c.iter().map(|p| zero - p[1]).collect()).collect()
}

#[test]
fn figure_11_of_table_4_has_four_curves_and_none_meets_zero() {
    let (svg, document) = figure_11("3-rrr", TABLE_4, "+++");
    let curves = heights(&svg);
    assert_eq!(curves.len(), 4, "det A and three B_jj");
    let profile = document["profile"].as_array().unwrap();
    for (k, curve) in curves.iter().enumerate() {
        let largest = curve.iter().copied().fold(0.0, f64::max);
        assert!(curve.iter().all(|&y| y > 0.05 * largest), "curve {k} meets zero");
        assert_eq!(curve.len(), profile.len());
        for (y, p) in curve.iter().zip(profile) {
            let value =
                if k == 0 { p["relative_det_a"].as_f64().unwrap() } else { numbers(&p["relative_b"])[k - 1] };
            assert!((y - value * largest).abs() < 0.03, "curve {k}: {y} px for {value}");
        }
    }
    for label in ["Point 1", "Point 2", "Point 3", "det A", "B₁₁", "B₃₃"] {
        assert!(svg.contains(&format!(">{label}</text>")), "{label}");
    }
    assert!(!svg.contains("obstacle"));
}

/// At (4, 12) leg 2, based at (9, 0), is stretched to 13 = √(5² + 12²): t = 5/7 of the way from (4, 7) to (4, 14).
#[test]
fn figure_11_shows_where_a_leg_ends() {
    let (svg, _) = figure_11("five-bar", "4,7\n4,14\n", "++");
    assert!(svg.contains(">leg 2 is stretched or folded (serial singularity)</text>"));
    let zero = &drawn(&svg, "zero")[0];
    let expected = zero[0][0] + 5.0 / 7.0 * (zero[1][0] - zero[0][0]);
    let document = roxmltree::Document::parse(&svg).unwrap();
    let band = document.descendants().find(|n| n.attribute("class") == Some("obstacle")).unwrap();
    let number = |name| band.first_element_child().unwrap().attribute(name).unwrap().parse::<f64>().unwrap();
    assert!((number("x") + number("width") / 2.0 - expected).abs() < 0.02, "{svg}");
    assert!(number("width") < 4.0);
    // Out of reach there is nothing to draw.
    let curves = drawn(&svg, "curve");
    assert_eq!(curves.len(), 3);
    assert!(curves.iter().flatten().all(|p| p[0] <= expected));
}

/// What the test of Table 4 looks for is seen where it is: det A crosses zero, the B_jj do not.
#[test]
fn figure_11_shows_a_change_of_sign() {
    let (svg, _) = figure_11("five-bar", "4,7\n3,5\n4,6\n", "+-");
    let crosses = |c: &Vec<f64>| c.iter().any(|&y| y > 0.0) && c.iter().any(|&y| y < 0.0);
    assert_eq!(heights(&svg).iter().map(crosses).collect::<Vec<_>>(), [true, false, false]);
    assert!(svg.contains(">det A vanishes or changes sign (parallel singularity)</text>"));
    assert!(svg.contains("up to point 2 of 3"));
}

#[test]
fn a_figure_that_cannot_be_written_is_bad_input() {
    let (_directory, path) = file(TABLE_4);
    let mut command = aspecta("check-path 3-rrr --mode +++ --out");
    let output = command.args([&path, &path]).output().unwrap();
    let messages = String::from_utf8_lossy(&output.stderr);
    assert_eq!((output.status.code(), messages.contains("--out ")), (Some(2), true), "{messages}");
}
