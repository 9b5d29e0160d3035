//! Exact placements whose rotations are quarter turns: how URDF-like origins reach the base frame.

use num_integer::Integer;
use num_traits::{ToPrimitive, Zero};

use super::{ExactMatrix, ExactVector};
use crate::number::{BigInt, BigRational};

/// A rotation by quarter turns about coordinate axes; the entries are -1, 0 and 1.
pub type QuarterTurns = [[i64; 3]; 3];

/// The frame that does not move.
pub const IDENTITY: QuarterTurns = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];

/// A frame in the base frame.
#[derive(Clone, Debug)]
pub struct Placement {
    /// Its rotation, base_from_frame.
    pub rotation: QuarterTurns,
    /// Its origin.
    pub origin: ExactVector,
}

impl Placement {
    /// The base frame itself.
    pub fn base() -> Self {
        Placement { rotation: IDENTITY, origin: std::array::from_fn(|_| BigRational::zero()) }
    }

    /// The frame that stands at `inner` in this frame.
    pub fn then(&self, inner: &Placement) -> Placement {
        let moved = turn(&self.rotation, &inner.origin);
        let origin = std::array::from_fn(|i| &self.origin[i] + &moved[i]);
        Placement { rotation: product(&self.rotation, &inner.rotation), origin }
    }
}

/// Rz(yaw) Ry(pitch) Rx(roll), the rotation of a URDF `rpy` in degrees; `None` unless all are multiples of 90.
pub fn from_rpy(degrees: &ExactVector) -> Option<QuarterTurns> {
    let [roll, pitch, yaw] = degrees.each_ref().map(quarters);
    Some(product(&product(&about(2, yaw?), &about(1, pitch?)), &about(0, roll?)))
}

/// `rotation` applied to `vector`.
pub fn turn(rotation: &QuarterTurns, vector: &ExactVector) -> ExactVector {
    let entry = |row: &[i64; 3]| {
        let terms = row.iter().zip(vector).map(|(&sign, x)| BigRational::from_integer(sign.into()) * x);
        terms.sum()
    };
    rotation.each_ref().map(entry)
}

/// `rotation` with exact entries.
pub fn exact(rotation: &QuarterTurns) -> ExactMatrix {
    rotation.map(|row| row.map(|entry| BigRational::from_integer(entry.into())))
}

fn quarters(degrees: &BigRational) -> Option<usize> {
    let turns = degrees / BigRational::from_integer(BigInt::from(90));
    if turns.is_integer() { turns.numer().mod_floor(&BigInt::from(4)).to_usize() } else { None }
}

/// The rotation by `turns` quarter turns about a coordinate axis.
fn about(axis: usize, turns: usize) -> QuarterTurns {
    let (cosine, sine) = [(1, 0), (0, 1), (-1, 0), (0, -1)][turns];
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut rotation = IDENTITY;
    (rotation[u][u], rotation[u][v]) = (cosine, -sine);
    (rotation[v][u], rotation[v][v]) = (sine, cosine);
    rotation
}

fn product(a: &QuarterTurns, b: &QuarterTurns) -> QuarterTurns {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum()))
}
