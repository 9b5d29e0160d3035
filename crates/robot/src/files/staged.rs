//! Atomic replacement of sets of files. Main type: [`StagedFolder`].

use std::collections::HashSet;
use std::fs;
use std::path::{Component, Path, PathBuf};

use tempfile::NamedTempFile;

use super::disk::{Disk, System};
use super::lock::{FolderLock, Unfinished};
use super::{Writing, parent, rename_onto, write_beside, writing};
use crate::{Error, ErrorKind, Result, Watch};

/// A set of files that is complete on the disk under temporary names. The folder is locked for other groebot processes.
///
/// If it is dropped without [`commit`](Self::commit), it removes the temporary files and the folders that it created. A
/// second staging in the same folder waits for the first.
#[derive(Debug)]
pub struct StagedFolder<'d> {
    disk: &'d dyn Disk,
    changes: Vec<Change>,
    // After `changes`, because fields are dropped in order, and a folder is removed only when it is empty.
    folders: NewFolders,
    // Last: the lock is held until the folder is restored.
    _lock: FolderLock,
    _writing: Writing,
}

/// One file that is replaced, created or removed.
#[derive(Debug)]
struct Change {
    target: PathBuf,
    /// `None` removes the file.
    new: Option<NamedTempFile>,
    /// A copy of the content of `target` at the time of staging.
    old: Option<NamedTempFile>,
}

impl StagedFolder<'static> {
    /// Writes every file under a temporary name in `folder`. Existing files are unchanged.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a name that is not a plain file name, or that is the name of a link, a device, a
    /// pipe or a socket; [`ErrorKind::DuplicateName`], [`ErrorKind::Io`], and those of [`Watch::check`], which is
    /// called before each file and while waiting for the lock.
    pub fn stage<'w>(folder: &Path, files: &[(String, Vec<u8>)], watch: impl Into<Option<&'w Watch>>) -> Result<Self> {
        let watch = Watch::or_none(watch);
        StagedFolder::stage_on(&System, folder, files, watch)
    }
}

impl<'d> StagedFolder<'d> {
    /// Same as [`StagedFolder::stage`], but on another `disk`.
    ///
    /// # Errors
    /// Those of [`StagedFolder::stage`].
    pub fn stage_on<'w>(
        disk: &'d dyn Disk,
        folder: &Path,
        files: &[(String, Vec<u8>)],
        watch: impl Into<Option<&'w Watch>>,
    ) -> Result<Self> {
        let watch = Watch::or_none(watch);
        check_names(folder, files)?;
        let (folders, lock) = open(folder, watch)?;
        let mut staged = StagedFolder { disk, changes: Vec::new(), folders, _lock: lock, _writing: writing() };
        for (name, bytes) in files {
            watch.check()?;
            let change = Change::write(disk, folder.join(name), bytes)?;
            staged.changes.push(change);
        }
        Ok(staged)
    }

    /// Also removes the file `name`, if there is one.
    ///
    /// # Errors
    /// Those of [`StagedFolder::stage`].
    pub fn without(mut self, name: &str) -> Result<Self> {
        check_name(name).map_err(|error| error.in_file(&self.folders.folder))?;
        let target = self.folders.folder.join(name);
        let old = old_content(self.disk, &target)?;
        self.changes.push(Change { target, new: None, old });
        Ok(self)
    }

    /// Renames every file to its own name. When one step fails, the steps before it are reverted.
    ///
    /// If the process is killed meanwhile, each file is old or new, and [`refuse_unfinished`](super::refuse_unfinished)
    /// refuses them all.
    ///
    /// # Errors
    /// [`ErrorKind::Io`], about the file that could not be replaced or restored.
    pub fn commit(self) -> Result<()> {
        let StagedFolder { disk, changes, folders, _lock, _writing } = self;
        let names = changes.iter().filter_map(|change| change.target.file_name());
        let unfinished =
            Unfinished::begin(disk, &folders.folder, names.map(|name| name.to_string_lossy().into_owned()))?;
        let mut done = Vec::new();
        let replaced = changes.into_iter().try_for_each(|change| change.apply(disk, &mut done));
        let replaced = replaced.and_then(|()| {
            disk.sync_folder(parent(&folders.folder.join("x"))).map_err(|error| Error::io(&folders.folder, &error))
        });
        if let Err(error) = replaced {
            revert(disk, done)?;
            unfinished.undone()?;
            return Err(error);
        }
        unfinished.done()?;
        folders.keep();
        Ok(())
    }
}

