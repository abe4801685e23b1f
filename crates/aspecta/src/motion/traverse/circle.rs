//! What makes a box of poses a disc, a cylinder or a ball.

use aspecta_robot::num::{Interval, Scalar};

/// The circle or sphere that cuts a box.
pub(super) struct Circle<'a> {
    pub centre: Vec<f64>,
    pub round: &'a [usize],
    pub radius: f64,
}

impl Circle<'_> {
    /// The pose of a box that is nearest to the centre, and whether it surely lies within, or surely not: then
    /// nothing of the box does.
    pub fn nearest(&self, part: &[Interval]) -> (Vec<f64>, Option<bool>) {
        let mut pose: Vec<f64> = part.iter().map(|x| x.mid()).collect();
        let mut square = Interval::point(0.0);
        for &k in self.round {
            pose[k] = self.centre[k].clamp(part[k].lo, part[k].hi);
            square = square + (Interval::point(pose[k]) - Interval::point(self.centre[k])).square();
        }
        let room = Interval::point(self.radius).square() - square;
        let holds = if room.is_negative() { Some(false) } else { (room.lo >= 0.0).then_some(true) };
        (pose, holds)
    }
}
