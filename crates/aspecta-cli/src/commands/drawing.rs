//! What `domains --out` writes.

use aspecta_cli::domains::{Choice, Format};
use clap::Args;

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

const JOINTS: [&str; 3] = ["q1", "q2", "q3"];

impl Drawing {
    /// As the library wants it.
    pub fn choice(&self) -> Choice {
        let held = JOINTS.iter().position(|joint| *joint == self.hold).unwrap_or(2);
        Choice { meshes: self.meshes.clone(), held }
    }
}
