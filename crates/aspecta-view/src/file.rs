//! Files that are there only when they are complete.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Creates a directory if need be and makes sure that files can be written into it: before long work, not
/// after it.
///
/// # Errors
/// Those of the file system.
pub fn writable(dir: &Path) -> io::Result<()> {
    fs::create_dir_all(dir)?;
    let probe = dir.join(".aspecta-writable");
    fs::write(&probe, "").and_then(|()| fs::remove_file(&probe))
}

/// Writes `content` into `dir` under a temporary name, renames it to `name`, and returns the path.
///
/// # Errors
/// Those of the file system; then no file is left behind.
pub fn put(dir: &Path, name: &str, content: impl AsRef<[u8]>) -> io::Result<PathBuf> {
    let (path, draft) = (dir.join(name), dir.join(format!(".{name}.{}.part", std::process::id())));
    let write = || -> io::Result<()> {
        let mut file = fs::File::create(&draft)?;
        file.write_all(content.as_ref())?;
        file.sync_all()?;
        fs::rename(&draft, &path)
    };
    write().inspect_err(|_| {
        // The first error is the one to report.
        let _ = fs::remove_file(&draft);
    })?;
    Ok(path)
}
