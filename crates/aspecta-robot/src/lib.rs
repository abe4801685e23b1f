//! A fully parallel robot as data: one platform, n legs, one actuator a leg (Definitions 1 and 2).
//!
//! Everything the crate knows of a robot is its n leg equations f_i(X, q_i) = 0. A leg is written in
//! a frame of its own at its anchor A_i, in which every kind of leg has a short equation
//! ([`crate::legs`]); the platform is the motion group that places the attachment points C_i.

// A variant that is added leads to every place that must decide about it.
#![warn(clippy::wildcard_enum_match_arm)]

mod bodies;
pub mod catalogue;
pub mod chart;
mod classes;
mod clearance;
pub mod constraint;
mod file;
mod frame;
mod leg;
mod leg_index;
pub mod legs;
pub mod num;
mod platform;
mod postures;
mod rod_angle;
mod shape;
mod sizes;
mod slice;
mod sound;
#[doc(hidden)]
pub mod text;
mod twins;
mod window;
pub mod work;
mod working_mode;

pub use crate::legs::{Actuator, Prismatic, Revolute, Spherical, Strut};
pub use bodies::{Body, BodyPair, Capsule, MOST_BODIES, MOST_PAIRS};
pub use classes::{AXES, ClassSet, MAX_BOXES, MODES};
pub use clearance::{Clearance, LinkPart, MOST_OBSTACLES, Solid};
pub(crate) use file::{Fault, LegKeys};
pub use file::{FileError, Mistake, Problem, is_unprintable};
pub use frame::{crank_frame, rail_frame};
pub use leg::{BASE_FRAME, Frame, Leg, Limit, into_frame, out_of_frame, point};
pub use leg_index::LegIndex;
pub use platform::{Coordinate, Platform};
pub use postures::NoSuchMode;
pub use rod_angle::{MOST_SHARED, RodAngle};
pub use shape::Shape;
pub use sizes::MixedUnits;
pub use slice::SliceError;
pub use sound::{Takes, Unsound, holds, sane, takes, usable, wanted};
pub use twins::is_one_point;
pub use window::{Unbounded, Window};
pub use working_mode::{LegSet, NotAMode, WorkingMode};

use crate::legs::Kind;
use serde::{Deserialize, Serialize};

/// Numbers beyond this are not those of a robot.
pub const GREATEST: f64 = 1e7;

/// A robot, ready to compute with. Made from a robot file or by [`Robot::new`].
///
/// # Examples
/// ```
/// use aspecta_robot::Robot;
///
/// let robot = Robot::resolve("3-rrr")?;
/// assert_eq!((robot.dof(), robot.legs.len(), robot.length_unit.as_str()), (3, 3, "unit"));
/// # Ok::<(), aspecta_robot::FileError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Robot {
    /// Short name, as in the catalogue.
    pub name: String,
    /// One line for people.
    pub title: String,
    /// The source of the figures.
    pub source: String,
    /// The unit of all lengths, for people (`mm`, `m`, …); the arithmetic does not use it.
    pub length_unit: String,
    /// The motion group of the moving platform.
    pub platform: Platform,
    /// One leg per degree of freedom.
    pub legs: Vec<Leg>,
    /// Limits that two legs share.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub rod_angles: Vec<RodAngle>,
    /// The thickness of its links and other bodies.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub bodies: Vec<Capsule>,
    /// The bodies that keep clear of one another.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pairs: Vec<BodyPair>,
    /// Bounds the user sets on pose coordinates: `window[k]` for coordinate k, `None` where free.
    pub window: Vec<Option<(f64, f64)>>,
}

