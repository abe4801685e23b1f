//! VTK's XML files of surfaces (`.vtp`), for ParaView and its kin.

use super::{Surface, Surfaces, name};
use crate::xml::escape;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use std::fmt::Write;

/// Returns one surface of an aspect: points are poses, in double precision. Each has its joint vector `q`; of
/// the characteristic surface also `source`, the pose on the boundary with the same joint vector. Cells have
/// `face`, which counts the names in the field data.
pub fn vtp(all: &Surfaces, surface: &Surface) -> String {
    let (points, cells) = (surface.vertices.len(), surface.triangles.len());
    let mut body = String::new();
    for data in &surface.data {
        let components = data.components.each_ref().map(String::as_str);
        body += &doubles(data.name, components, &data.values);
    }
    let coordinates = all.coordinates.each_ref().map(String::as_str);
    let faces = array("UInt8", "face", "", surface.face.iter().copied());
    let corners = surface.triangles.iter().flatten();
    let connectivity = array("Int64", "connectivity", "", corners.flat_map(|v| i64::from(*v).to_le_bytes()));
    let ends = (1..=cells as i64).map(|k| 3 * k);
    let offsets = array("Int64", "offsets", "", ends.flat_map(i64::to_le_bytes));
    format!(
        "<?xml version=\"1.0\"?>\n\
         <VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n\
         <FieldData>\n{}</FieldData>\n<Piece NumberOfPoints=\"{points}\" NumberOfPolys=\"{cells}\">\n\
         <PointData>\n{body}</PointData>\n<CellData Scalars=\"face\">\n{faces}</CellData>\n\
         <Points>\n{}</Points>\n<Polys>\n{connectivity}{offsets}</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n",
        names(all),
        doubles("Points", coordinates, &surface.vertices),
    )
}

/// The names of the faces, as the format wants strings: bytes in decimal, each string ended by a 0.
fn names(all: &Surfaces) -> String {
    let mut text = format!(
        "<DataArray type=\"String\" Name=\"faces\" NumberOfTuples=\"{}\" format=\"ascii\">",
        all.faces.len()
    );
    for byte in all.faces.iter().flat_map(|face| name(*face).into_bytes().into_iter().chain([0])) {
        let _ = write!(text, "{byte} ");
    }
    text + "</DataArray>\n"
}

fn doubles(name: &str, components: [&str; 3], values: &[[f64; 3]]) -> String {
    let [x, y, z] = components.map(escape);
    let attributes = format!(
        " NumberOfComponents=\"3\" ComponentName0=\"{x}\" ComponentName1=\"{y}\" ComponentName2=\"{z}\""
    );
    array("Float64", name, &attributes, values.iter().flatten().flat_map(|x| x.to_le_bytes()))
}

/// Binary data in base64, after their length.
fn array(kind: &str, name: &str, attributes: &str, bytes: impl Iterator<Item = u8>) -> String {
    let bytes: Vec<u8> = bytes.collect();
    let length = (bytes.len() as u64).to_le_bytes();
    let content = STANDARD.encode([&length[..], &bytes].concat());
    format!(
        "<DataArray type=\"{kind}\" Name=\"{name}\"{attributes} format=\"binary\">{content}</DataArray>\n"
    )
}
