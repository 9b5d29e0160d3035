//! Computed torque of a UR5 with delay, noise, or more mass than in the model: a picture of the largest error over
//! time.
//!
//!     cargo run --release --example 08_disturbances > docs/disturbances.svg

use std::f64::consts::TAU;

use groebot::control::{ClosedLoop, ComputedTorque, Disturbance, Gains, Sample, greatest_errors};
use groebot::dynamics::{Base, Equations};
use groebot::model::Robot;
use groebot::number::BigRational;
use groebot::{Result, Watch};

const FREQUENCY: f64 = 20.0;

fn main() -> Result<()> {
    let described = Robot::from_urdf(include_str!("../tests/corpus/dynamics/ur5.urdf"))?;
    let mut parts = described.parts().clone();
    for mass in parts.links.iter_mut().filter_map(|link| link.mass.as_mut()) {
        let factor = BigRational::new(105.into(), 100.into());
        mass.mass *= &factor;
        mass.moments.iter_mut().for_each(|moment| *moment *= &factor);
    }
    let known = Equations::new(&described, Base::Fixed)?.without_friction();
    let heavy = Equations::new(&Robot::new(parts)?, Base::Fixed)?.without_friction();

    let rate = TAU * 0.4;
    let wave = |time: f64| {
        let list = |value: fn(f64) -> f64, depth: f64| -> Vec<f64> {
            (0..6).map(|joint| depth * value(rate * time + f64::from(joint))).collect()
        };
        [list(f64::sin, 0.3), list(f64::cos, 0.3 * rate), list(f64::sin, -0.3 * rate * rate)]
    };
    let [q, velocity, _] = wave(0.0);
    let start: Vec<f64> = q.iter().map(|q| q + 0.02).collect();
    let run = |real: &Equations, integral: f64, disturbance: Disturbance| -> Result<Vec<Sample>> {
        let gains = Gains { integral: vec![integral; 6], ..Gains::critical(6, FREQUENCY) };
        let law = ComputedTorque::new(&known, gains)?;
        let samples =
            ClosedLoop::new(real, law, 1e-3, disturbance)?.run([&start, &velocity], 5.0, wave, &Watch::none())?;
        Ok(samples.into_iter().step_by(10).collect())
    };
    let calm = Disturbance::default();
    let runs = [
        ("as it is", run(&known, 0.0, calm)?),
        ("1 ms late", run(&known, 0.0, Disturbance { delay: 1, ..calm })?),
        ("noise 1e-4, 1e-3", run(&known, 0.0, Disturbance { noise: [1e-4, 1e-3], ..calm })?),
        ("5 % heavier", run(&heavy, 0.0, calm)?),
        ("and with integral", run(&heavy, 2000.0, calm)?),
    ];
    print!("{}", greatest_errors(&runs.each_ref().map(|(name, samples)| (*name, samples.as_slice()))));
    Ok(())
}
