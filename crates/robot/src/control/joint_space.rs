//! Joint-space control laws: open loop, computed torque, and PD control with gravity compensation.

use super::{Desired, Law, fixed};
use crate::dynamics::{Equations, State, Workspace};
use crate::{Error, ErrorKind, Result};

/// PID gains for each degree of freedom.
#[derive(Clone, Debug, PartialEq)]
pub struct Gains {
    /// `Kp` \[1/s^2; for torques N m/rad\].
    pub proportional: Vec<f64>,
    /// `Kv` \[1/s; for torques N m s/rad\].
    pub derivative: Vec<f64>,
    /// `Ki` \[1/s^3; for torques N m/(rad s)\]; zero without integral action.
    pub integral: Vec<f64>,
}

impl Gains {
    /// Gains of critical damping at a frequency \[rad/s\]: `Kp = w^2` and `Kv = 2 w`.
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
        let text = || format!("give gains for {count} degrees of freedom, each finite and nonnegative");
        if lists.iter().all(is_right) { Ok(()) } else { Err(Error::new(ErrorKind::BadValue, text())) }
    }

    /// The correction of a degree of freedom: `-Kv e' - Kp e - Ki int e`.
    fn pull(&self, at: usize, desired: &Desired<'_>, state: &State<'_>, sum: &[f64]) -> f64 {
        let (error, rate) = (state.q[at] - desired.q[at], state.velocity[at] - desired.velocity[at]);
        -self.derivative[at] * rate - self.proportional[at] * error - self.integral[at] * sum[at]
    }
}

fn integrate_errors(sum: &mut [f64], desired: &Desired<'_>, state: &State<'_>, time: f64) {
    let errors = state.q.iter().zip(desired.q).map(|(q, desired)| q - desired);
    sum.iter_mut().zip(errors).for_each(|(sum, error)| *sum += error * time);
}

/// Open-loop control: the torques of the desired motion, independent of the state, RH0 (2-46).
#[derive(Clone, Debug)]
pub struct OpenLoop {
    equations: Equations,
    workspace: Workspace,
}

impl OpenLoop {
    /// Builds the law of a robot.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for a floating base.
    pub fn new(equations: &Equations) -> Result<Self> {
        fixed(equations)?;
        Ok(OpenLoop { workspace: equations.workspace(), equations: equations.clone() })
    }
}

impl Law for OpenLoop {
    fn torques(&mut self, desired: &Desired<'_>, _: State<'_>) -> Result<&[f64]> {
        let state = State::new(desired.q, desired.velocity);
        self.equations.inverse(&mut self.workspace, state, desired.acceleration).map(|torques| torques.as_slice())
    }
}

/// The commanded acceleration: the desired one with feedback of the errors.
#[derive(Clone, Debug)]
pub(super) struct Commanded {
    gains: Gains,
    sum: Vec<f64>,
    accelerations: Vec<f64>,
}

impl Commanded {
    /// Builds the feedback from gains in 1/s^2, 1/s and 1/s^3.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] unless there is one finite, nonnegative gain for each degree of freedom.
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

    /// Integrates the errors over a time \[s\].
    pub(super) fn integrate(&mut self, desired: &Desired<'_>, state: &State<'_>, time: f64) {
        integrate_errors(&mut self.sum, desired, state, time);
    }
}

/// Computed torque, RH0 (2-47): `M (q_d'' - Kv e' - Kp e) + C q' + N`, so that each error satisfies `e'' + Kv e' + Kp e
/// = 0`, independently of the others.
#[derive(Clone, Debug)]
pub struct ComputedTorque {
    equations: Equations,
    workspace: Workspace,
    commanded: Commanded,
}

impl ComputedTorque {
    /// Builds the law of a robot, with gains in 1/s^2, 1/s and 1/s^3.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] unless there is one finite, nonnegative gain for each degree of freedom;
    /// [`ErrorKind::Unsupported`] for a floating base.
    pub fn new(equations: &Equations, gains: Gains) -> Result<Self> {
        let commanded = Commanded::new(fixed(equations)?, gains)?;
        Ok(ComputedTorque { workspace: equations.workspace(), equations: equations.clone(), commanded })
    }
}

impl Law for ComputedTorque {
    fn torques(&mut self, desired: &Desired<'_>, state: State<'_>) -> Result<&[f64]> {
        let commanded = self.commanded.accelerations(desired, &state);
        self.equations.inverse(&mut self.workspace, state, commanded).map(|torques| torques.as_slice())
    }

    fn integrate(&mut self, desired: &Desired<'_>, state: State<'_>, time: f64) {
        self.commanded.integrate(desired, &state, time);
    }
}

/// PD control with gravity compensation: `N - Kv e' - Kp e`. The desired configuration is globally asymptotically
/// stable, also with the robot's own damping alone (M. Takegaki and S. Arimoto, J. Dynamic Systems, Measurement, and
/// Control 103, 1981).
#[derive(Clone, Debug)]
pub struct GravityCompensation {
    equations: Equations,
    workspace: Workspace,
    gains: Gains,
    sum: Vec<f64>,
    torques: Vec<f64>,
}

impl GravityCompensation {
    /// Builds the law of a robot, with gains in N m/rad, N m s/rad and N m/(rad s).
    ///
    /// # Errors
    /// Those of [`ComputedTorque::new`].
    pub fn new(equations: &Equations, gains: Gains) -> Result<Self> {
        let count = fixed(equations)?;
        gains.check(count)?;
        let zeros = vec![0.0; count];
        let (sum, torques) = (zeros.clone(), zeros);
        Ok(GravityCompensation { workspace: equations.workspace(), equations: equations.clone(), gains, sum, torques })
    }
}

impl Law for GravityCompensation {
    fn torques(&mut self, desired: &Desired<'_>, state: State<'_>) -> Result<&[f64]> {
        let gravity = self.equations.gravity(&mut self.workspace, state.q)?;
        for (at, (torque, gravity)) in self.torques.iter_mut().zip(gravity.iter()).enumerate() {
            *torque = gravity + self.gains.pull(at, desired, &state, &self.sum);
        }
        Ok(&self.torques)
    }

    fn integrate(&mut self, desired: &Desired<'_>, state: State<'_>, time: f64) {
        integrate_errors(&mut self.sum, desired, &state, time);
    }
}
