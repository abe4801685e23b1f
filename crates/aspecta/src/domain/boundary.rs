//! The boundary ∂WA_ij of a W-aspect: curves in two dimensions, a triangle mesh in three, every piece named
//! by what it is.
//!
//! *Numerical*, at the resolution of a grid. The grid's nodes are sorted into the aspect and the rest, every
//! grid edge between the two is bisected to the place where a function of the class changes its sign, and the
//! places are joined simplex by simplex (marching triangles and tetrahedra). Vertices lie on the boundary to
//! 1e-9 of the window ([`PLACED`]) and mostly to rounding; what lies between them is a chord. What is thinner
//! than the grid can be missed: parts of the aspect, gaps in it, and the slivers between det A = 0 and a
//! serial singularity, which are tangent to each other where they meet.

mod corner;
mod lattice;

pub use super::face::Face;
pub(crate) use corner::onto;
pub(super) use lattice::orders;

use super::field::Field;
use crate::aspect::{Analysis, Aspect, AspectId, ClassId, DetSign, Place};
use aspecta_kinematics::constraints::Constraint;
use aspecta_kinematics::{WorkingMode, for_platform};
use aspecta_robot::work;
use lattice::{Edge, Lattice, Tag};
use serde::Serialize;

/// How far from its faces, in widths of the window, a vertex may be and count as placed.
pub const PLACED: f64 = 1e-9;

/// A point of the boundary.
#[derive(Clone, Debug, Serialize)]
pub struct BoundaryVertex {
    /// X, as [`aspecta_robot::Platform::coordinates`] orders it; glued angles in (−π, π].
    pub pose: Vec<f64>,
    /// The faces it lies on: one, or two or three that meet there.
    pub faces: [Option<Face>; 3],
    /// How far it is from the farthest of them: |function| / ‖gradient‖, coordinates counted in widths of the
    /// window. Infinite where it cannot be told.
    pub offset: f64,
}

impl BoundaryVertex {
    fn new<const D: usize, const N: usize>(
        field: &Field<'_, D, N>,
        pose: [f64; N],
        faces: [Option<Face>; 3],
    ) -> Self {
        let turned = field.window.turned(&pose);
        Self { pose: turned, faces, offset: field.offset(&pose, &faces) }
    }

    /// Whether it lies on its faces, to [`PLACED`]. Else its pose is within a cell of them.
    pub fn placed(&self) -> bool {
        self.offset <= PLACED
    }
}

/// A segment or triangle of a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Simplex {
    /// Indices of its vertices; a segment's second stands twice.
    pub corners: [u32; 3],
    /// The face that it is a piece of.
    pub face: Face,
}

impl Simplex {
    /// Returns its edges, lower index first: one in two dimensions, three in three.
    pub(crate) fn edges(&self, dimension: usize) -> impl Iterator<Item = (u32, u32)> + use<> {
        let [a, b, c] = self.corners;
        let ordered = |(u, v): (u32, u32)| (u.min(v), u.max(v));
        [(a, b), (b, c), (c, a)].into_iter().take(if dimension == 2 { 1 } else { 3 }).map(ordered)
    }
}

/// The boundary of a W-aspect.
#[derive(Clone, Debug, Serialize)]
pub struct Boundary {
    /// The aspect.
    pub aspect: AspectId,
    /// Its working mode.
    pub mode: WorkingMode,
    /// Its sign of det A.
    pub det_a: DetSign,
    /// The coordinates that vary: two (curves) or three (a surface).
    pub axes: Vec<usize>,
    /// Cells of the grid per axis.
    pub cells: usize,
    /// The vertices.
    pub vertices: Vec<BoundaryVertex>,
    /// Segments with the aspect to their left, or triangles counter-clockwise seen from outside. Across the
    /// ends of a glued angle differences count modulo 2π.
    pub simplices: Vec<Simplex>,
    /// Vertices that are not [`BoundaryVertex::placed`].
    pub unplaced: usize,
    /// Nodes of the grid in the class of which it is not known in which aspect they lie; they were left out.
    pub unassigned: usize,
    /// Its class.
    #[serde(skip)]
    pub(crate) class: ClassId,
    /// The diagonal of a cell of the grid, in widths of the window.
    #[serde(skip)]
    pub(crate) cell: f64,
    #[serde(skip)]
    lattice: Lattice,
}

/// Why there is no boundary.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BoundaryError {
    /// No such aspect.
    #[error("there is no aspect {id}: the analysis found {count}, numbered from 1")]
    NoSuchAspect {
        /// The one asked for.
        id: AspectId,
        /// Number of aspects.
        count: usize,
    },
    /// A slice along a line.
    #[error(
        "the boundary of an aspect needs two or three coordinates that vary, but {0} does: free one more"
    )]
    Line(usize),
    /// Resolution out of range.
    #[error("a grid of {0} cells per axis cannot be: choose 4 to 2000 in two dimensions, 4 to 300 in three")]
    Cells(usize),
}

