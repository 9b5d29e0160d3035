//! Simulation of a robot under a control law. Main type: [`ClosedLoop`].

use super::{Desired, Law};
use crate::dynamics::{Equations, State, Workspace};
use crate::{Error, ErrorKind, Result, Watch};
use groebot_algebra::limits::{CONTROL_STEPS, check_count};
use groebot_algebra::random::SplitMix64;

/// Disturbances: actuation delay and measurement noise.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Disturbance {
    /// Delay until torques act, in steps.
    pub delay: usize,
    /// Standard deviations of the measured positions \[rad or m\] and velocities \[rad/s or m/s\].
    pub noise: [f64; 2],
    /// The seed of the noise.
    pub seed: u64,
}

/// A robot under a control law. Torques are constant during a step, which is integrated by the Runge-Kutta method of
/// order four.
#[derive(Debug)]
pub struct ClosedLoop<'a, L> {
    plant: &'a Equations,
    workspace: Workspace,
    law: L,
    step: f64,
    disturbance: Disturbance,
}

/// A sample of a simulation.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Sample {
    /// The time since the beginning \[s\].
    pub time: f64,
    /// The configuration.
    pub q: Vec<f64>,
    /// The velocity.
    pub velocity: Vec<f64>,
    /// The torques, constant from this time on.
    pub torques: Vec<f64>,
    /// The desired configuration.
    pub desired: Vec<f64>,
}

impl<'a, L: Law> ClosedLoop<'a, L> {
    /// Builds the simulation of `plant`, which may differ from the law's model. `step` is the time for which torques
    /// are constant \[s\].
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a step that is not positive; [`ErrorKind::Unsupported`] for a floating base.
    pub fn new(plant: &'a Equations, law: L, step: f64, disturbance: Disturbance) -> Result<Self> {
        super::fixed(plant)?;
        if !(step.is_finite() && step > 0.0) {
            return Err(Error::new(ErrorKind::BadValue, format!("a step of {step} s: give a positive one")));
        }
        Ok(ClosedLoop { workspace: plant.workspace(), plant, law, step, disturbance })
    }

    /// Simulates the robot for `duration` \[s\] from a configuration and a velocity. `desired` returns the desired
    /// configuration, velocity and acceleration at a time.
    ///
    /// # Errors
    /// Those of [`Law::torques`] and [`Equations::forward`], with the time; those of [`Watch::check`].
    pub fn run<'w>(
        &mut self,
        start: [&[f64]; 2],
        duration: f64,
        desired: impl Fn(f64) -> [Vec<f64>; 3],
        watch: impl Into<Option<&'w Watch>>,
    ) -> Result<Vec<Sample>> {
        let watch = Watch::or_none(watch);
        let [mut q, mut velocity] = start.map(<[f64]>::to_vec);
        // A quotient outside the range of integers becomes the largest integer.
        let steps = (duration / self.step).round() as usize;
        check_count("steps of the law", steps, CONTROL_STEPS)?;
        check_count("steps of delay", self.disturbance.delay, CONTROL_STEPS)?;
        let mut samples: Vec<Sample> = Vec::with_capacity(steps + 1);
        let mut noise = Noise(SplitMix64::new(self.disturbance.seed));
        for number in 0..=steps {
            watch.check()?;
            let time = number as f64 * self.step;
            let [place, rate, change] = desired(time);
            let wanted = Desired { q: &place, velocity: &rate, acceleration: &change };
            let [of_place, of_rate] = self.disturbance.noise;
            let measured = [noise.added(&q, of_place), noise.added(&velocity, of_rate)];
            let measured_state = State::new(&measured[0], &measured[1]);
            let at = |error: Error| error.with_context(format!("at {time:.4} s"));
            let commanded = self.law.torques(&wanted, measured_state).map_err(at)?.to_vec();
            self.law.integrate(&wanted, measured_state, self.step);
            let torques = match number.checked_sub(self.disturbance.delay) {
                _ if self.disturbance.delay == 0 => commanded.clone(),
                Some(earlier) => samples[earlier].torques.clone(),
                None => samples.first().map_or(&commanded, |first| &first.torques).clone(),
            };
            samples.push(Sample { time, q: q.clone(), velocity: velocity.clone(), torques: commanded, desired: place });
            if number < steps {
                self.advance(&mut q, &mut velocity, &torques).map_err(at)?;
            }
        }
        Ok(samples)
    }

    /// Integrates one step.
    fn advance(&mut self, q: &mut [f64], velocity: &mut [f64], torques: &[f64]) -> Result<()> {
        let step = self.step;
        let along = |from: &[f64], slope: &[f64], time: f64| -> Vec<f64> {
            from.iter().zip(slope).map(|(from, slope)| from + time * slope).collect()
        };
        let mut change = |q: &[f64], velocity: &[f64]| -> Result<Vec<f64>> {
            Ok(self.plant.forward(&mut self.workspace, State::new(q, velocity), torques)?.as_slice().to_vec())
        };
        let first = change(q, velocity)?;
        let [q_2, v_2] = [along(q, velocity, step / 2.0), along(velocity, &first, step / 2.0)];
        let second = change(&q_2, &v_2)?;
        let [q_3, v_3] = [along(q, &v_2, step / 2.0), along(velocity, &second, step / 2.0)];
        let third = change(&q_3, &v_3)?;
        let [q_4, v_4] = [along(q, &v_3, step), along(velocity, &third, step)];
        let fourth = change(&q_4, &v_4)?;
        for at in 0..q.len() {
            q[at] += step / 6.0 * (velocity[at] + 2.0 * v_2[at] + 2.0 * v_3[at] + v_4[at]);
        }
        for at in 0..velocity.len() {
            velocity[at] += step / 6.0 * (first[at] + 2.0 * second[at] + 2.0 * third[at] + fourth[at]);
        }
        let finite = q.iter().chain(&*velocity).all(|x| x.is_finite());
        let text = "the motion exceeds the range of doubles: the law does not stabilise the robot";
        if finite { Ok(()) } else { Err(Error::new(ErrorKind::BadValue, text)) }
    }
}

/// Normal noise by the Box-Muller transform.
struct Noise(SplitMix64);

impl Noise {
    /// A number in (0, 1].
    fn uniform(&mut self) -> f64 {
        // The sum is exact.
        self.0.share() + 1.0 / (1_u64 << 53) as f64
    }

    fn added(&mut self, numbers: &[f64], deviation: f64) -> Vec<f64> {
        if deviation == 0.0 {
            return numbers.to_vec();
        }
        let mut normal = || {
            let radius = (-2.0 * self.uniform().ln()).sqrt();
            radius * (std::f64::consts::TAU * self.uniform()).cos()
        };
        numbers.iter().map(|number| number + deviation * normal()).collect()
    }
}
