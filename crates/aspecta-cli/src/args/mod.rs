//! What commands are told: options that several of them have, each typed once, and what their values mean.

pub mod away;
pub mod budget;
pub mod drawing;
pub mod fix;
pub mod format;
pub mod given;
pub mod making;
pub mod path;
pub mod planning;
