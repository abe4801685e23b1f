//! What commands are told: options that several of them have, each typed once, and what their values mean.
//!
//! Where commands use an option for different things, they give it its help by `mut_arg`.

pub mod away;
pub mod budget;
pub mod drawing;
pub mod fix;
pub mod format;
pub mod given;
pub mod making;
pub mod mode;
pub mod out;
pub mod path;
pub mod planning;
pub mod rate;
pub mod robot;
pub mod threads;
