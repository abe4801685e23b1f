//! The page of a motion: complete, well-formed, self-contained, true to the robot and the same every time.
//!
//! With `ASPECTA_FIGURES=DIR` the pages stay in DIR to look at.

use crate::common::{analysis, analysis_in, five_bar, three_rrr};
use aspecta::aspect::{Analysis, AspectId, ClassId};
use aspecta::kinematics::WorkingMode;
use aspecta::motion::{PathCheck, ProfilePoint, check_path};
use aspecta::robot::{Robot, catalogue};
use aspecta_view::figure::palette;
use aspecta_view::report::motion::Motion;
use roxmltree::{Document, Node};
use serde_json::Value;

const TABLE_4: [[f64; 3]; 3] = [[-15.468, 0.781, 0.073], [-15.468, -7.091, 0.5], [-9.902, -7.091, 1.081]];

fn mode(text: &str) -> WorkingMode {
    text.parse().unwrap()
}

fn check<const N: usize>(robot: &Robot, path: &[[f64; N]], text: &str) -> PathCheck {
    let path: Vec<Vec<f64>> = path.iter().map(|pose| pose.to_vec()).collect();
    check_path(robot, &path, mode(text)).unwrap()
}

fn catalogued(name: &str) -> Robot {
    catalogue::find(name).unwrap()
}

/// A page taken apart, after the checks that every page must pass.
struct Page {
    text: String,
    /// The values of each track, one a frame, in whole units.
    tracks: Vec<Vec<i64>>,
    frames: usize,
}

impl Page {
    fn new(name: &str, motion: Motion<'_>) -> Self {
        let text = motion.page();
        if let Ok(dir) = std::env::var("ASPECTA_FIGURES") {
            std::fs::write(std::path::Path::new(&dir).join(format!("motion-{name}.html")), &text).unwrap();
        }
        assert!(text.len() < 1_500_000, "{} bytes", text.len());
        for outside in
            ["src=", "<link", "<img", "<iframe", "@import", "href=", "url(http", "fetch(", "import("]
        {
            assert!(!text.contains(outside), "the page refers to something outside: {outside}");
        }
        assert_eq!(text.matches("NaN").count(), text.matches("Number.isNaN(wanted)").count());
        let (_, json) = text.split_once("<script id=\"motion\" type=\"application/json\">").unwrap();
        let json: Value = serde_json::from_str(json.split_once("</script>").unwrap().0).unwrap();
        let frames = json["frames"].as_u64().unwrap() as usize;
        let unpacked = |track: &Value| {
            let steps: Vec<i64> = track.as_array().unwrap().iter().map(|x| x.as_i64().unwrap()).collect();
            assert!(!steps.is_empty() && steps.len() <= frames);
            let mut value = 0;
            (0..frames)
                .map(|k| {
                    value += steps.get(k).copied().unwrap_or(0);
                    value
                })
                .collect()
        };
        let tracks = json["tracks"].as_array().unwrap().iter().map(unpacked).collect();
        let page = Self { text, tracks, frames };
        page.check_pictures();
        page
    }

    fn svg(&self, id: &str) -> Option<&str> {
        let end = self.text.find(&format!("aria-labelledby=\"{id}-title\""))?;
        let start = self.text[..end].rfind("<svg").unwrap();
        Some(&self.text[start..start + self.text[start..].find("</svg>").unwrap() + 6])
    }

    /// Each is XML with a title, and refers to tracks that exist.
    fn check_pictures(&self) {
        assert_eq!(self.text.matches("<svg").count(), self.text.matches("</svg>").count());
        for svg in
            self.text.split("<svg").skip(1).map(|s| format!("<svg{}", s.split_once("</svg>").unwrap().0))
        {
            let svg = format!("{svg}</svg>");
            let document = Document::parse(&svg).unwrap();
            assert!(document.descendants().any(|n| n.tag_name().name() == "title"));
            for node in document.descendants() {
                for name in ["data-points", "data-trail", "data-switch"] {
                    let Some(numbers) = node.attribute(name) else { continue };
                    assert!(
                        numbers.split(' ').all(|n| n.parse::<usize>().unwrap() < self.tracks.len()),
                        "{numbers}"
                    );
                }
            }
        }
    }

