//! Exact rotations: quaternions up to scale (Euler-Rodrigues parameters) over Q(sqrt 2, sqrt 3), so that compositions
//! do not drift, and two rotations by 45 degrees are a quarter turn. Main types: [`ExactRotation`], [`Turn`].

use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::decimal::{integer, is_decimal_of, is_double_of};
use super::surd::{Surd, SurdVector};
use super::{ExactMatrix, ExactVector};
use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::{BigInt, BigRational, parse_rational};

/// pi to 60 decimals.
const PI: &str = "3.141592653589793238462643383279502884197169399375105820974944";
/// Maximum number of quarter turns: a million radians.
const GREATEST: i64 = 636_619;
/// Number of bits to which a quaternion, and the tangent of half an elementary rotation's angle, are rounded.
const BITS: u64 = 60;

/// The angle of an elementary rotation: an exact multiple of 15 degrees plus a remainder.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Turn {
    /// 0 to 23: a multiple of 2 or 3.
    steps: u8,
    /// The remainder in \[-pi/4, pi/4\] \[rad\].
    rest: f64,
    /// The steps of the exact angle that this angle approximates, if it differs. That angle has no remainder.
    meant: Option<u8>,
}

impl Turn {
    /// Builds the angle `degrees`; multiples of 30 and of 45 are exact.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] above a million radians.
    pub fn from_degrees(degrees: &BigRational) -> Result<Self> {
        let turns = (degrees / integer(15)).round();
        if *degrees == &turns * integer(15) && is_step(&turns) {
            return Turn::new(&turns, &BigRational::zero());
        }
        let quarters = (degrees / integer(90)).round();
        let rest = (degrees - &quarters * integer(90)) * pi() / integer(180);
        Turn::new(&(quarters * integer(6)), &rest)
    }

    /// Builds the angle `radians`. Within 1e-15 of a multiple of pi/4 or pi/6, as in doubles, it is the multiple. A
    /// rounded or truncated decimal of a multiple with at least four decimals (1.5708, 3.14159, -0.785398, 0.5236) is
    /// not replaced, but [stands for](Turn::meant) the multiple.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] above a million radians.
    pub fn from_radians(radians: &BigRational) -> Result<Self> {
        let step = pi() / integer(12);
        let turns = (radians / &step).round();
        let exact = step * &turns;
        if is_step(&turns) && is_double_of(radians, &exact) {
            return Turn::new(&turns, &BigRational::zero());
        }
        let general = Turn::general(radians)?;
        let is_rounded = is_step(&turns) && is_decimal_of(radians, &exact);
        Ok(Turn { meant: is_rounded.then(|| whole_steps(&turns)), ..general })
    }

    fn general(radians: &BigRational) -> Result<Self> {
        let quarter = pi() / integer(2);
        let quarters = (radians / &quarter).round();
        let rest = radians - quarter * &quarters;
        Turn::new(&(quarters * integer(6)), &rest)
    }

    /// The multiple of pi/4 or pi/6 of which it is the rounded decimal; otherwise the angle itself.
    #[must_use]
    pub fn meant(self) -> Self {
        self.meant.map_or(self, |steps| Turn { steps, ..Turn::default() })
    }

    fn new(steps: &BigRational, rest: &BigRational) -> Result<Self> {
        if steps.abs() > integer(6 * GREATEST) {
            return Err(Error::new(ErrorKind::BadValue, "the angle is too large; give at most a million radians"));
        }
        Ok(Turn { steps: whole_steps(steps), rest: rest.to_f64().unwrap_or(0.0), meant: None })
    }

    /// Whether it is a multiple of 45 or of 30 degrees, whose rotation is exact. Any other rotation is exactly
    /// orthogonal too, and within 1e-15 of the true one.
    pub fn is_exact(self) -> bool {
        self.rest == 0.0
    }

    /// Whether it is a multiple of a quarter turn, whose rotation has integer entries.
    pub fn is_quarter(self) -> bool {
        self.is_exact() && self.steps.is_multiple_of(6)
    }

    /// The angle in degrees, in \[0, 360), when it is exact.
    pub fn degrees(self) -> Option<u16> {
        self.is_exact().then(|| 15 * u16::from(self.steps))
    }

