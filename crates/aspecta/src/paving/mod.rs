//! Certified adaptive paving of the workspace: one tree of boxes, every working mode in one pass.

mod budget;
mod classify;
mod refine;
mod share;
mod touch;
mod tree;

pub use aspecta_robot::work::{Control, Progress};
pub use aspecta_robot::{AXES, ClassSet, MAX_BOXES, MODES};
pub use budget::{Budget, MAX_DEPTH, PAVING_SHARE, Stop};
pub use share::{Share, Shares};
pub use tree::{BoxOf, Mark, Node, Paving};

pub(crate) use refine::for_paving;
