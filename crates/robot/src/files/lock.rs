//! Locks: one writer at a time in a folder, and the marker of an incomplete set of files.

use std::collections::BTreeSet;
use std::fs::{self, File, TryLockError};
use std::path::{Path, PathBuf};
use std::time::Duration;

use super::disk::Disk;
use super::temporary::remove_left_over;
use super::{parent, write_beside};
use crate::{Error, ErrorKind, Result, Watch};

/// Interval between attempts to lock.
const PAUSE: Duration = Duration::from_millis(10);
/// The file that lists the names of a set while its files are replaced one after the other.
const UNFINISHED: &str = ".groebot-unfinished";

/// The lock of a folder: no other groebot process writes a set of files to it. The kernel releases it, also when a
/// process is killed.
///
/// A file system without locks gives no protection.
#[derive(Debug)]
pub(super) struct FolderLock {
    _file: File,
}

impl FolderLock {
    /// Waits for the lock and removes the temporary files of killed writers; `None` when the folder was removed or
    /// replaced meanwhile.
    pub(super) fn take(folder: &Path, watch: &Watch) -> Result<Option<Self>> {
        let Ok(file) = open(folder) else { return Ok(None) };
        while let Err(TryLockError::WouldBlock) = file.try_lock() {
            watch.check()?;
            std::thread::sleep(PAUSE);
        }
        if !is_still(&file, folder) {
            return Ok(None);
        }
        remove_left_over(folder);
        Ok(Some(FolderLock { _file: file }))
    }
}

#[cfg(unix)]
fn open(folder: &Path) -> std::io::Result<File> {
    File::open(folder)
}

#[cfg(unix)]
fn is_still(file: &File, folder: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let id = |meta: fs::Metadata| (meta.dev(), meta.ino());
    matches!((file.metadata().map(id), fs::metadata(folder).map(id)), (Ok(a), Ok(b)) if a == b)
}

/// On other systems a folder cannot be opened: a file in it is locked instead.
#[cfg(not(unix))]
fn open(folder: &Path) -> std::io::Result<File> {
    fs::OpenOptions::new().create(true).write(true).truncate(false).open(folder.join(".groebot-lock"))
}

#[cfg(not(unix))]
fn is_still(_: &File, folder: &Path) -> bool {
    folder.is_dir()
}

/// The marker of a folder whose set of files is being replaced. It is on the disk before the first file changes and is
/// removed after the last change.
pub(super) struct Unfinished<'d> {
    disk: &'d dyn Disk,
    note: PathBuf,
    /// The names left by an earlier, interrupted writer.
    before: BTreeSet<String>,
    now: BTreeSet<String>,
}

impl<'d> Unfinished<'d> {
    /// Writes the marker.
    pub(super) fn begin(disk: &'d dyn Disk, folder: &Path, names: impl Iterator<Item = String>) -> Result<Self> {
        let note = folder.join(UNFINISHED);
        let (before, now) = (listed(&note), names.collect());
        let unfinished = Unfinished { disk, note, before, now };
        if let Err(error) = unfinished.put(&unfinished.before | &unfinished.now) {
            // Nothing has changed yet. If the marker cannot be removed either, it refuses files that are still
            // complete.
            let _ = unfinished.undone();
            return Err(error);
        }
        Ok(unfinished)
    }

    /// Completes the set: all its files are new. Only those of an earlier set may be incomplete.
    pub(super) fn done(self) -> Result<()> {
        self.put(&self.before - &self.now)
    }

    /// Reverts the set: all its files are unchanged.
    pub(super) fn undone(self) -> Result<()> {
        self.put(self.before.clone())
    }

    fn put(&self, names: BTreeSet<String>) -> Result<()> {
        let io = |error| Error::io(&self.note, &error);
        if names.is_empty() {
            return if self.note.exists() { self.disk.remove(&self.note).map_err(io) } else { Ok(()) };
        }
        let text: String = names.iter().map(|name| format!("{name}\n")).collect();
        let file = write_beside(self.disk, &self.note, text.as_bytes())?;
        self.disk.rename(file.path(), &self.note).map_err(io)?;
        self.disk.sync_folder(parent(&self.note)).map_err(io)
    }
}

/// The names in a marker.
fn listed(note: &Path) -> BTreeSet<String> {
    fs::read_to_string(note).map_or_else(|_| BTreeSet::new(), |text| text.lines().map(str::to_owned).collect())
}

/// Refuses a file of a set that is being replaced, or whose replacement was interrupted. It may not match the other
/// files of the set.
///
/// # Errors
/// [`ErrorKind::Io`] with the file.
pub fn refuse_unfinished(path: &Path) -> Result<()> {
    let Some(name) = path.file_name().and_then(|name| name.to_str()) else { return Ok(()) };
    if !listed(&parent(path).join(UNFINISHED)).contains(name) {
        return Ok(());
    }
    let text = "the writing of a set with this file was interrupted, or is in progress; run the command that writes the set again";
    Err(Error::new(ErrorKind::Io, text).in_file(path))
}
