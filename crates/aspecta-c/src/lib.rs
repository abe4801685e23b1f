//! The C interface. Its documentation is that of `include/aspecta.h`, which cbindgen makes of these files.
//!
//! All that is unsafe here is what C leaves to the caller: that pointers are null or valid, that vectors have n numbers, that a
//! handle is used by one thread at a time and not after it was freed.

mod start;
mod step;

pub use start::{aspecta_free, aspecta_inverse_free, aspecta_inverse_start, aspecta_start};
pub use step::{
    aspecta_dof, aspecta_inverse_last, aspecta_inverse_step, aspecta_last, aspecta_report, aspecta_step,
};

use aspecta_kinematics::follow::{Follower, InverseFollower};

/// What a call came to.
#[allow(non_camel_case_types)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub enum aspecta_status {
    /// Certified.
    ASPECTA_OK = 0,
    /// Refused: a parallel singularity is ahead. The handle stays where it was, as after every other status but
    /// ASPECTA_OK.
    ASPECTA_PARALLEL = 1,
    /// Refused: a serial singularity of a leg is ahead, the end of its reach.
    ASPECTA_SERIAL = 2,
    /// Refused: the step is too long for a proof, or a jump.
    ASPECTA_TOO_LONG = 3,
    /// A number is not finite or beyond +-1e7, or the length of a strut is not positive.
    ASPECTA_BAD_INPUT = 4,
    /// A pointer is null.
    ASPECTA_NULL = 5,
}

/// A solution of the direct problem that is followed.
#[allow(non_camel_case_types)]
pub struct aspecta_follower(Follower);

/// A solution of the inverse problem that is followed.
#[allow(non_camel_case_types)]
pub struct aspecta_inverse(InverseFollower);
