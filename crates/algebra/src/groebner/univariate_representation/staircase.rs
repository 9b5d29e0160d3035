//! The quotient ring of a zero-dimensional ideal: which products of variables and standard monomials are standard, and
//! how the others are reduced. The rows of the basis carry all data that depend on the field.

use std::collections::{BTreeSet, HashMap};

use crate::groebner::Basis;
use crate::number::{BigInt, Rationals};
use crate::poly::{Monomial, PolynomialRing, Width};
use crate::{Error, ErrorKind, Result, Watch};
use num_integer::Integer;
use num_traits::One;

/// Position of a product of a variable and a standard monomial.
#[derive(Clone, Copy, Debug)]
pub(super) enum Place {
    /// The standard monomial with this index.
    Standard(usize),
    /// The border monomial with this index.
    Border(usize),
}

/// Computation of the normal form of a border monomial.
#[derive(Clone, Copy, Debug)]
enum Step {
    /// The tail of the basis polynomial with this index.
    Lead(usize),
    /// The variable times an earlier border monomial.
    Product(usize, usize),
}

/// Representation of a variable itself in the quotient ring.
#[derive(Clone, Copy, Debug)]
pub(super) enum Coordinate {
    /// The standard monomial with this index.
    Standard(usize),
    /// The leading monomial of the (linear) basis polynomial with this index.
    Lead(usize),
}

/// A basis polynomial with integer coefficients: `lead m + sum tail[j] b_j` over standard monomials `b_j`.
#[derive(Clone, Debug)]
pub(super) struct Row {
    pub(super) lead: BigInt,
    pub(super) tail: Vec<(usize, BigInt)>,
}

/// The standard monomials, the border for some variables, and the basis polynomials as rows.
#[derive(Clone, Debug)]
pub(super) struct Staircase {
    pub(super) standard: Vec<Monomial>,
    pub(super) rows: Vec<Row>,
    ring: PolynomialRing<Rationals>,
    leads: HashMap<Monomial, usize>,
}

/// The border monomials of some variables, smallest first, and the position of each of their products.
#[derive(Clone, Debug)]
pub(super) struct Border {
    steps: Vec<Step>,
    /// `action[v][j]`: variable `v` times standard monomial `j`; empty for variables that are not needed.
    pub(super) action: Vec<Vec<Place>>,
}

impl Staircase {
    /// # Errors
    /// Those of [`Basis::require_zero_dimensional`]; [`ErrorKind::Overflow`].
    pub(super) fn new(basis: &Basis<Rationals>) -> Result<Self> {
        basis.require_zero_dimensional()?;
        let basis = basis.clone().with_width(Width::Bits32)?;
        let Some(standard) = basis.quotient_basis() else {
            return Err(Error::new(ErrorKind::Overflow, "a standard monomial does not fit the ring; give a wider one"));
        };
        let places: HashMap<&Monomial, usize> = standard.iter().enumerate().map(|(i, m)| (m, i)).collect();
        let not_reduced = || Error::new(ErrorKind::BadValue, "the basis is not reduced; give the reduced basis");
        let mut rows = Vec::new();
        let mut leads = HashMap::new();
        for (index, f) in basis.polynomials.iter().enumerate() {
            let denominator = f.terms().iter().fold(BigInt::one(), |lcm, term| lcm.lcm(term.coefficient.denom()));
            let integral = f.terms().iter().map(|t| t.coefficient.numer() * (&denominator / t.coefficient.denom()));
            let mut integral = f.terms().iter().map(|t| &t.monomial).zip(integral);
            let (monomial, lead) = integral.next().ok_or_else(not_reduced)?;
            let tail = integral.map(|(m, c)| places.get(m).map(|&place| (place, c)));
            rows.push(Row { lead, tail: tail.collect::<Option<_>>().ok_or_else(not_reduced)? });
            leads.insert(monomial.clone(), index);
        }
        Ok(Staircase { rows, leads, ring: basis.ring.clone(), standard })
    }

    /// The dimension of the quotient ring.
    pub(super) fn dimension(&self) -> usize {
        self.standard.len()
    }

    pub(super) fn variables(&self) -> usize {
        self.ring.variables().len()
    }

    /// The representation of each variable itself.
    pub(super) fn coordinates(&self) -> Vec<Coordinate> {
        let coordinate = |v: usize| {
            let variable = self.ring.variable(v);
            let monomial = &variable.leading().expect("a variable is a term").monomial;
            match self.place(monomial) {
                Some(place) => Coordinate::Standard(place),
                None => Coordinate::Lead(self.leads[monomial]),
            }
        };
        (0..self.variables()).map(coordinate).collect()
    }

    fn place(&self, monomial: &Monomial) -> Option<usize> {
        self.standard.binary_search_by(|m| self.ring.layout().compare(m, monomial)).ok()
    }

