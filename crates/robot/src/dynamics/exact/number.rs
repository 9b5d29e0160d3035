//! Exact numbers that are polynomials. Main type: [`Exact`].

use std::ops::{Add, Mul, Neg, Sub};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use num_traits::{One, Zero};

use crate::dynamics::recursions::Scalar;
use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::{BigRational, Rationals, Ring};
use groebot_algebra::poly::{Order, Polynomial, PolynomialRing, Term, Width};

/// The variables of exact numbers with their relations: `s^2 = 1 - c^2` for a sine and its cosine, `r2^2 = 2` for a
/// square root.
#[derive(Debug)]
pub struct Setting {
    ring: PolynomialRing<Rationals>,
    squares: Vec<Square>,
    most: usize,
    /// Number of terms of the longest sum that exceeded the limit; 0 while none did.
    exceeded: AtomicUsize,
}

#[derive(Debug)]
struct Square {
    variable: usize,
    constant: BigRational,
    /// The variable whose square is subtracted in the relation.
    less: Option<usize>,
}

impl Setting {
    /// Builds a setting from variables, greatest first, pairs of a sine and its cosine, and primes with square roots
    /// `r2`, `r3` and so on. `most` limits the number of terms of a sum.
    pub(super) fn new(
        variables: &[String],
        circles: &[[String; 2]],
        primes: &[u32],
        most: usize,
    ) -> Result<Arc<Setting>> {
        let ring = PolynomialRing::new(Rationals, variables, Order::Lex)?.with_width(Width::Bits8);
        let place = |name: &str| {
            ring.index_of(name).ok_or_else(|| Error::new(ErrorKind::UnknownName, format!("no variable `{name}`")))
        };
        let circle = |[sine, cosine]: &[String; 2]| {
            Ok(Square { variable: place(sine)?, constant: BigRational::one(), less: Some(place(cosine)?) })
        };
        let root = |prime: &u32| {
            let constant = BigRational::from_integer((*prime).into());
            Ok(Square { variable: place(&root_name(*prime))?, constant, less: None })
        };
        let squares = circles.iter().map(circle).chain(primes.iter().map(root)).collect::<Result<_>>()?;
        Ok(Arc::new(Setting { squares, most, exceeded: AtomicUsize::new(0), ring }))
    }

    /// The ring of the variables.
    pub fn ring(&self) -> &PolynomialRing<Rationals> {
        &self.ring
    }

    pub(super) fn has_roots(&self) -> bool {
        self.squares.iter().any(|square| square.less.is_none())
    }

    /// Fails when a sum exceeded the limit of terms.
    pub(super) fn check(&self) -> Result<()> {
        let (most, terms) = (self.most, self.exceeded.load(Ordering::Relaxed));
        let text = || format!("a sum has {terms} terms; at most {most} are allowed");
        if terms == 0 { Ok(()) } else { Err(Error::new(ErrorKind::Overflow, text())) }
    }

    /// Reduces a polynomial so that it contains no square of a sine or a square root.
    fn reduced(&self, mut f: Polynomial<BigRational>) -> Polynomial<BigRational> {
        let layout = self.ring.layout();
        for Square { variable, constant, less } in &self.squares {
            if f.terms().iter().all(|term| layout.exponent(&term.monomial, *variable) < 2) {
                continue;
            }
            let mut terms = Vec::with_capacity(2 * f.terms().len());
            for term in f.terms() {
                let mut exponents = layout.exponents(&term.monomial);
                let twice = exponents[*variable] / 2;
                exponents[*variable] %= 2;
                // (constant - less^2)^twice by the binomial theorem; products of reduced numbers need the powers 0 and
                // 1.
                let mut coefficient = term.coefficient.clone();
                for k in 0..=twice {
                    let left = twice - k;
                    let scaled = &coefficient * num_traits::pow(constant.clone(), left as usize);
                    let monomial = layout.pack(&exponents).expect("no greater than the exponents before");
                    terms.push(Term { coefficient: scaled, monomial });
                    let Some(less) = less else { break };
                    exponents[*less] += 2;
                    coefficient = -coefficient * BigRational::new(left.into(), (k + 1).into());
                }
            }
            f = self.ring.collect(terms);
        }
        f
    }

    fn admitted(self: &Arc<Self>, f: Polynomial<BigRational>) -> Exact {
        let terms = f.terms().len();
        if terms > self.most {
            self.exceeded.fetch_max(terms, Ordering::Relaxed);
            return Exact::zero();
        }
        match self.ring.as_constant(&f) {
            Some(number) => Exact(Kind::Number(number)),
            None => Exact(Kind::Sum(self.clone(), f)),
        }
    }

