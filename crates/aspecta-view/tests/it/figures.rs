//! Figures are well-formed and true to the robot.

use crate::common::{analysis, five_bar, three_rrr};
use aspecta::Kinematics;
use aspecta::aspect::{AspectId, Cell, ClassId, DetSign, ModeReport, Reachable};
use aspecta::robot::{Robot, catalogue};
use aspecta_view::figure::axes::Axis;
use aspecta_view::figure::barrier::{Barriers, Kind, contacts};
use aspecta_view::figure::curves::{Curve, Plane, Sheet};
use aspecta_view::figure::level::{Grid, contours, simplify};
use aspecta_view::figure::raster::{Label, Raster};
use aspecta_view::figure::{image, robot, survey};
use std::f64::consts::PI;

const PLANE: [f64; 2] = [0.0, 0.0];

fn curves(robot: &Robot, mode: &str) -> Vec<Curve> {
    let plane = Plane { through: PLANE.to_vec(), axes: [0, 1] };
    let sheet = Sheet { robot, mode: mode.parse().unwrap(), plane: &plane };
    sheet.curves(&Grid { x: (-4.0, 13.0), y: (-13.0, 13.0), n: 200 })
}

/// A circle that the grid does not favour.
#[test]
fn contours_lie_on_the_curve() {
    let f = |p: [f64; 2]| (p[0] - 0.1).powi(2) + (p[1] + 0.2).powi(2) - 0.49;
    let grid = Grid { x: (-1.0, 1.0), y: (-1.0, 1.0), n: 37 };
    let lines = contours(&grid, &grid.sample(f), f);
    assert_eq!(lines.len(), 1);
    assert_eq!(lines[0].first(), lines[0].last());
    assert!(lines[0].len() > 100);
    for p in &lines[0] {
        assert!(((p[0] - 0.1).hypot(p[1] + 0.2) - 0.7).abs() < 1e-14);
    }
    let fewer = simplify(&lines[0], 1e-2);
    assert!(fewer.len() < 40 && fewer.iter().all(|p| lines[0].contains(p)));
}

/// A saddle: the two branches of a hyperbola are not joined.
#[test]
fn contours_keep_branches_apart() {
    let f = |p: [f64; 2]| p[0] * p[1] - 1e-3;
    let grid = Grid { x: (-1.0, 1.0), y: (-1.0, 1.0), n: 5 };
    let lines = contours(&grid, &grid.sample(f), f);
    assert_eq!(lines.len(), 2);
    for line in lines {
        assert!(line.iter().all(|p| (p[0] > 0.0) == (line[0][0] > 0.0)));
    }
}

/// Where legs do not reach, margins of contacts may be no numbers; where they do, all kinds of curves are there.
#[test]
fn curves_of_a_body_with_contacts() {
    let file = include_str!("../../../../examples/3-rrr-plate.toml");
    let robot = Robot::from_toml(file, "3-rrr-plate.toml").unwrap();
    let plane = Plane { through: vec![0.0, 0.0, 0.1], axes: [0, 1] };
    let sheet = Sheet { robot: &robot, mode: "+-+".parse().unwrap(), plane: &plane };
    let found = sheet.curves(&Grid { x: (-20.0, 20.0), y: (-20.0, 20.0), n: 200 });
    let count = |fits: &dyn Fn(Kind) -> bool| found.iter().filter(|curve| fits(curve.kind)).count();
    let contacts = count(&|kind| matches!(kind, Kind::Contact(_)));
    assert!(
        contacts > 10 && count(&|kind| kind == Kind::Serial) > 2 && count(&|kind| kind == Kind::Parallel) > 2
    );
}

