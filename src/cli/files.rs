//! The files of a derivation and their folder.

use std::collections::BTreeSet;
use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};

use super::output::{Force, is_same_file};
use crate::{Error, ErrorKind, Result, Watch};
use groebot_ik::codegen;
use groebot_ik::derive::problem::ends::TASK_NAME;
use groebot_ik::derive::problem::input::{INPUT_NAMES, robot_name};
use groebot_ik::derive::report::stages;
use groebot_ik::derive::{Derivation, Ends, Source};
use groebot_ik::folder::{CERTIFICATE, CHECKS, DYNAMICS, OUTPUTS, Written, derived, thin};
use groebot_ik::solver::Program;
use groebot_ik::witness::Report;
use groebot_robot::document::{TEXT_LIMIT, is_stdin, read_text};
use groebot_robot::files::{StagedFolder, refuse_foreign, refuse_unfinished};

/// The number of bytes at the start of a certificate that identify it.
const HEAD: usize = 200;

/// Whether a file is JSON, by its name.
pub fn is_json(file: &Path) -> bool {
    file.extension().is_some_and(|end| end.eq_ignore_ascii_case("json"))
}

/// Whether this is a folder with a stored certificate.
pub fn is_derived(folder: &Path) -> bool {
    let mut head = [0; HEAD];
    // The first key identifies the file; formats without numbers had the other key.
    let is_ours = |text: &str| text.contains("\"proves\"") || text.contains("\"groebot\"");
    [CERTIFICATE, DYNAMICS].iter().any(|name| {
        let read = fs::File::open(folder.join(name)).and_then(|mut file| file.read(&mut head));
        read.is_ok_and(|count| is_ours(&String::from_utf8_lossy(&head[..count])))
    })
}

/// Files that one derivation has, and another one in the same folder does not.
const STALE: [&str; 6] = [TASK_NAME, OUTPUTS, "5_solver.c", "5_solver.h", "5_solver.rs", "5_ikfast.cpp"];

/// Extensions of generated solvers. A user's own code may have such a name, also in a folder of a derivation.
const CODE: [&str; 4] = ["c", "h", "rs", "cpp"];

/// Checks that no file of `files` replaces one that groebot did not write. In a folder that groebot derived into, the
/// files of a derivation are its own, but generated solvers and hashes only with their mark; elsewhere
/// [`refuse_foreign`] decides.
///
/// # Errors
/// [`ErrorKind::BadValue`] with the folder and the file's name.
fn refuse_overwriting(folder: &Path, files: &[(String, Vec<u8>)]) -> Result<()> {
    let is_derived = is_derived(folder);
    let is_code = |path: &Path| CODE.iter().any(|end| path.extension().is_some_and(|own| own == *end));
    let is_foreign = |(name, bytes): &&(String, Vec<u8>)| {
        let path = folder.join(name);
        let is_own = is_derived && !is_code(&path) && name != OUTPUTS || refuse_unfinished(&path).is_err();
        !is_own && refuse_foreign(&path, bytes).is_err()
    };
    let Some((name, _)) = files.iter().find(is_foreign) else { return Ok(()) };
    let text = format!(
        "this folder has a `{name}` that groebot did not write; give another folder by --out, move it away, or --force to replace it"
    );
    Err(Error::new(ErrorKind::BadValue, text).in_file(folder))
}

/// Replaces `files` in `folder` together, and removes those that `stale` lists. `stale` and the decision about
/// replacing are evaluated while no other process writes there.
///
/// # Errors
/// [`ErrorKind::BadValue`] for a foreign file without `force`; as `stale`, [`StagedFolder::stage`] and
/// [`StagedFolder::commit`].
pub fn write_set<'n>(
    folder: &Path,
    files: &[(String, Vec<u8>)],
    stale: impl FnOnce() -> Result<Vec<&'n str>>,
    force: Force,
    watch: &Watch,
) -> Result<()> {
    let staged = StagedFolder::stage(folder, files, watch)?;
    let stale = stale()?;
    if !force.force {
        refuse_overwriting(folder, files)?;
    }
    watch.check()?;
    stale.into_iter().try_fold(staged, StagedFolder::without)?.commit()
}

