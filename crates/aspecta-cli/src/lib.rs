//! What the `aspecta` program shows to people: figures and the report page.
//!
//! Everything is drawn from an [`aspecta::aspect::Analysis`]; nothing here decides anything about a robot.

pub mod figure;
pub mod report;
