//! `groebot basis --cover`: a basis for every value of the parameters, as text.

use crate::{Error, ErrorKind, Result, Watch};
use groebot_algebra::groebner::cover::{Cover, Space, check, cover};
use groebot_algebra::number::{Field, Rationals, Zp};
use groebot_algebra::poly::Fractions;
use groebot_algebra::poly::system::{Heading, PolynomialSystem};

/// The strata of the parameter space with a basis each, proved, and a line of summary.
///
/// # Errors
/// [`ErrorKind::BadValue`] without parameters, or for a coefficient with a denominator; those of [`cover`]; the error
/// of `watch`.
pub fn compute(system: &PolynomialSystem, heading: &Heading, watch: &Watch) -> Result<(String, String)> {
    if heading.parameters.is_empty() {
        let text = "a cover needs parameters, and there are none; name some in the heading";
        return Err(Error::new(ErrorKind::BadValue, text).with_context("--cover"));
    }
    match heading.characteristic {
        0 => {
            let (found, summary) = proved(Rationals, system, heading, watch)?;
            Ok((found.with_real_points(watch)?.to_string(), summary))
        }
        p => proved(Zp::new(p)?, system, heading, watch).map(|(found, summary)| (found.to_string(), summary)),
    }
}

fn proved<F: Field>(
    field: F,
    system: &PolynomialSystem,
    heading: &Heading,
    watch: &Watch,
) -> Result<(Cover<F>, String)> {
    let ring = heading.ring(Fractions::new(field, &heading.parameters)?)?;
    let generators = system.expand(&ring, watch)?;
    let found = cover(&ring, &generators, &Space::all(), watch)?;
    let proof = check(&found, &generators, watch)?;
    let summary = format!(
        "{} strata, {}; proved: they are disjoint and leave nothing out, {} S-polynomials reduce to zero",
        proof.strata, heading.order, proof.s_polynomials
    );
    Ok((found, summary))
}
