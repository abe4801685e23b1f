//! Boundaries of aspects and characteristic surfaces (Definition 9), judged by formulas and counts of their own.

use aspecta::Kinematics;
use aspecta::aspect::{Analysis, AspectClass, AspectId, ClassId, DetSign, Options, Place, analyze};
use aspecta::domain::boundary::{Boundary, BoundaryError, Face, Simplex};
use aspecta::domain::characteristic::{Characteristic, CharacteristicError};
use aspecta::kinematics::constraints::Constraint;
use aspecta::num::without_turns;
use aspecta::paving::{Budget, Control};
use aspecta::robot::work::Stopwatch;
use aspecta::robot::{Robot, catalogue};
use std::collections::HashMap;
use std::f64::consts::TAU;
use std::sync::LazyLock;
use std::sync::atomic::AtomicBool;

fn analysis_of(name: &str, options: &Options) -> Analysis {
    let robot = catalogue::find(name).unwrap();
    let cancelled = AtomicBool::new(false);
    analyze(&robot, options, &Control { cancelled: &cancelled, progress: &|_| {} }).unwrap()
}

/// The 3-RRR in the mode `+++`.
static THREE_RRR: LazyLock<Analysis> =
    LazyLock::new(|| analysis_of("3-rrr", &Options { modes: vec!["+++".parse().unwrap()], ..to_depth(6) }));

fn to_depth(depth: u32) -> Options {
    Options { budget: Budget { depth: Some(depth), ..Budget::default() }, ..Options::default() }
}

fn class_of<'a>(analysis: &'a Analysis, mode: &str, sign: DetSign) -> (usize, &'a AspectClass) {
    let wanted = |c: &AspectClass| c.mode.to_string() == mode && c.det_a == sign;
    let class = analysis.classes.iter().position(wanted).unwrap();
    (class, &analysis.classes[class])
}

/// Every edge of a simplex is walked once in each direction, so the mesh has no rim: in two dimensions as many segments begin at a
/// vertex as end there.
fn assert_closed(boundary: &Boundary) {
    let mut balance: HashMap<(u32, u32), i32> = HashMap::new();
    for simplex in &boundary.simplices {
        let [a, b, c] = simplex.corners;
        if boundary.axes.len() == 2 {
            *balance.entry((a, a)).or_default() += 1;
            *balance.entry((b, b)).or_default() -= 1;
        } else {
            for (u, v) in [(a, b), (b, c), (c, a)] {
                *balance.entry((u.min(v), u.max(v))).or_default() += if u < v { 1 } else { -1 };
            }
        }
    }
    assert!(balance.values().all(|&b| b == 0), "{} open", balance.values().filter(|&&b| b != 0).count());
}

/// The crank's angle in the posture in which B_jj has this sign: elbow formula from lengths alone.
fn crank(a: [f64; 2], c: [f64; 2], l: f64, m: f64, sign: i8) -> f64 {
    let (x, y) = (c[0] - a[0], c[1] - a[1]);
    let d = x.hypot(y);
    let inner = ((l * l + d * d - m * m) / (2.0 * l * d)).clamp(-1.0, 1.0).acos();
    // B = L (sin θ (x − L cos θ) − cos θ (y − L sin θ)) = L d sin(θ − angle of AC).
    y.atan2(x) + f64::from(sign) * inner
}

