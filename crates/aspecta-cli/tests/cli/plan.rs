//! `aspecta plan`, `assembly`, `modes` and `traverse`.

use crate::{aspecta, json, numbers, output, stdout};
use std::fs;

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn a_plan_is_a_path_that_the_check_accepts() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("path.csv");
    let arguments = "plan five-bar --from 4,7 --to 5,-7 --mode +- --budget depth=9";
    fs::write(&path, stdout(&format!("{arguments} --csv"))).unwrap();
    let check = output(&format!("check-path five-bar {} --mode +-", path.display()));
    assert_eq!(check.status.code(), Some(0), "{}", text(&check.stdout));
    let other = output(&format!("check-path five-bar {} --mode ++", path.display()));
    assert_eq!(other.status.code(), Some(2));
    assert!(
        text(&other.stderr).contains(":2: this line is in working mode +-, but --mode is ++"),
        "{}",
        text(&other.stderr)
    );
    let shown = stdout(arguments);
    assert!(shown.contains("singularity-free  yes, certified") && shown.contains("|/max"), "{shown}");
    let plan = json(&format!("{arguments} --json"));
    let ends = |k: usize| numbers(&plan["stretches"][0]["waypoints"][k]);
    assert_eq!(ends(0), [4.0, 7.0]);
    assert_eq!(plan["checks"][0]["singularity_free"], true);
}

#[test]
fn what_cannot_be_joined_is_proved() {
    let refused = output("assembly 3-rpr --q 14.98,15.38,12 --from 1 --to 3 --budget depth=5");
    assert_eq!(refused.status.code(), Some(1));
    assert!(text(&refused.stdout).contains("no such path exists, proved"), "{}", text(&refused.stdout));
    let refused = output("plan five-bar --from 4,7 --to 4,7 --mode ++ --to-mode -+ --budget depth=9 --json");
    assert_eq!(refused.status.code(), Some(1));
    let answer: serde_json::Value = serde_json::from_slice(&refused.stdout).unwrap();
    assert_eq!(answer["refusal"]["proved"], true, "{answer}");
    assert!(answer.get("stretches").is_none(), "{answer}");
}

#[test]
fn a_plan_goes_through_three_modes() {
    let shown = stdout("plan five-bar --from 4,7 --to 4,7 --mode ++ --to-mode -- --budget depth=9");
    assert!(shown.matches("through its serial singularity").count() >= 2, "{shown}");
    let plan = json("plan five-bar --from 4,7 --to 4,7 --mode ++ --to-mode -- --budget depth=9 --json");
    assert!(plan["stretches"].as_array().unwrap().len() >= 3, "{plan}");
    let once = stdout("plan five-bar --from 4,7 --to 4,7 --mode ++ --to-mode +- --budget depth=9");
    assert!(once.contains("serial ones only at 1 change of posture: certified"), "{once}");
}

/// The table of a motion: its header, and rows that belong together.
#[test]
fn a_plan_is_written_as_a_motion() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("motion.csv");
    let arguments = "plan five-bar --from 4,7 --to 4,7 --mode ++ --to-mode -- --budget depth=9 --speed 2 --acceleration 8 --trajectory";
    let shown = aspecta(arguments).arg(&path).output().unwrap();
    assert!(text(&shown.stdout).contains("total time: "), "{}", text(&shown.stderr));
    let motion = fs::read_to_string(&path).unwrap();
    assert!(motion.starts_with("time,x,y,q1,q2,v1,v2,a1,a2,mode\n0.0,4.0,7.0,"), "{motion}");
    let alone = output("plan five-bar --from 4,7 --to 4,7 --mode ++ --trajectory motion.csv");
    assert_eq!(alone.status.code(), Some(2));
}

#[test]
fn assembly_modes_are_listed_by_aspect() {
    let shown = stdout("assembly 3-rpr --q 14.98,15.38,12 --budget depth=6");
    assert!(shown.contains("6 direct solutions") && shown.contains("proved to be all"), "{shown}");
    assert_eq!(shown.matches("lie in one aspect: they can be changed").count(), 2, "{shown}");
    let shown = stdout("assembly 3-rpr --q 14.98,15.38,12 --from 2 --to 3 --explain --budget depth=6");
    assert!(shown.contains("round the cusp at") && shown.contains("vanish"), "{shown}");
}

#[test]
fn the_graph_of_modes_is_printed_and_drawn() {
    let directory = tempfile::tempdir().unwrap();
    let shown = aspecta("modes five-bar --budget depth=9 --out").arg(directory.path()).output().unwrap();
    let shown = text(&shown.stdout);
    assert!(shown.contains("five-bar: 10 aspects, 12 crossings found"), "{shown}");
    let drawn = fs::read_to_string(directory.path().join("modes.svg")).unwrap();
    roxmltree::Document::parse(&drawn).unwrap();
    assert_eq!(drawn.matches("<circle").count(), 10);
    let graph = json("modes five-bar --budget depth=9 --json");
    assert_eq!(graph["groups"].as_array().unwrap().len(), 2);
}

