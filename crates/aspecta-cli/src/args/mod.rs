//! What commands are told: options that several of them have, each typed once, and what their values mean.
//!
//! Where commands use an option for different things, each says what for by [`help`].

pub mod away;
pub mod budget;
pub mod drawing;
pub mod fix;
pub mod format;
pub mod given;
pub mod help;
pub mod making;
pub mod mode;
pub mod out;
pub mod path;
pub mod planning;
pub mod rate;
pub mod robot;
pub mod threads;
