//! What new users met, each with what is right.

mod asked;
mod beyond;
mod budgets;
mod degrees;
mod hexapods;
mod postures;

use crate::{aspecta, json, numbers, output, stdout};
use serde_json::Value;

/// A robot file of these cases.
fn case(name: &str) -> String {
    format!("{}/tests/cases/{name}.toml", env!("CARGO_MANIFEST_DIR"))
}

fn stderr(arguments: &str) -> String {
    String::from_utf8(output(arguments).stderr).unwrap()
}

fn degrees(value: &Value) -> Vec<f64> {
    numbers(value).iter().map(|q| q.to_degrees()).collect()
}

fn in_range(q: &[f64]) -> bool {
    q.iter().all(|q| (-20.0..=200.0).contains(q))
}

/// Both motors of `five-bar-with-stops` go from −20° to 200°.
#[test]
fn joint_values_are_those_of_the_joints_range() {
    let robot = case("five-bar-with-stops");
    let found = json(&format!("ik {robot} --pose -39.313,56.25 --json"));
    let solutions = found["solutions"].as_array().unwrap();
    assert_eq!(solutions.len(), 4);
    let turned = &solutions.iter().find(|s| s["mode"] == "-+").unwrap()["q"];
    assert!((degrees(turned)[1] - 182.176_207).abs() < 1e-6, "{turned}");
    assert!(solutions.iter().all(|s| s["within_limits"] != true || in_range(&degrees(&s["q"]))));
    // Asked for by another turn, it is told in its own.
    let state = json(&format!("state {robot} --pose -39.313,56.25 --q 1.0011417837,-3.1036190 --json"));
    assert!(in_range(&degrees(&state["states"][0]["q"])), "{state}");
    for aspect in json(&format!("analyze {robot} --budget depth=6 --json"))["classes"]
        .as_array()
        .unwrap()
        .iter()
        .flat_map(|class| class["aspects"].as_array().unwrap())
    {
        assert!(in_range(&degrees(&aspect["sample"]["q"])), "{aspect}");
        // Bounds are rounded outward.
        let inward = |q: f64| q - 1e-9 * (q - 90.0);
        let bounds = aspect["q_bounds"].as_array().unwrap().iter().flat_map(degrees).map(inward);
        assert!(in_range(&bounds.collect::<Vec<_>>()), "{aspect}");
    }
}

#[test]
fn a_path_within_limits_shows_values_within_limits() {
    let robot = case("five-bar-with-stops");
    let path = "x,y\n-39.313,56.25\n-45,40\n-52,24\n";
    let run = aspecta(&format!("check-path {robot} - --mode -+ --csv")).write_stdin(path).output().unwrap();
    let text = String::from_utf8(run.stdout).unwrap();
    let mut rows = csv::Reader::from_reader(text.as_bytes());
    let headers = rows.headers().unwrap().clone();
    let column = |name: &str| headers.iter().position(|h| h == name).unwrap();
    let (q1, q2) = (column("q1"), column("q2"));
    let all: Vec<[f64; 2]> = rows
        .records()
        .map(|row| row.unwrap())
        .map(|row| [q1, q2].map(|k| row[k].parse::<f64>().unwrap().to_degrees()))
        .collect();
    assert!(all.len() > 10 && all[0][1] > 180.0, "{text}");
    assert!(all.windows(2).all(|pair| (0..2).all(|k| (pair[0][k] - pair[1][k]).abs() < 30.0)), "{all:?}");
}

#[test]
fn angles_that_look_like_degrees_are_warned_of() {
    let robot = case("my-3rpr");
    for (arguments, way) in [
        (format!("plan {robot} --from 130,68,60 --to 140,70,30 --mode --- --budget depth=3"), "--deg"),
        ("fk five-bar --q 20,30".into(), "--deg"),
        ("ik 3-rrr --pose 0,0,30".into(), "--deg"),
        ("analyze 3-rrr --fix phi=30,x=0 --budget depth=3".into(), "phi=30deg"),
    ] {
        let text = stderr(&arguments);
        assert!(text.contains("warning: ") && text.contains("in radians") && text.contains(way), "{text}");
    }
    for quiet in [
        "fk five-bar --q 2,-3",
        "ik 3-rrr --pose 0,0,30 --deg",
        "analyze 3-rrr --fix phi=30deg,x=0 --budget depth=3",
    ] {
        assert!(!stderr(quiet).contains("warning"), "{quiet}");
    }
    // Lengths are no angles.
    assert!(!stderr("ik my-delta --pose 0,0,-900").contains("in radians"));
}

