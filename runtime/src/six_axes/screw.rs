//! Axes of joints ([`Axis`]), and lines and directions that they move ([`Figure`]).

use super::rigid::Rigid;
use super::vector::{Vector, add, cross, dot, scale, sub};

/// The axis of a joint.
#[derive(Clone, Copy)]
pub(super) struct Axis {
    /// Unit vector along the axis.
    pub direction: Vector,
    /// Any point of it.
    pub point: Vector,
    /// Whether the joint is prismatic.
    pub slides: bool,
}

/// The line or directions that a joint leaves invariant: the line of its axis; for a prismatic joint, its direction and one orthogonal to it.
#[derive(Clone, Copy)]
pub(super) struct Figure {
    pub direction: Vector,
    pub point: Vector,
    pub side: Option<Vector>,
}

impl Figure {
    /// The figure moved by the joint of an axis, given `c` and `s` of its angle, or `d^2` and `d` of its displacement.
    #[inline(always)]
    pub fn moved(&self, axis: &Axis, by: [f64; 2]) -> Figure {
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

    /// The figure moved by a rigid motion.
    #[inline(always)]
    pub fn carried(&self, motion: &Rigid) -> Figure {
        Figure {
            direction: motion.turned(&self.direction),
            point: motion.moved(&self.point),
            side: self.side.map(|side| motion.turned(&side)),
        }
    }
}

impl Axis {
    #[inline(always)]
    pub fn turned(&self, v: &Vector, [c, s]: [f64; 2]) -> Vector {
        let along = scale(&self.direction, dot(&self.direction, v));
        let across = sub(v, &along);
        add(&along, &add(&scale(&across, c), &scale(&cross(&self.direction, v), s)))
    }

    /// `c` and `s` of the rotations, or `d^2` and `d` of the translations, at which functions are sampled.
    #[inline(always)]
    pub fn samples(&self) -> [[f64; 2]; 3] {
        if self.slides { [[0.0, 0.0], [1.0, 1.0], [1.0, -1.0]] } else { [[1.0, 0.0], [0.0, 1.0], [0.0, -1.0]] }
    }

    /// The coefficients of 1, `c`, `s`, or of 1, `d^2`, `d`, of a function affine in them, from its values at the samples.
    #[inline(always)]
    pub fn coefficients(&self, [f, g, h]: [f64; 3]) -> [f64; 3] {
        let mean = 0.5 * (g + h);
        if self.slides {
            return [f, mean - f, 0.5 * (g - h)];
        }
        let cosine = f - mean;
        [f - cosine, cosine, 0.5 * (g - h)]
    }
}
