//! Motion: paths checked against singularities, between their samples too; paths planned, and timed under
//! joint limits; solutions followed in a control loop.

pub mod assembly;
pub mod crossing;
pub mod explore;
pub mod modes;
pub mod plan;
mod route;
mod search;
pub mod traverse;

pub use aspecta_kinematics::follow;
pub use aspecta_kinematics::path::{
    Asked, Bound, Clearance, Joined, Least, Obstacle, PathCheck, PathError, PathOptions, ProfilePoint,
    check_joints, check_path, check_poses, time,
};

/// a + t (b − a).
fn between(a: &[f64], b: &[f64], t: f64) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a + t * (b - a)).collect()
}
