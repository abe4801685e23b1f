//! Legs that are one and the same: motors on one axis, links of one length, one joint of the platform.

use crate::num::Interval;
use crate::{Leg, LegIndex, Robot, WorkingMode};

/// The greatest width of an enclosure of one number, that of the file or made of some by a few roundings, relative to the number or to 1.
/// A wider one is a tolerance, and two numbers with the same tolerance are two numbers.
const ONE_NUMBER: f64 = 1e-14;

impl Leg {
    /// Whether another leg has the same equation but for where its q counts from, so that both take the same shapes at every pose. Limits
    /// may differ. Numbers that are the same double are taken for one.
    fn is_twin_of(&self, other: &Self) -> bool {
        let data = |leg: &Self| (leg.anchor, leg.attachment, leg.axis(), leg.actuator);
        data(self) == data(other) && self.numbers().all(is_one_number)
    }

    /// The numbers in its equation.
    fn numbers(&self) -> impl Iterator<Item = Interval> {
        let places = self.anchor.into_iter().chain(self.attachment).chain(self.axis());
        places.chain(self.actuator.constants())
    }

    /// The axis about which its motor turns, or the direction in which it pushes.
    fn axis(&self) -> [Interval; 3] {
        self.frame[if self.actuator.is_angle() { 2 } else { 0 }]
    }
}

/// Whether two enclosures of points are of one point: equal, and of numbers known to rounding. With a tolerance they are two points.
pub fn is_one_point(a: &[Interval; 3], b: &[Interval; 3]) -> bool {
    a == b && a.iter().copied().all(is_one_number)
}

fn is_one_number(x: Interval) -> bool {
    x.width() <= ONE_NUMBER * x.magnitude().max(1.0)
}

impl Robot {
    /// The pairs of legs that are one and the same, the first leg of the robot first: motors on one axis, links of one length, one joint.
    pub fn twins(&self) -> Vec<[LegIndex; 2]> {
        let pairs = (1..self.legs.len()).flat_map(|j| (0..j).map(move |i| [i, j]));
        let are_one = |[i, j]: &[usize; 2]| self.legs[*i].is_twin_of(&self.legs[*j]);
        pairs.filter(are_one).map(|pair| pair.map(LegIndex::new)).collect()
    }

    /// Two legs that are one and the same ([`Robot::twins`]) and in the same posture in this mode, if there are any: their rows of A are
    /// equal wherever the platform is, so det A vanishes in all of the mode.
    ///
    /// # Examples
    /// ```
    /// use aspecta_robot::{Leg, Platform, Robot};
    ///
    /// // Both motors of a five-bar on one axis.
    /// let leg = Leg::revolute([0.0, 0.0], [0.0, 0.0], 0.1, 0.2);
    /// let robot = Robot::new("coaxial", Platform::PlanePoint, vec![leg.clone(), leg])?;
    /// assert!(robot.twins_in("++".parse()?).is_some());
    /// assert!(robot.twins_in("+-".parse()?).is_none());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn twins_in(&self, mode: WorkingMode) -> Option<[LegIndex; 2]> {
        self.twins().into_iter().find(|[i, j]| mode.sign(i.index()) == mode.sign(j.index()))
    }
}
