//! Motion: paths checked against singularities, between their samples too; paths planned; solutions followed in a control loop.

pub mod assembly;
mod check;
pub mod crossing;
pub mod follow;
pub mod modes;
pub mod plan;
pub mod traverse;

pub use check::{Extreme, Obstacle, PathCheck, PathError, ProfilePoint, check_path};