/// Boxes that are too coarse do not say how many aspects there are, nor that a class has none.
#[test]
fn coarse_modes_say_what_they_leave_open() {
    let shown = stdout("modes five-bar --budget depth=3");
    assert!(shown.starts_with("five-bar: at least 2 aspects (finer boxes"), "{shown}");
    assert!(shown.contains("no aspect was seen, and none is excluded, in ++ det A -, "), "{shown}");
    let graph = json("modes five-bar --budget depth=3 --json");
    assert!(graph["count"]["high"].is_null() && graph["count"]["low"] == 2, "{graph}");
    assert_eq!(graph["unseen"].as_array().unwrap().len(), 6);
    assert_eq!(json("modes five-bar --budget depth=9 --json")["unseen"], serde_json::json!([]));
}

#[test]
fn sets_of_poses_are_traversed() {
    let shown = stdout("traverse five-bar --box 2:6,8:10 --budget depth=9");
    assert_eq!(shown.matches("yes, certified: aspect").count(), 4, "{shown}");
    let directory = tempfile::tempdir().unwrap();
    let poses = directory.path().join("poses.csv");
    fs::write(&poses, "x,y\n4,7\n5,-7\n").unwrap();
    let shown =
        stdout(&format!("traverse five-bar --poses {} --through-modes --budget depth=9", poses.display()));
    assert!(shown.contains("every pose can be reached within aspects"), "{shown}");
    let refused = output(&format!("traverse five-bar --path {} --budget depth=9", poses.display()));
    assert_eq!(refused.status.code(), Some(1), "{}", text(&refused.stdout));
    let map = directory.path().join("five-bar.aspecta");
    stdout(&format!("domains five-bar --cells 60 --budget depth=9 --save {}", map.display()));
    let shown = stdout(&format!("traverse five-bar --box 2:6,8:10 --budget depth=9 --map {}", map.display()));
    assert!(shown.contains("uniqueness domain 1 of aspect"), "{shown}");
}

/// Poses of Dietmaier's platform at his strut lengths: two with det A < 0, one with det A > 0.
const LOW: &str = "0.99537,-0.05120,0.08138,-2.12556,-0.03022,2.80757";
const LOWER: &str = "0.80327,-0.29601,0.51686,-2.29563,-0.15448,1.21144";
const HIGH: &str = "0.66753,0.73832,-0.09638,-2.55057,-0.33924,-1.86632";

#[test]
fn free_bodies_are_planned_over_a_roadmap() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("path.csv");
    let arguments = format!("plan gough-stewart --from {LOW} --to {LOWER} --mode ------");
    fs::write(&path, stdout(&format!("{arguments} --csv"))).unwrap();
    let check = output(&format!("check-path gough-stewart {} --mode ------", path.display()));
    assert_eq!(check.status.code(), Some(0), "{}", text(&check.stdout));
    let motion = directory.path().join("motion.csv");
    let moving = format!(
        "{arguments} --json --trajectory {} --speed 1 --acceleration 4 --out {}",
        motion.display(),
        directory.path().display()
    );
    let plan = json(&moving);
    assert_eq!(plan["checks"][0]["singularity_free"], true, "{plan}");
    assert_eq!(numbers(&plan["stretches"][0]["waypoints"][0])[0], 0.99537);
    assert!(fs::read_to_string(&motion).unwrap().starts_with("time,x,y,z,roll,pitch,yaw,q1,"));
    assert!(fs::read_to_string(directory.path().join("motion.html")).unwrap().contains("<svg"));
}

#[test]
fn the_assembly_modes_of_a_free_body_are_joined() {
    let q = "1,0.645275,1.086284,1.503439,1.281933,0.771071";
    let found = json(&format!("assembly gough-stewart --q {q} --json"));
    assert_eq!(found["solutions"].as_array().unwrap().len(), 40, "{found}");
    for class in found["classes"].as_array().unwrap() {
        assert_eq!(class["joined"].as_array().unwrap().len(), 1, "{class}");
        let pair = [0, 1].map(|k| class["joined"][0][k].as_u64().unwrap());
        let change =
            json(&format!("assembly gough-stewart --q {q} --from {} --to {} --json", pair[0], pair[1]));
        assert_eq!(change["checks"][0]["singularity_free"], true, "{change}");
    }
}

#[test]
fn what_a_roadmap_does_not_join_is_proved_apart_or_undecided() {
    let refused = output(&format!("plan gough-stewart --from {LOW} --to {HIGH} --mode ------ --json"));
    assert_eq!(refused.status.code(), Some(1));
    let answer: serde_json::Value = serde_json::from_slice(&refused.stdout).unwrap();
    assert_eq!(answer["refusal"]["proved"], true, "{answer}");
    let arguments = format!("plan gough-stewart --from {LOW} --to {LOWER} --mode ------ --budget 0.000001s");
    let refused = output(&arguments);
    assert_eq!(refused.status.code(), Some(1));
    let told = text(&refused.stdout);
    assert!(told.contains("undecided: could not be joined within the budget (0 samples"), "{told}");
}

