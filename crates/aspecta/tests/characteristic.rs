//! Boundaries of aspects and characteristic surfaces (Definition 9), judged by formulas and counts of their own.

use aspecta::aspect::{Analysis, AspectClass, DetSign, Options, analyze};
use aspecta::domain::boundary::{Boundary, BoundaryError, Face};
use aspecta::kinematics::modal::Constraint;
use aspecta::paving::{Budget, Control};
use aspecta::robot::catalogue;
use std::collections::HashMap;
use std::sync::atomic::AtomicBool;

fn analysis_of(name: &str, options: &Options) -> Analysis {
    let robot = catalogue::find(name).unwrap();
    let cancelled = AtomicBool::new(false);
    analyze(&robot, options, &Control { cancelled: &cancelled, progress: &|_| {} }).unwrap()
}

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
            assert_eq!((boundary.unplaced, boundary.unassigned), (0, 0), "aspect {}", aspect.id);
            assert_closed(&boundary);
            for vertex in &boundary.vertices {
                let c = [vertex.pose[0], vertex.pose[1]];
                let spans = legs.map(|(a, _, _): ([f64; 2], f64, f64)| (c[0] - a[0]).hypot(c[1] - a[1]));
                for face in vertex.faces.iter().flatten() {
                    match *face {
                        Face::Of(Constraint::Reach(j)) => {
                            let (_, l, m) = legs[j];
                            let gap = (spans[j] - (l + m)).abs().min((spans[j] - (l - m).abs()).abs());
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
            assert!(
                (aspect.measure..=aspect.measure + class.undecided).contains(&area),
                "aspect {}: {area} is not in {} + {}", aspect.id, aspect.measure, class.undecided
            );
        }
    }
}

#[test]
fn three_rrr_boundary_is_closed_and_lies_where_it_says() {
    let analysis = analysis_of("3-rrr", &to_depth(6));
    let (_, class) = class_of(&analysis, "+++", DetSign::Positive);
    let boundary = Boundary::new(&analysis, class.aspects[0].id, 40).unwrap();
    eprintln!(
        "3-rrr: {} aspects {:?}, {} vertices, {} triangles, {} unplaced, {} unassigned",
        class.aspects.len(), class.high, boundary.vertices.len(), boundary.simplices.len(), boundary.unplaced,
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
                    let span = (ends[j][0] - anchors[j][0]).hypot(ends[j][1] - anchors[j][1]);
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
    let error = Boundary::new(&analysis, 99, 20).unwrap_err();
    assert!(matches!(error, BoundaryError::NoSuchAspect { id: 99, .. }));
    assert!(Boundary::new(&analysis, 1, 1).unwrap_err().to_string().contains("choose 4 to 2000"));
}
