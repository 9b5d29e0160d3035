//! The exact law by which a joint follows another one of its chain (`mimic`): [`Coupling`].
//!
//! An angle that follows with an integer factor m and an offset b has `c + i s = e^(ib) (C + i S)^m` with C and S of its leader. So its cosine and sine are
//! polynomials in those of the leader. A prismatic joint that follows a prismatic joint is linear in it.

use num_traits::{One, ToPrimitive, Zero};

use super::arithmetic::{Arithmetic, Exact};
use groebot_algebra::number::BigRational;
use groebot_algebra::poly::rational_root;
use groebot_robot::kinematics::Mimic;

/// The law from the unknowns of a leader to those of a follower.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Coupling {
    /// The index of the leader.
    pub leader: usize,
    /// The law.
    pub law: Law,
}

/// The law of a [`Coupling`], in the unknowns of relations: c, s' = s / |w| and d' = d / |w| with the axis vector w of each joint.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Law {
    /// Both joints are revolute.
    Revolute {
        /// The number of rotations per rotation of the leader: not zero.
        times: i32,
        /// |w| of the leader over |w| of the follower.
        ratio: BigRational,
        /// |w|^2 of the follower.
        square: BigRational,
        /// c and s' of the offset.
        offset: [BigRational; 2],
    },
    /// Both joints are prismatic.
    Prismatic {
        /// d' of the follower for one of the leader.
        factor: BigRational,
        /// d' of the offset.
        offset: BigRational,
    },
}

impl Coupling {
    /// The law of `mimic` with the leader at index `leader`. The other arguments are, for the follower and the leader, whether they are revolute, and
    /// |w|^2.
    ///
    /// `None` if the law is not a polynomial over Q. This holds for a fractional factor of an angle, for a prismatic and a revolute joint, and for axis vectors
    /// whose lengths have an irrational ratio.
    pub(super) fn new(
        leader: usize,
        revolute: [bool; 2],
        [own, other]: [&BigRational; 2],
        mimic: &Mimic,
    ) -> Option<Self> {
        let (ratio, square) = (rational_root(&(other / own))?, own.clone());
        let root = square.to_f64().unwrap_or(1.0).sqrt();
        let law = match (revolute, mimic.whole()) {
            ([true, true], Some(times)) => {
                let offset = turned(mimic.offset.to_f64().unwrap_or(0.0), &square, root);
                Law::Revolute { times, ratio, square, offset }
            }
            ([false, false], _) => {
                let factor = &mimic.multiplier * ratio;
                Law::Prismatic { factor, offset: quotient(&mimic.offset, &square, root) }
            }
            _ => return None,
        };
        Some(Coupling { leader, law })
    }

    /// Whether the law is linear in the unknowns of the leader, so that these follow from the follower's.
    pub(crate) fn is_linear(&self) -> bool {
        match self.law {
            Law::Revolute { times, .. } => times.abs() == 1,
            Law::Prismatic { .. } => true,
        }
    }

    /// The follower's unknowns, c and s' or d', as functions of those of the leader.
    pub(crate) fn follow<A: Arithmetic>(&self, leader: &[A::Value], arithmetic: &mut A) -> Vec<A::Value> {
        match (&self.law, leader) {
            (Law::Revolute { times, ratio, square, offset }, [cosine, sine]) => {
                let signed = if *times < 0 { -ratio } else { ratio.clone() };
                let [scale, square] = [signed, square.clone()].map(|number| arithmetic.rational(&number));
                let rotation = [cosine.clone(), arithmetic.mul(&scale, sine)];
                let start = offset.each_ref().map(|number| arithmetic.rational(number));
                let next = |sum: [A::Value; 2], _| product(&sum, &rotation, &square, arithmetic);
                (0..times.unsigned_abs()).fold(start, next).to_vec()
            }
            (Law::Prismatic { factor, offset }, [length]) => {
                let [factor, offset] = [factor, offset].map(|number| arithmetic.rational(number));
                let share = arithmetic.mul(&factor, length);
                vec![arithmetic.add(&share, &offset)]
            }
            _ => Vec::new(),
        }
    }

    /// The coefficients of a linear law. For each unknown of the follower, c and s' or d': the coefficients of the leader's unknowns, then the constant.
    pub(super) fn coefficients(&self) -> Vec<Vec<BigRational>> {
        let count = if matches!(self.law, Law::Revolute { .. }) { 2 } else { 1 };
        let number = |here: bool| BigRational::from_integer(i32::from(here).into());
        let at = |own: usize| (0..count).map(|k| number(k == own)).collect::<Vec<_>>();
        let zero = self.follow(&at(count), &mut Exact);
        let columns: Vec<Vec<BigRational>> = (0..count).map(|own| self.follow(&at(own), &mut Exact)).collect();
        let row = |k: usize| columns.iter().map(|column| &column[k] - &zero[k]).chain([zero[k].clone()]).collect();
        (0..count).map(row).collect()
    }

    /// All constants of the law.
    pub(in crate::derive) fn numbers(&self) -> Vec<&BigRational> {
        match &self.law {
            Law::Revolute { ratio, square, offset: [c, s], .. } => vec![ratio, square, c, s],
            Law::Prismatic { factor, offset } => vec![factor, offset],
        }
    }
}

/// The product of two rotations, each by c and s' about axes of the same length.
fn product<A: Arithmetic>(
    a: &[A::Value; 2],
    b: &[A::Value; 2],
    square: &A::Value,
    arithmetic: &mut A,
) -> [A::Value; 2] {
    let [cc, ss, sc, cs] = [(0, 0), (1, 1), (1, 0), (0, 1)].map(|(i, j)| arithmetic.mul(&a[i], &b[j]));
    let across = arithmetic.mul(square, &ss);
    [arithmetic.sub(&cc, &across), arithmetic.add(&sc, &cs)]
}

/// c and s' of an angle, rounded to a rational point of `c^2 + n s'^2 = 1`, where n is `square`.
fn turned(angle: f64, square: &BigRational, root: f64) -> [BigRational; 2] {
    let half_turns = (angle / std::f64::consts::PI).round();
    let tangent = ((angle - half_turns * std::f64::consts::PI) / 2.0).tan();
    let quarter = (tangent.abs() - 1.0).abs() < 4.0 * f64::EPSILON;
    let tangent = if quarter { tangent.signum() } else { tangent };
    let tangent = quotient(&BigRational::from_float(tangent).unwrap_or_default(), square, root);
    let bent = square * &tangent * &tangent;
    let below = BigRational::one() + &bent;
    let sign = BigRational::from_integer(if half_turns % 2.0 == 0.0 { 1 } else { -1 }.into());
    [&sign * (BigRational::one() - bent) / &below, sign * (&tangent + &tangent) / below]
}

/// `number / root`, where `root` is that of `square`. Rounded if the root is irrational.
fn quotient(number: &BigRational, square: &BigRational, root: f64) -> BigRational {
    if number.is_zero() {
        return BigRational::zero();
    }
    let root = rational_root(square).or_else(|| BigRational::from_float(root)).unwrap_or_else(BigRational::one);
    number / root
}