/// Opens and locks the folder. It is created when absent.
fn open(folder: &Path, watch: &Watch) -> Result<(NewFolders, FolderLock)> {
    loop {
        watch.check()?;
        let folders = NewFolders::create(folder)?;
        if let Some(lock) = FolderLock::take(parent(&folder.join("x")), watch)? {
            return Ok((folders, lock));
        }
    }
}

impl Change {
    fn write(disk: &dyn Disk, target: PathBuf, bytes: &[u8]) -> Result<Self> {
        let old = old_content(disk, &target)?;
        let new = Some(write_beside(disk, &target, bytes)?);
        Ok(Change { target, new, old })
    }

    /// Replaces or removes the file, and records its old content.
    fn apply(self, disk: &dyn Disk, done: &mut Vec<(PathBuf, Option<NamedTempFile>)>) -> Result<()> {
        let Change { target, new, old } = self;
        match new {
            Some(new) => rename_onto(disk, new, &target)?,
            // The file is already absent.
            None if old.is_none() => return Ok(()),
            None => disk.remove(&target).map_err(|error| Error::io(&target, &error))?,
        }
        done.push((target, old));
        Ok(())
    }
}

/// A copy of the regular file `target`; `None` without a file.
fn old_content(disk: &dyn Disk, target: &Path) -> Result<Option<NamedTempFile>> {
    let found = match fs::symlink_metadata(target) {
        Ok(found) => found,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(Error::io(target, &error)),
    };
    if !found.is_file() && !found.is_dir() {
        let text = "a link, a device, a pipe or a socket has the name of a file of this set; give another folder, or move it away";
        return Err(Error::new(ErrorKind::BadValue, text).in_file(target));
    }
    let content = fs::read(target).map_err(|error| Error::io(target, &error))?;
    write_beside(disk, target, &content).map(Some)
}

/// Reverts changes: old content is restored, new files are removed. All are attempted; the first failure is reported.
fn revert(disk: &dyn Disk, done: Vec<(PathBuf, Option<NamedTempFile>)>) -> Result<()> {
    let back = |(target, old): (PathBuf, Option<NamedTempFile>)| match old {
        Some(old) => rename_onto(disk, old, &target),
        None => disk.remove(&target).map_err(|error| Error::io(&target, &error)),
    };
    let failures: Vec<Error> = done.into_iter().map(back).filter_map(Result::err).collect();
    failures.into_iter().next().map_or(Ok(()), Err)
}

/// The folders that staging created, outermost first. Empty ones are removed on drop.
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
                // Another process created the folder first: it is not removed.
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
            // If another process put a file there, `remove_dir` refuses.
            let _ = fs::remove_dir(path);
        }
    }
}

fn check_names(folder: &Path, files: &[(String, Vec<u8>)]) -> Result<()> {
    let mut names = HashSet::new();
    for (name, _) in files {
        check_name(name).map_err(|error| error.in_file(folder))?;
        if !names.insert(name) {
            let text = format!("the file `{name}` is given twice; give each name once");
            return Err(Error::new(ErrorKind::DuplicateName, text).in_file(folder));
        }
    }
    Ok(())
}

fn check_name(name: &str) -> Result<()> {
    let mut components = Path::new(name).components();
    match (components.next(), components.next()) {
        (Some(Component::Normal(only)), None) if only == name => Ok(()),
        _ => {
            let text = format!("`{name}` is not a plain file name; give a name without folders");
            Err(Error::new(ErrorKind::BadValue, text))
        }
    }
}
