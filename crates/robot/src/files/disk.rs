//! Interface of the writer to the file system. Main type: [`Disk`].

use std::fmt::Debug;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::Path;

use tempfile::NamedTempFile;

/// Beginning and end of a temporary file's name.
pub(super) const ENDS: [&str; 2] = [".groebot-", ".tmp"];

/// The calls by which files are replaced. By default each one calls the operating system. Tests override single calls
/// to make them fail.
pub trait Disk: Debug {
    /// Creates a temporary file in `folder` with the permissions of the file `like`, or of a new file.
    ///
    /// # Errors
    /// Those of the operating system, as for all calls below.
    fn create(&self, folder: &Path, like: &Path) -> io::Result<NamedTempFile> {
        let mut builder = tempfile::Builder::new();
        builder.prefix(ENDS[0]).suffix(ENDS[1]);
        #[cfg(unix)]
        builder.permissions(permissions_of(like));
        #[cfg(not(unix))]
        let _ = like;
        builder.tempfile_in(folder)
    }

    /// Writes all `bytes` at the end of `file`.
    ///
    /// # Errors
    /// Those of [`Disk::create`].
    fn write(&self, file: &mut File, bytes: &[u8]) -> io::Result<()> {
        file.write_all(bytes)
    }

    /// Flushes the content of `file` to the disk.
    ///
    /// # Errors
    /// Those of [`Disk::create`].
    fn sync(&self, file: &File) -> io::Result<()> {
        file.sync_all()
    }

    /// Renames the file `from` to `to` and replaces a file with this name.
    ///
    /// # Errors
    /// Those of [`Disk::create`].
    fn rename(&self, from: &Path, to: &Path) -> io::Result<()> {
        fs::rename(from, to)
    }

    /// Removes the file `path`.
    ///
    /// # Errors
    /// Those of [`Disk::create`].
    fn remove(&self, path: &Path) -> io::Result<()> {
        fs::remove_file(path)
    }

    /// Flushes the directory entries of `folder` to the disk, if the operating system supports it.
    ///
    /// # Errors
    /// Those of [`Disk::create`].
    fn sync_folder(&self, folder: &Path) -> io::Result<()> {
        if cfg!(unix) { File::open(folder)?.sync_all() } else { Ok(()) }
    }
}

/// The operating system's file system.
#[derive(Clone, Copy, Debug, Default)]
pub struct System;

impl Disk for System {}

/// The permissions of the file that `path` replaces, or of a new file. The umask applies to both.
#[cfg(unix)]
fn permissions_of(path: &Path) -> fs::Permissions {
    use std::os::unix::fs::PermissionsExt;
    let mode = fs::metadata(path).map_or(0o666, |old| old.permissions().mode() & 0o777);
    fs::Permissions::from_mode(mode)
}
