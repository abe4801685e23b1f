//! The functions that bound the aspects of a robot, as a list. How they are evaluated is not said here: the
//! checker does it in its own way.

mod named;
mod scale;

pub use named::{constraint, if_any};
pub use scale::Scale;

use crate::leg_index::{as_index, as_indices};
use crate::{Body, Clearance, LegIndex, LegSet, Limit, Robot};
use serde::{Deserialize, Serialize};
use std::fmt;

/// One of the functions that bound an aspect. The limits of a leg count from 0 here and from 1 where they are
/// printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Constraint {
    /// H_j of leg j.
    Reach(#[serde(with = "as_index")] LegIndex),
    /// Limit k of leg j.
    Limit(#[serde(with = "as_index")] LegIndex, usize),
    /// Limit k of those that two legs share: the angle between their rods.
    RodAngle(#[serde(with = "as_indices")] [LegIndex; 2], usize),
    /// Pair k of bodies, which keep clear of one another.
    Apart([Body; 2], usize),
    /// det A.
    Det,
}

/// The kind of configuration that a constraint excludes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A serial singularity of this leg.
    Serial(LegIndex),
    /// A parallel singularity.
    Parallel,
    /// A configuration beyond a joint limit.
    Limit,
}

impl Constraint {
    /// Returns all constraints of a robot, leg by leg; first those of the pose alone. det A, which needs all
    /// legs, is the last.
    pub fn of(robot: &Robot) -> impl Iterator<Item = Self> {
        let of_leg = |(j, leg): (usize, &crate::Leg)| {
            let j = LegIndex::new(j);
            let reach = (leg.actuator.postures() == 2).then_some(Self::Reach(j));
            reach.into_iter().chain((0..leg.limits.len()).map(move |k| Self::Limit(j, k)))
        };
        let shared = robot.rod_angles.iter().enumerate().map(|(k, limit)| Self::RodAngle(limit.legs, k));
        let apart = robot.pairs.iter().enumerate().map(|(k, pair)| Self::Apart(pair.bodies, k));
        robot.legs.iter().enumerate().flat_map(of_leg).chain(shared).chain(apart).chain([Self::Det])
    }

    /// Returns the kind of configuration that it excludes.
    pub fn kind(self) -> Kind {
        match self {
            Self::Reach(j) => Kind::Serial(j),
            Self::Limit(..) | Self::RodAngle(..) | Self::Apart(..) => Kind::Limit,
            Self::Det => Kind::Parallel,
        }
    }

    /// Whether it is a limit of the machine, and no singularity.
    pub fn is_limit(self) -> bool {
        self.kind() == Kind::Limit
    }

    /// The legs on whose s h it depends, besides the pose.
    pub fn postures(self) -> LegSet {
        match self {
            Self::Reach(_) => LegSet::NONE,
            Self::Limit(j, _) => LegSet::of(j),
            Self::RodAngle(legs, _) => LegSet::of_two(legs),
            Self::Apart(bodies, _) => Body::legs(bodies),
            Self::Det => LegSet::ALL,
        }
    }

    /// Whether its root is one of the functions whose least is P (docs/theory.md, 5): of H_j, and of what is left to an obstacle or between
    /// two bodies that are not thin.
    pub fn counts_by_root(self, robot: &Robot) -> bool {
        match self {
            Self::Reach(_) => true,
            Self::Limit(j, k) => robot.leg(j).limits[k].as_clearance().is_some(),
            Self::Apart(_, k) => !robot.pairs[k].is_thin(),
            Self::RodAngle(..) | Self::Det => false,
        }
    }

    /// Whether it is that two bodies, or a link and an obstacle, do not touch.
    pub fn is_contact(self, robot: &Robot) -> bool {
        match self {
            Self::Limit(j, k) => robot.leg(j).limits[k].as_clearance().is_some(),
            Self::Apart(..) => true,
            Self::Reach(_) | Self::RodAngle(..) | Self::Det => false,
        }
    }

    /// The leg that it is about, if it is about one alone.
    pub fn leg(self) -> Option<LegIndex> {
        match self {
            Self::Reach(j) | Self::Limit(j, _) => Some(j),
            Self::RodAngle(..) | Self::Apart(..) | Self::Det => None,
        }
    }

    /// A number by which neighbours of one kind are told apart, in colours say.
    pub fn order(self) -> usize {
        match self {
            Self::Reach(j) => j.index(),
            Self::Limit(j, k) => j.index() + k,
            Self::RodAngle([j, _], k) => j.index() + k + 1,
            Self::Apart(_, k) => k,
            Self::Det => 0,
        }
    }

    /// Whether it says something of the driven joints alone, wherever the platform is.
    pub fn is_of_drives(self, robot: &Robot) -> bool {
        match self {
            Self::Limit(j, k) => match robot.leg(j).limits[k].as_clearance() {
                Some(clearance) => clearance.part.is_driven(),
                None => {
                    let limit = &robot.leg(j).limits[k];
                    matches!(limit, Limit::ActuatorAngle { .. } | Limit::ActuatorLength { .. })
                }
            },
            Self::Apart(bodies, _) => bodies.into_iter().all(Body::is_driven),
            Self::Reach(_) | Self::RodAngle(..) | Self::Det => false,
        }
    }

    /// Returns its name, with the joint that it limits or the obstacle.
    pub fn named(self, robot: &Robot) -> String {
        match self {
            Self::Limit(j, k) => {
                let limit = &robot.leg(j).limits[k];
                match limit.as_clearance() {
                    Some(Clearance { obstacle, part, .. }) => {
                        format!("obstacle {obstacle} at the {} of leg {j}", part.name())
                    }
                    None => format!("{} limit of leg {j}", limit.joint()),
                }
            }
            Self::Reach(_) | Self::RodAngle(..) | Self::Apart(..) | Self::Det => self.to_string(),
        }
    }
}

/// Its name where the robot is not at hand: `det A`, `H_1`, `joint limit 1 of leg 2`.
impl fmt::Display for Constraint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Reach(j) => write!(f, "H_{j}"),
            Self::Limit(j, k) => write!(f, "joint limit {} of leg {j}", k + 1),
            Self::RodAngle([i, j], _) => write!(f, "limit of the angle between the rods of legs {i} and {j}"),
            Self::Apart([first, second], _) => write!(f, "contact of {first} and {second}"),
            Self::Det => f.write_str("det A"),
        }
    }
}
