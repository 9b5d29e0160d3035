//! The proof that a modular basis is the reduced basis over Q: homogenisation and Arnold's criterion.

use std::collections::HashSet;

use super::super::hilbert::is_homogeneous;
use super::super::verify::{Claim, verify};
use super::super::{Basis, Options, dehomogenise, f4, homogenise};
use super::divisors::Divisors;
use super::system::{Integral, System, refuse};
use super::{Modular, Status};
use crate::number::{BigRational, Rationals, Ring, residue};
use crate::poly::{Monomial, Order, Polynomial, PolynomialRing};
use crate::{Result, Watch};

/// Proves that `found` is the reduced Groebner basis of the ideal of `generators`, polynomials of `ring`. Sets
/// [`Status::Proved`].
///
/// With cofactors, [`verify`] proves it. Without cofactors, the steps are:
///
/// 1. The homogenised generators `F` (a last variable, graded reverse order) have a basis `H` from [`super::basis`].
/// 2. Over Q, `F` and the S-pairs of `H` reduce to zero by `H`; modulo one prime, the leading monomials of `H` are
///    those of the ideal of `F`. Then `<H> = <F>` (Arnold 2003): the Hilbert function of `F` modulo the prime bounds
///    that of `F` over Q from above, that of `H` bounds it from below.
/// 3. With the last variable put to one, `H` is a basis `B` of the ideal of the generators in graded reverse order. In
///    that order, the elements of `found` reduce to zero by `B` and have the same leading monomials. In another order,
///    the generators and the S-pairs of `found` reduce to zero by `found`; its elements do by `B`, or the quotient
///    rings have the same finite dimension.
///
/// Reductions to zero over Q are proved by a bound on the coefficients and enough primes. The only assumption is that
/// the polynomials of F4 modulo the prime of step 2 belong to the ideal there: they are sums of multiples of its input.
///
/// # Errors
/// [`Certificate`](crate::ErrorKind::Certificate) when `found` is not a basis of the ideal, or is not reduced; those of
/// [`super::basis`].
pub fn prove<'w>(
    found: &Modular,
    ring: &PolynomialRing<Rationals>,
    generators: &[Polynomial<BigRational>],
    watch: impl Into<Option<&'w Watch>>,
) -> Result<Status> {
    let watch = Watch::or_none(watch);
    let basis = &found.basis;
    let generators = transferred(ring, generators, &basis.ring)?;
    if !basis.cofactors.is_empty() {
        let claim = Claim { generators: &generators, basis: &basis.polynomials, cofactors: &basis.cofactors };
        return verify(&basis.ring, &claim, watch).map(|_| Status::Proved);
    }
    check_reduced(&basis.ring, &basis.polynomials)?;
    if *basis.ring.layout().order() == Order::GrevLex && generators.iter().all(|f| is_homogeneous(&basis.ring, f)) {
        prove_homogeneous(&basis.ring, &basis.polynomials, &generators, found.confirmed_by, watch)?;
        return Ok(Status::Proved);
    }
    let graded = graded_basis(&basis.ring, &generators, watch)?;
    prove_by(&graded, &basis.ring, &basis.polynomials, &generators, watch)
}

/// Checks that the basis is monic, sorted from the smallest, and that no element reduces another.
fn check_reduced(ring: &PolynomialRing<Rationals>, basis: &[Polynomial<BigRational>]) -> Result<()> {
    let monic = |f: &Polynomial<BigRational>| f.leading().is_some_and(|t| ring.field().is_one(&t.coefficient));
    if !basis.iter().all(|f| ring.is_well_formed(f) && monic(f)) {
        return Err(refuse("a basis element is not a monic polynomial of the ring"));
    }
    let leads: Vec<&Monomial> = basis.iter().filter_map(|f| f.leading()).map(|term| &term.monomial).collect();
    let sorted = leads.windows(2).all(|pair| ring.layout().compare(pair[0], pair[1]).is_lt());
    let reducible = |index: usize, m: &Monomial| {
        let divides = |(other, lead): (usize, &&Monomial)| other != index && ring.layout().divides(lead, m);
        leads.iter().enumerate().any(divides)
    };
    let reduced =
        |(index, f): (usize, &Polynomial<BigRational>)| !f.terms().iter().any(|t| reducible(index, &t.monomial));
    if sorted && basis.iter().enumerate().all(reduced) {
        return Ok(());
    }
    Err(refuse("the basis is not reduced, or not sorted by leading monomial from the smallest"))
}

/// Converts polynomials to another ring.
fn transferred(
    from: &PolynomialRing<Rationals>,
    list: &[Polynomial<BigRational>],
    to: &PolynomialRing<Rationals>,
) -> Result<Vec<Polynomial<BigRational>>> {
    list.iter().map(|f| from.transfer(f, to)).collect()
}

fn integral(list: &[Polynomial<BigRational>]) -> Vec<Integral> {
    let nonzero = list.iter().enumerate().filter(|(_, f)| !f.is_zero());
    nonzero.map(|(index, f)| Integral::new(index, f)).collect()
}

/// Proves by Arnold's criterion that the homogeneous `generators` and `basis` generate the same ideal, and that `basis`
/// is a Groebner basis.
fn prove_homogeneous(
    ring: &PolynomialRing<Rationals>,
    basis: &[Polynomial<BigRational>],
    generators: &[Polynomial<BigRational>],
    prime: u32,
    watch: &Watch,
) -> Result<()> {
    let mut divisors = Divisors::new(ring, basis);
    check_leads(ring, &divisors.elements, generators, prime, watch)?;
    divisors.prove_all(&integral(generators), watch).map_err(|error| error.with_context("a generator"))?;
    divisors.prove_basis(watch)
}

