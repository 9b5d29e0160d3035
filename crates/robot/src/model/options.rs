//! Options for the reading of robot descriptions. Main type: [`ReadOptions`].

use std::env;
use std::path::{Path, PathBuf};

use super::package_folders;

/// Options for the reading of a robot description: the folders of packages and the values of xacro's arguments.
///
/// ```
/// # use groebot_robot::model::ReadOptions;
/// let options = ReadOptions::new().package("ur_description", "/opt/ur_description").argument("ur_type", "ur5e");
/// assert_eq!(options.arguments().next(), Some(("ur_type", "ur5e")));
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ReadOptions {
    packages: Vec<(String, PathBuf)>,
    folders: Vec<PathBuf>,
    arguments: Vec<(String, String)>,
}

impl ReadOptions {
    /// Options without packages and arguments.
    pub fn new() -> Self {
        ReadOptions::default()
    }

    /// Options that search packages in the folders of the environment variables `ROS_PACKAGE_PATH`, and `share` in the
    /// folders of `AMENT_PREFIX_PATH`.
    pub fn from_environment() -> Self {
        let listed = |name| env::var_os(name).map(|text| env::split_paths(&text).collect()).unwrap_or_default();
        let ros: Vec<PathBuf> = listed("ROS_PACKAGE_PATH");
        let ament: Vec<PathBuf> = listed("AMENT_PREFIX_PATH");
        let folders = ros.into_iter().chain(ament.into_iter().map(|prefix| prefix.join("share")));
        folders.filter(|folder| folder.is_absolute()).fold(ReadOptions::new(), ReadOptions::folder)
    }

    /// Adds the package `name` in the folder `path`. The first one of a name counts.
    #[must_use]
    pub fn package(mut self, name: impl Into<String>, path: impl Into<PathBuf>) -> Self {
        self.packages.push((name.into(), path.into()));
        self
    }

    /// Adds a folder with packages. A package is a folder with a `package.xml` that has its name, at most four levels
    /// below, or a direct subfolder with the package's name.
    #[must_use]
    pub fn folder(mut self, path: impl Into<PathBuf>) -> Self {
        self.folders.push(path.into());
        self
    }

    /// Sets the argument `name` of a description in xacro. The last value of a name counts.
    #[must_use]
    pub fn argument(mut self, name: impl Into<String>, value: impl Into<String>) -> Self {
        self.arguments.push((name.into(), value.into()));
        self
    }

    /// The arguments of a description in xacro, as names and values.
    pub fn arguments(&self) -> impl Iterator<Item = (&str, &str)> {
        self.arguments.iter().map(|(name, value)| (name.as_str(), value.as_str()))
    }

    /// The folder of the package `name`, which is one of [`ReadOptions::package`], else in one of
    /// [`ReadOptions::folder`].
    pub fn find_package(&self, name: &str) -> Option<PathBuf> {
        let given = self.packages.iter().find(|(known, _)| known == name).map(|(_, path)| path.clone());
        given.or_else(|| self.folders.iter().find_map(|folder| package_folders::inside(folder, name)))
    }

    /// The folders of the packages that are given by name.
    pub(super) fn given_packages(&self) -> impl Iterator<Item = (&str, &Path)> {
        self.packages.iter().map(|(name, path)| (name.as_str(), path.as_path()))
    }
}
