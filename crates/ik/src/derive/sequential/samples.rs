//! The sampled values of a free joint. Main type: [`Samples`].

use super::ProvedStep;
use super::slack::Slack;
use crate::solver::JointValue;

/// The offset of the samples of a free angle. With it, no sample is a value that a solution is likely to have.
const FIRST: f64 = 0.4;
/// The centre of the samples of a free length, as a fraction of the reach.
const MIDDLE: f64 = 0.1;

/// A prismatic joint whose limits exceed this multiple of the reach is sampled along its travel. An arm on a rail reaches a target from only a part of the
/// rail.
const FAR: f64 = 1.2;
/// The number of samples per reach along such a travel, and the maximum number of samples.
const CLOSE: f64 = 3.0;
const MOST: f64 = 64.0;

/// The number of samples for an angle, and for a length.
#[derive(Clone, Copy)]
pub(super) struct Samples {
    angles: i32,
    lengths: i32,
}

/// For roots of degree at most two: one sample near enough to a member of the self-motion is sufficient.
const FEW: Samples = Samples { angles: 8, lengths: 5 };
/// For roots of higher degree, which have fewer correct digits and need nearer samples. Next to a double root, a self-motion may cover only a small part of the
/// circle.
const MORE: Samples = Samples { angles: 16, lengths: 16 };
/// For the formulas of an ideal chain. The described chain has a few solutions there instead of a self-motion, and each is searched from the nearest samples.
const MANY: Samples = Samples { angles: 16, lengths: 5 };

impl Samples {
    /// The numbers of samples for a program of these steps, whose formulas have the error bound `slack`.
    pub fn of(steps: &[ProvedStep], slack: Slack) -> Self {
        match slack {
            Slack::NONE if steps.iter().all(|step| step.shape.form.degree() <= 2) => FEW,
            Slack::NONE => MORE,
            _ => MANY,
        }
    }

    /// The samples of a joint \[rad, or the unit of `reach`\]. A prismatic joint with a long `travel` is sampled along it.
    pub fn places(self, joint: JointValue, reach: f64, travel: Option<(f64, f64)>) -> Vec<f64> {
        if let Some((low, high)) = travel.filter(|(low, high)| low.abs().max(high.abs()) > FAR * reach) {
            let count = (CLOSE * (high - low) / reach).ceil().clamp(f64::from(self.lengths), MOST) as usize;
            return (0..count).map(|k| low + (high - low) * (k as f64 + FIRST) / count as f64).collect();
        }
        let (count, middle, step) = match joint {
            JointValue::Angle { .. } => (self.angles, FIRST, std::f64::consts::TAU / f64::from(self.angles)),
            JointValue::Plain(_) => (self.lengths, MIDDLE * reach, 2.0 * reach / f64::from(self.lengths - 1)),
        };
        (0..count).map(|k| middle + f64::from(k - count / 2) * step).collect()
    }
}
