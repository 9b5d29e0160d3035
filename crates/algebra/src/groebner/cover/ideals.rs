//! Ideals of the parameters: sums, saturations, intersections and partial radicals.
//!
//! An ideal is stored as its reduced basis. Only its zero set is used, so every operation may enlarge the ideal inside
//! its radical. Source: Cox, Little and O'Shea, Ideals, Varieties, and Algorithms, 4th edition (2015), sections 4.2 to
//! 4.4.

use crate::groebner::{Options, Strategy, basis, normal_form};
use crate::number::{Field, Ring};
use crate::poly::{Order, Polynomial, PolynomialRing, factor, gcd, square_free_factors};
use crate::{ErrorKind, Result, Watch};

/// The reduced basis of an ideal; empty for the zero ideal, `[1]` for the unit ideal.
pub(super) type Ideal<E> = Vec<Polynomial<E>>;

/// Computes a Groebner basis. All code of the cover calls this function.
pub(super) fn groebner<F: Field>(
    ring: &PolynomialRing<F>,
    generators: &[Polynomial<F::Element>],
    watch: &Watch,
) -> Result<Ideal<F::Element>> {
    let options = Options { strategy: Strategy::Sugar, cofactors: false };
    let found = basis(ring, generators, &options, watch)?;
    Ok(found.with_width(ring.layout().width())?.polynomials)
}

/// The ring of the parameters with one more variable for eliminations.
#[derive(Clone)]
pub(super) struct Ideals<'a, F: Field> {
    pub ring: PolynomialRing<F>,
    extended: PolynomialRing<F>,
    pub watch: &'a Watch,
}

impl<'a, F: Field> Ideals<'a, F> {
    /// Ideals of the polynomials of `ring`.
    pub fn new(ring: &PolynomialRing<F>, watch: &'a Watch) -> Result<Self> {
        let taken = |name: &str| ring.generator(name).is_some();
        let fresh = (0..).map(|k| format!("t{k}")).find(|name| !taken(name)).expect("there are infinitely many names");
        let mut names = vec![fresh];
        names.extend_from_slice(ring.variables());
        let order = Order::elimination(1, names.len());
        let extended = PolynomialRing::new(ring.field().clone(), &names, order)?;
        Ok(Ideals { ring: ring.clone(), extended, watch })
    }

    /// Distinct monic factors with the same zeros as `f`, irreducible where [`crate::poly::factor()`] supports the
    /// field. All code of the cover calls this function.
    pub fn factors(&self, f: &Polynomial<F::Element>) -> Result<Vec<Polynomial<F::Element>>> {
        if self.ring.as_constant(f).is_some() {
            return Ok(Vec::new());
        }
        match factor(&self.ring, f, self.watch) {
            Ok(found) => Ok(found.factors.into_iter().map(|(factor, _)| factor).collect()),
            Err(error) if error.kind() == ErrorKind::Unsupported => self.separable_factors(f),
            Err(error) => Err(error),
        }
    }

    /// Square-free factors, for fields without factorization into irreducible ones.
    fn separable_factors(&self, f: &Polynomial<F::Element>) -> Result<Vec<Polynomial<F::Element>>> {
        self.watch.check()?;
        let characteristic = self.ring.field().characteristic();
        let separable = characteristic == 0 || characteristic > u64::from(self.ring.degree(f));
        Ok(if separable { square_free_factors(&self.ring, f) } else { vec![self.ring.monic(f)] })
    }

    /// Whether the ideal is the unit ideal: its zero set is empty.
    pub fn is_unit(&self, ideal: &[Polynomial<F::Element>]) -> bool {
        ideal.iter().any(|f| !f.is_zero() && self.ring.as_constant(f).is_some())
    }

    /// Whether the ideal contains `f`.
    pub fn contains(&self, ideal: &[Polynomial<F::Element>], f: &Polynomial<F::Element>) -> Result<bool> {
        Ok(normal_form(&self.ring, f, ideal)?.is_zero())
    }