/// The files of a derivation's folder.
pub struct Files {
    /// The files to write, by name.
    pub written: Vec<(String, Vec<u8>)>,
    /// The names of files that only a full folder contains; empty for a full folder.
    pub left_out: Vec<String>,
}

impl Files {
    /// The names of the files to write.
    pub fn names(&self) -> Vec<&str> {
        self.written.iter().map(|(name, _)| name.as_str()).collect()
    }
}

/// Writes the files of a derivation of `source`, and removes those of an earlier derivation that are not in this one.
///
/// # Errors
/// As [`write_set`]; [`ErrorKind::BadValue`] where another process wrote an input of another kind meanwhile.
pub fn write_derivation(source: &Source, folder: &Path, files: &Files, force: Force, watch: &Watch) -> Result<()> {
    let Files { written: files, left_out } = files;
    let is_input = |name: &str| is_same_file(&source.path.with_file_name(name), &folder.join(name));
    let is_stale = |name: &&str| match *name {
        name if files.iter().any(|(new, _)| new == name) => false,
        TASK_NAME => !is_input(TASK_NAME) && !keeps_task(source, folder),
        CHECKS => true,
        name if stages::STAGES.contains(&name) => true,
        // Generated solvers and hashes, with their marks.
        name => refuse_foreign(&folder.join(name), &[]).is_ok(),
    };
    let stale = || {
        refuse_input(source, folder, files)?;
        refuse_other_input(source, folder)?;
        // A set, because a file can be removed only once.
        let known: BTreeSet<&str> = STALE.into_iter().chain(left_out.iter().map(String::as_str)).collect();
        Ok(known.into_iter().filter(|name| is_derived(folder) && is_stale(name)).collect())
    };
    write_set(folder, files, stale, force, watch)
}

/// Checks that no file of `files` replaces the description that they are derived from.
///
/// # Errors
/// [`ErrorKind::BadValue`] with the description.
pub fn refuse_input(source: &Source, folder: &Path, files: &[(String, Vec<u8>)]) -> Result<()> {
    if !files.iter().any(|(name, _)| is_same_file(&source.path, &folder.join(name))) {
        return Ok(());
    }
    let text = "this is the input, and has the name of an output file; give another folder by --out";
    Err(Error::new(ErrorKind::BadValue, text).in_file(&source.path))
}

/// The folder for the files of a derivation of `source`, which was given as `input`. It is `out` if given, the input's
/// own folder if it is a mechanism's, else the folder `foo` next to `foo.toml`.
///
/// # Errors
/// [`ErrorKind::BadValue`] for a file without extension, which determines no folder name. The same for a folder with an
/// input of the other kind, or with another input of this kind from which nothing has been derived.
pub fn destination(source: &Source, input: &Path, out: Option<&Path>) -> Result<PathBuf> {
    let file = &source.path;
    let named = file.file_name().is_some_and(|name| INPUT_NAMES.iter().any(|known| name == *known));
    let folder = match out {
        Some(out) => out.to_owned(),
        None if input.is_dir() || named => file.parent().unwrap_or(Path::new("")).to_owned(),
        None if file.extension().is_some() => without_end(file),
        None if robot_name(input).is_some() => input.to_owned(),
        None if is_stdin(file) => {
            let text = "standard input has no folder for the files; give one by --out";
            return Err(Error::new(ErrorKind::BadValue, text).in_file(file));
        }
        None => {
            let text = "the files would go to a folder of this very name; give another one by --out";
            return Err(Error::new(ErrorKind::BadValue, text).in_file(file));
        }
    };
    refuse_other_input(source, &folder)?;
    Ok(folder)
}