#[test]
fn degrees_in_a_rad_range_are_not_advised_to_be_left_out() {
    let text = std::fs::read_to_string(case("five-bar-with-stops")).unwrap();
    let run = aspecta("check -")
        .write_stdin(text.replace("deg = [-20, 200]", "rad = [-20, 200]"))
        .output()
        .unwrap();
    let message = String::from_utf8(run.stderr).unwrap();
    assert_eq!(run.status.code(), Some(2));
    assert!(message.contains("write { deg = [-20, 200] }") && !message.contains("leave it out"), "{message}");
}

#[test]
fn lengths_in_two_units_are_warned_of() {
    let text = std::fs::read_to_string(case("five-bar-with-stops")).unwrap();
    let check = |text: &str| {
        let run = aspecta("check -").write_stdin(text).output().unwrap();
        assert_eq!(run.status.code(), Some(0));
        String::from_utf8(run.stderr).unwrap()
    };
    assert_eq!(check(&text), "");
    let mixed = check(&text.replacen("crank = 90", "crank = 0.09", 1));
    assert!(mixed.contains("the crank of leg 1") && mixed.contains("in one unit"), "{mixed}");
    for robot in json("robots --json")["robots"].as_array().unwrap() {
        let shown = stdout(&format!("robots show {}", robot["name"].as_str().unwrap()));
        assert_eq!(check(&shown), "", "{}", robot["name"]);
    }
}

#[test]
fn decimals_do_not_hide_an_architecture_singularity() {
    let text = stderr(&format!("check {}", case("similar-hexagons-rounded")));
    assert!(text.contains("warning: det A nearly vanishes at every pose"), "{text}");
}

#[test]
fn a_point_has_no_attachments() {
    let run = output(&format!("check {}", case("plane-point-attachment")));
    let text = String::from_utf8(run.stderr).unwrap();
    assert_eq!(run.status.code(), Some(2));
    assert!(
        text.contains("legs[2].attachment = [1, 0]: all legs of a `plane-point` end in the point itself"),
        "{text}"
    );
}

#[test]
fn texts_of_files_do_not_move_the_terminal() {
    let unseen = |text: &str| text.chars().any(|c| c != '\n' && c.is_control());
    let text = stderr(&format!("check {}", case("esc_key")));
    assert!(text.contains("\\u{1b}[2J: unknown key") && !unseen(&text), "{text}");
    let run = aspecta("ik five-bar --file -").write_stdin("\u{1b}]0;x\u{7},y\n1,2\n").output().unwrap();
    assert!(!unseen(&String::from_utf8(run.stderr).unwrap()));
    // Names that look like others.
    let robot = std::fs::read_to_string(case("five-bar-with-stops")).unwrap();
    for name in ["dex\u{200b}tar", "dex\u{202e}tar"] {
        let run = aspecta("check -").write_stdin(robot.replace("dextar", name)).output().unwrap();
        let message = String::from_utf8(run.stderr).unwrap();
        assert_eq!(run.status.code(), Some(2), "{message}");
        assert!(message.contains("cannot be seen"), "{message}");
    }
}

#[test]
fn the_ranges_of_aspects_are_in_the_table() {
    let text = stdout(&format!("analyze {} --budget depth=8", case("leg-coaxial-limited")));
    let ranges = text.split_once("Ranges of each aspect").expect("a table of ranges").1;
    for name in ["x [m]", "y [m]", "q1 [rad]", "q2 [rad]"] {
        assert!(ranges.lines().nth(1).unwrap().contains(name), "{ranges}");
    }
    assert!(ranges.contains(" to "), "{ranges}");
}

