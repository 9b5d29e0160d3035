//! The input from which a solver was derived, as text that is stored with it. Main type: [`Origin`].

use std::collections::BTreeMap;
use std::path::Path;

use groebot::derive::{Derivation, Ends, Recount, Source};
use groebot::document::read_text;
use groebot::folder::prove_text;
use groebot::limits::DESCRIPTION_BYTES;
use groebot::{Error, ErrorKind, Result, Watch, witness};

/// The name of the stored proof in a derivation's folder.
pub const CERTIFICATE: &str = "certificate.json";

/// The files of a mechanism's folder from which a solver is derived: the description and the task.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Origin {
    /// Name and text.
    pub files: BTreeMap<String, String>,
}

impl Origin {
    /// An origin of one file.
    pub fn of(name: &str, text: &str) -> Self {
        Origin { files: BTreeMap::from([(name.to_owned(), text.to_owned())]) }
    }

    /// The origin of a source with its current task.
    ///
    /// # Errors
    /// [`ErrorKind::Io`] for a file of the folder that can no longer be read.
    pub fn of_source(source: &Source) -> Result<Self> {
        let mut origin = Origin::of(source.name, &source.text);
        if let Some((name, text)) = source.task_file() {
            origin.files.insert(name, String::from_utf8_lossy(&text).into_owned());
        }
        let folder = source.path.parent().unwrap_or(Path::new(""));
        for name in source.referenced_files() {
            let path = folder.join(name);
            origin.files.insert(name.to_owned(), read_text(&path, DESCRIPTION_BYTES)?);
        }
        Ok(origin)
    }

    /// The source, read again.
    ///
    /// # Errors
    /// As [`Source::read`], without the name of the temporary folder from which it is read.
    pub fn source(&self) -> Result<Source> {
        self.source_between(&Ends::default())
    }

    /// The source, read again with another task.
    ///
    /// # Errors
    /// As [`Source::read_between`].
    pub fn source_between(&self, ends: &Ends) -> Result<Source> {
        let folder = tempfile::tempdir().map_err(|error| Error::io(&std::env::temp_dir(), &error))?;
        for (name, text) in &self.files {
            if name.is_empty() || !name.chars().all(|c| c.is_ascii_alphanumeric() || "._-".contains(c)) {
                return Err(Error::new(ErrorKind::BadValue, format!("`{name}` is no name of a file of a derivation")));
            }
            let path = folder.path().join(name);
            std::fs::write(&path, text).map_err(|error| Error::io(&path, &error))?;
        }
        Source::read_between(folder.path(), ends).map_err(|error| elsewhere(&error))
    }
}

/// The error without its file, which is temporary and unknown to the caller.
pub fn elsewhere(error: &Error) -> Error {
    let moved = Error::new(error.kind(), error.message());
    error.place().line.map_or(moved.clone(), |line| moved.at_line(line))
}

/// Result of the check of a solver.
pub struct Checked {
    /// Number of targets that were solved.
    pub targets: usize,
    /// Solutions that are lost at singular targets.
    pub weak_spots: Vec<String>,
    /// One line for each target.
    pub table: String,
}

/// Proves a derivation again from its certificate, without the Groebner engine, as `groebot check` does. Then compares the solutions of all kinds of targets
/// with those of independent solvers.
///
/// # Errors
/// [`ErrorKind::Certificate`] for a proof that fails, for a proof that claims less than the derivation of its input, and for a wrong or missing solution at an
/// ordinary target.
pub fn check(source: &Source, proved: &Derivation, watch: &Watch) -> Result<Checked> {
    let again = prove_text(source, &proved.certificate()?, &mut Recount::new(watch))?;
    if again.program() != proved.program() {
        return Err(Error::new(ErrorKind::Certificate, "the solver is not the one that its certificate proves"));
    }
    let report = witness::check(source, proved, watch)?;
    if let Some(row) = report.failures().find(|row| !row.is_weak_spot()) {
        let faults: Vec<_> = row.verdict.faults().iter().map(|fault| fault.sentence()).collect();
        let text =
            format!("at an ordinary target an answer is wrong or missing: {}; row {}", faults.join("; "), row.number);
        return Err(Error::new(ErrorKind::Certificate, text));
    }
    let weak_spots = report.weak_spots().map(|row| format!("row {} ({}): {}", row.number, row.kind, row.weakness()));
    Ok(Checked { targets: report.rows.len(), weak_spots: weak_spots.collect(), table: report.to_csv() })
}
