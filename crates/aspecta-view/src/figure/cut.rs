//! The data that pictures and meshes of an aspect are made of.

use aspecta::domain::{Domains, Map, Mesh};

/// An aspect cut into its regions, and the surfaces that bound them.
#[derive(Clone, Copy, Debug)]
pub struct Cut<'a> {
    /// The robot and its aspects.
    pub map: &'a Map,
    /// The regions of one of its aspects.
    pub domains: &'a Domains,
    /// The boundary of that aspect.
    pub boundary: &'a Mesh,
    /// Its characteristic surfaces.
    pub surface: &'a Mesh,
}