impl Boundary {
    /// The boundary of an aspect, on a grid with `cells` cells per axis over the aspect's bounds. In a slice: the boundary within the slice.
    ///
    /// # Errors
    /// [`BoundaryError`] if there is no such aspect, the slice is a line, or the number of cells is out of
    /// range.
    pub fn new(analysis: &Analysis, aspect: AspectId, cells: usize) -> Result<Self, BoundaryError> {
        let dimension = analysis.window.axes().len();
        if dimension < 2 {
            return Err(BoundaryError::Line(dimension));
        }
        if cells < 4 || cells > if dimension == 2 { 2000 } else { 300 } {
            return Err(BoundaryError::Cells(cells));
        }
        let count = || analysis.classes.iter().map(|class| class.aspects.len()).sum();
        let (class, aspect) = analysis
            .aspect(aspect)
            .ok_or_else(|| BoundaryError::NoSuchAspect { id: aspect, count: count() })?;
        Ok(for_platform!(analysis.robot.platform, extract(analysis, class, aspect, cells)))
    }

    /// Whether a pose of its class, strictly inside it, lies in the aspect; `None` if it cannot be told.
    /// Certified where the analysis decides; else by what is seen from it within the class, sampled: a node
    /// of its cell, or a place uphill.
    pub(crate) fn holds<const D: usize, const N: usize>(
        &self,
        analysis: &Analysis,
        field: &Field<'_, D, N>,
        pose: &[f64; N],
    ) -> Option<bool> {
        let class = &analysis.classes[self.class.index()];
        if class.low == 1 && class.high == Some(1) {
            return Some(true);
        }
        if let Place::Inside(id) = analysis.locate(pose, self.class) {
            return Some(id == self.aspect);
        }
        let seen = |node: &usize| {
            let far = self.lattice.pose::<N>(*node);
            (1..8).all(|t| field.violated(&field.between(pose, &far, f64::from(t) / 8.0), &[]).is_none())
        };
        for node in self.lattice.around(pose) {
            match self.lattice.tags[node] {
                Tag::Member if seen(&node) => return Some(true),
                Tag::Other if seen(&node) => return Some(false),
                Tag::Member | Tag::Other | Tag::Outside | Tag::Unknown => {}
            }
        }
        Some(field.aspect_of(analysis, self.class, pose, self.cell)? == self.aspect)
    }
}

fn extract<const D: usize, const N: usize>(
    analysis: &Analysis,
    class: ClassId,
    aspect: &Aspect,
    cells: usize,
) -> Boundary {
    let of = &analysis.classes[class.index()];
    let field =
        Field::<D, N> { robot: &analysis.robot, mode: of.mode, sign: of.det_a, window: &analysis.window };
    let id = aspect.id;
    let mut lattice = Lattice::new(analysis, aspect, cells);
    let unassigned = lattice.tag(analysis, class, id, &field);
    let cuts = lattice.cuts();
    let mut edges: Vec<Edge> = cuts.iter().flatten().copied().collect();
    edges.sort_unstable();
    edges.dedup();
    let mut vertices: Vec<BoundaryVertex> = work::map(&edges, |&edge| vertex(&field, &lattice, edge));
    let index = |edge: &Edge| edges.binary_search(edge).unwrap_or_default() as u32;
    let unnamed = Face::Of(Constraint::Det);
    let mut simplices: Vec<Simplex> =
        work::map(&cuts, |cut| Simplex { corners: cut.map(|e| index(&e)), face: unnamed });
    let dimension = lattice.axes.len();
    let cell = lattice.diagonal(&field);
    corner::sharpen(&field, &mut vertices, &mut simplices, dimension, cell);
    Boundary {
        aspect: id,
        mode: of.mode,
        det_a: of.det_a,
        axes: lattice.axes.clone(),
        cells,
        unplaced: vertices.iter().filter(|v| !v.placed()).count(),
        vertices,
        simplices,
        unassigned,
        class,
        cell,
        lattice,
    }
}

/// The point in which an edge of the grid crosses the boundary.
fn vertex<const D: usize, const N: usize>(
    field: &Field<'_, D, N>,
    lattice: &Lattice,
    (node, step): Edge,
) -> BoundaryVertex {
    let ahead = lattice.ahead(node, step).unwrap_or(node);
    let (inside, outside) = if lattice.is_member(node) { (node, ahead) } else { (ahead, node) };
    let (inside, outside) = (lattice.pose::<N>(inside), lattice.pose::<N>(outside));
    // Between two aspects of one class both ends are positive: look for what parts them.
    const PARTS: u32 = 4096;
    let part = |t: u32| field.between(&inside, &outside, f64::from(t) / f64::from(PARTS));
    let parted = || (1..PARTS).map(part).find(|pose| field.violated(pose, &[]).is_some());
    let beyond = if field.violated(&outside, &[]).is_some() { Some(outside) } else { parted() };
    match beyond.and_then(|beyond| field.cross(&inside, &beyond)) {
        Some((pose, face)) => BoundaryVertex::new(field, pose, [Some(face), None, None]),
        None => {
            let middle = field.between(&inside, &outside, 0.5);
            let faces = [Some(Face::Of(Constraint::Det)), None, None];
            BoundaryVertex { offset: f64::INFINITY, ..BoundaryVertex::new(field, middle, faces) }
        }
    }
}
