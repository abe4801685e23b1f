//! Certified adaptive paving of the workspace: one tree of boxes, every working mode in one pass.

mod budget;
mod classify;
mod refine;
mod touch;
mod tree;

pub use budget::{Budget, Control, MAX_BOXES, MAX_DEPTH, PAVING_SHARE, Progress, Stop};
pub use tree::{AXES, BoxOf, ClassSet, MODES, Mark, Node, Paving};

pub(crate) use refine::for_paving;
