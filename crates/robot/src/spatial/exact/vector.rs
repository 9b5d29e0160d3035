//! Exact vectors: sums, products and lines, for exact zero tests. The vector type is [`ExactVector`].

use num_traits::{One, ToPrimitive, Zero};

use super::rotation::over_common;
use super::{ExactMatrix, ExactVector};
use groebot_algebra::number::{BigInt, BigRational};

/// The vector of zeros.
pub fn zero() -> ExactVector {
    std::array::from_fn(|_| BigRational::zero())
}

/// The unit vector along a coordinate axis: 0, 1, 2 for x, y, z.
pub fn unit(axis: usize) -> ExactVector {
    std::array::from_fn(|k| if k == axis { BigRational::one() } else { BigRational::zero() })
}

/// The identity matrix.
pub fn identity() -> ExactMatrix {
    std::array::from_fn(unit)
}

/// `a + b`.
pub fn add(a: &ExactVector, b: &ExactVector) -> ExactVector {
    std::array::from_fn(|i| &a[i] + &b[i])
}

/// `a - b`.
pub fn sub(a: &ExactVector, b: &ExactVector) -> ExactVector {
    std::array::from_fn(|i| &a[i] - &b[i])
}

/// `factor a`.
pub fn scale(a: &ExactVector, factor: &BigRational) -> ExactVector {
    a.each_ref().map(|x| x * factor)
}

/// `a . b`.
pub fn dot(a: &ExactVector, b: &ExactVector) -> BigRational {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// `a x b`.
pub fn cross(a: &ExactVector, b: &ExactVector) -> ExactVector {
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        &a[j] * &b[k] - &a[k] * &b[j]
    })
}

/// The matrix, given by rows, times `a`.
pub fn turn(matrix: &ExactMatrix, a: &ExactVector) -> ExactVector {
    matrix.each_ref().map(|row| dot(row, a))
}

/// Whether all entries are zero.
pub fn is_zero(a: &ExactVector) -> bool {
    a.iter().all(Zero::is_zero)
}

/// The length.
pub fn length(a: &ExactVector) -> f64 {
    root(&dot(a, a))
}

/// The square root of a nonnegative number.
pub fn root(square: &BigRational) -> f64 {
    square.to_f64().unwrap_or(f64::INFINITY).sqrt()
}

/// The square root of a quotient that is not reduced to lowest terms.
fn ratio(a: &BigRational, b: &BigRational) -> f64 {
    root(&BigRational::new_raw(a.numer() * b.denom(), a.denom() * b.numer()))
}

/// The nonnegative sine of the angle between two nonzero vectors; exactly zero when they are parallel.
pub fn sine(a: &ExactVector, b: &ExactVector) -> f64 {
    share(a, b, |product, lengths| lengths - product)
}

/// The magnitude of the cosine of that angle; exactly zero when they are perpendicular.
pub fn cosine(a: &ExactVector, b: &ExactVector) -> f64 {
    share(a, b, |product, _| product.clone())
}

/// The square root of `part` divided by |a|^2 |b|^2. `part` gets (a . b)^2 and this product, in integers, which need no
/// gcd.
fn share(a: &ExactVector, b: &ExactVector, part: impl Fn(&BigInt, &BigInt) -> BigInt) -> f64 {
    let [a, b] = [a, b].map(|vector| over_common(vector.each_ref()).0);
    let dot = |a: &[BigInt; 3], b: &[BigInt; 3]| -> BigInt { a.iter().zip(b).map(|(x, y)| x * y).sum() };
    let (product, lengths) = (dot(&a, &b).pow(2), dot(&a, &a) * dot(&b, &b));
    root(&BigRational::new_raw(part(&product, &lengths), lengths))
}

/// Formats a vector as `[1/2, 0, 1]`.
pub fn show(vector: &ExactVector) -> String {
    let [x, y, z] = vector.each_ref().map(|entry| match entry.to_string() {
        short if short.len() <= 24 => short,
        _ => entry.to_f64().unwrap_or(f64::NAN).to_string(),
    });
    format!("[{x}, {y}, {z}]")
}

/// A line in space.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// A point of it.
    pub point: ExactVector,
    /// Its direction, of any length.
    pub direction: ExactVector,
}

impl Line {
    /// The point of the line nearest to `p`.
    pub fn foot(&self, p: &ExactVector) -> ExactVector {
        let along = dot(&sub(p, &self.point), &self.direction) / dot(&self.direction, &self.direction);
        add(&self.point, &scale(&self.direction, &along))
    }

    /// The distance of `p` from the line; exactly zero on the line.
    pub fn distance(&self, p: &ExactVector) -> f64 {
        let moment = cross(&sub(p, &self.point), &self.direction);
        ratio(&dot(&moment, &moment), &dot(&self.direction, &self.direction))
    }

    /// The point of this line nearest to another line that is not parallel.
    pub fn nearest(&self, other: &Line) -> ExactVector {
        let normal = cross(&self.direction, &other.direction);
        let apart = sub(&other.point, &self.point);
        let along = dot(&cross(&apart, &other.direction), &normal) / dot(&normal, &normal);
        add(&self.point, &scale(&self.direction, &along))
    }

    /// The distance from a line that is not parallel; exactly zero when they intersect.
    pub fn gap(&self, other: &Line) -> f64 {
        let normal = cross(&self.direction, &other.direction);
        let volume = dot(&sub(&other.point, &self.point), &normal);
        ratio(&(&volume * &volume), &dot(&normal, &normal))
    }
}
