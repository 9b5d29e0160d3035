//! What a solver was derived from, as text that travels with it. Main type: [`Origin`].

use std::collections::BTreeMap;
use std::path::Path;

use groebot::derive::{Derivation, Ends, Recount, Source};
use groebot::document::read_text;
use groebot::folder::prove_text;
use groebot::limits::DESCRIPTION_BYTES;
use groebot::{Error, ErrorKind, Result, Watch, witness};

/// The name of the stored proof in a derivation's folder.
pub const CERTIFICATE: &str = "certificate.json";

/// The files of a mechanism's folder from which a solver is derived: the description, and what is asked of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Origin {
    /// Name and text.
    pub files: BTreeMap<String, String>,
}

impl Origin {
    /// One file alone.
    pub fn of(name: &str, text: &str) -> Self {
        Origin { files: BTreeMap::from([(name.to_owned(), text.to_owned())]) }
    }

    /// That of a source that was read, for what is asked of it by now.
    ///
    /// # Errors
    /// [`ErrorKind::Io`] for a file beside it that cannot be read any more.
    pub fn of_source(source: &Source) -> Result<Self> {
        let mut origin = Origin::of(source.name, &source.text);
        if let Some((name, text)) = source.task_file() {
            origin.files.insert(name, String::from_utf8_lossy(&text).into_owned());
        }
        let folder = source.path.parent().unwrap_or(Path::new(""));
        for name in source.beside() {
            let path = folder.join(name);
            origin.files.insert(name.to_owned(), read_text(&path, DESCRIPTION_BYTES)?);
        }
        Ok(origin)
    }

    /// The source, read again.
    ///
    /// # Errors
    /// As [`Source::read`], without the name of the passing folder in which it is read.
    pub fn source(&self) -> Result<Source> {
        self.source_between(&Ends::default())
    }

    /// The same for what else is asked of it.
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

/// The same error without its file, whose name means nothing to a caller.
pub fn elsewhere(error: &Error) -> Error {
    let told = Error::new(error.kind(), error.message());
    error.place().line.map_or(told.clone(), |line| told.at_line(line))
}

/// What a check of a solver found.
pub struct Checked {
    /// Targets that were solved again.
    pub targets: usize,
    /// What is lost at singular targets.
    pub weak_spots: Vec<String>,
    /// One line a target.
    pub table: String,
}

/// Proves a derivation again from its certificate as `groebot check` does, without the engine, and solves targets of all kinds against the witnesses.
///
/// # Errors
/// [`ErrorKind::Certificate`] for a proof that does not hold or claims less than the derivation of its input, and an answer that is wrong or missing at an ordinary target.
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
