//! How far a configuration is from the singularities.

use super::LegAt;
use super::limit::rod_length;
use crate::homogeneous::Homogeneous;
use crate::modal::{LegClosure, ModalRows, closures};
use crate::placement::Placement;
use aspecta_robot::Robot;
use aspecta_robot::WorkingMode;
use aspecta_robot::num::{Interval, Scalar, each};
use serde::{Deserialize, Serialize};

/// How far configurations must stay from the singularities. Neither measure has a unit, and neither changes
/// when the robot is moved, scaled or its legs are renumbered.
///
/// - *parallel*: |det Â| ≥ `parallel`, Â being A with moments divided by the
///   [characteristic length](Robot::characteristic_length) (unless the platform only turns) and then every row
///   by its norm. 0 at a parallel singularity, at most 1.
/// - *serial*: |B_jj| / max |B_jj| ≥ `serial` for every leg j:
///   [`State::serial_measures`](crate::State::serial_measures). 0 at a serial singularity, at most 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Margins {
    /// The least |det Â|.
    pub parallel: f64,
    /// The least |B_jj| / max |B_jj|.
    pub serial: f64,
}

impl Margins {
    /// Whether they ask for anything.
    pub fn are_any(&self) -> bool {
        *self != Self::default()
    }
}

/// The measures of [`Margins`] at a pose where all legs close: det Â with the sign of det A, and |B_jj| / max
/// |B_jj| per leg, 1 for struts.
pub fn measures<T: Scalar, const D: usize, const N: usize>(
    robot: &Robot,
    placement: &Placement<T, D>,
    mode: WorkingMode,
) -> (T, [T; N]) {
    let legs = closures::<T, D, N>(robot, placement);
    let heights: [T; N] = each!(|j| legs[j].closure.reach.sqrt());
    let rows = ModalRows::<T, N>::new(robot, &legs, &heights);
    let parallel = rows.det(mode) / unit_of_det(robot, &legs, &rows, mode);
    let one = T::constant(Interval::point(1.0));
    let serial = each!(|j| match robot.legs[j].actuator.greatest_reach() {
        Some(most) => (legs[j].closure.reach / T::constant(most)).sqrt(),
        None => one,
    });
    (parallel, serial)
}

/// The H_j at which |B_jj| / max |B_jj| is `least`.
pub(super) fn least_reach(robot: &Robot, j: usize, least: f64) -> Interval {
    let most = robot.legs[j].actuator.greatest_reach().unwrap_or(Interval::point(0.0));
    most * Interval::point(least).square()
}

/// Returns the divisor that makes the weighted det A into det Â.
pub(super) fn unit_of_det<T: Scalar, const D: usize, const N: usize>(
    robot: &Robot,
    legs: &[LegClosure<T, D>; N],
    rows: &ModalRows<T, N>,
    mode: WorkingMode,
) -> T {
    let homogeneous = Homogeneous::of(robot);
    let norm =
        |(j, at)| homogeneous.norm(rod_length(&LegAt::of(&robot.legs[j], at)), &rows.row(j, mode.sign(j)));
    let unit = T::constant(homogeneous.unit_of_moments());
    legs.iter().enumerate().map(norm).fold(unit, |unit, norm| unit * norm)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Kinematics;
    use crate::for_platform;
    use aspecta_robot::catalogue;

    fn measured(robot: &Robot, pose: &[f64], mode: WorkingMode) -> (f64, Vec<f64>) {
        fn of<const D: usize, const N: usize>(
            robot: &Robot,
            x: &[f64],
            mode: WorkingMode,
        ) -> (f64, Vec<f64>) {
            let (parallel, serial) = measures::<f64, D, N>(robot, &Placement::at(robot.platform, x), mode);
            (parallel, serial.to_vec())
        }
        for_platform!(robot.platform, of(robot, pose, mode))
    }

    /// The measures are those of the state: det Â is the determinant of its homogeneous A.
    #[test]
    fn measures_are_those_of_the_state() {
        for robot in catalogue::all().iter().map(|entry| catalogue::find(entry.name).unwrap()) {
            let n = robot.dof();
            let ranges = robot.workspace_window().map_or(Vec::new(), |window| window.ranges);
            let mut compared = 0;
            for i in 0..2000 {
                // Low-discrepancy poses.
                let pose: Vec<f64> = (0..n)
                    .map(|k| {
                        let share =
                            (f64::from(i) * [0.7549, 0.5698, 0.4302, 0.8192, 0.6711, 0.5497][k]).fract();
                        let (lo, hi) = ranges.get(k).copied().unwrap_or((-0.4, 0.4));
                        lo + share * (hi - lo)
                    })
                    .collect();
                for solution in robot.inverse(&pose).unwrap() {
                    let (parallel, serial) = measured(&robot, &pose, solution.mode);
                    let state = robot.state(&pose, &solution.q).unwrap();
                    let exact = Homogeneous::of(&robot).matrix(&state.a).determinant();
                    assert!((parallel - exact).abs() < 1e-7, "{}: {parallel} {exact}", robot.name);
                    assert!(exact.abs() <= 1.0 + 1e-12, "{}: {exact}", robot.name);
                    for (a, b) in serial.iter().zip(&state.serial_measures) {
                        assert!(
                            (a - b).abs() < 1e-6,
                            "{}: {serial:?} {:?}",
                            robot.name,
                            state.serial_measures
                        );
                    }
                    compared += 1;
                }
            }
            assert!(compared > 0, "{}: no pose was reached", robot.name);
        }
    }
}
