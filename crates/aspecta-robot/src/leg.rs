//! Legs, their actuators and their joint limits.

use crate::num::{Interval, Scalar};
use serde::{Deserialize, Serialize};

/// An orthonormal frame at the anchor of a leg: its rows are the unit vectors u, v, w in base
/// coordinates. Enclosures hold the exact frame. In the plane only the upper left 2 × 2 block counts.
pub type Frame = [[Interval; 3]; 3];

/// One leg: it ties the point A_i of the base to the point C_i of the platform.
///
/// Lengths are in the robot's unit. Every constant is an interval that holds the decimal number of
/// the robot file.
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
    /// What drives the leg.
    pub actuator: Actuator,
    /// Limits of its actuated and passive joints.
    pub limits: Vec<Limit>,
}

/// The driven joint of a leg and the lengths behind it. u, v, w are the leg's frame.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Actuator {
    /// RRR, RSS, RUS: a crank of length L turns by q (rad) from u towards v about w, a rod of length M
    /// follows. f = ‖C − A − L(cos q u + sin q v)‖² − M².
    Revolute {
        /// L > 0.
        crank: Interval,
        /// M > 0.
        rod: Interval,
    },
    /// PRR, PSS, PUS: a slider at A + q u, a rod of length M. f = ‖C − A − q u‖² − M².
    Prismatic {
        /// M > 0.
        rod: Interval,
    },
    /// RPR, UPS, SPS: the distance from A to C is driven. f = ‖C − A‖² − q², q > 0.
    Strut,
    /// RRR on a sphere: w_i = cos(proximal) w + sin(proximal)(cos q u + sin q v) is the intermediate
    /// joint, at the angle `distal` of the platform joint v_i. f = w_i · v_i − cos(distal).
    Spherical {
        /// (cos, sin) of the proximal link's angle.
        proximal: (Interval, Interval),
        /// cos of the distal link's angle.
        distal_cos: Interval,
    },
}

impl Actuator {
    /// The name used in robot files.
    pub const fn kind(&self) -> &'static str {
        match self {
            Self::Revolute { .. } => "revolute",
            Self::Prismatic { .. } => "prismatic",
            Self::Strut => "strut",
            Self::Spherical { .. } => "spherical",
        }
    }

    /// How many inverse solutions the leg has: 2, or 1 for a strut.
    pub const fn postures(&self) -> usize {
        match self {
            Self::Strut => 1,
            _ => 2,
        }
    }

    /// Whether q is an angle (rad) rather than a length.
    pub const fn is_angle(&self) -> bool {
        matches!(self, Self::Revolute { .. } | Self::Spherical { .. })
    }

    /// The greatest H can be: (2LM)², M² or (sin sin)²; `None` for struts, whose H has no
    /// zero to keep away from. Makes reaches comparable.
    pub fn greatest_reach(&self) -> Option<Interval> {
        let one = Interval::point(1.0);
        match self {
            Self::Revolute { crank, rod } => Some(((*crank + *crank) * *rod).square()),
            Self::Prismatic { rod } => Some(rod.square()),
            Self::Strut => None,
            Self::Spherical { proximal, distal_cos } => {
                Some(proximal.1.square() * (one - distal_cos.square()))
            }
        }
    }

    /// The size of the terms of the leg equation, approximately, to judge a residual by.
    pub fn equation_scale(&self, q: f64) -> f64 {
        match self {
            Self::Revolute { crank, rod } => (crank.mid() + rod.mid()).powi(2),
            Self::Prismatic { rod } => rod.mid().powi(2) + q * q,
            Self::Strut => q * q,
            Self::Spherical { .. } => 1.0,
        }
    }

    /// The sum of the link lengths, approximately (1 for struts and spherical legs).
    pub fn size(&self) -> f64 {
        match self {
            Self::Revolute { crank, rod } => crank.mid() + rod.mid(),
            Self::Prismatic { rod } => rod.mid(),
            Self::Strut | Self::Spherical { .. } => 1.0,
        }
    }
}

/// A joint limit: a condition that a configuration within the limits fulfils strictly.
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
    /// The same angle in space, where it has no sign: between min and max in [0, π].
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
}

/// The frame whose vectors are those of the base.
pub const BASE_FRAME: Frame = {
    const O: Interval = Interval::point(0.0);
    const I: Interval = Interval::point(1.0);
    [[I, O, O], [O, I, O], [O, O, I]]
};

/// A point with exact coordinates given as decimals.
pub fn point(p: [f64; 3]) -> [Interval; 3] {
    p.map(Interval::decimal)
}

impl Limit {
    /// The joint it limits, as robot files call it.
    pub fn joint(&self) -> &'static str {
        match self {
            Self::ActuatorAngle { .. } | Self::ActuatorLength { .. } => "actuator",
            Self::Elbow { .. } | Self::SpatialElbow { .. } => "elbow",
            Self::BaseCone { .. } => "base-joint",
            Self::PlatformCone { .. } => "platform-joint",
        }
    }
}

impl Leg {
    /// A revolute-driven leg in the plane: crank `l` turning from the x axis, rod `m`.
    pub fn revolute(anchor: [f64; 2], attachment: [f64; 2], l: f64, m: f64) -> Self {
        let actuator = Actuator::Revolute { crank: Interval::decimal(l), rod: Interval::decimal(m) };
        Self::planar(anchor, attachment, actuator)
    }

    /// A strut in the plane.
    pub fn strut(anchor: [f64; 2], attachment: [f64; 2]) -> Self {
        Self::planar(anchor, attachment, Actuator::Strut)
    }

    fn planar(a: [f64; 2], c: [f64; 2], actuator: Actuator) -> Self {
        Self {
            anchor: point([a[0], a[1], 0.0]),
            attachment: point([c[0], c[1], 0.0]),
            frame: BASE_FRAME,
            actuator,
            limits: Vec::new(),
        }
    }

    /// The range of the driven joint, if it has one: rad (about the middle, which is in (−π, π]) or length units.
    pub fn drive_range(&self) -> Option<(f64, f64)> {
        self.limits.iter().find_map(|limit| match limit {
            Limit::ActuatorAngle { middle: (cos, sin), half_cos } => {
                let (middle, half) = (sin.mid().atan2(cos.mid()), half_cos.mid().acos());
                Some((middle - half, middle + half))
            }
            Limit::ActuatorLength { min, max } => Some((min.mid(), max.mid())),
            _ => None,
        })
    }

    /// [`Leg::drive_range`], certainly held: half-width and middle are those of the limit, not of rounded angles.
    pub fn drive_enclosure(&self) -> Option<Interval> {
        self.limits.iter().find_map(|limit| match limit {
            Limit::ActuatorAngle { middle, half_cos } => {
                let half = Interval::angle(*half_cos, (Interval::point(1.0) - half_cos.square()).sqrt())?;
                let middle = Interval::angle(middle.0, middle.1)?;
                Some((middle - half).hull(middle + half))
            }
            Limit::ActuatorLength { min, max } => Some(min.hull(*max)),
            _ => None,
        })
    }

    /// The limits of a driven length, if it has any: (min, max).
    pub fn length_range(&self) -> Option<(Interval, Interval)> {
        self.limits.iter().find_map(|l| match l {
            Limit::ActuatorLength { min, max } => Some((*min, *max)),
            _ => None,
        })
    }
}
