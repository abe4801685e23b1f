//! Robots as files of other programs.

pub mod mjcf;
