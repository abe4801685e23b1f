//! Figures are well-formed, deterministic and true to the robot.

use aspecta::aspect::{ModeReport, Reachable, Sample};
use aspecta::robot::{Leg, Platform, Robot};
use aspecta_cli::figure;

fn five_bar() -> Robot {
    let legs =
        vec![Leg::revolute([0.0, 0.0], [0.0, 0.0], 8.0, 5.0), Leg::revolute([9.0, 0.0], [0.0, 0.0], 5.0, 8.0)];
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
