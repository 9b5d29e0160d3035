//! Exactly orthogonal rational rotations: integer quaternions up to scale (Euler-Rodrigues parameters), so that nothing drifts
//! however many are composed. Main types: [`ExactRotation`], [`Turn`].

use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::{ExactMatrix, ExactVector};
use crate::number::{BigInt, BigRational, parse_rational};
use crate::{Error, ErrorKind, Result};

/// pi to 60 decimals.
const PI: &str = "3.141592653589793238462643383279502884197169399375105820974944";
/// The fewest decimals that a rounded multiple of pi/2 must have to be taken for the exact one.
const DECIMALS: usize = 4;
/// The most decimals that are looked at.
const MOST_DECIMALS: usize = 40;
/// The most quarter turns: a million radians.
const GREATEST: i64 = 636_619;
/// The bits that a quaternion of general angles is rounded to.
const BITS: u64 = 60;
/// 2^60, the scale of the cosine and sine of half a rest.
const SCALE: f64 = 1_152_921_504_606_846_976.0;

/// The angle of an elementary rotation: quarter turns, which are exact, and a rest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Turn {
    /// 0 to 3.
    quarters: u8,
    /// What is left, in \[-pi/4, pi/4\] \[rad\].
    rest: f64,
}

impl Turn {
    /// The angle `degrees`; multiples of 90 are exact.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] beyond a million radians.
    pub fn from_degrees(degrees: &BigRational) -> Result<Self> {
        let turns = (degrees / integer(90)).round();
        let rest = (degrees - &turns * integer(90)) * pi() / integer(180);
        Turn::new(&turns, &rest)
    }

    /// The angle `radians`. It is taken for the multiple k pi/2 when it is the rounded or truncated decimal of k pi/2 with at
    /// least four decimals (1.5708, 3.14159, -1.570796), or within 1e-15 of it.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] beyond a million radians.
    pub fn from_radians(radians: &BigRational) -> Result<Self> {
        let quarter = pi() / integer(2);
        let turns = (radians / &quarter).round();
        let whole = &quarter * &turns;
        let rest = if is_decimal_of(radians, &whole) { BigRational::zero() } else { radians - whole };
        Turn::new(&turns, &rest)
    }

    fn new(turns: &BigRational, rest: &BigRational) -> Result<Self> {
        if turns.abs() > integer(GREATEST) {
            return Err(Error::new(ErrorKind::BadValue, "the angle is too large; give at most a million radians"));
        }
        let quarters = turns.to_integer().mod_floor(&BigInt::from(4)).to_u8().unwrap_or(0);
        Ok(Turn { quarters, rest: rest.to_f64().unwrap_or(0.0) })
    }

    /// Whether it is a whole number of quarter turns: its rotation is the true one. Any other rotation is exactly orthogonal too,
    /// and within 1e-15 of the true one.
    pub fn is_exact(self) -> bool {
        self.rest == 0.0
    }

    /// The cosine and sine of half the angle, as integers up to scale.
    fn half(self) -> (BigInt, BigInt) {
        let [c, s] =
            [(self.rest / 2.0).cos(), (self.rest / 2.0).sin()].map(|x| BigInt::from((x * SCALE).round() as i64));
        match self.quarters {
            0 => (c, s),
            1 => (&c - &s, c + s),
            2 => (-s, c),
            _ => (&c + &s, s - c),
        }
    }
}

/// Whether `given` is within 1e-15 of `exact`, or is its rounded or truncated decimal with enough decimals.
fn is_decimal_of(given: &BigRational, exact: &BigRational) -> bool {
    if (given - exact).abs() * integer(1_000_000_000_000_000) <= integer(1) {
        return true;
    }
    let mut shift = BigRational::one();
    for decimals in 0..=MOST_DECIMALS {
        let digits = given * &shift;
        if digits.is_integer() {
            let wanted = exact * shift;
            return decimals >= DECIMALS && (digits == wanted.round() || digits == wanted.trunc());
        }
        shift *= integer(10);
    }
    false
}

fn integer(n: i64) -> BigRational {
    BigRational::from_integer(n.into())
}

fn pi() -> BigRational {
    parse_rational(PI).unwrap_or_default()
}

/// The numerators of `numbers` over their least common denominator, and this.
pub fn over_common<const N: usize>(numbers: [&BigRational; N]) -> ([BigInt; N], BigInt) {
    let common = numbers.iter().fold(BigInt::one(), |common, number| common.lcm(number.denom()));
    (numbers.map(|number| number.numer() * (&common / number.denom())), common)
}

