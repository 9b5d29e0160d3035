//! The proof that a formulation finds every solution of a generic target: its pencil is regular ([`Determinant`]).
//!
//! The equations are polynomials in the target's coordinates, the hidden half angle and the chain's constants. Suppose that their determinant is nonzero at one
//! target and one half angle modulo a prime. Then it is not the zero polynomial over Q. At a generic target it vanishes for at most sixteen half angles, and
//! that of every solution is among them.

use serde::{Deserialize, Serialize};

use super::given::Six;
use super::profile::{Frame, STILL};
use super::residue::Residue;
use super::rows::{Doubled, FAR, MOVING, Row, Rows};
use super::screw::{Axis, Figure};
use super::vector::dot;
use crate::solver::eigenvalue::Formulation;
use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::Zp;
use groebot_algebra::random::SplitMix64;
use groebot_robot::kinematics::{Chain, Joint, JointKind};

/// The number of rows and columns of a pencil before elimination.
const ALL: usize = 2 * (STILL + MOVING);
/// The number of columns of the near joints.
const NEAR: usize = ALL - 2 * FAR;

/// The determinant of a formulation's equations at a random reachable target and a random half angle, modulo a prime.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Determinant {
    /// The prime.
    pub prime: u64,
    /// The random seed of the target and the half angle.
    pub seed: u64,
    /// The determinant modulo the prime.
    pub value: u64,
}

impl Determinant {
    /// Evaluates the determinant of `formulation` for `chain`, which has six joints that are not given. The formulation must be valid. Given joints between
    /// them have random values.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] if the prime divides a denominator of the chain, or if a random number is zero; as [`fits`](super::fits).
    pub fn evaluate(chain: &Chain, formulation: Formulation, prime: u64, seed: u64) -> Result<Self> {
        Determinant::of_six(&Six::of(chain)?, formulation, prime, seed)
    }

    pub(super) fn of_six(six: &Six, formulation: Formulation, prime: u64, seed: u64) -> Result<Self> {
        let field = Zp::new(prime)?;
        let unlucky = || Error::new(ErrorKind::Unsupported, format!("{prime} is unlucky for the chain's constants"));
        let value = determinant(six, formulation, field, seed).ok_or_else(unlucky)?;
        Ok(Determinant { prime, seed, value })
    }
}

fn determinant(six: &Six, formulation: Formulation, field: Zp, seed: u64) -> Option<u64> {
    let mut random = SplitMix64::new(seed);
    let mut draw = || Residue::new(random.unit(field.modulus()), field);
    let axes: Option<Vec<Axis>> = six.chain.joints().iter().map(|joint| axis(joint, field)).collect();
    let mut axes: [Axis; 6] = axes?.try_into().ok()?;
    let mut turns = [[draw(); 2]; 6];
    for (turn, axis) in turns.iter_mut().zip(&axes) {
        *turn = point_of_circle(axis, draw())?;
    }
    for given in six.between.iter().rev() {
        let axis = axis(&given.joint, field)?;
        let by = point_of_circle(&axis, draw())?;
        axes[given.line.before..].iter_mut().for_each(|other| *other = other.moved(&axis, by));
    }
    let zero = Residue::new(0, field);
    let figures = axes.map(|axis| Figure::of(&axis, Frame::on(&axis).across[0]));
    let moved =
        figures.map(|figure| axes.iter().zip(&turns).rev().fold(figure, |figure, (a, by)| figure.moved(a, *by)));
    let back =
        figures.map(|figure| axes.iter().zip(&turns).fold(figure, |figure, (a, [c, s])| figure.moved(a, [*c, -*s])));
    let rows = Rows::of(formulation, &axes, [&figures, &moved, &back]);
    let axis = &axes[formulation.doubled()];
    let doubled = Doubled { second: formulation.second, slides: axis.slides, square: axis.square };
    Some(matrix_determinant(matrix(&rows, &doubled, [zero, draw()]), field))
}

/// The axis of a joint modulo a prime.
fn axis(joint: &Joint, field: Zp) -> Option<Axis> {
    let one = Residue::new(1, field);
    let half = (one + one).inverse()?;
    let direction = Residue::vector(&joint.axis, field)?;
    let square = dot(&direction, &direction);
    Some(Axis {
        direction,
        point: Residue::vector(&joint.point, field)?,
        slides: joint.kind == JointKind::Prismatic,
        square,
        inverse_square: square.inverse()?,
        sample: (one + square).inverse()?,
        units: [Residue::new(0, field), one, half],
    })
}

/// `c` and `s'` of the rotation about `axis` whose half angle has the tangent `t sqrt n`. For a prismatic joint, the square of the displacement `t` and `t`.
fn point_of_circle(axis: &Axis, t: Residue) -> Option<[Residue; 2]> {
    if axis.slides {
        return Some([t * t, t]);
    }
    let (one, square) = (axis.units[1], axis.square * t * t);
    let inverse = (one + square).inverse()?;
    Some([(one - square) * inverse, (t + t) * inverse])
}

type Matrix = [[Residue; ALL]; ALL];

/// All equations at the half angle `x`, each times the cosine and the sine of half the doubled angle. The arguments are zero and `x`.
fn matrix(rows: &Rows, doubled: &Doubled, [zero, x]: [Residue; 2]) -> Matrix {
    let mut matrix = [[zero; ALL]; ALL];
    let moving = rows
        .constant
        .iter()
        .zip(&rows.linear)
        .map(|(a, b)| -> Row { std::array::from_fn(|column| a[column] - x * b[column]) });
    for (index, row) in rows.still.iter().copied().chain(moving).enumerate() {
        let near = doubled.monomials(&row);
        for power in 0..2 {
            let target = &mut matrix[2 * index + power];
            for (degree, values) in near.iter().enumerate() {
                target[3 * (degree + power)..][..3].copy_from_slice(values);
            }
            target[NEAR + power * FAR..][..FAR].copy_from_slice(&row[row.len() - FAR..]);
        }
    }
    matrix
}

/// The determinant, by Gauss elimination.
fn matrix_determinant(mut matrix: Matrix, field: Zp) -> u64 {
    let mut product = Residue::new(1, field);
    for k in 0..ALL {
        let Some(pivot) = (k..ALL).find(|&row| matrix[row][k].value != 0) else { return 0 };
        if pivot != k {
            matrix.swap(k, pivot);
            product = -product;
        }
        product = product * matrix[k][k];
        let Some(inverse) = matrix[k][k].inverse() else { return 0 };
        let (above, below) = matrix.split_at_mut(k + 1);
        for row in below {
            let factor = row[k] * inverse;
            row.iter_mut().zip(&above[k]).for_each(|(entry, over)| *entry = *entry - factor * *over);
        }
    }
    product.value
}
