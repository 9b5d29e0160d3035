//! Control laws, RH0 2.5: what torques make a robot follow a reference. They return torques and own no clock. Main type: [`Law`].
//!
//! Errors are what is less what should be, `e = q - q_d`, as in the thesis. [`ClosedLoop`] puts a law and a robot together.

mod closed_loop;
mod joint_space;
mod picture;
mod reference;
mod two_chains;
mod work_space;

pub use closed_loop::{ClosedLoop, Disturbance, Sample};
pub use joint_space::{ComputedTorque, Gains, GravityCompensation, OpenLoop};
pub use picture::{errors_and_torques, greatest_errors};
pub use reference::{Desired, Trajectory};
pub use two_chains::TwoChains;
pub use work_space::{Effective, Inversion, Target, WorkSpace};

use crate::Result;
use crate::dynamics::{Equations, State};

/// A control law of a robot: it reads where the robot is and should be.
pub trait Law {
    /// The torques at a state, of each freedom.
    ///
    /// # Errors
    /// As [`Equations::inverse`], and what the law itself refuses.
    fn torques(&mut self, desired: &Desired<'_>, state: State<'_>) -> Result<&[f64]>;

    /// Tells the law that an error has lasted for a time \[s\]; laws without integral action do not mind.
    fn endure(&mut self, desired: &Desired<'_>, state: State<'_>, time: f64) {
        let _ = (desired, state, time);
    }
}

/// A law whose torques are cut at what the motors give.
#[derive(Clone, Debug)]
pub struct Limited<L> {
    law: L,
    most: Vec<f64>,
    torques: Vec<f64>,
    cut: Vec<f64>,
}

impl<L: Law> Limited<L> {
    /// The law with the greatest torque of each freedom \[N m or N\]; infinite where there is none.
    pub fn new(law: L, most: Vec<f64>) -> Self {
        let count = most.len();
        Limited { law, most, torques: vec![0.0; count], cut: vec![0.0; count] }
    }

    /// By freedom, what was cut off the last torques, with its sign.
    pub fn cut(&self) -> &[f64] {
        &self.cut
    }
}

impl<L: Law> Law for Limited<L> {
    fn torques(&mut self, desired: &Desired<'_>, state: State<'_>) -> Result<&[f64]> {
        let asked = self.law.torques(desired, state)?;
        for (at, (asked, most)) in asked.iter().zip(&self.most).enumerate() {
            self.torques[at] = asked.clamp(-most, *most);
            self.cut[at] = asked - self.torques[at];
        }
        Ok(&self.torques)
    }

    fn endure(&mut self, desired: &Desired<'_>, state: State<'_>, time: f64) {
        // What lasts while a motor gives all it can is not summed up: it would take as long to be undone.
        if self.cut.iter().all(|cut| *cut == 0.0) {
            self.law.endure(desired, state, time);
        }
    }
}

impl<L: Law + ?Sized> Law for Box<L> {
    fn torques(&mut self, desired: &Desired<'_>, state: State<'_>) -> Result<&[f64]> {
        (**self).torques(desired, state)
    }

    fn endure(&mut self, desired: &Desired<'_>, state: State<'_>, time: f64) {
        (**self).endure(desired, state, time);
    }
}

/// How many freedoms the equations of a law have; laws of joints ask for a base that is fixed.
fn fixed(equations: &Equations) -> Result<usize> {
    use crate::{Error, ErrorKind};
    let text = "this law is for a robot whose base is fixed";
    if equations.is_floating() { Err(Error::new(ErrorKind::Unsupported, text)) } else { Ok(equations.freedoms()) }
}
