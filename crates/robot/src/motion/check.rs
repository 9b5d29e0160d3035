//! Checks of a motion: limits, speeds, jumps and margins. Main function: [`findings`].

use super::{JointTrack, Trajectory};

/// The bounds of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Maximum joint velocity as a fraction of the joint's own maximum.
    pub speed_share: f64,
    /// Maximum step of a joint without a given speed, from sample to sample \[rad or m\].
    pub jump: f64,
    /// Minimum of the figure `margin`, if there is one \[m\].
    pub margin: f64,
}

impl Default for Bounds {
    /// Full speed, steps of half a radian, nonnegative margins.
    fn default() -> Self {
        Bounds { speed_share: 1.0, jump: 0.5, margin: 0.0 }
    }
}

/// Violation at a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fault {
    /// A joint exceeds its limits.
    Limit {
        /// The index of the joint.
        joint: usize,
        /// Its value.
        value: f64,
    },
    /// A joint exceeds its maximum velocity.
    Speed {
        /// The index of the joint.
        joint: usize,
        /// Its velocity since the previous sample.
        rate: f64,
    },
    /// A joint without a given speed exceeds the maximum step.
    Jump {
        /// The index of the joint.
        joint: usize,
        /// The step.
        step: f64,
    },
    /// The margin is too small.
    Margin {
        /// The margin.
        margin: f64,
    },
}

/// A violation with its sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finding {
    /// The index of the sample, from 0.
    pub sample: usize,
    /// The violation.
    pub fault: Fault,
}

/// All violations of `trajectory` in the order of time, at most one of each kind for a sample.
pub fn findings(trajectory: &Trajectory, bounds: &Bounds) -> Vec<Finding> {
    let margins = trajectory.figures.iter().find(|figure| figure.name == "margin");
    let mut found = Vec::new();
    for (sample, q) in trajectory.q.iter().enumerate() {
        let mut add = |fault: Option<Fault>| found.extend(fault.map(|fault| Finding { sample, fault }));
        let limits = trajectory.joints.iter().map(|joint| joint.limits);
        add(beyond_limit(limits, q).map(|(joint, value)| Fault::Limit { joint, value }));
        if let Some(before) = sample.checked_sub(1) {
            let time = trajectory.times[sample] - trajectory.times[before];
            let speeds = trajectory.joints.iter().map(|joint| joint.speed.map(|speed| speed * bounds.speed_share));
            let fast = too_fast(speeds, &trajectory.q[before], q, time);
            add(fast.map(|(joint, rate)| Fault::Speed { joint, rate }));
            add(jumps(&trajectory.joints, &trajectory.q[before], q, bounds.jump));
        }
        let margin = margins.map(|figure| figure.values[sample]).filter(|margin| *margin < bounds.margin);
        add(margin.map(|margin| Fault::Margin { margin }));
    }
    found
}

/// The first joint that exceeds its limits, by its index, with its value.
pub fn beyond_limit(limits: impl Iterator<Item = Option<(f64, f64)>>, q: &[f64]) -> Option<(usize, f64)> {
    let beyond =
        |(limits, value): (Option<(f64, f64)>, &f64)| limits.is_some_and(|(low, high)| *value < low || *value > high);
    let joint = limits.zip(q).position(beyond)?;
    Some((joint, q[joint]))
}

/// The first joint that cannot move from `before` to `q` in `time` \[s\] at its maximum velocity, by its index, with
/// its velocity.
pub fn too_fast(
    speeds: impl Iterator<Item = Option<f64>>,
    before: &[f64],
    q: &[f64],
    time: f64,
) -> Option<(usize, f64)> {
    let rates = q.iter().zip(before).map(|(to, from)| (to - from) / time);
    let fast = |(speed, rate): (Option<f64>, f64)| speed.is_some_and(|speed| rate.abs() > speed).then_some(rate);
    speeds.zip(rates).map(fast).enumerate().find_map(|(joint, rate)| Some((joint, rate?)))
}

/// The first joint without a given speed whose step exceeds `most`.
fn jumps(joints: &[JointTrack], before: &[f64], q: &[f64], most: f64) -> Option<Fault> {
    let far = |joint: &usize| joints[*joint].speed.is_none() && (q[*joint] - before[*joint]).abs() > most;
    let joint = (0..joints.len()).find(far)?;
    Some(Fault::Jump { joint, step: q[joint] - before[joint] })
}
