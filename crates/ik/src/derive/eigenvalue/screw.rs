//! The axes of joints ([`Axis`]) and their invariants ([`Figure`]), modulo a prime.

use super::residue::Residue;
use super::vector::{Vector, add, cross, dot, scale, sub};

/// The axis of a joint: its line, with precomputed numbers for its motion.
///
/// With `n = w.w`, a rotation by `q` has the coordinates `c = cos q` and `s' = sin q / sqrt n`, which fulfil `c^2 + n s'^2 = 1`. So a direction of any length
/// needs no square root. A prismatic joint with displacement `d' w` has the coordinates `d'^2` and `d'` instead.
#[derive(Clone, Copy)]
pub(super) struct Axis {
    /// `w`; not zero, of any length.
    pub direction: Vector,
    /// Any point of the line.
    pub point: Vector,
    /// Whether the joint is prismatic.
    pub slides: bool,
    /// `n`.
    pub square: Residue,
    /// `1 / n`.
    pub inverse_square: Residue,
    /// `1 / (1 + n)`, for the rotations at which functions of the angle are sampled.
    pub sample: Residue,
    /// The numbers 0, 1 and 1/2.
    pub units: [Residue; 3],
}

/// The invariants of a joint: the line of its axis. For a prismatic joint, its direction and a perpendicular direction.
#[derive(Clone, Copy)]
pub(super) struct Figure {
    pub direction: Vector,
    pub point: Vector,
    pub side: Option<Vector>,
}

impl Figure {
    /// The invariants of the joint of `axis`; `across` is perpendicular to the axis.
    pub fn of(axis: &Axis, across: Vector) -> Self {
        Figure { direction: axis.direction, point: axis.point, side: axis.slides.then_some(across) }
    }

    /// The figure moved by the joint of `axis` with the coordinates `c` and `s'`, or `d'^2` and `d'`.
    pub fn moved(&self, axis: &Axis, by: [Residue; 2]) -> Figure {
        if axis.slides {
            return Figure { point: add(&self.point, &scale(&axis.direction, by[1])), ..*self };
        }
        let arm = axis.turned(&sub(&self.point, &axis.point), by);
        Figure {
            direction: axis.turned(&self.direction, by),
            point: add(&axis.point, &arm),
            side: self.side.map(|side| axis.turned(&side, by)),
        }
    }
}

impl Axis {
    /// The axis moved by the joint of `other` with the coordinates `c` and `s'`, or `d'^2` and `d'`.
    pub fn moved(&self, other: &Axis, by: [Residue; 2]) -> Axis {
        let figure = Figure { direction: self.direction, point: self.point, side: None }.moved(other, by);
        Axis { direction: figure.direction, point: figure.point, ..*self }
    }

    /// A vector rotated about the direction of the axis.
    fn turned(&self, v: &Vector, [c, s]: [Residue; 2]) -> Vector {
        let along = scale(&self.direction, dot(&self.direction, v) * self.inverse_square);
        let across = sub(v, &along);
        add(&along, &add(&scale(&across, c), &scale(&cross(&self.direction, v), s)))
    }

    /// `c` and `s'` of the three rotations at which functions are sampled, with half-angle tangents 0, `sqrt n` and `-sqrt n`. For a prismatic joint, the
    /// displacements 0, 1 and -1.
    pub fn samples(&self) -> [[Residue; 2]; 3] {
        let [zero, one, _] = self.units;
        if self.slides {
            return [[zero, zero], [one, one], [one, -one]];
        }
        let (c, s) = ((one - self.square) * self.sample, (one + one) * self.sample);
        [[one, zero], [c, s], [c, -s]]
    }

    /// The coefficients of 1, `c` and `s'`, or of 1, `d'^2` and `d'`, of an affine function of these, from its values at the samples.
    pub fn coefficients(&self, [f, g, h]: [Residue; 3]) -> [Residue; 3] {
        let [_, one, half] = self.units;
        let (mean, wide) = (half * (g + h), one + self.square);
        if self.slides {
            return [f, mean - f, half * (g - h)];
        }
        let cosine = half * (f - mean) * wide * self.inverse_square;
        [f - cosine, cosine, half * half * (g - h) * wide]
    }
}
