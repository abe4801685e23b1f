//! What is asked for: windows, margins, sets, budgets, plans.

use super::{case, stderr};
use crate::{aspecta, json, numbers, output, stdout};
use serde_json::Value;

/// `five-bar-window` is a five-bar for y from 40 to 130 only.
#[test]
fn a_window_means_the_same_in_all_commands() {
    let robot = case("five-bar-window");
    for (y, inside) in [(120, true), (130, true), (131, false)] {
        let found = json(&format!("ik {robot} --pose 59,{y} --mode +- --json"));
        assert_eq!(found["solutions"][0]["within_limits"], inside, "{found}");
        let q = numbers(&found["solutions"][0]["q"]);
        let q = q.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
        let found = json(&format!("fk {robot} --q={q} --mode=+- --json"));
        let is_here = |s: &&Value| (numbers(&s["pose"])[1] - f64::from(y)).abs() < 1e-6;
        let here = found["solutions"].as_array().unwrap().iter().find(is_here).unwrap();
        assert_eq!(here["within_limits"], inside, "{here}");
        let state = json(&format!("state {robot} --pose 59,{y} --q={q} --json"));
        assert_eq!(state["states"][0]["within_limits"], inside, "{state}");
        let path = format!("59,120\n59,{y}\n");
        let run =
            aspecta(&format!("check-path {robot} - --mode=+- --json")).write_stdin(path).output().unwrap();
        let check: Value = serde_json::from_slice(&run.stdout).unwrap();
        assert_eq!(
            (check["within_limits"].as_bool(), run.status.code()),
            (Some(inside), Some(i32::from(!inside)))
        );
        if !inside {
            assert_eq!(check["obstacle"]["constraint"]["kind"], "window", "{check}");
            assert_eq!(check["obstacle"]["constraint"]["coordinate"], "y", "{check}");
            let t = numbers(&check["obstacle"]["t"]);
            assert!(t[0] <= 10.0 / 11.0 && 10.0 / 11.0 <= t[1] && t[1] - t[0] < 1e-9, "{t:?}");
        }
        let line = format!("59,120\n59,{y}\n");
        let run = aspecta(&format!("follow {robot} --inverse --mode=+- --json"))
            .write_stdin(line)
            .output()
            .unwrap();
        let last: Value = serde_json::from_slice(run.stdout.split(|b| *b == b'\n').nth(1).unwrap()).unwrap();
        assert_eq!(last["within_limits"], inside, "{last}");
    }
    let far = output(&format!("plan {robot} --from 59,120 --to 59,131 --mode=+-"));
    assert_ne!(far.status.code(), Some(0));
}

/// |det Â| is at most 1, as `--avoid` says.
#[test]
fn the_distance_from_parallel_singularities_is_at_most_one() {
    for name in ["symmetric-6-6", "my-3rpr"] {
        let robot = case(name);
        let start = if name == "my-3rpr" { "130,68,0.5" } else { "0,0,1,0,0,0" };
        let found = json(&format!("ik {robot} --pose {start} --json"));
        let mode = found["solutions"][0]["mode"].as_str().unwrap().to_owned();
        let path = format!("{start}\n{start}\n");
        let run = aspecta(&format!("check-path {robot} - --json --mode={mode}"))
            .write_stdin(path)
            .output()
            .unwrap();
        let check: Value = serde_json::from_slice(&run.stdout).unwrap();
        let most = check["clearance"]["parallel"]["at_most"].as_f64().unwrap();
        assert!(0.0 < most && most <= 1.0, "{name}: {most}");
    }
}

/// How far two printers reach at z = 10 was computed independently: radii of 136.1 and 64.58.
#[test]
fn a_round_set_is_traversed_as_far_as_the_printer_reaches() {
    let holds = |name: &str, radius: f64| {
        let run =
            output(&format!("traverse {} --disc 0,0,10 --radius {radius} --mode +++ --det -", case(name)));
        let text = String::from_utf8(run.stdout).unwrap();
        (run.status.code(), text.contains("yes, certified"), text.contains("no, certified"))
    };
    for (name, within, beyond) in [("kossel-plus", 136.0, 136.2), ("short-arm-printer", 64.5, 64.7)] {
        assert_eq!(holds(name, within), (Some(0), true, false), "{name}");
        assert_eq!(holds(name, beyond), (Some(1), false, true), "{name}");
    }
    let printer = case("kossel-plus");
    let sound = output(&format!("traverse {printer} --cylinder 0,0,5:10 --radius 130 --mode +++ --det -"));
    assert_eq!(sound.status.code(), Some(0), "{}", String::from_utf8_lossy(&sound.stdout));
    let ball = output(&format!("traverse {printer} --ball 0,0,100 --radius 60 --mode +++ --det -"));
    assert_eq!(ball.status.code(), Some(0), "{}", String::from_utf8_lossy(&ball.stdout));
    for (arguments, why) in [
        ("--disc 0,0,10", "--radius"),
        ("--disc 0:1,0,10 --radius 3", "give one value of x"),
        ("--disc 0,0,10 --radius -3", "give a positive number"),
    ] {
        let run = output(&format!("traverse {printer} {arguments}"));
        let message = String::from_utf8(run.stderr).unwrap();
        assert!(run.status.code() == Some(2) && message.contains(why), "{arguments}: {message}");
    }
    let none = stderr("traverse five-bar --ball 4,7 --radius 1");
    assert!(none.contains("no coordinate z"), "{none}");
}

