//! Temporary files. A writer locks its temporary file while it is open, so an unlocked one was left by a killed
//! process.

use std::ffi::OsStr;
use std::fs::{self, DirEntry, File, TryLockError};
use std::io;
use std::path::Path;

use tempfile::NamedTempFile;

use super::disk::{Disk, ENDS};

/// Creates a temporary file in `folder` with [`Disk::create`]. It is locked until it is closed, if the file system
/// supports locks.
pub(super) fn create(disk: &dyn Disk, folder: &Path, like: &Path) -> io::Result<NamedTempFile> {
    loop {
        let file = disk.create(folder, like)?;
        // Another process may have removed it as a left-over file before it was locked.
        let is_taken = matches!(file.as_file().try_lock(), Err(TryLockError::WouldBlock));
        if !is_taken && file.path().exists() {
            return Ok(file);
        }
    }
}

/// Removes the unlocked temporary files in `folder`. A file that cannot be removed is left to the next writer.
pub(super) fn remove_left_over(folder: &Path) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten().filter(is_temporary) {
        let path = entry.path();
        // The lock is held until the file is removed.
        if let Ok(file) = File::open(&path)
            && file.try_lock().is_ok()
        {
            let _ = fs::remove_file(&path);
        }
    }
}

fn is_temporary(entry: &DirEntry) -> bool {
    let is_ours = |name: &OsStr| {
        let name = name.to_string_lossy();
        name.starts_with(ENDS[0]) && name.ends_with(ENDS[1])
    };
    is_ours(&entry.file_name()) && entry.file_type().is_ok_and(|kind| kind.is_file())
}
