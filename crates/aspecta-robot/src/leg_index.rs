//! Which of a robot's legs.

use serde::{Serialize, Serializer};
use std::fmt;

/// One of a robot's legs: an index into [`Robot::legs`](crate::Robot::legs), and so into joint vectors.
///
/// Indices count from 0, as vectors do. Numbers count from 1: messages, tables and JSON say the number.
///
/// # Examples
/// ```
/// use aspecta_robot::{LegIndex, catalogue};
///
/// let robot = catalogue::find("five-bar").unwrap();
/// let leg = LegIndex::new(1);
/// assert_eq!((leg.index(), leg.number()), (1, 2));
/// assert_eq!(format!("leg {leg}"), "leg 2");
/// assert_eq!(robot.leg(leg).actuator.postures(), 2);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct LegIndex(usize);

impl LegIndex {
    /// The leg with this index, from 0.
    pub const fn new(index: usize) -> Self {
        Self(index)
    }

    /// Returns its index, from 0.
    pub const fn index(self) -> usize {
        self.0
    }

    /// Returns its number, from 1.
    pub const fn number(self) -> usize {
        self.0 + 1
    }
}

/// Its number, from 1.
impl fmt::Display for LegIndex {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.number().fmt(f)
    }
}

/// Its number, from 1.
impl Serialize for LegIndex {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.number().serialize(serializer)
    }
}

/// For `serde(with)`: certificates and maps, which are read back, have the index, from 0.
pub(crate) mod as_index {
    use super::LegIndex;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub fn serialize<S: Serializer>(leg: &LegIndex, serializer: S) -> Result<S::Ok, S::Error> {
        leg.0.serialize(serializer)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<LegIndex, D::Error> {
        usize::deserialize(deserializer).map(LegIndex)
    }
}

/// [`as_index`] of two legs.
pub(crate) mod as_indices {
    use super::LegIndex;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub fn serialize<S: Serializer>(legs: &[LegIndex; 2], serializer: S) -> Result<S::Ok, S::Error> {
        legs.map(LegIndex::index).serialize(serializer)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<[LegIndex; 2], D::Error> {
        Ok(<[usize; 2]>::deserialize(deserializer)?.map(LegIndex))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chart::{Chain, Chart};
    use crate::constraint::{Constraint, constraint};

    /// Results count legs from 1; the files of certificates and maps count them from 0, and read so.
    #[test]
    fn json_has_numbers_and_files_have_indices() {
        let leg = LegIndex::new(1);
        assert_eq!(serde_json::to_string(&leg).unwrap(), "2");
        let named = constraint(&Constraint::Limit(leg, 0), serde_json::value::Serializer).unwrap();
        assert_eq!(named, serde_json::json!({ "kind": "limit", "leg": 2, "limit": 1 }));
        assert_eq!(format!("{leg:>3}, {}", Constraint::Reach(leg)), "  2, H_2");

        let (chart, reach) = (Chart::Chain(Chain { leg, bend: None }), Constraint::Limit(leg, 0));
        let files = [serde_json::to_string(&chart).unwrap(), serde_json::to_string(&reach).unwrap()];
        assert_eq!(files, [r#"{"chain":{"leg":1}}"#, r#"{"Limit":[1,0]}"#]);
        assert_eq!(serde_json::from_str::<Chart>(&files[0]).unwrap(), chart);
        assert_eq!(serde_json::from_str::<Constraint>(&files[1]).unwrap(), reach);
    }
}
