//! Three coordinates modulo a prime ([`Vector`]).

use super::residue::Residue;

/// Three coordinates.
pub(super) type Vector = [Residue; 3];

pub(super) fn dot(a: &Vector, b: &Vector) -> Residue {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross(a: &Vector, b: &Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(super) fn add(a: &Vector, b: &Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub(super) fn sub(a: &Vector, b: &Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(super) fn scale(a: &Vector, factor: Residue) -> Vector {
    a.map(|entry| entry * factor)
}
