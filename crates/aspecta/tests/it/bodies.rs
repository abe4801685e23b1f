//! Bodies of the machine that keep clear of one another: counts, solutions, paths and certificates, against a library of collision queries.

use crate::obstacles::{LINKS, Point, analyzed, disc, exact, five_bar, is_accepted, joints, with};
use crate::random::Random;
use aspecta::Kinematics;
use aspecta::aspect::{Options, Purpose, analyze};
use aspecta::kinematics::constraints::Constraint;
use aspecta::motion::{PathOptions, check_poses};
use aspecta::num::Interval;
use aspecta::paving::{Budget, Control};
use aspecta::robot::{Body, Clearance, Limit, LinkPart, Platform, Robot, Shape, catalogue};
use parry3d_f64::math::{Pose, Vector};
use parry3d_f64::query::distance;
use parry3d_f64::shape::{HalfSpace, Segment};

const ANCHORS: [[f64; 2]; 2] = [[0.0, 0.0], [9.0, 0.0]];

fn radius(radius: f64) -> String {
    format!("[bodies]\nradius = {radius:?}\n")
}

/// The paper's five-bar whose links are in one plane, so that those that share no joint may not cross. Wherever it stands, whatever its unit,
/// mirrored, its legs exchanged.
#[test]
fn thin_links_that_may_not_cross_leave_10_aspects() {
    let thin = radius(0.0);
    let analysis = analyzed(&five_bar(ANCHORS, LINKS, &thin));
    assert_eq!((analysis.aspects.low, analysis.aspects.high), (10, Some(10)));
    assert!(is_accepted(analysis.certificate.as_ref().unwrap()));
    // Some configurations are lost: without bodies the areas are larger.
    let free = analyzed(&five_bar(ANCHORS, LINKS, ""));
    let area = |analysis: &aspecta::aspect::Analysis| {
        analysis.classes.iter().map(|class| class.measure).sum::<f64>()
    };
    assert!(area(&analysis) < 0.95 * area(&free), "{} {}", area(&analysis), area(&free));
    let moved = five_bar([[-3.0, 2.0], [2.4, 9.2]], LINKS, &thin);
    let scaled = five_bar([[0.0, 0.0], [0.9, 0.0]], LINKS.map(|l| l.map(|x| 0.1 * x)), &thin);
    let mirrored = five_bar([[0.0, 0.0], [-9.0, 0.0]], LINKS, &thin);
    let renumbered = five_bar([[9.0, 0.0], [0.0, 0.0]], [LINKS[1], LINKS[0]], &thin);
    for robot in [moved, scaled, mirrored, renumbered] {
        assert_eq!(exact(&robot), 10, "{:?}", robot.legs);
    }
}

/// Links that are thicker part aspects; a clearance is as good as a thickness.
#[test]
fn thick_links_leave_12_aspects() {
    assert_eq!(exact(&five_bar(ANCHORS, LINKS, &radius(0.7))), 12);
    assert_eq!(exact(&five_bar(ANCHORS, LINKS, "[bodies]\nradius = 0\nclearance = 1.4\n")), 12);
    let modes = vec!["+-".parse().unwrap()];
    let options = Options { certificate: true, modes, purpose: Purpose::Numbers, ..Options::default() };
    let robot = five_bar(ANCHORS, LINKS, &radius(0.7));
    let analysis = analyze(&robot, &options, &Control::unwatched()).unwrap();
    assert!(analysis.aspects.certified && is_accepted(analysis.certificate.as_ref().unwrap()));
}

/// Bodies in different layers never meet.
#[test]
fn layers_part_bodies() {
    let layers = |first: i32, second: i32| {
        let leg = |j: usize, layer: i32| {
            let [crank, rod] = LINKS[j];
            format!(
                "[[legs]]\nanchor = {:?}\nbodies = {{ radius = 0.7, layer = {layer} }}\n\
                 actuator = {{ kind = \"revolute\", crank = {crank}, rod = {rod} }}\n",
                ANCHORS[j]
            )
        };
        let text = format!("name = \"x\"\nplatform = \"plane-point\"\n{}{}", leg(0, first), leg(1, second));
        Robot::from_toml(&text, "layers.toml").unwrap()
    };
    assert_eq!(layers(1, 1).pairs.len(), 3);
    assert!(layers(1, 2).pairs.is_empty());
}

