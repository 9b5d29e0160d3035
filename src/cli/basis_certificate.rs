//! The proof of a basis as JSON: generators, basis and cofactors as text.

use serde::Serialize;

use super::basis_question::Question;
use crate::{Error, ErrorKind, Result, Watch};
use groebot_algebra::groebner::Basis;
use groebot_algebra::groebner::verify::{Claim, verify};
use groebot_algebra::number::{Field, Ring, Style};
use groebot_algebra::poly::{Polynomial, PolynomialRing};

/// The version of the file format; version 1 had a text instead of a number.
const FORMAT: u32 = 2;

/// `basis` is the reduced Groebner basis of the ideal of `generators`, and `basis[i]` is the sum over j of
/// `cofactors[i][j] * generators[j]`. docs/basis_files.md describes it.
#[derive(Serialize)]
struct Certificate<'a> {
    format: u32,
    proves: &'static str,
    characteristic: u64,
    parameters: &'a [String],
    variables: &'a [String],
    order: String,
    eliminated: &'a [String],
    generators: Vec<String>,
    basis: Vec<String>,
    cofactors: Vec<Vec<String>>,
}

/// Proves `found` without the engine, then prints the proof.
///
/// # Errors
/// [`ErrorKind::Certificate`] when it is not a basis of `generators`; [`ErrorKind::Overflow`]; the error of `watch`.
pub fn prove<F: Field>(
    question: &Question,
    ring: &PolynomialRing<F>,
    generators: &[Polynomial<F::Element>],
    found: &Basis<F>,
    watch: &Watch,
) -> Result<String> {
    let generators: Vec<_> = generators.iter().map(|f| ring.transfer(f, &found.ring)).collect::<Result<_>>()?;
    let claim = Claim { generators: &generators, basis: &found.polynomials, cofactors: &found.cofactors };
    verify(&found.ring, &claim, watch)?;
    let texts = |list: &[Polynomial<F::Element>]| list.iter().map(|f| found.ring.format(f, Style::Text)).collect();
    let heading = &question.working;
    let certificate = Certificate {
        format: FORMAT,
        proves: "basis",
        characteristic: heading.characteristic,
        parameters: &heading.parameters,
        variables: &heading.variables,
        order: heading.order.to_string(),
        eliminated: &question.eliminated,
        generators: texts(&generators),
        basis: texts(&found.polynomials),
        cofactors: found.cofactors.iter().map(|row| texts(row)).collect(),
    };
    let json = serde_json::to_string_pretty(&certificate);
    let json =
        json.map_err(|error| Error::new(ErrorKind::Certificate, format!("the proof cannot be written: {error}")))?;
    Ok(json + "\n")
}
