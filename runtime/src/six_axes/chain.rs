//! General chains of six joints ([`Chain`]), and the formulations of their loop equation ([`Formulation`]).

use core::array::from_fn;

use super::profile::Frame;
use super::rigid::Rigid;
use super::screw::{Axis, Figure};
use super::vector::{Vector, scale};

/// A displacement of so many length scales represents an infinite one. Chains with two prismatic joints have such eigenvalues.
const LONG: f64 = 1e4;

/// Whether a displacement represents an infinite one.
pub(super) fn is_infinite(value: f64) -> bool {
    value.is_nan() || value.abs() > LONG
}

/// The joint that is hidden in the pencil, and the one that is doubled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Formulation {
    /// The joint, from 0, whose angle or displacement is the eigenvalue.
    pub hidden: usize,
    /// Whether the equations are multiplied by half the angle, or by the displacement, of the second joint after the hidden one instead of the first.
    pub second: bool,
}

impl Formulation {
    /// The joint `steps` after the hidden one in the loop.
    #[inline(always)]
    pub(super) fn joint(&self, steps: usize) -> usize {
        (self.hidden + steps) % 6
    }

    /// The joint by whose half angle or displacement the equations are multiplied.
    pub(super) fn doubled(&self) -> usize {
        self.joint(if self.second { 2 } else { 1 })
    }
}

/// Formulations in the order in which they are tried, at least one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Formulations {
    list: [Formulation; Formulations::ROOM],
    count: usize,
}

impl Formulations {
    /// Capacity: each joint can be hidden, and each of the two after it doubled.
    pub const ROOM: usize = 12;

    /// Formulations from a list.
    ///
    /// # Panics
    /// When it is empty, longer than [`Formulations::ROOM`], or one hides none of the joints 0 to 5.
    #[must_use]
    pub const fn new(list: &[Formulation]) -> Self {
        assert!(!list.is_empty() && list.len() <= Self::ROOM, "1 to 12 formulations are allowed");
        let (mut formulations, mut k) = (Formulations { list: [list[0]; Self::ROOM], count: list.len() }, 0);
        while k < list.len() {
            assert!(list[k].hidden < 6, "joints 0 to 5 can be hidden");
            formulations.list[k] = list[k];
            k += 1;
        }
        formulations
    }

    /// The formulations.
    #[must_use]
    pub fn as_slice(&self) -> &[Formulation] {
        &self.list[..self.count]
    }

    /// The formulation of an attempt; after the last one the first is used again.
    pub(super) fn of(&self, attempt: usize) -> Formulation {
        self.list[attempt % self.count]
    }
}

/// A chain of six joints, given by their axes of rotation or translation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chain {
    /// Directions of the axes at zero, of length one.
    pub directions: [Vector; 6],
    /// Points on the axes at zero, divided by `length`, as are all lengths except those of `back`.
    pub points: [Vector; 6],
    /// For each axis, two unit vectors orthogonal to it and to each other.
    pub across: [[Vector; 2]; 6],
    /// Whether joints are prismatic.
    pub slides: [bool; 6],
    /// At zero, each joint's frame in the frame of the joint before; the first one in the base. Its z axis is the joint's axis.
    pub steps: [Rigid; 6],
    /// At zero, the last joint's frame in the base.
    pub last: Rigid,
    /// The base in the frame of the tip at zero, in the unit of the target.
    pub back: Rigid,
    /// Characteristic length of the chain, in the unit of the target.
    pub length: f64,
    /// The eigenvalue problems, in the order in which they are tried.
    pub formulations: Formulations,
    /// Tolerance between this robot and the one for which solutions are wanted (relative to `length`, and rad); zero where both are equal. Complex solutions
    /// within this distance of each other count as lost solutions, because they may be real for the other robot.
    pub within: f64,
}

impl Chain {
    pub(super) fn axis(&self, joint: usize) -> Axis {
        Axis { direction: self.directions[joint], point: self.points[joint], slides: self.slides[joint] }
    }

    /// The hidden axis of a formulation.
    pub(super) fn frame(&self, formulation: Formulation) -> Frame<'_> {
        Frame { axis: self.axis(formulation.hidden), across: &self.across[formulation.hidden] }
    }

    /// The line or direction that a joint leaves invariant, moved to the other side of the target if `ahead`.
    #[inline(always)]
    pub(super) fn place(&self, formulation: Formulation, steps: usize, ahead: bool, displacement: &Rigid) -> Figure {
        let joint = formulation.joint(steps);
        let side = self.slides[joint].then_some(self.across[joint][0]);
        let figure = Figure { direction: self.directions[joint], point: self.points[joint], side };
        match (ahead, formulation.hidden + steps >= 6) {
            (true, true) => figure.carried(&displacement.inverse()),
            (false, false) => figure.carried(displacement),
            _ => figure,
        }
    }

    /// The joint values, with displacements multiplied by a factor.
    pub(super) fn scaled(&self, q: &[f64; 6], factor: f64) -> [f64; 6] {
        from_fn(|joint| if self.slides[joint] { q[joint] * factor } else { q[joint] })
    }

    /// Whether a displacement among joint values represents an infinite one.
    pub(super) fn has_infinite(&self, q: &[f64; 6]) -> bool {
        q.iter().zip(&self.slides).any(|(value, slides)| *slides && is_infinite(*value))
    }

    /// The rigid motion from the tip's pose at zero to a target.
    pub(super) fn displacement(&self, target: &[f64; 12]) -> Rigid {
        let rotation = from_fn(|i| from_fn(|j| target[3 + 3 * i + j]));
        let pose = Rigid { rotation, translation: [target[0], target[1], target[2]] };
        let displacement = pose.after(&self.back);
        Rigid { translation: scale(&displacement.translation, 1.0 / self.length), ..displacement }
    }

    /// The target that joint values reach: a position, and a rotation matrix by rows.
    #[must_use]
    pub fn forward(&self, q: &[f64; 6]) -> [f64; 12] {
        let displacement = self.reach(&self.scaled(q, 1.0 / self.length)).end.after(&self.last.inverse());
        let translation = scale(&displacement.translation, self.length);
        let Rigid { rotation, translation } = Rigid { translation, ..displacement }.after(&self.back.inverse());
        from_fn(|k| if k < 3 { translation[k] } else { rotation[k / 3 - 1][k % 3] })
    }
}
