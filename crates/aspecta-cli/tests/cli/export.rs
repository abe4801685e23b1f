//! `aspecta export`: models for MuJoCo. That they move as they should is what `referee/mujoco/run` tests.

use crate::{aspecta, output, stdout};
use aspecta::legs::{Dimension, Size};
use aspecta::num::Interval;
use aspecta::robot::{Robot, catalogue};
use roxmltree::{Document, Node};
use std::fs;
use std::path::PathBuf;
use tempfile::TempDir;

type Point = [f64; 3];

fn named<'a>(document: &'a Document<'_>, tag: &str, name: &str) -> Node<'a, 'a> {
    let found = document.descendants().find(|n| n.has_tag_name(tag) && n.attribute("name") == Some(name));
    found.unwrap_or_else(|| panic!("no {tag} `{name}`"))
}

fn numbers(node: Node<'_, '_>, attribute: &str) -> Vec<f64> {
    let text = node.attribute(attribute).unwrap_or_else(|| panic!("no {attribute}: {node:?}"));
    text.split(' ').map(|x| x.parse().unwrap()).collect()
}

fn point(node: Node<'_, '_>, attribute: &str) -> Point {
    numbers(node, attribute).try_into().unwrap()
}

fn distance(a: Point, b: Point) -> f64 {
    a.iter().zip(b).map(|(x, y)| (x - y).powi(2)).sum::<f64>().sqrt()
}

/// Where a site is in the start configuration: bodies are aligned with the base but for the platform, which hangs from nothing.
fn place(site: Node<'_, '_>) -> Point {
    let mut p = point(site, "pos");
    for body in site.ancestors().filter(|n| n.has_tag_name("body")) {
        if let Some(axes) = body.attribute("xyaxes").map(|_| numbers(body, "xyaxes")) {
            let (x, y) = ([axes[0], axes[1], axes[2]], [axes[3], axes[4], axes[5]]);
            let z = [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]];
            p = std::array::from_fn(|k| x[k] * p[0] + y[k] * p[1] + z[k] * p[2]);
        }
        let pos = point(body, "pos");
        p = std::array::from_fn(|k| p[k] + pos[k]);
    }
    p
}

/// The length of what a body is drawn as.
fn length(document: &Document<'_>, body: &str) -> f64 {
    let shape = named(document, "body", body).children().find(|n| n.has_tag_name("geom")).unwrap();
    let ends = numbers(shape, "fromto");
    distance([ends[0], ends[1], ends[2]], [ends[3], ends[4], ends[5]])
}

fn catalogue_robots() -> impl Iterator<Item = Robot> {
    catalogue::all().iter().map(|entry| catalogue::find(entry.name).unwrap())
}

#[test]
fn every_robot_has_its_joints_servos_and_loops() {
    for robot in catalogue_robots() {
        let text = stdout(&format!("export mjcf {}", robot.name));
        let document = Document::parse(&text).unwrap_or_else(|e| panic!("{}: {e}", robot.name));
        assert_eq!(document.root_element().attribute("model"), Some(robot.name.as_str()));
        let count = |tag: &str| document.descendants().filter(|n| n.has_tag_name(tag)).count();
        assert_eq!((count("position"), count("connect")), (robot.dof(), robot.dof()), "{}", robot.name);
        let key = numbers(named(&document, "key", "start"), "ctrl");
        for (k, leg) in (1..).zip(&robot.legs) {
            let joint = named(&document, "joint", &format!("q{k}"));
            let kind = if leg.actuator.is_angle() { "hinge" } else { "slide" };
            assert_eq!(joint.attribute("type"), Some(kind), "{}", robot.name);
            assert_eq!(numbers(joint, "ref"), [key[k - 1]], "{}", robot.name);
            assert_eq!(joint.attribute("range").is_some(), !leg.limits.is_empty(), "{}", robot.name);
            assert_eq!(
                named(&document, "position", &format!("q{k}")).attribute("joint"),
                joint.attribute("name")
            );
        }
        let platform = named(&document, "body", "platform");
        let joints = platform.children().filter(|n| n.has_tag_name("joint"));
        let names: Vec<_> = joints.map(|n| n.attribute("name").unwrap()).collect();
        let coordinates = robot.platform.coordinates().iter().map(|c| c.name);
        let mut wanted: Vec<_> =
            coordinates.filter(|name| !["roll", "pitch", "yaw"].contains(name)).collect();
        if robot.platform.turns_in_space() {
            wanted.push("orientation");
        }
        assert_eq!(names, wanted, "{}", robot.name);
    }
}

