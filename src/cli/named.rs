//! Robots by name as arguments of commands that use a derived solver, and `groebot robots`.

use std::path::{Path, PathBuf};

use serde_json::json;
use tempfile::TempDir;

use super::progress::{Limits, Session};
use super::{Outcome, console, json};
use crate::{Error, Result};
use groebot_ik::derive::problem::input::{named_robot, robot_name};
use groebot_ik::folder::SolverCache;
use groebot_robot::document::shown;
use groebot_robot::robots::{self, Kind, LISTED, Listed};

/// Options of commands that use a derived solver.
#[derive(Clone, clap::Args)]
pub struct CacheArguments {
    /// For a robot by name: derive its solver now, without the cache of derived solvers
    #[arg(long)]
    no_cache: bool,
}

/// The path of a derivation: that of an argument, or of a robot by name.
pub struct SolverPath {
    path: PathBuf,
    /// Removed with this value.
    _uncached: Option<TempDir>,
}

impl SolverPath {
    /// The folder or file.
    pub fn path(&self) -> &Path {
        &self.path
    }
}

impl CacheArguments {
    /// The derivation at `path`. For the name of a robot it is the one in the user's cache, derived at its first use with progress on standard error.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`](crate::ErrorKind::UnknownName) for a word that is neither a file nor a robot; as [`SolverCache::derivation`].
    pub fn derivation(&self, path: &Path) -> Result<SolverPath> {
        let Some(name) = robot_name(path) else { return Ok(SolverPath { path: path.to_owned(), _uncached: None }) };
        let robot = named_robot(name)?;
        let cache = if self.no_cache { None } else { usable_cache(robot) };
        let (cache, uncached) = match cache {
            Some(cache) => (cache, None),
            None => {
                let folder = TempDir::new().map_err(|error| Error::io(&std::env::temp_dir(), &error))?;
                (SolverCache::new(folder.path()), Some(folder))
            }
        };
        let session = Session::start(Limits::default())?;
        Ok(SolverPath { path: cache.derivation(robot, &session.watch)?, _uncached: uncached })
    }
}

/// The user's cache. If it does not have the derivation of `robot` and cannot store it: `None`, with a note.
fn usable_cache(robot: &Listed) -> Option<SolverCache> {
    let cache = SolverCache::of_user().and_then(|cache| cache.check(robot).map(|()| cache));
    let note = |error: &Error| console::print_notes(&[format!("`{}` is derived at each call: {error}", robot.name())]);
    cache.inspect_err(note).ok()
}

/// Whether `path` is the name of a robot with a solver.
pub fn is_chain(path: &Path) -> bool {
    robot_name(path).and_then(|name| robots::find(name).ok()).is_some_and(|robot| robot.kind() != Kind::Robot)
}

const EXAMPLES: &str = "Examples:
  groebot robots                       all, by vendor
  groebot robots kuka                  those whose name, vendor, model or source contains `kuka`
  groebot robots --json
  groebot derive franka_panda          derives the solver into the folder franka_panda
  groebot solve ur10e --target 0.5,0.2,0.4,0,1,0,0

Each command that takes a file also takes a name if no file has this name. solve, codegen, view, reach and explain use
the solver in the user's cache folder (GROEBOT_CACHE sets another one); it is derived at its first use.";

/// Lists the robots that groebot knows by name
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// Only robots whose name, vendor, model or source contains each of these words
    #[arg(value_name = "WORD")]
    words: Vec<String>,
    /// Print JSON: for each robot name, vendor, model, kind, source, and the check of its numbers
    #[arg(long)]
    json: bool,
}

/// Prints the list.
pub fn run(arguments: &Arguments) -> Outcome {
    let text = arguments.words.join(" ");
    let words: Vec<String> = text.split_whitespace().map(plain).collect();
    let has_words = |robot: &&Listed| {
        let texts = [robot.name(), robot.vendor(), robot.model(), robot.source()].map(plain);
        words.iter().all(|word| texts.iter().any(|text| text.contains(word)))
    };
    let mut robots: Vec<&Listed> = LISTED.iter().filter(has_words).collect();
    if robots.is_empty() {
        let unlisted = |error: Error| {
            let text = format!("no name, vendor, model or source contains `{}`, and {}", shown(&text), error.message());
            Error::new(error.kind(), text)
        };
        robots::find(&text).map_err(unlisted)?;
    }
    robots.sort_by_key(|robot| (robot.vendor().to_lowercase(), robot.kind(), robot.name()));
    if arguments.json {
        let robots: Vec<_> = robots.iter().map(|robot| entry(robot)).collect();
        return console::print(&json::text(&json!({ "format": json::FORMAT, "robots": robots })));
    }
    console::print(&table(&robots))
}

/// Text for comparisons: in lower case, without hyphens and underscores, `ä` as `a`.
fn plain(text: &str) -> String {
    text.to_lowercase().replace('ä', "a").replace(['_', '-'], "")
}

/// A robot as JSON.
fn entry(robot: &Listed) -> serde_json::Value {
    json!({
        "name": robot.name(),
        "vendor": robot.vendor(),
        "model": robot.model(),
        "kind": robot.kind().word(),
        "source": robot.source(),
        "checked": robot.checked(),
    })
}

/// The robots as text, by vendor.
fn table(robots: &[&Listed]) -> String {
    let width = robots.iter().map(|robot| robot.name().len()).max().unwrap_or(0);
    let models = robots.iter().map(|robot| robot.model().chars().count()).max().unwrap_or(0);
    let mut text = String::new();
    let mut vendor = "";
    for robot in robots {
        if robot.vendor() != vendor {
            vendor = robot.vendor();
            text += &format!("{}{vendor}\n", if text.is_empty() { "" } else { "\n" });
        }
        let checked = robot.checked().map_or("unchecked", |_| "checked");
        text +=
            &format!("  {:width$}  {:models$}  {:5}  {checked}\n", robot.name(), robot.model(), robot.kind().word());
    }
    let checked = robots.iter().filter(|robot| robot.checked().is_some()).count();
    text + &format!("\n{} robots, {checked} of them checked against an independent description\n", robots.len())
}
