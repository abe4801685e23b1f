//! # Aspecta
//!
//! Which solution is a parallel robot in, and where can it go from there without meeting a singularity?
//!
//! The theory is Chablat & Wenger, *Mechanism and Machine Theory* 36(6), 2001; "the paper" throughout.
//! Data flows one way: [`robot`] → [`kinematics`] → [`paving`] → [`aspect`] → [`domain`] → [`motion`].
//! Beside it stands [`verify`], which shares next to nothing with the rest and checks what [`certificate`]s claim.

// A variant that is added leads to every place that must decide about it.
#![warn(clippy::wildcard_enum_match_arm)]

pub mod aspect;
pub mod domain;
pub mod motion;
pub mod paving;

pub use aspecta_kinematics as kinematics;
pub use aspecta_kinematics::Kinematics;
pub use aspecta_robot as robot;
pub use aspecta_robot::{legs, num};
pub use aspecta_verify as verify;
pub use aspecta_verify::certificate;