#[test]
fn random_robots_are_exact() {
    assert!(exact_among(3) >= 2);
}

#[test]
#[ignore = "takes minutes"]
fn random_robots_are_exact_at_length() {
    assert!(exact_among(10) >= 8);
}

/// How many of so many random five-bars with discs, bars and thick or thin links are exact.
fn exact_among(cases: usize) -> usize {
    let random = &mut Random(31);
    let mut exact = 0;
    for case in 0..cases {
        let mut length = || random.within(2.0, 9.0);
        let links = [[length(), length()], [length(), length()]];
        let other = [random.within(3.0, 9.0), random.within(-2.0, 2.0)];
        let mut tables = radius([0.0, 0.4][case % 2]);
        tables += &disc([random.within(-6.0, 12.0), random.within(3.0, 9.0)], random.within(0.3, 1.0));
        if case % 3 == 0 {
            tables += "[[obstacles]]\nends = [[-3, -4.5], [8, -5]]\nradius = 0.2\n";
        }
        let robot = five_bar([[0.0, 0.0], other], links, &tables);
        let budget = Budget { boxes: Some(300_000), ..Budget::default() };
        let options = Options { budget, ..Options::default() };
        exact += usize::from(analyze(&robot, &options, &Control::unwatched()).unwrap().aspects.certified);
    }
    exact
}

/// The slice of the 3-RRR that the paper counts, in one of its modes, with links one unit thick.
#[test]
fn slices_of_bodies_are_exact() {
    let robot = with("3-rrr", &radius(0.5));
    let modes = vec!["+++".parse().unwrap()];
    let options = Options { fix: vec![(2, 0.0)], modes, ..Options::default() };
    let analysis = analyze(&robot, &options, &Control::unwatched()).unwrap();
    assert_eq!((analysis.aspects.low, analysis.aspects.high), (7, Some(7)), "{:?}", analysis.doubts);
}

/// Where a body is, by the joints of its leg or the pose.
fn ends(robot: &Robot, pose: &[f64], q: &[f64], body: Body) -> [Point; 2] {
    let capsule = robot.capsule(body);
    let given = || capsule.unwrap().shape.ends().unwrap().map(|end| end.map(|x| x.mid()));
    match body {
        Body::Crank(j) => {
            let [a, b, _] = joints(robot, pose, q, j.index());
            [a, b]
        }
        Body::Rod(j) => {
            let [_, b, c] = joints(robot, pose, q, j.index());
            [b, c]
        }
        Body::Obstacle(_) => given(),
        Body::Platform(_) => given().map(|[x, y, z]| match robot.platform {
            Platform::PlaneBody => {
                let (sin, cos) = pose[2].sin_cos();
                [pose[0] + cos * x - sin * y, pose[1] + sin * x + cos * y, 0.0]
            }
            _ => [pose[0] + x, pose[1] + y, pose.get(2).copied().unwrap_or(0.0) + z],
        }),
    }
}

/// By how much the bodies of a robot are farther apart than they must be, by the library.
fn least_to_spare(robot: &Robot, pose: &[f64], q: &[f64]) -> f64 {
    let of = |body: Body| {
        let [from, to] = ends(robot, pose, q, body).map(|p| Vector::new(p[0], p[1], p[2]));
        Segment::new(from, to)
    };
    let spare = |pair: &aspecta::robot::BodyPair| {
        let here = Pose::identity();
        let distance = match robot.capsule(pair.bodies[1]).map(|body| body.shape) {
            Some(Shape::Wall { normal, offset }) => {
                let [x, y, z] = normal.map(Interval::mid);
                let (wall, [x, y, z]) =
                    (HalfSpace::new(Vector::new(x, y, z)), [x, y, z].map(|n| n * offset.mid()));
                distance(&here, &of(pair.bodies[0]), &Pose::translation(x, y, z), &wall)
            }
            Some(Shape::Link | Shape::Axis(_)) | None => {
                let [first, second] = pair.bodies.map(of);
                distance(&here, &first, &here, &second)
            }
        };
        distance.unwrap().distance - pair.distance.mid()
    };
    robot.pairs.iter().map(spare).fold(f64::INFINITY, f64::min)
}

