//! Working modes in which det A vanishes identically: what Definition 5 excepts, "unless it is zero everywhere".

use super::result::{AspectClass, EarlierDomain};
use aspecta_robot::{LegIndex, Robot, WorkingMode};
use serde::Serialize;

/// A working mode in which det A vanishes at every pose, because two legs are one and the same and in the same posture: with all motors
/// locked the platform can move about everywhere.
///
/// Such a mode has no generalized aspects (Definition 8 asks for det A ≠ 0); what there is of it are the connected domains in which
/// the mode exists, all of them singular. No certificate file holds their numbers.
#[derive(Clone, Debug, Serialize)]
#[non_exhaustive]
pub struct SingularMode {
    /// The working mode.
    pub mode: WorkingMode,
    /// The two legs that are one ([`Robot::twins_in`]).
    pub legs: [LegIndex; 2],
    /// At least this many domains (certified).
    pub low: usize,
    /// At most this many (certified), `None` if not proved.
    pub high: Option<usize>,
    /// Certified inner measure, as [`Analysis::measure`](super::Analysis::measure) says.
    pub measure: f64,
    /// Measure of where it is undecided whether the mode exists.
    pub undecided: f64,
    /// One entry for each of the `low` proved domains, largest first.
    pub domains: Vec<EarlierDomain>,
}

impl SingularMode {
    /// The mode whose domains were counted like the aspects of a class.
    pub(super) fn new(robot: &Robot, counted: AspectClass) -> Option<Self> {
        let AspectClass { mode, low, high, measure, undecided, aspects, .. } = counted;
        let legs = robot.twins_in(mode)?;
        let domains =
            aspects.into_iter().map(|a| EarlierDomain { measure: a.measure, sample: a.sample }).collect();
        Some(Self { mode, legs, low, high, measure, undecided, domains })
    }
}
