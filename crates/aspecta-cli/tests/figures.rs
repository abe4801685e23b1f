//! Figures are well-formed, deterministic and true to the robot.

use aspecta::aspect::{ModeReport, Reachable, Sample};
use aspecta::robot::{Leg, Platform, Robot};
use aspecta_cli::figure;

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

fn modes(robot: &Robot, pose: &[f64]) -> Vec<ModeReport> {
    let all = robot.working_modes().into_iter().enumerate();
    all.map(|(k, mode)| ModeReport {
        number: k + 1,
        mode,
        reachable: Reachable::Yes,
        sample: robot.inverse_in(pose, mode).unwrap().map(|q| Sample { pose: pose.to_vec(), q }),
    })
    .collect()
}

/// Parses the figure and, if `ASPECTA_FIGURES` names a directory, leaves it there to look at.
fn check(name: &str, svg: &str) {
    let document = roxmltree::Document::parse(svg).unwrap();
    assert_eq!(document.root_element().tag_name().name(), "svg");
    assert!(!svg.contains("NaN") && !svg.contains("inf"), "{name}");
    if let Ok(dir) = std::env::var("ASPECTA_FIGURES") {
        std::fs::write(std::path::Path::new(&dir).join(format!("{name}.svg")), svg).unwrap();
    }
}

#[test]
fn robots_and_postures_are_well_formed() {
    for (robot, pose) in [(five_bar(), vec![4.0, 7.0]), (three_rrr(), vec![-5.0, -2.0, 0.3])] {
        let modes = modes(&robot, &pose);
        check(&robot.name, &figure::robot::robot(&robot, modes[0].sample.as_ref().unwrap()));
        check(&format!("{}-postures", robot.name), &figure::robot::postures(&robot, &modes));
    }
}

use aspecta::aspect::{Aspect, AspectClass, Cell, DetSign};
use aspecta_cli::figure::barrier::Barriers;

/// A stand-in for an analysis: uniform cells, judged at their corners.
fn classes(robot: &Robot, side: usize) -> (Vec<AspectClass>, Vec<Vec<Cell>>) {
    let window = robot.workspace_window().unwrap();
    let mut classes = Vec::new();
    let mut all = Vec::new();
    for mode in robot.working_modes() {
        for det_a in [DetSign::Positive, DetSign::Negative] {
            let at = |k: usize, i: usize| {
                window.ranges[k].0 + (window.ranges[k].1 - window.ranges[k].0) * i as f64 / side as f64
            };
            let inside = |i: usize, j: usize| {
                let b = Barriers::at(robot, mode, &[at(0, i), at(1, j)]);
                (b.det > 0.0) == (det_a == DetSign::Positive) && b.margins.iter().all(|m| m.1 > 0.0)
            };
            let id = classes.len() + 1;
            let mut cells = Vec::new();
            for (i, j) in (0..side * side).map(|k| (k % side, k / side)) {
                let n = [(i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1)]
                    .iter()
                    .filter(|c| inside(c.0, c.1))
                    .count();
                if n > 0 {
                    cells.push(Cell {
                        lo: [at(0, i), at(1, j), 0.0],
                        hi: [at(0, i + 1), at(1, j + 1), 0.0],
                        aspect: (n == 4).then_some(id),
                    });
                }
            }
            let c = cells.iter().find(|c| c.aspect.is_some()).unwrap();
            let pose = vec![0.5 * (c.lo[0] + c.hi[0]), 0.5 * (c.lo[1] + c.hi[1])];
            let q = robot.inverse_in(&pose, mode).unwrap().unwrap();
            let aspect = Aspect {
                id,
                measure: 1.0,
                pieces: 1,
                sample: Sample { pose, q },
                w_bounds: vec![],
                q_bounds: vec![(-3.0, 3.0); 2],
            };
            classes.push(AspectClass {
                mode,
                det_a,
                low: 1,
                high: None,
                measure: 1.0,
                undecided: 0.0,
                aspects: vec![aspect],
            });
            all.push(cells);
        }
    }
    (classes, all)
}

#[test]
fn maps_of_the_five_bar() {
    let robot = five_bar();
    let (classes, cells) = classes(&robot, 256);
    let window = robot.workspace_window().unwrap();
    let survey = figure::survey::Survey::new(&robot, &window, 256, &classes, &cells);
    check("figure9", &figure::maps::figure_9(&survey));
    check("class", &figure::maps::class(&survey, classes[0].mode, classes[0].det_a));
    check("parallel", &figure::maps::parallel_aspects(&survey));
    check("serial", &figure::maps::serial_aspects(&survey));
}
