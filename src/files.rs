//! Files that are never half-written: everything goes to temporary files beside their targets, is
//! brought to the disk, and only then renamed. [`StagedFolder`] does it for a set of files at once.

use std::collections::HashSet;
use std::fs;
use std::io::Write;
use std::path::{Component, Path, PathBuf};

use tempfile::NamedTempFile;

use crate::{Error, ErrorKind, Result, Watch};

/// Replaces the content of `path` by `bytes`: readers see the old file or the new one, nothing between.
///
/// The folder must exist. A symbolic link at `path` is replaced, not followed.
///
/// # Errors
/// [`ErrorKind::BadValue`] when `path` names no file, [`ErrorKind::Io`] when the disk refuses; the old file then stays.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> Result<()> {
    if path.file_name().is_none() {
        return Err(Error::new(ErrorKind::BadValue, "this path names no file; end it in a file name").in_file(path));
    }
    rename_onto(write_beside(path, bytes)?, path)?;
    sync_folder(parent(path))
}

/// Replaces or creates `files` (name, content) in `folder`, which is created when it is absent.
///
/// # Errors
/// Those of [`StagedFolder::stage`] and [`StagedFolder::commit`].
pub fn write_folder_atomically(folder: &Path, files: &[(String, Vec<u8>)], watch: &Watch) -> Result<()> {
    let staged = StagedFolder::stage(folder, files, watch)?;
    watch.check()?;
    staged.commit()
}

/// A set of files that is complete on the disk but still under temporary names.
///
/// Dropped without [`commit`](Self::commit), it removes the temporary files and the folders that it created.
#[derive(Debug)]
pub struct StagedFolder {
    files: Vec<StagedFile>,
    // After `files`: fields drop in order, and a folder is removed only once it is empty.
    folders: NewFolders,
}

#[derive(Debug)]
struct StagedFile {
    target: PathBuf,
    new: NamedTempFile,
    /// A copy of what `target` held at the time of staging.
    old: Option<NamedTempFile>,
}

impl StagedFolder {
    /// Writes every file under a temporary name in `folder`; nothing that can be seen changes.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a name that is not a plain file name, [`ErrorKind::DuplicateName`],
    /// [`ErrorKind::Io`], and those of [`Watch::check`], which is asked before each file.
    pub fn stage(folder: &Path, files: &[(String, Vec<u8>)], watch: &Watch) -> Result<Self> {
        let mut names = HashSet::new();
        for (name, _) in files {
            check_name(name).map_err(|error| error.in_file(folder))?;
            if !names.insert(name) {
                let text = format!("the file `{name}` is given twice; give each name once");
                return Err(Error::new(ErrorKind::DuplicateName, text).in_file(folder));
            }
        }
        let mut staged = StagedFolder { files: Vec::new(), folders: NewFolders::create(folder)? };
        for (name, bytes) in files {
            watch.check()?;
            staged.files.push(StagedFile::write(folder.join(name), bytes)?);
        }
        Ok(staged)
    }

    /// Renames every file to its own name. When one rename fails, those before it are taken back.
    ///
    /// A process that is killed between two renames leaves some new files beside some old ones;
    /// each file by itself is whole.
    ///
    /// # Errors
    /// [`ErrorKind::Io`], about the file that could not be replaced or taken back.
    pub fn commit(self) -> Result<()> {
        let StagedFolder { files, folders } = self;
        let mut done = Vec::new();
        for StagedFile { target, new, old } in files {
            if let Err(error) = rename_onto(new, &target) {
                take_back(done)?;
                return Err(error);
            }
            done.push((target, old));
        }
        sync_folder(&folders.folder)?;
        folders.keep();
        Ok(())
    }
}

impl StagedFile {
    fn write(target: PathBuf, bytes: &[u8]) -> Result<Self> {
        let old = match fs::read(&target) {
            Ok(content) => Some(write_beside(&target, &content)?),
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => None,
            Err(error) => return Err(Error::io(&target, &error)),
        };
        let new = write_beside(&target, bytes)?;
        Ok(StagedFile { target, new, old })
    }
}

/// Undoes renames: an old content returns, a file that was not there goes.
fn take_back(done: Vec<(PathBuf, Option<NamedTempFile>)>) -> Result<()> {
    for (target, old) in done {
        match old {
            Some(old) => rename_onto(old, &target)?,
            None => fs::remove_file(&target).map_err(|error| Error::io(&target, &error))?,
        }
    }
    Ok(())
}

/// The folders that staging had to create, outermost first; removed on drop where they are empty.
#[derive(Debug)]
struct NewFolders {
    folder: PathBuf,
    created: Vec<PathBuf>,
}

impl NewFolders {
    fn create(folder: &Path) -> Result<Self> {
        let is_absent = |path: &&Path| !path.as_os_str().is_empty() && !path.exists();
        let mut absent: Vec<PathBuf> = folder.ancestors().take_while(is_absent).map(Path::to_owned).collect();
        absent.reverse();
        let mut folders = NewFolders { folder: folder.to_owned(), created: Vec::new() };
        for path in absent {
            match fs::create_dir(&path) {
                Ok(()) => folders.created.push(path),
                // Another process was faster: the folder is there, and not ours to remove.
                Err(error) if error.kind() == std::io::ErrorKind::AlreadyExists => {}
                Err(error) => return Err(Error::io(&path, &error)),
            }
        }
        Ok(folders)
    }

    fn keep(mut self) {
        self.created.clear();
    }
}

impl Drop for NewFolders {
    fn drop(&mut self) {
        for path in self.created.iter().rev() {
            // Not ours any more when someone else put a file there: `remove_dir` then refuses.
            let _ = fs::remove_dir(path);
        }
    }
}

fn check_name(name: &str) -> Result<()> {
    let mut components = Path::new(name).components();
    match (components.next(), components.next()) {
        (Some(Component::Normal(only)), None) if only == name => Ok(()),
        _ => {
            let text = format!("`{name}` is no plain file name; give a name without folders");
            Err(Error::new(ErrorKind::BadValue, text))
        }
    }
}

/// A temporary file in the folder of `path` that holds `bytes`, on the disk.
fn write_beside(path: &Path, bytes: &[u8]) -> Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".groebot-").suffix(".tmp");
    #[cfg(unix)]
    builder.permissions(permissions_for(path));
    let write = || {
        let mut file = builder.tempfile_in(parent(path))?;
        file.write_all(bytes)?;
        file.as_file().sync_all()?;
        Ok(file)
    };
    write().map_err(|error| Error::io(path, &error))
}

/// Those of the file that `path` replaces, or those that any new file gets (the umask applies to both).
#[cfg(unix)]
fn permissions_for(path: &Path) -> fs::Permissions {
    use std::os::unix::fs::PermissionsExt;
    let mode = fs::metadata(path).map_or(0o666, |old| old.permissions().mode() & 0o777);
    fs::Permissions::from_mode(mode)
}

fn rename_onto(file: NamedTempFile, target: &Path) -> Result<()> {
    file.persist(target).map(drop).map_err(|error| Error::io(target, &error.error))
}

fn parent(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// Brings the renames themselves to the disk, where the system can.
fn sync_folder(folder: &Path) -> Result<()> {
    if cfg!(unix) {
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        fs::File::open(folder).and_then(|file| file.sync_all()).map_err(|error| Error::io(folder, &error))?;
    }
    Ok(())
}
