//! Laws in joint space: open loop, computed torque, and proportional and derivative action with gravity compensated.

use super::{Desired, Law, fixed};
use crate::dynamics::{Equations, State, Workspace};
use crate::{Error, ErrorKind, Result};

/// By freedom the factors of an error, its rate, and its integral in time.
#[derive(Clone, Debug, PartialEq)]
pub struct Gains {
    /// `Kp` \[1/s^2, or of torques N m/rad\].
    pub proportional: Vec<f64>,
    /// `Kv` \[1/s, or N m s/rad\].
    pub derivative: Vec<f64>,
    /// `Ki` \[1/s^3, or N m/(rad s)\]; nought for none.
    pub integral: Vec<f64>,
}

impl Gains {
    /// Those with which errors die out as fast as they can without swinging, at a frequency \[rad/s\]: `Kp = w^2` and `Kv = 2 w`.
    pub fn critical(count: usize, frequency: f64) -> Self {
        Gains {
            proportional: vec![frequency * frequency; count],
            derivative: vec![2.0 * frequency; count],
            integral: vec![0.0; count],
        }
    }

    fn check(&self, count: usize) -> Result<()> {
        let lists = [&self.proportional, &self.derivative, &self.integral];
        let is_right = |list: &&Vec<f64>| list.len() == count && list.iter().all(|x| x.is_finite() && *x >= 0.0);
        let text = || format!("give gains of {count} freedoms, each finite and not below zero");
        if lists.iter().all(is_right) { Ok(()) } else { Err(Error::new(ErrorKind::BadValue, text())) }
    }

    /// What the errors of a freedom ask for: `-Kv e' - Kp e - Ki int e`.
    fn pull(&self, at: usize, desired: &Desired<'_>, state: &State<'_>, sum: &[f64]) -> f64 {
        let (error, rate) = (state.q[at] - desired.q[at], state.velocity[at] - desired.velocity[at]);
        -self.derivative[at] * rate - self.proportional[at] * error - self.integral[at] * sum[at]
    }
}

fn endured(sum: &mut [f64], desired: &Desired<'_>, state: &State<'_>, time: f64) {
    let errors = state.q.iter().zip(desired.q).map(|(q, desired)| q - desired);
    sum.iter_mut().zip(errors).for_each(|(sum, error)| *sum += error * time);
}

/// The torques that the desired motion asks for, wherever the robot is, RH0 (2-46).
#[derive(Clone, Debug)]
pub struct OpenLoop {
    equations: Equations,
    room: Workspace,
}

impl OpenLoop {
    /// That of a robot.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for a base that moves freely.
    pub fn new(equations: &Equations) -> Result<Self> {
        fixed(equations)?;
        Ok(OpenLoop { room: equations.workspace(), equations: equations.clone() })
    }
}

impl Law for OpenLoop {
    fn torques(&mut self, desired: &Desired<'_>, _: State<'_>) -> Result<&[f64]> {
        let state = State::new(desired.q, desired.velocity);
        self.equations.inverse(&mut self.room, state, desired.acceleration).map(|torques| torques.as_slice())
    }
}

/// What errors make of the acceleration that is desired.
#[derive(Clone, Debug)]
pub(super) struct Commanded {
    gains: Gains,
    sum: Vec<f64>,
    accelerations: Vec<f64>,
}

impl Commanded {
    /// That of gains in 1/s^2, 1/s and 1/s^3.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for gains that are not as many as freedoms, finite and not below zero.
    pub(super) fn new(count: usize, gains: Gains) -> Result<Self> {
        gains.check(count)?;
        Ok(Commanded { gains, sum: vec![0.0; count], accelerations: vec![0.0; count] })
    }

    /// `q_d'' - Kv e' - Kp e - Ki int e`.
    pub(super) fn accelerations(&mut self, desired: &Desired<'_>, state: &State<'_>) -> &[f64] {
        for (at, commanded) in self.accelerations.iter_mut().enumerate() {
            *commanded = desired.acceleration[at] + self.gains.pull(at, desired, state, &self.sum);
        }
        &self.accelerations
    }

    /// Adds errors that have lasted for a time \[s\].
    pub(super) fn endure(&mut self, desired: &Desired<'_>, state: &State<'_>, time: f64) {
        endured(&mut self.sum, desired, state, time);
    }
}

/// Computed torque, RH0 (2-47): `M (q_d'' - Kv e' - Kp e) + C q' + N`, so that each error obeys `e'' + Kv e' + Kp e = 0`, whatever the others do.
#[derive(Clone, Debug)]
pub struct ComputedTorque {
    equations: Equations,
    room: Workspace,
    commanded: Commanded,
}

impl ComputedTorque {
    /// That of a robot, with gains in 1/s^2, 1/s and 1/s^3.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for gains that are not as many as freedoms, finite and not below zero; [`ErrorKind::Unsupported`] for a base that moves freely.
    pub fn new(equations: &Equations, gains: Gains) -> Result<Self> {
        let commanded = Commanded::new(fixed(equations)?, gains)?;
        Ok(ComputedTorque { room: equations.workspace(), equations: equations.clone(), commanded })
    }
}

impl Law for ComputedTorque {
    fn torques(&mut self, desired: &Desired<'_>, state: State<'_>) -> Result<&[f64]> {
        let commanded = self.commanded.accelerations(desired, &state);
        self.equations.inverse(&mut self.room, state, commanded).map(|torques| torques.as_slice())
    }

    fn endure(&mut self, desired: &Desired<'_>, state: State<'_>, time: f64) {
        self.commanded.endure(desired, &state, time);
    }
}

/// Gravity compensated, and errors pulled back by proportional and derivative action: `N - Kv e' - Kp e`. It comes to rest where it should wherever it starts, of
/// the robot's own damping alone if need be (M. Takegaki and S. Arimoto, J. Dynamic Systems, Measurement, and Control 103, 1981).
#[derive(Clone, Debug)]
pub struct GravityCompensation {
    equations: Equations,
    room: Workspace,
    gains: Gains,
    sum: Vec<f64>,
    torques: Vec<f64>,
}

impl GravityCompensation {
    /// That of a robot, with gains in N m/rad, N m s/rad and N m/(rad s).
    ///
    /// # Errors
    /// As [`ComputedTorque::new`].
    pub fn new(equations: &Equations, gains: Gains) -> Result<Self> {
        let count = fixed(equations)?;
        gains.check(count)?;
        let zeros = vec![0.0; count];
        let (sum, torques) = (zeros.clone(), zeros);
        Ok(GravityCompensation { room: equations.workspace(), equations: equations.clone(), gains, sum, torques })
    }
}

impl Law for GravityCompensation {
    fn torques(&mut self, desired: &Desired<'_>, state: State<'_>) -> Result<&[f64]> {
        let gravity = self.equations.gravity(&mut self.room, state.q)?;
        for (at, (torque, gravity)) in self.torques.iter_mut().zip(gravity.iter()).enumerate() {
            *torque = gravity + self.gains.pull(at, desired, &state, &self.sum);
        }
        Ok(&self.torques)
    }

    fn endure(&mut self, desired: &Desired<'_>, state: State<'_>, time: f64) {
        endured(&mut self.sum, desired, &state, time);
    }
}