    /// Where the points of the moving circles with this radius are in a frame, pixels.
    fn circles(&self, id: &str, radius: &str, frame: usize) -> Vec<[f64; 2]> {
        let document = Document::parse(self.svg(id).unwrap()).unwrap();
        let pixels = |n: &str| self.tracks[n.parse::<usize>().unwrap()][frame] as f64 / 100.0;
        let place = |circle: Node<'_, '_>| {
            let moving = circle.parent().and_then(|group| group.attribute("data-points"));
            let at = |name| circle.attribute(name).unwrap().parse().unwrap();
            moving.map_or([at("cx"), at("cy")], |tracks| {
                let (x, y) = tracks.split_once(' ').unwrap();
                [pixels(x), pixels(y)]
            })
        };
        let circles = document.descendants().filter(|n| n.tag_name().name() == "circle");
        circles.filter(|n| n.attribute("r") == Some(radius)).map(place).collect()
    }

    /// The tracks of the numbers beside the pictures, with their decimals, in the order of the page.
    fn numbers(&self) -> Vec<(&[i64], i32)> {
        let number = |text: &str| {
            let (track, rest) = text.split_once("\" data-decimals=\"").unwrap();
            let track: usize = track.parse().unwrap();
            (&self.tracks[track][..], rest.split_once('"').unwrap().0.parse().unwrap())
        };
        self.text.split("data-number=\"").skip(1).map(number).collect()
    }
}

/// Base, elbow and platform joints A_i, B_i, C_i of a planar robot with revolute legs, by elementary geometry.
fn joints(robot: &[([f64; 2], [f64; 2], f64)], p: &ProfilePoint) -> Vec<[f64; 2]> {
    let (sin, cos) = p.pose.get(2).copied().unwrap_or(0.0).sin_cos();
    let mut points = Vec::new();
    for ((a, c, crank), q) in robot.iter().zip(&p.q) {
        let platform = [p.pose[0] + cos * c[0] - sin * c[1], p.pose[1] + sin * c[0] + cos * c[1]];
        points.extend([[a[0] + crank * q.cos(), a[1] + crank * q.sin()], *a, platform]);
    }
    points
}

/// The joints of every leg are drawn where they are, in every frame: up to scale and shift, which two base joints tell.
#[test]
fn robots_are_drawn_where_they_are() {
    let rrr = [
        ([-10.0, -10.0], [0.0, 0.0], 10.0),
        ([10.0, -10.0], [10.0, 0.0], 10.0),
        ([0.0, 10.0], [10.0, 10.0], 10.0),
    ];
    let bar = [([0.0, 0.0], [0.0, 0.0], 8.0), ([9.0, 0.0], [0.0, 0.0], 5.0)];
    let on_3_rrr = check(&three_rrr(), &TABLE_4, "+++");
    let on_five_bar = check(&five_bar(), &[[4.0, 7.0], [6.0, 9.0], [3.0, 10.0]], "++");
    let cases: [(&str, Robot, &PathCheck, &[_]); 2] =
        [("3-rrr", three_rrr(), &on_3_rrr, &rrr), ("five-bar", five_bar(), &on_five_bar, &bar)];
    for (name, robot, check, geometry) in cases {
        let page = Page::new(name, Motion::new(&robot).then(check.mode, &check.profile));
        assert_eq!(page.frames, check.profile.len(), "every sample is a frame");
        for (frame, sample) in check.profile.iter().enumerate() {
            let (expected, drawn) = (joints(geometry, sample), page.circles("robot", "4.5", frame));
            assert_eq!(drawn.len(), expected.len());
            let scale = (drawn[4][0] - drawn[1][0]) / (expected[4][0] - expected[1][0]);
            for (d, e) in drawn.iter().zip(&expected) {
                let right = drawn[1][0] + scale * (e[0] - expected[1][0]);
                let down = drawn[1][1] - scale * (e[1] - expected[1][1]);
                assert!((d[0] - right).hypot(d[1] - down) < 0.05, "{name}, frame {frame}: {d:?} {e:?}");
            }
            // The dot on the path is the origin of the platform frame, here C₁.
            let dot = page.circles("robot", "3", frame)[0];
            assert!((dot[0] - drawn[2][0]).hypot(dot[1] - drawn[2][1]) < 0.02);
        }
    }
}

