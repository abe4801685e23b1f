//! The middle of a coaxial five-bar with four equal links, where both legs fold up.
//!
//! With d = C − A, r = ‖d‖ and L = M, H = r² (4L² − r²) for both legs and G = ±r², G being what is left of det A
//! ([`ModalRows::parted`](aspecta_kinematics::modal::ModalRows::parted)): all of them grow along the field d wherever 0 < r² < 2L², and r = 0 has H = 0. So there is no
//! summit with r² < 2L² if nothing else bounds the aspects. No box round r = 0 is ever decided by what is evaluated there.

use crate::paving::Paving;
use aspecta_kinematics::chart::Chart;
use aspecta_kinematics::constraints::is_limited;
use aspecta_robot::num::{Interval, Scalar};
use aspecta_robot::{Platform, Robot};

/// Whether a robot is one of these, all of whose workspace is looked at.
pub(super) fn folds_up(robot: &Robot, paving: &Paving) -> bool {
    let equal = robot.legs[0].actuator.as_revolute().is_some_and(|leg| leg.crank == leg.rod);
    let whole = paving.chart == Chart::Pose
        && !is_limited(robot)
        && paving.window.cut.iter().all(|cut| *cut == (false, false));
    robot.platform == Platform::PlanePoint
        && equal
        && !paving.twins.is_empty()
        && whole
        && paving.axes.len() == 2
}

/// Whether r² < 2L² all over a box of such a robot.
pub(super) fn is_in_the_middle(robot: &Robot, paving: &Paving, node: u32) -> bool {
    let leg = &robot.legs[0];
    let Some(links) = leg.actuator.as_revolute() else { return false };
    let extent = paving.extent(node);
    let d = |k: usize| extent[k] + leg.attachment[k] - leg.anchor[k];
    (links.crank.square() * Interval::point(2.0) - d(0).square() - d(1).square()).is_positive()
}
