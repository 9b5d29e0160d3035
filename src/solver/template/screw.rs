//! Lines in space that turn about each other ([`Line`], [`Axis`]), over any [`Scalar`].

use serde::{Deserialize, Serialize};

use super::scalar::{Scalar, Vector, add, cross, dot, scale, sub};

/// A line with a direction, and a point on it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Line<T> {
    /// Not zero, of any length.
    pub direction: Vector<T>,
    /// Any point of the line.
    pub point: Vector<T>,
}

/// The axis of a revolute joint: its line with what turning about it needs.
///
/// With `n = w.w` a turn by `q` has the coordinates `c = cos q` and `s' = sin q / sqrt n`, which fulfil `c^2 + n s'^2 = 1`: no
/// square root is needed for a direction of any length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis<T> {
    /// The line.
    pub line: Line<T>,
    /// `n`.
    pub square: T,
    /// `1 / n`.
    pub inverse_square: T,
    /// `1 / (1 + n)`, for the turns at which functions of the angle are sampled.
    pub sample: T,
    /// Nought, one and a half.
    pub units: [T; 3],
}

impl<T: Scalar> Line<T> {
    /// The line turned about `axis`, given `c` and `s'`.
    pub fn turned(&self, axis: &Axis<T>, [c, s]: [T; 2]) -> Line<T> {
        let arm = axis.turned(&sub(&self.point, &axis.line.point), [c, s]);
        Line { direction: axis.turned(&self.direction, [c, s]), point: add(&axis.line.point, &arm) }
    }
}

impl<T: Scalar> Axis<T> {
    /// A vector turned about the direction of the axis.
    fn turned(&self, v: &Vector<T>, [c, s]: [T; 2]) -> Vector<T> {
        let w = &self.line.direction;
        let along = scale(w, dot(w, v) * self.inverse_square);
        let across = sub(v, &along);
        add(&along, &add(&scale(&across, c), &scale(&cross(w, v), s)))
    }

    /// `c` and `s'` of the three turns that functions are sampled at: half-angle tangents 0, `sqrt n` and `-sqrt n`.
    pub(super) fn samples(&self) -> [[T; 2]; 3] {
        let [zero, one, _] = self.units;
        let (c, s) = ((one - self.square) * self.sample, (one + one) * self.sample);
        [[one, zero], [c, s], [c, -s]]
    }

    /// The coefficients of 1, `c` and `s'` of a function that is affine in them, from its values at the samples.
    pub(super) fn coefficients(&self, [f, g, h]: [T; 3]) -> [T; 3] {
        let [_, one, half] = self.units;
        let (mean, wide) = (half * (g + h), one + self.square);
        let cosine = half * (f - mean) * wide * self.inverse_square;
        [f - cosine, cosine, half * half * (g - h) * wide]
    }
}

impl Axis<f64> {
    /// The axis along a direction of length one.
    pub fn along(line: Line<f64>) -> Self {
        Axis { line, square: 1.0, inverse_square: 1.0, sample: 0.5, units: [0.0, 1.0, 0.5] }
    }
}
