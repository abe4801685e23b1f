//! Working modes, generalized aspects and their certified counts (section 3 of the paper).

mod result;

pub use result::{
    Analysis, Aspect, AspectClass, Cell, Count, DetSign, LegReport, ModeReport, OldAspects, OldAspectSet, Reachable,
    Run, Sample, Stop,
};