/// Independently of how the model came about: links have the lengths of the robot file, and loops are closed where it starts.
#[test]
fn links_are_as_long_as_they_should_be_and_loops_are_closed() {
    for robot in catalogue_robots() {
        let text = stdout(&format!("export mjcf {}", robot.name));
        let document = Document::parse(&text).unwrap();
        let scale = robot.legs.iter().map(|leg| leg.actuator.size()).fold(0.0, f64::max);
        for (k, leg) in (1..).zip(&robot.legs) {
            let near = |found: f64, wanted: f64| {
                assert!((found - wanted).abs() < 1e-10 * scale, "{}, leg {k}: {found}, {wanted}", robot.name);
            };
            let (end, attachment) = (named(&document, "site", &format!("end{k}")), format!("attachment{k}"));
            let attachment = named(&document, "site", &attachment);
            near(distance(place(end), place(attachment)), 0.0);
            let q = numbers(named(&document, "joint", &format!("q{k}")), "ref")[0];
            for Dimension { name, size } in leg.actuator.dimensions(leg) {
                match size {
                    Some(Size::Length(wanted)) => near(length(&document, &format!("{name}{k}")), wanted),
                    // Links on a sphere are drawn straight.
                    Some(Size::Angle(angle)) => {
                        near(length(&document, &format!("{name}{k}")), 2.0 * (0.5 * angle).sin());
                    }
                    Some(Size::Lengths(..)) | None => {
                        near(distance(place(end), leg.anchor.map(Interval::mid)), q);
                    }
                }
            }
        }
    }
}

/// The whole text, read through once: cranks of 8 and 5 on anchors (0, 0) and (9, 0), closed at (4, 7).
#[test]
fn the_five_bar() {
    assert_eq!(stdout("export mjcf five-bar --pose 4,7 --mode ++"), include_str!("five-bar.xml"));
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("model.xml");
    let said = aspecta("export mjcf five-bar --pose 4,7 --mode ++ --out").arg(&path).output().unwrap();
    assert_eq!(String::from_utf8(said.stdout).unwrap(), format!("written: {}\n", path.display()));
    assert_eq!(fs::read_to_string(&path).unwrap(), include_str!("five-bar.xml"));
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 1, "no draft is left");
}

/// The modes that the options ask for are those that the model is in.
#[test]
fn where_a_model_starts() {
    let fact = |arguments: &str| {
        let text = stdout(arguments);
        let document = Document::parse(&text).unwrap();
        let mode = named(&document, "text", "working_mode").attribute("data").unwrap().to_owned();
        (mode, point(named(&document, "body", "platform"), "pos"))
    };
    let (mode, place) = fact("export mjcf 3-rrr --pose -15.468,0.781,4.2 --deg --mode +-+");
    assert_eq!((mode.as_str(), place), ("+-+", [-15.468, 0.781, 0.0]));
    assert_eq!(fact("export mjcf 3-rrr --mode --+").0, "--+");
    assert_eq!(fact("export mjcf delta --pose 0,0,-900").1, [0.0, 0.0, -900.0]);
}

/// A five-bar with this limit on leg 1.
fn limited(limit: &str) -> (TempDir, PathBuf) {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("limited.toml");
    let limited = format!("rod = 5 }}\nlimits = {{ {limit} }}");
    fs::write(&path, stdout("robots show five-bar").replace("rod = 5 }", &limited)).unwrap();
    (directory, path)
}

/// A range that passes 180°: at (-3.5, -2) the crank points at -119.2° in mode ++, which is 240.8° in the range. All may
/// be a full turn away.
#[test]
fn a_range_may_pass_180_degrees() {
    let (_directory, path) = limited("actuator = { deg = [100, 280] }");
    let output = aspecta("export mjcf --pose=-3.5,-2 --mode ++").arg(&path).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    let document = Document::parse(&text).unwrap();
    let joint = named(&document, "joint", "q1");
    let [low, high, q] = [numbers(joint, "range"), numbers(joint, "ref")].concat()[..] else {
        panic!("{joint:?}")
    };
    let off = |x: f64, degrees: f64| (0.5 * (x - degrees.to_radians())).sin().abs();
    assert!(off(low, 100.0) < 1e-9 && off(high, 280.0) < 1e-9 && off(q, 240.80628) < 1e-7);
    assert!(low < q && q < high && high - low < 3.2, "{low} {q} {high}");
}

#[test]
fn limits_of_passive_joints_are_left_out_and_said_to_be() {
    let (_directory, path) = limited("elbow = { deg = [5, 175] }");
    let output = aspecta("export mjcf").arg(&path).output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(said, "the model lacks these limits: elbow of leg 1\n");
}

/// A five-bar with these tables in its file.
fn cell(tables: &str) -> (TempDir, PathBuf) {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("cell.toml");
    fs::write(&path, format!("{}\n{tables}", stdout("robots show five-bar"))).unwrap();
    (directory, path)
}

