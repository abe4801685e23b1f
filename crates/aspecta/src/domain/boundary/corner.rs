//! Sharp edges: where two faces of the boundary meet, the mesh gets vertices on both.

use super::{BoundaryVertex, Face, Simplex};
use crate::domain::field::Field;
use aspecta_robot::work;
use std::collections::HashMap;

/// The edges of a mesh whose ends lie on different faces, in order.
fn mixed(vertices: &[BoundaryVertex], simplices: &[Simplex], dimension: usize) -> Vec<(u32, u32)> {
    let face = |v: u32| vertices[v as usize].faces[0];
    let edges = simplices.iter().flat_map(|s| s.edges(dimension));
    let mut mixed: Vec<_> = edges.filter(|&(u, v)| face(u) != face(v)).collect();
    mixed.sort_unstable();
    mixed.dedup();
    mixed
}

/// Splits every simplex whose vertices lie on different faces along the edges of the boundary.
pub fn sharpen<const D: usize, const N: usize>(
    field: &Field<'_, D, N>,
    vertices: &mut Vec<BoundaryVertex>,
    simplices: &mut Vec<Simplex>,
    dimension: usize,
    cell: f64,
) {
    let mixed = mixed(vertices, simplices, dimension);
    let corners: Vec<_> = work::map(&mixed, |&(u, v)| meeting(field, vertices, &[u, v], cell));
    let first = vertices.len() as u32;
    vertices.extend(corners);
    let on_edge: HashMap<(u32, u32), u32> = mixed.into_iter().zip(first..).collect();
    let split = |u: u32, v: u32| on_edge.get(&(u.min(v), u.max(v))).copied();
    let mut sharp = Vec::with_capacity(simplices.len());
    for simplex in simplices.iter() {
        let [a, b, c] = simplex.corners;
        let face = |v: u32| vertices[v as usize].faces[0].unwrap_or(simplex.face);
        let mut push = |corners: [u32; 3], of: u32| sharp.push(Simplex { corners, face: face(of) });
        if dimension == 2 {
            match split(a, b) {
                None => push([a, b, b], a),
                Some(m) => {
                    push([a, m, m], a);
                    push([m, b, b], b);
                }
            }
            continue;
        }
        match [split(a, b), split(b, c), split(c, a)] {
            [None, None, None] => push([a, b, c], a),
            [Some(p), Some(q), Some(r)] => {
                let m = vertices.len() as u32;
                let parts = [
                    ([a, p, m], a),
                    ([p, b, m], b),
                    ([b, q, m], b),
                    ([q, c, m], c),
                    ([c, r, m], c),
                    ([r, a, m], a),
                ];
                parts.into_iter().for_each(|(part, of)| push(part, of));
                vertices.push(meeting(field, vertices, &[a, b, c], cell));
            }
            // One corner lies on another face than the others.
            [p, q, r] => {
                let (lone, left, right, to_left, to_right) = match (p, q, r) {
                    (Some(p), None, Some(r)) => (a, b, c, p, r),
                    (Some(p), Some(q), None) => (b, c, a, q, p),
                    (None, Some(q), Some(r)) => (c, a, b, r, q),
                    // Faces differ along two edges or none.
                    _ => unreachable!("one mixed edge in a triangle"),
                };
                push([lone, to_left, to_right], lone);
                push([to_left, left, right], left);
                push([to_left, right, to_right], left);
            }
        }
    }
    *simplices = sharp;
}

/// The point near some vertices on all their faces; if there is none within two cells, a point of the
/// boundary between them.
fn meeting<const D: usize, const N: usize>(
    field: &Field<'_, D, N>,
    vertices: &[BoundaryVertex],
    of: &[u32],
    cell: f64,
) -> BoundaryVertex {
    let pose = |v: u32| -> [f64; N] { std::array::from_fn(|k| vertices[v as usize].pose[k]) };
    let start = pose(of[0]);
    let share = 1.0 / of.len() as f64;
    let middle = of.iter().fold(start, |at, &v| field.moved(&at, &field.difference(&start, &pose(v)), share));
    let mut faces = [None; 3];
    of.iter().zip(&mut faces).for_each(|(&v, face)| *face = vertices[v as usize].faces[0]);
    if let Some(corner) = field.project(&middle, &faces, 2.0 * cell) {
        let vertex = BoundaryVertex::new(field, corner, faces);
        if vertex.placed() && closes(field, &corner, &faces) {
            return vertex;
        }
    }
    let single: Vec<[Option<Face>; 3]> = faces.iter().flatten().map(|&f| [Some(f), None, None]).collect();
    for faces in single {
        if let Some(vertex) = onto(field, &middle, faces, cell) {
            return vertex;
        }
    }
    BoundaryVertex { pose: middle.to_vec(), faces, offset: f64::INFINITY }
}

/// The nearest point on the faces, if it lies on the boundary of the class and within a cell.
pub fn onto<const D: usize, const N: usize>(
    field: &Field<'_, D, N>,
    from: &[f64; N],
    faces: [Option<Face>; 3],
    cell: f64,
) -> Option<BoundaryVertex> {
    let at = field.project(from, &faces, cell)?;
    let vertex = BoundaryVertex::new(field, at, faces);
    (vertex.placed() && closes(field, &at, &faces)).then_some(vertex)
}

/// Whether a point of some faces lies on the boundary of the class: no other function is negative there.
fn closes<const D: usize, const N: usize>(
    field: &Field<'_, D, N>,
    at: &[f64; N],
    faces: &[Option<Face>; 3],
) -> bool {
    field.violated(at, faces).is_none()
}