    /// The cosine and sine of half the angle, up to scale: tan 15 = 2 - sqrt 3, tan 22.5 = sqrt 2 - 1, tan 30 = 1 / sqrt 3.
    fn half(self) -> (Surd, Surd) {
        let (c, s) = match self.steps % 6 {
            0 if self.rest == 0.0 => (Surd::of(1, 0, 0), Surd::default()),
            2 => (Surd::of(1, 0, 0), Surd::of(2, 0, -1)),
            3 => (Surd::of(1, 0, 0), Surd::of(-1, 1, 0)),
            4 => (Surd::of(0, 0, 1), Surd::of(1, 0, 0)),
            _ => {
                let tangent = BigRational::from_float((self.rest / 2.0).tan()).unwrap_or_default();
                let (sine, cosine) = shortest_fraction(&tangent).into_raw();
                let whole = |n: BigInt| Surd::from(&BigRational::from_integer(n));
                (whole(cosine), whole(sine))
            }
        };
        match self.steps / 6 {
            0 => (c, s),
            1 => (c.sub(&s), c.add(&s)),
            2 => (s.neg(), c),
            _ => (c.add(&s), s.sub(&c)),
        }
    }
}

/// The number of steps of 15 degrees modulo full turns.
fn whole_steps(steps: &BigRational) -> u8 {
    steps.to_integer().mod_floor(&BigInt::from(24)).to_u8().unwrap_or(0)
}

/// Whether a number of steps of 15 degrees is a multiple of 30 or of 45 degrees.
fn is_step(steps: &BigRational) -> bool {
    let steps = steps.to_integer();
    [2, 3].iter().any(|n| (&steps % BigInt::from(*n)).is_zero())
}

/// The cosine and sine of half the angle of the direction (`cosine`, `sine`), up to scale, in integers. Their quotient
/// is within 2^-60.
fn half_of(cosine: &BigRational, sine: &BigRational) -> [BigInt; 2] {
    let length = root(&(cosine.pow(2) + sine.pow(2)));
    let [c, s] = if cosine.is_negative() {
        let s = length - cosine;
        if sine.is_negative() { [-sine, -s] } else { [sine.clone(), s] }
    } else {
        [length + cosine, sine.clone()]
    };
    if c.abs() >= s.abs() {
        let (s, c) = shortest_fraction(&(s / c)).into_raw();
        [c, s]
    } else {
        shortest_fraction(&(c / s)).into_raw().into()
    }
}

/// The square root of a nonnegative number, within 2^-80 of the larger of one and the root.
fn root(square: &BigRational) -> BigRational {
    let scaled = (square * BigRational::from_integer(BigInt::one() << 160)).to_integer();
    BigRational::new(scaled.sqrt(), BigInt::one() << 80)
}

/// The first convergent of the continued fraction of `number` that is within 2^-60 of it. The sign is that of `number`.
fn shortest_fraction(number: &BigRational) -> BigRational {
    let enough = BigRational::new(BigInt::one(), BigInt::one() << BITS);
    let size = number.abs();
    let mut rest = size.clone();
    let mut last = [BigInt::zero(), BigInt::one()];
    let mut convergent = [BigInt::one(), BigInt::zero()];
    loop {
        let whole = rest.floor().to_integer();
        let next = [0, 1].map(|part| &whole * &convergent[part] + &last[part]);
        last = std::mem::replace(&mut convergent, next);
        let fraction = BigRational::new(convergent[0].clone(), convergent[1].clone());
        if (&fraction - &size).abs() <= enough {
            return if number.is_negative() { -fraction } else { fraction };
        }
        rest = (rest - BigRational::from_integer(whole)).recip();
    }
}

fn pi() -> BigRational {
    parse_rational(PI).unwrap_or_default()
}

/// The numerators of `numbers` over their least common denominator, and this denominator.
pub fn over_common<const N: usize>(numbers: [&BigRational; N]) -> ([BigInt; N], BigInt) {
    let common = numbers.iter().fold(BigInt::one(), |common, number| common.lcm(number.denom()));
    (numbers.map(|number| number.numer() * (&common / number.denom())), common)
}

/// An exact rotation: quarter turns, multiples of 45 and 30 degrees, rational quaternions, and all their products.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExactRotation {
    /// w, x, y, z up to scale. Their rational parts are coprime integers, and the first nonzero one is positive.
    quaternion: [Surd; 4],
}

