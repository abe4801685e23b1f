//! The moving platform: a motion group and its pose coordinates.

use serde::{Deserialize, Serialize};
use std::fmt;

/// The motion group of the platform, which fixes n and the pose coordinates X.
///
/// | platform | group | X | examples |
/// |---|---|---|---|
/// | `plane-point` | R² | x, y | five-bar, 2-PRR |
/// | `plane-body` | SE(2) | x, y, φ | 3-RRR, 3-PRR, 3-RPR |
/// | `translating-body` | R³ | x, y, z | Delta, linear Delta, Orthoglide |
/// | `turning-body` | SO(3) | roll, pitch, yaw | spherical 3-RRR |
/// | `free-body` | SE(3) | x, y, z, roll, pitch, yaw | Hexa, Gough-Stewart |
///
/// Angles are in radians. Spatial orientations are R = R_z(yaw) R_y(pitch) R_x(roll).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Platform {
    /// A point of the plane.
    PlanePoint,
    /// A body in the plane.
    PlaneBody,
    /// A body in space that does not turn.
    TranslatingBody,
    /// A body that turns about a fixed point.
    TurningBody,
    /// A free body in space.
    FreeBody,
}

/// One pose coordinate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Coordinate {
    /// Its name: `x`, `y`, `z`, `phi`, `roll`, `pitch`, `yaw`.
    pub name: &'static str,
    /// Whether it is an angle (rad) rather than a length.
    pub angle: bool,
    /// Whether it is periodic with period 2π.
    pub periodic: bool,
}

const fn length(name: &'static str) -> Coordinate {
    Coordinate { name, angle: false, periodic: false }
}

const fn turn(name: &'static str) -> Coordinate {
    Coordinate { name, angle: true, periodic: true }
}

const X: Coordinate = length("x");
const Y: Coordinate = length("y");
const Z: Coordinate = length("z");
const PHI: Coordinate = turn("phi");
const ROLL: Coordinate = turn("roll");
const PITCH: Coordinate = Coordinate { name: "pitch", angle: true, periodic: false };
const YAW: Coordinate = turn("yaw");

impl Platform {
    /// All platforms, smallest first.
    pub const ALL: [Self; 5] =
        [Self::PlanePoint, Self::PlaneBody, Self::TranslatingBody, Self::TurningBody, Self::FreeBody];

    /// The pose coordinates, in the order in which poses are written.
    ///
    /// # Examples
    /// ```
    /// use aspecta_robot::Platform;
    ///
    /// let names: Vec<&str> = Platform::PlaneBody.coordinates().iter().map(|c| c.name).collect();
    /// assert_eq!(names, ["x", "y", "phi"]);
    /// assert_eq!((Platform::FreeBody.dof(), Platform::FreeBody.to_string()), (6, "free-body".to_owned()));
    /// ```
    pub const fn coordinates(self) -> &'static [Coordinate] {
        match self {
            Self::PlanePoint => &[X, Y],
            Self::PlaneBody => &[X, Y, PHI],
            Self::TranslatingBody => &[X, Y, Z],
            Self::TurningBody => &[ROLL, PITCH, YAW],
            Self::FreeBody => &[X, Y, Z, ROLL, PITCH, YAW],
        }
    }

    /// Degrees of freedom.
    pub const fn dof(self) -> usize {
        self.coordinates().len()
    }

    /// Dimension of the space the legs live in: 2 or 3.
    pub const fn space(self) -> usize {
        match self {
            Self::PlanePoint | Self::PlaneBody => 2,
            Self::TranslatingBody | Self::TurningBody | Self::FreeBody => 3,
        }
    }

    /// Whether it turns about more than one axis: its orientation then has no three coordinates without singularity.
    pub const fn turns_in_space(self) -> bool {
        matches!(self, Self::TurningBody | Self::FreeBody)
    }

    /// The indices of roll, pitch and yaw, for those platforms.
    pub const fn turns(self) -> Option<[usize; 3]> {
        match self {
            Self::TurningBody => Some([0, 1, 2]),
            Self::FreeBody => Some([3, 4, 5]),
            Self::PlanePoint | Self::PlaneBody | Self::TranslatingBody => None,
        }
    }

    /// The name used in robot files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::PlanePoint => "plane-point",
            Self::PlaneBody => "plane-body",
            Self::TranslatingBody => "translating-body",
            Self::TurningBody => "turning-body",
            Self::FreeBody => "free-body",
        }
    }
}

impl fmt::Display for Platform {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
