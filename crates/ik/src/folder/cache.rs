//! Solvers of robots by name, derived at their first use. Main type: [`SolverCache`].

use std::env;
use std::fs;
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};
use tempfile::TempDir;

use super::outputs::hex;
use super::{PROGRAM, derived};
use crate::derive::problem::input::InputFile;
use crate::derive::{Derivation, Ends, Source};
use crate::witness;
use crate::{Error, ErrorKind, Result, Watch};
use groebot_algebra::limits::STAGE_BYTES;
use groebot_robot::document::{read_bytes, read_text, shown};
use groebot_robot::files::write_folder_atomically;
use groebot_robot::robots::{Kind, LISTED, Listed};

/// The environment variable with the folder of the cache.
const VARIABLE: &str = "GROEBOT_CACHE";
/// The file with the hashes of all other files of a folder, in the format of the program `sha256sum`.
const HASHES: &str = "cache.sha256";
/// The number of hexadecimal digits of a description's hash in the name of its folder.
const DIGITS: usize = 16;
/// The number of attempts to replace a damaged folder while other processes do the same.
const ATTEMPTS: usize = 3;

/// A folder with the derivations of robots by name.
///
/// Each robot has a folder of its own, whose name contains the version of groebot and the hash of the description. It has the files that `groebot derive` writes,
/// and the hash of each. A folder appears under its name only when it is complete, so that several processes can share the cache.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SolverCache {
    folder: PathBuf,
}

impl SolverCache {
    /// The cache in `folder`, which is created when it is needed.
    pub fn new(folder: impl Into<PathBuf>) -> Self {
        SolverCache { folder: folder.into() }
    }

    /// The user's cache: the folder in `GROEBOT_CACHE` if this environment variable is set; else `groebot/solvers` in the system's cache folder, which is
    /// `XDG_CACHE_HOME` or `~/.cache`, `~/Library/Caches` on macOS, and `LOCALAPPDATA` on Windows.
    ///
    /// # Errors
    /// [`ErrorKind::Io`] if no such variable and no home folder are set.
    pub fn of_user() -> Result<Self> {
        let variable = |name: &str| env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from);
        let home = |folder: &str| variable("HOME").map(|home| home.join(folder));
        let system = || {
            if cfg!(windows) {
                variable("LOCALAPPDATA")
            } else if cfg!(target_os = "macos") {
                home("Library/Caches")
            } else {
                variable("XDG_CACHE_HOME").filter(|folder| folder.is_absolute()).or_else(|| home(".cache"))
            }
        };
        let folder = variable(VARIABLE).or_else(|| system().map(|folder| folder.join("groebot/solvers")));
        let none = || {
            let text = format!("there is no cache folder for derived solvers; set {VARIABLE} to a folder");
            Error::new(ErrorKind::Io, text)
        };
        folder.map(SolverCache::new).ok_or_else(none)
    }

    /// Checks that the folder has the derivation of `robot`, or that it can be stored there.
    ///
    /// # Errors
    /// [`ErrorKind::Io`] where the folder cannot be written.
    pub fn check(&self, robot: &Listed) -> Result<()> {
        if is_sound(&self.folder.join(folder_name(robot))) { Ok(()) } else { self.new_folder().map(drop) }
    }

    /// A new folder in the cache, for files that are not complete.
    fn new_folder(&self) -> Result<TempDir> {
        let new = fs::create_dir_all(&self.folder).and_then(|()| TempDir::with_prefix_in(".new-", &self.folder));
        new.map_err(|error| {
            let (folder, reason) = (shown(&self.folder.to_string_lossy()), error.kind());
            let text =
                format!("derived solvers cannot be stored in `{folder}`: {reason}; set {VARIABLE} to another folder");
            Error::new(ErrorKind::Io, text)
        })
    }

    /// The folder with the derivation of `robot`. It is derived, proved and checked numerically if the cache does not have it, or has it damaged.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for a robot with several chains. As [`Source::choose_given`] and [`Derivation::of`]; [`ErrorKind::Certificate`] for a solver with
    /// a wrong or missing solution at an ordinary target; [`ErrorKind::Io`] where the folder cannot be written; those of `watch`.
    pub fn derivation<'w>(&self, robot: &Listed, watch: impl Into<Option<&'w Watch>>) -> Result<PathBuf> {
        let watch = Watch::or_none(watch);
        refuse_several_chains(robot)?;
        let folder = self.folder.join(folder_name(robot));
        if !is_sound(&folder) {
            let files = files(robot, watch)?;
            place(&files, &folder, &self.new_folder()?, watch)?;
        }
        Ok(folder)
    }
}

