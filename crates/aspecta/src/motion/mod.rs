//! Motion: paths checked against singularities, between their samples too; solutions followed in a control loop.

mod check;
pub mod follow;

pub use check::{Extreme, Obstacle, PathCheck, PathError, ProfilePoint, check_path};
