//! The places at which cases put a free joint. Main type: [`Samples`].

use super::ProvedStep;
use super::slack::Slack;
use crate::solver::JointValue;

/// A free angle is put at places round the circle, none of them one that a solution is likely to have by itself.
const FIRST: f64 = 0.4;
/// A free length is put at places on both sides of this share of the reach.
const MIDDLE: f64 = 0.1;

/// A slide that goes beyond this multiple of the reach needs places of its own: an arm on a rail reaches targets from a part of it only.
const FAR: f64 = 1.2;
/// So many places there are within a reach then, and so many altogether at most.
const CLOSE: f64 = 3.0;
const MOST: f64 = 64.0;

/// How many places there are for an angle, and for a length.
#[derive(Clone, Copy)]
pub(super) struct Samples {
    angles: i32,
    lengths: i32,
}

/// One from which a member of the self-motion is reached is enough.
const FEW: Samples = Samples { angles: 8, lengths: 5 };
/// Where roots of polynomials of higher degree than two are known to fewer digits, so that nearer places are needed: next to a double root a
/// self-motion may go round a small part of the circle.
const MORE: Samples = Samples { angles: 16, lengths: 16 };
/// Where the formulas are those of an ideal chain: the chain that is meant has a few answers there instead of a self-motion, and each is looked for
/// from the places next to it.
const MANY: Samples = Samples { angles: 16, lengths: 5 };

impl Samples {
    /// Those of a program of these steps, whose formulas are off by `slack`.
    pub fn of(steps: &[ProvedStep], slack: Slack) -> Self {
        match slack {
            Slack::NONE if steps.iter().all(|step| step.shape.form.degree() <= 2) => FEW,
            Slack::NONE => MORE,
            _ => MANY,
        }
    }

    /// The places of a joint \[rad, or the unit of `reach`\]; where a slide's `travel` is longer than what the arm reaches, along that.
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
