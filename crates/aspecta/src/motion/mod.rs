//! Motion: paths checked against singularities, between their samples too; paths planned; solutions followed in a control loop.

mod check;
pub mod crossing;
pub mod follow;
pub mod modes;
pub mod plan;

pub use check::{Extreme, Obstacle, PathCheck, PathError, ProfilePoint, check_path};
