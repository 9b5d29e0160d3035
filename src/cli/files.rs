//! Where a derivation's files go, and which they are.

use std::fs;
use std::path::{Path, PathBuf};

use crate::codegen::{self, c99::Pair};
use crate::derive::input::INPUT_NAMES;
use crate::derive::{Proved, Source, stages};
use crate::document::{TEXT_LIMIT, read_text};
use crate::solver::Program;
use crate::witness::Report;
use crate::{Error, ErrorKind, Result};

/// The longest file for IKFast that a folder gets, in bytes: the others are the same solver.
const IKFAST_LIMIT: usize = 90_000;
/// The same for one that solves an eigenvalue problem.
const SIX_AXES_LIMIT: usize = 135_000;

/// The header of the C file, which includes it.
const HEADER: &str = "5_solver.h";
/// The file of the numeric checks.
pub const CHECKS: &str = "6_check.csv";
/// The file of the proof.
pub const CERTIFICATE: &str = "certificate.json";

/// Whether this is a folder with a stored certificate.
pub fn is_derived(folder: &Path) -> bool {
    folder.join(CERTIFICATE).is_file()
}

/// The folder for the files of a derivation of `source`, which was asked for as `input`: `out` if it is given, the input's own folder
/// if it is a mechanism's, else the folder `foo` beside `foo.toml`.
///
/// # Errors
/// [`ErrorKind::BadValue`] when a file without extension leaves no name for a folder, or the folder has an input of the other kind, or
/// another one of this kind that nothing has been derived from.
pub fn destination(source: &Source, input: &Path, out: Option<&Path>) -> Result<PathBuf> {
    let file = &source.path;
    let named = file.file_name().is_some_and(|name| INPUT_NAMES.iter().any(|known| name == *known));
    let folder = match out {
        Some(out) => out.to_owned(),
        None if input.is_dir() || named => file.parent().unwrap_or(Path::new("")).to_owned(),
        None if file.extension().is_some() => file.with_extension(""),
        None => {
            let text = "the files would go to a folder of this very name; give another one by --out";
            return Err(Error::new(ErrorKind::BadValue, text).in_file(file));
        }
    };
    let other = INPUT_NAMES.iter().find(|name| **name != source.name && folder.join(name).exists());
    let refusal = match other {
        Some(other) => format!("this folder has a `{other}`, and would get a `{}`", source.name),
        None if holds_another(&folder, source) => {
            format!("this folder has another `{}`, which nothing has been derived from", source.name)
        }
        None => return Ok(folder),
    };
    Err(Error::new(ErrorKind::BadValue, format!("{refusal}; give another one by --out")).in_file(&folder))
}

/// Whether `folder` has a description that differs from `source`, and nothing derived from it: somebody wrote it there.
fn holds_another(folder: &Path, source: &Source) -> bool {
    let own = folder.join(source.name);
    let is_copy = || fs::read(&own).is_ok_and(|bytes| bytes == source.text.as_bytes());
    own.exists() && !is_derived(folder) && !is_same_file(&source.path, &own) && !is_copy()
}

/// Every file of a derivation with its name: the stages, the printed solvers, the numeric checks, and the input itself with the files
/// that it refers to when `folder` does not hold them yet.
///
/// # Errors
/// As [`Proved::stage_files`] and [`read_text`].
pub fn assemble_files(
    source: &Source,
    derivation: &Proved,
    checked: &Report,
    folder: &Path,
) -> Result<Vec<(String, Vec<u8>)>> {
    let mut files = Vec::new();
    if !is_same_file(&source.path, &folder.join(source.name)) {
        files.push((source.name.to_owned(), source.text.clone().into_bytes()));
    }
    for name in source.beside() {
        let path = source.path.with_file_name(name);
        if !is_same_file(&path, &folder.join(name)) {
            files.push((name.to_owned(), read_text(&path, TEXT_LIMIT)?.into_bytes()));
        }
    }
    files.extend(source.task_file());
    files.extend(derivation.stage_files()?.into_iter().filter(|(name, _)| is_ours(folder, name)));
    if let (Proved::Chain(_) | Proved::SixAxes(_) | Proved::Limbs(_), Some((_, page))) =
        (derivation, files.iter_mut().find(|(name, _)| name == stages::PAGE))
    {
        page.extend(accuracy(checked).into_bytes());
        if let Proved::Limbs(_) = derivation {
            page.extend(format!("\nWitnesses: {}.\n", checked.summary()).into_bytes());
        }
    }
    files.extend(printed_solvers(derivation.program()));
    files.push((CHECKS.to_owned(), checked.to_csv().into_bytes()));
    files.sort_by(|a, b| a.0.cmp(&b.0));
    Ok(files)
}

/// What the page of a chain or of limbs says about measured accuracy, behind what follows from the proof.
fn accuracy(checked: &Report) -> String {
    format!(
        "\n## Accuracy, measured\n\nResiduals by forward kinematics (shares of the reach, radians), and how far the joints that made the \
         target are from the nearest answer:\nat random targets, at and near singular ones, and at the border of the workspace. Next to a \
         singular configuration joints are known\nless well than the pose.\n\n{}",
        checked.accuracy()
    )
}

/// Whether a stage file may be written and compared: a page that a person wrote in the place of ours is left alone.
pub fn is_ours(folder: &Path, name: &str) -> bool {
    let by_hand = |text: String| !text.contains(stages::MARK);
    name != stages::PAGE || !fs::read_to_string(folder.join(name)).is_ok_and(by_hand)
}

/// The program as source code, one file a language but C's two; IKFast's only where it has a type for the task and the file is not too long.
pub fn printed_solvers(program: &Program) -> Vec<(String, Vec<u8>)> {
    let ikfast = codegen::ikfast::emit(program, &codegen::ikfast::Options::default());
    let ikfast = ikfast
        .ok()
        .filter(|text| text.len() <= if codegen::has_six_axes(program) { SIX_AXES_LIMIT } else { IKFAST_LIMIT })
        .map(|text| ("5_ikfast.cpp".to_owned(), text.into_bytes()));
    let Pair { header, source } = Pair::new(program, HEADER);
    let own = [
        ("5_solver.c".to_owned(), source.into_bytes()),
        (HEADER.to_owned(), header.into_bytes()),
        ("5_solver.rs".to_owned(), codegen::rust::emit(program).into_bytes()),
    ];
    ikfast.into_iter().chain(own).collect()
}

fn is_same_file(a: &Path, b: &Path) -> bool {
    matches!((fs::canonicalize(a), fs::canonicalize(b)), (Ok(a), Ok(b)) if a == b)
}
