//! A limit that two legs share.

use crate::leg_index::as_indices;
use crate::num::Interval;
use crate::text::brief;
use crate::{LegIndex, Robot};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// The greatest number of limits that legs share.
pub const MOST_SHARED: usize = 32;

/// The angle between the rods of two legs, from 0 to π, stays within a range: firmware keeps the rods of a five-bar printer from 15° to
/// 165° apart. It is the angle between the directions from B to C of both legs.
///
/// # Examples
/// ```
/// use aspecta_robot::{LegIndex, Robot};
///
/// let five_bar = aspecta_robot::catalogue::find("five-bar").unwrap();
/// let text = "[[rod-angles]]\nlegs = [1, 2]\nangle = { deg = [15, 165] }\n";
/// let file = format!("{}\n{text}", aspecta_robot::catalogue::all()[0].text);
/// let robot = Robot::from_toml(&file, "printer.toml")?;
/// assert_eq!(robot.rod_angles[0].legs, [LegIndex::new(0), LegIndex::new(1)]);
/// assert!(five_bar.rod_angles.is_empty());
/// # Ok::<(), aspecta_robot::FileError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RodAngle {
    /// The legs, both with a rod of constant length.
    #[serde(with = "as_indices")]
    pub legs: [LegIndex; 2],
    /// cos of the least angle; `None` if that is 0.
    pub min_cos: Option<Interval>,
    /// cos of the greatest angle; `None` if that is π.
    pub max_cos: Option<Interval>,
}

impl RodAngle {
    /// In words, as limits are told: `rods of legs 1 and 2 from 0.2618 to 2.8798 rad apart`.
    pub fn in_words(&self) -> String {
        let angle =
            |cos: Option<Interval>, otherwise: f64| brief(cos.map_or(otherwise, |cos| cos.mid().acos()));
        let [first, second] = self.legs;
        let (min, max) = (angle(self.min_cos, 0.0), angle(self.max_cos, PI));
        format!("rods of legs {first} and {second} from {min} to {max} rad apart")
    }

    /// Whether it can be one of a robot's.
    pub(crate) fn fits(&self, robot: &Robot) -> bool {
        let has_rod = |leg: &LegIndex| {
            robot.legs.get(leg.index()).is_some_and(|leg| leg.actuator.rigid_rod().is_some())
        };
        let [first, second] = &self.legs;
        let is_cos = |cos: &Interval| crate::sane(cos) && cos.lo > -1.0 && cos.hi < 1.0;
        let bounds = [self.min_cos, self.max_cos];
        let ordered = self.min_cos.zip(self.max_cos).is_none_or(|(min, max)| max.hi < min.lo);
        let any = bounds.iter().flatten().count() > 0;
        first != second
            && has_rod(first)
            && has_rod(second)
            && any
            && bounds.iter().flatten().all(is_cos)
            && ordered
    }
}
