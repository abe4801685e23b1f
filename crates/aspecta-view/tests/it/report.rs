//! The report of whole analyses: complete, well-formed, self-contained, of a sane size and the same every time.
//!
//! With `ASPECTA_FIGURES=DIR` the reports stay in DIR to look at.

use crate::common::{analysis, five_bar, slice, three_rrr};
use aspecta::aspect::{Analysis, Cell, ClassId, Place};
use aspecta::robot::LegIndex;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Where a report goes: into the directory `ASPECTA_FIGURES` names, else a temporary one.
fn directory(name: &str) -> (PathBuf, tempfile::TempDir) {
    let temporary = tempfile::tempdir().unwrap();
    let dir = std::env::var("ASPECTA_FIGURES").map_or(temporary.path().to_owned(), PathBuf::from);
    (dir.join(name), temporary)
}

fn files(dir: &Path) -> BTreeMap<PathBuf, String> {
    let entries = fs::read_dir(dir).unwrap().chain(fs::read_dir(dir.join("figures")).unwrap());
    let paths = entries.map(|e| e.unwrap().path()).filter(|p| p.is_file());
    paths.map(|p| (p.strip_prefix(dir).unwrap().to_owned(), fs::read_to_string(&p).unwrap())).collect()
}

/// Writes a report and checks what every report must fulfil; returns the page.
fn checked(analysis: &Analysis, dir: &Path, sections: &[&str], most_bytes: usize) -> String {
    let written = aspecta_view::report::write(analysis, dir).unwrap();
    let files = files(dir);
    assert_eq!(files.len(), written.len(), "nothing but the named files, no drafts");
    let page = &files[Path::new("report.html")];
    for (path, svg) in files.iter().filter(|f| f.0.extension().is_some_and(|e| e == "svg")) {
        let document = roxmltree::Document::parse(svg).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        let root = document.root_element();
        assert_eq!(root.tag_name().name(), "svg");
        assert!(root.descendants().any(|n| n.has_tag_name(("http://www.w3.org/2000/svg", "title"))));
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{}", path.display());
        assert!(page.contains(svg.as_str()), "{} is not in the page", path.display());
        assert!(page.contains(&format!("href=\"{}\"", path.display())), "{} is not linked", path.display());
    }
    assert!(page.len() < most_bytes, "{} bytes", page.len());
    let markup =
        page.split("<script").map(|s| s.split_once("</script>").map_or(s, |s| s.1)).collect::<String>();
    for outside in ["src=", "<link", "<img", "<iframe", "@import", "href=\"http", "url(http"] {
        assert!(!markup.contains(outside), "the page refers to something outside: {outside}");
    }
    for id in sections {
        assert_eq!(page.matches(&format!("<section id=\"{id}\">")).count(), 1, "{id}");
        assert!(page.contains(&format!("href=\"#{id}\"")), "{id} is not in the navigation");
    }
    page.clone()
}

#[test]
fn the_five_bar() {
    let analysis = analysis(&five_bar(), 9);
    let (dir, _keep) = directory("five-bar");
    let sections = ["robot", "modes", "counts", "maps", "earlier", "certified", "run"];
    let page = checked(&analysis, &dir, &sections, 3_000_000);
    // Table 2: six classes of one aspect, two of two.
    assert_eq!(page.matches("<strong>exactly 1</strong>").count(), 6);
    assert_eq!(page.matches("<strong>exactly 2</strong>").count(), 2);
    assert!(page.contains("exactly 10 generalized aspects"));
    assert!(!page.contains("id=\"volume\"") && !page.contains("id=\"doubts\""));
}

