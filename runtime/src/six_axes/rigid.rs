//! Rigid motions ([`Rigid`]).

use core::array::from_fn;

use super::vector::{Vector, add, cross, dot, scale};
use crate::trigonometry::{cosine, sine};

/// A rigid motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rigid {
    /// The rotation matrix, by rows.
    pub rotation: [Vector; 3],
    /// The image of the origin.
    pub translation: Vector,
}

/// The axis of the motions by which [`aside`] displaces targets.
const DIRECTION: Vector = [0.48, 0.6, 0.64];

impl Rigid {
    /// The identity.
    pub const NONE: Rigid =
        Rigid { rotation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], translation: [0.0; 3] };

    /// The rotated direction `v`.
    #[inline(always)]
    #[must_use]
    pub fn turned(&self, v: &Vector) -> Vector {
        let [x, y, z] = &self.rotation;
        [dot(x, v), dot(y, v), dot(z, v)]
    }

    /// The transformed point `p`.
    #[inline(always)]
    #[must_use]
    pub fn moved(&self, p: &Vector) -> Vector {
        add(&self.turned(p), &self.translation)
    }

    /// The inverse motion.
    #[inline(always)]
    #[must_use]
    pub fn inverse(&self) -> Rigid {
        let back = Rigid { rotation: [self.column(0), self.column(1), self.column(2)], translation: [0.0; 3] };
        let [x, y, z] = back.turned(&self.translation);
        Rigid { translation: [-x, -y, -z], ..back }
    }

    /// The composition: `other` first, then this motion.
    #[inline(always)]
    #[must_use]
    pub fn after(&self, other: &Rigid) -> Rigid {
        let [x, y, z] = [self.turned(&other.column(0)), self.turned(&other.column(1)), self.turned(&other.column(2))];
        let rotation = [[x[0], y[0], z[0]], [x[1], y[1], z[1]], [x[2], y[2], z[2]]];
        Rigid { rotation, translation: self.moved(&other.translation) }
    }

    #[inline(always)]
    pub(crate) fn column(&self, index: usize) -> Vector {
        let [x, y, z] = &self.rotation;
        [x[index], y[index], z[index]]
    }

    /// Followed by a rotation about the moved z axis, given its cosine and sine.
    #[inline(always)]
    pub(crate) fn then_turned(&self, [c, s]: [f64; 2]) -> Rigid {
        let turned = |[x, y, z]: Vector| [c * x + s * y, c * y - s * x, z];
        let [x, y, z] = self.rotation;
        Rigid { rotation: [turned(x), turned(y), turned(z)], ..*self }
    }

    /// Followed by a translation along the moved z axis.
    #[inline(always)]
    pub(crate) fn then_slid(&self, distance: f64) -> Rigid {
        Rigid { translation: add(&self.translation, &scale(&self.column(2), distance)), ..*self }
    }
}

/// A small motion by `size` (rad, and relative to the length scale), different for each attempt.
pub(super) fn aside(size: f64, attempt: usize) -> Rigid {
    let sign = if attempt.is_multiple_of(2) { size } else { -size };
    let [c, s] = [cosine(sign), sine(sign)];
    let about = |v: Vector| -> Vector {
        let (w, along) = (DIRECTION, dot(&DIRECTION, &v) * (1.0 - c));
        let third = cross(&w, &v);
        from_fn(|k| c * v[k] + s * third[k] + along * w[k])
    };
    let columns = [about([1.0, 0.0, 0.0]), about([0.0, 1.0, 0.0]), about([0.0, 0.0, 1.0])];
    Rigid { rotation: from_fn(|i| from_fn(|j| columns[j][i])), translation: [-0.7 * sign, 0.5 * sign, 0.3 * sign] }
}
