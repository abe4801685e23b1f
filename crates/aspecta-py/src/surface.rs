//! The surfaces that bound an aspect and its regions, as arrays.

use crate::error;
use aspecta::Map;
use aspecta::domain::{Domains, Mesh, Surfaces};
use aspecta_view::figure::barrier::Barriers;
use aspecta_view::{MeshFormat, mesh};
use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;

/// A curve or a surface over poses: its name; vertices; corners of its segments or triangles; the face of each, and the names of the
/// faces; joint vectors of the vertices; poses of the boundary with the same joint vectors, or nothing. Rows are one after the other.
pub type Surface<'py> = (
    String,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<u32>>,
    Bound<'py, PyArray1<u8>>,
    Vec<String>,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<f64>>,
);

/// The boundary and the characteristic surface of an aspect.
pub fn of<'py>(py: Python<'py>, map: &Map, domains: &Domains, surfaces: &Surfaces) -> Vec<Surface<'py>> {
    let cut =
        aspecta_view::Cut { map, domains, boundary: &surfaces.boundary, surface: &surfaces.characteristic };
    if let Some(meshes) = mesh::Surfaces::new(&cut) {
        let faces: Vec<String> = meshes.faces.iter().map(|face| mesh::name(*face)).collect();
        return meshes.surfaces.into_iter().map(|surface| of_triangles(py, surface, &faces)).collect();
    }
    let named = [("boundary", &surfaces.boundary), ("characteristic", &surfaces.characteristic)];
    named.into_iter().map(|(name, mesh)| plain(py, map, domains, name, mesh)).collect()
}

/// A surface of a robot with three coordinates: triangles that hang together across the ends of an angle.
fn of_triangles<'py>(py: Python<'py>, surface: mesh::Surface, faces: &[String]) -> Surface<'py> {
    let data = |name: &str| {
        let found = surface.data.iter().find(|data| data.name == name);
        found.map_or_else(Vec::new, |data| data.values.concat()).into_pyarray(py)
    };
    let (q, sources) = (data("q"), data("source"));
    (
        surface.name.into(),
        surface.vertices.concat().into_pyarray(py),
        surface.triangles.concat().into_pyarray(py),
        surface.face.into_pyarray(py),
        faces.to_vec(),
        q,
        sources,
    )
}

/// A curve, or a surface of a slice.
fn plain<'py>(py: Python<'py>, map: &Map, domains: &Domains, name: &str, mesh: &Mesh) -> Surface<'py> {
    let free = map.window.axes();
    let mut faces = Vec::new();
    let mut face_of = |face| {
        faces.iter().position(|known| *known == face).unwrap_or_else(|| {
            faces.push(face);
            faces.len() - 1
        }) as u8
    };
    let face: Vec<u8> = mesh.simplices.iter().map(|simplex| face_of(simplex.face)).collect();
    let corners: Vec<u32> = mesh.simplices.iter().flat_map(|s| s.corners[..free.len()].to_vec()).collect();
    let held: Vec<(usize, f64)> = map.window.held().collect();
    let whole = |vertex: &Vec<f64>| {
        let mut pose = vec![0.0; map.robot.dof()];
        free.iter()
            .zip(vertex)
            .chain(held.iter().map(|(k, value)| (k, value)))
            .for_each(|(&k, &x)| pose[k] = x);
        Barriers::at(&map.robot, domains.mode, &pose).q
    };
    let q: Vec<f64> = mesh.vertices.iter().flat_map(whole).collect();
    (
        name.into(),
        mesh.vertices.concat().into_pyarray(py),
        corners.into_pyarray(py),
        face.into_pyarray(py),
        faces.into_iter().map(mesh::name).collect(),
        q.into_pyarray(py),
        mesh.sources.concat().into_pyarray(py),
    )
}

/// A format of mesh files by its name.
pub fn format(name: &str) -> PyResult<MeshFormat> {
    match name {
        "ply" => Ok(MeshFormat::Ply),
        "glb" => Ok(MeshFormat::Glb),
        "vtp" => Ok(MeshFormat::Vtp),
        other => {
            Err(error::Error::new_err(format!("`{other}` is no format of meshes: ply, glb and vtp are")))
        }
    }
}