impl ExactRotation {
    /// The identity.
    pub fn identity() -> Self {
        ExactRotation { quaternion: [1, 0, 0, 0].map(|n| Surd::of(n, 0, 0)) }
    }

    /// The rotation by `turn` about a coordinate axis: 0, 1, 2 (modulo 3) for x, y, z.
    pub fn about(axis: usize, turn: Turn) -> Self {
        let (cosine, sine) = turn.half();
        let mut quaternion = [cosine, Surd::default(), Surd::default(), Surd::default()];
        quaternion[1 + axis % 3] = sine;
        ExactRotation { quaternion }.reduced()
    }

    /// Rz(yaw) Ry(pitch) Rx(roll), the rotation of a URDF `rpy`. If one angle is general, each of the three is rounded
    /// to a rational rotation.
    pub fn from_rpy(turns: [Turn; 3]) -> Self {
        let is_exact = turns.iter().all(|turn| turn.is_exact());
        let [roll, pitch, yaw] = turns;
        let about = |axis, turn| {
            let rotation = ExactRotation::about(axis, turn);
            if is_exact { rotation } else { rotation.made_rational() }
        };
        about(2, yaw).then(&about(1, pitch)).then(&about(0, roll))
    }

    /// The rotation of the quaternion `xyzw`, of any length, to 60 bits; `None` for zero.
    pub fn from_quaternion([x, y, z, w]: &[BigRational; 4]) -> Option<Self> {
        let quaternion = [w, x, y, z].map(Surd::from);
        quaternion.iter().any(|part| !part.is_zero()).then(|| ExactRotation { quaternion }.reduced().rounded())
    }

    /// The product: first `inner`, then this one.
    #[must_use]
    pub fn then(&self, inner: &ExactRotation) -> Self {
        let ([a, b, c, d], [e, f, g, h]) = (&self.quaternion, &inner.quaternion);
        let sum = |[p, q, r, s]: [Surd; 4]| p.add(&q).add(&r).add(&s);
        let quaternion = [
            sum([a.mul(e), b.mul(f).neg(), c.mul(g).neg(), d.mul(h).neg()]),
            sum([a.mul(f), b.mul(e), c.mul(h), d.mul(g).neg()]),
            sum([a.mul(g), b.mul(h).neg(), c.mul(e), d.mul(f)]),
            sum([a.mul(h), b.mul(g), c.mul(f).neg(), d.mul(e)]),
        ];
        ExactRotation { quaternion }.reduced()
    }

