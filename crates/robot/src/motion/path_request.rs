//! The poses and the timing of a path. Main type: [`PathRequest`].

use crate::spatial::Pose;
use crate::{Error, ErrorKind, Result};

/// Timing of a path.
#[derive(Clone, Debug, PartialEq)]
pub enum Pace {
    /// One pose every this many seconds. Joints may use their maximum velocity.
    Every(f64),
    /// At these times \[s\], ascending.
    At(Vec<f64>),
}

impl Pace {
    /// The times of `count` poses \[s\].
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for no pose, a time between poses that is not positive, and a number of times other than `count`.
    pub fn times(&self, count: usize) -> Result<Vec<f64>> {
        let bad = |text: String| Err(Error::new(ErrorKind::BadValue, text));
        match self {
            _ if count == 0 => bad("there is no pose; give at least one".to_owned()),
            Pace::Every(time) if !(time.is_finite() && *time > 0.0) => {
                bad(format!("the time between two poses is {time}; give a positive number"))
            }
            Pace::Every(time) => Ok((0..count).map(|sample| sample as f64 * time).collect()),
            Pace::At(times) if times.len() != count => {
                bad(format!("{} times for {count} poses; give one each", times.len()))
            }
            Pace::At(times) => Ok(times.clone()),
        }
    }
}

/// Poses that an arm moves through.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct PathRequest<'a> {
    /// The poses base_from_tip, in order.
    pub poses: &'a [Pose],
    /// The timing.
    pub pace: &'a Pace,
    /// By joint, its maximum velocity \[rad/s or the chain's unit per second\]; may be shorter than the list of joints.
    pub speeds: &'a [Option<f64>],
    /// The joint values before the first pose. The step from there to the first pose counts like any other, and may be a jump.
    pub start: Option<&'a [f64]>,
}

impl<'a> PathRequest<'a> {
    /// A path through poses, from any joint values.
    pub fn new(poses: &'a [Pose], pace: &'a Pace) -> Self {
        PathRequest { poses, pace, speeds: &[], start: None }
    }

    /// Sets the maximum velocities.
    #[must_use]
    pub fn speeds(mut self, speeds: &'a [Option<f64>]) -> Self {
        self.speeds = speeds;
        self
    }

    /// Sets the joint values before the first pose.
    #[must_use]
    pub fn start(mut self, q: &'a [f64]) -> Self {
        self.start = Some(q);
        self
    }
}