/// The numbers beside the pictures, and the dots on the curves, are those of the profile.
#[test]
fn numbers_are_those_of_the_profile() {
    let robot = three_rrr();
    let check = check(&robot, &TABLE_4, "+++");
    let page = Page::new("numbers", Motion::new(&robot).then(check.mode, &check.profile));
    let numbers = page.numbers();
    for (frame, p) in check.profile.iter().enumerate() {
        let legs = p.q.iter().zip(&p.relative_b).flat_map(|(q, b)| [*q, *b]);
        let pose = p.pose.iter().copied().chain([p.relative_det_a]);
        let expected: Vec<f64> = [p.segment as f64, p.t].into_iter().chain(pose).chain(legs).collect();
        assert_eq!(numbers.len(), expected.len());
        for ((track, decimals), expected) in numbers.iter().zip(expected) {
            let unit = 0.1_f64.powi(*decimals);
            assert!((track[frame] as f64 * unit - expected).abs() < 0.51 * unit, "{frame}: {expected}");
        }
        let [one, other] = [&check.profile[0], p].map(|p| [p.segment as f64 + p.t, p.relative_det_a]);
        let dots = [0, frame].map(|frame| page.circles("figure11", "4", frame)[0]);
        // 640 pixels for two segments, 340 for 2.5.
        assert!((dots[1][0] - dots[0][0] - 320.0 * (other[0] - one[0])).abs() < 0.03);
        assert!((dots[1][1] - dots[0][1] + 136.0 * (other[1] - one[1])).abs() < 0.03);
    }
}

/// The number of the section shown in each frame, and the groups of the sections.
fn sections(page: &Page) -> (Vec<i64>, Vec<String>) {
    let svg = page.svg("aspect").unwrap();
    let document = Document::parse(svg).unwrap();
    let groups: Vec<Node<'_, '_>> =
        document.descendants().filter(|n| n.has_attribute("data-switch")).collect();
    let track: usize = groups[0].attribute("data-switch").unwrap().parse().unwrap();
    let cases: Vec<_> =
        groups.iter().map(|g| g.attribute("data-case").unwrap().parse::<usize>().unwrap()).collect();
    assert_eq!(cases, (0..groups.len()).collect::<Vec<_>>());
    (page.tracks[track].clone(), groups.iter().map(|g| svg[g.range()].to_owned()).collect())
}

fn the_aspect_of(analysis: &Analysis, pose: &[f64], text: &str) -> AspectId {
    let classes = (0..analysis.classes.len()).filter(|&k| analysis.classes[k].mode == mode(text));
    classes.filter_map(|k| analysis.aspect_at(pose, ClassId::new(k))).next().unwrap()
}

/// In the plane the whole aspect is seen, in its colour, and the dot is at the pose.
#[test]
fn the_aspect_of_a_five_bar() {
    let (robot, analysis) = (five_bar(), analysis(&five_bar(), 8));
    let path = [[4.0, 7.0], [6.0, 9.0], [3.0, 10.0]];
    let check = check(&robot, &path, "++");
    let page =
        Page::new("five-bar-aspect", Motion::new(&robot).then(check.mode, &check.profile).within(&analysis));
    let (shown, groups) = sections(&page);
    assert!(groups.len() == 1 && shown.iter().all(|&k| k == 0));
    let id = the_aspect_of(&analysis, &path[0], "++");
    assert!(
        groups[0].contains(&format!("fill:{}", palette::aspect(id)))
            && groups[0].contains(&format!(">aspect {id}<"))
    );
    let dot = |frame| page.circles("aspect", "5", frame)[0];
    let (first, point_2, last) = (dot(0), dot(101), dot(page.frames - 1));
    let scale = (point_2[0] - first[0]) / 2.0;
    assert!((last[0] - first[0] + scale).abs() < 0.05 && (last[1] - first[1] + 3.0 * scale).abs() < 0.05);
}

