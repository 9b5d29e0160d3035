//! Folders of packages, and the files that a description may include. Main type: [`Packages`].

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};

use crate::document::shown;
use crate::model::ReadOptions;
use crate::model::package_folders::{is_package_name, package_name};
use crate::{Error, ErrorKind, Result};

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