/// Of its four modes two have det A = 0 everywhere.
#[test]
fn the_leg_of_a_quadruped_has_two_aspects() {
    let robot = case("leg-coaxial");
    let text = stdout(&format!("analyze {robot}"));
    assert!(text.contains("certified: exactly 2"), "{text}");
    for mode in ["++", "--"] {
        let said = format!("Mode {mode} (1 domain, area of 0.25");
        assert!(text.contains(&said) && text.contains("det A vanishes everywhere"), "{text}");
    }
    let found = &json(&format!("analyze {robot} --json"))["singular_modes"][0];
    let [inner, undecided] = ["measure", "undecided"].map(|key| found[key].as_f64().unwrap());
    let ring = std::f64::consts::PI * (0.3f64.powi(2) - 0.1f64.powi(2));
    assert!(inner < ring && ring < inner + undecided && undecided < 0.001, "{inner} {undecided}");
}

#[test]
fn the_analysis_ends_with_table_2_and_the_number() {
    let text = stdout("analyze five-bar");
    assert!(text.trim_end().ends_with("number of generalized aspects, certified: exactly 10"), "{text}");
}

#[test]
fn traverse_takes_a_mode_and_a_sign() {
    let all = json("traverse five-bar --box 3.9:4.1,6.9:7.1 --json");
    assert_eq!(all["classes"].as_array().unwrap().len(), 8);
    let one = json("traverse five-bar --box 3.9:4.1,6.9:7.1 --mode ++ --det + --json");
    let classes = one["classes"].as_array().unwrap();
    assert_eq!(classes.len(), 1);
    assert_eq!(
        (&classes[0]["mode"], &classes[0]["det_a"]),
        (&Value::from("++"), &all["classes"][0]["det_a"])
    );
}

#[test]
fn a_number_that_is_none_does_not_end_a_stream() {
    let run = aspecta("follow five-bar --inverse --mode ++ --csv")
        .write_stdin("4,7\nnan,7\n4.1,7\n")
        .output()
        .unwrap();
    let text = String::from_utf8(run.stdout).unwrap();
    assert_eq!(text.lines().count(), 4, "{text}");
    assert_eq!(run.status.code(), Some(1));
    // Nor do others mislead: what was refused is no line to go on from.
    let poses = "-15.468,0.781,0.073\n-15.468,0.781,nan\n-15.468,0.781,1e300\n-15.468,0.781,0.08\n";
    let run = aspecta("follow 3-rrr --inverse --mode +++ --unwrap").write_stdin(poses).output().unwrap();
    let (text, messages) = (String::from_utf8(run.stdout).unwrap(), String::from_utf8(run.stderr).unwrap());
    assert!(text.ends_with("4 lines: 2 certified, 2 refused\n") && messages.is_empty(), "{text}{messages}");
}

#[test]
fn state_tells_what_is_gained_and_lost() {
    // Both cranks of the five-bar at rest in a line with their rods: leg 1 stretched, |A1 C| = 13.
    let stretched = json("state five-bar --pose 13,0 --mode ++ --json");
    let lost = stretched["states"][0]["velocities"]["lost"].as_array().unwrap();
    assert_eq!(lost.len(), 1, "{stretched}");
    assert_eq!((&lost[0]["leg"], &lost[0]["posture"]), (&Value::from(1), &Value::from("stretched")));
    let twist = numbers(&lost[0]["twist"]);
    assert!((twist[0].abs() - 1.0).abs() < 1e-9 && twist[1].abs() < 1e-9, "{twist:?}");
    assert_eq!(stretched["states"][0]["velocities"]["rank_b"], 1);
    // t = −A⁻¹B q̇, against a difference of two configurations.
    let at = |x: f64| json(&format!("state five-bar --pose {x},7 --mode ++ --json"))["states"][0].clone();
    let (a, b) = (at(4.0), at(4.000_001));
    let (qa, qb) = (numbers(&a["q"]), numbers(&b["q"]));
    let rows: Vec<Vec<f64>> =
        a["velocities"]["twist_of_joints"].as_array().unwrap().iter().map(numbers).collect();
    let twist: Vec<f64> =
        rows.iter().map(|row| row[0] * (qb[0] - qa[0]) + row[1] * (qb[1] - qa[1])).collect();
    assert!((twist[0] - 1e-6).abs() < 1e-11 && twist[1].abs() < 1e-11, "{twist:?}");
    assert!(a["velocities"]["gained"].as_array().unwrap().is_empty());
}