/// Refuses a robot with several chains.
fn refuse_several_chains(robot: &Listed) -> Result<()> {
    if robot.kind() != Kind::Robot {
        return Ok(());
    }
    let limbs = LISTED.iter().map(Listed::name).filter(|name| name.starts_with(robot.name()) && *name != robot.name());
    let text = format!(
        "`{}` has several chains, and so no solver; its chains are {}",
        robot.name(),
        limbs.map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
    );
    Err(Error::new(ErrorKind::Unsupported, text))
}

/// The name of a robot's folder: the robot, the version of groebot, and the hash of the description.
fn folder_name(robot: &Listed) -> String {
    let described = format!("{:?}\n{}", robot.ends(), robot.text());
    let hash = hex(&Sha256::digest(described));
    format!("{}-{}-{}", robot.name(), env!("CARGO_PKG_VERSION"), &hash[..DIGITS])
}

/// The files of the derivation of `robot`, with their hashes.
fn files(robot: &Listed, watch: &Watch) -> Result<Vec<(String, Vec<u8>)>> {
    let mut source = Source::of(InputFile::of_robot(robot)?, &Ends::default())?;
    source.choose_given(watch)?;
    let at_robot = |error: Error| error.in_file(&source.path);
    let derivation = Derivation::of(&source, watch).map_err(at_robot)?.about(&source);
    let checked = witness::check(&source, &derivation, watch)?;
    if let Some(row) = checked.failures().find(|row| !row.is_weak_spot()) {
        let text = format!("at an ordinary target an answer is wrong or missing: numeric check, row {}", row.number);
        return Err(at_robot(Error::new(ErrorKind::Certificate, text)));
    }
    let written = derived(&source, &derivation, &checked)?;
    let mut files: Vec<(String, Vec<u8>)> = written.into_iter().map(|file| (file.name, file.bytes)).collect();
    files.push((source.name.to_owned(), source.text.clone().into_bytes()));
    files.extend(source.task_file());
    let line = |(name, bytes): &(String, Vec<u8>)| format!("{}  {name}\n", hex(&Sha256::digest(bytes)));
    let hashes: String = files.iter().map(line).collect();
    files.push((HASHES.to_owned(), hashes.into_bytes()));
    Ok(files)
}

/// Whether a folder contains a program, and all its files have their hashes.
fn is_sound(folder: &Path) -> bool {
    let Ok(text) = read_text(&folder.join(HASHES), STAGE_BYTES) else { return false };
    let has_hash = |line: &str| {
        let Some((hash, name)) = line.split_once("  ") else { return false };
        read_bytes(&folder.join(name), STAGE_BYTES).is_ok_and(|bytes| hex(&Sha256::digest(&bytes)) == hash)
    };
    text.lines().any(|line| line.ends_with(PROGRAM)) && text.lines().all(has_hash)
}

/// Writes `files` to the folder `new`, and renames it to `folder`. A damaged folder of this name is removed; a sound one, which another process has placed meanwhile,
/// is left.
fn place(files: &[(String, Vec<u8>)], folder: &Path, new: &TempDir, watch: &Watch) -> Result<()> {
    let io = |error: std::io::Error| Error::io(folder, &error);
    let content = new.path().join("derivation");
    write_folder_atomically(&content, files, watch)?;
    let mut last = Ok(());
    for _ in 0..ATTEMPTS {
        last = fs::rename(&content, folder).map_err(io);
        if last.is_ok() || is_sound(folder) {
            return Ok(());
        }
        // Another process may have moved it already.
        let _ = fs::rename(folder, new.path().join("damaged"));
        let _ = fs::remove_dir_all(new.path().join("damaged"));
    }
    last
}