    /// The inverse rotation.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let [w, x, y, z] = &self.quaternion;
        ExactRotation { quaternion: [w.clone(), x.neg(), y.neg(), z.neg()] }.reduced()
    }

    /// `vector`, rotated by [`ExactRotation::matrix`].
    pub fn turn(&self, vector: &ExactVector) -> ExactVector {
        self.matrix().map(|row| row.iter().zip(vector).map(|(entry, x)| entry * x).sum())
    }

    /// `vector`, rotated exactly.
    pub(crate) fn turned(&self, vector: &SurdVector) -> SurdVector {
        let (rows, scale) = self.scaled_matrix();
        rows.map(|row| {
            let terms = row.iter().zip(vector).map(|(entry, x)| entry.mul(x));
            terms.fold(Surd::default(), |sum, term| sum.add(&term)).over(&scale)
        })
    }

    /// The matrix, row by row: exactly orthogonal and rational. It is the rotation itself if that is rational, else
    /// within 1e-17.
    pub fn matrix(&self) -> ExactMatrix {
        let (rows, scale) =
            if self.is_rational() { self.scaled_matrix() } else { self.clone().rounded().scaled_matrix() };
        rows.map(|row| row.map(|entry| &entry.parts[0] / &scale.parts[0]))
    }

    /// Whether its matrix is rational.
    fn is_rational(&self) -> bool {
        self.quaternion.iter().all(|part| part.rational().is_some())
    }

    /// The matrix times the second value, |quaternion|^2, by the Euler-Rodrigues formula.
    fn scaled_matrix(&self) -> ([[Surd; 3]; 3], Surd) {
        let [w, x, y, z] = &self.quaternion;
        let [ww, xx, yy, zz] = [w, x, y, z].map(|part| part.mul(part));
        let twice = |a: Surd| a.add(&a);
        let square = |signs: [bool; 3]| {
            let parts = [&xx, &yy, &zz].into_iter().zip(signs);
            parts.fold(ww.clone(), |sum, (part, plus)| if plus { sum.add(part) } else { sum.sub(part) })
        };
        let [xy, xz, yz, wx, wy, wz] = [x.mul(y), x.mul(z), y.mul(z), w.mul(x), w.mul(y), w.mul(z)];
        let rows = [
            [square([true, false, false]), twice(xy.sub(&wz)), twice(xz.add(&wy))],
            [twice(xy.add(&wz)), square([false, true, false]), twice(yz.sub(&wx))],
            [twice(xz.sub(&wy)), twice(yz.add(&wx)), square([false, false, true])],
        ];
        (rows, square([true; 3]))
    }

    /// Normalises the quaternion to its unique form.
    fn reduced(self) -> Self {
        let first = self.quaternion.iter().find(|part| !part.is_zero()).filter(|part| part.rational().is_none());
        let factor = first.map_or(Surd::of(1, 0, 0), |first| first.adjugate().0);
        let quaternion = self.quaternion.each_ref().map(|part| part.mul(&factor));
        let parts = || quaternion.iter().flat_map(|part| &part.parts);
        let common = parts().fold(BigInt::one(), |common, part| common.lcm(part.denom()));
        let divisor =
            parts().fold(BigInt::zero(), |divisor, part| divisor.gcd(&(part.numer() * (&common / part.denom()))));
        let is_negative = parts().find(|part| !part.is_zero()).is_some_and(Signed::is_negative);
        let scale = BigRational::new(if is_negative { -common } else { common }, divisor.max(BigInt::one()));
        ExactRotation { quaternion: quaternion.map(|part| Surd { parts: part.parts.map(|part| part * &scale) }) }
    }

    /// Whether its quaternion has long numbers: the product of several general rotations.
    pub(crate) fn is_long(&self) -> bool {
        self.quaternion.iter().flat_map(|part| &part.parts).any(|part| part.numer().bits() > 2 * BITS)
    }

    /// Rounds the quaternion to 120 bits if it is long.
    pub(crate) fn shortened(self) -> Self {
        if self.is_long() { self.to_bits(2 * BITS) } else { self }
    }

    /// The rotation itself if its entries are rational, else a rational one within 1e-17. Roll, pitch and yaw are
    /// rounded separately, so that an axis in a coordinate plane stays in it.
    pub(crate) fn made_rational(self) -> Self {
        if self.is_rational() {
            return self;
        }
        let m = self.scaled_matrix().0.map(|row| row.map(|entry| entry.value()));
        let is_upright = m[0][0].is_zero() && m[1][0].is_zero();
        let level = root(&(m[0][0].pow(2) + m[1][0].pow(2)));
        let (yaw, roll) = if is_upright {
            (half_of(&BigRational::one(), &BigRational::zero()), half_of(&m[1][1], &-&m[1][2]))
        } else {
            (half_of(&m[0][0], &m[1][0]), half_of(&m[2][2], &m[2][1]))
        };
        let about = |axis: usize, [cosine, sine]: [BigInt; 2]| {
            let mut quaternion = [cosine, BigInt::zero(), BigInt::zero(), BigInt::zero()];
            quaternion[1 + axis] = sine;
            ExactRotation { quaternion: quaternion.map(|n| Surd::from(&BigRational::from_integer(n))) }
        };
        about(2, yaw).then(&about(1, half_of(&level, &-&m[2][0]))).then(&about(0, roll))
    }

    /// The nearest rotation with rational entries, to [`BITS`] bits.
    fn rounded(self) -> Self {
        self.to_bits(BITS)
    }

    fn to_bits(self, kept: u64) -> Self {
        let values = self.quaternion.each_ref().map(Surd::value);
        let (integers, _) = over_common(values.each_ref());
        let bits = integers.iter().map(BigInt::bits).max().unwrap_or(0);
        let Some(excess) = bits.checked_sub(kept).filter(|excess| *excess > 0) else { return self };
        let half = BigInt::one() << (excess - 1);
        let round = |part: BigInt| Surd::from(&BigRational::from_integer((part + &half) >> excess));
        ExactRotation { quaternion: integers.map(round) }.reduced()
    }
}
