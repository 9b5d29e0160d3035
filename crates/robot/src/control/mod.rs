//! Control laws, RH0 2.5: the torques with which a robot follows a reference. A law returns torques and has no clock.
//! Main type: [`Law`].
//!
//! Errors are actual minus desired values, `e = q - q_d`, as in the thesis. [`ClosedLoop`] simulates a robot under a
//! law.

mod closed_loop;
mod joint_space;
mod operational_space;
mod picture;
mod reference;
mod two_chains;

pub use closed_loop::{ClosedLoop, Disturbance, Sample};
pub use joint_space::{ComputedTorque, Gains, GravityCompensation, OpenLoop};
pub use operational_space::{Effective, Inversion, OperationalSpace, Target};
pub use picture::{errors_and_torques, greatest_errors};
pub use reference::Desired;
pub use two_chains::TwoChains;

use crate::Result;
use crate::dynamics::{Equations, State};

/// A control law of a robot: it computes torques from the actual and the desired state.
pub trait Law {
    /// Computes the torque of each degree of freedom at a state.
    ///
    /// # Errors
    /// Those of [`Equations::inverse`], and errors of the law itself.
    fn torques(&mut self, desired: &Desired<'_>, state: State<'_>) -> Result<&[f64]>;

    /// Integrates the errors over a time \[s\]. Laws without integral action ignore this call.
    fn integrate(&mut self, desired: &Desired<'_>, state: State<'_>, time: f64) {
        let _ = (desired, state, time);
    }
}

/// A law with torque limits of the motors.
#[derive(Clone, Debug)]
pub struct Limited<L> {
    law: L,
    most: Vec<f64>,
    torques: Vec<f64>,
    cut: Vec<f64>,
}

impl<L: Law> Limited<L> {
    /// Limits the torque of each degree of freedom \[N m or N\]; infinite without a limit.
    pub fn new(law: L, most: Vec<f64>) -> Self {
        let count = most.len();
        Limited { law, most, torques: vec![0.0; count], cut: vec![0.0; count] }
    }

    /// The signed excess of the last torques over the limits, for each degree of freedom.
    pub fn cut(&self) -> &[f64] {
        &self.cut
    }
}

impl<L: Law> Law for Limited<L> {
    fn torques(&mut self, desired: &Desired<'_>, state: State<'_>) -> Result<&[f64]> {
        let commanded = self.law.torques(desired, state)?;
        for (at, (commanded, most)) in commanded.iter().zip(&self.most).enumerate() {
            self.torques[at] = commanded.clamp(-most, *most);
            self.cut[at] = commanded - self.torques[at];
        }
        Ok(&self.torques)
    }

    fn integrate(&mut self, desired: &Desired<'_>, state: State<'_>, time: f64) {
        // Anti-windup: errors are not integrated while a motor is at its limit.
        if self.cut.iter().all(|cut| *cut == 0.0) {
            self.law.integrate(desired, state, time);
        }
    }
}

impl<L: Law + ?Sized> Law for Box<L> {
    fn torques(&mut self, desired: &Desired<'_>, state: State<'_>) -> Result<&[f64]> {
        (**self).torques(desired, state)
    }

    fn integrate(&mut self, desired: &Desired<'_>, state: State<'_>, time: f64) {
        (**self).integrate(desired, state, time);
    }
}

/// Number of degrees of freedom of a law's equations. Joint-space laws need a fixed base.
fn fixed(equations: &Equations) -> Result<usize> {
    use crate::{Error, ErrorKind};
    let text = "this law needs a robot with a fixed base";
    if equations.is_floating() { Err(Error::new(ErrorKind::Unsupported, text)) } else { Ok(equations.freedoms()) }
}
