//! The exact number of distinct real solutions at rational targets: [`Counter`].
//!
//! The equations' Groebner basis is learned once modulo a prime. For each target, F4 repeats the arithmetic modulo further primes (Traverso 1988). There the
//! minimal polynomial of a linear form of the unknowns is computed (Wiedemann 1986) and rebuilt over Q.
//!
//! If its degree is the number of all solutions, it has as many real roots as there are real solutions (the shape lemma; Cox, Little, O'Shea, "Using Algebraic
//! Geometry", 2.4). Descartes' rule of signs counts them.

use std::cell::Cell;

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Zero};

use super::exact::{ExactChain, Reached, Value};
use super::form::Form;
use crate::{Error, ErrorKind, Result, Watch};
use groebot_algebra::groebner::{Basis, Trace, WordQuotient, f4};
use groebot_algebra::number::{BigRational, Chinese, Zp, primes_below, reconstruct, residue};
use groebot_algebra::poly::{Monomial, Order, Polynomial, PolynomialRing, Term};
use groebot_algebra::roots::isolate_square_free;
use groebot_robot::kinematics::Chain;

/// The number of primes in one replay.
const LANES: usize = 4;
/// The number of additional bits that confirm a rebuilt fraction.
const SURPLUS: u32 = 30;
/// The maximum number of batches of primes per target.
const BATCHES: usize = 400;
/// The number of batches from which a target is slow. With lengths and angles of many digits, all targets are slow.
const LONG: usize = 128;
/// The maximum number of slow targets that are counted or given up.
const FEW: usize = 3;
/// The number of batches of primes between two attempts to rebuild.
const PATIENCE: usize = 4;
/// The number of linear forms that are tried.
const FORMS: u64 = 3;

/// The exponents of a monomial, one for each unknown.
type Exponents = Vec<u32>;
/// A polynomial with integer coefficients.
type Integral = Vec<(Exponents, BigInt)>;
/// The polynomials of one target.
type System = Vec<Integral>;

/// A basis modulo a prime, with the learned computation.
struct Learned {
    trace: Trace,
    /// The terms of each generator, greatest first.
    terms: Vec<Vec<Exponents>>,
    /// The monomials of each basis polynomial.
    supports: Vec<Vec<Monomial>>,
    /// The dimension of the quotient ring.
    dimension: usize,
}

/// The monic minimal polynomial of a linear form modulo a prime, constant term first.
struct Image {
    prime: u32,
    polynomial: Vec<u32>,
}

/// A chain whose joints are actuators of a mechanism.
struct Part {
    exact: ExactChain,
    /// By joint: the index of its actuator.
    actuators: Vec<usize>,
}

/// Counts the solutions of the equations of a chain, or of chains that share actuators.
pub(super) struct Counter {
    parts: Vec<Part>,
    names: Vec<String>,
    /// The unknowns of each actuator; `None` where it is given.
    unknowns: Vec<Option<Value>>,
    learned: Option<Learned>,
    /// The number of slow targets so far.
    long: Cell<usize>,
}

impl Counter {
    pub fn new(chain: &Chain, given: &[usize]) -> Self {
        let exact = ExactChain::new(chain);
        let actuators = (0..exact.joints()).collect();
        Counter::of_parts(vec![Part { exact, actuators }], given)
    }

    /// The counter of chains whose joints have these actuators. `None` if the axis vectors of an actuator's joints have different lengths, because the joints
    /// then have no common unknowns.
    pub fn of_coupled(members: &[(&Chain, &[usize])], given: &[usize]) -> Option<Self> {
        let part = |(chain, actuators): &(&Chain, &[usize])| Part {
            exact: ExactChain::new(chain),
            actuators: actuators.to_vec(),
        };
        let parts: Vec<Part> = members.iter().map(part).collect();
        let square = |(part, joint): (&Part, usize)| part.exact.square(joint).clone();
        let alike = |actuator: usize| {
            let mut squares = joints_of(&parts, actuator).map(square);
            let first = squares.next();
            squares.all(|other| Some(other) == first)
        };
        let count = members.iter().flat_map(|(_, actuators)| actuators.iter()).max().map_or(0, |last| last + 1);
        (0..count).all(alike).then(|| Counter::of_parts(parts, given))
    }

