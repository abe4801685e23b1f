//! The shape of a robot file. These types are what serde reads and what the JSON Schema is made from:
//! their doc comments are the descriptions an editor shows.

use super::schema::keys_of_each_kind;
use super::tables::{BodiesTable, LegBodiesTable, ObstacleTable, RodAngleTable};
use crate::Platform;
use crate::legs::Kind;
use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::{Deserializer, Error, MapAccess, SeqAccess, Visitor, value::SeqAccessDeserializer};
use std::fmt;
use std::ops::Range as Span;
use std::sync::LazyLock;

/// A value and where it stands in the file (bytes).
#[derive(Clone, Debug)]
pub(super) struct At<T> {
    pub value: T,
    pub span: Span<usize>,
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for At<T> {
    fn deserialize<D: Deserializer<'de>>(d: D) -> Result<Self, D::Error> {
        let spanned = toml::Spanned::<T>::deserialize(d)?;
        Ok(Self { span: spanned.span(), value: spanned.into_inner() })
    }
}

/// A TOML integer or float.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plain(pub f64);

impl<'de> Deserialize<'de> for Plain {
    fn deserialize<D: Deserializer<'de>>(d: D) -> Result<Self, D::Error> {
        struct Reader;
        impl Visitor<'_> for Reader {
            type Value = Plain;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a number")
            }
            fn visit_i64<E: Error>(self, x: i64) -> Result<Plain, E> {
                Ok(Plain(x as f64))
            }
            fn visit_u64<E: Error>(self, x: u64) -> Result<Plain, E> {
                Ok(Plain(x as f64))
            }
            fn visit_f64<E: Error>(self, x: f64) -> Result<Plain, E> {
                Ok(Plain(x))
            }
        }
        d.deserialize_any(Reader)
    }
}

pub(super) type Number = At<Plain>;

/// [min, max].
#[derive(Clone, Debug, Deserialize)]
#[serde(try_from = "Vec<Number>")]
pub(super) struct Pair(pub [Number; 2]);

impl TryFrom<Vec<Number>> for Pair {
    type Error = &'static str;
    fn try_from(numbers: Vec<Number>) -> Result<Self, &'static str> {
        numbers.try_into().map(Self).map_err(|_| "expected two numbers, [min, max]")
    }
}

/// The unit of an angle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Unit {
    Deg,
    Rad,
}

/// An angle, or a range of angles, with its unit: `{ deg = … }` or `{ rad = … }`.
#[derive(Clone, Debug)]
pub(super) struct Angle<T> {
    pub unit: Unit,
    pub value: T,
}

impl<T> Angle<T> {
    const EXPECTED: &'static str = "an angle with its unit, { deg = … } or { rad = … }";

    fn from_map<'de, A: MapAccess<'de>>(mut map: A) -> Result<Self, A::Error>
    where
        T: Deserialize<'de>,
    {
        let one = || A::Error::custom(format!("expected {}, and one of them only", Self::EXPECTED));
        let unit = map.next_key()?.ok_or_else(one)?;
        let value = map.next_value()?;
        if map.next_key::<Unit>()?.is_some() { Err(one()) } else { Ok(Self { unit, value }) }
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Angle<T> {
    fn deserialize<D: Deserializer<'de>>(d: D) -> Result<Self, D::Error> {
        struct Reader<T>(std::marker::PhantomData<T>);
        impl<'de, T: Deserialize<'de>> Visitor<'de> for Reader<T> {
            type Value = Angle<T>;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str(Angle::<T>::EXPECTED)
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Angle<T>, A::Error> {
                Angle::from_map(map)
            }
        }
        d.deserialize_any(Reader(std::marker::PhantomData))
    }
}

/// A range: of a length, `[min, max]`, or of an angle, `{ deg = [min, max] }` or `{ rad = [min, max] }`.
#[derive(Clone, Debug)]
pub(super) enum Range {
    Length(Pair),
    Angle(Angle<Pair>),
}

impl<'de> Deserialize<'de> for Range {
    fn deserialize<D: Deserializer<'de>>(d: D) -> Result<Self, D::Error> {
        struct Reader;
        impl<'de> Visitor<'de> for Reader {
            type Value = Range;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str(
                    "[min, max] for a length, { deg = [min, max] } or { rad = [min, max] } for an angle",
                )
            }
            fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<Range, A::Error> {
                Pair::deserialize(SeqAccessDeserializer::new(seq)).map(Range::Length)
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Range, A::Error> {
                Angle::from_map(map).map(Range::Angle)
            }
        }
        d.deserialize_any(Reader)
    }
}

