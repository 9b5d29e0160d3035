//! A polar arm follows a sine wave under computed torque, with 5 % more mass than in the law's model. Then its inertial parameters are identified from its
//! motion.
//!
//!     cargo run --example 07_computed_torque

use groebot::control::{ClosedLoop, ComputedTorque, Disturbance, Gains};
use groebot::dynamics::{Base, Equations, Logged, State};
use groebot::model::Robot;
use groebot::number::BigRational;
use groebot::{Result, Watch};

fn main() -> Result<()> {
    let described = Robot::from_urdf(include_str!("../tests/corpus/dynamics/rrp.urdf"))?;
    let mut parts = described.parts().clone();
    for mass in parts.links.iter_mut().filter_map(|link| link.mass.as_mut()) {
        let factor = BigRational::new(105.into(), 100.into());
        mass.mass *= &factor;
        mass.moments.iter_mut().for_each(|moment| *moment *= &factor);
    }
    let known = Equations::new(&described, Base::Fixed)?;
    let real = Equations::new(&Robot::new(parts)?, Base::Fixed)?;

    let wave = |time: f64| {
        let list =
            |value: fn(f64) -> f64| -> Vec<f64> { (0..3).map(|joint| value(2.0 * time + f64::from(joint))).collect() };
        [list(|x| 0.3 * x.sin()), list(|x| 0.6 * x.cos()), list(|x| -1.2 * x.sin())]
    };
    let [q, velocity, _] = wave(0.0);
    let law = ComputedTorque::new(&known, Gains::critical(3, 20.0))?;
    let mut closed = ClosedLoop::new(&real, law, 1e-3, Disturbance::default())?;
    let samples = closed.run([&q, &velocity], 4.0, wave, &Watch::none())?;
    let worst = samples.iter().flat_map(|sample| sample.q.iter().zip(&sample.desired).map(|(q, d)| (q - d).abs()));
    println!("worst error: {:.2e}", worst.fold(0.0, f64::max));

    let mut room = real.workspace();
    let logged = samples.iter().step_by(20).map(|sample| {
        let state = State::new(&sample.q, &sample.velocity);
        let acceleration = real.forward(&mut room, state, &sample.torques)?.as_slice().to_vec();
        let (q, velocity, torques) = (sample.q.clone(), sample.velocity.clone(), sample.torques.clone());
        Ok(Logged { q, velocity, acceleration, torques })
    });
    let log = logged.collect::<Result<Vec<_>>>()?;
    let found = known.identify(&log, false)?;
    for estimate in &found.base {
        println!("{:>12.6} instead of {:>12.6}   {}", estimate.value, estimate.described, estimate.name);
    }
    Ok(())
}