/// `elbow = { deg = [5, 175] }` on the first leg: its elbow is to the right of the way from A to C, which is the sign −.
#[test]
fn signs_of_elbows_are_what_the_documentation_says() {
    let found = json(&format!("ik {} --pose 59,120 --json", case("five-bar-elbow")));
    let mut kept = 0;
    for solution in found["solutions"].as_array().unwrap() {
        let q = numbers(&solution["q"])[0];
        let left = 59.0 * 90.0 * q.sin() - 120.0 * 90.0 * q.cos() > 0.0;
        assert_eq!(left, solution["mode"].as_str().unwrap().starts_with('+'), "{solution}");
        assert!(!left || solution["within_limits"] == false, "{solution}");
        kept += usize::from(solution["within_limits"] == true);
    }
    assert!(kept > 0, "{found}");
}

/// Another robot under the name of one of the catalogue.
#[test]
fn verify_says_what_robot_the_proof_is_about() {
    let directory = tempfile::tempdir().unwrap();
    let (robot, proof) = (directory.path().join("mine.toml"), directory.path().join("proof.json"));
    let text = stdout("robots show five-bar");
    std::fs::write(&robot, format!("{text}\n[window]\nx = [2, 6]\n")).unwrap();
    let analysed = aspecta("analyze --mode ++ --certificate").arg(&proof).arg(&robot).output().unwrap();
    assert_eq!(analysed.status.code(), Some(0));
    let run = aspecta("verify").arg(&proof).output().unwrap();
    let text = String::from_utf8(run.stdout).unwrap();
    assert!(
        text.contains("leg 1: revolute, A (0.000000, 0.000000)") && text.contains("crank 8.000000"),
        "{text}"
    );
    assert!(text.contains("window: x 2.000000 to 6.000000"), "{text}");
    assert!(text.contains("this is not the `five-bar` of `aspecta robots`"), "{text}");
}

#[test]
fn verify_keeps_its_budget() {
    let directory = tempfile::tempdir().unwrap();
    let proof = directory.path().join("proof.json");
    assert!(aspecta("analyze five-bar --certificate").arg(&proof).output().unwrap().status.success());
    let run = aspecta("verify --budget 0.01s").arg(&proof).output().unwrap();
    let text = String::from_utf8(run.stderr).unwrap();
    assert_eq!(run.status.code(), Some(1), "{text}");
    assert!(text.contains("the --budget has run out: nothing is verified"), "{text}");
    for bad in ["depth=3", "soon", "1e300h"] {
        let run = aspecta("verify --budget").arg(bad).arg(&proof).output().unwrap();
        assert_eq!(run.status.code(), Some(2));
    }
}

/// Its grid has 2³¹ cells along an axis.
#[test]
fn a_map_that_would_fill_the_memory_is_refused() {
    let run = output(&format!(
        "locate {}/tests/cases/grid_count_2147483648.gz --pose 4,7",
        env!("CARGO_MANIFEST_DIR")
    ));
    let text = String::from_utf8(run.stderr).unwrap();
    assert_eq!(run.status.code(), Some(2), "{text}");
    assert!(text.contains("a grid of more than 134 million nodes"), "{text}");
}

/// Links are followed, and what is no regular file is written into.
#[cfg(unix)]
#[test]
fn outputs_replace_nothing_but_files() {
    let directory = tempfile::tempdir().unwrap();
    let [link, real] = ["link.json", "real.json"].map(|name| directory.path().join(name));
    std::fs::write(&real, "before").unwrap();
    std::os::unix::fs::symlink(&real, &link).unwrap();
    let write = |path: &std::path::Path| {
        let run =
            aspecta("analyze five-bar --mode ++ --budget depth=4 --certificate").arg(path).output().unwrap();
        assert!(run.status.code() < Some(2), "{}", String::from_utf8_lossy(&run.stderr));
    };
    write(&link);
    assert!(std::fs::symlink_metadata(&link).unwrap().is_symlink());
    assert!(std::fs::read_to_string(&real).unwrap().starts_with('{'));
    let lost = directory.path().join("lost.json");
    std::os::unix::fs::symlink(directory.path().join("nowhere"), &lost).unwrap();
    let run =
        aspecta("analyze five-bar --mode ++ --budget depth=4 --certificate").arg(&lost).output().unwrap();
    assert_eq!(run.status.code(), Some(2), "{}", String::from_utf8_lossy(&run.stderr));
    assert!(std::fs::symlink_metadata(&lost).unwrap().is_symlink());
    let device = std::path::Path::new("/dev/null");
    write(device);
    assert!(!std::fs::metadata(device).unwrap().is_file());
    // A link that lies in wait where a directory is probed.
    let victim = directory.path().join("victim");
    std::fs::write(&victim, "kept").unwrap();
    std::os::unix::fs::symlink(&victim, directory.path().join(".aspecta-writable")).unwrap();
    let run =
        aspecta("analyze five-bar --mode ++ --budget depth=4 --out").arg(directory.path()).output().unwrap();
    assert!(run.status.code() < Some(2));
    assert_eq!(std::fs::read_to_string(&victim).unwrap(), "kept");
    let left =
        std::fs::read_dir(directory.path()).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap());
    assert!(!left.into_iter().any(|name| name.ends_with(".part")));
}

