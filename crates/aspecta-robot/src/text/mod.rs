//! Vectors and numbers as people read them: what the texts of all results are made of.

mod labels;
mod limits;
mod numbers;

pub use labels::{Labels, det_a_unit};
pub use numbers::{between, brief, number, subscript, unsigned};
