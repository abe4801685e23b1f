//! Files of section 4: pictures of basic regions and uniqueness domains, meshes of the surfaces that bound them.

use crate::figure::regions::{Cut, regions, uniqueness};
use crate::figure::section::Mesh;
use crate::file::put;
use crate::ply;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Writes `aspect-N-regions.svg` and `aspect-N-uniqueness.svg` into `dir`, which is created if need be; for robots with three coordinates
/// also `aspect-N-boundary.ply` and `aspect-N-characteristic.ply`. Returns the paths.
///
/// # Errors
/// Those of the file system.
pub fn write(cut: &Cut<'_>, dir: &Path) -> io::Result<Vec<PathBuf>> {
    fs::create_dir_all(dir)?;
    let name = |what: &str| format!("aspect-{}-{what}", cut.domains.aspect);
    let mut written = vec![
        put(dir, &name("regions.svg"), regions(cut))?,
        put(dir, &name("uniqueness.svg"), uniqueness(cut))?,
    ];
    let (robot, window) = (&cut.analysis.robot, &cut.analysis.window);
    if robot.dof() == 3 {
        let coordinates = std::array::from_fn(|k| {
            let of = robot.platform.coordinates()[k];
            format!("{} [{}]", of.name, if of.angle { "rad" } else { &robot.length_unit })
        });
        let boundary = Mesh::from(cut.boundary);
        let faces = ply::faces(&boundary);
        for (what, mesh) in [("boundary.ply", boundary), ("characteristic.ply", Mesh::from(cut.surface))] {
            let file = ply::ply(&mesh, &coordinates, &faces, window.glued[2]);
            written.push(put(dir, &name(what), file)?);
        }
    }
    Ok(written)
}