/// Every solution is told to be within limits just if its bodies are clear of one another.
#[test]
fn solutions_within_limits_are_clear() {
    solutions_are_clear(4_000);
}

/// The same for 10⁵ configurations of each robot.
#[test]
#[ignore = "takes minutes"]
fn solutions_within_limits_are_clear_at_length() {
    solutions_are_clear(100_000);
}

fn solutions_are_clear(wanted: usize) {
    let bar = "[[obstacles]]\nends = [[2, 4], [7, 5]]\nradius = 0.2\nclearance = 0.1\n";
    let plate = "[[bodies.platform]]\nends = [[0, 0], [10, 0]]\nradius = 0.5\n";
    let strut = "[bodies]\nradius = 0.6\n";
    let rods = "[bodies]\nradius = 20\n[[bodies.platform]]\nends = [[0, 0, 0], [0, 0, -200]]\nradius = 15\n\
                [[obstacles]]\nends = [[-900, 300, -900], [900, 300, -900]]\nradius = 40\n";
    let wall = "[[obstacles]]\nface = [0, -14]\nnormal = [0.2, 1]\nclearance = 0.3\n";
    let table = "[[bodies.platform]]\nends = [[0, 0, 0], [10, 0, -200]]\nradius = 15\n\
                 [[obstacles]]\nface = [0, 0, -300]\nnormal = [0.1, 0, 1]\n";
    let random = &mut Random(12);
    for (name, tables, size) in [
        ("five-bar", format!("{}{bar}", radius(0.4)), 9.0),
        ("3-rrr", format!("{}{plate}", radius(0.4)), 16.0),
        ("3-rrr", format!("{plate}{wall}"), 16.0),
        ("3-rpr", format!("{strut}{plate}"), 12.0),
        ("delta", table.into(), 900.0),
        ("delta", rods.into(), 900.0),
        ("gough-stewart", "[bodies]\nradius = 0.02\n".into(), 0.6),
    ] {
        let mut robot = with(name, &tables);
        assert!(!robot.pairs.is_empty(), "{name}");
        robot.legs.iter_mut().for_each(|leg| leg.limits.clear());
        robot.window.fill(None);
        let (mut clear, mut touching) = (0, 0);
        while clear + touching < wanted {
            let coordinates = robot.platform.coordinates();
            let end = |angle: bool| if angle { 1.0 } else { size };
            let pose: Vec<f64> =
                coordinates.iter().map(|c| random.within(-end(c.angle), end(c.angle))).collect();
            for found in robot.inverse(&pose).unwrap() {
                let spare = least_to_spare(&robot, &pose, &found.q);
                if spare.abs() < 1e-9 * size {
                    continue;
                }
                assert_eq!(found.within_limits, spare > 0.0, "{name} {pose:?} {:?}: {spare}", found.q);
                (clear, touching) = (clear + usize::from(spare > 0.0), touching + usize::from(spare < 0.0));
            }
        }
        assert!(clear > wanted / 50 && touching > wanted / 100, "{name}: {clear} {touching}");
    }
}

/// Thin links cross just where the library says that they do.
#[test]
fn thin_links_cross_where_segments_do() {
    let robot = with("five-bar", &radius(0.0));
    let random = &mut Random(2);
    let (mut clear, mut crossing) = (0, 0);
    while clear < 2000 || crossing < 2000 {
        let pose = [random.within(-5.0, 14.0), random.within(-12.0, 12.0)];
        for found in robot.inverse(&pose).unwrap() {
            let meets = least_to_spare(&robot, &pose, &found.q) < 1e-12;
            assert_eq!(found.within_limits, !meets, "{pose:?} {:?}", found.q);
            (clear, crossing) = (clear + usize::from(!meets), crossing + usize::from(meets));
        }
    }
}