    /// A variable as a number.
    pub(super) fn variable(self: &Arc<Self>, name: &str) -> Exact {
        let index = self.ring.index_of(name).expect("a variable of the setting");
        Exact(Kind::Sum(self.clone(), self.ring.variable(index)))
    }

    /// A polynomial of the ring as a number.
    pub(super) fn number(self: &Arc<Self>, f: Polynomial<BigRational>) -> Exact {
        let f = self.reduced(f);
        self.admitted(f)
    }

    /// The polynomial that a number is.
    pub(super) fn polynomial(&self, number: &Exact) -> Polynomial<BigRational> {
        match &number.0 {
            Kind::Number(number) => self.ring.constant(number.clone()),
            Kind::Sum(_, f) => f.clone(),
        }
    }

    /// The derivative of a number by a joint's value: a sum of derivatives by variables, each times a number.
    pub(super) fn derivative(self: &Arc<Self>, number: &Exact, by: &[(usize, Exact)]) -> Exact {
        let Kind::Sum(_, f) = &number.0 else { return Exact::zero() };
        let part = |(variable, rate): &(usize, Exact)| self.admitted(self.ring.derivative(f, *variable)) * rate.clone();
        by.iter().map(part).fold(Exact::zero(), |sum, part| sum + part)
    }
}

/// The variable name of a prime's square root.
pub(super) fn root_name(prime: u32) -> String {
    format!("r{prime}")
}

/// A rational number, or a polynomial in the variables of a [`Setting`] without squares of sines and square roots.
/// Equal numbers have equal data.
#[derive(Clone, Debug)]
pub struct Exact(Kind);

#[derive(Clone, Debug)]
enum Kind {
    Number(BigRational),
    Sum(Arc<Setting>, Polynomial<BigRational>),
}

impl From<BigRational> for Exact {
    fn from(number: BigRational) -> Self {
        Exact(Kind::Number(number))
    }
}

impl Exact {
    /// Number of terms.
    pub(crate) fn terms(&self) -> usize {
        match &self.0 {
            Kind::Number(number) => usize::from(!number.is_zero()),
            Kind::Sum(_, f) => f.terms().len(),
        }
    }
}

impl PartialEq for Exact {
    fn eq(&self, other: &Self) -> bool {
        match (&self.0, &other.0) {
            (Kind::Number(a), Kind::Number(b)) => a == b,
            (Kind::Sum(_, a), Kind::Sum(_, b)) => a == b,
            _ => false,
        }
    }
}

impl Add for Exact {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        match (self.0, other.0) {
            (Kind::Number(a), Kind::Number(b)) => Exact(Kind::Number(a + b)),
            (Kind::Number(zero), sum) | (sum, Kind::Number(zero)) if zero.is_zero() => Exact(sum),
            (Kind::Number(a), Kind::Sum(setting, f)) | (Kind::Sum(setting, f), Kind::Number(a)) => {
                let sum = setting.ring.add(&f, &setting.ring.constant(a));
                setting.admitted(sum)
            }
            (Kind::Sum(setting, f), Kind::Sum(_, g)) => setting.admitted(setting.ring.add(&f, &g)),
        }
    }
}

impl Neg for Exact {
    type Output = Self;

    fn neg(self) -> Self {
        match self.0 {
            Kind::Number(number) => Exact(Kind::Number(-number)),
            Kind::Sum(setting, f) => {
                let negated = setting.ring.neg(&f);
                Exact(Kind::Sum(setting, negated))
            }
        }
    }
}

impl Sub for Exact {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Exact {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        match (self.0, other.0) {
            (Kind::Number(a), Kind::Number(b)) => Exact(Kind::Number(a * b)),
            (Kind::Number(zero), _) | (_, Kind::Number(zero)) if zero.is_zero() => Exact::zero(),
            (Kind::Number(a), Kind::Sum(setting, f)) | (Kind::Sum(setting, f), Kind::Number(a)) => {
                let scaled = setting.ring.scale(&f, &a);
                setting.admitted(scaled)
            }
            (Kind::Sum(setting, f), Kind::Sum(_, g)) => {
                let product = setting.ring.checked_mul(&f, &g).expect("the degrees fit");
                setting.number(product)
            }
        }
    }
}

impl Scalar for Exact {
    fn zero() -> Self {
        Exact(Kind::Number(BigRational::zero()))
    }

    fn one() -> Self {
        Exact(Kind::Number(BigRational::one()))
    }

    fn half(&self) -> Self {
        Exact(Kind::Number(BigRational::new(1.into(), 2.into()))) * self.clone()
    }
}
