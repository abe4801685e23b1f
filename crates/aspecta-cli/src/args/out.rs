//! `--out`: a directory for pictures and pages.

use crate::failure::Failure;
use aspecta_view::file;
use clap::Args;
use std::path::{Path, PathBuf};

/// A directory, if one is given. Each command says what for.
#[derive(Args)]
pub struct OutDir {
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

impl OutDir {
    /// The directory.
    pub fn directory(&self) -> Option<&Path> {
        self.out.as_deref()
    }

    /// Makes sure that files can be written there: before long work, not after it.
    pub fn check(&self) -> Result<(), Failure> {
        self.directory().map_or(Ok(()), |dir| file::writable(dir).map_err(Failure::in_directory(dir)))
    }
}
