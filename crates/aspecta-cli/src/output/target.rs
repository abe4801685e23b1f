//! A file that is to be written once the long work is done.

use crate::failure::Failure;
use aspecta_view::file;
use std::fs;
use std::path::{Path, PathBuf};

/// The file or directory that output goes to.
pub struct Target {
    directory: PathBuf,
    name: String,
}

impl Target {
    /// The file at `path`, which was given to `option`: its directory must be there before the work begins.
    pub fn new(option: &str, path: &Path) -> Result<Self, Failure> {
        let directory = path.parent().filter(|d| !d.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let name = path.file_name().and_then(|name| name.to_str());
        let Some(name) = name.filter(|_| !path.is_dir()) else {
            return Err(Failure::Input(format!("{option} {}: give the name of a file", path.display())));
        };
        let refused = |error| Failure::Input(format!("{option} {}: {error}", path.display()));
        fs::read_dir(directory).map_err(refused)?;
        Ok(Self { directory: directory.to_owned(), name: name.to_owned() })
    }

    /// Writes it, whole or not at all.
    pub fn write(&self, content: impl AsRef<[u8]>) -> Result<PathBuf, Failure> {
        let refused = |error| {
            Failure::Input(format!("cannot write `{}`: {error}", self.directory.join(&self.name).display()))
        };
        file::put(&self.directory, &self.name, content).map_err(refused)
    }
}
