//! The standard monomials of an ideal, their multiples by one variable, and the enumeration for another order.
//!
//! J.-C. Faugere, P. Gianni, D. Lazard, T. Mora, "Efficient computation of zero-dimensional Groebner bases by change of
//! ordering", J. Symbolic Computation 16 (1993), section 2: a product of a variable and a standard monomial is
//! standard, or a leading monomial, or a variable times a smaller product.

use std::collections::HashMap;

use crate::groebner::Basis;
use crate::number::Field;
use crate::poly::{Monomial, PolynomialRing};
use crate::{Error, ErrorKind, Result};

/// A variable times a standard monomial.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Product {
    /// The standard monomial with this index.
    Standard(usize),
    /// The border monomial with this index.
    Border(usize),
}

/// Computation of the normal form of a border monomial.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Origin {
    /// It is the leading monomial of this basis polynomial.
    Lead(usize),
    /// It is this variable times this border monomial.
    Multiple(usize, usize),
}

/// The standard monomials of a zero-dimensional ideal and their border.
#[derive(Clone, Debug)]
pub(super) struct Staircase {
    /// The standard monomials by degree, 1 first.
    pub standard: Vec<Monomial>,
    /// `products[v][j]`: variable `v` times standard monomial `j`.
    pub products: Vec<Vec<Product>>,
    pub border: Vec<Monomial>,
    pub origins: Vec<Origin>,
}

impl Staircase {
    /// Builds the staircase of a zero-dimensional basis. The ideal is not the unit ideal.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Overflow`] when a product does not fit the lanes of the ring.
    pub fn new<F: Field>(basis: &Basis<F>) -> Result<Self> {
        let ring = &basis.ring;
        let leads = basis.polynomials.iter().enumerate();
        let leads: HashMap<&Monomial, usize> =
            leads.filter_map(|(index, f)| Some((&f.leading()?.monomial, index))).collect();
        let products = vec![Vec::new(); ring.variables().len()];
        let one = vec![ring.layout().one()];
        let mut stairs = Staircase { standard: one, products, border: Vec::new(), origins: Vec::new() };
        let (mut start, mut below) = (0, HashMap::new());
        while start < stairs.standard.len() {
            let layer = start..stairs.standard.len();
            start = layer.end;
            below = stairs.climb(ring, &leads, layer, &below)?;
        }
        Ok(stairs)
    }

    /// Sorts the products of the standard monomials of one degree into standard and border; returns the new border, by
    /// monomial.
    ///
    /// A product is standard when it is reached from each of its divisors of this degree and is not a leading monomial.
    fn climb<F: Field>(
        &mut self,
        ring: &PolynomialRing<F>,
        leads: &HashMap<&Monomial, usize>,
        layer: std::ops::Range<usize>,
        below: &HashMap<Monomial, usize>,
    ) -> Result<HashMap<Monomial, usize>> {
        let steps = variables(ring);
        let (reached, places) = reach(ring, &steps, &self.standard[layer])?;
        let mut border = HashMap::new();
        let sorted: Vec<Product> = reached
            .into_iter()
            .map(|(monomial, hits)| {
                let origin = match leads.get(&monomial) {
                    Some(&lead) => Origin::Lead(lead),
                    None if hits == support_size(ring, &monomial) => return self.add_standard(monomial),
                    None => multiple_of(ring, &steps, &monomial, below),
                };
                border.insert(monomial.clone(), self.border.len());
                self.add_border(monomial, origin)
            })
            .collect();
        for (at, place) in places.into_iter().enumerate() {
            self.products[at % steps.len()].push(sorted[place]);
        }
        Ok(border)
    }

    /// Each standard monomial except 1 as `(its index, a variable, the index of a smaller standard monomial)`: it is
    /// their product. Sorted by degree.
    pub fn descents(&self) -> Vec<(usize, usize, usize)> {
        let mut descents = vec![None; self.standard.len()];
        for (variable, products) in self.products.iter().enumerate() {
            for (factor, product) in products.iter().enumerate() {
                if let Product::Standard(index) = *product {
                    descents[index] = Some((index, variable, factor));
                }
            }
        }
        descents.into_iter().flatten().collect()
    }

    fn add_standard(&mut self, monomial: Monomial) -> Product {
        self.standard.push(monomial);
        Product::Standard(self.standard.len() - 1)
    }

    fn add_border(&mut self, monomial: Monomial, origin: Origin) -> Product {
        self.border.push(monomial);
        self.origins.push(origin);
        Product::Border(self.border.len() - 1)
    }
}

/// Distinct products with their multiplicities, and the position of every product among them.
type Reached = (Vec<(Monomial, usize)>, Vec<usize>);

