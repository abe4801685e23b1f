//! Legs, their actuators and their joint limits.

use crate::Clearance;
use crate::legs::{Actuator, Drive};
use crate::num::{Interval, Scalar, dot_constant, each, turned_to};
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// An orthonormal frame at the anchor of a leg: its rows are the unit vectors u, v, w in base
/// coordinates. Enclosures hold the exact frame. In the plane only the upper left 2 × 2 block counts.
pub type Frame = [[Interval; 3]; 3];

/// One leg: it ties the point A_i of the base to the point C_i of the platform.
///
/// Lengths are in the robot's unit. Every constant is an interval that holds the decimal number of
/// the robot file.
///
/// # Examples
/// ```
/// use aspecta_robot::{Actuator, Leg};
///
/// // Crank 8 about A = (0, 0), rod 5 to C = (1, 0) of the platform.
/// let leg = Leg::revolute([0.0, 0.0], [1.0, 0.0], 8.0, 5.0);
/// assert!(matches!(leg.actuator, Actuator::Revolute(_)));
/// assert_eq!(leg.actuator.postures(), 2);
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Leg {
    /// A_i in base coordinates (the plane uses the first two). The centre of the sphere, zero, for
    /// spherical legs.
    pub anchor: [Interval; 3],
    /// C_i in the platform frame. For spherical legs the unit vector v_i of the platform joint.
    pub attachment: [Interval; 3],
    /// The leg's own frame, in which its actuator is described.
    pub frame: Frame,
    /// The actuator that drives the leg, with the lengths of its links.
    pub actuator: Actuator,
    /// Limits of its actuated and passive joints, and obstacles.
    pub limits: Vec<Limit>,
}

/// A limit of a joint, or an obstacle: a condition that a configuration within the limits fulfils strictly.
///
/// Angular ranges are kept as a middle direction and a half-width in (0, π): inside is where the
/// cosine of the difference exceeds that of the half-width, one smooth condition for any range.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "joint", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Limit {
    /// A driven angle (revolute and spherical legs).
    ActuatorAngle {
        /// (cos, sin) of the middle of the range.
        middle: (Interval, Interval),
        /// cos of its half-width.
        half_cos: Interval,
        /// Full turns from the angle of `middle` in (−π, π] to the middle that the robot file means: 1 for
        /// the range 200° to 400°. No configuration depends on it, but how a joint's value is told.
        #[serde(default, skip_serializing_if = "is_zero")]
        turns: i32,
    },
    /// A driven length (prismatic legs and struts), min < q < max.
    ActuatorLength {
        /// Lower limit.
        min: Interval,
        /// Upper limit.
        max: Interval,
    },
    /// The passive angle at B of a revolute leg in the plane, from the crank's direction to the
    /// rod's, counter-clockwise.
    Elbow {
        /// (cos, sin) of the middle of the range.
        middle: (Interval, Interval),
        /// cos of its half-width.
        half_cos: Interval,
    },
    /// The elbow angle in space, where it has no sign: between min and max in [0, π].
    SpatialElbow {
        /// cos of the smallest angle.
        min_cos: Interval,
        /// cos of the greatest angle.
        max_cos: Interval,
    },
    /// The direction of the rod (of the strut) stays within a half-angle of a direction fixed in the base.
    BaseCone {
        /// Unit direction, in the leg's own frame.
        axis: [Interval; 3],
        /// cos of the half-angle.
        half_cos: Interval,
    },
    /// The direction of the rod (of the strut) stays within a half-angle of a direction fixed in the platform.
    PlatformCone {
        /// Unit direction, platform frame.
        axis: [Interval; 3],
        /// cos of the half-angle.
        half_cos: Interval,
    },
    /// A part of the leg stays clear of an obstacle.
    Clearance(Clearance),
}

/// The frame whose vectors are those of the base.
pub const BASE_FRAME: Frame = {
    const O: Interval = Interval::point(0.0);
    const I: Interval = Interval::point(1.0);
    [[I, O, O], [O, I, O], [O, O, I]]
};

/// A base vector in the leg's frame.
pub fn into_frame<T: Scalar, const D: usize>(leg: &Leg, v: &[T; D]) -> [T; D] {
    each!(|k| dot_constant(&leg.frame[k][..D], v))
}

/// A vector of the leg's frame in the base.
pub fn out_of_frame<T: Scalar, const D: usize>(leg: &Leg, v: &[T; D]) -> [T; D] {
    each!(|k| {
        let column = [leg.frame[0][k], leg.frame[1][k], leg.frame[2][k]];
        dot_constant(&column[..D], v)
    })
}

/// A point with exact coordinates given as decimals.
pub fn point(p: [f64; 3]) -> [Interval; 3] {
    p.map(Interval::decimal)
}

/// Whether a number can be left out of a file.
fn is_zero(turns: &i32) -> bool {
    *turns == 0
}

