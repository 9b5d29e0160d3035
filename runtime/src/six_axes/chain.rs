//! Six joints in any place ([`Chain`]), and the ways to see their loop ([`Formulation`]).

use core::array::from_fn;

use super::profile::Frame;
use super::rigid::Rigid;
use super::screw::{Axis, Figure};
use super::vector::{Vector, scale};

/// A way of so many length scales stands for an infinite one, which chains with two sliding joints have among their eigenvalues.
const LONG: f64 = 1e4;

/// Whether a way stands for an infinite one.
pub(super) fn is_infinite(way: f64) -> bool {
    way.is_nan() || way.abs() > LONG
}

/// Which angle is hidden in the pencil, and which is doubled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Formulation {
    /// The joint, from 0, whose angle or way is the eigenvalue.
    pub hidden: usize,
    /// Whether the equations are multiplied by half the angle, or by the way, of the second joint behind it, and not of the first.
    pub second: bool,
}

impl Formulation {
    /// The joint that stands `steps` behind the hidden one in the loop.
    #[inline(always)]
    pub(super) fn joint(&self, steps: usize) -> usize {
        (self.hidden + steps) % 6
    }

    /// The joint whose half angle or way the equations are multiplied by.
    pub(super) fn doubled(&self) -> usize {
        self.joint(if self.second { 2 } else { 1 })
    }
}

/// Formulations in the order in which they are tried; one at least.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Formulations {
    list: [Formulation; Formulations::ROOM],
    count: usize,
}

impl Formulations {
    /// Each joint can be hidden, and each of the two behind it doubled.
    pub const ROOM: usize = 12;

    /// Those of a list.
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

    /// That of an attempt: after the last the first again.
    pub(super) fn of(&self, attempt: usize) -> Formulation {
        self.list[attempt % self.count]
    }
}

/// Six joints, by the lines that they turn about or slide along.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chain {
    /// Directions of the axes at zero, of length one.
    pub directions: [Vector; 6],
    /// Points on the axes at zero; as all lengths but those of `back`, shares of `length`.
    pub points: [Vector; 6],
    /// Two directions of length one across each axis and each other.
    pub across: [[Vector; 2]; 6],
    /// Whether joints slide along their axes.
    pub slides: [bool; 6],
    /// At zero each joint's frame, whose z axis is the joint's, in that of the joint before; the first one in the base.
    pub steps: [Rigid; 6],
    /// At zero the last joint's frame in the base.
    pub last: Rigid,
    /// The base seen from the tip at zero, in the unit of the target.
    pub back: Rigid,
    /// A length typical of the chain, in the unit of the target.
    pub length: f64,
    /// The eigenvalue problems, in the order in which they are tried.
    pub formulations: Formulations,
    /// How far the robot for which answers are wanted may be from this one (shares of `length`, and rad); zero where it is this one. Two complex
    /// solutions that are as near to each other are lost answers: of that robot they may be real.
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

    /// What a joint leaves alone, moved to where the loop is cut behind the target.
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

    /// The joints with ways times a factor.
    pub(super) fn scaled(&self, q: &[f64; 6], factor: f64) -> [f64; 6] {
        from_fn(|joint| if self.slides[joint] { q[joint] * factor } else { q[joint] })
    }

    /// Whether a way among joint values stands for an infinite one.
    pub(super) fn has_infinite(&self, q: &[f64; 6]) -> bool {
        q.iter().zip(&self.slides).any(|(way, slides)| *slides && is_infinite(*way))
    }

    /// What takes the tip from its place at zero to a target.
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