/// A rotation whose matrix has rational entries and is exactly orthogonal.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExactRotation {
    /// w, x, y, z: coprime integers; the unit quaternion is this over its length.
    quaternion: [BigInt; 4],
}

impl ExactRotation {
    /// The rotation that moves nothing.
    pub fn identity() -> Self {
        ExactRotation { quaternion: [1, 0, 0, 0].map(BigInt::from) }
    }

    /// The rotation by `turn` about a coordinate axis: 0, 1, 2 (modulo 3) for x, y, z.
    pub fn about(axis: usize, turn: Turn) -> Self {
        let (cosine, sine) = turn.half();
        let mut quaternion = [cosine, BigInt::zero(), BigInt::zero(), BigInt::zero()];
        quaternion[1 + axis % 3] = sine;
        ExactRotation { quaternion }.reduced()
    }

    /// Rz(yaw) Ry(pitch) Rx(roll), the rotation of a URDF `rpy`. Two or more general angles are rounded together, to 60 bits.
    pub fn from_rpy([roll, pitch, yaw]: [Turn; 3]) -> Self {
        let about = ExactRotation::about;
        about(2, yaw).then(&about(1, pitch)).then(&about(0, roll)).rounded()
    }

    /// The rotation of the quaternion `xyzw`, of any length, to 60 bits; `None` for zero.
    pub fn from_quaternion([x, y, z, w]: &[BigRational; 4]) -> Option<Self> {
        let (quaternion, _) = over_common([w, x, y, z]);
        quaternion.iter().any(|part| !part.is_zero()).then(|| ExactRotation { quaternion }.reduced().rounded())
    }

    /// The product: first `inner`, then this one.
    #[must_use]
    pub fn then(&self, inner: &ExactRotation) -> Self {
        let ([a, b, c, d], [e, f, g, h]) = (&self.quaternion, &inner.quaternion);
        let quaternion = [
            a * e - b * f - c * g - d * h,
            a * f + b * e + c * h - d * g,
            a * g - b * h + c * e + d * f,
            a * h + b * g - c * f + d * e,
        ];
        ExactRotation { quaternion }.reduced()
    }

    /// The opposite rotation.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let [w, x, y, z] = &self.quaternion;
        ExactRotation { quaternion: [w.clone(), -x, -y, -z] }
    }

    /// `vector`, rotated.
    pub fn turn(&self, vector: &ExactVector) -> ExactVector {
        let (rows, scale) = self.scaled_matrix();
        let (numerators, common) = over_common(vector.each_ref());
        let divisor = scale * common;
        rows.map(|row| {
            let entry: BigInt = row.iter().zip(&numerators).map(|(factor, x)| factor * x).sum();
            BigRational::new(entry, divisor.clone())
        })
    }

    /// The matrix, by rows.
    pub fn matrix(&self) -> ExactMatrix {
        let (rows, scale) = self.scaled_matrix();
        rows.map(|row| row.map(|entry| BigRational::new(entry, scale.clone())))
    }

    /// The matrix times the second value, |quaternion|^2: the formula of Euler and Rodrigues.
    fn scaled_matrix(&self) -> ([[BigInt; 3]; 3], BigInt) {
        let [w, x, y, z] = &self.quaternion;
        let [ww, xx, yy, zz] = [w * w, x * x, y * y, z * z];
        let twice = |n: BigInt| n * 2;
        let rows = [
            [&ww + &xx - &yy - &zz, twice(x * y - w * z), twice(x * z + w * y)],
            [twice(x * y + w * z), &ww - &xx + &yy - &zz, twice(y * z - w * x)],
            [twice(x * z - w * y), twice(y * z + w * x), &ww - &xx - &yy + &zz],
        ];
        (rows, ww + xx + yy + zz)
    }

    fn reduced(mut self) -> Self {
        let common = self.quaternion.iter().fold(BigInt::zero(), |common, part| common.gcd(part));
        if !common.is_one() {
            self.quaternion = self.quaternion.map(|part| part / &common);
        }
        self
    }

    /// The same rotation to [`BITS`] bits.
    fn rounded(self) -> Self {
        let bits = self.quaternion.iter().map(BigInt::bits).max().unwrap_or(0);
        let Some(excess) = bits.checked_sub(BITS).filter(|excess| *excess > 0) else { return self };
        let half = BigInt::one() << (excess - 1);
        ExactRotation { quaternion: self.quaternion.map(|part| (part + &half) >> excess) }.reduced()
    }
}
