//! Operations on an ideal with a Groebner basis: membership, elimination, dimension, quotient.

use super::{Basis, Options, Settings, basis, f4_with, modular, normal_form};
use crate::number::{Field, PrimeElement, Rationals, Ring, Zp};
use crate::poly::{Monomial, Order, Polynomial, PolynomialRing};
use crate::{Error, ErrorKind, Result, Watch};

impl<F: Field> Basis<F> {
    /// Whether `f` belongs to the ideal.
    ///
    /// # Errors
    /// [`ErrorKind::Overflow`].
    pub fn contains(&self, f: &Polynomial<F::Element>) -> Result<bool> {
        Ok(normal_form(&self.ring, f, &self.polynomials)?.is_zero())
    }

    /// The leading monomials, smallest first.
    pub fn leading_monomials(&self) -> Vec<&Monomial> {
        self.polynomials.iter().filter_map(|f| f.leading()).map(|term| &term.monomial).collect()
    }

    /// The standard monomials, smallest first. They are a vector-space basis of the quotient ring, and their number is
    /// the number of complex solutions with multiplicity. Empty for the unit ideal. `None` when the ideal is
    /// positive-dimensional, or when a standard monomial overflows the lanes of the ring.
    pub fn quotient_basis(&self) -> Option<Vec<Monomial>> {
        let layout = self.ring.layout();
        let mut standard: Vec<_> =
            self.staircase()?.iter().map(|exponents| layout.pack(exponents)).collect::<Option<_>>()?;
        standard.sort_by(|a, b| layout.compare(a, b));
        Some(standard)
    }

    /// The number of complex solutions counted with multiplicity; `None` when there are infinitely many.
    pub fn quotient_dimension(&self) -> Option<usize> {
        Some(self.staircase()?.len())
    }

    /// The exponents of all standard monomials; `None` when there are infinitely many.
    fn staircase(&self) -> Option<Vec<Vec<u32>>> {
        let layout = self.ring.layout();
        let leads = self.leading_monomials();
        let variables = 0..self.ring.variables().len();
        let has_power = |v: usize| {
            let powers = leads.iter().filter_map(|m| layout.pure_power(m));
            self.is_unit_ideal() || powers.into_iter().any(|(variable, _)| variable == v)
        };
        if !variables.clone().all(has_power) {
            return None;
        }
        let leads: Vec<Vec<u32>> = leads.iter().map(|m| layout.exponents(m)).collect();
        let mut standard = Vec::new();
        collect_standard(&leads, &mut vec![0; variables.len()], 0, &mut standard);
        Some(standard)
    }

    /// A largest set of independent variables (indices): no leading monomial has only these variables. Its size is the
    /// dimension of the ideal (Kredel and Weispfenning 1988). Empty when zero-dimensional; `None` for the unit ideal.
    pub fn independent_variables(&self) -> Option<Vec<usize>> {
        if self.is_unit_ideal() {
            return None;
        }
        let count = self.ring.variables().len();
        let layout = self.ring.layout();
        let supports: Vec<Vec<usize>> = self
            .leading_monomials()
            .iter()
            .map(|m| (0..count).filter(|&v| layout.exponent(m, v) > 0).collect())
            .collect();
        let mut best = Vec::new();
        let limit = count - disjoint_supports(&supports, count);
        largest_independent(&supports, 0..count, limit, &mut Vec::new(), &mut best);
        Some(best)
    }

    /// Checks that the ideal has finitely many solutions.
    ///
    /// # Errors
    /// [`ErrorKind::Inconsistent`] for the unit ideal; [`ErrorKind::PositiveDimensional`] with the names of the free
    /// variables.
    pub fn require_zero_dimensional(&self) -> Result<()> {
        match self.independent_variables() {
            None => Err(Error::new(ErrorKind::Inconsistent, "the equations contradict each other: the ideal is {1}")),
            Some(free) if free.is_empty() => Ok(()),
            Some(free) => {
                let names: Vec<_> = free.iter().map(|&v| self.ring.variables()[v].as_str()).collect();
                let text = format!("infinitely many solutions; these unknowns are free: {}", names.join(", "));
                Err(Error::new(ErrorKind::PositiveDimensional, text))
            }
        }
    }
}

