//! Constraints as JSON names them, legs and limits counted from 1.

use super::Constraint;
use crate::{Body, LegIndex, bodies};
use serde::{Serialize, Serializer};

#[derive(Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
enum Named {
    #[serde(rename = "det A")]
    Det,
    Reach {
        leg: LegIndex,
    },
    Limit {
        leg: LegIndex,
        limit: usize,
    },
    #[serde(rename = "rod angle")]
    RodAngle {
        legs: [LegIndex; 2],
    },
    Contact {
        #[serde(serialize_with = "bodies::names")]
        bodies: [Body; 2],
    },
}

impl From<Constraint> for Named {
    fn from(constraint: Constraint) -> Self {
        match constraint {
            Constraint::Det => Self::Det,
            Constraint::Reach(leg) => Self::Reach { leg },
            Constraint::Limit(leg, limit) => Self::Limit { leg, limit: limit + 1 },
            Constraint::RodAngle(legs, _) => Self::RodAngle { legs },
            Constraint::Apart(bodies, _) => Self::Contact { bodies },
        }
    }
}

/// Writes a constraint, for `serialize_with`.
pub fn constraint<S: Serializer>(constraint: &Constraint, serializer: S) -> Result<S::Ok, S::Error> {
    Named::from(*constraint).serialize(serializer)
}

/// Writes a constraint, or null where there is none.
pub fn if_any<S: Serializer>(constraint: &Option<Constraint>, serializer: S) -> Result<S::Ok, S::Error> {
    constraint.map(Named::from).serialize(serializer)
}
