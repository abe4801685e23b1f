//! The extent of an analysis: the coordinates that are fixed, and the unit in which the others are measured.

use aspecta_robot::{Robot, Window};
use serde::{Serialize, Serializer};
use std::fmt;

/// A coordinate that is held at a value, in a slice.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Held {
    /// Its name.
    pub coordinate: &'static str,
    /// The value: certificates hold for this double (length unit or rad).
    pub value: f64,
    /// Unit of the value.
    pub unit: String,
}

impl Held {
    pub(super) fn all(robot: &Robot, window: &Window) -> Vec<Self> {
        let held = |(k, value): (usize, f64)| {
            let coordinate = robot.platform.coordinates()[k].name;
            Self { coordinate, value, unit: unit(robot, window.angles[k]).to_owned() }
        };
        window.held().map(held).collect()
    }
}

/// `phi = 0.5 rad`, the value in as many digits as it takes to read it back.
impl fmt::Display for Held {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} = {} {}", self.coordinate, self.value, self.unit)
    }
}

/// The quantity that an analysis measures, of poses as sets of the coordinates that vary, and its unit.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Measure {
    /// `length`, `angle`, `area` or `volume`.
    pub name: &'static str,
    /// The product of the units of the coordinates that vary.
    pub unit: Unit,
}

impl Measure {
    pub(crate) fn over(robot: &Robot, window: &Window) -> Self {
        let axes = window.axes();
        let angles = axes.iter().filter(|&&k| window.angles[k]).count();
        let name = match (axes.len(), angles) {
            (1, 0) => "length",
            (1, _) => "angle",
            (2, _) => "area",
            _ => "volume",
        };
        let factors = [(false, axes.len() - angles), (true, angles)];
        let present = factors.into_iter().filter(|(_, power)| *power > 0);
        Self { name, unit: Unit(present.map(|(angle, n)| (unit(robot, angle).to_owned(), n)).collect()) }
    }
}

/// A product of powers of units; `mm^2 rad` as a text and in JSON.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Unit(pub Vec<(String, usize)>);

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let power = |(unit, n): &(String, usize)| if *n == 1 { unit.clone() } else { format!("{unit}^{n}") };
        f.write_str(&self.0.iter().map(power).collect::<Vec<_>>().join(" "))
    }
}

impl Serialize for Unit {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

/// The unit of a coordinate.
fn unit(robot: &Robot, angle: bool) -> &str {
    if angle { "rad" } else { &robot.length_unit }
}
