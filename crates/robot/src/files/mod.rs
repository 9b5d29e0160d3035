//! Atomic writing of files. A file is never half-written: its content is written to a temporary file in the same
//! folder, flushed to the disk, and renamed. [`StagedFolder`] does this for a set of files at once. [`refuse_foreign`]
//! decides which files may be replaced.

mod disk;
mod lock;
mod own;
mod staged;
mod temporary;

use std::path::Path;
use std::sync::{PoisonError, RwLock, RwLockReadGuard, RwLockWriteGuard};

use tempfile::NamedTempFile;

pub use self::disk::{Disk, System};
pub use self::lock::refuse_unfinished;
pub use self::own::{MARK, Target, is_marked, refuse_foreign, write_into};
pub use self::staged::StagedFolder;
use crate::{Error, Result, Watch};

/// Lock of the process' writers. Each writer holds it for reading from its first temporary file to its last step. The
/// end of the process waits for it.
static WRITERS: RwLock<()> = RwLock::new(());

/// The guard of a writer.
type Writing = RwLockReadGuard<'static, ()>;

fn writing() -> Writing {
    WRITERS.read().unwrap_or_else(PoisonError::into_inner)
}

/// Waits until this process has no half-written file. No writer starts while the guard exists. For callers that are
/// about to end the process.
pub fn stop_writers() -> RwLockWriteGuard<'static, ()> {
    WRITERS.write().unwrap_or_else(PoisonError::into_inner)
}

/// Replaces the content of `path` by `bytes` atomically: readers see the old file or the new one.
///
/// The folder must exist. A symbolic link to a regular file is replaced, not followed. For a device, a pipe or a socket
/// the bytes are written to it.
///
/// # Errors
/// Those of [`Target::of`]; [`ErrorKind::Io`](crate::ErrorKind::Io) when writing fails; the old file is then unchanged.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> Result<()> {
    write_atomically_on(&System, path, bytes)
}

/// Same as [`write_atomically`], but on another `disk`.
///
/// # Errors
/// Those of [`write_atomically`].
pub fn write_atomically_on(disk: &dyn Disk, path: &Path, bytes: &[u8]) -> Result<()> {
    if Target::of(path)? == Target::Stream {
        return write_into(path, bytes).map_err(|error| Error::io(path, &error));
    }
    let _writing = writing();
    rename_onto(disk, write_beside(disk, path, bytes)?, path)?;
    disk.sync_folder(parent(path)).map_err(|error| Error::io(path, &error))
}

/// Replaces or creates `files` (name, content) in `folder`, which is created when it is absent.
///
/// # Errors
/// Those of [`StagedFolder::stage`] and [`StagedFolder::commit`].
pub fn write_folder_atomically<'w>(
    folder: &Path,
    files: &[(String, Vec<u8>)],
    watch: impl Into<Option<&'w Watch>>,
) -> Result<()> {
    let watch = Watch::or_none(watch);
    let staged = StagedFolder::stage(folder, files, watch)?;
    watch.check()?;
    staged.commit()
}

/// Writes `bytes` to a temporary file in the folder of `path`, and flushes it to the disk.
fn write_beside(disk: &dyn Disk, path: &Path, bytes: &[u8]) -> Result<NamedTempFile> {
    let write = || {
        let mut file = temporary::create(disk, parent(path), path)?;
        disk.write(file.as_file_mut(), bytes)?;
        disk.sync(file.as_file())?;
        Ok(file)
    };
    write().map_err(|error| Error::io(path, &error))
}

fn rename_onto(disk: &dyn Disk, file: NamedTempFile, target: &Path) -> Result<()> {
    // The file stays open, and so locked, until it is renamed.
    let (_open, mut path) = file.into_parts();
    disk.rename(&path, target).map_err(|error| Error::io(target, &error))?;
    path.disable_cleanup(true);
    Ok(())
}

/// The folder of a file.
fn parent(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}