impl Limit {
    /// The middle of the range of a driven angle, as the robot file means it (rad); `None` of other limits.
    pub(crate) fn middle_angle(&self) -> Option<f64> {
        match self {
            Self::ActuatorAngle { middle: (cos, sin), turns, .. } => {
                Some(sin.mid().atan2(cos.mid()) + TAU * f64::from(*turns))
            }
            Self::ActuatorLength { .. }
            | Self::Elbow { .. }
            | Self::SpatialElbow { .. }
            | Self::BaseCone { .. }
            | Self::PlatformCone { .. }
            | Self::Clearance(_) => None,
        }
    }

    /// What it keeps clear of an obstacle, if it does that.
    pub fn as_clearance(&self) -> Option<&Clearance> {
        match self {
            Self::Clearance(clearance) => Some(clearance),
            Self::ActuatorAngle { .. }
            | Self::ActuatorLength { .. }
            | Self::Elbow { .. }
            | Self::SpatialElbow { .. }
            | Self::BaseCone { .. }
            | Self::PlatformCone { .. } => None,
        }
    }

    /// The joint it limits, as robot files call it, or `clearance`.
    pub fn joint(&self) -> &'static str {
        match self {
            Self::ActuatorAngle { .. } | Self::ActuatorLength { .. } => "actuator",
            Self::Elbow { .. } | Self::SpatialElbow { .. } => "elbow",
            Self::BaseCone { .. } => "base-joint",
            Self::PlatformCone { .. } => "platform-joint",
            Self::Clearance(_) => "clearance",
        }
    }
}

impl Leg {
    /// A leg in the plane whose frame is that of the base.
    pub(crate) fn planar(a: [f64; 2], c: [f64; 2], actuator: Actuator) -> Self {
        Self {
            anchor: point([a[0], a[1], 0.0]),
            attachment: point([c[0], c[1], 0.0]),
            frame: BASE_FRAME,
            actuator,
            limits: Vec::new(),
        }
    }

    /// The range of the driven joint, if it has one, as the robot file gives it: rad or length units.
    pub fn drive_range(&self) -> Option<(f64, f64)> {
        self.limits.iter().find_map(|limit| match limit {
            Limit::ActuatorAngle { half_cos, .. } => {
                let (middle, half) = (limit.middle_angle()?, half_cos.mid().acos());
                Some((middle - half, middle + half))
            }
            Limit::ActuatorLength { min, max } => Some((min.mid(), max.mid())),
            Limit::Elbow { .. }
            | Limit::SpatialElbow { .. }
            | Limit::BaseCone { .. }
            | Limit::PlatformCone { .. }
            | Limit::Clearance(_) => None,
        })
    }

    /// [`Leg::drive_range`], certainly held: half-width and middle are those of the limit, not of rounded angles.
    pub fn drive_enclosure(&self) -> Option<Interval> {
        self.limits.iter().find_map(|limit| match limit {
            Limit::ActuatorAngle { middle, half_cos, turns } => {
                let half = Interval::angle(*half_cos, (Interval::point(1.0) - half_cos.square()).sqrt())?;
                let turned = Interval::PI * Interval::point(2.0 * f64::from(*turns));
                let middle = Interval::angle(middle.0, middle.1)? + turned;
                Some((middle - half).hull(middle + half))
            }
            Limit::ActuatorLength { min, max } => Some(min.hull(*max)),
            Limit::Elbow { .. }
            | Limit::SpatialElbow { .. }
            | Limit::BaseCone { .. }
            | Limit::PlatformCone { .. }
            | Limit::Clearance(_) => None,
        })
    }

    /// The value of the driven joint, as people and controllers call it: a length, or the angle (rad) that lies
    /// within the joint's own range, or next to it if none does; in (−π, π] if the joint has no limits.
    pub fn joint_value(&self, drive: Drive<f64>) -> f64 {
        self.in_range(drive.value())
    }

    /// Turns a value of the driven joint by full turns into the joint's range, or as near to its middle as may
    /// be; lengths, and angles of joints without limits, are left as they are.
    pub fn in_range(&self, q: f64) -> f64 {
        self.limits.iter().find_map(Limit::middle_angle).map_or(q, |middle| turned_to(q, middle))
    }

    /// The limits of a driven length, if it has any: (min, max).
    pub fn length_range(&self) -> Option<(Interval, Interval)> {
        self.limits.iter().find_map(|l| match l {
            Limit::ActuatorLength { min, max } => Some((*min, *max)),
            Limit::ActuatorAngle { .. }
            | Limit::Elbow { .. }
            | Limit::SpatialElbow { .. }
            | Limit::BaseCone { .. }
            | Limit::PlatformCone { .. }
            | Limit::Clearance(_) => None,
        })
    }

    /// How long the two parts of a strut are that cover it at every length: as long as the shortest strut. `None` if the longest is more than
    /// twice that, or open.
    pub fn telescope(&self) -> Option<Interval> {
        self.length_range().filter(|(min, max)| max.hi <= 2.0 * min.lo).map(|(min, _)| min)
    }
}