/// Enumerates the exponent vectors that start with `exponents` before `variable` and that no leading monomial divides.
/// The enumeration is finite because some leading monomial is a power of each variable.
fn collect_standard(leads: &[Vec<u32>], exponents: &mut Vec<u32>, variable: usize, standard: &mut Vec<Vec<u32>>) {
    let divides = |lead: &Vec<u32>, exponents: &[u32]| lead.iter().zip(exponents).all(|(a, b)| a <= b);
    if leads.iter().any(|lead| divides(lead, exponents)) {
        return;
    }
    if variable == exponents.len() {
        return standard.push(exponents.clone());
    }
    while !leads.iter().any(|lead| divides(lead, exponents)) {
        collect_standard(leads, exponents, variable + 1, standard);
        exponents[variable] += 1;
    }
    exponents[variable] = 0;
}

/// The number of pairwise disjoint sets that a greedy search finds. Each must lose a variable.
fn disjoint_supports(supports: &[Vec<usize>], count: usize) -> usize {
    let mut taken = vec![false; count];
    let mut sorted: Vec<_> = supports.iter().collect();
    sorted.sort_by_key(|support| support.len());
    let free = sorted.into_iter().filter(|support| {
        let free = !support.iter().any(|&v| taken[v]);
        if free {
            support.iter().for_each(|&v| taken[v] = true);
        }
        free
    });
    free.count()
}

/// Extends `chosen` by variables of `rest` and searches for a larger set than `best`. The first of equal size is kept,
/// and no set exceeds `limit`.
fn largest_independent(
    supports: &[Vec<usize>],
    rest: std::ops::Range<usize>,
    limit: usize,
    chosen: &mut Vec<usize>,
    best: &mut Vec<usize>,
) {
    if chosen.len() > best.len() {
        best.clone_from(chosen);
    }
    if chosen.len() + rest.len() <= best.len() || best.len() == limit {
        return;
    }
    let after = rest.start + 1..rest.end;
    chosen.push(rest.start);
    if !supports.iter().any(|support| support.iter().all(|v| chosen.contains(v))) {
        largest_independent(supports, after.clone(), limit, chosen, best);
    }
    chosen.pop();
    largest_independent(supports, after, limit, chosen, best);
}

/// Computes the proved reduced basis: over Q by a modular computation with proof, modulo p by F4 without random
/// combinations, else by [`basis`].
fn certain_basis<F: Field>(
    ring: &PolynomialRing<F>,
    generators: &[Polynomial<F::Element>],
    watch: &Watch,
) -> Result<Basis<F>> {
    let fast = match ring.field().prime_element(&ring.field().one()) {
        Some(PrimeElement::Rational(_)) => over_rationals(ring, generators, watch),
        Some(PrimeElement::Residue(_)) => modulo_prime(ring, generators, watch),
        None => return basis(ring, generators, &Options::default(), watch),
    };
    match fast {
        Err(error) if !matches!(error.kind(), ErrorKind::Cancelled | ErrorKind::Budget) => {
            basis(ring, generators, &Options::default(), watch)
        }
        outcome => outcome,
    }
}

fn over_rationals<F: Field>(
    ring: &PolynomialRing<F>,
    generators: &[Polynomial<F::Element>],
    watch: &Watch,
) -> Result<Basis<F>> {
    let number = |c: &F::Element| match ring.field().prime_element(c) {
        Some(PrimeElement::Rational(q)) => Ok(q.clone()),
        _ => Err(no_number()),
    };
    let (plain, generators) = over(ring, Rationals, generators, number)?;
    let found = modular::basis(&plain, &generators, &Options::default(), watch)?;
    modular::prove(&found, &plain, &generators, watch)?;
    back(ring, &found.basis, |q| ring.field().from_rational(q).ok_or_else(no_number))
}