/// A point or a direction: 2 numbers in the plane, 3 in space.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(transparent)]
pub(super) struct Vector(#[schemars(length(min = 2, max = 3))] pub Vec<Number>);

/// A fully parallel robot: a platform and one leg for each of its degrees of freedom.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, expecting = "a robot")]
#[schemars(title = "Aspecta robot file")]
pub(super) struct RobotFile {
    /// Short name, as on the command line.
    #[schemars(length(min = 1))]
    pub name: At<String>,
    /// One line that says what the robot is.
    pub title: Option<At<String>>,
    /// Where the figures come from, in one line.
    pub source: Option<At<String>>,
    /// Unit of all lengths, shown in tables and figures; nothing is converted.
    #[schemars(extend("default" = "unit"))]
    pub length_unit: Option<At<String>>,
    /// What the platform can do; fixes the pose coordinates and the number of legs.
    pub platform: At<Platform>,
    /// The legs, in the order of the joint coordinates.
    #[serde(default)]
    pub legs: Vec<At<LegTable>>,
    /// Limits that two legs share: the angle between their rods.
    #[serde(default)]
    pub rod_angles: Vec<At<RodAngleTable>>,
    /// The thickness of links and other bodies of the machine, which keep clear of one another.
    pub bodies: Option<At<BodiesTable>>,
    /// Bodies of the surroundings that the machine keeps clear of.
    #[serde(default)]
    pub obstacles: Vec<At<ObstacleTable>>,
    /// Bounds on pose coordinates, within what the legs reach.
    #[serde(default)]
    pub window: WindowTable,
}

/// A leg: it ties the point A of the base to the point C of the platform.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, expecting = "the table of a leg")]
pub(super) struct LegTable {
    /// A, in base coordinates. Spherical legs have none: they all pivot about the origin.
    pub anchor: Option<At<Vector>>,
    /// C, in the platform frame (default: its origin). For a spherical leg the direction of the platform
    /// joint, of any length.
    pub attachment: Option<At<Vector>>,
    /// What drives the leg.
    pub actuator: At<ActuatorTable>,
    /// Limits of the leg's joints.
    #[serde(default)]
    pub limits: LimitsTable,
    /// The thickness of its links.
    pub bodies: Option<At<LegBodiesTable>>,
}

/// The driven joint of a leg and the lengths behind it.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, expecting = "an actuator, { kind = …, … }")]
#[schemars(transform = keys_of_each_kind)]
pub(super) struct ActuatorTable {
    /// What is driven.
    pub kind: At<Kind>,
    /// Length of the driven crank (revolute).
    pub crank: Option<Number>,
    /// Length of the rod (revolute, prismatic).
    pub rod: Option<Number>,
    /// The rail, positive q first (prismatic); of any length.
    pub direction: Option<At<Vector>>,
    /// The motor's axis (revolute in space, spherical): q turns counter-clockwise about it; of any length.
    pub axis: Option<At<Vector>>,
    /// Where the crank points at q = 0 (revolute in space, spherical); its part along `axis` is ignored.
    pub zero: Option<At<Vector>>,
    /// Angle of the proximal link, from the motor's axis to the intermediate joint (spherical).
    pub proximal: Option<At<Angle<Number>>>,
    /// Angle of the distal link, from the intermediate to the platform joint (spherical).
    pub distal: Option<At<Angle<Number>>>,
}

/// The value of a key of an actuator.
#[derive(Clone, Copy, Debug)]
pub(super) enum Value<'a> {
    Number(&'a Number),
    Vector(&'a At<Vector>),
    Angle(&'a At<Angle<Number>>),
}

impl Value<'_> {
    pub fn span(self) -> Span<usize> {
        match self {
            Self::Number(number) => number.span.clone(),
            Self::Vector(vector) => vector.span.clone(),
            Self::Angle(angle) => angle.span.clone(),
        }
    }
}

impl ActuatorTable {
    /// All keys beside `kind`, with their values.
    pub fn values(&self) -> [(&'static str, Option<Value<'_>>); 7] {
        let Self { kind: _, crank, rod, direction, axis, zero, proximal, distal } = self;
        [
            ("crank", crank.as_ref().map(Value::Number)),
            ("rod", rod.as_ref().map(Value::Number)),
            ("direction", direction.as_ref().map(Value::Vector)),
            ("axis", axis.as_ref().map(Value::Vector)),
            ("zero", zero.as_ref().map(Value::Vector)),
            ("proximal", proximal.as_ref().map(Value::Angle)),
            ("distal", distal.as_ref().map(Value::Angle)),
        ]
    }

    /// The value of a key, if it is there.
    pub fn value_of(&self, key: &str) -> Option<Value<'_>> {
        self.values().into_iter().find(|(name, _)| *name == key)?.1
    }
}

/// The hint for a leg whose kind is missing.
static KINDS: LazyLock<String> = LazyLock::new(|| {
    let names: Vec<_> = Kind::ALL.iter().map(|kind| format!("`{}`", kind.name())).collect();
    format!("one of {}", names.join(", "))
});

/// Returns advice on what to write for a missing key.
pub(super) fn hint(key: &str) -> &'static str {
    match key {
        "name" => "give the robot a short name, name = \"my-robot\"",
        "platform" => {
            "say what the platform can do, one of `plane-point`, `plane-body`, `translating-body`, `turning-body`, \
             `free-body`"
        }
        "actuator" => "say what drives the leg, actuator = { kind = \"revolute\", … }",
        "kind" => &KINDS,
        "anchor" => "give the point A of the base, anchor = […]",
        "attachment" => "give the direction of the platform joint, attachment = […]",
        "crank" => "give the length of the driven crank",
        "rod" => "give the length of the rod",
        "direction" => "give the direction of the rail, direction = […]",
        "axis" => "give the direction of the axis, axis = […]",
        "zero" => "say where the crank points at q = 0, zero = […]",
        "legs" => "name the two legs, legs = [1, 2]",
        "angle" => "give the range of the angle between their rods, angle = { deg = [15, 165] }",
        "radius" => "give the radius, radius = …",
        "ends" => {
            "give the two ends of its axis, ends = [[…], […]], or the centre of a disc or ball, centre = […]"
        }
        "normal" => "give the direction out of the wall, normal = […]",
        "within" => "give the cone's half-angle, within = { deg = … }",
        "deg" => "give the range in the plane, { deg = [min, max] }",
        _ => "give the angle of the link, { deg = … }",
    }
}

