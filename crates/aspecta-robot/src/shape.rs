//! Where bodies are.

use crate::num::Interval;
use crate::{Body, Capsule, Solid};
use serde::{Deserialize, Serialize};

/// The shape and place of a body, of one of the platform in the platform's frame, of an obstacle in the base.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Shape {
    /// A link, from joint to joint.
    Link,
    /// All points at most the radius away from the segment between these ends, or from the point that both are.
    Axis([[Interval; 3]; 2]),
    /// An obstacle: all that is behind a plane (in the plane a line), n·x ≤ offset.
    Wall {
        /// The unit vector n out of it.
        normal: [Interval; 3],
        /// The offset.
        offset: Interval,
    },
}

impl Shape {
    /// The ends of an axis that is given.
    pub fn ends(&self) -> Option<[[Interval; 3]; 2]> {
        match self {
            Self::Axis(ends) => Some(*ends),
            Self::Link | Self::Wall { .. } => None,
        }
    }
}

impl Capsule {
    /// An obstacle that is a disc, a ball or a wall, with its number.
    pub(crate) fn as_solid(&self) -> Option<(usize, Solid)> {
        let Body::Obstacle(number) = self.body else { return None };
        match self.shape {
            Shape::Axis([centre, other]) if centre == other => {
                Some((number, Solid::Ball { centre, radius: self.radius }))
            }
            Shape::Wall { normal, offset } => Some((number, Solid::Wall { normal, offset })),
            Shape::Axis(_) | Shape::Link => None,
        }
    }
}
