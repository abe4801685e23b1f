//! Bodies of the surroundings that the links of a leg keep clear of.

use crate::num::{Interval, Scalar, dot};
use crate::sound::is_in_space;
use crate::{Capsule, Leg, Limit, Robot, sane};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The greatest number of obstacles of a robot.
pub const MOST_OBSTACLES: usize = 8;

/// One part of a leg kept clear of one obstacle: they are farther apart than `distance`.
///
/// What obstacles a robot has is said in its file once; each leg then has a limit of this kind for each of its links and each round
/// obstacle, and for each end of its links and each wall, but where the links are too short to come there.
///
/// # Examples
/// ```
/// use aspecta_robot::{Limit, Robot};
///
/// let obstacle = "[[obstacles]]\ncentre = [4.5, 0]\nradius = 1\nclearance = 0.2\n";
/// let file = format!("{}\n{obstacle}", aspecta_robot::catalogue::all()[0].text);
/// let robot = Robot::from_toml(&file, "five-bar.toml")?;
/// let limits = &robot.legs[1].limits;
/// assert!(matches!(limits[..], [Limit::Clearance(crank), Limit::Clearance(rod)] if crank.obstacle == 1 && rod.obstacle == 1));
/// assert_eq!(limits[1].in_words("cm"), "rod 0.2000 cm from obstacle 1");
/// # Ok::<(), aspecta_robot::FileError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Clearance {
    /// The obstacle's number in the robot file, from 1.
    pub obstacle: usize,
    /// What it is.
    pub solid: Solid,
    /// What is kept clear of it.
    pub part: LinkPart,
    /// The least distance from it, ≥ 0: half the width of the link, and what is to be left besides.
    pub distance: Interval,
}

/// The shape and place of an obstacle, in base coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Solid {
    /// A ball; in the plane a disc.
    Ball {
        /// Its centre.
        centre: [Interval; 3],
        /// Its radius > 0.
        radius: Interval,
    },
    /// All that is behind a plane (in the plane a line): n·x ≤ offset.
    Wall {
        /// The unit vector n out of it.
        normal: [Interval; 3],
        /// The offset.
        offset: Interval,
    },
}

/// A part of a leg from A by B to C; of a strut, which has no B, the rod reaches from A to C.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LinkPart {
    /// The driven link, from A to B.
    Crank,
    /// The link from B to C, or the strut.
    Rod,
    /// B.
    Elbow,
    /// C.
    End,
}

impl LinkPart {
    /// Whether the motor alone says where it is.
    pub(crate) fn is_driven(self) -> bool {
        match self {
            Self::Crank | Self::Elbow => true,
            Self::Rod | Self::End => false,
        }
    }

    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Self::Crank => "crank",
            Self::Rod => "rod",
            Self::Elbow => "elbow",
            Self::End => "end",
        }
    }
}

impl Solid {
    /// The parts of a leg that are to be kept clear of it, so that the whole leg is.
    pub fn parts_of(&self, leg: &Leg) -> &'static [LinkPart] {
        let facts = leg.actuator.kind().facts();
        match self {
            _ if !facts.has_rod => &[],
            Self::Ball { .. } if facts.has_elbow => &[LinkPart::Crank, LinkPart::Rod],
            Self::Ball { .. } => &[LinkPart::Rod],
            Self::Wall { .. } if facts.is_positive => &[LinkPart::End],
            Self::Wall { .. } => &[LinkPart::Elbow, LinkPart::End],
        }
    }

    /// Whether it can be in a machine in the plane or in space.
    pub(crate) fn is_sound(&self, space: usize) -> bool {
        match self {
            Self::Ball { centre, radius } => {
                centre.iter().all(sane) && is_in_space(centre, space) && sane(radius) && radius.lo > 0.0
            }
            Self::Wall { normal, offset } => {
                let length = dot(normal, normal);
                let is_unit = length.contains(1.0) && length.width() < 1e-6;
                normal.iter().all(sane) && is_in_space(normal, space) && is_unit && sane(offset)
            }
        }
    }

    /// How far a point is from it, or rather a function that is positive just if the point is farther than `distance`.
    pub(crate) fn margin_of(&self, point: &[Interval; 3], distance: Interval) -> Interval {
        match self {
            Self::Ball { centre, radius } => {
                let away: [Interval; 3] = std::array::from_fn(|k| point[k] - centre[k]);
                dot(&away, &away) - (*radius + distance).square()
            }
            Self::Wall { normal, offset } => dot(normal, point) - *offset - distance,
        }
    }
}

impl Robot {
    /// The discs, balls and walls that the robot is kept clear of, by number.
    pub fn obstacles(&self) -> BTreeMap<usize, Solid> {
        let limits = self.legs.iter().flat_map(|leg| &leg.limits);
        let clearances = limits.filter_map(Limit::as_clearance);
        let of_legs = clearances.map(|clearance| (clearance.obstacle, clearance.solid));
        of_legs.chain(self.bodies.iter().filter_map(Capsule::as_solid)).collect()
    }
}

impl Clearance {
    /// Whether the part may come as near as that: not if the links are too short for it.
    pub(crate) fn matters_to(&self, leg: &Leg) -> bool {
        let farthest = match (leg.actuator.as_revolute(), self.part) {
            (Some(links), LinkPart::Crank | LinkPart::Elbow) => Some(links.crank),
            (Some(links), LinkPart::Rod | LinkPart::End) => Some(links.crank + links.rod),
            (None, _) if leg.actuator.kind().facts().is_positive => leg.length_range().map(|(_, max)| max),
            (None, _) => None,
        };
        let is_beyond =
            |reach: Interval| self.solid.margin_of(&leg.anchor, self.distance + reach).is_positive();
        !farthest.is_some_and(is_beyond)
    }

    /// Whether it can be one of a leg's.
    pub(crate) fn fits(&self, leg: &Leg, space: usize) -> bool {
        let is_known = (1..=MOST_OBSTACLES).contains(&self.obstacle);
        is_known
            && self.solid.is_sound(space)
            && self.solid.parts_of(leg).contains(&self.part)
            && sane(&self.distance)
            && self.distance.lo >= 0.0
    }
}
