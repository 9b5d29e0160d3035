//! The coefficients of a reduced basis as functions of the parameters, evaluated modulo a prime.

use super::flat::common_multiple;
use super::lift::{Primes, image};
use super::pattern::Functions;
use super::prime::Prime;
use super::{Ideal, Ring, fresh};
use crate::groebner::f4::Trace;
use crate::number::{BigRational, Ring as _, Zp};
use crate::poly::{Monomial, Polynomial};
use crate::random::SplitMix64;
use crate::{Error, ErrorKind, Result, Watch};

/// Number of points that are evaluated at once.
pub(super) const LANES: usize = 8;

/// A system of equations with polynomial coefficients and the trace of its basis at a random point.
pub(super) struct System {
    parameters: usize,
    equations: Vec<Equation>,
    trace: Trace,
    /// The supports of the basis, greatest monomials first. The first coefficient is one.
    pub supports: Vec<Vec<Monomial>>,
}

/// The coefficients of one equation.
type Equation = Vec<Coefficient>;
/// Exponents of the parameters with their factor.
type Coefficient = Vec<(Vec<u32>, BigRational)>;
/// Same as [`Coefficient`], but modulo a prime.
type Residue = Vec<(Vec<u32>, u64)>;

impl System {
    /// Clears denominators and learns the basis at a random point modulo a prime. Another point must have the same
    /// leading monomials.
    ///
    /// # Errors
    /// Those of the engine.
    pub fn new<'w>(ideal: &Ideal<'_>, watch: impl Into<Option<&'w Watch>>) -> Result<Self> {
        let watch = Watch::or_none(watch);
        let ring = ideal.ring;
        let mut equations = Vec::new();
        for f in ideal.generators {
            let denominators = f.terms().iter().map(|term| term.coefficient.denominator());
            equations.push(equation(ring, f, &common_multiple(ring, denominators)));
        }
        let parameters = ring.field().ring().variables().len();
        let mut primes = Primes::new();
        let mut stream = SplitMix64::new(3);
        for _ in 0..10 {
            let field = primes.next_that(|field| admit(&equations, field));
            let point: Vec<u64> = (0..parameters).map(|_| stream.unit(field.p)).collect();
            let values = Evaluator::new(&equations, parameters, field).values(std::slice::from_ref(&point));
            if let Some((trace, supports)) = learn(ring, ideal.generators, &values, field, watch)?
                && fresh::has_leads(ideal, supports.iter().map(|support| &support[0]), &mut primes, watch)?
            {
                return Ok(System { parameters, equations, trace, supports });
            }
        }
        Err(Error::new(
            ErrorKind::BadValue,
            "ten random points give different bases, or make coefficients vanish; give each equation once",
        ))
    }
}

impl System {
    /// The leading monomials of the basis, smallest first.
    pub fn leads(&self) -> impl Iterator<Item = &Monomial> + Clone {
        self.supports.iter().map(|support| &support[0])
    }

    /// The number of terms for the basis at one point.
    pub fn terms(&self) -> usize {
        self.trace.terms()
    }
}

/// The coefficients of `f` times `multiple`, a common multiple of their denominators.
fn equation(ring: &Ring, f: &super::Poly, multiple: &Polynomial<BigRational>) -> Equation {
    let ground = ring.field().ring();
    let coefficient = |term: &crate::poly::Term<crate::poly::Fraction<BigRational>>| {
        let (top, bottom) = (term.coefficient.numerator(), term.coefficient.denominator());
        let cleared = if multiple == bottom {
            top.clone()
        } else {
            ground.mul(top, &ground.exact_div(multiple, bottom).expect("it divides the multiple"))
        };
        let terms = cleared.terms().iter();
        terms.map(|t| (ground.layout().exponents(&t.monomial), t.coefficient.clone())).collect()
    };
    f.terms().iter().map(coefficient).collect()
}