/// Both ends of a rod keep its radius from a wall, whatever the crank has; and a link without a radius is in its layer.
#[test]
fn obstacles_meet_what_is_there() {
    let robot = |bodies: &str, obstacle: &str| {
        let leg = |j: usize| {
            let [crank, rod] = LINKS[j];
            format!(
                "[[legs]]\nanchor = {:?}\nbodies = {{ {bodies} }}\n\
                 actuator = {{ kind = \"revolute\", crank = {crank}, rod = {rod} }}\n",
                ANCHORS[j]
            )
        };
        let text = format!(
            "name = \"x\"\nplatform = \"plane-point\"\n{}{}[[obstacles]]\n{obstacle}\n",
            leg(0),
            leg(1)
        );
        Robot::from_toml(&text, "x.toml").unwrap()
    };
    let wall = "face = [0, -4]\nnormal = [0, 1]";
    let thick = robot("crank = { radius = 0.1 }, rod = { radius = 2 }", wall);
    let elbow_of = |robot: &Robot| robot.legs[0].limits.first().map(|limit| limit.in_words("cm"));
    assert_eq!(elbow_of(&thick), Some("elbow 2.0000 cm from obstacle 1".into()));
    let below =
        robot("crank = { radius = 0.1 }, rod = { radius = 1, layer = 1 }", &format!("{wall}\nlayer = 1"));
    assert_eq!(elbow_of(&below), Some("elbow 1.0000 cm from obstacle 1".into()));
    let disc = "centre = [4, 3]\nradius = 1\nlayer = 7";
    let thin = robot("rod = { layer = 7 }", disc);
    assert_eq!(elbow_of(&thin), Some("rod 0 cm from obstacle 1".into()));
    assert_eq!(robot("layer = 1", disc).legs[0].limits.len(), 0);
}

/// A disc of the platform touches a wall just where its centre is as near as its radius: the aspects of a point that is limited so.
#[test]
fn bodies_of_the_platform_stay_in_front_of_walls() {
    let wall = "[[obstacles]]\nface = [0, -4]\nnormal = [0.3, 1]\n";
    let robot = with("five-bar", &format!("[[bodies.platform]]\ncentre = [0, 0]\nradius = 1\n{wall}"));
    let names: Vec<String> = Constraint::of(&robot).map(|constraint| constraint.to_string()).collect();
    assert!(names.contains(&"contact of body 1 of the platform and obstacle 1".to_owned()), "{names:?}");
    let mut alone = robot.clone();
    alone.legs.iter_mut().for_each(|leg| leg.limits.clear());
    let analysis = analyzed(&alone);
    let certificate = analysis.certificate.as_ref().unwrap();
    assert!(is_accepted(certificate));
    for fault in 0..3 {
        let mut forged = certificate.clone();
        let wall = forged.robot.bodies.iter_mut().find_map(|body| match &mut body.shape {
            Shape::Wall { normal, offset } => Some((normal, offset)),
            Shape::Link | Shape::Axis(_) => None,
        });
        let (normal, offset) = wall.unwrap();
        match fault {
            0 => *offset = *offset + Interval::point(0.1),
            1 => *offset = *offset - Interval::point(0.1),
            _ => *normal = [Interval::point(0.0), Interval::point(1.0), Interval::point(0.0)],
        }
        assert!(!is_accepted(&forged), "{fault}");
    }
    // The same by the end of a rod, of which the distance is a limit of its leg.
    let mut by_limit = alone.clone();
    by_limit.bodies.clear();
    by_limit.pairs.clear();
    let end = robot.legs[0]
        .limits
        .iter()
        .find_map(|limit| limit.as_clearance().filter(|c| c.part == LinkPart::End));
    let end = Clearance { distance: Interval::point(1.0), ..*end.unwrap() };
    by_limit.legs[0].limits.push(Limit::Clearance(end));
    let other = analyzed(&by_limit);
    for (one, other) in analysis.classes.iter().zip(&other.classes) {
        assert_eq!((one.low, one.high), (other.low, other.high), "{}", one.mode);
        assert!((one.measure - other.measure).abs() < 1e-9 * one.measure.max(1.0));
    }
}