/// Where the bounds are apart, the page says where and why.
#[test]
fn doubts() {
    let analysis = analysis(&five_bar(), 6);
    let (dir, _keep) = directory("five-bar-6");
    let page = checked(&analysis, &dir, &["counts"], 3_000_000);
    let (_, table) = page.split_once("<table id=\"doubts\">").unwrap();
    let table = table.split_once("</table>").unwrap().0.replace('\u{a0}', " ");
    assert_eq!(analysis.doubts.len(), 8);
    assert_eq!(table.matches("may hide a whole aspect").count(), 8);
    // The largest come first.
    let mut doubts: Vec<_> = analysis.doubts.iter().collect();
    doubts.sort_by(|a, b| b.measure.total_cmp(&a.measure));
    let place = |k: usize| {
        let range = |(lo, hi): (f64, f64)| format!("{lo:.2} … {hi:.2} unit").replace('-', "−");
        let place = &doubts[k].place;
        table
            .find(&format!("x: {}", range(place[0])))
            .filter(|_| table.contains(&format!("y: {}", range(place[1]))))
    };
    assert!(place(0).is_some() && place(0) < place(7), "{table}");
}

/// Of a folded leg the page gives its own coordinates, and beyond the rows listed it says how many there are.
#[test]
fn doubts_about_folded_legs() {
    let mut analysis = analysis(&three_rrr(), 5);
    let doubt = &mut analysis.doubts[0];
    (doubt.fold, doubt.measure) = (Some(LegIndex::new(1)), 1e9);
    doubt.place = vec![(0.5, 0.75), (-0.125, 0.125), (1.0, 1.5)];
    let (dir, _keep) = directory("3-rrr-5");
    let page = checked(&analysis, &dir, &["counts"], 15_000_000).replace('\u{a0}', " ");
    for text in ["leg 2 folded", "q2: 0.50 … 0.75 rad", "p: −0.12 … 0.12", "φ: 1.00 … 1.50 rad"] {
        assert!(page.contains(text), "{text}");
    }
    assert!(page.contains(&format!("… and {} more", analysis.doubts.len() - 10)));
}

#[test]
fn the_three_rrr() {
    let analysis = analysis(&three_rrr(), 5);
    let (dir, _keep) = directory("3-rrr");
    let sections = ["robot", "modes", "counts", "space", "earlier", "certified", "run"];
    let page = checked(&analysis, &dir, &sections, 15_000_000);
    let (_, volume) = page.split_once("<script id=\"volume\" type=\"application/json\">").unwrap();
    let volume: serde_json::Value = serde_json::from_str(volume.split_once("</script>").unwrap().0).unwrap();
    assert_eq!(volume["size"], serde_json::json!([32, 32, 32]));
    assert_eq!(volume["classes"].as_array().unwrap().len(), analysis.classes.len());
    assert_eq!(volume["numbers"].as_array().unwrap().len(), 8);
}

/// White says: in none of the aspects. So all poses that are undecided are in cells that are drawn, those too that only a
/// folded leg's own coordinates describe.
#[test]
fn what_is_undecided_is_not_white() {
    let analysis = analysis(&three_rrr(), 6);
    let mut of_folds = 0;
    for class in (0..analysis.classes.len()).map(ClassId::new) {
        let drawn = analysis.cells(class);
        // About the poses with C1 on A1, where the first leg folds.
        for k in 0..500 {
            let [i, j, l] = [k % 8, k / 8 % 8, k / 64].map(f64::from);
            let pose = [0.601 * i - 12.0, 0.607 * j - 12.0, 0.31 * l - 1.2];
            let holds = |c: &Cell| (0..3).all(|a| c.lo[a] <= pose[a] && pose[a] < c.hi[a]);
            let place = analysis.locate(&pose, class);
            assert_eq!(drawn.iter().any(holds), place != Place::Outside, "{pose:?}");
            let (leaf, _) = analysis.pavings[0].descend_to(&pose, &mut |_| false).unwrap();
            of_folds +=
                usize::from(place == Place::Undecided && analysis.pavings[0].nodes[leaf as usize].covered);
        }
    }
    assert!(of_folds > 100, "{of_folds} poses: the test tests nothing");
}

const FLAT: [&str; 7] = ["robot", "modes", "counts", "maps", "earlier", "certified", "run"];

