//! Files of section 4: pictures of basic regions and uniqueness domains, meshes of the surfaces that bound them.

use crate::figure::regions::{Cut, regions, uniqueness};
use crate::file::put;
use crate::mesh::{Surfaces, gltf, ply, vtk};
use clap::ValueEnum;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// A format of meshes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// Polygon File Format, a file a surface
    Ply,
    /// Binary glTF 2.0, both surfaces in one file, in colour
    Glb,
    /// VTK PolyData, a file a surface, with joint vectors
    Vtp,
}

/// Writes `aspect-N-regions.svg` and `aspect-N-uniqueness.svg` into `dir`, which is created if need be; for robots with three coordinates
/// also meshes in these formats: `aspect-N-boundary` and `aspect-N-characteristic`, or both in one file `aspect-N.glb`. Returns the
/// paths.
///
/// # Errors
/// Those of the file system.
pub fn write(cut: &Cut<'_>, formats: &[Format], dir: &Path) -> io::Result<Vec<PathBuf>> {
    fs::create_dir_all(dir)?;
    let number = cut.domains.aspect;
    let mut written = vec![
        put(dir, &format!("aspect-{number}-regions.svg"), regions(cut))?,
        put(dir, &format!("aspect-{number}-uniqueness.svg"), uniqueness(cut))?,
    ];
    let Some(meshes) = Surfaces::new(cut) else { return Ok(written) };
    if formats.contains(&Format::Glb) {
        written.push(put(dir, &format!("aspect-{number}.glb"), gltf::glb(&meshes))?);
    }
    for surface in &meshes.surfaces {
        let name = |extension: &str| format!("aspect-{number}-{}.{extension}", surface.name);
        if formats.contains(&Format::Ply) {
            written.push(put(dir, &name("ply"), ply::ply(&meshes, surface))?);
        }
        if formats.contains(&Format::Vtp) {
            written.push(put(dir, &name("vtp"), vtk::vtp(&meshes, surface))?);
        }
    }
    Ok(written)
}
