//! How far bodies are in front of a wall.

use super::contact::{Both, lifted};
use super::in_mode::InMode;
use super::rods::Shared;
use aspecta_robot::BodyPair;
use aspecta_robot::num::Scalar;

impl<const D: usize> InMode<'_, '_, D> {
    /// How far the ends of a body are in front of a wall, less the distance asked for; nothing if none of the two is a wall.
    pub(super) fn beyond_wall(&self, pair: &BodyPair) -> Option<Vec<Shared>> {
        let (slot, normal, offset) = self.place.setting.robot.wall_of(pair)?;
        let (over, middle) = (self.axes(pair, lifted), self.axes(pair, |_, f| f.at_middle));
        let asked = offset + pair.distance;
        let beyond = |end: usize| {
            let (over, middle) = (over[1 - slot].end(end), middle[1 - slot].end(end));
            let along = |k: usize| over[k] * Both::constant(normal[k]);
            let total = (1..D).fold(along(0), |sum, k| sum + along(k)) - Both::constant(asked);
            let at_middle = (0..D).fold(-asked, |sum, k| sum + middle[k] * normal[k]);
            self.shared(pair, total, at_middle)
        };
        Some((0..2).map(beyond).collect())
    }
}
