//! What is drawn and written of an analysis: well-formed, and true to the robot.

mod common;
mod figures;
mod motion;
mod regions;
mod report;
