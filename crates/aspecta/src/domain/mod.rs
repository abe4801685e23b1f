//! Section 4 of the paper: the largest domains of the workspace in which a joint vector means one pose.
//!
//! An aspect may hold several poses of one joint vector. Its characteristic surfaces (Def. 9) are where such
//! a pose enters or leaves it; they cut it into basic regions (Def. 10), on each of which the number of
//! direct solutions in the aspect is constant; the images of two basic regions, their basic components (Def.
//! 11), coincide or are disjoint. Unions of adjacent regions with disjoint images are the uniqueness domains
//! (Theorem 3).
//!
//! The regions are numerical: sets of nodes of a grid, true to a cell. [`cusps`], where three direct
//! solutions meet, are certified.

mod analysis;
pub mod boundary;
pub mod characteristic;
pub use aspecta_kinematics::cusps;
mod face;
mod field;
mod grid;
mod id;
mod images;
mod labels;
mod map;
mod mesh;
mod partition;
mod result;
mod sheet;
pub mod slice;
mod surfaces;
mod thin;
mod uniqueness;

pub use analysis::domains;
pub use id::RegionId;
pub use labels::{Labels, OUTSIDE};
pub use map::{Location, MAP_VERSION, Map, MapError, MappedAspect, MappedClass, Nowhere};
pub use mesh::Mesh;
pub use result::{
    Agreement, BasicRegion, Coincidence, Disagreement, DomainError, DomainOptions, Domains, UniquenessDomain,
    Unresolved, Violation,
};
pub use sheet::Sheet;
pub use surfaces::Surfaces;