#[test]
fn five_bar_boundaries_lie_where_they_say_and_enclose_the_aspects() {
    let analysis = analysis_of("five-bar", &Options::default());
    assert_eq!((analysis.aspects.low, analysis.aspects.certified), (10, true));
    let legs = [([0.0, 0.0], 8.0, 5.0), ([9.0, 0.0], 5.0, 8.0)];
    for class in &analysis.classes {
        for aspect in &class.aspects {
            let boundary = Boundary::new(&analysis, aspect.id, 300).unwrap();
            // Where two aspects of a class nearly touch, what parts them can be too thin to be found.
            assert!(boundary.unplaced <= 2, "aspect {}: {}", aspect.id, boundary.unplaced);
            // Slivers that are nowhere a cell wide.
            assert!(boundary.unassigned < 20, "aspect {}: {}", aspect.id, boundary.unassigned);
            assert_closed(&boundary);
            for vertex in boundary.vertices.iter().filter(|v| v.placed()) {
                let c = [vertex.pose[0], vertex.pose[1]];
                let spans = legs.map(|(a, _, _): ([f64; 2], f64, f64)| (c[0] - a[0]).hypot(c[1] - a[1]));
                for face in vertex.faces.iter().flatten() {
                    match *face {
                        Face::Of(Constraint::Reach(j)) => {
                            let (_, l, m) = legs[j.index()];
                            let gap = (spans[j.index()] - (l + m))
                                .abs()
                                .min((spans[j.index()] - (l - m).abs()).abs());
                            assert!(gap < 1e-7, "H_{j} at {c:?}: {gap}");
                        }
                        Face::Of(Constraint::Det) => {
                            let rods = [0, 1].map(|j| {
                                let (a, l, m) = legs[j];
                                let t: f64 = crank(a, c, l, m, class.mode.sign(j));
                                [(c[0] - a[0] - l * t.cos()) / m, (c[1] - a[1] - l * t.sin()) / m]
                            });
                            let sine = rods[0][0] * rods[1][1] - rods[1][0] * rods[0][1];
                            assert!(sine.abs() < 1e-6, "det A at {c:?}: {sine}");
                        }
                        other => panic!("the five-bar has no {other:?}"),
                    }
                }
                assert!(vertex.faces[0].is_some());
            }
            let area = boundary.simplices.iter().map(|s| {
                let [p, q] = [s.corners[0], s.corners[1]].map(|v| &boundary.vertices[v as usize].pose);
                0.5 * (p[0] * q[1] - p[1] * q[0])
            });
            let area: f64 = area.sum();
            // The polygon cuts off less than half a cell of the grid at each corner of the aspect, of which there are less than 20.
            let cell: f64 = analysis.window.ranges.iter().map(|(lo, hi)| (hi - lo) / 300.0).product();
            let (low, high) = (aspect.measure - 10.0 * cell, aspect.measure + class.undecided + 10.0 * cell);
            assert!((low..=high).contains(&area), "aspect {}: {area} is not in {low} … {high}", aspect.id);
        }
    }
}

#[test]
fn three_rrr_boundary_is_closed_and_lies_where_it_says() {
    let analysis = &*THREE_RRR;
    let (_, class) = class_of(analysis, "+++", DetSign::Positive);
    let boundary = Boundary::new(analysis, class.aspects[0].id, 30).unwrap();
    eprintln!(
        "3-rrr: {} aspects {:?}, {} vertices, {} triangles, {} unplaced, {} unassigned",
        class.aspects.len(),
        class.high,
        boundary.vertices.len(),
        boundary.simplices.len(),
        boundary.unplaced,
        boundary.unassigned
    );
    assert_closed(&boundary);
    assert!(boundary.unplaced * 1000 < boundary.vertices.len(), "{} unplaced", boundary.unplaced);
    let anchors = [[-10.0, -10.0], [10.0, -10.0], [0.0, 10.0]];
    let attachments = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0]];
    for vertex in boundary.vertices.iter().filter(|v| v.placed()) {
        let [x, y, phi] = [vertex.pose[0], vertex.pose[1], vertex.pose[2]];
        let (s, c) = f64::sin_cos(phi);
        let ends = attachments.map(|[u, v]: [f64; 2]| [x + c * u - s * v, y + s * u + c * v]);
        // Lines B_iC_i as (direction, moment about the origin): dependent where det A = 0.
        let lines: [[f64; 3]; 3] = std::array::from_fn(|j| {
            let t = crank(anchors[j], ends[j], 10.0, 10.0, 1);
            let u = [0, 1].map(|k| (ends[j][k] - anchors[j][k] - 10.0 * [t.cos(), t.sin()][k]) / 10.0);
            [u[0], u[1], (ends[j][0] * u[1] - ends[j][1] * u[0]) / 10.0]
        });
        for face in vertex.faces.iter().flatten() {
            match *face {
                Face::Of(Constraint::Reach(j)) => {
                    let span = (ends[j.index()][0] - anchors[j.index()][0])
                        .hypot(ends[j.index()][1] - anchors[j.index()][1]);
                    assert!((span - 20.0).abs().min(span) < 1e-6, "{span}");
                }
                Face::Of(Constraint::Det) => {
                    let [a, b, c] = lines;
                    let det = a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
                        + a[2] * (b[0] * c[1] - b[1] * c[0]);
                    assert!(det.abs() < 1e-5, "{det} at {:?} on {:?}", vertex.pose, vertex.faces);
                }
                other => panic!("no {other:?} here"),
            }
        }
    }
}

