//! The middle of a coaxial five-bar with four equal links, where both legs fold up.
//!
//! With d = C − A, r = ‖d‖ and L = M, H = r² (4L² − r²) for both legs and G = ±r², G being what is left of det A
//! ([`ModalRows::parted`](aspecta_kinematics::modal::ModalRows::parted)): all of them grow along the field d wherever 0 < r² < 2L², and r = 0 has H = 0. So there is no
//! summit with r² < 2L² if nothing else bounds the aspects. The cosine of the angle between the rods is 1 where the legs are in one posture, and
//! r²/2L² − 1 in opposite ones: where that is beyond its limit there is nothing of the class. No box round r = 0 is ever decided by what is
//! evaluated there.

use crate::paving::{ClassSet, Paving};
use aspecta_kinematics::chart::Chart;
use aspecta_robot::num::{Interval, Scalar};
use aspecta_robot::{Platform, Robot};

/// Whether a robot is one of these, all of whose workspace is looked at.
pub(super) fn folds_up(robot: &Robot, paving: &Paving) -> bool {
    let equal = robot.legs[0].actuator.as_revolute().is_some_and(|leg| leg.crank == leg.rod);
    let whole = paving.chart == Chart::Pose && !paving.window.is_cut() && paving.axes.len() == 2;
    robot.platform == Platform::PlanePoint && equal && !paving.twins.is_empty() && whole
}

/// The classes of such a robot that have no summit in a box, for these reasons.
pub(super) fn summitless_in_the_middle(robot: &Robot, paving: &Paving, node: u32) -> ClassSet {
    let leg = &robot.legs[0];
    let Some(links) = leg.actuator.as_revolute() else { return 0 };
    let extent = paving.extent(node);
    let d = |k: usize| extent[k] + leg.attachment[k] - leg.anchor[k];
    let cosine = (d(0).square() + d(1).square()) / (links.crank.square() * Interval::point(2.0))
        - Interval::point(1.0);
    let free = robot.legs.iter().all(|leg| leg.limits.is_empty()) && robot.pairs.is_empty();
    let grows = cosine.is_negative() && free;
    let limits = &robot.rod_angles;
    let is_beyond = |max: Interval| (max - cosine).is_positive();
    let in_one_posture = grows || limits.iter().any(|limit| limit.min_cos.is_some());
    let in_opposite_ones =
        grows && limits.is_empty() || limits.iter().any(|limit| limit.max_cos.is_some_and(is_beyond));
    let none = |m: &usize| if paving.vanishes_in(*m) { in_one_posture } else { in_opposite_ones };
    (0..paving.modes.len()).filter(none).fold(0, |set, m| set | 3 << (2 * m))
}
