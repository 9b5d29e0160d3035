//! The number types with which relations are evaluated ([`Arithmetic`]), and multilinear polynomials over them ([`Multilinear`]).

use std::collections::{BTreeMap, HashMap};

use num_traits::Zero;
use smallvec::SmallVec;

use groebot_algebra::number::{BigInt, BigRational, Field, Ring, Zp};
use groebot_algebra::poly::{Polynomial, PolynomialRing};

/// A commutative ring of values, such as numbers, polynomials or registers of a program. Operations may change the ring's own state, such as emitted code.
pub trait Arithmetic {
    /// A value.
    type Value: Clone;

    /// The image of a rational number.
    fn rational(&mut self, number: &BigRational) -> Self::Value;
    /// `a + b`.
    fn add(&mut self, a: &Self::Value, b: &Self::Value) -> Self::Value;
    /// `a - b`.
    fn sub(&mut self, a: &Self::Value, b: &Self::Value) -> Self::Value;
    /// `a b`.
    fn mul(&mut self, a: &Self::Value, b: &Self::Value) -> Self::Value;
    /// `-a`.
    fn neg(&mut self, a: &Self::Value) -> Self::Value;
    /// Whether `a` is known to be zero. Terms with zero coefficients are removed, so exact cancellations must be recognised here.
    fn is_zero(&self, a: &Self::Value) -> bool;
}

/// The rational numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Exact;

impl Arithmetic for Exact {
    type Value = BigRational;

    fn rational(&mut self, number: &BigRational) -> BigRational {
        number.clone()
    }
    fn add(&mut self, a: &BigRational, b: &BigRational) -> BigRational {
        a + b
    }
    fn sub(&mut self, a: &BigRational, b: &BigRational) -> BigRational {
        a - b
    }
    fn mul(&mut self, a: &BigRational, b: &BigRational) -> BigRational {
        a * b
    }
    fn neg(&mut self, a: &BigRational) -> BigRational {
        -a
    }
    fn is_zero(&self, a: &BigRational) -> bool {
        a.is_zero()
    }
}

/// Polynomials over a field. Rational numbers are mapped into the field.
#[derive(Clone, Copy, Debug)]
pub struct Polynomials<'a, F: Field>(pub &'a PolynomialRing<F>);

impl<F: Field> Arithmetic for Polynomials<'_, F> {
    type Value = Polynomial<F::Element>;

    fn rational(&mut self, number: &BigRational) -> Self::Value {
        let ring = self.0;
        ring.constant(ring.field().from_rational(number).unwrap_or_else(|| ring.field().zero()))
    }
    fn add(&mut self, a: &Self::Value, b: &Self::Value) -> Self::Value {
        Ring::add(self.0, a, b)
    }
    fn sub(&mut self, a: &Self::Value, b: &Self::Value) -> Self::Value {
        Ring::sub(self.0, a, b)
    }
    fn mul(&mut self, a: &Self::Value, b: &Self::Value) -> Self::Value {
        Ring::mul(self.0, a, b)
    }
    fn neg(&mut self, a: &Self::Value) -> Self::Value {
        Ring::neg(self.0, a)
    }
    fn is_zero(&self, a: &Self::Value) -> bool {
        a.is_zero()
    }
}

/// Numbers modulo a prime. The images of rational numbers are cached, because only a few different ones occur.
#[derive(Clone, Debug)]
pub struct Modular {
    field: Zp,
    /// By numerator: denominators with the images. (Hashing a whole fraction costs more than reducing it.)
    images: HashMap<BigInt, Vec<(BigInt, u64)>>,
    unlucky: bool,
}

impl Modular {
    /// Arithmetic in GF(p), given by `field`.
    pub fn new(field: Zp) -> Self {
        Modular { field, images: HashMap::new(), unlucky: false }
    }

    /// The field.
    pub fn field(&self) -> Zp {
        self.field
    }

    /// Whether a denominator is zero modulo the prime. The results are then invalid.
    pub(crate) fn is_unlucky(&self) -> bool {
        self.unlucky
    }
}

