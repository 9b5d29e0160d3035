//! The loop of six axes seen from one of them ([`Formulation`], [`Equations`]).
//!
//! Whichever joint is called first, the loop says `E1 E2 ... E6 = G`, with the axes behind the target moved to the other side of it. The
//! line of the fourth axis is left alone by `E4`, so `E1` takes `E2 E3 (line 4)` to `G E6^-1 E5^-1 (line 4)`: two joints on each side of
//! the hidden one. Each joint may turn or slide.

use serde::{Deserialize, Serialize};

use super::profile::{Frame, Profile};
use super::scalar::Scalar;
use super::screw::{Axis, Figure};

/// Which angle is hidden in the pencil, and which is doubled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Formulation {
    /// The joint, from 0, whose angle or way is the eigenvalue.
    pub hidden: usize,
    /// Whether the equations are multiplied by half the angle, or by the way, of the second joint behind it, and not of the first.
    pub second: bool,
}

impl Formulation {
    /// The joint that stands `steps` behind the hidden one in the loop.
    pub fn joint(&self, steps: usize) -> usize {
        (self.hidden + steps) % 6
    }

    /// The joint whose half angle or way the equations are multiplied by.
    pub fn doubled(&self) -> usize {
        self.joint(if self.second { 2 } else { 1 })
    }

    /// Whether it is one: whether there is such a joint.
    pub fn is_valid(&self) -> bool {
        self.hidden < 6
    }
}

/// The two sides of the loop, as coefficients.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Equations<T> {
    /// `n` of the hidden axis.
    pub square: T,
    /// Whether the hidden joint slides.
    pub slides: bool,
    /// Whether what is moved are directions with a line, and not a line alone: the fourth joint slides.
    pub is_directed: bool,
    /// What the hidden joint moves: products of the joints 1 and 2 behind it.
    pub turned: Profile<T>,
    /// Where it moves that to: products of the joints 5 and 4 behind it, with the sines of their angles reversed.
    pub reached: Profile<T>,
}

impl<T: Scalar> Equations<T> {
    /// The equations of a formulation: `figures` are what the axes leave alone, `moved` these moved by the target, `back` those moved by
    /// its inverse.
    pub fn new(
        formulation: Formulation,
        frame: &Frame<T>,
        axes: &[Axis<T>; 6],
        [figures, moved, back]: [&[Figure<T>; 6]; 3],
    ) -> Self {
        let is_behind_target = |steps: usize| formulation.hidden + steps >= 6;
        let place = |steps: usize, ahead: bool| {
            let joint = formulation.joint(steps);
            match (ahead, is_behind_target(steps)) {
                (true, true) => back[joint],
                (false, false) => moved[joint],
                _ => figures[joint],
            }
        };
        let axis =
            |steps: usize, ahead: bool| Axis { line: place(steps, ahead).line, ..axes[formulation.joint(steps)] };
        Equations {
            square: axes[formulation.hidden].square,
            slides: axes[formulation.hidden].slides,
            is_directed: axes[formulation.joint(3)].slides,
            turned: Profile::new(frame, &axis(1, true), &axis(2, true), &place(3, true)),
            reached: Profile::new(frame, &axis(5, false), &axis(4, false), &place(3, false)),
        }
    }
}
