use super::equations::curvature_at;
use super::*;
use crate::robot::catalogue;

#[test]
fn second_derivatives_do_not_depend_on_the_configuration() {
    for name in ["3-rrr", "3-prr", "3-rpr", "spherical-3-rrr"] {
        let robot = Robot::resolve(name).unwrap();
        for leg in &robot.legs {
            let at = |d: [f64; 2], q: f64| curvature_at::<2>(leg, d, q).map(|row| row.map(Interval::mid));
            assert_eq!(at([0.0, 0.0], 1.0), at([3.0, -2.0], 2.5), "{name}");
        }
    }
}