/// A plane of poses is drawn as a planar workspace, in W alone; axes have their names and units.
#[test]
fn slices_of_the_three_rrr() {
    for (name, held, title, labels) in [
        ("3-rrr-phi", (2, 0.0), "slice φ = 0 rad", ["x [unit]", "y [unit]"]),
        ("3-rrr-x", (0, -5.0), "slice x = −5 unit", ["y [unit]", "φ [rad]"]),
    ] {
        let analysis = slice(&three_rrr(), 8, &[held]);
        let (dir, _keep) = directory(name);
        let page = checked(&analysis, &dir, &FLAT, 4_000_000);
        assert!(page.contains(&format!("In the {title} this robot has")), "{title}");
        assert!(page.contains("certified area") && !page.contains("Q-aspects</h2>"));
        let files = files(&dir);
        for figure in ["overview", "aspects-mf8-negative", "parallel-aspects", "serial-aspects"] {
            let svg = &files[Path::new(&format!("figures/{figure}.svg"))];
            for text in [title, labels[0], labels[1]] {
                assert!(svg.contains(&format!(">{text}</text>")), "{text} in {figure} of {name}");
            }
            assert!(!svg.contains(">q"), "a joint axis in {figure} of {name}");
        }
    }
}

/// A line of poses is drawn as one strip a class, every aspect with its number and colour.
#[test]
fn slices_with_one_free_coordinate() {
    let three = slice(&three_rrr(), 12, &[(0, -5.0), (2, 0.3)]);
    for (name, analysis) in [("five-bar-y", slice(&five_bar(), 12, &[(1, 0.0)])), ("3-rrr-x-phi", three)] {
        let (dir, _keep) = directory(name);
        checked(&analysis, &dir, &FLAT, 500_000);
        let files = files(&dir);
        let svg = &files[Path::new("figures/strips.svg")];
        for aspect in analysis.classes.iter().flat_map(|c| &c.aspects) {
            assert!(svg.contains(&format!(">{}</text>", aspect.id)), "{} in {name}", aspect.id);
            assert!(svg.contains(&format!("fill:{}", aspecta_view::figure::palette::aspect(aspect.id))));
        }
        assert_eq!(svg.matches("det A").count(), analysis.classes.len());
    }
}

/// Same analysis, same files, on one thread and on several.
#[test]
fn reports_are_deterministic() {
    let slices = [slice(&three_rrr(), 5, &[(2, 0.0)]), slice(&three_rrr(), 8, &[(0, -5.0), (2, 0.3)])];
    for analysis in slices
        .into_iter()
        .chain([(five_bar(), 5), (three_rrr(), 3)].map(|(robot, depth)| analysis(&robot, depth)))
    {
        let write = |threads| {
            let dir = tempfile::tempdir().unwrap();
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| aspecta_view::report::write(&analysis, dir.path())).unwrap();
            files(dir.path())
        };
        assert!(write(1) == write(3));
    }
}

/// Texts of the robot file are shown, not run.
#[test]
fn names_are_escaped() {
    let mut robot = three_rrr();
    robot.title = "<script>alert(1)</script>".into();
    robot.length_unit = "</script><b>".into();
    let analysis = analysis(&robot, 3);
    let (dir, _keep) = directory("escaped");
    let page = checked(&analysis, &dir, &["robot"], 15_000_000);
    assert!(!page.contains("alert(1)</script>") && !page.contains("</script><b>"));
}

/// An analysis that decided next to nothing (stopped at once, say) has a report too.
#[test]
fn nothing_decided() {
    for robot in [five_bar(), three_rrr()] {
        let analysis = analysis(&robot, 1);
        assert!(analysis.classes.iter().all(|c| c.aspects.is_empty()));
        let (dir, _keep) = directory(&format!("undecided-{}", robot.name));
        let page = checked(&analysis, &dir, &["robot", "modes", "counts", "earlier"], 15_000_000);
        assert!(page.contains("at least 0 generalized aspects"));
    }
}

/// A place that cannot be written to is an error, not a panic.
#[test]
fn errors_of_the_file_system_are_returned() {
    let analysis = analysis(&five_bar(), 3);
    let file = tempfile::NamedTempFile::new().unwrap();
    assert!(aspecta_view::report::write(&analysis, file.path()).is_err());
}
