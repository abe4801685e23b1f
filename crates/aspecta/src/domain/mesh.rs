//! Curves and surfaces over poses, without how they came about.

use super::boundary::{Boundary, Simplex};
use super::characteristic::Characteristic;
use super::face::Face;
use serde::{Deserialize, Serialize};

/// Segments or triangles over poses of two or three coordinates.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(into = "Packed", from = "Packed")]
pub struct Mesh {
    /// The vertices: poses, on a slice their coordinates that vary.
    pub vertices: Vec<Vec<f64>>,
    /// Per vertex of a characteristic surface, the pose on the boundary with the same joint vector; empty for
    /// a boundary.
    pub sources: Vec<Vec<f64>>,
    /// The simplices that join them: [`Boundary::simplices`] or [`Characteristic::simplices`].
    pub simplices: Vec<Simplex>,
}

impl From<&Boundary> for Mesh {
    fn from(boundary: &Boundary) -> Self {
        let vertices = boundary.vertices.iter().map(|v| v.pose.clone()).collect();
        Self { vertices, sources: Vec::new(), simplices: boundary.simplices.clone() }
    }
}

impl From<&Characteristic> for Mesh {
    fn from(surface: &Characteristic) -> Self {
        let vertices = surface.vertices.iter().map(|v| v.pose.clone()).collect();
        let sources =
            surface.vertices.iter().map(|v| surface.sources[v.source as usize].pose.clone()).collect();
        Self { vertices, sources, simplices: surface.simplices.clone() }
    }
}

/// A mesh as it is kept: numbers in rows, neighbouring simplices of a face together.
#[derive(Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Packed {
    axes: usize,
    poses: Vec<f64>,
    sources: Vec<f64>,
    pieces: Vec<Piece>,
}

#[derive(Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Piece {
    face: Face,
    corners: Vec<[u32; 3]>,
}

impl From<Mesh> for Packed {
    fn from(mesh: Mesh) -> Self {
        let runs = mesh.simplices.chunk_by(|a, b| a.face == b.face);
        let piece =
            |run: &[Simplex]| Piece { face: run[0].face, corners: run.iter().map(|s| s.corners).collect() };
        let pieces = runs.map(piece).collect();
        let axes = mesh.vertices.first().map_or(0, Vec::len);
        Self { axes, poses: mesh.vertices.concat(), sources: mesh.sources.concat(), pieces }
    }
}

impl From<Packed> for Mesh {
    fn from(Packed { axes, poses, sources, pieces }: Packed) -> Self {
        let simplices = |Piece { face, corners }: Piece| {
            corners.into_iter().map(move |corners| Simplex { corners, face })
        };
        let rows = |numbers: Vec<f64>| numbers.chunks(axes.max(1)).map(<[f64]>::to_vec).collect();
        Self {
            vertices: rows(poses),
            sources: rows(sources),
            simplices: pieces.into_iter().flat_map(simplices).collect(),
        }
    }
}
