//! Orientations in homogeneous coordinates: the direct problem as an intersection of quadrics.
//!
//! With its actuators locked, the leg equations of a body that turns in space are quadratic forms in the
//! quaternion e of its orientation (`turning_body`) or in the eight Study parameters (e, g) of its pose
//! (`free_body`). Their common points in complex projective space are finitely many for a generic robot, as
//! many for each; so they can be followed ([`track`]) from a system whose points are known while its
//! coefficients turn into the robot's, and none is lost. That none *was* lost is no matter of belief: each is
//! proved afterwards ([`prove`]), and when as many different ones are proved as there can be, the list is
//! complete. Those of special robots that are no orientations are zeros of other equations ([`zeros`]).

mod forms;
mod linear;
mod point;
mod prove;
mod quaternion;
mod solve;
mod track;
mod zeros;

pub(super) use forms::Quadrics;
pub(super) use point::Point;
pub(super) use prove::Proved;
pub(super) use quaternion::{rotation, turned_product};
pub(super) use solve::{Problem, is_nearly_real};
pub(super) use track::Ends;
pub(super) use zeros::{Number, System, double, single, zero};
#[cfg(test)]
pub(super) use {
    forms::Family,
    track::{Pace, Tracker, polish},
};
