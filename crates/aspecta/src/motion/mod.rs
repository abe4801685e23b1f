//! Motion: paths checked against singularities, between their samples too; timed under joint limits; solutions followed in a control loop.

mod check;
pub mod follow;
mod spline;
pub mod time;

pub use check::{
    Asked, Clearance, Joined, Least, Obstacle, PathCheck, PathError, PathOptions, ProfilePoint, check_joints,
    check_path, check_poses,
};
