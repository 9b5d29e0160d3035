//! Hilbert series of ideals: [`HilbertSeries`], from the leading monomials of a basis.
//!
//! A. Bigatti, "Computation of Hilbert-Poincare series", J. Pure and Applied Algebra 119 (1997): the series of a
//! monomial ideal follows from two simpler ones, its sum with a pivot and its quotient by it.

use num_traits::{One, Signed, Zero};

use super::Basis;
use crate::number::{BigInt, BigRational, Field, Rationals, Ring};
use crate::poly::univariate::{Univariate, UnivariateRing};
use crate::poly::{Order, Polynomial, PolynomialRing};
use crate::{Error, ErrorKind, Result};

/// The Hilbert series `sum over d of H(d) t^d` of a quotient ring by a homogeneous ideal, H(d) being the dimension of its part of
/// degree d: numerator / (1 - t)^variables.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct HilbertSeries {
    /// The numerator, constant term first; empty for the unit ideal.
    pub numerator: Vec<BigInt>,
    /// The number of variables: the power of `1 - t` in the denominator.
    pub variables: usize,
}

impl<F: Field> Basis<F> {
    /// The Hilbert series of the ideal of the leading monomials. For a homogeneous ideal it is the series of the ideal,
    /// in any order. For another ideal and a degree order, the sum of its coefficients up to degree d is the affine
    /// Hilbert function: the dimension of the polynomials of degree at most d modulo the ideal.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when the ideal is not homogeneous and the order does not compare total degrees first.
    pub fn hilbert_series(&self) -> Result<HilbertSeries> {
        if !compares_degrees(self.ring.layout().order())
            && !self.polynomials.iter().all(|f| is_homogeneous(&self.ring, f))
        {
            let text = "a Hilbert series needs a homogeneous ideal or a degree order; compute the basis in grevlex";
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let layout = self.ring.layout();
        let leads = self.leading_monomials().into_iter().map(|m| layout.exponents(m)).collect();
        Ok(HilbertSeries { numerator: numerator(leads), variables: layout.variables() })
    }

    /// The degree (multiplicity) of the ideal. For a zero-dimensional ideal it is the number of solutions with
    /// multiplicity, else the degree of its projective closure. Zero for the unit ideal.
    ///
    /// # Errors
    /// Those of [`Basis::hilbert_series`].
    pub fn degree(&self) -> Result<BigInt> {
        Ok(self.hilbert_series()?.degree())
    }
}

/// Whether the monomials of greater total degree are greater.
fn compares_degrees(order: &Order) -> bool {
    match order {
        Order::GrevLex => true,
        Order::Lex => false,
        Order::Block(blocks) => matches!(blocks.as_slice(), [block] if block.graded),
    }
}

/// Whether all terms have the same degree.
pub(super) fn is_homogeneous<F: Field>(ring: &PolynomialRing<F>, f: &Polynomial<F::Element>) -> bool {
    let degree = |monomial| ring.layout().degree(monomial);
    f.terms().windows(2).all(|pair| degree(&pair[0].monomial) == degree(&pair[1].monomial))
}

impl HilbertSeries {
    /// The numerator of the reduced series, whose denominator is `(1 - t)^k` with the least k, and this k. It is the
    /// dimension of the ideal as an affine set; that of the projective set is one less. Empty and 0 for the unit ideal.
    pub fn reduced(&self) -> (Vec<BigInt>, usize) {
        let (mut numerator, mut power) = (self.numerator.clone(), self.variables);
        while !numerator.is_empty() && numerator.iter().sum::<BigInt>().is_zero() {
            numerator = running_sums(&numerator);
            trim(&mut numerator);
            power -= 1;
        }
        if numerator.is_empty() { (numerator, 0) } else { (numerator, power) }
    }

    /// The dimension; `None` for the unit ideal.
    pub fn dimension(&self) -> Option<usize> {
        (!self.numerator.is_empty()).then(|| self.reduced().1)
    }

    /// The degree: the reduced numerator at `t = 1`.
    pub fn degree(&self) -> BigInt {
        self.reduced().0.iter().sum()
    }

    /// The Hilbert function at `degree`: the dimension of the quotient ring's part of that degree.
    pub fn value(&self, degree: usize) -> BigInt {
        let mut coefficients = self.numerator.clone();
        coefficients.resize(degree + 1, BigInt::zero());
        for _ in 0..self.variables {
            coefficients = running_sums(&coefficients);
        }
        coefficients.swap_remove(degree)
    }

    /// The Hilbert polynomial, equal to the Hilbert function in all degrees from [`HilbertSeries::regularity`] on.
    pub fn polynomial(&self) -> Univariate<BigRational> {
        let ring = UnivariateRing::new(Rationals, "d");
        let (numerator, dimension) = self.reduced();
        let Some(below) = dimension.checked_sub(1) else { return ring.zero() };
        let shifted = |k: usize| binomial(&ring, BigInt::from(below) - BigInt::from(k), below);
        let terms = numerator.iter().enumerate();
        let terms = terms.map(|(k, c)| ring.scale(&shifted(k), &BigRational::from_integer(c.clone())));
        terms.fold(ring.zero(), |sum, term| ring.add(&sum, &term))
    }

