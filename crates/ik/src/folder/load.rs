//! The solver of a folder that `groebot derive` wrote. Main function: [`program`].

use std::path::Path;

use super::names::{CERTIFICATE, PROGRAM};
use crate::derive::problem::input::hidden_robot;
use crate::derive::{Derivation, Source};
use crate::solver::Program;
use crate::{Error, ErrorKind, Result};
use groebot_algebra::limits;
use groebot_robot::document::read_text;

/// The solver in `folder`: its `5_program.json`, or in a thin folder without that file, the solver that its certificate proves.
///
/// # Errors
/// [`ErrorKind::Io`] for a folder with neither of the two files. Otherwise those of [`Program::from_json`] and [`reprove`], with the name of the file.
pub fn program(folder: &Path) -> Result<Program> {
    let file = folder.join(PROGRAM);
    if file.exists() {
        let text = read_text(&file, limits::PROGRAM_BYTES)?;
        return Program::from_json(&text).map_err(|error| error.in_file(&file));
    }
    if !folder.join(CERTIFICATE).exists() {
        let hidden = hidden_robot(folder);
        let text =
            format!("this folder has no `{PROGRAM}` and no `{CERTIFICATE}`; `groebot derive` writes them{hidden}");
        return Err(Error::new(ErrorKind::Io, text).in_file(folder));
    }
    Ok(reprove(folder, &Source::read(folder)?)?.program().clone())
}

/// The derivation of `source` that the certificate in `folder` proves.
///
/// # Errors
/// Same as [`Derivation::prove_source`], and [`ErrorKind::Io`] if the certificate cannot be read.
pub fn reprove(folder: &Path, source: &Source) -> Result<Derivation> {
    let path = folder.join(CERTIFICATE);
    let text = read_text(&path, limits::STAGE_BYTES)?;
    let derivation = Derivation::prove_source(source, &text).map_err(|error| error.in_file(&path))?;
    Ok(derivation.about(source))
}
