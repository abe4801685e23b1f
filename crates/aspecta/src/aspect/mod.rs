//! Working modes, generalized aspects and their certified counts (section 3 of the paper).
//!
//! | paper | here |
//! |---|---|
//! | Theorem 1 | [`LegReport`] |
//! | Def. 5, parallel aspects | [`Analysis::parallel_aspects`]; "unless it is zero everywhere": [`SingularMode`] |
//! | Def. 6, serial aspects | [`Analysis::serial_aspects`] |
//! | Def. 7, working modes | [`aspecta_robot::WorkingMode`], [`ModeReport`] |
//! | Def. 8, generalized aspects | [`Aspect`], [`AspectClass`] |

mod analyze;
mod ascent;
mod atlas;
mod certify;
mod components;
mod count;
mod doubt;
mod earlier;
mod id;
mod measure;
mod options;
mod project;
mod refusal;
mod result;
mod saddle;
mod scale;
mod seams;
mod search;
mod singular;
mod summit;

pub(crate) use components::UnionFind;

pub use analyze::analyze;
pub use aspecta_robot::constraint::Scale;
pub use certify::certify;
pub use id::{AspectId, ClassId};
pub use measure::{Held, Measure, Unit};
pub use options::{Options, Purpose};
pub use refusal::AnalysisError;
pub use result::{
    Analysis, Aspect, AspectClass, Cell, Count, DetSign, Doubt, DoubtKind, EarlierAspects, EarlierDomain,
    FORMAT_VERSION, LegReport, ModeReport, Place, Reachable, Run, Sample,
};
pub use scale::typical;
pub use singular::SingularMode;
