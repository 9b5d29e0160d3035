//! The files of a derivation, in one list for the writer and the check. Main function: [`derived`].

use super::names::{CHECKS, IKFAST, IKFAST_END, SOLVER};
use crate::Result;
use crate::codegen::{self, c99::Pair};
use crate::derive::report::stages;
use crate::derive::{Derivation, Method, Source};
use crate::solver::Program;
use crate::witness::Report;
use groebot_robot::document::word;

/// A file that is written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written {
    /// Its name.
    pub name: String,
    /// Its content.
    pub bytes: Vec<u8>,
    /// The number of bytes that follow from the proof and are the same everywhere; what comes after them was measured, and rounding decides
    /// its last digits.
    pub proved: usize,
}

impl Written {
    /// A file of which everything follows from the proof.
    fn proved((name, bytes): (String, Vec<u8>)) -> Self {
        Written { name, proved: bytes.len(), bytes }
    }
}

/// Every file that a derivation writes beside its input, by name: the stages with the certificate, the page, the printed solvers, the numeric checks.
///
/// # Errors
/// As [`Derivation::stage_files`].
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

/// What the page tells of the numeric checks.
fn measured(derivation: &Derivation, checked: &Report) -> String {
    match derivation.method() {
        Method::Equations(_) => String::new(),
        Method::Sequential(_) | Method::Eigenvalue(_) => accuracy(checked) + &weak_spots(checked),
        Method::Coupled(_) => {
            accuracy(checked) + &weak_spots(checked) + &format!("\nWitnesses: {}.\n", checked.summary())
        }
    }
}

/// What the page of a chain or of coupled chains says about measured accuracy, behind what follows from the proof.
fn accuracy(checked: &Report) -> String {
    format!(
        "\n## Accuracy, measured\n\nResiduals by forward kinematics (shares of the reach, radians), and how far the joints that made the \
         target are from the nearest answer:\nat random targets, at and near singular ones, and at the border of the workspace. Next to a \
         singular configuration joints are known\nless well than the pose.\n\n{}",
        checked.accuracy()
    )
}

/// What the page says about targets at which answers are wrong or missing; nothing where there are none.
fn weak_spots(checked: &Report) -> String {
    let rows: String = checked.weak_spots().map(|row| format!("* row {}, {}\n", row.number, row.weakness())).collect();
    if rows.is_empty() {
        return rows;
    }
    format!(
        "\n## Weak spots\n\nAt these targets of `6_check.csv`, singular or next to such, the answers are not all right:\n\n{rows}"
    )
}

/// The program as source code, one file a language but C's two, named as `source` asks; IKFast's only where it has a type for the task.
pub fn printed_solvers(program: &Program, source: &Source) -> Vec<(String, Vec<u8>)> {
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