/// Each curve of a contact is told from the others, and lies where that contact is: of two rods that end in one joint, which both touch a wall there,
/// neither hides the other.
#[test]
fn contacts_are_told_apart() {
    let entry = catalogue::all().iter().find(|entry| entry.name == "five-bar").unwrap();
    let tables = "[bodies]\nradius = 0.3\n[[obstacles]]\nends = [[8, 9], [13, 9]]\nradius = 0.2\n";
    let robot = Robot::from_toml(&format!("{}\n{tables}", entry.text), "cell.toml").unwrap();
    let named: Vec<String> = contacts(&robot).map(|contact| contact.named(&robot)).collect();
    let find = |name: &str| named.iter().position(|found| found == name).unwrap();
    let found = curves(&robot, "+-");
    let on_top = |number: usize| {
        let of = found.iter().filter(|curve| curve.kind == Kind::Contact(number));
        of.flat_map(|curve| &curve.points).filter(|p| (p[1] - 8.5).abs() < 1e-9).count()
    };
    for rod in ["contact of rod of leg 1 and obstacle 1", "contact of rod of leg 2 and obstacle 1"] {
        assert!(on_top(find(rod)) > 5, "{rod}: its end touches the bar from below");
    }
    // Cranks touch where the distance of their ends says.
    let cranks = find("contact of crank of leg 1 and crank of leg 2");
    for curve in found.iter().filter(|curve| curve.kind == Kind::Contact(cranks)) {
        for p in &curve.points {
            let margins = Barriers::at(&robot, "+-".parse().unwrap(), p).margins;
            let margin = margins.iter().find(|margin| margin.0 == curve.kind).unwrap();
            assert!(margin.1.abs() < 1e-9, "{p:?}");
        }
    }
    let analysis = analysis(&robot, 5);
    let directory = tempfile::tempdir().unwrap();
    aspecta_view::report::write(&analysis, directory.path()).unwrap();
    let figure = std::fs::read_to_string(directory.path().join("figures/aspects-mf2-positive.svg")).unwrap();
    assert!(figure.contains("contact of crank of leg 1 and rod of leg 2"), "{figure}");
    assert!(!figure.contains("joint limit"));
}

/// Serial singularities are the circles |A_iC| = L + M and |L − M|; at parallel ones B1, C and B2 are in line.
#[test]
fn singular_curves_of_the_five_bar() {
    let robot = five_bar();
    for mode in ["++", "+-", "-+", "--"] {
        let found = curves(&robot, mode);
        for kind in [Kind::Serial, Kind::Parallel] {
            assert!(found.iter().any(|c| c.kind == kind), "{mode} {kind:?}");
        }
        for curve in &found {
            for &[x, y] in &curve.points {
                let r = [x.hypot(y), (x - 9.0).hypot(y)];
                assert!(r.iter().all(|r| (3.0 - 1e-9..=13.0 + 1e-9).contains(r)), "beyond reach: {x} {y}");
                if curve.kind == Kind::Serial {
                    let off =
                        r.iter().flat_map(|r| [(r - 3.0).abs(), (r - 13.0).abs()]).fold(f64::MAX, f64::min);
                    assert!(off < 1e-9, "{mode}: {off:e} from the circles at {x} {y}");
                } else {
                    let q = Barriers::at(&robot, mode.parse().unwrap(), &[x, y]).q;
                    let to_b1 = [8.0 * q[0].cos() - x, 8.0 * q[0].sin() - y];
                    let to_b2 = [9.0 + 5.0 * q[1].cos() - x, 5.0 * q[1].sin() - y];
                    let sine = (to_b1[0] * to_b2[1] - to_b1[1] * to_b2[0]) / 40.0;
                    assert!(sine.abs() < 1e-7, "{mode}: sine {sine:e} at {x} {y}");
                }
            }
        }
    }
}

