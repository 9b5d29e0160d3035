//! What a motion must keep: limits, speeds, jumps and margins. Main function: [`findings`].

use super::{JointTrack, Trajectory};

/// What is demanded of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The greatest share of its own speed that a joint may have.
    pub speed_share: f64,
    /// How far a joint whose speed is not told may go from sample to sample \[rad or m\].
    pub jump: f64,
    /// The least value of the figure `margin`, where there is one \[m\].
    pub margin: f64,
}

impl Default for Bounds {
    /// Full speed, jumps of half a radian, margins that are not negative.
    fn default() -> Self {
        Bounds { speed_share: 1.0, jump: 0.5, margin: 0.0 }
    }
}

/// What is wrong at a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fault {
    /// A joint is beyond its limits.
    Limit {
        /// The joint, by its place.
        joint: usize,
        /// Its value.
        value: f64,
    },
    /// A joint moves faster than it can.
    Speed {
        /// The joint, by its place.
        joint: usize,
        /// Its rate since the sample before.
        rate: f64,
    },
    /// A joint whose speed is not told goes far in one step.
    Jump {
        /// The joint, by its place.
        joint: usize,
        /// How far.
        step: f64,
    },
    /// The margin is too small.
    Margin {
        /// The margin.
        margin: f64,
    },
}

/// A fault at its sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finding {
    /// The sample, from 0.
    pub sample: usize,
    /// What is wrong.
    pub fault: Fault,
}

/// All that is wrong with `trajectory`, in the order of time, of each kind one at most for a sample.
pub fn findings(trajectory: &Trajectory, bounds: &Bounds) -> Vec<Finding> {
    let margins = trajectory.figures.iter().find(|figure| figure.name == "margin");
    let mut found = Vec::new();
    for (sample, q) in trajectory.q.iter().enumerate() {
        let mut add = |fault: Option<Fault>| found.extend(fault.map(|fault| Finding { sample, fault }));
        add(beyond_limit(&trajectory.joints, q));
        if let Some(before) = sample.checked_sub(1) {
            let time = trajectory.times[sample] - trajectory.times[before];
            add(too_fast(&trajectory.joints, &trajectory.q[before], q, time * bounds.speed_share));
            add(jumps(&trajectory.joints, &trajectory.q[before], q, bounds.jump));
        }
        let margin = margins.map(|figure| figure.values[sample]).filter(|margin| *margin < bounds.margin);
        add(margin.map(|margin| Fault::Margin { margin }));
    }
    found
}

/// The first joint beyond its limits.
pub fn beyond_limit(joints: &[JointTrack], q: &[f64]) -> Option<Fault> {
    let beyond = |(joint, value): (&JointTrack, &f64)| joint.limits.is_some_and(|(low, high)| *value < low || *value > high);
    let joint = joints.iter().zip(q).position(beyond)?;
    Some(Fault::Limit { joint, value: q[joint] })
}

/// The first joint that cannot go from `before` to `q` in `time` \[s\].
pub fn too_fast(joints: &[JointTrack], before: &[f64], q: &[f64], time: f64) -> Option<Fault> {
    let fast = |joint: &usize| joints[*joint].speed.is_some_and(|speed| (q[*joint] - before[*joint]).abs() > speed * time);
    let joint = (0..joints.len()).find(fast)?;
    Some(Fault::Speed { joint, rate: (q[joint] - before[joint]) / time })
}

/// The first joint without a told speed that goes further than `most`.
fn jumps(joints: &[JointTrack], before: &[f64], q: &[f64], most: f64) -> Option<Fault> {
    let far = |joint: &usize| joints[*joint].speed.is_none() && (q[*joint] - before[*joint]).abs() > most;
    let joint = (0..joints.len()).find(far)?;
    Some(Fault::Jump { joint, step: q[joint] - before[joint] })
}
