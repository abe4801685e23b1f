//! Motion: paths checked against singularities, between their samples too.

mod check;

pub use check::{Extreme, Obstacle, PathCheck, PathError, ProfilePoint, check_path};
