//! Triangle meshes as binary PLY files.

use crate::figure::section::Mesh;
use aspecta::domain::boundary::Face;
use aspecta::kinematics::modal::Constraint;
use std::collections::HashMap;
use std::f64::consts::{PI, TAU};
use std::fmt::Write;

/// The faces that occur in a mesh, each once, in order of their names.
pub fn faces(mesh: &Mesh<'_>) -> Vec<Face> {
    let mut faces: Vec<Face> = Vec::new();
    for simplex in mesh.simplices {
        if !faces.contains(&simplex.face) {
            faces.push(simplex.face);
        }
    }
    faces.sort_by_key(|face| name(*face));
    faces
}

/// A mesh of triangles over three coordinates with these names and units: binary, little-endian. The property `face` of a triangle counts
/// `faces` from 0; comments of the header say what they are.
///
/// Across the ends of a `glued` third coordinate triangles get copies of their vertices a full turn further, so that they hang together
/// in a viewer.
pub fn ply(mesh: &Mesh<'_>, coordinates: &[String; 3], faces: &[Face], glued: bool) -> Vec<u8> {
    let mut vertices: Vec<[f64; 3]> = mesh.vertices.iter().map(|v| [v[0], v[1], v[2]]).collect();
    let mut copies: HashMap<u32, u32> = HashMap::new();
    let mut triangles: Vec<[u32; 3]> = mesh.simplices.iter().map(|s| s.corners).collect();
    let angle = |v: u32| mesh.vertices[v as usize][2];
    for corners in triangles.iter_mut().filter(|_| glued) {
        let top = corners.iter().map(|&v| angle(v)).fold(f64::MIN, f64::max);
        for corner in corners.iter_mut().filter(|v| top - angle(**v) > PI) {
            *corner = *copies.entry(*corner).or_insert_with(|| {
                let [x, y, angle] = vertices[*corner as usize];
                vertices.push([x, y, angle + TAU]);
                vertices.len() as u32 - 1
            });
        }
    }
    let mut file = header(coordinates, faces, vertices.len(), triangles.len()).into_bytes();
    file.extend(vertices.iter().flatten().flat_map(|x| x.to_le_bytes()));
    for (corners, simplex) in triangles.iter().zip(mesh.simplices) {
        file.push(3);
        file.extend(corners.iter().flat_map(|v| v.to_le_bytes()));
        file.push(faces.iter().position(|f| *f == simplex.face).unwrap_or(255) as u8);
    }
    file
}

fn header(coordinates: &[String; 3], faces: &[Face], vertices: usize, triangles: usize) -> String {
    let mut text = "ply\nformat binary_little_endian 1.0\n".to_owned();
    let _ = writeln!(text, "comment x, y, z are {}", coordinates.join(", "));
    for (k, face) in faces.iter().enumerate() {
        let _ = writeln!(text, "comment face {k}: {}", name(*face));
    }
    let _ = write!(
        text,
        "element vertex {vertices}\nproperty double x\nproperty double y\nproperty double z\n\
         element face {triangles}\nproperty list uchar int vertex_indices\nproperty uchar face\nend_header\n"
    );
    // As the format wants it: a length unit may be anything.
    text.replace(|c: char| !c.is_ascii(), "?")
}

fn name(face: Face) -> String {
    match face {
        Face::Of(Constraint::Det) => "det A = 0".into(),
        Face::Of(Constraint::Reach(leg)) => format!("det B = 0, leg {}", leg + 1),
        Face::Of(Constraint::Limit(leg, limit)) => format!("joint limit {} of leg {}", limit + 1, leg + 1),
        Face::Cut { coordinate, upper } => {
            format!(
                "{} end of the window, coordinate {}",
                if upper { "upper" } else { "lower" },
                coordinate + 1
            )
        }
    }
}
