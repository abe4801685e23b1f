//! Files that are there only when they are complete.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use tempfile::{Builder, NamedTempFile};

/// Makes sure that files can be written into a directory, which may be created for them: before long work,
/// not after it. It is left as it was found: whether there will be files is not known yet.
///
/// # Errors
/// Those of the file system.
pub fn writable(dir: &Path) -> io::Result<()> {
    let is_new = |place: &&Path| !place.as_os_str().is_empty() && !place.exists();
    let new: Vec<&Path> = dir.ancestors().take_while(is_new).collect();
    fs::create_dir_all(dir)?;
    let tried = NamedTempFile::new_in(dir).and_then(NamedTempFile::close);
    // What somebody has written into meanwhile stays.
    new.into_iter().take_while(|place| fs::remove_dir(place).is_ok()).for_each(drop);
    tried
}

/// Writes `content` into `dir`, which is created if need be, under a temporary name that nobody can guess,
/// renames it to `name`, and returns the path. Links are followed, and what is there but no regular file (a
/// device, a pipe) is written into as it is.
///
/// # Errors
/// Those of the file system, and a link that leads nowhere; then no file is left behind.
pub fn put(dir: &Path, name: &str, content: impl AsRef<[u8]>) -> io::Result<PathBuf> {
    fs::create_dir_all(dir)?;
    let path = dir.join(name);
    // What a link leads to.
    let place = if path.is_symlink() { fs::canonicalize(&path)? } else { path.clone() };
    match fs::metadata(&place) {
        Ok(found) if !found.is_file() => {
            fs::OpenOptions::new().write(true).open(&place)?.write_all(content.as_ref())?
        }
        _ => replace(&place, content.as_ref())?,
    }
    Ok(path)
}

/// Held while a draft is there.
static WRITING: Mutex<()> = Mutex::new(());

/// Waits until no file is being written; none is while the guard is held. For programs that are about to end.
pub fn between_writes() -> MutexGuard<'static, ()> {
    WRITING.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Puts a regular file in its place at once.
fn replace(path: &Path, content: &[u8]) -> io::Result<()> {
    let _writing = between_writes();
    let mut draft = Builder::new();
    // As other programs make files: for all whom the user's mask lets.
    #[cfg(unix)]
    draft.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut draft =
        draft.prefix(".aspecta-").suffix(".part").tempfile_in(path.parent().unwrap_or(Path::new(".")))?;
    draft.write_all(content)?;
    draft.as_file().sync_all()?;
    draft.persist(path)?;
    Ok(())
}
