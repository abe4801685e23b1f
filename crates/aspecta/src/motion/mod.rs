//! Motion: paths checked against singularities, between their samples too; paths planned, and timed under joint limits; solutions followed in a control loop.

pub mod assembly;
mod check;
pub mod crossing;
pub mod follow;
pub mod modes;
pub mod plan;
mod spline;
pub mod time;
pub mod traverse;

pub use check::{
    Asked, Clearance, Joined, Least, Obstacle, PathCheck, PathError, PathOptions, ProfilePoint, check_joints,
    check_path, check_poses,
};