/// A straight line that can be driven is planned without looking for aspects.
#[test]
fn a_straight_way_is_planned_first() {
    let plan = json(&format!("plan {} --from 0,0,-800 --to 200,0,-800 --mode --- --json", case("my-delta")));
    assert!(plan["refusal"].is_null(), "{plan}");
}

#[test]
fn budgets_govern_what_follows_the_aspects() {
    // Bounds that have met end a run, however fine it might have been.
    let fine = json("analyze five-bar --mode ++ --budget depth=20 --json");
    assert_eq!(
        (fine["run"]["stop"].as_str(), fine["run"]["depth"].as_u64() <= Some(14)),
        (Some("exact"), true),
        "{}",
        fine["run"]
    );
    let cut = output("analyze five-bar --budget 1boxes");
    assert_eq!(cut.status.code(), Some(1));
    let few = output("cusps 3-rpr --boxes 1");
    assert_eq!(few.status.code(), Some(1));
    let told = stdout("analyze 3-rrr --fix x=-10,y=0 --deg");
    assert!(told.contains("phi [deg]") && !told.contains("phi [rad]"), "{told}");
}

/// One vector or many: the list of what is found is in the same place.
#[test]
fn json_of_one_vector_and_of_many_has_one_shape() {
    let one = json("fk five-bar --q=1,2 --json");
    let run = aspecta("fk five-bar --file - --json").write_stdin("1,2\n").output().unwrap();
    let many: Value = serde_json::from_slice(&run.stdout).unwrap();
    assert_eq!(one["results"][0]["solutions"], many["results"][0]["solutions"]);
    assert_eq!(one["results"][0]["solutions"], one["solutions"]);
    let run = output("ik five-bar --pose 99,0 --json");
    let out_of_reach: Value = serde_json::from_slice(&run.stdout).unwrap();
    assert_eq!(run.status.code(), Some(1));
    assert_eq!(out_of_reach["results"][0]["solutions"], serde_json::json!([]));
}

/// Both poses lie in one aspect, as `analyze` certifies; boxes a little finer than usual join them.
#[test]
fn a_plan_within_one_aspect_is_found() {
    let robot = format!("{}/../aspecta/tests/fixtures/folding_sphere.toml", env!("CARGO_MANIFEST_DIR"));
    let ends = "--from=-0.196042,1.273286,-2.469458 --to=0.930941,0.844879,2.979742";
    let text = stdout(&format!("plan {robot} {ends} --mode=-+-"));
    assert!(text.contains("singularity-free  yes, certified"), "{text}");
}

/// A motion with a trajectory is played in its seconds; what bounds the aspect is named, joint limits too.
#[test]
fn a_page_of_a_trajectory_plays_in_seconds() {
    let directory = tempfile::tempdir().unwrap();
    let (out, csv) = (directory.path().join("motion"), directory.path().join("motion.csv"));
    let plan = format!(
        "plan {} --from=-39.313,56.25 --to=-52,24 --mode=-+ --speed 1 --acceleration 5 --trajectory {} --out {}",
        case("five-bar-with-stops"),
        csv.display(),
        out.display()
    );
    stdout(&plan);
    let page = std::fs::read_to_string(out.join("motion.html")).unwrap();
    assert!(page.contains("joint limit"));
    let (_, now) = page.split_once("class=\"now\">").unwrap();
    let (now, _) = now.split_once("class=\"keys\"").unwrap();
    assert!(now.contains("</span> s<"), "{now}");
    let (_, data) = page.split_once("type=\"application/json\">").unwrap();
    let data: Value = serde_json::from_str(data.split_once("</script>").unwrap().0).unwrap();
    // A step of the clock is a fiftieth of a second.
    let clock = data["clock"].as_u64().unwrap() as usize;
    let steps: Vec<i64> = numbers(&data["tracks"][clock]).iter().map(|x| *x as i64).collect();
    assert!(steps[0] == 0 && steps[1..steps.len() - 1].iter().all(|step| *step == 20), "{steps:?}");
}

/// What is undecided is told in a few lines, however many boxes there are.
#[test]
fn undecided_boxes_of_cusps_are_told_together() {
    let run = output("cusps 3-rrr --fix q1=0.5 --boxes 3000");
    let text = String::from_utf8(run.stdout).unwrap();
    let lines = text.lines().filter(|line| line.starts_with("undecided")).count();
    assert!(run.status.code() == Some(1) && (1..40).contains(&lines), "{text}");
}
