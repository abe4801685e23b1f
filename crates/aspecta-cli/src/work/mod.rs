//! Work that several commands do with the library before anything is shown.

pub mod mapping;
pub mod planning;
pub mod solve;
pub mod timing;
pub mod watch;
