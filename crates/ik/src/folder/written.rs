//! The files of a derivation, in one list for the writer and the check. Main function: [`derived`].

use super::names::{CHECKS, IKFAST, IKFAST_END, SOLVER};
use crate::Result;
use crate::codegen::{self, c99::Pair};
use crate::derive::report::stages;
use crate::derive::{Derivation, Method, Source};
use crate::solver::Program;
use crate::witness::Report;
use groebot_robot::document::word;

/// A file with its content.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written {
    /// Its name.
    pub name: String,
    /// Its content.
    pub bytes: Vec<u8>,
    /// Number of bytes that follow from the proof and are equal on all machines. The bytes after them are measurements, whose last digits depend on rounding.
    pub proved: usize,
}

impl Written {
    /// A file whose whole content follows from the proof.
    fn proved((name, bytes): (String, Vec<u8>)) -> Self {
        Written { name, proved: bytes.len(), bytes }
    }
}

/// Every file that a derivation writes in addition to its input, by name: the stages with the certificate, the page, the printed solvers, and the numeric
/// checks.
///
/// # Errors
/// Same as [`Derivation::stage_files`].
pub fn derived(source: &Source, derivation: &Derivation, checked: &Report) -> Result<Vec<Written>> {
    let mut files: Vec<Written> = derivation.stage_files()?.into_iter().map(Written::proved).collect();
    if let Some(page) = files.iter_mut().find(|file| file.name == stages::PAGE) {
        page.bytes.extend(measured(derivation, checked).into_bytes());
    }
    files.extend(printed_solvers(derivation.program(), source).into_iter().map(Written::proved));
    files.push(Written { name: CHECKS.to_owned(), bytes: checked.to_csv().into_bytes(), proved: 0 });
    files.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(files)
}

/// The part of the page with the numeric checks.
fn measured(derivation: &Derivation, checked: &Report) -> String {
    match derivation.method() {
        Method::Equations(_) => String::new(),
        Method::Sequential(_) | Method::Eigenvalue(_) => accuracy(checked) + &weak_spots(checked),
        Method::Coupled(_) => {
            accuracy(checked) + &weak_spots(checked) + &format!("\nWitnesses: {}.\n", checked.summary())
        }
    }
}

/// The part of the page of a chain or of coupled chains with the measured accuracy. It comes after the proved part.
fn accuracy(checked: &Report) -> String {
    format!(
        "\n## Accuracy, measured\n\nResiduals by forward kinematics (shares of the reach, radians), and how far the joints that made the \
         target are from the nearest answer:\nat random targets, at and near singular ones, and at the border of the workspace. Next to a \
         singular configuration joints are known\nless well than the pose.\n\n{}",
        checked.accuracy()
    )
}

/// The part of the page with targets at which solutions are wrong or missing. Empty if there are none.
fn weak_spots(checked: &Report) -> String {
    let rows: String = checked.weak_spots().map(|row| format!("* row {}, {}\n", row.number, row.weakness())).collect();
    if rows.is_empty() {
        return rows;
    }
    format!(
        "\n## Weak spots\n\nAt these targets of `6_check.csv`, at or near singular poses, solutions are missing or wrong:\n\n{rows}"
    )
}

/// The program as source code: one file per language, and two for C. The names are those that `source` specifies. IKFast's file is omitted if IKFast has no
/// type for the task.
pub(crate) fn printed_solvers(program: &Program, source: &Source) -> Vec<(String, Vec<u8>)> {
    let named = source.ends.name.as_deref().map(word);
    let [solver, ikfast] = named.map_or([SOLVER.into(), IKFAST.into()], |stem| [stem.clone(), stem + IKFAST_END]);
    let Pair { header, source: code } = Pair::new(program, &solver);
    let own = [
        (format!("{solver}.c"), code.into_bytes()),
        (format!("{solver}.h"), header.into_bytes()),
        (format!("{solver}.rs"), codegen::rust::emit(program).into_bytes()),
    ];
    let for_ikfast = codegen::ikfast::emit_beside(program, &codegen::ikfast::Options::default(), &solver);
    let for_ikfast = for_ikfast.ok().map(|text| (format!("{ikfast}.cpp"), text.into_bytes()));
    for_ikfast.into_iter().chain(own).collect()
}
