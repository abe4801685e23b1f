//! The options that choose what `domains --out` writes.

use aspecta::robot::LegIndex;
use aspecta_view::{Choice, MeshFormat};
use clap::{Args, ValueEnum};

/// Options of pictures and meshes.
#[derive(Args)]
pub struct Drawing {
    /// Formats of the meshes, separated by commas
    #[arg(long, value_name = "LIST", value_delimiter = ',', requires = "out", default_value = "ply,glb")]
    meshes: Vec<Format>,
    /// The joint that is held in pictures of the joint space of robots with 3 joints
    #[arg(long, value_name = "JOINT", requires = "out", default_value = "q3", value_parser = JOINTS)]
    hold: String,
}

/// A format of meshes.
#[derive(Clone, Copy, ValueEnum)]
enum Format {
    /// Polygon File Format, a file for each surface
    Ply,
    /// Binary glTF 2.0, both surfaces in one file, coloured by what bounds the aspect
    Glb,
    /// VTK PolyData, a file for each surface, with joint vectors
    Vtp,
}

impl From<Format> for MeshFormat {
    fn from(format: Format) -> Self {
        match format {
            Format::Ply => Self::Ply,
            Format::Glb => Self::Glb,
            Format::Vtp => Self::Vtp,
        }
    }
}

const JOINTS: [&str; 3] = ["q1", "q2", "q3"];

impl Drawing {
    /// Returns the choice as the library takes it.
    pub fn choice(&self) -> Choice {
        let held = LegIndex::new(JOINTS.iter().position(|joint| *joint == self.hold).unwrap_or(2));
        Choice { meshes: self.meshes.iter().copied().map(MeshFormat::from).collect(), held }
    }
}
