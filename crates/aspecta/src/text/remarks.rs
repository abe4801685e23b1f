//! What the counts do not tell by themselves: modes in which det A vanishes at every pose, or keeps one sign.

use super::{between, brief};
use crate::aspect::{Analysis, SingularMode};

/// Why the modes of an Agile Eye have aspects of one sign only.
const AGILE_EYE: &str = "An Agile Eye, all angles 90°: det A keeps its sign in each working mode, and vanishes only on curves, where a leg is folded \
     and the platform turns with all motors locked. No refinement decides the boxes on them; curves part nothing.";

/// Remarks on Table 2, a paragraph each: why an Agile Eye has aspects of one sign only; of each mode in which det A vanishes at every pose, why
/// it has no aspects, and what there is of it.
pub fn remarks(analysis: &Analysis) -> Vec<String> {
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
    let eye = analysis.agile_eye.then(|| AGILE_EYE.to_owned());
    eye.into_iter().chain(analysis.singular_modes.iter().map(sentence)).collect()
}
