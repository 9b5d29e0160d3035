//! Folders of packages, and the files that a description may include. Main type: [`Packages`].

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};

use quick_xml::Reader;
use quick_xml::events::Event;

use crate::document::shown;
use crate::model::ReadOptions;
use crate::{Error, ErrorKind, Result};

/// Levels of folders that are searched for packages.
const LEVELS: usize = 4;
/// Maximum number of folders that are searched for a package.
const FOLDERS: usize = 20_000;
/// Maximum size of a `package.xml` in bytes.
const MANIFEST: u64 = 100_000;

/// The package `name` in `folder` or at most four levels below.
pub fn inside(folder: &Path, name: &str) -> Option<PathBuf> {
    if !is_package_name(name) {
        return None;
    }
    let direct = folder.join(name);
    if direct.is_dir() {
        return Some(direct);
    }
    search(folder, name, LEVELS, &mut { FOLDERS })
}

fn search(folder: &Path, name: &str, levels: usize, left: &mut usize) -> Option<PathBuf> {
    *left = left.checked_sub(1)?;
    let manifest = folder.join("package.xml");
    if manifest.is_file() {
        return (package_name(&manifest).as_deref() == Some(name)).then(|| folder.to_owned());
    }
    let levels = levels.checked_sub(1)?;
    let mut below: Vec<PathBuf> = fs::read_dir(folder).ok()?.flatten().map(|entry| entry.path()).collect();
    below.sort();
    below.into_iter().filter(|path| path.is_dir()).find_map(|path| search(&path, name, levels, left))
}

/// Whether `name` is a single name of a folder.
fn is_package_name(name: &str) -> bool {
    !name.is_empty() && ![".", ".."].contains(&name) && !name.contains(['/', '\\', '\0', ':'])
}

/// The name in a `package.xml`.
fn package_name(manifest: &Path) -> Option<String> {
    if fs::metadata(manifest).ok()?.len() > MANIFEST {
        return None;
    }
    let text = fs::read_to_string(manifest).ok()?;
    let mut reader = Reader::from_str(&text);
    let mut in_name = false;
    loop {
        match reader.read_event().ok()? {
            Event::Start(start) => in_name = start.name().as_ref() == b"name",
            Event::Text(text) if in_name => return Some(text.decode().ok()?.trim().to_owned()),
            Event::Eof => return None,
            _ => {}
        }
    }
}

/// The packages of one expansion, and the folders whose files it may read.
pub struct Packages<'o> {
    options: &'o ReadOptions,
    /// Packages that were searched, each with its folder.
    known: HashMap<String, PathBuf>,
    /// The folders whose files may be read, without symbolic links.
    roots: Vec<PathBuf>,
}

impl<'o> Packages<'o> {
    /// The packages of a description in `folder`: those of `options`, and the package that contains the description.
    pub fn new(folder: &Path, options: &'o ReadOptions) -> Self {
        let mut packages = Packages { options, known: HashMap::new(), roots: Vec::new() };
        packages.allow(folder);
        for (name, path) in options.given_packages() {
            packages.allow(path);
            packages.known.entry(name.to_owned()).or_insert_with(|| absolute(path));
        }
        if let Some(own) = packages.roots.first().cloned().as_deref().and_then(own_package) {
            packages.allow(&own);
            if let Some(name) = package_name(&own.join("package.xml")) {
                packages.known.entry(name).or_insert(own);
            }
        }
        packages
    }

    /// The folder of the package `name`.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] if it is not found.
    pub fn find(&mut self, name: &str) -> Result<PathBuf> {
        if let Some(path) = self.known.get(name) {
            return Ok(path.clone());
        }
        let missing = || {
            let text = format!(
                "the package `{}` is not found; give `--package {}=FOLDER`, or its folder in ROS_PACKAGE_PATH or AMENT_PREFIX_PATH",
                shown(name),
                shown(name)
            );
            Error::new(ErrorKind::UnknownName, text)
        };
        let path = Some(name).filter(|name| is_package_name(name)).and_then(|name| self.options.find_package(name));
        let path = absolute(&path.ok_or_else(missing)?);
        self.allow(&path);
        self.known.insert(name.to_owned(), path.clone());
        Ok(path)
    }

    fn allow(&mut self, folder: &Path) {
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        self.roots.extend(fs::canonicalize(folder).ok());
    }

    /// The file at `path` without symbolic links; `None` if it does not exist.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for a file outside of the description's folder and the packages;
    /// [`ErrorKind::Io`] for a folder or a device.
    pub fn allowed(&self, path: &Path) -> Result<Option<PathBuf>> {
        let Ok(real) = fs::canonicalize(path) else { return Ok(None) };
        if !self.roots.iter().any(|root| real.starts_with(root)) {
            let text = format!(
                "the file `{}` is outside of the description's folder and of the given packages; give its package by `--package NAME=FOLDER`",
                shown(&path.to_string_lossy())
            );
            return Err(Error::new(ErrorKind::Unsupported, text));
        }
        if !real.is_file() {
            let text = format!("`{}` is not a file; give a file", shown(&path.to_string_lossy()));
            return Err(Error::new(ErrorKind::Io, text));
        }
        Ok(Some(real))
    }
}

/// The path from the root of the file system.
fn absolute(path: &Path) -> PathBuf {
    std::path::absolute(path).unwrap_or_else(|_| path.to_owned())
}

/// The nearest folder with a `package.xml` that contains `folder`.
fn own_package(folder: &Path) -> Option<PathBuf> {
    folder.ancestors().find(|folder| folder.join("package.xml").is_file()).map(Path::to_owned)
}
