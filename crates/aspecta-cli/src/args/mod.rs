//! Options that several commands share, each typed once, and the meaning of their values.
//!
//! Where commands use an option for different things, each says what for by [`help`].

pub mod away;
pub mod budget;
pub mod det;
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
