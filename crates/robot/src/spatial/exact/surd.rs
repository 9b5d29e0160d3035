//! Numbers a + b sqrt 2 + c sqrt 3 + d sqrt 6 with rational a, b, c, d: the field with the sines of all multiples of 15
//! degrees and the tangents of half of them. Main type: [`Surd`].

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::ExactVector;
use super::decimal::is_decimal_of;
use groebot_algebra::number::BigRational;

/// Initial precision of square roots in bits. An irrational number, and one with a long denominator, is rounded to a
/// multiple of 2^-80.
const BITS: u64 = 80;
/// Maximum length of a denominator in bits.
const LONGEST: u64 = 256;

/// An element of Q(sqrt 2, sqrt 3).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Surd {
    /// The coefficients of 1, sqrt 2, sqrt 3 and sqrt 6.
    pub(crate) parts: [BigRational; 4],
}

impl Surd {
    /// `a + b sqrt 2 + c sqrt 3`, for small numbers.
    pub fn of(a: i64, b: i64, c: i64) -> Self {
        Surd { parts: [a, b, c, 0].map(|n| BigRational::from_integer(n.into())) }
    }

    /// Whether it is zero.
    pub fn is_zero(&self) -> bool {
        self.parts.iter().all(Zero::is_zero)
    }

    /// The number itself, when it is rational.
    pub fn rational(&self) -> Option<&BigRational> {
        self.parts[1..].iter().all(Zero::is_zero).then_some(&self.parts[0])
    }

    /// `self + other`.
    pub fn add(&self, other: &Surd) -> Surd {
        Surd { parts: std::array::from_fn(|i| &self.parts[i] + &other.parts[i]) }
    }

    /// `self - other`.
    pub fn sub(&self, other: &Surd) -> Surd {
        Surd { parts: std::array::from_fn(|i| &self.parts[i] - &other.parts[i]) }
    }

    /// `-self`.
    pub fn neg(&self) -> Surd {
        Surd { parts: self.parts.each_ref().map(|part| -part) }
    }

    /// `self * other`: the basis is indexed by two bits, for sqrt 2 and sqrt 3; a bit in both factors gives 2 or 3.
    pub fn mul(&self, other: &Surd) -> Surd {
        let mut product = Surd::default();
        for (i, a) in self.parts.iter().enumerate().filter(|(_, a)| !a.is_zero()) {
            for (j, b) in other.parts.iter().enumerate().filter(|(_, b)| !b.is_zero()) {
                let square = [1, 2, 3, 6][i & j];
                product.parts[i ^ j] += a * b * BigRational::from_integer(square.into());
            }
        }
        product
    }

    /// The product of the three conjugates, and the norm: the rational product of this product and the number.
    pub fn adjugate(&self) -> (Surd, BigRational) {
        let [a, b, c, d] = &self.parts;
        let conjugate = |b: BigRational, c: BigRational, d: BigRational| Surd { parts: [a.clone(), b, c, d] };
        let [first, second, third] =
            [conjugate(-b, c.clone(), -d), conjugate(b.clone(), -c, -d), conjugate(-b, -c, d.clone())];
        let adjugate = first.mul(&second).mul(&third);
        let norm = self.mul(&adjugate).parts[0].clone();
        (adjugate, norm)
    }

    /// `self / divisor`; zero for a zero divisor.
    pub fn over(&self, divisor: &Surd) -> Surd {
        let (adjugate, norm) = divisor.adjugate();
        if norm.is_zero() {
            return Surd::default();
        }
        let product = self.mul(&adjugate);
        Surd { parts: product.parts.map(|part| part / &norm) }
    }

    /// The number with a relative error of 2^-80, also when its parts cancel.
    pub fn value(&self) -> BigRational {
        let irrational = self.parts[1..].iter().map(Signed::abs).sum::<BigRational>();
        let mut bits = BITS;
        loop {
            let unit = BigInt::one() << bits;
            let root = |n: u32| BigRational::new((BigInt::from(n) << (2 * bits)).sqrt(), unit.clone());
            let value: BigRational = self.parts.iter().zip([1, 2, 3, 6]).map(|(part, n)| part * root(n)).sum();
            // Each root is less than one unit below the true one.
            if value.abs() * &unit >= &irrational * (BigInt::one() << BITS) {
                return value;
            }
            bits *= 2;
        }
    }

    /// The number as a double.
    pub fn double(&self) -> f64 {
        self.value().to_f64().unwrap_or(f64::NAN)
    }

    /// The number itself if it is rational with a short denominator, else a rational one within 2^-80.
    pub fn nearby(&self) -> BigRational {
        match self.rational() {
            Some(rational) if rational.denom().bits() <= LONGEST => rational.clone(),
            _ => nearest(&self.value()),
        }
    }

    /// The number itself if its denominators are short, else a rational one within 2^-80. Otherwise products of general
    /// rotations would grow without limit.
    pub fn shortened(self) -> Surd {
        let is_short = self.parts.iter().all(|part| part.denom().bits() <= LONGEST);
        if is_short { self } else { Surd::from(&nearest(&self.value())) }
    }
}

/// The nearest multiple of 2^-80.
fn nearest(x: &BigRational) -> BigRational {
    let shifted: BigInt = x.numer() << BITS;
    let half: BigInt = x.denom() >> 1;
    BigRational::new((shifted + half).div_floor(x.denom()), BigInt::one() << BITS)
}

impl From<&BigRational> for Surd {
    fn from(rational: &BigRational) -> Self {
        let mut surd = Surd::default();
        surd.parts[0] = rational.clone();
        surd
    }
}

/// Three coordinates.
pub type SurdVector = [Surd; 3];

/// Converts a rational vector.
pub fn surds(vector: &ExactVector) -> SurdVector {
    vector.each_ref().map(Surd::from)
}

/// The unit vector of which `axis` is the decimal, to four places at least. Its entries must be 0, 1/2, sqrt 2 / 2,
/// sqrt 3 / 2 or 1 up to sign, and its direction irrational.
pub fn recognised(axis: &ExactVector) -> Option<SurdVector> {
    let half = Surd::from(&BigRational::new(1.into(), 2.into()));
    let known = [Surd::of(0, 0, 0), Surd::of(1, 0, 0), Surd::of(0, 1, 0), Surd::of(0, 0, 1), Surd::of(2, 0, 0)];
    let known: Vec<Surd> = known.iter().flat_map(|twice| [twice.mul(&half), twice.mul(&half).neg()]).collect();
    let read = |entry: &BigRational| known.iter().find(|surd| is_decimal_of(entry, &surd.value())).cloned();
    let [x, y, z] = axis.each_ref().map(read);
    let unit = [x?, y?, z?];
    let square = unit.iter().fold(Surd::default(), |sum, entry| sum.add(&entry.mul(entry)));
    let is_rational = directed(&unit).iter().all(|entry| entry.rational().is_some());
    (!is_rational && square == Surd::of(1, 0, 0)).then_some(unit)
}

/// The direction of a nonzero vector: its entries divided by the magnitude of the greatest one.
pub fn directed(vector: &SurdVector) -> SurdVector {
    let sizes = vector.each_ref().map(|entry| entry.double());
    let greatest = (0..3).max_by(|&i, &j| sizes[i].abs().total_cmp(&sizes[j].abs())).unwrap_or(0);
    let divisor = if sizes[greatest] < 0.0 { vector[greatest].neg() } else { vector[greatest].clone() };
    vector.each_ref().map(|entry| entry.over(&divisor))
}