impl Arithmetic for Modular {
    type Value = u64;

    fn rational(&mut self, number: &BigRational) -> u64 {
        let known = self.images.get(number.numer());
        if let Some((_, image)) =
            known.and_then(|list| list.iter().find(|(denominator, _)| denominator == number.denom()))
        {
            return *image;
        }
        let image = self.field.from_rational(number);
        self.unlucky |= image.is_none();
        let image = image.unwrap_or(0);
        self.images.entry(number.numer().clone()).or_default().push((number.denom().clone(), image));
        image
    }
    fn add(&mut self, a: &u64, b: &u64) -> u64 {
        Ring::add(&self.field, a, b)
    }
    fn sub(&mut self, a: &u64, b: &u64) -> u64 {
        Ring::sub(&self.field, a, b)
    }
    fn mul(&mut self, a: &u64, b: &u64) -> u64 {
        Ring::mul(&self.field, a, b)
    }
    fn neg(&mut self, a: &u64) -> u64 {
        Ring::neg(&self.field, a)
    }
    fn is_zero(&self, a: &u64) -> bool {
        *a == 0
    }
}

/// An unknown of a joint, by the joint's index in the chain.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Factor {
    /// c, the cosine of its angle.
    Cosine(usize),
    /// s', its sine divided by the length of the axis vector.
    Sine(usize),
    /// d', its displacement divided by the length of the axis vector.
    Length(usize),
    /// d' d'.
    LengthSquared(usize),
}

impl Factor {
    /// The index of the joint.
    pub fn joint(self) -> usize {
        match self {
            Factor::Cosine(joint) | Factor::Sine(joint) | Factor::Length(joint) | Factor::LengthSquared(joint) => joint,
        }
    }
}

/// A product of unknowns with at most one factor per joint, in the order of the joints. It is empty for 1.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Factors(SmallVec<[Factor; 4]>);

impl Factors {
    /// The factors, in the order of their joints.
    pub fn list(&self) -> &[Factor] {
        &self.0
    }

    /// The product. The only product of two factors of one joint is d' d', because each joint occurs at most once in a word.
    fn times(&self, other: &Factors) -> Factors {
        let mut list = self.0.clone();
        for &factor in &other.0 {
            match list.iter().position(|own| own.joint() == factor.joint()) {
                None => list.push(factor),
                Some(at) => {
                    debug_assert!(matches!((list[at], factor), (Factor::Length(_), Factor::Length(_))));
                    list[at] = Factor::LengthSquared(factor.joint());
                }
            }
        }
        list.sort_by_key(|factor| factor.joint());
        Factors(list)
    }
}

/// A polynomial of degree at most one in the cosine and sine of each unknown revolute joint. In the length of a prismatic joint, its degree is at most two. It
/// maps each product of unknowns to its coefficient.
#[derive(Clone, Debug, PartialEq)]
pub struct Multilinear<V> {
    terms: BTreeMap<Factors, V>,
}

impl<V: Clone> Multilinear<V> {
    /// Zero.
    pub fn zero() -> Self {
        Multilinear { terms: BTreeMap::new() }
    }

    /// A constant.
    pub(crate) fn constant<A: Arithmetic<Value = V>>(value: V, arithmetic: &A) -> Self {
        let mut constant = Multilinear::zero();
        if !arithmetic.is_zero(&value) {
            constant.terms.insert(Factors::default(), value);
        }
        constant
    }

    /// The products with their nonzero coefficients; 1 comes first.
    pub(crate) fn terms(&self) -> impl ExactSizeIterator<Item = (&Factors, &V)> {
        self.terms.iter()
    }

    /// The coefficient of a product of unknowns, given by its factors in the order of the joints; `None` for zero.
    pub(crate) fn coefficient(&self, factors: &[Factor]) -> Option<&V> {
        self.terms.get(&Factors(SmallVec::from_slice(factors)))
    }

    /// The coefficient of 1.
    pub fn constant_term(&self) -> Option<&V> {
        self.coefficient(&[])
    }