fn modulo_prime<F: Field>(
    ring: &PolynomialRing<F>,
    generators: &[Polynomial<F::Element>],
    watch: &Watch,
) -> Result<Basis<F>> {
    let number = |c: &F::Element| match ring.field().prime_element(c) {
        Some(PrimeElement::Residue(n)) => Ok(n),
        _ => Err(no_number()),
    };
    let (plain, generators) = over(ring, Zp::new(ring.field().characteristic())?, generators, number)?;
    let found = f4_with(&plain, &generators, Settings { combinations: false, ..Settings::default() }, watch)?;
    back(ring, &found, |&n| Ok(ring.field().from_integer(&n.into())))
}

/// A ring and generators in it.
type Generated<G> = (PolynomialRing<G>, Vec<Polynomial<<G as Ring>::Element>>);

/// Converts the ideal to a ring over a field that the engines support.
fn over<F: Field, G: Field>(
    ring: &PolynomialRing<F>,
    field: G,
    generators: &[Polynomial<F::Element>],
    number: impl Fn(&F::Element) -> Result<G::Element>,
) -> Result<Generated<G>> {
    let plain = PolynomialRing::new(field, ring.variables(), ring.layout().order().clone())?;
    let plain = plain.with_width(ring.layout().width());
    let moved = generators.iter().map(|f| ring.map_into(f, &plain, &number)).collect::<Result<_>>()?;
    Ok((plain, moved))
}

/// Converts the basis back to the field of `ring`.
fn back<F: Field, G: Field>(
    ring: &PolynomialRing<F>,
    found: &Basis<G>,
    element: impl Fn(&G::Element) -> Result<F::Element>,
) -> Result<Basis<F>> {
    let ring = ring.with_width(found.ring.layout().width());
    let moved = found.polynomials.iter().map(|f| found.ring.map_into(f, &ring, &element));
    let polynomials = moved.collect::<Result<_>>()?;
    Ok(Basis { ring, polynomials, cofactors: Vec::new() })
}

fn no_number() -> Error {
    Error::new(ErrorKind::BadValue, "the elements of a prime field are numbers")
}

/// Computes the elimination ideal: the reduced grevlex basis of the ideal of `generators` intersected with the ring
/// without the variables `eliminated`. Over Q the basis is computed modulo primes and proved ([`modular::prove`]).
/// Modulo a prime below 2^31 it is computed by F4 without random combinations, else by [`basis`].
///
/// # Errors
/// [`ErrorKind::UnknownName`] for a name that is not a variable, [`ErrorKind::DuplicateName`] for one listed twice;
/// those of [`basis`].
pub fn eliminate<'w, F: Field>(
    ring: &PolynomialRing<F>,
    generators: &[Polynomial<F::Element>],
    eliminated: &[&str],
    watch: impl Into<Option<&'w Watch>>,
) -> Result<Basis<F>> {
    let watch = Watch::or_none(watch);
    if let Some(name) = eliminated.iter().find(|name| ring.index_of(name).is_none()) {
        let known = ring.variables().join(", ");
        return Err(Error::new(
            ErrorKind::UnknownName,
            format!("`{name}` is not a variable; the variables are {known}"),
        ));
    }
    let kept: Vec<&str> = ring.variables().iter().map(String::as_str).filter(|n| !eliminated.contains(n)).collect();
    let names: Vec<&str> = eliminated.iter().chain(&kept).copied().collect();
    let order = Order::elimination(eliminated.len(), names.len());
    let block_ring = PolynomialRing::new(ring.field().clone(), &names, order)?;
    let moved: Vec<_> = generators.iter().map(|f| ring.transfer(f, &block_ring)).collect::<Result<_>>()?;
    let full = certain_basis(&block_ring, &moved, watch)?;
    let target = PolynomialRing::new(ring.field().clone(), &kept, Order::GrevLex)?;
    let target = target.with_width(full.ring.layout().width());
    let free = full.polynomials.iter().filter(|f| (0..eliminated.len()).all(|v| full.ring.degree_in(f, v) == 0));
    let polynomials = free.map(|f| full.ring.transfer(f, &target)).collect::<Result<_>>()?;
    Ok(Basis { ring: target, polynomials, cofactors: Vec::new() })
}
