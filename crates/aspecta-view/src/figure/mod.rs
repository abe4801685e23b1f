//! Figures as standalone SVG: deterministic text, no external fonts or styles.
//!
//! What is *certified* in a figure is the colour of a cell (it lies in that aspect) and the white outside;
//! grey cells are undecided. Singular curves, postures and Q-aspects are drawn in plain f64: *numerical*.

pub mod axes;
pub mod barrier;
mod bodies;
pub mod components;
mod contacts;
pub mod curves;
pub mod cut;
pub(crate) mod film;
pub mod graph;
mod hues;
pub mod image;
pub mod joints;
mod label;
mod legend;
pub mod level;
pub mod maps;
mod oblique;
pub mod palette;
mod parts;
pub mod profile;
pub mod raster;
pub mod regions;
pub mod robot;
pub mod section;
pub mod shape;
pub(crate) mod skeleton;
pub mod slices;
pub mod stack;
pub mod strips;
pub mod survey;
pub mod svg;