/// The path without the end of its name: `.toml`, `.urdf` or `.urdf.xacro`.
fn without_end(file: &Path) -> PathBuf {
    let short = file.with_extension("");
    let is_xacro = file.extension().is_some_and(|end| end.eq_ignore_ascii_case("xacro"));
    if is_xacro && short.extension().is_some_and(|end| end.eq_ignore_ascii_case("urdf")) {
        return short.with_extension("");
    }
    short
}

/// Fails if `folder` has an input other than `source`.
fn refuse_other_input(source: &Source, folder: &Path) -> Result<()> {
    let other = INPUT_NAMES.iter().find(|name| **name != source.name && folder.join(name).exists());
    let refusal = match other {
        Some(other) => format!("this folder has a `{other}`, and would get a `{}`", source.name),
        None if holds_another(folder, source) => {
            format!("this folder has another `{}`, which nothing has been derived from", source.name)
        }
        None => return Ok(()),
    };
    Err(Error::new(ErrorKind::BadValue, format!("{refusal}; give another one by --out")).in_file(folder))
}

/// Whether `folder` has a description that differs from `source`, and nothing derived from it: a user wrote it there.
fn holds_another(folder: &Path, source: &Source) -> bool {
    let own = folder.join(source.name);
    let is_copy = || fs::read(&own).is_ok_and(|bytes| bytes == source.text.as_bytes());
    own.exists() && !is_derived(folder) && !is_same_file(&source.path, &own) && !is_copy()
}

/// All files of a derivation with their names: those of [`derived`] or of [`thin`], and the input with the files that
/// it refers to if `folder` does not contain them yet.
///
/// # Errors
/// As [`derived`] and [`read_text`].
pub fn assemble_files(
    source: &Source,
    derivation: &Derivation,
    checked: &Report,
    folder: &Path,
    as_thin: bool,
) -> Result<Files> {
    let all = derived(source, derivation, checked)?;
    let mut left_out: Vec<String> = all.iter().map(|file| file.name.clone()).collect();
    let kept = if as_thin { thin(all) } else { all };
    left_out.retain(|name| kept.iter().all(|file| file.name != *name));
    let mut written = source_files(source, folder)?;
    let ours = kept.into_iter().filter(|file| is_ours(folder, &file.name));
    written.extend(ours.map(|Written { name, bytes, .. }| (name, bytes)));
    written.sort_by(|a, b| a.0.cmp(&b.0));
    Ok(Files { written, left_out })
}

/// The input with the files that it refers to and its task, as far as `folder` does not contain them yet.
///
/// # Errors
/// As [`read_text`].
pub fn source_files(source: &Source, folder: &Path) -> Result<Vec<(String, Vec<u8>)>> {
    let mut files = Vec::new();
    if !is_same_file(&source.path, &folder.join(source.name)) {
        files.push((source.name.to_owned(), source.text.clone().into_bytes()));
    }
    for name in source.referenced_files() {
        let path = source.path.with_file_name(name);
        if !is_same_file(&path, &folder.join(name)) {
            files.push((name.to_owned(), read_text(&path, TEXT_LIMIT)?.into_bytes()));
        }
    }
    files.extend(source.task_file().filter(|_| !keeps_task(source, folder)));
    Ok(files)
}

/// Whether a file of a derivation may be written: a page that a user wrote under the same name is kept.
fn is_ours(folder: &Path, name: &str) -> bool {
    let by_hand = |text: String| !text.contains(stages::MARK);
    name != stages::PAGE || !fs::read_to_string(folder.join(name)).is_ok_and(by_hand)
}

/// Whether `folder` has a task file with the same task in another form.
fn keeps_task(source: &Source, folder: &Path) -> bool {
    Ends::read(&folder.join(TASK_NAME)).is_ok_and(|ends| ends == source.ends)
}

/// The reason why there is no file for IKFast; `None` if there is one.
pub fn without_ikfast(program: &Program) -> Option<String> {
    let refusal = codegen::ikfast::emit_beside(program, &codegen::ikfast::Options::default(), "").err()?;
    Some(format!("no file for IKFast: {}", refusal.message()))
}
