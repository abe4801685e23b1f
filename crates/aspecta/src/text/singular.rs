//! Wording of working modes in which det A vanishes at every pose.

use super::{between, brief};
use crate::aspect::{Analysis, SingularMode};

/// A sentence for each of these modes: why it has no aspects, and what there is of it.
pub fn singular_modes(analysis: &Analysis) -> Vec<String> {
    let sentence = |found: &SingularMode| {
        let SingularMode { mode, legs: [first, second], low, high, measure, .. } = found;
        let domains = match high {
            Some(0) => "which does not exist within the limits".to_owned(),
            _ => {
                let (name, unit) = (analysis.measure.name, &analysis.measure.unit);
                format!("{}, {name} of {} {unit}", between(*low, *high, "domain", "domains"), brief(*measure))
            }
        };
        format!(
            "Mode {mode} ({domains}): det A vanishes everywhere, for legs {first} and {second} are one and the same, in the same posture. The \
             platform moves with all motors locked; a mode like this has no aspects (Defs 5 and 8)."
        )
    };
    analysis.singular_modes.iter().map(sentence).collect()
}
