//! The basis with the parameters as variables of the lowest block, by F4 modulo primes.
//!
//! The computation is learned modulo one prime and replayed modulo others in lanes (C. Traverso, "Groebner trace
//! algorithms", ISSAC 1988). Only the elements that are needed over the rational functions are reconstructed: those
//! whose leading monomial in the unknowns is minimal. Each coefficient is reconstructed from as few primes as possible.
//! It must agree with the first prime, which is not used for it.

use super::assemble::{Element, assemble};
use super::flat::{Equations, admit, equations, flat_ring, image_of};
use super::lift::{Primes, Residues, image};
use super::pilot::{Pilot, minimal};
use super::prime::Prime;
use super::{Ideal, fresh, is_free};
use crate::groebner::Basis;
use crate::groebner::f4::Trace;
use crate::number::{BigRational, Rationals, Zp};
use crate::poly::{Fractions, Polynomial, Term};
use crate::{Error, ErrorKind, Result, Watch};

/// Number of primes of one replay.
const LANES: usize = 4;
/// Maximum number of primes for learning.
const TEACHERS: usize = 4;

/// Computes the reduced basis over the rational functions.
///
/// # Errors
/// Those of F4; [`ErrorKind::Unsupported`] when too many primes are unlucky; the error with which `pilot` stops the
/// work.
pub(super) fn rebuilt_basis(
    ideal: &Ideal<'_>,
    pilot: &mut Pilot<'_>,
    watch: &Watch,
) -> Result<Basis<Fractions<Rationals>>> {
    let mut primes = Primes::new();
    let rational = flat_ring(ideal.ring, Rationals)?;
    let equations = equations(ideal, &rational)?;
    for _ in 0..TEACHERS {
        let teacher = primes.next_that(|field| admit(&equations, field));
        let flat = rational.over(Zp::known_prime(teacher.p));
        let image = image_of(&flat, &equations, teacher).expect("a prime that divides no coefficient");
        let (basis, trace) = Trace::learn_guided(&flat, &image, pilot, watch)?;
        let leads = basis.polynomials.iter().map(|f| flat.layout().exponents(&f.terms()[0].monomial));
        let chosen = minimal(ideal.ring.variables().len(), &leads.collect::<Vec<_>>());
        let seen = coefficients(&chosen, &basis.polynomials);
        if let Some(values) = rebuild(&equations, &trace, &chosen, (teacher, &seen), &mut primes, watch)? {
            let elements = chosen.iter().map(|&index| &basis.polynomials[index]);
            let elements = elements.map(|f| Element::new(ideal.ring, &flat, f));
            let found = assemble(ideal.ring, elements, values, watch)?;
            let leads = found.polynomials.iter().map(|f| &f.terms()[0].monomial);
            let is_confirmed = if let Some(known) = pilot.leads() {
                known.eq(leads)
            } else if is_free(ideal) {
                fresh::has_leads(ideal, leads, &mut primes, watch)?
            } else {
                fresh::has_leads_with_variables(ideal, &equations, &basis.polynomials, &mut primes, watch)?
            };
            if is_confirmed {
                return Ok(found);
            }
        }
    }
    Err(Error::new(ErrorKind::Unsupported, "the computations modulo too many primes differ; use another method"))
}

fn coefficients(chosen: &[usize], basis: &[Polynomial<u64>]) -> Vec<u64> {
    chosen.iter().flat_map(|&index| basis[index].terms().iter().map(|term| term.coefficient)).collect()
}

/// The coefficients of the chosen elements over Q. They must be `seen` modulo the learned prime; `None` when most
/// primes differ.
fn rebuild(
    equations: &Equations,
    trace: &Trace,
    chosen: &[usize],
    (teacher, seen): (Prime, &[u64]),
    primes: &mut Primes,
    watch: &Watch,
) -> Result<Option<Vec<BigRational>>> {
    let mut residues = Residues::default();
    let mut unlucky = 0;
    while unlucky <= LANES + residues.count() {
        let (fields, generators) = lanes(equations, primes);
        let found = trace.replay(fields.map(|field| field.p as u32), &generators, watch)?;
        for (field, lane) in fields.into_iter().zip(found) {
            match lane {
                Some(basis) => {
                    let row: Vec<u64> =
                        chosen.iter().flat_map(|&index| basis[index].iter().map(|&c| u64::from(c))).collect();
                    residues.push(field, &row);
                }
                None => unlucky += 1,
            }
        }
        watch.report("rebuilding", residues.count(), 0);
        if residues.is_worth_a_trial()
            && let Some(values) = residues.rationals_like(teacher, seen)
        {
            return Ok(Some(values));
        }
    }
    Ok(None)
}

/// The next primes that divide no coefficient, and the equations modulo each.
fn lanes(equations: &Equations, primes: &mut Primes) -> ([Prime; LANES], Vec<Vec<[u32; LANES]>>) {
    let fields = std::array::from_fn(|_| primes.next_that(|field| admit(equations, field)));
    let value = |term: &Term<BigRational>| fields.map(|field: Prime| image(field, &term.coefficient) as u32);
    (fields, equations.iter().map(|terms| terms.iter().map(value).collect()).collect())
}
