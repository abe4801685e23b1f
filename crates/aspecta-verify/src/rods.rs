//! The angle between the rods of two legs, over a box in a working mode.

use super::body::{MOST, rod_length};
use super::in_mode::InMode;
use super::place::{Along, Function, OWN, Posture, ZERO};
use aspecta_robot::num::{Interval, Scalar};
use aspecta_robot::{AXES, LegIndex, RodAngle};

/// A function of the configuration: its range, and its derivatives along the axes and by each leg's q.
pub(super) struct Shared {
    pub range: Interval,
    pub along: [Interval; AXES],
    pub by_joint: [Interval; MOST],
}

impl<const D: usize> InMode<'_, '_, D> {
    /// How far inside its limit the angle between two rods is. With e = ∂f/∂C / 2M for a rod and c = e_i·e_j it is (cos α − c)(c − cos β), or
    /// the one factor that there is.
    pub(super) fn rod_angle(&self, limit: &RodAngle) -> Shared {
        let c = self.cosine(limit.legs);
        let below = |min: Interval| min - c.range;
        let above = |max: Interval| c.range - max;
        let one = Interval::point(1.0);
        let (range, slope) = match (limit.min_cos, limit.max_cos) {
            (Some(min), Some(max)) => (below(min) * above(max), below(min) - above(max)),
            (Some(min), None) => (below(min), -one),
            (None, Some(max)) => (above(max), one),
            (None, None) => (one, ZERO),
        };
        Shared { range, along: c.along.map(|x| x * slope), by_joint: c.by_joint.map(|x| x * slope) }
    }

    /// The cosine of the angle.
    fn cosine(&self, [first, second]: [LegIndex; 2]) -> Shared {
        let robot = self.place.setting.robot;
        let legs: [&Posture; 2] = [first, second].map(|j| &*self.legs[j.index()]);
        let lengths = [first, second].map(|j| rod_length(&robot.leg(j).actuator).unwrap_or(Interval::ENTIRE));
        let both = Interval::point(4.0) * lengths[0] * lengths[1];
        let function = |i: usize, k: usize| -> &Function { &legs[i].over.push[k] };
        let along = |i: usize, k: usize| {
            let f = function(i, k);
            Along { value: f.value, gradient: std::array::from_fn(|a| legs[i].along(f, a)) }
        };
        let over = (0..D).fold(Along::zero(), |sum, k| sum + along(0, k) * along(1, k));
        let middle = (0..D).fold(ZERO, |sum, k| sum + legs[0].push_at_middle(k) * legs[1].push_at_middle(k));
        let fixed = |a: usize| {
            (0..D).fold(ZERO, |sum, k| {
                let (f, g) = (function(0, k), function(1, k));
                sum + f.gradient[a] * g.value + f.value * g.gradient[a]
            })
        };
        let mut by_joint = [ZERO; MOST];
        for (i, j) in [first, second].into_iter().enumerate() {
            let own =
                (0..D).fold(ZERO, |sum, k| sum + function(i, k).gradient[OWN] * function(1 - i, k).value);
            by_joint[j.index()] = own / both;
        }
        Shared {
            range: self.place.centred(&over, middle) / both,
            along: std::array::from_fn(|a| fixed(a) / both),
            by_joint,
        }
    }
}
