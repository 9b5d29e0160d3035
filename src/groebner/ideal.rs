//! Questions to an ideal, answered by a Groebner basis: membership, elimination, dimension, quotient.

use super::{Basis, Options, basis, normal_form};
use crate::number::Field;
use crate::poly::{Monomial, Order, Polynomial, PolynomialRing};
use crate::{Error, ErrorKind, Result, Watch};

impl<F: Field> Basis<F> {
    /// Whether `f` lies in the ideal.
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

    /// The standard monomials, smallest first: a vector-space basis of the quotient ring, whose size is the number of
    /// complex solutions with multiplicity. `None` when the ideal is positive-dimensional; empty for the unit ideal.
    pub fn quotient_basis(&self) -> Option<Vec<Monomial>> {
        let layout = self.ring.layout();
        let leads = self.leading_monomials();
        let bound = |v: usize| {
            let powers = leads.iter().filter_map(|m| match layout.pure_power(m) {
                Some((variable, power)) if variable == v => Some(power),
                _ if layout.degree(m) == 0 => Some(0),
                _ => None,
            });
            powers.min()
        };
        let bounds: Vec<u32> = (0..self.ring.variables().len()).map(bound).collect::<Option<_>>()?;
        let mut standard = Vec::new();
        let mut exponents = vec![0; bounds.len()];
        collect_standard(&self.ring, &leads, &bounds, 0, &mut exponents, &mut standard);
        standard.sort_by(|a, b| layout.compare(a, b));
        Some(standard)
    }

    /// The number of complex solutions counted with multiplicity; `None` when there are infinitely many.
    pub fn quotient_dimension(&self) -> Option<usize> {
        self.quotient_basis().map(|monomials| monomials.len())
    }

    /// A largest set of variables (indices) that no leading monomial is made of alone: they can be chosen freely. Its size is the
    /// dimension of the ideal (Kredel and Weispfenning 1988); empty when zero-dimensional, `None` for the unit ideal.
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
        Some(largest_independent(&supports, count, Vec::new(), 0))
    }

    /// Fails unless the ideal has finitely many solutions.
    ///
    /// # Errors
    /// [`ErrorKind::Inconsistent`] for the unit ideal; [`ErrorKind::PositiveDimensional`] with the names of variables that stay free.
    pub fn require_zero_dimensional(&self) -> Result<()> {
        match self.independent_variables() {
            None => Err(Error::new(ErrorKind::Inconsistent, "the equations contradict each other: the ideal is {1}")),
            Some(free) if free.is_empty() => Ok(()),
            Some(free) => {
                let names: Vec<_> = free.iter().map(|&v| self.ring.variables()[v].as_str()).collect();
                let text = format!("infinitely many solutions; these unknowns stay free: {}", names.join(", "));
                Err(Error::new(ErrorKind::PositiveDimensional, text))
            }
        }
    }
}

/// Walks all exponent vectors below `bounds` that no leading monomial divides.
fn collect_standard<F: Field>(
    ring: &PolynomialRing<F>,
    leads: &[&Monomial],
    bounds: &[u32],
    variable: usize,
    exponents: &mut Vec<u32>,
    standard: &mut Vec<Monomial>,
) {
    for power in 0..bounds.get(variable).copied().unwrap_or(1) {
        if let Some(exponent) = exponents.get_mut(variable) {
            *exponent = power;
        }
        let Some(monomial) = ring.layout().pack(exponents) else { break };
        if leads.iter().any(|lead| ring.layout().divides(lead, &monomial)) {
            break;
        }
        if variable + 1 >= bounds.len() {
            standard.push(monomial);
        } else {
            collect_standard(ring, leads, bounds, variable + 1, exponents, standard);
        }
    }
    if let Some(exponent) = exponents.get_mut(variable) {
        *exponent = 0;
    }
}

fn largest_independent(supports: &[Vec<usize>], count: usize, chosen: Vec<usize>, next: usize) -> Vec<usize> {
    if next == count {
        return chosen;
    }
    let mut with = chosen.clone();
    with.push(next);
    let free = |set: &[usize]| !supports.iter().any(|support| support.iter().all(|v| set.contains(v)));
    let skipped = largest_independent(supports, count, chosen, next + 1);
    if !free(&with) {
        return skipped;
    }
    let taken = largest_independent(supports, count, with, next + 1);
    if taken.len() >= skipped.len() { taken } else { skipped }
}

/// The elimination ideal: the reduced basis of the ideal of `generators` intersected with the ring without the variables named
/// `eliminated`, in graded reverse order.
///
/// # Errors
/// [`ErrorKind::UnknownName`] for a name that is no variable; [`ErrorKind::Overflow`]; what `watch` stops with.
pub fn eliminate<F: Field>(
    ring: &PolynomialRing<F>,
    generators: &[Polynomial<F::Element>],
    eliminated: &[&str],
    watch: &Watch,
) -> Result<Basis<F>> {
    if let Some(name) = eliminated.iter().find(|name| ring.index_of(name).is_none()) {
        let known = ring.variables().join(", ");
        return Err(Error::new(ErrorKind::UnknownName, format!("`{name}` is no variable; the variables are {known}")));
    }
    let kept: Vec<&str> = ring.variables().iter().map(String::as_str).filter(|n| !eliminated.contains(n)).collect();
    let names: Vec<&str> = eliminated.iter().chain(&kept).copied().collect();
    let order = Order::elimination(eliminated.len(), names.len());
    let block_ring = PolynomialRing::new(ring.field().clone(), &names, order)?;
    let moved: Vec<_> = generators.iter().map(|f| ring.transfer(f, &block_ring)).collect::<Result<_>>()?;
    let full = basis(&block_ring, &moved, &Options::default(), watch)?;
    let target = PolynomialRing::new(ring.field().clone(), &kept, Order::GrevLex)?;
    let free = full.polynomials.iter().filter(|f| (0..eliminated.len()).all(|v| full.ring.degree_in(f, v) == 0));
    let polynomials = free.map(|f| full.ring.transfer(f, &target)).collect::<Result<_>>()?;
    Ok(Basis { ring: target, polynomials, cofactors: Vec::new() })
}
