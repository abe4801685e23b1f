//! Files that are there only when they are complete.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Writes `text` into `dir` under a temporary name, renames it to `name`, and returns the path.
///
/// # Errors
/// Those of the file system; then no file is left behind.
pub fn put(dir: &Path, name: &str, text: &str) -> io::Result<PathBuf> {
    let (path, draft) = (dir.join(name), dir.join(format!(".{name}.{}.part", std::process::id())));
    let write = || -> io::Result<()> {
        let mut file = fs::File::create(&draft)?;
        file.write_all(text.as_bytes())?;
        file.sync_all()?;
        fs::rename(&draft, &path)
    };
    write().inspect_err(|_| {
        // The first error is the one to report.
        let _ = fs::remove_file(&draft);
    })?;
    Ok(path)
}