    /// The border for multiplication by `variables`, with all border monomials that it depends on.
    ///
    /// # Errors
    /// [`ErrorKind::Overflow`].
    pub(super) fn border(&self, variables: impl IntoIterator<Item = usize>) -> Result<Border> {
        let mut needed: BTreeSet<usize> = variables.into_iter().collect();
        loop {
            let monomials = self.border_monomials(&needed)?;
            match self.missing(&monomials, &needed) {
                Some(variable) => drop(needed.insert(variable)),
                None => return Ok(self.steps(&monomials, &needed)),
            }
        }
    }

    fn product(&self, variable: usize, monomial: &Monomial) -> Result<Monomial> {
        let factor = self.ring.variable(variable);
        let factor = &factor.leading().expect("a variable is a term").monomial;
        let overflow = || Error::new(ErrorKind::Overflow, "a border monomial does not fit the ring; give a wider one");
        self.ring.layout().checked_mul(factor, monomial).ok_or_else(overflow)
    }

    /// The products of `variables` and standard monomials that are not standard, smallest first.
    fn border_monomials(&self, variables: &BTreeSet<usize>) -> Result<Vec<Monomial>> {
        let mut border = Vec::new();
        for &variable in variables {
            for monomial in &self.standard {
                let product = self.product(variable, monomial)?;
                if self.place(&product).is_none() {
                    border.push(product);
                }
            }
        }
        border.sort_by(|a, b| self.ring.layout().compare(a, b));
        border.dedup();
        Ok(border)
    }

    /// The variables by which `monomial` can be divided to give another border monomial.
    fn divisors<'a>(&'a self, monomial: &'a Monomial) -> impl Iterator<Item = (usize, Monomial)> + 'a {
        (0..self.variables()).filter_map(|v| {
            let variable = self.ring.variable(v);
            let quotient = self.ring.layout().checked_div(monomial, &variable.leading()?.monomial)?;
            self.place(&quotient).is_none().then_some((v, quotient))
        })
    }

    /// A variable that must be added so that every border monomial is a leading monomial or a product of known ones.
    fn missing(&self, monomials: &[Monomial], needed: &BTreeSet<usize>) -> Option<usize> {
        let composed = monomials.iter().filter(|m| !self.leads.contains_key(*m));
        composed
            .filter_map(|m| {
                let mut divisors = self.divisors(m).map(|(v, _)| v).peekable();
                let first = divisors.peek().copied();
                if divisors.any(|v| needed.contains(&v)) { None } else { first }
            })
            .next()
    }

    fn steps(&self, monomials: &[Monomial], needed: &BTreeSet<usize>) -> Border {
        let places: HashMap<&Monomial, usize> = monomials.iter().enumerate().map(|(i, m)| (m, i)).collect();
        let step = |m: &Monomial| match self.leads.get(m) {
            Some(&row) => Step::Lead(row),
            None => {
                let known = self.divisors(m).filter(|(v, _)| needed.contains(v));
                let known = known.filter_map(|(v, quotient)| Some(Step::Product(v, *places.get(&quotient)?))).next();
                known.expect("the border is closed under division by a variable of it")
            }
        };
        let steps = monomials.iter().map(step).collect();
        let place = |v: usize, m: &Monomial| {
            let product = self.product(v, m).expect("the border fits the ring");
            self.place(&product).map_or_else(|| Place::Border(places[&product]), Place::Standard)
        };
        let actions = |v: usize| self.standard.iter().map(|m| place(v, m)).collect();
        let action = (0..self.variables()).map(|v| if needed.contains(&v) { actions(v) } else { Vec::new() });
        Border { steps, action: action.collect() }
    }
}

impl Border {
    /// The normal forms of the border monomials, from those of the leading monomials. `add_scaled(target, factor, row)`
    /// adds `factor row` to the first entries of `target`.
    ///
    /// # Errors
    /// The error with which `watch` stops the work.
    pub(super) fn normal_forms<E: Clone + PartialEq>(
        &self,
        leads: &[Vec<E>],
        [zero, one]: [E; 2],
        add_scaled: impl Fn(&mut [E], &E, &[E]),
        watch: &Watch,
    ) -> Result<Vec<Vec<E>>> {
        let mut forms: Vec<Vec<E>> = Vec::with_capacity(self.steps.len());
        for step in &self.steps {
            watch.check()?;
            let form = match *step {
                Step::Lead(row) => leads[row].clone(),
                Step::Product(variable, factor) => {
                    let mut sum = vec![zero.clone(); forms[factor].len()];
                    let terms = forms[factor].iter().zip(&self.action[variable]);
                    for (coefficient, place) in terms.filter(|(coefficient, _)| **coefficient != zero) {
                        match *place {
                            Place::Standard(i) => add_scaled(&mut sum[i..], coefficient, std::slice::from_ref(&one)),
                            Place::Border(i) => add_scaled(&mut sum, coefficient, &forms[i]),
                        }
                    }
                    sum
                }
            };
            forms.push(form);
        }
        Ok(forms)
    }
}