/// A robot that was read from a certificate has all the pairs that its bodies ask for.
#[test]
fn pairs_are_those_of_the_bodies() {
    let robot = with(
        "3-rrr",
        &format!(
            "{}[[bodies.platform]]\ncentre = [5, 3]\nradius = 1\n{}",
            radius(0.5),
            disc([9.0, 5.0], 0.5)
        ),
    );
    robot.check().unwrap();
    let changes: [fn(&mut Robot); 5] = [
        |robot| robot.pairs.truncate(3),
        |robot| robot.bodies[2].radius = Interval::point(0.9),
        |robot| robot.bodies[1] = robot.bodies[0],
        |robot| robot.pairs[1].distance = Interval::point(0.9),
        |robot| robot.bodies[0].layer = None,
    ];
    for (k, change) in changes.into_iter().enumerate() {
        let mut changed = robot.clone();
        change(&mut changed);
        assert_eq!(changed.check().is_err(), k < 4, "{k}");
    }
}

/// A path on which two links come as near to one another as their thickness and 10⁻³ to 10⁻⁹ more, or less: never called free where it is less.
#[test]
fn paths_on_which_links_graze() {
    let free = five_bar(ANCHORS, LINKS, "");
    let thin = five_bar(ANCHORS, LINKS, &radius(0.0));
    let random = &mut Random(16);
    let (mut free_paths, mut met) = (0, 0);
    while free_paths + met < 100 {
        let mut pose = || vec![random.within(-3.0, 12.0), random.within(-9.0, 9.0)];
        let (from, to) = (pose(), pose());
        let mode = "+-".parse().unwrap();
        let options = PathOptions::default();
        let path = [from.clone(), to.clone()];
        if check_poses(&free, &path, mode, &options).map_or(true, |check| check.obstacle.is_some()) {
            continue;
        }
        let at = |t: f64| {
            let x: Vec<f64> = from.iter().zip(&to).map(|(a, b)| a + t * (b - a)).collect();
            let q = free.inverse_in(&x, mode).unwrap().unwrap();
            least_to_spare(&thin, &x, &q)
        };
        let steps = 2000;
        let near = (0..=steps).map(|i| at(f64::from(i) / f64::from(steps))).fold(f64::INFINITY, f64::min);
        if near < 0.1 {
            continue;
        }
        let off = 10f64.powf(random.within(-9.0, -3.0));
        for apart in [near - off, near + off] {
            let robot = five_bar(ANCHORS, LINKS, &radius(0.5 * apart));
            let check = check_poses(&robot, &path, mode, &options).unwrap();
            // Samples see no nearer point than there is: thicker links touch.
            if apart > near {
                assert_ne!(check.within_limits, Some(true), "{apart} {off} {path:?}");
                met += usize::from(check.within_limits == Some(false));
            } else if check.within_limits == Some(true) {
                free_paths += 1;
            }
        }
    }
    assert!(free_paths > 20 && met > 20, "{free_paths} {met}");
}

#[test]
fn forged_certificates_are_refused() {
    let modes = vec!["+-".parse().unwrap()];
    let options = Options { certificate: true, modes, purpose: Purpose::Numbers, ..Options::default() };
    let random = &mut Random(8);
    for thickness in [0.0, 0.7] {
        let robot = five_bar(ANCHORS, LINKS, &radius(thickness));
        let certificate = analyze(&robot, &options, &Control::unwatched()).unwrap().certificate.unwrap();
        for case in 0..5 {
            let mut forged = certificate.clone();
            let pair = random.below(forged.robot.pairs.len());
            let by = Interval::point(random.within(0.05, 0.3));
            let distance = &mut forged.robot.pairs[pair].distance;
            match case {
                0 => *distance = *distance + by,
                // Of the cranks alone this would change nothing that is claimed.
                1 => forged.robot.pairs[1].distance = forged.robot.pairs[1].distance + by,
                2 => {
                    forged.robot.pairs.remove(pair);
                }
                3 => {
                    // With its scale too.
                    forged.robot.pairs.remove(1);
                    forged.scale.pairs.remove(1);
                }
                _ => {
                    let claim = &mut forged.claims[random.below(2)];
                    (claim.low, claim.high) = (claim.low - 1, Some(claim.low - 1));
                }
            }
            assert!(!is_accepted(&forged), "thickness {thickness}, case {case}, pair {pair}");
        }
    }
}

