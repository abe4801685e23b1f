//! Pairs of bodies as functions of which P is made.

use super::{Bound, joined};
use crate::rods::Shared;
use crate::turns::{Joint, Turn};
use aspecta_robot::num::Interval;

/// Two thin bodies that may nearly touch.
pub(super) struct Parted {
    /// Lines, one of which must part them: the functions of which the lesser counts, and turns.
    pub lines: Vec<([Bound; 2], Vec<Turn>)>,
    /// The ends of both.
    pub joints: [Joint; 4],
}

/// Of lines that part two bodies those that may be the best; none at all if something else is always less.
pub(super) fn possible(
    mut lines: Vec<([Bound; 2], Vec<Turn>)>,
    least: f64,
) -> Option<Vec<([Bound; 2], Vec<Turn>)>> {
    let lowest = |ends: &[Bound; 2]| ends[0].value.lo.min(ends[1].value.lo);
    let highest = |ends: &[Bound; 2]| ends[0].value.hi.min(ends[1].value.hi);
    let best = lines.iter().map(|line| lowest(&line.0)).fold(f64::NEG_INFINITY, f64::max);
    lines.retain(|line| highest(&line.0) >= best);
    (best <= least).then_some(lines)
}

impl Shared {
    /// As one of the functions whose least is P, `size` being its scale.
    pub(super) fn bound(&self, size: Interval) -> Bound {
        Bound { value: self.range / size, gradient: joined(&self.along, &self.by_joint), height_of: None }
    }
}
