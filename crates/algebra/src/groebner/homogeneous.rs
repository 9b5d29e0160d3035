//! Homogenisation, and the Hilbert-driven computation of a homogeneous basis.
//!
//! C. Traverso, "Hilbert functions and the Buchberger algorithm", J. Symbolic Computation 22 (1996): pairs of a degree
//! are skipped once the number of leading monomials of this degree agrees with the series. They reduce to zero.

use super::engine::basis_towards;
use super::goal::another_series;
use super::hilbert::is_homogeneous;
use super::{Basis, HilbertSeries, Options, Strategy};
use crate::number::Field;
use crate::poly::{Block, Order, Polynomial, PolynomialRing, Term};
use crate::{Error, ErrorKind, Result, Watch};

/// A ring and polynomials of it.
pub type System<F> = (PolynomialRing<F>, Vec<Polynomial<<F as crate::number::Ring>::Element>>);

/// Homogenises the polynomials by powers of one more variable `name`, the smallest one. The order of the other
/// variables is unchanged. [`dehomogenise`] maps a basis of the homogenised system to a basis of the system.
///
/// # Errors
/// [`ErrorKind::DuplicateName`] when `name` is already a variable.
pub fn homogenise<F: Field>(
    ring: &PolynomialRing<F>,
    polynomials: &[Polynomial<F::Element>],
    name: &str,
) -> Result<System<F>> {
    let names: Vec<&str> = ring.variables().iter().map(String::as_str).chain([name]).collect();
    let order = match ring.layout().order() {
        Order::Block(blocks) => Order::Block(blocks.iter().copied().chain([Block { size: 1, graded: true }]).collect()),
        order => order.clone(),
    };
    let target = PolynomialRing::new(ring.field().clone(), &names, order)?.with_width(ring.layout().width());
    let lift = |f: &Polynomial<F::Element>| {
        let top = ring.degree(f);
        let lifted = f.terms().iter().map(|term| {
            let mut exponents = ring.layout().exponents(&term.monomial);
            exponents.push(top - ring.layout().degree(&term.monomial));
            Ok(Term { coefficient: term.coefficient.clone(), monomial: target.monomial(&exponents)? })
        });
        Ok(target.collect(lifted.collect::<Result<Vec<_>>>()?))
    };
    let lifted = polynomials.iter().map(lift).collect::<Result<_>>()?;
    Ok((target, lifted))
}

/// Substitutes one for the variable `name`. The result is in the ring without it.
///
/// # Errors
/// [`ErrorKind::UnknownName`] when there is no such variable.
pub fn dehomogenise<F: Field>(
    ring: &PolynomialRing<F>,
    polynomials: &[Polynomial<F::Element>],
    name: &str,
) -> Result<System<F>> {
    let Some(index) = ring.index_of(name) else {
        let known = ring.variables().join(", ");
        return Err(Error::new(
            ErrorKind::UnknownName,
            format!("`{name}` is not a variable; the variables are {known}"),
        ));
    };
    let names: Vec<&String> = ring.variables().iter().filter(|variable| *variable != name).collect();
    let order = order_without(ring.layout().order(), index);
    let target = PolynomialRing::new(ring.field().clone(), &names, order)?.with_width(ring.layout().width());
    let lower = |f: &Polynomial<F::Element>| {
        let lowered = f.terms().iter().map(|term| {
            let mut exponents = ring.layout().exponents(&term.monomial);
            exponents.remove(index);
            Ok(Term { coefficient: term.coefficient.clone(), monomial: target.monomial(&exponents)? })
        });
        Ok(target.collect(lowered.collect::<Result<Vec<_>>>()?))
    };
    let lowered = polynomials.iter().map(lower).collect::<Result<_>>()?;
    Ok((target, lowered))
}

/// The order of the remaining variables after the one at `index` is removed.
fn order_without(order: &Order, index: usize) -> Order {
    let Order::Block(blocks) = order else { return order.clone() };
    let mut end = 0;
    let shrunk = blocks.iter().map(|block| {
        let start = end;
        end += block.size;
        Block { size: block.size - usize::from((start..end).contains(&index)), ..*block }
    });
    Order::Block(shrunk.filter(|block| block.size > 0).collect())
}

/// Computes the reduced Groebner basis of a homogeneous ideal with a known Hilbert series, for example from another
/// order or another prime. This is faster where most pairs reduce to zero, as for a lexicographic order.
///
/// The result is correct if `series` is the series of the ideal.
///
/// # Errors
/// [`ErrorKind::BadValue`] when a generator is not homogeneous, or when the computation contradicts the series; those
/// of [`super::basis`].
pub fn hilbert_driven<'w, F: Field>(
    ring: &PolynomialRing<F>,
    generators: &[Polynomial<F::Element>],
    series: &HilbertSeries,
    watch: impl Into<Option<&'w Watch>>,
) -> Result<Basis<F>> {
    let watch = Watch::or_none(watch);
    if let Some(index) = generators.iter().position(|f| !is_homogeneous(ring, f)) {
        let text = format!("generator {} is not homogeneous; homogenise the system first", index + 1);
        return Err(Error::new(ErrorKind::BadValue, text));
    }
    let options = Options { strategy: Strategy::Sugar, ..Options::default() };
    let found = basis_towards(ring, generators, &options, Some(series), watch)?;
    if found.hilbert_series()? == *series { Ok(found) } else { Err(another_series()) }
}
