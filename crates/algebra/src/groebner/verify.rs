//! An independent checker of Groebner bases: small, slow, and without code of the engines except ring arithmetic.
//!
//! [`verify`] proves over the given field that `<G> = <F>` and that `G` is a Groebner basis (NAO proposition 6.2.2).

use crate::number::{Field, Ring};
use crate::poly::{Monomial, Polynomial, PolynomialRing};
use crate::{Error, ErrorKind, Result, Watch};

/// The claim: `basis` is the reduced Groebner basis of the ideal of `generators`, and `basis[i] = sum over j of
/// cofactors[i][j] * generators[j]`.
#[derive(Clone, Copy, Debug)]
pub struct Claim<'a, E> {
    /// The generators F.
    pub generators: &'a [Polynomial<E>],
    /// The basis G.
    pub basis: &'a [Polynomial<E>],
    /// Cofactors: one row for each basis element, one column for each generator.
    pub cofactors: &'a [Vec<Polynomial<E>>],
}

/// Numbers of the statements that were proved.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Proof {
    /// Basis elements whose cofactors multiply out.
    pub cofactor_rows: usize,
    /// Generators that reduce to zero.
    pub generators: usize,
    /// S-pairs that reduce to zero.
    pub pairs: usize,
}

/// Proves `claim`: cofactors multiply out, generators reduce to zero, S-pairs reduce to zero, the basis is reduced.
///
/// # Errors
/// [`ErrorKind::Certificate`] with the first element, generator or pair for which the claim fails;
/// [`ErrorKind::Overflow`]; the error with which `watch` stops the work.
pub fn verify<'w, F: Field>(
    ring: &PolynomialRing<F>,
    claim: &Claim<'_, F::Element>,
    watch: impl Into<Option<&'w Watch>>,
) -> Result<Proof> {
    let watch = Watch::or_none(watch);
    check_forms(ring, claim)?;
    check_reduced(ring, claim.basis, watch)?;
    check_cofactors(ring, claim, watch)?;
    for (index, f) in claim.generators.iter().enumerate() {
        if !remainder(ring, f, claim.basis, watch)?.is_zero() {
            return Err(refuse(format!("generator {} does not reduce to zero by the basis", index + 1)));
        }
    }
    let pairs = check_pairs(ring, claim.basis, watch)?;
    Ok(Proof { cofactor_rows: claim.basis.len(), generators: claim.generators.len(), pairs })
}

fn refuse(text: String) -> Error {
    Error::new(ErrorKind::Certificate, text)
}

/// Checks that all are polynomials of `ring` and that no basis element is zero.
fn check_forms<F: Field>(ring: &PolynomialRing<F>, claim: &Claim<'_, F::Element>) -> Result<()> {
    let bad = |list: &[Polynomial<F::Element>]| list.iter().position(|f| !ring.is_well_formed(f));
    let rows =
        claim.cofactors.iter().enumerate().map(|(k, row)| (format!("cofactors of basis element {}:", k + 1), &row[..]));
    let lists = [("generators:".to_owned(), claim.generators), ("basis:".to_owned(), claim.basis)];
    for (name, list) in lists.into_iter().chain(rows) {
        if let Some(index) = bad(list) {
            return Err(refuse(format!("{name} element {} is not a polynomial of this ring", index + 1)));
        }
    }
    match claim.basis.iter().position(Polynomial::is_zero) {
        Some(index) => Err(refuse(format!("basis element {} is zero", index + 1))),
        None => Ok(()),
    }
}