/// The image of a curve is continuous, also where angles pass π and where a curve ends on a serial singularity.
#[test]
fn images_of_curves_are_continuous() {
    let robot = five_bar();
    let plane = Plane { through: PLANE.to_vec(), axes: [0, 1] };
    let sheet = Sheet { robot: &robot, mode: "+-".parse().unwrap(), plane: &plane };
    let mut beyond = false;
    for curve in curves(&robot, "+-") {
        let images = sheet.images(&curve, &[0.03; 2]);
        assert!(images.len() == 1, "this five-bar has no leg that can fold");
        for pair in images[0].1.windows(2) {
            assert!((0..2).all(|k| (pair[0][k] - pair[1][k]).abs() < 0.06), "{pair:?}");
        }
        beyond |= images[0].1.iter().flatten().any(|q| q.abs() > PI);
    }
    assert!(beyond, "no curve of this mode passes π: the test tests nothing");
}

/// Where C comes to lie on A2 the second leg is folded and its crank free: a serial singularity, which no line of det A = 0
/// crosses.
#[test]
fn folds_are_not_drawn_as_parallel_singularities() {
    let robot = catalogue::find("symmetric-five-bar").unwrap();
    let window = robot.slice(&[]).unwrap();
    let plane = Plane { through: vec![0.0; 2], axes: [0, 1] };
    let mut folds = 0;
    for mode in robot.working_modes() {
        let sheet = Sheet { robot: &robot, mode, plane: &plane };
        let grid = Grid { x: window.ranges[0], y: window.ranges[1], n: 200 };
        for (kind, line) in sheet.curves(&grid).iter().flat_map(|curve| sheet.images(curve, &[0.03; 2])) {
            let is_wide = |pair: &[Vec<f64>]| (0..2).any(|k| (pair[0][k] - pair[1][k]).abs() > 0.06);
            let wide = line.windows(2).filter(|pair| is_wide(pair)).count();
            assert!(wide == 0 || (kind, line.len()) == (Kind::Serial, 2), "{mode}: {kind:?} {line:?}");
            folds += wide;
        }
    }
    assert!(folds > 0, "no curve passes a fold: the test tests nothing");
}

/// A cell whose q1 passes π appears at both edges of Q, and nowhere between.
#[test]
fn images_wrap_round() {
    let robot = five_bar();
    let mode = "++".parse().unwrap();
    let pose = (0..400)
        .map(|k| [0.02 * k as f64 - 3.5, 4.0])
        .find(|p| {
            let b = Barriers::at(&robot, mode, p);
            let next = Barriers::at(&robot, mode, &[p[0] + 0.02, p[1]]);
            b.margins.iter().chain(&next.margins).all(|m| m.1 > 1.0)
                && (0..2).any(|k| (b.q[k] - next.q[k]).abs() > PI)
        })
        .unwrap();
    let cell =
        Cell { lo: [pose[0] - 0.1, 3.9, 0.0], hi: [pose[0] + 0.1, 4.1, 0.0], aspect: Some(AspectId::new(1)) };
    let plane = Plane { through: PLANE.to_vec(), axes: [0, 1] };
    let sheet = Sheet { robot: &robot, mode, plane: &plane };
    let axis = Axis { label: String::new(), range: (-PI, PI), angle: true };
    let raster = image::image(&sheet, DetSign::Positive, &[cell], &[axis.clone(), axis], 200);
    let drawn: Vec<(usize, usize)> = (0..40_000)
        .map(|k| (k % 200, k / 200))
        .filter(|&(c, r)| raster.at(c, r) == Label::Aspect(AspectId::new(1)))
        .collect();
    let line = |axis: usize| drawn.iter().map(move |p| if axis == 0 { p.0 } else { p.1 });
    let wraps = |axis: usize| {
        line(axis).any(|v| v == 0) && line(axis).any(|v| v == 199) && !line(axis).any(|v| v == 100)
    };
    assert!(wraps(0) || wraps(1), "{drawn:?}");
    assert!(drawn.len() < 400);
}

