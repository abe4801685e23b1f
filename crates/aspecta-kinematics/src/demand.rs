//! What is asked of a configuration: to lie in an aspect, and if wanted well away from its singularities.

use super::WorkingMode;
use super::limits::{margin, rod_length};
use super::modal::{Constraint, LegClosure, ModalRows, closures};
use super::placement::Placement;
use aspecta_robot::num::{Interval, Scalar, dot, each};
use aspecta_robot::{Platform, Robot};
use serde::{Deserialize, Serialize};

/// How far configurations must stay from the singularities. Neither measure has a unit, and neither changes when the robot is moved,
/// scaled or its legs are renumbered.
///
/// - *parallel*: |det Â| ≥ `parallel`, Â being A with every row divided by the force along its rod and moments by the
///   [characteristic length](Robot::characteristic_length) (for a platform that only turns, every row by its norm). 0 at a parallel
///   singularity, at most 1 for platforms that do not turn.
/// - *serial*: |B_jj| / max |B_jj| ≥ `serial` for every leg j: [`super::State::serial_measures`]. 0 at a serial singularity, at most 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Margins {
    /// Of |det Â|.
    pub parallel: f64,
    /// Of |B_jj| / max |B_jj|.
    pub serial: f64,
}

impl Margins {
    /// Whether they ask for anything.
    pub fn are_any(&self) -> bool {
        *self != Self::default()
    }
}

/// What is asked of the configurations of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Demand {
    /// The working mode.
    pub mode: WorkingMode,
    /// The sign of det A: +1 or −1.
    pub sign: i8,
    /// What they stay away from singularities.
    pub margins: Margins,
    /// A leg (from 0) that may come to its serial singularity: all else is asked of both its postures, wherever they exist and where they
    /// meet.
    pub crossing: Option<usize>,
}

impl Demand {
    /// To lie in S_{s,σ}, however near its boundary.
    pub fn class(mode: WorkingMode, sign: i8) -> Self {
        Self { mode, sign, margins: Margins::default(), crossing: None }
    }
}

/// Visits, at one pose, functions that are all positive there if and only if the demand is met: with no margins and no crossing they are
/// those whose common positivity region is S_{s,σ} — H_j, c_k and σ det A (times the weights). `visit` returns whether to go on.
pub fn demands<T: Scalar, const D: usize, const N: usize>(
    robot: &Robot,
    placement: &Placement<T, D>,
    demand: &Demand,
    visit: impl FnMut(Constraint, T) -> bool,
) {
    demands_of(robot, placement, &closures::<T, D, N>(robot, placement), demand, visit);
}

/// [`demands`] with the legs as a chart has them; where it is a leg's own, s B_jj stands for H_j.
pub fn demands_of<T: Scalar, const D: usize, const N: usize>(
    robot: &Robot,
    placement: &Placement<T, D>,
    legs: &[LegClosure<T, D>; N],
    demand: &Demand,
    mut visit: impl FnMut(Constraint, T) -> bool,
) {
    for (j, at) in legs.iter().enumerate() {
        if let Some(fold) = &at.fold {
            let b = if demand.mode.sign(j) > 0 { fold.b } else { -fold.b };
            if !visit(Constraint::Reach(j), b) {
                return;
            }
        } else if robot.legs[j].actuator.postures() == 2 {
            let reach = at.closure.reach;
            let least = if demand.crossing == Some(j) { 0.0 } else { demand.margins.serial };
            let reach = if least > 0.0 { reach - T::constant(least_reach(robot, j, least)) } else { reach };
            if !visit(Constraint::Reach(j), reach) {
                return;
            }
        }
    }
    let heights: [[T; 2]; N] = std::array::from_fn(|j| legs[j].heights());
    let rows = ModalRows::<T, N>::new(robot, legs, &each!(|j| heights[j][0]));
    let other = demand.crossing.map(|j| demand.mode.with_other_posture(j));
    for mode in std::iter::once(demand.mode).chain(other) {
        for (j, at) in legs.iter().enumerate() {
            let leg = &robot.legs[j];
            let sh = heights[j][usize::from(mode.sign(j) < 0)];
            let at = at.limited(leg);
            for (k, limit) in leg.limits.iter().enumerate() {
                if !visit(Constraint::Limit(j, k), margin(limit, &at, sh, placement)) {
                    return;
                }
            }
        }
        let det = rows.det(mode);
        let mut det = if demand.sign > 0 { det } else { -det };
        if demand.margins.parallel > 0.0 {
            let unit = unit_of_det(robot, legs, &rows, mode);
            det = det - unit.scale(Interval::point(demand.margins.parallel));
        }
        if !visit(Constraint::Det, det) {
            return;
        }
    }
}

/// The measures of [`Margins`] at a pose where all legs close: det Â with the sign of det A, and |B_jj| / max |B_jj| per leg, 1 for struts.
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
fn least_reach(robot: &Robot, j: usize, least: f64) -> Interval {
    let most = robot.legs[j].actuator.greatest_reach().unwrap_or(Interval::point(0.0));
    most * Interval::point(least).square()
}

/// What the weighted det A is a multiple of: divided by it, it is det Â.
fn unit_of_det<T: Scalar, const D: usize, const N: usize>(
    robot: &Robot,
    legs: &[LegClosure<T, D>; N],
    rows: &ModalRows<T, N>,
    mode: WorkingMode,
) -> T {
    let mut unit = T::constant(unit_of_moments(robot));
    for (j, at) in legs.iter().enumerate() {
        let force = if robot.platform == Platform::TurningBody {
            let row = rows.row(j, mode.sign(j));
            dot(&row, &row).sqrt()
        } else {
            rod_length(&at.limited(&robot.legs[j]))
        };
        unit = unit * force;
    }
    unit
}

/// What det A of a robot whose rods bear unit forces is divided by for its moments: the characteristic length once for each angle, unless the
/// platform only turns.
pub fn unit_of_moments(robot: &Robot) -> Interval {
    let turning = robot.platform == Platform::TurningBody;
    let angles = robot.platform.coordinates().iter().filter(|c| c.angle).count();
    let length = Interval::point(robot.characteristic_length());
    (0..if turning { 0 } else { angles }).fold(Interval::point(1.0), |unit, _| unit * length)
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
                    let exact = crate::singularity::homogeneous(&robot, &state.a).determinant();
                    assert!((parallel - exact).abs() < 1e-7, "{}: {parallel} {exact}", robot.name);
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