    /// Whether the polynomial is zero.
    pub(crate) fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    /// The joints whose unknowns occur, in their order.
    pub fn joints(&self) -> Vec<usize> {
        let mut joints: Vec<usize> =
            self.terms.keys().flat_map(|product| product.0.iter().map(|f| f.joint())).collect();
        joints.sort_unstable();
        joints.dedup();
        joints
    }

    /// Replaces each coefficient by its image under `change`, and removes zeros.
    fn map<A: Arithmetic<Value = V>>(&self, arithmetic: &mut A, change: impl Fn(&mut A, &V) -> V) -> Self {
        let mut image = Multilinear::zero();
        for (product, value) in &self.terms {
            let value = change(arithmetic, value);
            if !arithmetic.is_zero(&value) {
                image.terms.insert(product.clone(), value);
            }
        }
        image
    }

    /// Adds `value` times the product.
    fn absorb<A: Arithmetic<Value = V>>(&mut self, product: Factors, value: V, arithmetic: &mut A) {
        let sum = match self.terms.get(&product) {
            Some(own) => arithmetic.add(own, &value),
            None => value,
        };
        if arithmetic.is_zero(&sum) {
            self.terms.remove(&product);
        } else {
            self.terms.insert(product, sum);
        }
    }

    /// `self + other`.
    #[must_use]
    pub(crate) fn add<A: Arithmetic<Value = V>>(&self, other: &Self, arithmetic: &mut A) -> Self {
        let mut sum = self.clone();
        for (product, value) in &other.terms {
            sum.absorb(product.clone(), value.clone(), arithmetic);
        }
        sum
    }

    /// `self - other`.
    #[must_use]
    pub(crate) fn sub<A: Arithmetic<Value = V>>(&self, other: &Self, arithmetic: &mut A) -> Self {
        let mut difference = self.clone();
        for (product, value) in &other.terms {
            let changed = match difference.terms.get(product) {
                Some(own) => arithmetic.sub(own, value),
                None => arithmetic.neg(value),
            };
            if arithmetic.is_zero(&changed) {
                difference.terms.remove(product);
            } else {
                difference.terms.insert(product.clone(), changed);
            }
        }
        difference
    }

    /// `-self`.
    #[must_use]
    pub(crate) fn neg<A: Arithmetic<Value = V>>(&self, arithmetic: &mut A) -> Self {
        self.map(arithmetic, |arithmetic, value| arithmetic.neg(value))
    }

    /// `self` times a rational number. The factors 0, 1 and -1 need no multiplication.
    #[must_use]
    pub(crate) fn scale<A: Arithmetic<Value = V>>(&self, number: &BigRational, arithmetic: &mut A) -> Self {
        if number.is_zero() {
            return Multilinear::zero();
        }
        if number.is_integer() && number.numer().magnitude() == &1_u32.into() {
            return if *number.numer() == 1.into() { self.clone() } else { self.neg(arithmetic) };
        }
        let factor = arithmetic.rational(number);
        self.map(arithmetic, |arithmetic, value| arithmetic.mul(value, &factor))
    }

    /// `self other`. The factors may share only prismatic joints.
    #[must_use]
    pub(crate) fn mul<A: Arithmetic<Value = V>>(&self, other: &Self, arithmetic: &mut A) -> Self {
        let mut product = Multilinear::zero();
        for (left, a) in &self.terms {
            for (right, b) in &other.terms {
                let value = arithmetic.mul(a, b);
                product.absorb(left.times(right), value, arithmetic);
            }
        }
        product
    }

    /// `self` times an unknown of a joint that does not occur in it, or times d' of a prismatic joint.
    #[must_use]
    pub(super) fn times_unknown<A: Arithmetic<Value = V>>(&self, factor: Factor, arithmetic: &mut A) -> Self {
        let mut product = Multilinear::zero();
        for (own, value) in &self.terms {
            product.absorb(own.times(&Factors(SmallVec::from_slice(&[factor]))), value.clone(), arithmetic);
        }
        product
    }
}
