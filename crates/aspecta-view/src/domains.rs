//! Files of section 4: pictures of basic regions and uniqueness domains, meshes of the surfaces that bound
//! them.

use crate::figure::components::JointSpace;
use crate::figure::cut::Cut;
use crate::figure::joints::components;
use crate::figure::regions::{regions, uniqueness};
use crate::figure::stack::stack;
use crate::file::put;
use crate::mesh::{Surfaces, gltf, ply, vtk};
use aspecta::robot::LegIndex;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// A format of meshes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeshFormat {
    /// Polygon File Format, a file for each surface.
    Ply,
    /// Binary glTF 2.0, both surfaces in one file, coloured by what bounds the aspect.
    Glb,
    /// VTK PolyData, a file for each surface, with joint vectors.
    Vtp,
}

/// The choice of files to write.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// Formats of the meshes.
    pub meshes: Vec<MeshFormat>,
    /// The joint, by its leg, that is held in pictures of a joint space of three.
    pub held: LegIndex,
}

/// Writes pictures into `dir`, which is created if need be: `aspect-N-regions.svg`, `-uniqueness.svg`,
/// `-components.svg` and `-sheets.svg`; for robots with three coordinates also meshes, `aspect-N-boundary`
/// and `aspect-N-characteristic`, or both in one file `aspect-N.glb`. Returns the paths.
///
/// # Errors
/// Those of the file system.
pub fn write(cut: &Cut<'_>, choice: &Choice, dir: &Path) -> io::Result<Vec<PathBuf>> {
    fs::create_dir_all(dir)?;
    let number = cut.domains.aspect;
    let mut written = Vec::new();
    let mut keep = |what: &str, content: &[u8]| -> io::Result<()> {
        written.push(put(dir, &format!("aspect-{number}{what}"), content)?);
        Ok(())
    };
    keep("-regions.svg", regions(cut).as_bytes())?;
    keep("-uniqueness.svg", uniqueness(cut).as_bytes())?;
    if let Some(space) = JointSpace::new(cut, choice.held) {
        keep("-components.svg", components(&space).as_bytes())?;
        keep("-sheets.svg", stack(&space).as_bytes())?;
    }
    let Some(meshes) = Surfaces::new(cut) else { return Ok(written) };
    if choice.meshes.contains(&MeshFormat::Glb) {
        keep(".glb", &gltf::glb(&meshes))?;
    }
    for surface in &meshes.surfaces {
        if choice.meshes.contains(&MeshFormat::Ply) {
            keep(&format!("-{}.ply", surface.name), &ply::ply(&meshes, surface))?;
        }
        if choice.meshes.contains(&MeshFormat::Vtp) {
            keep(&format!("-{}.vtp", surface.name), vtk::vtp(&meshes, surface).as_bytes())?;
        }
    }
    Ok(written)
}
