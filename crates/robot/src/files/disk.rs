//! What the writer asks of the file system. Main type: [`Disk`].

use std::fmt::Debug;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::Path;

use tempfile::NamedTempFile;

/// How the name of a temporary file begins and ends.
pub(super) const ENDS: [&str; 2] = [".groebot-", ".tmp"];

/// The calls by which files are replaced. Each does what the operating system does; a test overrides them one by one to make them fail.
pub trait Disk: Debug {
    /// A new temporary file in `folder` with the permissions that the file `like` has, or that any new file gets.
    ///
    /// # Errors
    /// Those of the operating system; so do all calls below.
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
    /// As [`Disk::create`].
    fn write(&self, file: &mut File, bytes: &[u8]) -> io::Result<()> {
        file.write_all(bytes)
    }

    /// Brings the content of `file` to the disk.
    ///
    /// # Errors
    /// As [`Disk::create`].
    fn sync(&self, file: &File) -> io::Result<()> {
        file.sync_all()
    }

    /// Gives the file `from` the name `to`, in place of a file that has this name.
    ///
    /// # Errors
    /// As [`Disk::create`].
    fn rename(&self, from: &Path, to: &Path) -> io::Result<()> {
        fs::rename(from, to)
    }

    /// Removes the file `path`.
    ///
    /// # Errors
    /// As [`Disk::create`].
    fn remove(&self, path: &Path) -> io::Result<()> {
        fs::remove_file(path)
    }

    /// Brings the names in `folder` to the disk, where the operating system can.
    ///
    /// # Errors
    /// As [`Disk::create`].
    fn sync_folder(&self, folder: &Path) -> io::Result<()> {
        if cfg!(unix) { File::open(folder)?.sync_all() } else { Ok(()) }
    }
}

/// The file system itself.
#[derive(Clone, Copy, Debug, Default)]
pub struct System;

impl Disk for System {}

/// Those of the file that `path` replaces, or those that any new file gets (the umask applies to both).
#[cfg(unix)]
fn permissions_of(path: &Path) -> fs::Permissions {
    use std::os::unix::fs::PermissionsExt;
    let mode = fs::metadata(path).map_or(0o666, |old| old.permissions().mode() & 0o777);
    fs::Permissions::from_mode(mode)
}