/// Checks that the basis is monic and that no term is divisible by the leading monomial of another element.
fn check_reduced<F: Field>(ring: &PolynomialRing<F>, basis: &[Polynomial<F::Element>], watch: &Watch) -> Result<()> {
    for (index, g) in basis.iter().enumerate() {
        watch.check()?;
        if !g.leading().is_some_and(|term| ring.field().is_one(&term.coefficient)) {
            return Err(refuse(format!("basis element {} is not monic", index + 1)));
        }
        for (other, h) in basis.iter().enumerate().filter(|(other, _)| *other != index) {
            let lead = lead(h)?;
            if g.terms().iter().any(|term| ring.layout().divides(lead, &term.monomial)) {
                return Err(refuse(format!("basis element {} is not reduced by element {}", index + 1, other + 1)));
            }
        }
    }
    Ok(())
}

fn lead<E>(f: &Polynomial<E>) -> Result<&Monomial> {
    f.leading().map(|term| &term.monomial).ok_or_else(|| refuse("a basis element is zero".to_owned()))
}

fn check_cofactors<F: Field>(ring: &PolynomialRing<F>, claim: &Claim<'_, F::Element>, watch: &Watch) -> Result<()> {
    if claim.cofactors.len() != claim.basis.len() {
        let text = format!("{} rows of cofactors for {} basis elements", claim.cofactors.len(), claim.basis.len());
        return Err(refuse(text));
    }
    for (index, (g, row)) in claim.basis.iter().zip(claim.cofactors).enumerate() {
        if row.len() != claim.generators.len() {
            let text =
                format!("element {} has {} cofactors for {} generators", index + 1, row.len(), claim.generators.len());
            return Err(refuse(text));
        }
        watch.report("cofactors", index, claim.basis.len() - index);
        let mut sum = ring.zero();
        for (cofactor, f) in row.iter().zip(claim.generators) {
            watch.check()?;
            sum = ring.add(&sum, &ring.checked_mul(cofactor, f)?);
        }
        if sum != *g {
            return Err(refuse(format!(
                "the combination of the generators with the cofactors of basis element {} is not equal to it",
                index + 1
            )));
        }
    }
    Ok(())
}

fn check_pairs<F: Field>(ring: &PolynomialRing<F>, basis: &[Polynomial<F::Element>], watch: &Watch) -> Result<usize> {
    let one = ring.field().one();
    let (mut pairs, all) = (0, basis.len() * basis.len().saturating_sub(1) / 2);
    for (i, f) in basis.iter().enumerate() {
        for (j, g) in basis.iter().enumerate().skip(i + 1) {
            watch.report("S-pairs", pairs, all - pairs);
            let lcm = ring.lcm(lead(f)?, lead(g)?)?;
            let lift = |h: &Polynomial<F::Element>| -> Result<_> {
                let factor = ring.layout().checked_div(&lcm, lead(h)?).expect("a multiple is divisible");
                ring.mul_term(h, &one, &factor)
            };
            let difference = ring.sub(&lift(f)?, &lift(g)?);
            if !remainder(ring, &difference, basis, watch)?.is_zero() {
                return Err(refuse(format!(
                    "the S-pair of basis elements {} and {} does not reduce to zero",
                    i + 1,
                    j + 1
                )));
            }
            pairs += 1;
        }
    }
    Ok(pairs)
}

/// The remainder of `f` by the monic `basis`. Whole terms are cancelled one at a time.
fn remainder<F: Field>(
    ring: &PolynomialRing<F>,
    f: &Polynomial<F::Element>,
    basis: &[Polynomial<F::Element>],
    watch: &Watch,
) -> Result<Polynomial<F::Element>> {
    let (mut rest, mut kept) = (f.clone(), ring.zero());
    'terms: while let Some(top) = rest.leading().cloned() {
        watch.check()?;
        for g in basis {
            if let Some(factor) = ring.layout().checked_div(&top.monomial, lead(g)?) {
                rest = ring.sub(&rest, &ring.mul_term(g, &top.coefficient, &factor)?);
                continue 'terms;
            }
        }
        let term = ring.term(top.coefficient, top.monomial);
        rest = ring.sub(&rest, &term);
        kept = ring.add(&kept, &term);
    }
    Ok(kept)
}