    /// The least degree from which on Hilbert function and polynomial agree.
    pub fn regularity(&self) -> usize {
        let (numerator, dimension) = self.reduced();
        numerator.len().saturating_sub(dimension)
    }
}

/// `(d + shift) (d + shift - 1) ... / below!` with `below` factors: a binomial coefficient as a polynomial in d.
fn binomial(ring: &UnivariateRing<Rationals>, shift: BigInt, below: usize) -> Univariate<BigRational> {
    (0..below).fold(ring.one(), |product, k| {
        let root = BigRational::from_integer(&shift - BigInt::from(k));
        let factor = ring.polynomial(vec![root, BigRational::one()]);
        let share = BigRational::new(BigInt::one(), BigInt::from(k + 1));
        ring.scale(&ring.mul(&product, &factor), &share)
    })
}

/// The coefficients of the product with `1 + t + t^2 + ...`, truncated to the same length.
fn running_sums(coefficients: &[BigInt]) -> Vec<BigInt> {
    let mut sum = BigInt::zero();
    coefficients
        .iter()
        .map(|c| {
            sum += c;
            sum.clone()
        })
        .collect()
}

fn trim(coefficients: &mut Vec<BigInt>) {
    while coefficients.last().is_some_and(Zero::is_zero) {
        coefficients.pop();
    }
}

/// The numerator of the series of a monomial ideal, given by exponents.
pub(super) fn numerator(monomials: Vec<Vec<u32>>) -> Vec<BigInt> {
    let monomials = minimal(monomials);
    let mut result = match pivot(&monomials) {
        None => coprime_numerator(&monomials),
        Some(pivot) => {
            let degree = degree(&pivot) as usize;
            let quotient = numerator(monomials.iter().map(|m| quotient(m, &pivot)).collect());
            let mut sum = numerator(monomials.into_iter().chain([pivot]).collect());
            sum.resize(sum.len().max(quotient.len() + degree), BigInt::zero());
            sum[degree..].iter_mut().zip(quotient).for_each(|(sum, c)| *sum += c);
            sum
        }
    };
    trim(&mut result);
    result
}

fn degree(monomial: &[u32]) -> u32 {
    monomial.iter().sum()
}

/// `m : pivot`.
fn quotient(m: &[u32], pivot: &[u32]) -> Vec<u32> {
    m.iter().zip(pivot).map(|(a, b)| a.saturating_sub(*b)).collect()
}

/// The monomials that no other monomial divides.
fn minimal(mut monomials: Vec<Vec<u32>>) -> Vec<Vec<u32>> {
    monomials.sort_by_cached_key(|m| (degree(m), m.clone()));
    let mut kept: Vec<Vec<u32>> = Vec::new();
    for m in monomials {
        if !kept.iter().any(|divisor| divisor.iter().zip(&m).all(|(a, b)| a <= b)) {
            kept.push(m);
        }
    }
    kept
}

/// The power of the most frequent variable whose exponent is the median; `None` when no two monomials share a variable.
fn pivot(monomials: &[Vec<u32>]) -> Option<Vec<u32>> {
    let count = monomials.first()?.len();
    let uses = |v: usize| monomials.iter().filter(|m| m[v] > 0).count();
    let variable = (0..count).max_by_key(|&v| (uses(v), count - v)).filter(|&v| uses(v) > 1)?;
    let mixed = monomials.iter().filter(|m| m[variable] > 0 && degree(m) > m[variable]);
    let mut exponents: Vec<u32> = mixed.map(|m| m[variable]).collect();
    exponents.sort_unstable();
    let mut pivot = vec![0; count];
    pivot[variable] = exponents[exponents.len() / 2];
    Some(pivot)
}

/// The product of `1 - t^degree` over monomials that pairwise share no variable.
fn coprime_numerator(monomials: &[Vec<u32>]) -> Vec<BigInt> {
    monomials.iter().fold(vec![BigInt::one()], |product, m| {
        let degree = degree(m) as usize;
        let mut next = product.clone();
        next.resize(product.len() + degree, BigInt::zero());
        next[degree..].iter_mut().zip(&product).for_each(|(sum, c)| *sum -= c);
        next
    })
}

/// The number of additional monomials of this degree in `smaller` compared with `larger`; `None` when it has fewer.
pub(super) fn excess(larger: &HilbertSeries, smaller: &HilbertSeries, degree: usize) -> Option<BigInt> {
    let difference = larger.value(degree) - smaller.value(degree);
    (!difference.is_negative()).then_some(difference)
}
