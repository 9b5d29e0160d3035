//! Exact numbers. The field is a value ([`Rationals`], [`Zp`]); its elements are plain data.
//!
//! [`Ring`] and [`Field`] are the only two traits of the hierarchy. Polynomial rings and fields of rational functions
//! (in [`crate::poly`]) implement them too. [`laws`] has the axioms as test functions.

mod chinese;
mod decimal;
mod extension;
pub mod laws;
mod limbs;
mod primes;
mod rational;
mod reconstruct;
pub(crate) mod word;
mod zp;

pub use chinese::Chinese;
pub use decimal::parse_rational;
pub use extension::Extension;
pub use limbs::residue;
pub use num_bigint::BigInt;
pub use num_rational::BigRational;
pub use primes::primes_below;
pub use rational::Rationals;
pub(crate) use rational::common_divisor;
pub use rational::decimal as decimal_text;
pub use reconstruct::reconstruct;
pub use zp::Zp;

use std::fmt::Debug;

/// Output style of an element or a polynomial.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// Plain text that the parser of [`crate::poly`] reads back: `3/2*x^2`.
    Text,
    /// Plain text with finite decimal expansions where they exist: `1.5*x^2`. The parser reads it back too.
    Decimal,
    /// LaTeX mathematics: `\frac{3}{2}x^{2}`.
    Latex,
}

/// A commutative ring with one, as a value.
pub trait Ring: Clone + Debug + PartialEq {
    /// Type of the elements, plain data. Two elements are equal exactly when they are the same element of the ring.
    type Element: Clone + Debug + PartialEq;

    /// The neutral element of addition.
    fn zero(&self) -> Self::Element;
    /// The neutral element of multiplication.
    fn one(&self) -> Self::Element;
    /// The image of an integer.
    fn from_integer(&self, n: &BigInt) -> Self::Element;
    /// `a + b`.
    fn add(&self, a: &Self::Element, b: &Self::Element) -> Self::Element;
    /// `-a`.
    fn neg(&self, a: &Self::Element) -> Self::Element;
    /// `a * b`.
    fn mul(&self, a: &Self::Element, b: &Self::Element) -> Self::Element;
    /// Whether `a` is zero.
    fn is_zero(&self, a: &Self::Element) -> bool;
    /// `a` divided by a unit `b`; `None` when `b` has no inverse in the ring.
    fn checked_div(&self, a: &Self::Element, b: &Self::Element) -> Option<Self::Element>;
    /// Formats `a` in `style`. The parser of [`crate::poly`] reads the text style back.
    fn format(&self, a: &Self::Element, style: Style) -> String;

    /// `a - b`.
    fn sub(&self, a: &Self::Element, b: &Self::Element) -> Self::Element {
        self.add(a, &self.neg(b))
    }
    /// Whether `a` is one.
    fn is_one(&self, a: &Self::Element) -> bool {
        *a == self.one()
    }
    /// `a` to the power `n`, by repeated squaring; `a^0` is one.
    fn pow(&self, a: &Self::Element, n: u32) -> Self::Element {
        let (mut result, mut square, mut n) = (self.one(), a.clone(), n);
        while n > 0 {
            if n & 1 == 1 {
                result = self.mul(&result, &square);
            }
            n >>= 1;
            if n > 0 {
                square = self.mul(&square, &square);
            }
        }
        result
    }
    /// The element with the name `name` (a variable or a parameter), if there is one.
    fn generator(&self, _name: &str) -> Option<Self::Element> {
        None
    }
}

/// An element of a prime field, in the form that algorithms on machine words take.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PrimeElement<'a> {
    /// An element of GF(p), in `0..p`.
    Residue(u64),
    /// A rational number.
    Rational(&'a BigRational),
}

/// A field as a value: a [`Ring`] in which every nonzero element has an inverse.
pub trait Field: Ring {
    /// The characteristic; 0 for the rationals and their extensions.
    fn characteristic(&self) -> u64;

    /// `1 / a`, or `None` for zero.
    fn inverse(&self, a: &Self::Element) -> Option<Self::Element> {
        self.checked_div(&self.one(), a)
    }
    /// The image of a rational number; `None` when its denominator is zero in the field.
    fn from_rational(&self, q: &BigRational) -> Option<Self::Element> {
        self.checked_div(&self.from_integer(q.numer()), &self.from_integer(q.denom()))
    }
    /// `a` as a number of Q or GF(p); `None` in other fields.
    fn prime_element<'a>(&self, _a: &'a Self::Element) -> Option<PrimeElement<'a>> {
        None
    }
}