    fn of_parts(parts: Vec<Part>, given: &[usize]) -> Self {
        let mut names = Vec::new();
        let mut unknowns = Vec::new();
        for actuator in 0.. {
            let Some((part, joint)) = joints_of(&parts, actuator).next() else { break };
            if given.contains(&actuator) {
                unknowns.push(None);
                continue;
            }
            unknowns.push(Some(part.exact.unknown(joint, names.len())));
            let letters: &[&str] = if part.exact.turns(joint) { &["c", "s"] } else { &["d"] };
            names.extend(letters.iter().map(|letter| format!("{letter}{}", actuator + 1)));
        }
        Counter { parts, names, unknowns, learned: None, long: Cell::new(0) }
    }

    /// The value of an actuator at the rational point with parameter `t`, as [`ExactChain::value`].
    pub fn value(&self, actuator: usize, t: &BigRational) -> Option<Value> {
        joints_of(&self.parts, actuator).next().map(|(part, joint)| part.exact.value(joint, t))
    }

    /// The value of an actuator as a double: radians, or the chain's length unit.
    pub fn double(&self, actuator: usize, value: &Value) -> f64 {
        joints_of(&self.parts, actuator).next().map_or(f64::NAN, |(part, joint)| part.exact.double(joint, value))
    }

    /// The number of distinct real solutions for the target that the joint values `values` reach. `None` if there are infinitely many or multiple ones, or if
    /// the count needs too many primes.
    ///
    /// # Errors
    /// The error of `watch` if it stops the count.
    pub fn count(&mut self, values: &[Value], watch: &Watch) -> Result<Option<usize>> {
        let before = self.long.get();
        if before >= FEW {
            return Ok(None);
        }
        let system = self.system(values);
        let polynomial = match self.eliminant(&system, 1, watch)? {
            None if self.long.get() == before => self.eliminant_afresh(&system, watch)?,
            polynomial => polynomial,
        };
        match polynomial.map(|polynomial| isolate_square_free(&polynomial, watch)) {
            Some(Err(error)) if error.kind() == ErrorKind::BadValue => Ok(None),
            roots => Ok(roots.transpose()?.map(|roots| roots.len())),
        }
    }

    /// The eliminant with a newly learned computation, for a target that does not follow the previous one.
    fn eliminant_afresh(&mut self, system: &System, watch: &Watch) -> Result<Option<Vec<BigInt>>> {
        if !self.learn(system, watch)? {
            return Ok(None);
        }
        let before = self.long.get();
        for form in (1..=FORMS).take_while(|_| self.long.get() == before) {
            if let Some(polynomial) = self.eliminant(system, form, watch)? {
                return Ok(Some(polynomial));
            }
        }
        Ok(None)
    }

    /// The equations and the circle relations, with integer coefficients.
    fn system(&self, values: &[Value]) -> System {
        let letter = |&actuator: &usize| self.unknowns[actuator].as_ref().unwrap_or(&values[actuator]).clone();
        let mut system = System::new();
        for Part { exact, actuators } in &self.parts {
            let own: Vec<Value> = actuators.iter().map(|&actuator| values[actuator].clone()).collect();
            let reached: Reached = exact.reached(&own);
            let letters: Vec<Value> = actuators.iter().map(letter).collect();
            system.extend(exact.equations(&reached, &letters).iter().map(|form| self.integral(form)));
        }
        let mut first = 0;
        for (actuator, unknown) in self.unknowns.iter().enumerate() {
            if let (Some(Value::Revolute(_)), Some((part, joint))) = (unknown, joints_of(&self.parts, actuator).next())
            {
                system.push(self.circle(first, part.exact.square(joint)));
                first += 1;
            }
            first += usize::from(unknown.is_some());
        }
        system
    }

    /// The primitive integer multiple of an equation.
    fn integral(&self, form: &Form) -> Integral {
        let denominator = form.terms().fold(BigInt::one(), |lcm, (_, c)| lcm.lcm(c.denom()));
        let exponents = |set: u32| (0..self.names.len()).map(|v| set >> v & 1).collect::<Exponents>();
        let mut terms: Integral =
            form.terms().map(|(set, c)| (exponents(set), c.numer() * (&denominator / c.denom()))).collect();
        let content = terms.iter().fold(BigInt::zero(), |gcd, (_, c)| gcd.gcd(c));
        terms.iter_mut().for_each(|(_, c)| *c /= &content);
        terms
    }

    /// `c^2 + n s^2 = 1`, where `c` has the index `first`.
    fn circle(&self, first: usize, square: &BigRational) -> Integral {
        let power = |v: Option<usize>| (0..self.names.len()).map(|w| if v == Some(w) { 2 } else { 0 }).collect();
        let (n, d) = (square.numer().clone(), square.denom().clone());
        vec![(power(Some(first)), d.clone()), (power(Some(first + 1)), n), (power(None), -d)]
    }

