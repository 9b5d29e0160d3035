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

/// The axis of a joint: its line with what moving by it needs.
///
/// With `n = w.w` a turn by `q` has the coordinates `c = cos q` and `s' = sin q / sqrt n`, which fulfil `c^2 + n s'^2 = 1`: no
/// square root is needed for a direction of any length. A joint that slides by `d' w` has the coordinates `d'^2` and `d'` in their place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis<T> {
    /// The line.
    pub line: Line<T>,
    /// Whether the joint slides along it.
    pub slides: bool,
    /// `n`.
    pub square: T,
    /// `1 / n`.
    pub inverse_square: T,
    /// `1 / (1 + n)`, for the turns at which functions of the angle are sampled.
    pub sample: T,
    /// Nought, one and a half.
    pub units: [T; 3],
}

/// What a joint leaves alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figure<T> {
    /// The line of its axis.
    pub line: Line<T>,
    /// A direction across it, of a joint that slides: such a joint leaves all directions alone.
    pub side: Option<Vector<T>>,
}

impl<T: Scalar> Figure<T> {
    /// What the joint of `axis` leaves alone; `across` is perpendicular to it.
    pub fn of(axis: &Axis<T>, across: Vector<T>) -> Self {
        Figure { line: axis.line, side: axis.slides.then_some(across) }
    }

    /// The figure moved by the joint of `axis`, given `c` and `s'`, or `d'^2` and `d'`.
    pub fn moved(&self, axis: &Axis<T>, by: [T; 2]) -> Figure<T> {
        if axis.slides {
            let point = add(&self.line.point, &scale(&axis.line.direction, by[1]));
            return Figure { line: Line { point, ..self.line }, ..*self };
        }
        Figure { line: self.line.turned(axis, by), side: self.side.map(|side| axis.turned(&side, by)) }
    }
}

impl<T: Scalar> Line<T> {
    /// The line turned about `axis`, given `c` and `s'`.
    fn turned(&self, axis: &Axis<T>, [c, s]: [T; 2]) -> Line<T> {
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

    /// `c` and `s'` of the three turns that functions are sampled at: half-angle tangents 0, `sqrt n` and `-sqrt n`; or the slides by
    /// 0, 1 and -1.
    pub(super) fn samples(&self) -> [[T; 2]; 3] {
        let [zero, one, _] = self.units;
        if self.slides {
            return [[zero, zero], [one, one], [one, -one]];
        }
        let (c, s) = ((one - self.square) * self.sample, (one + one) * self.sample);
        [[one, zero], [c, s], [c, -s]]
    }

    /// The coefficients of 1, `c` and `s'`, or of 1, `d'^2` and `d'`, of a function that is affine in them, from its values at the samples.
    pub(super) fn coefficients(&self, [f, g, h]: [T; 3]) -> [T; 3] {
        let [_, one, half] = self.units;
        let (mean, wide) = (half * (g + h), one + self.square);
        if self.slides {
            return [f, mean - f, half * (g - h)];
        }
        let cosine = half * (f - mean) * wide * self.inverse_square;
        [f - cosine, cosine, half * half * (g - h) * wide]
    }
}

impl Axis<f64> {
    /// The axis along a direction of length one.
    pub fn along(line: Line<f64>, slides: bool) -> Self {
        Axis { line, slides, square: 1.0, inverse_square: 1.0, sample: 0.5, units: [0.0, 1.0, 0.5] }
    }
}
