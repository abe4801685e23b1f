//! Binary PLY files.

use super::{Surface, Surfaces, name};
use std::fmt::Write;

/// Returns one surface of an aspect: binary, little-endian. The property `face` of a triangle counts
/// [`Surfaces::faces`] from 0; comments of the header say what they are.
pub fn ply(all: &Surfaces, surface: &Surface) -> Vec<u8> {
    let mut file = header(all, surface).into_bytes();
    file.extend(surface.vertices.iter().flatten().flat_map(|x| x.to_le_bytes()));
    for (corners, face) in surface.triangles.iter().zip(&surface.face) {
        file.push(3);
        file.extend(corners.iter().flat_map(|v| v.to_le_bytes()));
        file.push(*face);
    }
    file
}

fn header(all: &Surfaces, surface: &Surface) -> String {
    let mut text = "ply\nformat binary_little_endian 1.0\n".to_owned();
    let _ = writeln!(text, "comment x, y, z are {}", all.coordinates.join(", ").replace('φ', "phi"));
    for (k, face) in all.faces.iter().enumerate() {
        let _ = writeln!(text, "comment face {k}: {}", name(*face));
    }
    let _ = write!(
        text,
        "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n\
         element face {}\nproperty list uchar int vertex_indices\nproperty uchar face\nend_header\n",
        surface.vertices.len(),
        surface.triangles.len()
    );
    // As the format wants it: a length unit may be anything.
    text.replace(|c: char| !c.is_ascii(), "?")
}