#[test]
fn in_robot_files() {
    let pairs = |robot: &Robot| robot.pairs.iter().map(ToString::to_string).collect::<Vec<_>>();
    let robot = with("3-rrr", &format!("{}[[bodies.platform]]\ncentre = [5, 3]\nradius = 1\n", radius(0.5)));
    // One pair of cranks, that of legs 1 and 2, the others being too short to meet; rods; cranks and rods of different legs; the disc and all six.
    assert_eq!(pairs(&robot).len(), 1 + 3 + 6 + 6, "{:?}", pairs(&robot));
    assert_eq!(pairs(&robot)[0], "crank of leg 1 and crank of leg 2");
    // A rod that ends in a body of the platform.
    let robot = with(
        "3-rpr",
        "[bodies]\nradius = 0.5\n[[bodies.platform]]\nends = [[0, 0], [17.04, 0]]\nradius = 0.5\n",
    );
    assert_eq!(pairs(&robot)[3..], ["rod of leg 3 and body 1 of the platform"]);
    let names: Vec<String> = Constraint::of(&robot).map(|constraint| constraint.to_string()).collect();
    assert!(names.contains(&"contact of rod of leg 1 and rod of leg 2".to_owned()), "{names:?}");
    // Cranks and bars are where the motors put them.
    let robot = with("five-bar", "[[obstacles]]\nends = [[2, 6], [7, 6]]\n");
    let driven: Vec<bool> =
        Constraint::of(&robot).map(|constraint| constraint.is_of_drives(&robot)).collect();
    assert_eq!(driven, [false, false, true, false, false, false]);
    assert_eq!(pairs(&robot).len(), 3, "the crank of leg 2 is too short: {:?}", pairs(&robot));

    for (name, tables, said) in [
        ("five-bar", "[bodies]\nradius = -1", "not negative"),
        ("five-bar", "[bodies]\nradius = 0.5\nlayer = 0.5", "a layer is a whole number"),
        ("five-bar", "[bodies]\nradius = 5", "touch in every configuration"),
        ("five-bar", "[bodies]\nclearence = 1", "unknown key"),
        ("five-bar", "[[bodies.platform]]\nends = [[0, 0], [1, 0], [2, 0]]\nradius = 1", "two ends"),
        ("five-bar", "[[bodies.platform]]\nradius = 1", "missing key `ends`"),
        ("five-bar", "[[bodies.platform]]\ncentre = [0, 0]\nradius = 0", "must be positive"),
        ("five-bar", "[[obstacles]]\nends = [[0, 0], [0, 0]]", "two points"),
        ("five-bar", "[[obstacles]]\nends = [[-1, 0], [1, 0]]", "touch in every configuration"),
        (
            "3-rpr",
            "[bodies]\nradius = 0.5\n[[bodies.platform]]\ncentre = [0, 1]\nradius = 0.7",
            "touch in every configuration",
        ),
        ("delta", "[bodies]\nradius = 0", "no thickness"),
        ("delta", "[bodies]\nradius = 9\nlayer = 1", "only planar machines"),
        ("spherical-3-rrr", "[bodies]\nradius = 0.1", "turning-body"),
        (
            "3-prr",
            "[[bodies.platform]]\nends = [[0, 0], [1, 0]]\nradius = 0\n[[obstacles]]\nface = [0, -3]\nnormal = [0, 1]",
            "give the body a radius, or a clearance above 0",
        ),
    ] {
        let text = catalogue::all().iter().find(|entry| entry.name == name).unwrap().text;
        let text = format!("{text}\n{tables}\n");
        let refused = Robot::from_toml(&text, "x.toml").expect_err(tables).to_string();
        assert!(refused.contains(said) && refused.contains("x.toml:"), "{tables}: {refused}");
    }
}