/// The trace at the point where the coefficients have these values; `None` when one of them vanishes.
fn learn(
    ring: &Ring,
    generators: &[super::Poly],
    values: &[Vec<[u32; LANES]>],
    field: Prime,
    watch: &Watch,
) -> Result<Option<(Trace, Vec<Vec<Monomial>>)>> {
    let target = ring.over(Zp::known_prime(field.p));
    let mut images = Vec::new();
    for (f, values) in generators.iter().zip(values) {
        if values.iter().any(|lanes| lanes[0] == 0) {
            return Ok(None);
        }
        let terms = f.terms().iter().zip(values);
        images.push(target.collect(terms.map(|(term, lanes)| crate::poly::Term {
            coefficient: u64::from(lanes[0]),
            monomial: term.monomial.clone(),
        })));
    }
    let (basis, trace) = Trace::learn(&target, &images, watch)?;
    let support = |f: &Polynomial<u64>| f.terms().iter().map(|term| term.monomial.clone()).collect();
    Ok(Some((trace, basis.polynomials.iter().map(support).collect())))
}

/// The coefficients of the equations modulo one prime.
struct Evaluator {
    field: Prime,
    /// The highest exponent of each parameter.
    tops: Vec<u32>,
    equations: Vec<Vec<Residue>>,
}

impl Evaluator {
    fn new(equations: &[Equation], parameters: usize, field: Prime) -> Self {
        let mut tops = vec![0; parameters];
        let mut map_term = |(exponents, factor): &(Vec<u32>, BigRational)| {
            tops.iter_mut().zip(exponents).for_each(|(top, &e)| *top = (*top).max(e));
            (exponents.clone(), image(field, factor))
        };
        let mut map = |coefficient: &Coefficient| coefficient.iter().map(&mut map_term).collect();
        let equations = equations.iter().map(|equation| equation.iter().map(&mut map).collect()).collect();
        Evaluator { field, tops, equations }
    }

    /// The coefficients at up to [`LANES`] points. Missing lanes repeat the first point.
    fn values(&self, points: &[Vec<u64>]) -> Vec<Vec<[u32; LANES]>> {
        let powers: [Vec<Vec<u64>>; LANES] = std::array::from_fn(|lane| self.powers(&points[lane % points.len()]));
        let value = |coefficient: &Residue| -> [u32; LANES] {
            std::array::from_fn(|lane| {
                let sum = coefficient.iter().fold(0, |sum, (exponents, factor)| {
                    let nonzero = exponents.iter().enumerate().filter(|(_, e)| **e > 0);
                    let term = nonzero.fold(*factor, |term, (v, &e)| self.field.mul(term, powers[lane][v][e as usize]));
                    self.field.add(sum, term)
                });
                sum as u32
            })
        };
        self.equations.iter().map(|equation| equation.iter().map(value).collect()).collect()
    }

    fn powers(&self, point: &[u64]) -> Vec<Vec<u64>> {
        let powers = |(&x, &top): (&u64, &u32)| {
            let mut powers = vec![1];
            (0..top).for_each(|_| powers.push(self.field.mul(x, *powers.last().expect("it has a one"))));
            powers
        };
        point.iter().zip(&self.tops).map(powers).collect()
    }
}

/// Whether the prime divides no numerator and no denominator of a coefficient.
fn admit(equations: &[Equation], field: Prime) -> bool {
    equations.iter().flatten().flatten().all(|(_, factor)| image(field, factor) != 0)
}

impl Functions for System {
    fn parameters(&self) -> usize {
        self.parameters
    }

    fn count(&self) -> usize {
        self.supports.iter().map(|support| support.len() - 1).sum()
    }

    fn admit(&self, field: Prime) -> bool {
        admit(&self.equations, field)
    }

    fn values(&self, field: Prime, points: &[Vec<u64>], watch: &Watch) -> Result<Vec<Option<Vec<u64>>>> {
        let evaluator = Evaluator::new(&self.equations, self.parameters, field);
        let mut results = Vec::with_capacity(points.len());
        for chunk in points.chunks(LANES) {
            watch.check()?;
            let lanes = self.trace.replay([field.p as u32; LANES], &evaluator.values(chunk), watch)?;
            let flat = |basis: Vec<Vec<u32>>| basis.iter().flat_map(|f| f[1..].iter().map(|&c| u64::from(c))).collect();
            results.extend(lanes.into_iter().take(chunk.len()).map(|lane| lane.map(flat)));
        }
        Ok(results)
    }
}