/// What keeps clear of one another is what MuJoCo looks at: of links, a column, a bar and a wall each pair that can meet, and nothing else.
#[test]
fn bodies_and_obstacles_are_geoms_that_can_touch() {
    let links = "[bodies]\nradius = 0.3\nclearance = 0.05\n";
    let column = "[[obstacles]]\ncentre = [3, 7]\nradius = 0.4\nclearance = 0.1\n";
    let bar = "[[obstacles]]\nends = [[8, 9], [13, 9]]\nradius = 0.2\n";
    let wall = "[[obstacles]]\nface = [0, -9]\nnormal = [0, 2]\n";
    let (_directory, path) = cell(&format!("{links}{column}{bar}{wall}"));
    let output = aspecta("export mjcf --mode +-").arg(&path).output().unwrap();
    assert_eq!(String::from_utf8_lossy(&output.stderr), "");
    let text = String::from_utf8(output.stdout).unwrap();
    let document = Document::parse(&text).unwrap();
    let geom = |name: &str| named(&document, "geom", name);
    assert_eq!(numbers(geom("rod1"), "size"), [0.3]);
    assert_eq!(
        (numbers(geom("obstacle1"), "pos"), numbers(geom("obstacle1"), "size")),
        (vec![3.0, 7.0, 0.0], vec![0.4])
    );
    assert_eq!(numbers(geom("obstacle2"), "fromto"), [8.0, 9.0, 0.0, 13.0, 9.0, 0.0]);
    assert_eq!(
        (numbers(geom("obstacle3"), "pos"), numbers(geom("obstacle3"), "zaxis")),
        (vec![0.0, -9.0, 0.0], vec![0.0, 1.0, 0.0])
    );
    let pairs: Vec<(String, f64)> = document
        .descendants()
        .filter(|n| n.has_tag_name("pair"))
        .map(|n| {
            let [one, other] = ["geom1", "geom2"].map(|key| n.attribute(key).unwrap());
            assert!(geom(one) != geom(other));
            assert_eq!(n.attribute("gap"), None, "versions of MuJoCo disagree on what it is");
            (format!("{one} {other}"), numbers(n, "margin")[0])
        })
        .collect();
    let expected = [
        ("crank1 crank2", 0.05),
        ("crank1 rod2", 0.05),
        ("rod1 crank2", 0.05),
        ("rod1 obstacle2", 0.0),
        ("rod2 obstacle2", 0.0),
        ("crank1 obstacle1", 0.1),
        ("rod1 obstacle1", 0.1),
        ("rod1 obstacle3", 0.0),
        ("rod2 obstacle1", 0.1),
        ("rod2 obstacle3", 0.0),
    ];
    assert_eq!(pairs, expected.map(|(names, margin)| (names.to_owned(), margin)));
}

/// Thin links have no geoms that could touch, and struts that reach far are covered by no two rigid parts.
#[test]
fn contacts_that_a_model_cannot_have_are_named() {
    let said = |robot: &PathBuf| {
        let output = aspecta("export mjcf").arg(robot).output().unwrap();
        assert!(!String::from_utf8(output.stdout).unwrap().contains("<contact>"));
        String::from_utf8(output.stderr).unwrap()
    };
    let (_directory, path) = cell("[bodies]\nradius = 0\n[[obstacles]]\ncentre = [4.5, 0]\nradius = 1\n");
    let thin = said(&path);
    assert!(thin.starts_with("the model lacks these limits: obstacle 1 at the crank of leg 1, "), "{thin}");
    assert!(thin.contains("contact of crank of leg 1 and rod of leg 2"), "{thin}");
    fs::write(&path, format!("{}\n[bodies]\nradius = 0.5\n", stdout("robots show 3-rpr"))).unwrap();
    assert!(said(&path).contains("contact of rod of leg 1 and rod of leg 2"));
}

#[test]
fn what_cannot_be_exported() {
    let refused = |arguments: &str, complaint: &str| {
        let output = output(arguments);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0), "{arguments}: {said}");
        assert!(said.contains(complaint), "{arguments}: {said}");
    };
    refused("export", "mjcf");
    refused("export urdf five-bar", "unrecognized subcommand 'urdf'");
    refused("export mjcf fivebar", "`fivebar` is neither");
    refused("export mjcf five-bar --pose 40,0", "the pose is out of reach: leg 1 by 27");
    refused("export mjcf five-bar --pose 4", "has 2 pose coordinates");
    refused("export mjcf five-bar --mode +++", "`+++` is not a working mode of `five-bar`");
    refused("export mjcf five-bar --deg", "--pose");
    refused("export mjcf five-bar --out no/such/model.xml", "--out no/such/model.xml");
    refused(
        "export mjcf 3-rpr --pose 0,0,0",
        "the pose is beyond the robot's joint limits in every working mode",
    );
    refused(
        "export mjcf 2-prr --pose 0,0 --mode --",
        "the pose is beyond the robot's joint limits in working mode --",
    );
}

/// Without a range of its sliders a robot may be anywhere: then the pose must be given.
#[test]
fn a_robot_without_bounds_needs_a_pose() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("free.toml");
    fs::write(&path, stdout("robots show 2-prr").replace("limits", "# limits")).unwrap();
    let output = aspecta("export mjcf").arg(&path).output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2));
    assert!(said.contains("nothing bounds the coordinate `y`") && said.contains("with --pose"), "{said}");
    assert!(aspecta("export mjcf --pose 0,200").arg(&path).output().unwrap().status.success());
}