/// The products of `monomials` and `steps`, monomial by monomial.
fn reach<F: Field>(ring: &PolynomialRing<F>, steps: &[Monomial], monomials: &[Monomial]) -> Result<Reached> {
    let mut reached: Vec<(Monomial, usize)> = Vec::new();
    let mut indices: HashMap<Monomial, usize> = HashMap::new();
    let mut places = Vec::with_capacity(monomials.len() * steps.len());
    for (monomial, step) in monomials.iter().flat_map(|monomial| steps.iter().map(move |step| (monomial, step))) {
        let place = *indices.entry(product_of(ring, step, monomial)?).or_insert_with_key(|product| {
            reached.push((product.clone(), 0));
            reached.len() - 1
        });
        reached[place].1 += 1;
        places.push(place);
    }
    Ok((reached, places))
}

/// The variables as monomials.
pub(super) fn variables<F: Field>(ring: &PolynomialRing<F>) -> Vec<Monomial> {
    let lead = |v| ring.variable(v).take_leading().expect("a variable is not zero").monomial;
    (0..ring.variables().len()).map(lead).collect()
}

fn product_of<F: Field>(ring: &PolynomialRing<F>, a: &Monomial, b: &Monomial) -> Result<Monomial> {
    ring.layout().checked_mul(a, b).ok_or_else(|| {
        let limit = ring.layout().width().max_degree();
        let text = format!("a standard monomial or its multiple exceeds degree {limit}; use a ring with wider lanes");
        Error::new(ErrorKind::Overflow, text)
    })
}

/// Number of variables that divide `monomial`.
fn support_size<F: Field>(ring: &PolynomialRing<F>, monomial: &Monomial) -> usize {
    (0..ring.variables().len()).filter(|&v| ring.layout().exponent(monomial, v) > 0).count()
}

/// A variable and a border monomial of one degree less whose product is `monomial`.
fn multiple_of<F: Field>(
    ring: &PolynomialRing<F>,
    steps: &[Monomial],
    monomial: &Monomial,
    below: &HashMap<Monomial, usize>,
) -> Origin {
    let divided = |(v, step)| {
        let quotient = ring.layout().checked_div(monomial, step)?;
        below.get(&quotient).map(|&border| Origin::Multiple(v, border))
    };
    steps.iter().enumerate().find_map(divided).expect("a product that is not standard, nor a lead, has such a divisor")
}

/// Enumeration of the monomials of the target ring from the smallest. Multiples of leading monomials are skipped.
///
/// The multiples of the standard monomials by one variable have the same order as these. So one queue for each variable
/// is already sorted.
#[derive(Debug)]
pub(super) struct Walk<'r, F: Field> {
    ring: &'r PolynomialRing<F>,
    steps: Vec<Monomial>,
    /// The standard monomials found so far, smallest first.
    pub standard: Vec<Monomial>,
    /// For each variable, the next standard monomial to multiply by it, and the product.
    next: Vec<(usize, Option<Monomial>)>,
}

/// A monomial all of whose divisors are standard: `variable` times the standard monomial with index `factor`.
#[derive(Clone, Debug)]
pub(super) struct Candidate {
    pub monomial: Monomial,
    pub variable: usize,
    pub factor: usize,
}

impl<'r, F: Field> Walk<'r, F> {
    /// Starts the enumeration after the standard monomial 1.
    pub fn new(ring: &'r PolynomialRing<F>) -> Self {
        let steps = variables(ring);
        let next = vec![(0, None); steps.len()];
        Walk { ring, steps, standard: vec![ring.layout().one()], next }
    }

    /// The next candidate for a standard monomial. If it is standard, the caller pushes it to [`Walk::standard`].
    ///
    /// # Errors
    /// [`crate::ErrorKind::Overflow`] when a product does not fit the lanes of the ring.
    pub fn next(&mut self) -> Result<Option<Candidate>> {
        while let Some(candidate) = self.smallest()? {
            let hits = self.advance(&candidate.monomial);
            if hits == support_size(self.ring, &candidate.monomial) {
                return Ok(Some(candidate));
            }
        }
        Ok(None)
    }

    fn smallest(&mut self) -> Result<Option<Candidate>> {
        let mut best: Option<Candidate> = None;
        for (variable, (factor, product)) in self.next.iter_mut().enumerate() {
            if product.is_none() && *factor < self.standard.len() {
                *product = Some(product_of(self.ring, &self.steps[variable], &self.standard[*factor])?);
            }
            let Some(monomial) = product else { continue };
            if best.as_ref().is_none_or(|best| self.ring.layout().compare(monomial, &best.monomial).is_lt()) {
                best = Some(Candidate { monomial: monomial.clone(), variable, factor: *factor });
            }
        }
        Ok(best)
    }

    /// Removes `monomial` from all queues. Returns the number of queues that had it.
    fn advance(&mut self, monomial: &Monomial) -> usize {
        let ahead = self.next.iter_mut().filter(|(_, product)| product.as_ref() == Some(monomial));
        ahead.map(|slot| *slot = (slot.0 + 1, None)).count()
    }
}
