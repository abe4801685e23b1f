//! The report of whole analyses: complete, well-formed, self-contained, of a sane size and the same every time.

use aspecta::aspect::{Analysis, Options, analyze};
use aspecta::paving::{Budget, Control};
use aspecta::robot::{Leg, Platform, Robot};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

fn five_bar() -> Robot {
    let legs = vec![
        Leg::revolute([0.0, 0.0], [0.0, 0.0], 8.0, 5.0),
        Leg::revolute([9.0, 0.0], [0.0, 0.0], 5.0, 8.0),
    ];
    Robot::new("five-bar", Platform::PlanePoint, legs).unwrap()
}

fn three_rrr() -> Robot {
    let legs = vec![
        Leg::revolute([-10.0, -10.0], [0.0, 0.0], 10.0, 10.0),
        Leg::revolute([10.0, -10.0], [10.0, 0.0], 10.0, 10.0),
        Leg::revolute([0.0, 10.0], [10.0, 10.0], 10.0, 10.0),
    ];
    Robot::new("3-rrr", Platform::PlaneBody, legs).unwrap()
}

fn analysis(robot: &Robot, depth: u32) -> Analysis {
    let budget = Budget { depth: Some(depth), ..Budget::default() };
    let control = Control { cancelled: &AtomicBool::new(false), progress: &|_| {} };
    analyze(robot, &Options { budget }, &control).unwrap()
}

/// Where reports go: a directory to look at if `ASPECTA_FIGURES` names one, else a temporary one.
fn directory(name: &str) -> (PathBuf, tempfile::TempDir) {
    let temporary = tempfile::tempdir().unwrap();
    let dir = std::env::var("ASPECTA_FIGURES").map_or(temporary.path().to_owned(), PathBuf::from);
    (dir.join(name), temporary)
}

fn checked_report(analysis: &Analysis, dir: &Path, most_bytes: u64) -> String {
    let written = aspecta_cli::report::write(analysis, dir).unwrap();
    let total: u64 = written.iter().map(|p| fs::metadata(p).unwrap().len()).sum();
    assert!(total < 2 * most_bytes);
    for path in &written[1..] {
        let svg = fs::read_to_string(path).unwrap();
        let document = roxmltree::Document::parse(&svg).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        assert_eq!(document.root_element().tag_name().name(), "svg");
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{}", path.display());
    }
    let page = fs::read_to_string(&written[0]).unwrap();
    assert!((page.len() as u64) < most_bytes, "{} bytes", page.len());
    assert!(fs::read_dir(dir).unwrap().all(|e| !e.unwrap().file_name().to_string_lossy().ends_with(".part")));
    page
}

#[test]
fn the_five_bar() {
    let analysis = analysis(&five_bar(), 9);
    let (dir, _keep) = directory("five-bar");
    let page = checked_report(&analysis, &dir, 3_000_000);
    for id in ["robot", "modes", "counts", "maps", "earlier", "certified", "run"] {
        assert!(page.contains(&format!("<section id=\"{id}\">")), "{id}");
    }
}

#[test]
fn the_three_rrr() {
    let analysis = analysis(&three_rrr(), 5);
    let (dir, _keep) = directory("3-rrr");
    let page = checked_report(&analysis, &dir, 15_000_000);
    for id in ["robot", "modes", "counts", "space", "earlier", "certified", "run"] {
        assert!(page.contains(&format!("<section id=\"{id}\">")), "{id}");
    }
}
