//! The tables of a robot file that are about more than one leg, and those of bodies.

use super::format::{Angle, At, Number, Pair, Vector};
use schemars::JsonSchema;
use serde::Deserialize;

/// Bodies of the machine: links with a radius, which need not be 0 in the plane, and bodies of the platform. Two of one layer that share no
/// joint keep clear of one another.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, expecting = "the bodies of the machine")]
pub(super) struct BodiesTable {
    /// Half the thickness of every link of which nothing else is said; 0 for thin links in the plane. A link without radius meets nothing.
    pub radius: Option<Number>,
    /// The layer of every link of which nothing else is said (plane), 0 if left out.
    pub layer: Option<Number>,
    /// What is to be left between two bodies besides their radii, 0 if left out.
    pub clearance: Option<Number>,
    /// Bodies of the platform.
    #[serde(default)]
    pub platform: Vec<At<CapsuleTable>>,
}

/// The bodies of a leg.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, expecting = "the bodies of a leg")]
pub(super) struct LegBodiesTable {
    /// Half the thickness of its links.
    pub radius: Option<Number>,
    /// The layer of its links (plane).
    pub layer: Option<Number>,
    /// The crank alone (revolute).
    pub crank: Option<At<LinkTable>>,
    /// The rod, or the strut, alone.
    pub rod: Option<At<LinkTable>>,
}

/// A link as a body.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, expecting = "the body of a link, { radius = … }")]
pub(super) struct LinkTable {
    /// Half its thickness.
    pub radius: Option<Number>,
    /// Its layer (plane).
    pub layer: Option<Number>,
}

/// A body of the platform: all points at most `radius` away from the segment between its `ends`, or from its `centre`.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, expecting = "a body, { ends = …, radius = … }")]
pub(super) struct CapsuleTable {
    /// The centre of a disc or ball, in the platform frame.
    pub centre: Option<At<Vector>>,
    /// The two ends of its axis, in the platform frame.
    pub ends: Option<At<Vec<At<Vector>>>>,
    /// Half its thickness.
    pub radius: Option<Number>,
    /// Its layer (plane), 0 if left out.
    pub layer: Option<Number>,
}

/// A disc, or a ball in space, `centre` and `radius`; a bar, `ends` and `radius`; or a wall, `face` and `normal`.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(
    rename_all = "kebab-case",
    deny_unknown_fields,
    expecting = "an obstacle, centre and radius, ends and radius or face and normal"
)]
pub(super) struct ObstacleTable {
    /// The centre of a disc or ball.
    pub centre: Option<At<Vector>>,
    /// The two ends of the axis of a bar.
    pub ends: Option<At<Vec<At<Vector>>>>,
    /// The radius of a disc or ball; half the thickness of a bar, 0 if left out.
    pub radius: Option<Number>,
    /// A point on the face of a wall.
    pub face: Option<At<Vector>>,
    /// The direction out of the wall, of any length.
    pub normal: Option<At<Vector>>,
    /// What is to be left between it and a body of the machine besides the radius of that (of a link without one, the axis), 0 if left out.
    pub clearance: Option<Number>,
    /// The layer in which it is (plane); in all if left out.
    pub layer: Option<Number>,
}

/// The range of the angle between the rods of two legs, within 0° to 180°.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, expecting = "a limit of the angle between two rods")]
pub(super) struct RodAngleTable {
    /// The numbers of the two legs, from 1.
    #[schemars(length(min = 2, max = 2))]
    pub legs: At<Vec<Number>>,
    /// The range.
    pub angle: At<Angle<Pair>>,
}
