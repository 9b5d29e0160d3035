//! The formulation of the closed loop of six axes with one hidden axis ([`Formulation`]).

use groebot_runtime::six_axes;
use serde::{Deserialize, Serialize};

/// The choice of the joint that is hidden in the pencil, and of the joint whose equations are doubled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Formulation {
    /// The joint, from 0, whose angle or displacement is the eigenvalue.
    pub hidden: usize,
    /// The joint that doubles the equations: they are multiplied by its half angle or displacement. False for the first joint after the hidden one, true for
    /// the second.
    pub second: bool,
}

impl Formulation {
    /// The joint that is `steps` after the hidden one in the loop.
    pub fn joint(&self, steps: usize) -> usize {
        (self.hidden + steps) % 6
    }

    /// The joint whose half angle or displacement the equations are multiplied by.
    #[doc(hidden)]
    pub fn doubled(&self) -> usize {
        self.joint(if self.second { 2 } else { 1 })
    }

    /// Whether the joint exists.
    #[doc(hidden)]
    pub fn is_valid(&self) -> bool {
        self.hidden < 6
    }
}

impl From<Formulation> for six_axes::Formulation {
    fn from(Formulation { hidden, second }: Formulation) -> Self {
        six_axes::Formulation { hidden, second }
    }
}