#[test]
fn the_poses_of_a_free_body_are_explored() {
    let shown = stdout("explore gough-stewart --samples 256");
    assert!(shown.contains("gough-stewart: at least 2 generalized aspects, certified"), "{shown}");
    assert!(shown.contains("bounds the number of aspects neither way (numerical)"), "{shown}");
    let found = json("explore hexa --mode ++++++ --samples 64 --json");
    assert_eq!(found["at_least"], 2, "{found}");
    assert_eq!(numbers(&found["classes"][0]["components"][0]["representative"]).len(), 6, "{found}");
}

#[test]
fn mistakes_are_named() {
    for (arguments, complaint) in [
        ("plan five-bar --from 4,7 --to 5 --mode +-", "has 2 pose coordinates (x, y), not 1"),
        ("plan five-bar --from 4,7 --to 5,a --mode +-", "`a`, is not a number"),
        ("plan five-bar --from 4,7 --to 5,6 --mode +", "`+` is not a working mode of `five-bar`"),
        ("plan five-bar --from 4,7 --to 5,6 --mode +- --avoid 2", "--avoid: `2` is not a number from 0 to 1"),
        ("plan five-bar --from 4,7 --to 5,6 --mode +- --weight -1", "--weight"),
        (
            "plan hexa --from 0,0,-600,0,0,0 --to 0,0,-600,0,0,0 --mode ------ --to-mode +-----",
            "changes of working mode are not planned",
        ),
        ("plan hexa --from 0,0,-600,0,0 --to 0,0,-600,0,0,0 --mode ------", "has 6 pose coordinates"),
        (
            "plan hexa --from 0,0,-600,0,0,0 --to 0,0,-600,0,0,0 --mode ------ --budget depth=5",
            "give a time, such as 30s",
        ),
        ("plan five-bar --from 4,7 --to 5,6 --mode +- --samples 10", "is no free body"),
        ("explore five-bar", "roadmaps are for `free-body`"),
        ("explore hexa --mode +", "`+` is not a working mode of `hexa`"),
        ("explore hexa --budget 2e6boxes", "give a time, such as 30s"),
        ("assembly 3-rpr --q 14.98,15.38,12 --from 1 --to 9", "has 6 direct solutions"),
        ("assembly 3-rpr --q 14.98,15.38 ", "has 3 joint coordinates"),
        ("traverse five-bar --box 2:6,8:10 --through-modes", "give them with --poses"),
        (
            "plan five-bar --from 4,7 --to 1,10 --mode +- --trajectory m.csv --speed -1 --acceleration 2",
            "speed limit of joint 1 is -1",
        ),
        ("traverse five-bar --box 6:2,8:10", "range 1 ends before it begins"),
        ("traverse five-bar --box 2:6", "has 2 pose coordinates"),
        ("traverse five-bar --box 2:6,8:10 --map five-bar", "give a file written by"),
    ] {
        let output = output(arguments);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments}: {message}");
        assert!(message.contains(complaint), "{arguments}: {message}");
    }
}

/// A directory for what is not written is not made.
#[test]
fn a_refusal_leaves_no_directory() {
    let directory = tempfile::tempdir().unwrap();
    let out = directory.path().join("a/b");
    let plan = |to: &str| {
        let arguments = format!("plan five-bar --from 4,7 --to {to} --mode ++ --out {}", out.display());
        output(&arguments).status.code()
    };
    assert_eq!(plan("4,-7"), Some(1));
    assert_eq!(std::fs::read_dir(directory.path()).unwrap().count(), 0);
    assert_eq!(plan("4.1,7"), Some(0));
    assert!(out.join("motion.html").is_file());
}

/// Names in a legend end within the picture, as wide as letters of their size are on average.
#[test]
fn no_legend_of_a_motion_is_cut() {
    let directory = tempfile::tempdir().unwrap();
    let ends = "--from 9,4 --to 12,4 --mode +-";
    stdout(&format!("plan ../../examples/five-bar-cell.toml {ends} --out {}", directory.path().display()));
    let page = fs::read_to_string(directory.path().join("motion.html")).unwrap();
    let number = |element: &str, key: &str| -> f64 {
        let (_, from) = element.split_once(&format!(" {key}=\"")).unwrap();
        from.split('"').next().unwrap().parse().unwrap()
    };
    let mut seen = Vec::new();
    for svg in page.split("<svg ").skip(1) {
        let width = number(&format!(" {svg}"), "width");
        for element in svg.split("<text").skip(1).filter(|element| element.contains("text-anchor=\"start\""))
        {
            let (start, rest) = element.split_once('>').unwrap();
            let name = rest.split('<').next().unwrap();
            let end = number(start, "x") + 0.5 * number(start, "font-size") * name.chars().count() as f64;
            assert!(end <= width, "`{name}` ends at {end} of {width}");
            seen.push(name.to_owned());
        }
    }
    assert!(["others", "det B = 0", "contact"].iter().all(|name| seen.iter().any(|s| s == name)), "{seen:?}");
}
