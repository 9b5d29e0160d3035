//! A law and a robot together: what the robot does. Main type: [`ClosedLoop`].

use super::{Desired, Law};
use crate::dynamics::{Equations, State, Workspace};
use crate::{Error, ErrorKind, Result, Watch};
use groebot_algebra::limits::{CONTROL_STEPS, check_count};

/// What a law does not know of a robot.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Disturbance {
    /// How many steps pass until torques act.
    pub delay: usize,
    /// The standard deviation of what is measured of places \[rad or m\] and of rates, per second of these.
    pub noise: [f64; 2],
    /// The seed of the noise.
    pub seed: u64,
}

/// A robot that a law moves: torques are held for a step, in which the robot moves by Runge's and Kutta's method of order four.
#[derive(Debug)]
pub struct ClosedLoop<'a, L> {
    plant: &'a Equations,
    room: Workspace,
    law: L,
    step: f64,
    disturbance: Disturbance,
}

/// A robot at a time.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Sample {
    /// Since the beginning \[s\].
    pub time: f64,
    /// Where it is.
    pub q: Vec<f64>,
    /// How it moves.
    pub velocity: Vec<f64>,
    /// What is held from here on.
    pub torques: Vec<f64>,
    /// Where it should be.
    pub desired: Vec<f64>,
}

impl<'a, L: Law> ClosedLoop<'a, L> {
    /// A robot, of which a law may know something else, and the time for which torques are held \[s\].
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a step that is not positive; [`ErrorKind::Unsupported`] for a base that moves freely.
    pub fn new(plant: &'a Equations, law: L, step: f64, disturbance: Disturbance) -> Result<Self> {
        super::fixed(plant)?;
        if !(step.is_finite() && step > 0.0) {
            return Err(Error::new(ErrorKind::BadValue, format!("a step of {step} s: give a positive one")));
        }
        Ok(ClosedLoop { room: plant.workspace(), plant, law, step, disturbance })
    }

    /// What the robot does in a time \[s\] from a configuration and rates; `desired` tells configuration, rates and what these change by at a time.
    ///
    /// # Errors
    /// As [`Law::torques`] and [`Equations::forward`], with the time; [`Watch::check`].
    pub fn run(
        &mut self,
        start: [&[f64]; 2],
        duration: f64,
        desired: impl Fn(f64) -> [Vec<f64>; 3],
        watch: &Watch,
    ) -> Result<Vec<Sample>> {
        let [mut q, mut velocity] = start.map(<[f64]>::to_vec);
        // A quotient beyond the integers is the greatest one.
        let steps = (duration / self.step).round() as usize;
        check_count("steps of the law", steps, CONTROL_STEPS)?;
        check_count("steps of delay", self.disturbance.delay, CONTROL_STEPS)?;
        let mut samples: Vec<Sample> = Vec::with_capacity(steps + 1);
        let mut noise = Noise(self.disturbance.seed);
        for number in 0..=steps {
            watch.check()?;
            let time = number as f64 * self.step;
            let [place, rate, change] = desired(time);
            let wanted = Desired { q: &place, velocity: &rate, acceleration: &change };
            let [of_place, of_rate] = self.disturbance.noise;
            let measured = [noise.added(&q, of_place), noise.added(&velocity, of_rate)];
            let seen = State::new(&measured[0], &measured[1]);
            let at = |error: Error| error.with_context(format!("at {time:.4} s"));
            let asked = self.law.torques(&wanted, seen).map_err(at)?.to_vec();
            self.law.endure(&wanted, seen, self.step);
            let torques = match number.checked_sub(self.disturbance.delay) {
                _ if self.disturbance.delay == 0 => asked.clone(),
                Some(earlier) => samples[earlier].torques.clone(),
                None => samples.first().map_or(&asked, |first| &first.torques).clone(),
            };
            samples.push(Sample { time, q: q.clone(), velocity: velocity.clone(), torques: asked, desired: place });
            if number < steps {
                self.advance(&mut q, &mut velocity, &torques).map_err(at)?;
            }
        }
        Ok(samples)
    }

    /// Moves the robot on by a step.
    fn advance(&mut self, q: &mut [f64], velocity: &mut [f64], torques: &[f64]) -> Result<()> {
        let step = self.step;
        let along = |from: &[f64], way: &[f64], time: f64| -> Vec<f64> {
            from.iter().zip(way).map(|(from, way)| from + time * way).collect()
        };
        let mut change = |q: &[f64], velocity: &[f64]| -> Result<Vec<f64>> {
            Ok(self.plant.forward(&mut self.room, State::new(q, velocity), torques)?.as_slice().to_vec())
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
        let text = "the motion grows beyond doubles: the law does not hold the robot";
        if finite { Ok(()) } else { Err(Error::new(ErrorKind::BadValue, text)) }
    }
}

/// Normal noise by SplitMix64 (Steele, Lea and Flood 2014) and Box and Muller.
struct Noise(u64);

impl Noise {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        // In (0, 1].
        (((z ^ (z >> 31)) >> 11) + 1) as f64 / (1u64 << 53) as f64
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
