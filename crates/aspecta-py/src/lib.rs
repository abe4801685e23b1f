//! The compiled part of the Python package `aspecta`: what it computes, and the command.
//!
//! It passes on what the libraries answer, and adds nothing. Conventions of Python (shapes, defaults, results with
//! names) are in `python/aspecta`, which is what users see; names here are private to the package.

mod analysis;
mod batch;
mod certificate;
mod error;
mod follow;
mod map;
mod path;
mod roadmap;
mod robot;
mod surface;
mod threads;
mod watch;

use pyo3::prelude::*;
use std::path::PathBuf;

/// The module `aspecta._native`.
#[pymodule]
mod _native {
    #[pymodule_export]
    use super::analysis::Analysis;
    #[pymodule_export]
    use super::certificate::verify;
    #[pymodule_export]
    use super::error::{Error, NoPlan};
    #[pymodule_export]
    use super::follow::{Follower, InverseFollower};
    #[pymodule_export]
    use super::map::Map;
    #[pymodule_export]
    use super::path::{check_joints, check_poses, trajectory};
    #[pymodule_export]
    use super::roadmap::{cusps, explore, join_solutions, plan_over_roadmap};
    #[pymodule_export]
    use super::robot::Robot;
    #[pymodule_export]
    use super::threads::set_threads;
    #[pymodule_export]
    use super::watch::Partial;
    #[pymodule_export]
    use super::{catalogue, coarse_depth, run_command, schema, write};

    /// Greatest depth of boxes.
    #[pymodule_export]
    const MAX_DEPTH: u32 = aspecta::paving::MAX_DEPTH;

    /// The version of the package.
    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");
}

/// Returns the name and the title of every robot of the catalogue.
#[pyfunction]
fn catalogue() -> PyResult<Vec<(String, String)>> {
    let entry = |entry: &aspecta::catalogue::Entry| {
        let robot = aspecta::Robot::resolve(entry.name).map_err(error::of)?;
        Ok((robot.name, robot.title))
    };
    aspecta::catalogue::all().iter().map(entry).collect()
}

/// Returns the depth of boxes that is fine enough to work with aspects where so many coordinates are free.
#[pyfunction]
fn coarse_depth(free: usize) -> Option<u32> {
    aspecta::Budget::coarse(free).depth
}

/// Writes a file, which is there only when it is complete, into a directory that is there.
#[pyfunction]
fn write(py: Python<'_>, path: PathBuf, content: &[u8]) -> PyResult<()> {
    let (Some(directory), Some(name)) = (path.parent(), path.file_name().and_then(|name| name.to_str()))
    else {
        return Err(error::Error::new_err(format!("`{}` is no name of a file", path.display())));
    };
    if !directory.as_os_str().is_empty() && !directory.is_dir() {
        return Err(error::at(&path, "there is no such directory to write it into"));
    }
    py.detach(|| aspecta_view::file::put(directory, name, content))
        .map_err(|reason| error::at(&path, reason))?;
    Ok(())
}

/// Returns the JSON Schema of robot files.
#[pyfunction]
fn schema() -> PyResult<String> {
    error::json(&aspecta::Robot::file_schema())
}

/// Runs the command `aspecta` with these arguments, the first its own name; returns its exit status.
#[pyfunction]
fn run_command(py: Python<'_>, arguments: Vec<String>) -> u8 {
    py.detach(|| aspecta_cli::run(arguments))
}