/// With three coordinates the section changes with the third one: it is at most half a step from it.
#[test]
fn sections_of_the_three_rrr() {
    let (robot, analysis) = (three_rrr(), analysis_in(&three_rrr(), "+++", 6));
    let check = check(&robot, &TABLE_4, "+++");
    let page =
        Page::new("3-rrr-aspect", Motion::new(&robot).then(check.mode, &check.profile).within(&analysis));
    let (shown, groups) = sections(&page);
    assert!((8..=32).contains(&groups.len()), "{} sections", groups.len());
    let heights: Vec<f64> = groups
        .iter()
        .map(|g| {
            g.split_once("φ = ").unwrap().1.split_once(" rad").unwrap().0.replace('−', "-").parse().unwrap()
        })
        .collect();
    let half = 0.5 * (1.081 - 0.073) / groups.len() as f64;
    for (k, p) in shown.iter().zip(&check.profile) {
        assert!((heights[*k as usize] - p.pose[2]).abs() < half + 0.006, "{k}: {}", p.pose[2]);
    }
}

/// After a change of working mode the aspect is another one and segments are counted on; a path met twice is in both.
#[test]
fn modes_change() {
    let (robot, analysis) = (five_bar(), analysis(&five_bar(), 7));
    let path = [[4.0, 7.0], [6.0, 9.0]];
    let stretches = ["++", "-+"].map(|text| check(&robot, &path, text));
    let motion =
        stretches.iter().fold(Motion::new(&robot), |m, c| m.then(c.mode, &c.profile)).within(&analysis);
    let page = Page::new("modes", motion);
    let (shown, groups) = sections(&page);
    assert_eq!((groups.len(), page.frames), (2, 202));
    assert!(shown[..101].iter().all(|&k| k == 0) && shown[101..].iter().all(|&k| k == 1));
    assert!(groups[0].contains("W (++)") && groups[1].contains("W (−+)"));
    assert!(page.text.contains("2 segments, working modes (++), then (−+)"));
    assert_eq!(page.numbers()[0].0[201], 2);
    assert!(page.svg("figure11").unwrap().contains(">(−+)</text>"));
}

/// Times that are given are kept and shown; without them the platform moves steadily.
#[test]
fn times() {
    let robot = three_rrr();
    let check = check(&robot, &TABLE_4, "+++");
    let motion = || Motion::new(&robot).then(check.mode, &check.profile);
    let times: Vec<f64> = (0..check.profile.len()).map(|k| 3.0 + 0.01 * k as f64).collect();
    let page = Page::new("timed", motion().timed(&times));
    let (seconds, decimals) = page.numbers()[2];
    assert_eq!((seconds[0], seconds[201], decimals), (0, 2010, 3));
    let clock = |page: &Page| {
        let (_, number) = page.text.split_once("\"clock\":").unwrap();
        page.tracks[number.split_once(',').unwrap().0.parse::<usize>().unwrap()].clone()
    };
    assert_eq!(clock(&page)[100], 1000);
    let steady = clock(&Page::new("steady", motion()));
    let steps = |k: usize| (steady[k + 1] - steady[k]) as f64;
    assert!(steady.is_sorted() && (steps(10) - steps(60)).abs() <= 1.0 && steps(100) == 0.0, "{steady:?}");
}

/// What stops a motion is said and seen, and the gap it leaves in the path is not bridged.
#[test]
fn obstacles() {
    let robot = five_bar();
    let check = check(&robot, &[[4.0, 7.0], [4.0, 14.0]], "++");
    let motion = Motion::new(&robot).then(check.mode, &check.profile).stopped_by(check.obstacle.as_ref());
    let page = Page::new("obstacle", motion);
    assert!(
        page.text
            .contains("<strong>In segment 1: leg 2 is stretched or folded (serial singularity).</strong>")
    );
    assert!(page.svg("figure11").unwrap().contains("class=\"obstacle\""));
    // Out of reach between two parts that are within.
    let mut parts = check.profile.clone();
    parts.drain(20..30);
    let page = Page::new("gap", Motion::new(&robot).then(check.mode, &parts));
    assert_eq!(page.svg("robot").unwrap().matches("data-breaks=\"20\"").count(), 1);
}