    /// Whether the ideal contains all `polynomials`: its zero set is contained in theirs.
    pub fn contains_all(
        &self,
        ideal: &[Polynomial<F::Element>],
        polynomials: &[Polynomial<F::Element>],
    ) -> Result<bool> {
        for f in polynomials {
            if !self.contains(ideal, f)? {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// An ideal between that of `generators` and its radical. Repeated factors are removed until none is found.
    pub fn ideal(&self, generators: &[Polynomial<F::Element>]) -> Result<Ideal<F::Element>> {
        let mut ideal = self.square_free(generators)?;
        loop {
            let reduced = groebner(&self.ring, &ideal, self.watch)?;
            ideal = self.square_free(&reduced)?;
            if ideal == reduced {
                return Ok(ideal);
            }
        }
    }

    fn square_free(&self, generators: &[Polynomial<F::Element>]) -> Result<Vec<Polynomial<F::Element>>> {
        let reduced = |f: &Polynomial<F::Element>| {
            let product = self.product(&self.factors(f)?);
            Ok(if self.ring.degree(&product) < self.ring.degree(f) { product } else { self.ring.monic(f) })
        };
        generators.iter().filter(|f| !f.is_zero()).map(reduced).collect()
    }

    /// The product of `factors`.
    pub fn product(&self, factors: &[Polynomial<F::Element>]) -> Polynomial<F::Element> {
        factors.iter().fold(self.ring.one(), |product, factor| self.ring.mul(&product, factor))
    }

    /// The sum of two ideals. Its zero set is the intersection of theirs.
    pub fn sum(&self, a: &[Polynomial<F::Element>], b: &[Polynomial<F::Element>]) -> Result<Ideal<F::Element>> {
        self.ideal(&[a, b].concat())
    }

    /// The closure of the zeros of `ideal` where some polynomial of `exclusion` is not zero.
    pub fn saturate(
        &self,
        ideal: &[Polynomial<F::Element>],
        exclusion: &[Polynomial<F::Element>],
    ) -> Result<Ideal<F::Element>> {
        let mut parts = vec![vec![self.ring.one()]];
        for f in exclusion {
            if self.contains(ideal, f)? {
                continue;
            }
            let part = self.saturate_by(ideal, f)?;
            if part == ideal {
                return Ok(part);
            }
            parts.push(part);
        }
        self.union(&parts)
    }

    /// The closure of the zeros of `ideal` where `f` is not zero.
    fn saturate_by(&self, ideal: &[Polynomial<F::Element>], f: &Polynomial<F::Element>) -> Result<Ideal<F::Element>> {
        match ideal {
            [] if !f.is_zero() => Ok(Vec::new()),
            [single] => Ok(vec![self.without_common_factors(single, f)]),
            _ => {
                let inverse = self.extended.mul(&self.extended.variable(0), &self.lifted(f)?);
                let mut system = vec![self.extended.sub(&self.extended.one(), &inverse)];
                for g in ideal {
                    system.push(self.lifted(g)?);
                }
                self.eliminated(&system)
            }
        }
    }

    fn without_common_factors(
        &self,
        f: &Polynomial<F::Element>,
        divisor: &Polynomial<F::Element>,
    ) -> Polynomial<F::Element> {
        let mut rest = self.ring.monic(f);
        loop {
            let common = gcd(&self.ring, &rest, divisor);
            if self.ring.as_constant(&common).is_some() {
                return rest;
            }
            rest = self.ring.exact_div(&rest, &common).expect("a gcd divides");
        }
    }

    /// The intersection of `ideals`. Its zero set is the union of theirs; `[1]` for no ideals.
    pub fn union(&self, ideals: &[Ideal<F::Element>]) -> Result<Ideal<F::Element>> {
        let largest = self.largest(ideals.to_vec())?;
        let Some((first, rest)) = largest.split_first() else { return Ok(vec![self.ring.one()]) };
        rest.iter().try_fold(first.clone(), |union, ideal| self.intersect(&union, ideal))
    }

    /// `t a + (1 - t) b` without `t`.
    fn intersect(&self, a: &[Polynomial<F::Element>], b: &[Polynomial<F::Element>]) -> Result<Ideal<F::Element>> {
        let t = self.extended.variable(0);
        let rest = self.extended.sub(&self.extended.one(), &t);
        let mut system = Vec::new();
        for (factor, ideal) in [(&t, a), (&rest, b)] {
            for f in ideal {
                system.push(self.extended.checked_mul(factor, &self.lifted(f)?)?);
            }
        }
        self.eliminated(&system)
    }

    fn lifted(&self, f: &Polynomial<F::Element>) -> Result<Polynomial<F::Element>> {
        self.ring.transfer(f, &self.extended)
    }

    fn eliminated(&self, system: &[Polynomial<F::Element>]) -> Result<Ideal<F::Element>> {
        let found = groebner(&self.extended, system, self.watch)?;
        let free = found.iter().filter(|f| self.extended.degree_in(f, 0) == 0);
        let kept: Vec<_> = free.map(|f| self.extended.transfer(f, &self.ring)).collect::<Result<_>>()?;
        self.ideal(&kept)
    }
}