#[test]
fn bad_requests_say_what_would_do() {
    let analysis = analysis_of("five-bar", &to_depth(6));
    let error = Boundary::new(&analysis, AspectId::new(99), 20).unwrap_err();
    assert!(matches!(error, BoundaryError::NoSuchAspect { id, .. } if id == AspectId::new(99)));
    assert!(
        Boundary::new(&analysis, AspectId::new(1), 1).unwrap_err().to_string().contains("choose 4 to 2000")
    );
}

#[test]
fn the_five_bar_has_no_characteristic_curves() {
    // Its two direct solutions mirror each other in B1B2, so det A has opposite signs there.
    let analysis = analysis_of("five-bar", &Options::default());
    for aspect in analysis.classes.iter().flat_map(|class| &class.aspects) {
        let boundary = Boundary::new(&analysis, aspect.id, 200).unwrap();
        let surface = Characteristic::new(&analysis, &boundary).unwrap();
        assert_eq!((surface.vertices.len(), surface.given_up.unsolved), (0, 0), "aspect {}", aspect.id);
    }
}

/// Poses with every coordinate in widths of the window, and the way between them the short way round.
struct Scaled<'a>(&'a Analysis);

impl Scaled<'_> {
    fn way(&self, a: &[f64], b: &[f64]) -> [f64; 3] {
        let window = &self.0.window;
        std::array::from_fn(|k| {
            let gap = b[k] - a[k];
            let gap = if window.glued[k] { gap - TAU * (gap / TAU).round() } else { gap };
            gap / (window.ranges[k].1 - window.ranges[k].0)
        })
    }

    fn moved(&self, a: &[f64], by: [f64; 3]) -> Vec<f64> {
        let width = |k: usize| self.0.window.ranges[k].1 - self.0.window.ranges[k].0;
        (0..3).map(|k| a[k] + by[k] * width(k)).collect()
    }
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

/// Whether the segment ±d round the origin meets a triangle.
fn meets(triangle: &[[f64; 3]; 3], d: [f64; 3]) -> bool {
    let [p, q, r] = *triangle;
    let (u, v): ([f64; 3], [f64; 3]) =
        (std::array::from_fn(|k| q[k] - p[k]), std::array::from_fn(|k| r[k] - p[k]));
    let h = cross(d, v);
    let det = dot(u, h);
    let s = p.map(|x| -x);
    let (a, w) = (dot(s, h) / det, cross(s, u));
    let (b, t) = (dot(d, w) / det, dot(v, w) / det);
    a >= 0.0 && b >= 0.0 && a + b <= 1.0 && t.abs() <= 1.0
}

/// How many direct solutions of the joint vector of `pose` lie in the aspect, `pose` being one of them; `None` if it is not, or
/// the analysis does not tell. Undecided cells belong to the aspect if it is the only one known of its class.
fn sheets(analysis: &Analysis, class: ClassId, id: AspectId, pose: &[f64]) -> Option<usize> {
    let of = &analysis.classes[class.index()];
    let q = analysis.robot.inverse_in(pose, of.mode).unwrap()?;
    let (mut count, mut itself) = (0, false);
    for s in analysis.robot.direct(&q).unwrap() {
        let positive = s.det_a > 0.0;
        if s.mode != of.mode || positive != (of.det_a == DetSign::Positive) || !s.within_limits {
            continue;
        }
        match analysis.locate(&s.pose, class) {
            Place::Inside(found) if found != id => continue,
            Place::Inside(_) => {}
            _ if of.aspects.len() == 1 => {}
            _ => return None,
        }
        count += 1;
        itself |= Scaled(analysis).way(pose, &s.pose).iter().all(|x| x.abs() < 1e-7);
    }
    itself.then_some(count)
}

