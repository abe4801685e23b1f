//! Section 4 of the paper: the largest domains of the workspace in which a joint vector means one pose.

pub mod boundary;
pub mod characteristic;