    fn ring(&self, prime: u32) -> Result<PolynomialRing<Zp>> {
        PolynomialRing::new(Zp::new(u64::from(prime))?, &self.names, Order::GrevLex)
    }

    fn image(&self, system: &System, prime: u32) -> Result<(PolynomialRing<Zp>, Vec<Polynomial<u64>>)> {
        let ring = self.ring(prime)?;
        let mut generators = Vec::with_capacity(system.len());
        for polynomial in system {
            let mut terms = Vec::with_capacity(polynomial.len());
            for (exponents, c) in polynomial {
                terms.push(Term { coefficient: u64::from(residue(c, prime)), monomial: ring.monomial(exponents)? });
            }
            generators.push(ring.collect(terms));
        }
        Ok((ring, generators))
    }

    /// Learns the computation of the basis at a target. Returns whether there are finitely many solutions.
    fn learn(&mut self, system: &System, watch: &Watch) -> Result<bool> {
        let prime = primes().next().ok_or_else(no_primes)?;
        let (ring, generators) = self.image(system, prime)?;
        let (basis, trace) = Trace::learn(&ring, &generators, watch)?;
        if basis.require_zero_dimensional().is_err() {
            return Ok(false);
        }
        let exponents = |f: &Polynomial<u64>| f.terms().iter().map(|t| ring.layout().exponents(&t.monomial)).collect();
        let support = |f: &Polynomial<u64>| f.terms().iter().map(|term| term.monomial.clone()).collect();
        let dimension = WordQuotient::new(&basis, watch)?.dimension();
        self.learned = Some(Learned {
            trace,
            terms: generators.iter().map(exponents).collect(),
            supports: basis.polynomials.iter().map(support).collect(),
            dimension,
        });
        Ok(true)
    }

    /// The minimal polynomial over Z of linear form number `form`. `None` if nothing is learned, if the target does not follow the learned computation, or if
    /// the form has equal values at two solutions.
    fn eliminant(&self, system: &System, form: u64, watch: &Watch) -> Result<Option<Vec<BigInt>>> {
        let Some(learned) = &self.learned else { return Ok(None) };
        let Some(lanes) = lanes(system, &learned.terms) else { return Ok(None) };
        let mut images: Vec<Image> = Vec::new();
        let mut primes = primes().skip(1);
        for batch in 1..=BATCHES {
            if batch == LONG + 1 {
                self.long.set(self.long.get() + 1);
            }
            let mut moduli = [0; LANES];
            for p in &mut moduli {
                *p = primes.next().ok_or_else(no_primes)?;
            }
            images.extend(self.images(learned, &lanes, moduli, form, watch)?);
            if batch == 1 && !self.confirms(system, learned, images.first(), form, watch)? {
                return Ok(None);
            }
            if batch % PATIENCE == 0
                && let Some(polynomial) = rebuilt(&images)?
            {
                return Ok(Some(polynomial));
            }
        }
        Ok(None)
    }

    /// The minimal polynomials modulo several primes, by the learned computation. Primes that do not follow it are left out.
    fn images(
        &self,
        learned: &Learned,
        lanes: &[Vec<BigInt>],
        moduli: [u32; LANES],
        form: u64,
        watch: &Watch,
    ) -> Result<Vec<Image>> {
        let row = |f: &Vec<BigInt>| f.iter().map(|c| moduli.map(|p| residue(c, p))).collect();
        let coefficients: Vec<Vec<[u32; LANES]>> = lanes.iter().map(row).collect();
        let mut images = Vec::with_capacity(LANES);
        for (prime, rows) in moduli.into_iter().zip(learned.trace.replay(moduli, &coefficients, watch)?) {
            let Some(rows) = rows else { continue };
            let basis = learned.basis(self.ring(prime)?, &rows);
            let minimal = self.minimal_polynomial(&basis, learned.dimension, form, watch)?;
            images.extend(minimal.map(|polynomial| Image { prime, polynomial }));
        }
        Ok(images)
    }

    /// Whether F4 without the learned computation gives the same polynomial.
    fn confirms(
        &self,
        system: &System,
        learned: &Learned,
        image: Option<&Image>,
        form: u64,
        watch: &Watch,
    ) -> Result<bool> {
        let Some(Image { prime, polynomial }) = image else { return Ok(false) };
        let (ring, generators) = self.image(system, *prime)?;
        let basis = f4(&ring, &generators, watch)?;
        if basis.require_zero_dimensional().is_err() {
            return Ok(false);
        }
        let afresh = self.minimal_polynomial(&basis, learned.dimension, form, watch)?;
        Ok(afresh.as_ref() == Some(polynomial))
    }

