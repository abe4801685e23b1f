//! What the `aspecta` program shows to people: figures and the report page.
//!
//! Everything is drawn from an [`aspecta::aspect::Analysis`] or an [`aspecta::motion::PathCheck`]; nothing here decides anything about a robot.

pub mod domains;
pub mod doubt;
pub mod export;
pub mod figure;
pub mod file;
pub mod mesh;
pub mod report;
pub mod words;
