//! Characteristic surfaces (Definition 9, eq. 15): S_C(WA_ij) = g_i⁻¹( g_i(∂WA_ij) ) ∩ WA_ij.
//!
//! *Numerical*, on the mesh of the boundary. At every vertex X of the boundary the joint vector q = g_i(X) is
//! taken (at a serial singularity by continuity), the direct problem of q is solved, and the solutions other
//! than X that lie in the same aspect are kept. Along the mesh's edges they are followed by Newton's method,
//! there and back; where that is not clear, a solution has no partner or its partner is farther away than a
//! cell's diagonal, the edge is halved on the boundary, [`ROUNDS`] times at most. The surface ends where its
//! solutions leave the aspect, so its rim lies on the boundary; the mesh stops short of it by up to
//! 2^−[`ROUNDS`] of a cell.
//!
//! Tolerances: solutions nearer than [`APART`] to X are X itself (at a parallel singularity X is a double
//! solution, which rounding splits; the surface is cut off as near to its cusps), and g_i(X′) = q holds to
//! [`SAME_JOINTS`].

mod net;

use crate::aspect::{Analysis, AspectId};
use crate::domain::boundary::{Boundary, BoundaryVertex, Simplex};
use crate::domain::field::Field;
use aspecta_kinematics::for_platform;
use net::Net;
use serde::{Deserialize, Serialize};

/// How often an edge of the boundary is halved where its solutions do not pair.
pub const ROUNDS: usize = 3;
/// Direct solutions nearer than this, in widths of the window, are one.
pub const APART: f64 = 1e-5;
/// How well g_i(X′) and q agree: rad or length units.
pub const SAME_JOINTS: f64 = 1e-9;

/// A point of a characteristic surface.
#[derive(Clone, Debug, Serialize)]
pub struct CharacteristicVertex {
    /// X′, strictly inside the aspect. Only where X lies on a limit of a driven joint does X′ lie on the same
    /// limit.
    pub pose: Vec<f64>,
    /// Index into [`Characteristic::sources`] of the point X of the boundary with the same joint vector.
    pub source: u32,
}

/// The characteristic surfaces of an aspect: polylines in two dimensions, triangle meshes in three.
#[derive(Clone, Debug, Serialize)]
pub struct Characteristic {
    /// The aspect.
    pub aspect: AspectId,
    /// Number of coordinates, 2 or 3.
    pub dimension: usize,
    /// The points of the boundary that were looked at: the vertices of the [`Boundary`] in their order, then
    /// those that halve its edges.
    pub sources: Vec<BoundaryVertex>,
    /// The vertices.
    pub vertices: Vec<CharacteristicVertex>,
    /// Segments or triangles, with the face of the boundary they come from. Across the ends of a glued angle
    /// differences count modulo 2π.
    pub simplices: Vec<Simplex>,
    /// The parts that were given up.
    pub given_up: GivenUp,
}

/// How much of a characteristic surface was given up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct GivenUp {
    /// Pieces of the boundary on which solutions begin or end: the rim, narrowed down by halving.
    pub rim: usize,
    /// Pieces with equally many solutions at all corners that could not be paired.
    pub unclear: usize,
    /// Points of the boundary whose direct problem was not solved: they are not placed, or the platform moves
    /// with locked actuators.
    pub unsolved: usize,
    /// Direct solutions of which it is not known in which aspect of the class they lie.
    pub unlocated: usize,
}

/// Why there are no characteristic surfaces.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CharacteristicError {
    /// Held coordinates.
    #[error(
        "the points of the boundary that it comes from lie outside a slice: `domain::slice::surfaces` finds it from within"
    )]
    Slice,
    /// The boundary belongs to something else.
    #[error("the boundary of aspect {0} was not computed from this analysis: compute it again")]
    Stranger(AspectId),
}

impl Characteristic {
    /// The characteristic surfaces of the aspect with this boundary. Faces at limits of driven joints give
    /// none: all direct solutions of their joint vectors lie on the same limit, not inside the aspect.
    ///
    /// # Errors
    /// [`CharacteristicError`] for slices, platforms without a direct model, and boundaries of another
    /// analysis.
    pub fn new(analysis: &Analysis, boundary: &Boundary) -> Result<Self, CharacteristicError> {
        let platform = analysis.robot.platform;
        if !analysis.fixed.is_empty() {
            return Err(CharacteristicError::Slice);
        }
        let class = analysis.classes.get(boundary.class.index()).filter(|c| {
            c.mode == boundary.mode
                && c.det_a == boundary.det_a
                && c.aspects.iter().any(|a| a.id == boundary.aspect)
        });
        if class.is_none() {
            return Err(CharacteristicError::Stranger(boundary.aspect));
        }
        Ok(for_platform!(platform, trace(analysis, boundary)))
    }
}

fn trace<const D: usize, const N: usize>(analysis: &Analysis, boundary: &Boundary) -> Characteristic {
    let robot = &analysis.robot;
    let field = Field::<D, N> { robot, mode: boundary.mode, sign: boundary.det_a, window: &analysis.window };
    let mut net = Net::new(analysis, boundary, field);
    let driven = |simplex: &Simplex| net.is_driven_limit(simplex.face);
    let mut open: Vec<Simplex> = boundary.simplices.iter().copied().filter(|s| !driven(s)).collect();
    let mut given_up = GivenUp::default();
    for round in 0..=ROUNDS {
        let pairings = net.pairings(&open);
        let (clear, rest): (Vec<_>, Vec<_>) = open.iter().partition(|s| net.is_clear(&pairings, s));
        clear.iter().for_each(|s| {
            net.emit(&pairings, s);
        });
        if round == ROUNDS {
            for simplex in &rest {
                match (net.emit(&pairings, simplex), net.is_level(simplex)) {
                    (true, _) => {}
                    (false, true) => given_up.unclear += 1,
                    (false, false) => given_up.rim += 1,
                }
            }
            break;
        }
        open = net.halve(&pairings, &rest);
    }
    net.finish(given_up)
}