/// Every inner cell's configuration is found again in W and in Q under its aspect's number.
#[test]
fn maps_agree_with_the_analysis() {
    let robot = five_bar();
    let analysis = analysis(&robot, 7);
    let cells: Vec<_> = (0..analysis.classes.len()).map(|k| analysis.cells(ClassId::new(k))).collect();
    let survey = survey::Survey::new(&analysis, &cells, 128);
    for (map, cells) in survey.classes.iter().zip(&cells) {
        for cell in cells.iter().filter(|c| c.aspect.is_some()) {
            let pose = [0.5 * (cell.lo[0] + cell.hi[0]), 0.5 * (cell.lo[1] + cell.hi[1])];
            let q = robot.inverse_in(&pose, map.class.mode).unwrap().unwrap();
            let label = Label::Aspect(cell.aspect.unwrap());
            assert_eq!(at(&map.w, &survey.pose_axes, &pose), label);
            let (image, axes) = (map.q.as_ref().unwrap(), survey.joint_axes.as_ref().unwrap());
            assert_eq!(at(image, axes, &q), label, "{pose:?} {q:?}");
        }
    }
}

fn at(raster: &Raster<Label>, axes: &[Axis; 2], p: &[f64]) -> Label {
    let n = [raster.size().0, raster.size().1];
    let pixel = [0, 1].map(|k| ((p[k] - axes[k].range.0) / axes[k].span() * n[k] as f64) as usize);
    raster.at(pixel[0].min(n[0] - 1), pixel[1].min(n[1] - 1))
}

/// Outlines enclose exactly their pixels: the signed areas of the loops sum to the number of pixels.
#[test]
fn outlines_enclose_their_pixels() {
    let hash = |c: usize, r: usize| (c * 7 + r * 13 + c * r * 5) % 11;
    let raster = Raster::from_fn(23, 17, |c, r| hash(c, r) < 4);
    let pixels = (0..23 * 17).filter(|k| raster.at(k % 23, k / 23)).count() as i64;
    let d = raster.outline(true);
    let mut area = 0;
    for outline in d.split_terminator('z') {
        let spaced = outline.replace('h', " h ").replace('v', " v ").replace('M', " ");
        let mut words = spaced.split_whitespace();
        let mut number = || words.next().and_then(|w| w.parse::<i64>().ok());
        let (Some(mut x), Some(mut y)) = (number(), number()) else { panic!("{outline}") };
        let start = (x, y);
        while let Some(command) = words.next() {
            let run: i64 = words.next().unwrap().parse().unwrap();
            if command == "h" {
                area -= run * y;
                x += run;
            } else {
                y += run;
            }
        }
        assert_eq!((x, y), start, "an outline closes");
    }
    assert_eq!(area, pixels);
}

#[test]
fn ticks_are_round() {
    let texts = |axis: Axis, pixels| axis.ticks(pixels).into_iter().map(|t| t.1).collect::<Vec<_>>();
    let axis = |lo, hi, angle| Axis { label: String::new(), range: (lo, hi), angle };
    assert_eq!(texts(axis(-PI, PI, true), 225.0), ["−π", "−π/2", "0", "π/2", "π"]);
    assert_eq!(texts(axis(-4.0, 13.0, false), 150.0), ["0", "10"]);
    assert_eq!(texts(axis(-0.004, 0.013, false), 150.0), ["0.00", "0.01"].map(|t| t.replace("0.00", "0")));
    assert_eq!(texts(axis(0.0, 0.5, true), 100.0), ["0", "0.5"]);
}

/// Unreachable modes are said to be so.
#[test]
fn postures_name_unreachable_modes() {
    for robot in [five_bar(), three_rrr()] {
        let modes = robot.working_modes().into_iter().enumerate();
        let modes: Vec<ModeReport> = modes
            .map(|(k, mode)| ModeReport { number: k + 1, mode, reachable: Reachable::No, sample: None })
            .collect();
        let svg = robot::postures(&robot, &modes);
        assert!(roxmltree::Document::parse(&svg).is_ok());
        assert_eq!(svg.matches("not reachable (proved)").count(), modes.len());
    }
}