/// Why legs and a platform do not make a robot.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RobotError {
    /// n legs for n degrees of freedom.
    #[error("platform `{platform}` has {wanted} degrees of freedom and needs {wanted} legs, not {found}")]
    LegCount {
        /// The platform.
        platform: Platform,
        /// Legs it needs.
        wanted: usize,
        /// Legs given.
        found: usize,
    },
    /// The leg kind does not go with the platform.
    #[error("leg {leg}: a {actuator} leg cannot drive a `{platform}` platform: {hint}")]
    Mismatch {
        /// The leg.
        leg: LegIndex,
        /// Kind of actuator.
        actuator: &'static str,
        /// The platform.
        platform: Platform,
        /// Advice on what would fit.
        hint: &'static str,
    },
}

impl Robot {
    /// One of the robot's legs.
    ///
    /// # Panics
    /// If it has no such leg: [`Robot::legs`] can be asked for one that may not be there.
    #[inline]
    pub fn leg(&self, leg: LegIndex) -> &Leg {
        &self.legs[leg.index()]
    }

    /// A robot without window, title, source or unit.
    ///
    /// # Errors
    /// [`RobotError`] if there is not one leg per degree of freedom, or if spherical legs and
    /// point-to-point legs are mixed up with the wrong platform.
    ///
    /// # Examples
    /// ```
    /// use aspecta_robot::{Leg, Platform, Robot};
    ///
    /// let legs = vec![
    ///     Leg::revolute([0.0, 0.0], [0.0, 0.0], 8.0, 5.0), // A, C, crank, rod
    ///     Leg::revolute([9.0, 0.0], [0.0, 0.0], 5.0, 8.0),
    /// ];
    /// let robot = Robot::new("five-bar", Platform::PlanePoint, legs)?;
    /// assert_eq!(robot.working_modes().len(), 4);
    /// assert!(Robot::new("one leg", Platform::PlanePoint, vec![Leg::strut([0.0; 2], [0.0; 2])]).is_err());
    /// # Ok::<(), aspecta_robot::RobotError>(())
    /// ```
    pub fn new(name: &str, platform: Platform, legs: Vec<Leg>) -> Result<Self, RobotError> {
        let kinds: Vec<_> = legs.iter().map(|leg| leg.actuator.kind()).collect();
        check_legs(platform, &kinds)?;
        Ok(Self {
            name: name.into(),
            title: String::new(),
            source: String::new(),
            length_unit: "unit".into(),
            platform,
            window: vec![None; platform.dof()],
            rod_angles: Vec::new(),
            bodies: Vec::new(),
            pairs: Vec::new(),
            legs,
        })
    }

    /// Degrees of freedom n: the number of legs, of pose coordinates and of joint coordinates.
    pub fn dof(&self) -> usize {
        self.platform.dof()
    }

    /// A length that is typical of the robot (its unit): the greatest distance of an attachment from the
    /// platform's origin; of a platform without extent, the size of its largest leg. It makes rotations and
    /// translations comparable in condition numbers and margins; no proof rests on it.
    pub fn characteristic_length(&self) -> f64 {
        let arm = |l: &Leg| l.attachment.iter().map(|c| c.mid().powi(2)).sum::<f64>().sqrt();
        let arms = self.legs.iter().map(arm).fold(0.0, f64::max);
        if arms > 0.0 { arms } else { self.legs.iter().map(|l| l.actuator.size()).fold(0.0, f64::max) }
    }
}

/// Whether legs of these kinds and the platform make a robot: one leg per degree of freedom, spherical legs for
/// the turning body only.
fn check_legs(platform: Platform, kinds: &[Kind]) -> Result<(), RobotError> {
    let wanted = platform.dof();
    if kinds.len() != wanted {
        return Err(RobotError::LegCount { platform, wanted, found: kinds.len() });
    }
    match kinds.iter().position(|kind| !kind.facts().fits(platform)) {
        None => Ok(()),
        Some(k) => Err(RobotError::Mismatch {
            leg: LegIndex::new(k),
            actuator: kinds[k].name(),
            platform,
            hint: "`spherical` legs and the `turning-body` platform go together, and with nothing else",
        }),
    }
}

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
