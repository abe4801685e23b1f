use super::equations::curvature;
use super::*;
use std::sync::atomic::AtomicBool;

#[test]
fn second_derivatives_do_not_depend_on_the_configuration() {
    fn check<const D: usize>(robot: &Robot, d: [f64; D]) {
        for leg in &robot.legs {
            let at = |d: [f64; D], q: f64| curvature::<D>(leg, d, q).map(|row| row.map(Interval::mid));
            assert_eq!(at([0.0; D], 1.0), at(d, 2.5), "{}", robot.name);
        }
    }
    for name in ["3-rrr", "3-prr", "3-rpr"] {
        check(&Robot::resolve(name).unwrap(), [3.0, -2.0]);
    }
    for name in ["delta", "linear-delta", "spherical-3-rrr", "gough-stewart"] {
        check(&Robot::resolve(name).unwrap(), [3.0, -2.0, 0.5]);
    }
}

/// The intervals prove by themselves what the degree of the direct problem says.
#[test]
fn the_search_proves_that_the_five_bar_has_no_cusp() {
    let robot = Robot::resolve("five-bar").unwrap();
    let control = Control { cancelled: &AtomicBool::new(false), progress: &|_| {} };
    for mode in robot.working_modes() {
        let system = System::<2>::new(&robot, Chart::Pose, mode, None);
        let search = Search::<2, 2> { window: robot.slice(&[]).unwrap(), system, elsewhere: &[] };
        let findings = search.run(100_000, &control);
        assert!(findings.found.is_empty() && findings.doubts.is_empty() && findings.boxes > 1, "{mode}");
    }
}