/// Files that the README names are there, and its commands take them.
#[test]
fn examples_of_the_readme_run() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let readme = std::fs::read_to_string(root.join("README.md")).unwrap();
    let named: Vec<&str> = readme
        .split(|c: char| c.is_whitespace() || "`()".contains(c))
        .filter(|word| word.starts_with("examples/"))
        .collect();
    assert!(named.len() >= 6 && named.iter().all(|name| root.join(name).is_file()), "{named:?}");
    for command in [
        "check-path 3-rrr examples/3-rrr-path.csv --mode +++",
        "check-path 3-rrr examples/3-rrr-joints.csv --start -15.468,0.781,0.073",
        "time 3-rrr examples/3-rrr-path.csv --mode +++ --speed 2 --acceleration 10",
        "traverse five-bar --poses examples/five-bar-points.csv",
        "ik five-bar --file examples/five-bar-poses.csv",
        "follow delta --pose 0,0,-900 --file examples/delta-joints.csv",
        "plan examples/irb-360-guard.toml --from 0,0,-1080 --to 300,100,-1060 --mode ---",
        "check examples/five-bar-cell.toml",
        "check examples/3-rrr-plate.toml",
    ] {
        let run = aspecta(command).current_dir(&root).output().unwrap();
        assert_eq!(run.status.code(), Some(0), "{command}: {}", String::from_utf8_lossy(&run.stderr));
    }
}

/// A wrist that turns on past 180° in a file of angles up to 180°.
#[test]
fn a_stream_of_angles_can_be_unwrapped() {
    let poses = "roll,pitch,yaw\n10,-5,170\n10,-5,175\n10,-5,179\n10,-5,-179\n10,-5,-175\n";
    let modes = json("ik spherical-3-rrr --pose 10,-5,170 --deg --json");
    let mode = modes["solutions"][0]["mode"].as_str().unwrap().to_owned();
    let run = |option: &str| {
        let follow = format!("follow spherical-3-rrr --inverse --mode={mode} --deg {option}");
        let run = aspecta(&follow).write_stdin(poses).output().unwrap();
        (String::from_utf8(run.stdout).unwrap(), String::from_utf8(run.stderr).unwrap())
    };
    let (text, messages) = run("");
    assert!(
        messages.contains("line 5: yaw jumps by -358.0 degrees; to go on by 2.0 instead, give --unwrap"),
        "{messages}"
    );
    assert!(!text.contains("5 certified") || !text.contains("may have vanished"), "{text}");
    let (text, messages) = run("--unwrap");
    assert_eq!(messages, "");
    assert!(text.ends_with("5 lines: 5 certified, 0 refused\n"), "{text}");
    let (rows, _) = run("--unwrap --csv");
    let mut csv = csv::Reader::from_reader(rows.as_bytes());
    let all: Vec<Vec<f64>> = csv
        .records()
        .map(|row| (1..7).map(|k| row.as_ref().unwrap()[k].parse().unwrap()).collect())
        .collect();
    assert!(
        all.windows(2).all(|pair| pair[0].iter().zip(&pair[1]).all(|(a, b)| (a - b).abs() < 0.3)),
        "{rows}"
    );
}