    /// The minimal polynomial of a linear form, constant term first. `None` if its degree is not `dimension`.
    fn minimal_polynomial(
        &self,
        basis: &Basis<Zp>,
        dimension: usize,
        form: u64,
        watch: &Watch,
    ) -> Result<Option<Vec<u32>>> {
        let ring = &basis.ring;
        let quotient = WordQuotient::new(basis, watch)?;
        let weighted = |v: usize| ring.scale(&ring.variable(v), &(form * (v * v) as u64 + 1));
        let terms = (0..self.names.len()).flat_map(|v| weighted(v).terms().to_vec());
        let minimal = quotient.minimal_polynomial(&ring.collect(terms), watch)?.coefficients;
        let full = quotient.dimension() == dimension && minimal.len() == dimension + 1;
        Ok(full.then(|| minimal.into_iter().map(|c| c as u32).collect()))
    }
}

impl Learned {
    /// The basis with these coefficients.
    fn basis(&self, ring: PolynomialRing<Zp>, rows: &[Vec<u32>]) -> Basis<Zp> {
        let row = |(support, row): (&Vec<Monomial>, &Vec<u32>)| {
            let terms = support.iter().zip(row);
            ring.collect(terms.map(|(m, &c)| Term { coefficient: u64::from(c), monomial: m.clone() }))
        };
        let polynomials = self.supports.iter().zip(rows).map(row).collect();
        Basis { ring, polynomials, cofactors: Vec::new() }
    }
}

/// The joints that an actuator moves.
fn joints_of(parts: &[Part], actuator: usize) -> impl Iterator<Item = (&Part, usize)> {
    parts.iter().filter_map(move |part| Some((part, part.actuators.iter().position(|own| *own == actuator)?)))
}

fn primes() -> impl Iterator<Item = u32> {
    primes_below(1 << 31).map(|p| p as u32)
}

fn no_primes() -> Error {
    Error::new(ErrorKind::Budget, "no primes below 2^31 are left")
}

/// The coefficients of the learned terms. `None` if a polynomial has other terms.
fn lanes(system: &System, terms: &[Vec<Exponents>]) -> Option<Vec<Vec<BigInt>>> {
    if system.len() != terms.len() {
        return None;
    }
    let row = |(polynomial, terms): (&Integral, &Vec<Exponents>)| {
        let known = polynomial.iter().all(|(exponents, _)| terms.contains(exponents));
        let find = |wanted: &Exponents| polynomial.iter().find(|(exponents, _)| exponents == wanted);
        let value = |wanted: &Exponents| find(wanted).map_or_else(BigInt::zero, |(_, c)| c.clone());
        known.then(|| terms.iter().map(value).collect())
    };
    system.iter().zip(terms).map(row).collect()
}

/// The integer polynomial with these monic images. It is rebuilt from all images but the last, which confirms it.
fn rebuilt(images: &[Image]) -> Result<Option<Vec<BigInt>>> {
    let Some((last, used)) = images.split_last() else { return Ok(None) };
    let primes: Vec<u32> = used.iter().map(|image| image.prime).collect();
    let chinese = Chinese::new(&primes)?;
    let mut denominator = BigInt::one();
    let mut coefficients: Vec<BigRational> = Vec::with_capacity(last.polynomial.len());
    for k in 0..last.polynomial.len() {
        let residues: Vec<u32> = used.iter().map(|image| image.polynomial[k]).collect();
        let multiple = chinese.lift(&residues, &chinese.factors_times(&denominator));
        let Some(fraction) = reconstruct(&multiple, chinese.modulus(), SURPLUS) else { return Ok(None) };
        let value = fraction / &denominator;
        denominator = denominator.lcm(value.denom());
        coefficients.push(value);
    }
    let whole: Vec<BigInt> = coefficients.iter().map(|c| c.numer() * (&denominator / c.denom())).collect();
    Ok(last.agrees(&whole, &denominator).then_some(whole))
}

impl Image {
    /// Whether this is the image of `polynomial` divided by `lead`.
    fn agrees(&self, polynomial: &[BigInt], lead: &BigInt) -> bool {
        let p = u64::from(self.prime);
        let lead = u64::from(residue(lead, self.prime));
        let same = |(c, &image): (&BigInt, &u32)| u64::from(residue(c, self.prime)) == u64::from(image) * lead % p;
        polynomial.iter().zip(&self.polynomial).all(same)
    }
}
