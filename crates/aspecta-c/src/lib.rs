//! The C interface: `include/aspecta.h`, where it is documented.
//!
//! All that is unsafe here is what C leaves to the caller: that pointers are null or valid, that vectors have n numbers, that a
//! handle is used by one thread at a time and not after it was freed.

mod start;
mod step;

pub use start::{aspecta_free, aspecta_inverse_free, aspecta_inverse_start, aspecta_start};
pub use step::{
    aspecta_dof, aspecta_inverse_last, aspecta_inverse_step, aspecta_last, aspecta_report, aspecta_step,
};

use aspecta::motion::follow::{Follower, InverseFollower};

/// Certified.
pub const OK: i32 = 0;
/// Refused: a parallel singularity is ahead.
pub const PARALLEL: i32 = 1;
/// Refused: a serial singularity is ahead.
pub const SERIAL: i32 = 2;
/// Refused: too long for a proof.
pub const TOO_LONG: i32 = 3;
/// The numbers cannot be used.
pub const BAD_INPUT: i32 = 4;
/// A pointer is null.
pub const NULL: i32 = 5;

/// What C holds a pointer to.
#[allow(non_camel_case_types)]
pub struct aspecta_follower(Follower);

/// The same for the inverse problem.
#[allow(non_camel_case_types)]
pub struct aspecta_inverse(InverseFollower);