/// The picture of a robot in space is linear in where its points are: a Delta's platform joints move as the pose does.
#[test]
fn a_delta_moves_as_its_pose_does() {
    let robot = catalogued("delta");
    let path = [
        [0.0, 0.0, -900.0],
        [100.0, 0.0, -900.0],
        [100.0, 100.0, -900.0],
        [100.0, 100.0, -1000.0],
        [-30.0, 70.0, -1100.0],
    ];
    let check = check(&robot, &path, "---");
    let page = Page::new("delta", Motion::new(&robot).then(check.mode, &check.profile));
    let moved = |leg: usize, from: usize, to: usize| {
        let [from, to] = [from, to]
            .map(|point| page.circles("robot", "4.5", (101 * point).saturating_sub(1))[3 * leg + 2]);
        [to[0] - from[0], to[1] - from[1]]
    };
    let [x, y, z] = [0, 1, 2].map(|k| moved(0, k, k + 1));
    assert!(x[0] > 5.0 && y[0] > 5.0 && z[1] > 5.0 && z[0].abs() < 0.03, "z points up: {x:?} {y:?} {z:?}");
    for leg in 0..3 {
        for axis in 0..2 {
            // (−130, −30, −100) from point 4; z is moved by −100.
            let expected = -1.3 * x[axis] - 0.3 * y[axis] + z[axis];
            assert!((moved(leg, 3, 4)[axis] - expected).abs() < 0.05, "leg {leg}");
        }
    }
}

/// Every kind of leg and platform.
#[test]
fn robots_in_space() {
    let cases: [(&str, &str, [&[f64]; 2], usize); 4] = [
        ("linear-delta", "+++", [&[0.0, 0.0, 100.0], &[40.0, 20.0, 130.0]], 6),
        ("spherical-3-rrr", "+++", [&[0.1, 0.2, 0.1], &[0.4, -0.3, 0.5]], 9),
        ("gough-stewart", "------", [&[0.1, 0.1, 0.8, 0.2, 0.1, 0.3], &[0.2, 0.0, 0.7, 0.1, 0.2, 0.1]], 12),
        ("hexa", "------", [&[0.0, 0.0, -500.0, 0.0, 0.0, 0.0], &[60.0, 20.0, -520.0, 0.1, 0.1, 0.2]], 18),
    ];
    for (name, text, path, joints) in cases {
        let robot = catalogued(name);
        let check = check_path(&robot, &path.map(<[f64]>::to_vec), mode(text)).unwrap();
        let page = Page::new(name, Motion::new(&robot).then(check.mode, &check.profile));
        assert_eq!(page.frames, 101, "{name}");
        let [first, last] = [0, 100].map(|frame| page.circles("robot", "4.5", frame));
        assert_eq!(first.len(), joints, "{name}");
        assert!(first.iter().zip(&last).any(|(a, b)| a != b), "{name}");
        let inside = |p: &[f64; 2]| (0.0..620.0).contains(&p[0]) && (0.0..520.0).contains(&p[1]);
        assert!(first.iter().chain(&last).all(inside), "{name}");
    }
}

/// Of long motions fewer samples are shown, the last one among them.
#[test]
fn long_motions_are_thinned() {
    let robot = five_bar();
    let path: Vec<[f64; 2]> =
        (0..1000).map(|k| [4.0 + 0.0005 * f64::from(k), 7.0 + f64::from(k % 2)]).collect();
    let check = check(&robot, &path, "++");
    let page = Page::new("long", Motion::new(&robot).then(check.mode, &check.profile));
    assert!((1000..=2001).contains(&page.frames), "{}", page.frames);
    let every = check.profile.len().div_ceil(2000);
    assert!(every > 1 && page.text.contains(&format!("One of {every} samples is shown.")), "{every}");
    assert_eq!((page.numbers()[0].0[page.frames - 1], page.numbers()[1].0[page.frames - 1]), (999, 1000));
}

#[test]
fn pages_are_deterministic_and_names_are_escaped() {
    let mut robot = three_rrr();
    robot.title = "<script>alert(1)</script>".into();
    robot.length_unit = "</script><b>".into();
    let analysis = analysis(&robot, 4);
    let check = check(&robot, &TABLE_4, "+++");
    let page = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| Motion::new(&robot).then(check.mode, &check.profile).within(&analysis).page())
    };
    let one = page(1);
    assert!(one == page(3));
    assert!(!one.contains("alert(1)</script>") && !one.contains("</script><b>"));
}

/// Nothing to show is said, not a panic.
#[test]
fn a_motion_without_samples() {
    let page = Motion::new(&five_bar()).page();
    assert!(page.contains("nothing to watch") && !page.contains("<script"));
}
