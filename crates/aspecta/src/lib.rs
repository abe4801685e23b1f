//! # Aspecta
//!
//! Which solution is a parallel robot in, and where can it go from there without meeting a singularity?
//!
//! The theory is Chablat & Wenger, *Mechanism and Machine Theory* 36(6), 2001; "the paper" throughout.
//! Data flows one way: [`robot`] → [`kinematics`] → `paving` → `aspect` → `motion`.
//! Beside it stands [`verify`], which shares next to nothing with the rest and checks what [`certificate`]s claim.

pub mod aspect;
pub mod certificate;
pub mod domain;
pub mod kinematics;
pub mod motion;
pub mod num;
pub mod paving;
pub mod robot;
pub mod verify;
