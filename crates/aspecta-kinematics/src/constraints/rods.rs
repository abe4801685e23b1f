//! The angle between the rods of two legs as a function that is positive strictly within its range.

use super::LegAt;
use super::limit::{rod_direction, rod_length};
use aspecta_robot::num::{Interval, Scalar, dot};
use aspecta_robot::{RodAngle, out_of_frame};

/// Two legs at a pose, each with its s h.
pub(super) struct TwoLegs<'a, T, const D: usize>(pub [(LegAt<'a, T, D>, T); 2]);

impl<T: Scalar, const D: usize> TwoLegs<'_, T, D> {
    /// (cos α − c)(c − cos β), c being the cosine of the angle between the rods and [α, β] its range, or the one factor that there is; times
    /// [`TwoLegs::unit`].
    pub(super) fn margin(&self, limit: &RodAngle) -> T {
        let directions = self.0.each_ref().map(|(at, sh)| out_of_frame(at.leg, &rod_direction(at, *sh)));
        let (cos, both) = (dot(&directions[0], &directions[1]), self.lengths());
        let below = |min: Interval| both.scale(min) - cos;
        let above = |max: Interval| cos - both.scale(max);
        match (limit.min_cos, limit.max_cos) {
            (Some(min), Some(max)) => below(min) * above(max),
            (Some(min), None) => below(min),
            (None, Some(max)) => above(max),
            (None, None) => T::constant(Interval::point(1.0)),
        }
    }

    /// The divisor that makes [`TwoLegs::margin`] the same function in all coordinates.
    pub(super) fn unit(&self, limit: &RodAngle) -> T {
        let both = self.lengths();
        if limit.min_cos.is_some() && limit.max_cos.is_some() { both.square() } else { both }
    }

    /// The product of what the directions of the rods are multiplied by.
    fn lengths(&self) -> T {
        let [(first, _), (second, _)] = &self.0;
        rod_length(first) * rod_length(second)
    }
}