/// Checks that the leading monomials modulo `p` are those of `basis`. The prime divides no coefficient of `generators`
/// and no leading coefficient of `basis`.
fn check_leads(
    ring: &PolynomialRing<Rationals>,
    basis: &[Integral],
    generators: &[Polynomial<BigRational>],
    p: u32,
    watch: &Watch,
) -> Result<()> {
    let system = System::new(ring, generators);
    if !system.is_good(p) || basis.iter().any(|f| residue(f.leading_coefficient(), p) == 0) {
        return Err(refuse(format!("the prime {p} divides a coefficient; compute the basis again")));
    }
    let (ring, images) = system.image(p)?;
    let image = f4(&ring, &images, watch)?;
    if image.leading_monomials().into_iter().eq(basis.iter().map(Integral::lead)) {
        return Ok(());
    }
    Err(refuse(format!("modulo {p} the leading monomials differ")))
}

/// A proved basis of the ideal of `generators` in graded reverse order. It is not reduced.
struct Graded {
    ring: PolynomialRing<Rationals>,
    basis: Vec<Polynomial<BigRational>>,
}

fn graded_basis(
    ring: &PolynomialRing<Rationals>,
    generators: &[Polynomial<BigRational>],
    watch: &Watch,
) -> Result<Graded> {
    let plain = PolynomialRing::new(Rationals, ring.variables(), Order::GrevLex)?.with_width(ring.layout().width());
    let name = fresh_name(ring.variables());
    let (homogeneous, lifted) = homogenise(&plain, &transferred(ring, generators, &plain)?, &name)?;
    let found = super::basis(&homogeneous, &lifted, &Options::default(), watch)?;
    let (prime, found) = (found.confirmed_by, found.basis);
    let lifted = transferred(&homogeneous, &lifted, &found.ring)?;
    prove_homogeneous(&found.ring, &found.polynomials, &lifted, prime, watch)?;
    let (ring, basis) = dehomogenise(&found.ring, &found.polynomials, &name)?;
    Ok(Graded { basis: minimal(&ring, basis), ring })
}

/// A name that is not in `names`.
fn fresh_name(names: &[String]) -> String {
    let mut name = "h".to_owned();
    while names.contains(&name) {
        name.push('h');
    }
    name
}

/// The elements whose leading monomials no other leading monomial divides, smallest first.
fn minimal(ring: &PolynomialRing<Rationals>, mut basis: Vec<Polynomial<BigRational>>) -> Vec<Polynomial<BigRational>> {
    basis.retain(|f| !f.is_zero());
    basis.sort_by(|f, g| ring.layout().compare(lead(f), lead(g)));
    let mut kept: Vec<Polynomial<BigRational>> = Vec::new();
    for f in basis {
        if !kept.iter().any(|g| ring.layout().divides(lead(g), lead(&f))) {
            kept.push(f);
        }
    }
    kept
}

fn lead(f: &Polynomial<BigRational>) -> &Monomial {
    &f.leading().expect("not zero").monomial
}

/// Step 3 of [`prove`].
fn prove_by(
    graded: &Graded,
    ring: &PolynomialRing<Rationals>,
    basis: &[Polynomial<BigRational>],
    generators: &[Polynomial<BigRational>],
    watch: &Watch,
) -> Result<Status> {
    if *ring.layout().order() == Order::GrevLex {
        prove_members(graded, ring, basis, watch)?;
        let same = leads(&graded.ring, &graded.basis) == leads(ring, basis);
        return if same { Ok(Status::Proved) } else { Err(refuse("a leading monomial is missing")) };
    }
    let dimension = dimension(ring, basis);
    if dimension.is_none() {
        prove_members(graded, ring, basis, watch)?;
    } else if dimension != self::dimension(&graded.ring, &graded.basis) {
        return Err(refuse("the quotient ring has another dimension"));
    }
    let mut divisors = Divisors::new(ring, basis);
    divisors.prove_all(&integral(generators), watch).map_err(|error| error.with_context("a generator"))?;
    divisors.prove_basis(watch)?;
    Ok(Status::Proved)
}

/// The exponents of the leading monomials.
fn leads(ring: &PolynomialRing<Rationals>, basis: &[Polynomial<BigRational>]) -> HashSet<Vec<u32>> {
    basis.iter().map(|f| ring.layout().exponents(lead(f))).collect()
}

/// The number of standard monomials, if finite.
fn dimension(ring: &PolynomialRing<Rationals>, basis: &[Polynomial<BigRational>]) -> Option<usize> {
    Basis { ring: ring.clone(), polynomials: basis.to_vec(), cofactors: Vec::new() }.quotient_dimension()
}

/// Proves that the elements of `basis` belong to the ideal of the graded basis.
fn prove_members(
    graded: &Graded,
    ring: &PolynomialRing<Rationals>,
    basis: &[Polynomial<BigRational>],
    watch: &Watch,
) -> Result<()> {
    let width = ring.layout().width().max(graded.ring.layout().width());
    let target = graded.ring.with_width(width);
    let by = transferred(&graded.ring, &graded.basis, &target)?;
    let elements = transferred(ring, basis, &target)?;
    let mut divisors = Divisors::new(&target, &by);
    divisors.prove_all(&integral(&elements), watch).map_err(|error| error.with_context("a basis element"))
}
