//! The loop of six axes seen from one of them ([`Formulation`], [`Equations`]).
//!
//! Whichever joint is called first, the loop says `E1 E2 ... E6 = G`, with the axes behind the target moved to the other side of it. The
//! line of the fourth axis is left alone by `E4`, so `E1` turns `E2 E3 (line 4)` into `G E6^-1 E5^-1 (line 4)`: two joints on each side of
//! the hidden one.

use serde::{Deserialize, Serialize};

use super::profile::{Frame, Profile};
use super::scalar::Scalar;
use super::screw::{Axis, Line};

/// Which angle is hidden in the pencil, and which is doubled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Formulation {
    /// The joint, from 0, whose angle is the eigenvalue.
    pub hidden: usize,
    /// Whether the equations are multiplied by half the angle of the second joint behind it, and not of the first.
    pub second: bool,
}

impl Formulation {
    /// The joint that stands `steps` behind the hidden one in the loop.
    pub fn joint(&self, steps: usize) -> usize {
        (self.hidden + steps) % 6
    }
}

/// The two sides of the loop, as coefficients.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Equations<T> {
    /// `n` of the hidden axis.
    pub square: T,
    /// What the hidden joint turns: products of the joints 1 and 2 behind it.
    pub turned: Profile<T>,
    /// What it is turned into: products of the joints 5 and 4 behind it, with the sines of their angles reversed.
    pub reached: Profile<T>,
}

impl<T: Scalar> Equations<T> {
    /// The equations of a formulation: `moved` are the axes moved by the target, `back` those moved by its inverse.
    pub fn new(
        formulation: Formulation,
        frame: &Frame<T>,
        axes: &[Axis<T>; 6],
        moved: &[Line<T>; 6],
        back: &[Line<T>; 6],
    ) -> Self {
        let is_behind_target = |steps: usize| formulation.hidden + steps >= 6;
        let place = |steps: usize, ahead: bool| {
            let joint = formulation.joint(steps);
            let line = match (ahead, is_behind_target(steps)) {
                (true, true) => back[joint],
                (false, false) => moved[joint],
                _ => axes[joint].line,
            };
            Axis { line, ..axes[joint] }
        };
        Equations {
            square: axes[formulation.hidden].square,
            turned: Profile::new(frame, &place(1, true), &place(2, true), &place(3, true).line),
            reached: Profile::new(frame, &place(5, false), &place(4, false), &place(3, false).line),
        }
    }
}
