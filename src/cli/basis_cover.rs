//! `groebot basis --cover`: a basis for every value of the parameters, as text and as JSON.

use serde_json::{Value, json};

use super::json::FORMAT;
use crate::{Error, ErrorKind, Result, Watch};
use groebot_algebra::groebner::cover::{Checked, Cover, Element, Kind, Space, Stratum, check, cover};
use groebot_algebra::number::{Field, Rationals, Ring, Style, Zp};
use groebot_algebra::poly::system::{Heading, PolynomialSystem};
use groebot_algebra::poly::{Fractions, Polynomial};

/// The strata of the parameter space with a basis each, proved.
pub struct Covered {
    /// The strata as text.
    pub text: String,
    /// A line of summary.
    pub summary: String,
    /// The strata as JSON.
    pub json: Value,
}

/// Computes the strata of the parameter space with a basis each, and proves them.
///
/// # Errors
/// [`ErrorKind::BadValue`] without parameters, or for a coefficient with a denominator; those of [`cover`]; the error
/// of `watch`.
pub fn compute(system: &PolynomialSystem, heading: &Heading, watch: &Watch) -> Result<Covered> {
    if heading.parameters.is_empty() {
        let text = "a cover needs parameters, and there are none; name some in the heading";
        return Err(Error::new(ErrorKind::BadValue, text).with_context("--cover"));
    }
    match heading.characteristic {
        0 => {
            let (found, proof) = proved(Rationals, system, heading, watch)?;
            let json = json(&found, &proof, heading);
            Ok(Covered { text: found.with_real_points(watch)?.to_string(), summary: summary(&proof, heading), json })
        }
        p => {
            let (found, proof) = proved(Zp::new(p)?, system, heading, watch)?;
            let json = json(&found, &proof, heading);
            Ok(Covered { text: found.to_string(), summary: summary(&proof, heading), json })
        }
    }
}

fn proved<F: Field>(
    field: F,
    system: &PolynomialSystem,
    heading: &Heading,
    watch: &Watch,
) -> Result<(Cover<F>, Checked)> {
    let ring = heading.ring(Fractions::new(field, &heading.parameters)?)?;
    let generators = system.expand(&ring, watch)?;
    let found = cover(&ring, &generators, &Space::all(), watch)?;
    let proof = check(&found, &generators, watch)?;
    Ok((found, proof))
}

fn summary(proof: &Checked, heading: &Heading) -> String {
    format!(
        "{} strata, {}; proved: they are disjoint and leave nothing out, {} S-polynomials reduce to zero",
        proof.strata, heading.order, proof.s_polynomials
    )
}

fn json<F: Field>(found: &Cover<F>, proof: &Checked, heading: &Heading) -> Value {
    json!({
        "format": FORMAT,
        "characteristic": heading.characteristic,
        "parameters": heading.parameters,
        "variables": heading.variables,
        "order": heading.order.to_string(),
        "strata": found.strata.iter().map(|own| stratum(found, own)).collect::<Vec<_>>(),
        "s_polynomials": proof.s_polynomials,
    })
}

/// A stratum: its equations, its exclusions, the number of solutions, its basis.
fn stratum<F: Field>(found: &Cover<F>, stratum: &Stratum<F>) -> Value {
    let ground = found.ring.field().ring();
    let texts = |list: &[Polynomial<F::Element>]| -> Vec<String> {
        list.iter().map(|f| ground.format(f, Style::Text)).collect()
    };
    let element = |element: &Element<F>| -> Vec<String> {
        element.representatives.iter().map(|f| found.ring.format(f, Style::Text)).collect()
    };
    let (solutions, dimension) = match stratum.kind {
        Kind::Inconsistent => (Some(0), None),
        Kind::Finite(count) => (Some(count), Some(0)),
        Kind::Family(dimension) => (None, Some(dimension)),
    };
    json!({
        "equations": texts(&stratum.region.equations),
        "exclusions": stratum.region.exclusions.iter().map(|list| texts(list)).collect::<Vec<_>>(),
        "solutions": solutions,
        "dimension": dimension,
        "basis": stratum.basis.iter().map(element).collect::<Vec<_>>(),
    })
}