/// Segments that cross the surface once, away from its rim, change the number of direct solutions in the aspect by one.
/// Returns how many segments there were.
fn assert_crossings_change_the_number(
    analysis: &Analysis,
    class: ClassId,
    surface: &Characteristic,
    half: f64,
    apart: f64,
) -> usize {
    let scaled = Scaled(analysis);
    let pose = |v: u32| &surface.vertices[v as usize].pose[..];
    let mut uses: HashMap<(u32, u32), u32> = HashMap::new();
    for s in &surface.simplices {
        for (u, v) in [(0, 1), (1, 2), (2, 0)].map(|(i, j)| (s.corners[i], s.corners[j])) {
            *uses.entry((u.min(v), u.max(v))).or_default() += 1;
        }
    }
    let rim: Vec<u32> = uses.iter().filter(|(_, n)| **n == 1).flat_map(|((u, v), _)| [*u, *v]).collect();
    let mut seed = 7_u64;
    let (mut tested, mut wrong) = (0, 0);
    for _ in 0..2000 {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let s = &surface.simplices[(seed >> 33) as usize % surface.simplices.len()];
        let [a, b, c] = s.corners.map(pose);
        let (u, v) = (scaled.way(a, b), scaled.way(a, c));
        let normal = cross(u, v);
        let size = dot(normal, normal).sqrt();
        if size < 1e-9 {
            continue;
        }
        let centre = scaled.moved(a, std::array::from_fn(|k| (u[k] + v[k]) / 3.0));
        let near = |v: &u32| dot(scaled.way(&centre, pose(*v)), scaled.way(&centre, pose(*v))).sqrt() < apart;
        if rim.iter().any(near) {
            continue;
        }
        let long = normal.map(|x| 3.0 * half * x / size);
        let triangle = |s: &Simplex| s.corners.map(|v| scaled.way(&centre, pose(v)));
        if surface.simplices.iter().filter(|s| meets(&triangle(s), long)).count() != 1 {
            continue;
        }
        let ends = [1.0, -1.0].map(|t| scaled.moved(&centre, long.map(|x| t * x / 3.0)));
        let [Some(m), Some(n)] = ends.each_ref().map(|end| sheets(analysis, class, surface.aspect, end))
        else {
            continue;
        };
        if m.abs_diff(n) != 1 {
            eprintln!("{m} and {n} solutions at {ends:?}, across a piece from {:?}", s.face);
            wrong += 1;
        }
        tested += 1;
    }
    // Where a sheet bends within a cell, its mesh can be farther from it than the segment reaches.
    assert!(wrong * 50 <= tested, "{wrong} of {tested}");
    tested
}

#[test]
fn three_rrr_characteristic_surface() {
    let analysis = &*THREE_RRR;
    let (class, of) = class_of(analysis, "+++", DetSign::Positive);
    let boundary = Boundary::new(analysis, of.aspects[0].id, 30).unwrap();
    let start = Stopwatch::start();
    let surface = Characteristic::new(analysis, &boundary).unwrap();
    report(&surface, start);
    assert!(surface.simplices.len() > 1000 && surface.given_up.unlocated * 20 < surface.vertices.len());
    let anchors = [[-10.0, -10.0], [10.0, -10.0], [0.0, 10.0]];
    let attachments = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0]];
    let ends = |pose: &[f64]| {
        let (s, c) = f64::sin_cos(pose[2]);
        attachments.map(|[u, v]: [f64; 2]| [pose[0] + c * u - s * v, pose[1] + s * u + c * v])
    };
    for vertex in &surface.vertices {
        let source = &surface.sources[vertex.source as usize];
        assert!(source.placed());
        for j in 0..3 {
            // The cranks stand as at X'; the rod of X closes on them.
            let q = crank(anchors[j], ends(&vertex.pose)[j], 10.0, 10.0, 1);
            let c = ends(&source.pose)[j];
            let rod = (c[0] - anchors[j][0] - 10.0 * q.cos()).hypot(c[1] - anchors[j][1] - 10.0 * q.sin());
            assert!((rod - 10.0).abs() < 1e-7, "{rod} at {vertex:?} {source:?}");
        }
        assert_ne!(analysis.locate(&vertex.pose, ClassId::new(class)), Place::Outside);
    }
    let tested = assert_crossings_change_the_number(analysis, ClassId::new(class), &surface, 0.003, 0.05);
    eprintln!("{tested} crossings");
    assert!(tested >= 50, "{tested} crossings");
}

#[test]
fn three_rpr_characteristic_surface() {
    surface_of_the_three_rpr(DetSign::Positive);
}

