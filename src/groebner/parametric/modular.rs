//! The basis with the parameters as variables of the lowest block, by F4 modulo primes.
//!
//! One prime teaches the computation, others repeat it in lanes (C. Traverso, "Groebner trace algorithms", ISSAC 1988). Only the
//! elements that count over the rational functions are rebuilt: those whose leading monomial in the unknowns is minimal. Each
//! coefficient is rebuilt from as few primes as it takes and agrees with the first prime, from which it was not made.

use super::assemble::{Element, assemble};
use super::flat::{equations, flat_ring};
use super::lift::{Primes, Residues, image};
use super::pilot::Pilot;
use super::prime::Prime;
use super::{Ideal, fresh, is_free};
use crate::groebner::Basis;
use crate::groebner::f4::Trace;
use crate::number::{BigRational, Rationals, Zp};
use crate::poly::{Fractions, Polynomial, PolynomialRing, Term};
use crate::{Error, ErrorKind, Result, Watch};

/// How many primes are tried at once.
const LANES: usize = 4;
/// How many primes may teach the computation before the search is given up.
const TEACHERS: usize = 4;

pub(super) type Equations = Vec<Vec<Term<BigRational>>>;

/// The reduced basis over the rational functions.
///
/// # Errors
/// Those of F4; [`ErrorKind::Unsupported`] when too many primes are unlucky; what `pilot` stops with.
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
    Err(Error::new(ErrorKind::Unsupported, "the computations modulo too many primes differ; take another way"))
}

/// The equations modulo a prime; `None` when it divides a coefficient.
pub(super) fn image_of(flat: &PolynomialRing<Zp>, equations: &Equations, field: Prime) -> Option<Vec<Polynomial<u64>>> {
    let term = |term: &Term<BigRational>| {
        let coefficient = image(field, &term.coefficient);
        (coefficient != 0).then(|| Term { coefficient, monomial: term.monomial.clone() })
    };
    let image = |terms: &Vec<Term<BigRational>>| Some(flat.descending(terms.iter().map(term).collect::<Option<_>>()?));
    equations.iter().map(image).collect()
}

/// Of elements with leading monomials of these exponents, smallest first: those without any of the `unknowns` first variables, which relations
/// of the parameters reduce to zero or which make the ideal the whole ring, and of the others those whose leading monomial in the
/// unknowns no smaller one divides.
pub(super) fn minimal(unknowns: usize, leads: &[Vec<u32>]) -> Vec<usize> {
    let mut chosen: Vec<usize> = Vec::with_capacity(leads.len());
    for (index, lead) in leads.iter().enumerate() {
        let part = |index: usize| &leads[index][..unknowns];
        let is_constant = |index: usize| part(index).iter().all(|&e| e == 0);
        let divides = |&other: &usize| !is_constant(other) && part(other).iter().zip(lead).all(|(a, b)| a <= b);
        if is_constant(index) || !chosen.iter().any(divides) {
            chosen.push(index);
        }
    }
    chosen
}

fn coefficients(chosen: &[usize], basis: &[Polynomial<u64>]) -> Vec<u64> {
    chosen.iter().flat_map(|&index| basis[index].terms().iter().map(|term| term.coefficient)).collect()
}

/// The coefficients of the chosen elements over Q, which must be `seen` modulo the prime that taught; `None` when most primes
/// go another way.
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

/// Whether the prime divides no numerator and no denominator of a coefficient.
pub(super) fn admit(equations: &Equations, field: Prime) -> bool {
    equations.iter().flatten().all(|term| image(field, &term.coefficient) != 0)
}
