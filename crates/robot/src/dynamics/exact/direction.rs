//! Directions over the rational numbers and square roots of small primes. Main type: [`Direction`].

use std::sync::Arc;

use num_bigint::BigInt;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::number::{Exact, Setting, root_name};
use crate::dynamics::recursions::{Matrix, Scalar};
use crate::spatial::exact::{ExactVector, vector};
use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::BigRational;

/// The largest prime whose square root is used.
const MOST_PRIME: u32 = 1000;

/// A direction as its vector divided by its length, and a rotation that maps the z axis to it.
pub(super) struct Direction {
    vector: ExactVector,
    length: Root,
    upright: Upright,
}

/// A rotation whose last column is a direction.
enum Upright {
    /// For a coordinate axis.
    Axes,
    /// The first column is perpendicular to the direction: a vector divided by its length.
    Across(Box<ExactVector>, Root),
    /// The half turn about the bisector of z and the direction, which is a rational unit vector.
    Midway,
}

impl Direction {
    pub(super) fn of(vector: &ExactVector, name: &str) -> Result<Self> {
        let fault = |error: Error| error.with_context(format!("`{name}`"));
        let length = Root::of(&square(vector)).map_err(fault)?;
        if vector.iter().filter(|x| x.is_zero()).count() == 2 {
            return Ok(Direction { vector: vector.clone(), length, upright: Upright::Axes });
        }
        let across = across(vector);
        let upright = match Root::of(&square(&across)) {
            Ok(other) => Upright::Across(Box::new(across), other),
            Err(_) if length.primes.is_empty() => Upright::Midway,
            Err(error) => return Err(fault(error)),
        };
        Ok(Direction { vector: vector.clone(), length, upright })
    }

    pub(super) fn primes(&self) -> impl Iterator<Item = u32> {
        let across = if let Upright::Across(_, length) = &self.upright { &length.primes[..] } else { &[] };
        self.length.primes.iter().chain(across).copied()
    }

    pub fn unit(&self, setting: &Arc<Setting>) -> [Exact; 3] {
        over(&self.vector, &self.length, setting)
    }

    /// A rotation whose last column is the direction.
    pub(super) fn upright(&self, setting: &Arc<Setting>) -> Matrix<Exact> {
        let z = self.unit(setting);
        let x = match &self.upright {
            Upright::Across(across, length) => over(across, length, setting),
            Upright::Axes => {
                let along = self.vector.iter().position(|x| !x.is_zero()).unwrap_or(2);
                std::array::from_fn(|i| if i == (along + 1) % 3 { Exact::one() } else { Exact::zero() })
            }
            Upright::Midway => self.midway().map(Exact::from),
        };
        let y: [Exact; 3] = std::array::from_fn(|i| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            z[j].clone() * x[k].clone() - z[k].clone() * x[j].clone()
        });
        std::array::from_fn(|i| [x[i].clone(), y[i].clone(), z[i].clone()])
    }

    /// The first column of the half turn that maps z to a rational unit vector u. With w = z + u, the half turn is 2 w
    /// w' / w'w - 1.
    fn midway(&self) -> ExactVector {
        let unit = self.vector.each_ref().map(|x| x / &self.length.rational);
        let [x, y, z] = &unit;
        // u has three nonzero entries, so 1 + z is not zero.
        let factor = x / (BigRational::one() + z);
        [&factor * x - BigRational::one(), &factor * y, x.clone()]
    }
}

fn square(vector: &ExactVector) -> BigRational {
    vector.iter().map(|x| x * x).sum()
}

/// A vector perpendicular to one that is not along a coordinate axis: in the plane of two of its coordinates, or a
/// coordinate axis where one of them is zero.
fn across(vector: &ExactVector) -> ExactVector {
    let last = (0..3).find(|&i| vector[i].is_zero()).unwrap_or(2);
    let mut across = vector::zero();
    if vector[last].is_zero() {
        across[last] = BigRational::one();
    } else {
        (across[0], across[1]) = (-vector[1].clone(), vector[0].clone());
    }
    across
}

fn over(vector: &ExactVector, length: &Root, setting: &Arc<Setting>) -> [Exact; 3] {
    let inverse = length.inverse(setting);
    vector.clone().map(|entry| Exact::from(entry) * inverse.clone())
}

/// The positive square root of a rational number: a rational number times square roots of primes.
struct Root {
    rational: BigRational,
    primes: Vec<u32>,
}

impl Root {
    fn of(square: &BigRational) -> Result<Self> {
        let unsupported = || {
            let length = square.to_f64().unwrap_or(f64::NAN).sqrt();
            let text = format!(
                "its length {length} is not a rational number times roots of primes up to {MOST_PRIME}; give a simpler direction"
            );
            Error::new(ErrorKind::Unsupported, text)
        };
        if !square.is_positive() {
            return Err(Error::new(ErrorKind::BadValue, "a direction of length zero; give another one"));
        }
        // sqrt(n / d) = sqrt(n d) / d
        let mut left = square.numer() * square.denom();
        let (mut whole, mut primes) = (BigInt::one(), Vec::new());
        for prime in groebot_algebra::number::primes_below(u64::from(MOST_PRIME) + 1) {
            let prime = u32::try_from(prime).map_err(|_| unsupported())?;
            while (&left % (prime * prime)).is_zero() {
                left /= prime * prime;
                whole *= prime;
            }
            if (&left % prime).is_zero() {
                left /= prime;
                primes.push(prime);
            }
        }
        let root = left.sqrt();
        if &root * &root != left {
            return Err(unsupported());
        }
        primes.sort_unstable();
        Ok(Root { rational: BigRational::new(whole * root, square.denom().clone()), primes })
    }

    /// Its reciprocal.
    fn inverse(&self, setting: &Arc<Setting>) -> Exact {
        let product = self.primes.iter().fold(BigInt::one(), |product, prime| product * prime);
        let rational = (&self.rational * BigRational::from_integer(product)).recip();
        let roots = self.primes.iter().map(|prime| setting.variable(&root_name(*prime)));
        roots.fold(Exact::from(rational), |product, root| product * root)
    }
}