#[test]
#[ignore = "half a minute: the other sign of det A"]
fn three_rpr_characteristic_surface_of_the_other_sign() {
    surface_of_the_three_rpr(DetSign::Negative);
}

fn surface_of_the_three_rpr(sign: DetSign) {
    let analysis = analysis_of("3-rpr", &to_depth(6));
    let (anchors, attachments) = (
        [[0.0, 0.0], [15.91, 0.0], [0.0, 10.0]],
        [[0.0, 0.0], [17.04, 0.0], [13.236_373_239_436_62, 16.096_708_466_836_508]],
    );
    let lengths = |pose: &[f64]| {
        let (s, c) = f64::sin_cos(pose[2]);
        let leg = |j: usize| {
            let (a, [u, v]): ([f64; 2], [f64; 2]) = (anchors[j], attachments[j]);
            (pose[0] + c * u - s * v - a[0]).hypot(pose[1] + s * u + c * v - a[1])
        };
        [leg(0), leg(1), leg(2)]
    };
    let (class, of) = class_of(&analysis, "---", sign);
    let boundary = Boundary::new(&analysis, of.aspects[0].id, 30).unwrap();
    assert_closed(&boundary);
    let start = Stopwatch::start();
    let surface = Characteristic::new(&analysis, &boundary).unwrap();
    eprintln!("{} aspects, at most {:?}, {} unplaced", of.low, of.high, boundary.unplaced);
    report(&surface, start);
    for vertex in &surface.vertices {
        let (q, of) = (lengths(&vertex.pose), lengths(&surface.sources[vertex.source as usize].pose));
        assert!((0..3).all(|j| (q[j] - of[j]).abs() < 1e-8), "{q:?} {of:?}");
    }
    let tested = assert_crossings_change_the_number(&analysis, ClassId::new(class), &surface, 0.003, 0.05);
    eprintln!("{tested} crossings");
    assert!(tested >= 50, "{tested} crossings");
}

/// Solutions are followed in turns, not in roll, pitch and yaw: along most of the boundary of a spherical robot's aspect.
#[test]
fn surfaces_of_a_spherical_robot_hang_together() {
    let robot = Robot::from_toml(include_str!("../fixtures/sphere.toml"), "sphere.toml").unwrap();
    let options = Options { modes: vec!["+++".parse().unwrap()], ..to_depth(5) };
    let analysis = analyze(&robot, &options, &Control::unwatched()).unwrap();
    let (_, class) = class_of(&analysis, "+++", DetSign::Negative);
    let boundary = Boundary::new(&analysis, class.aspects[0].id, 24).unwrap();
    let surface = Characteristic::new(&analysis, &boundary).unwrap();
    assert!(surface.simplices.len() > surface.given_up.unclear, "{:?}", surface.given_up);
    let mut tested = 0;
    for vertex in &surface.vertices {
        let source = &surface.sources[vertex.source as usize];
        // At a serial singularity a leg folds, and its inverse is there or not by rounding.
        if source.faces != [Some(Face::Of(Constraint::Det)), None, None] {
            continue;
        }
        let joints = |pose: &[f64]| robot.inverse_in(pose, class.mode).unwrap().unwrap();
        let (q, of) = (joints(&vertex.pose), joints(&source.pose));
        assert!((0..3).all(|j| without_turns(q[j] - of[j]).abs() < 1e-8), "{q:?} {of:?}");
        tested += 1;
    }
    assert!(tested > 1000, "{tested}");
}

fn report(surface: &Characteristic, start: Stopwatch) {
    eprintln!(
        "{} sources, {} vertices, {} simplices, {:?} in {:.2} s",
        surface.sources.len(),
        surface.vertices.len(),
        surface.simplices.len(),
        surface.given_up,
        start.seconds()
    );
}

#[test]
fn characteristic_surfaces_refuse_what_they_cannot_do() {
    let slice = analysis_of("3-rrr", &Options { fix: vec![(2, 0.0)], ..to_depth(5) });
    let id = slice.classes.iter().find_map(|c| c.aspects.first()).unwrap().id;
    let boundary = Boundary::new(&slice, id, 30).unwrap();
    assert_closed(&boundary);
    assert_eq!(Characteristic::new(&slice, &boundary).unwrap_err(), CharacteristicError::Slice);
}