/// Joint limits of a leg; a joint that is not named is free.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default, expecting = "the limits of a leg")]
pub(super) struct LimitsTable {
    /// The driven joint: `{ deg = [min, max] }` (revolute, spherical), `[min, max]` (prismatic, strut).
    pub actuator: Option<At<Range>>,
    /// The angle at B from crank to rod (revolute): in the plane counter-clockwise, in space from 0° to 180°.
    pub elbow: Option<At<Angle<Pair>>>,
    /// The direction of the rod (of the strut), fixed in the base.
    pub base_joint: Option<At<JointTable>>,
    /// The direction of the rod (of the strut), fixed in the platform.
    pub platform_joint: Option<At<JointTable>>,
}

/// The range of a direction: in the plane an angle from the x axis, `{ deg = [min, max] }`; in space a cone,
/// `{ axis = […], within = { deg = … } }`.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, expecting = "the range of a direction")]
pub(super) struct JointTable {
    /// Range from the x axis, counter-clockwise, in degrees (plane).
    pub deg: Option<Pair>,
    /// Range from the x axis, counter-clockwise, in radians (plane).
    pub rad: Option<Pair>,
    /// Axis of the cone (space), of any length.
    pub axis: Option<At<Vector>>,
    /// Half-angle of the cone (space).
    pub within: Option<At<Angle<Number>>>,
}

/// Bounds on pose coordinates: lengths `[min, max]`, angles `{ deg = [min, max] }`.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default, expecting = "bounds on pose coordinates")]
pub(super) struct WindowTable {
    /// Position of the platform's origin.
    pub x: Option<At<Range>>,
    /// Position of the platform's origin.
    pub y: Option<At<Range>>,
    /// Position of the platform's origin.
    pub z: Option<At<Range>>,
    /// Orientation of a body in the plane.
    pub phi: Option<At<Range>>,
    /// Rotation about x, first.
    pub roll: Option<At<Range>>,
    /// Rotation about y, second, within ±90°.
    pub pitch: Option<At<Range>>,
    /// Rotation about z, last.
    pub yaw: Option<At<Range>>,
}

impl WindowTable {
    /// The bounds by coordinate name.
    pub fn entries(&self) -> [(&'static str, Option<&At<Range>>); 7] {
        [
            ("x", self.x.as_ref()),
            ("y", self.y.as_ref()),
            ("z", self.z.as_ref()),
            ("phi", self.phi.as_ref()),
            ("roll", self.roll.as_ref()),
            ("pitch", self.pitch.as_ref()),
            ("yaw", self.yaw.as_ref()),
        ]
    }
}
