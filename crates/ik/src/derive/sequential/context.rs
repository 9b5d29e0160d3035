//! What the block of a step is made from ([`Context`]).

use super::ProvedStep;
use super::layout::Layout;
use super::samples::Samples;
use super::slack::Slack;
use crate::derive::closure::Mechanism;

/// A step and what is known when it runs.
pub(super) struct Context<'a> {
    pub mechanism: &'a Mechanism,
    pub known: &'a [usize],
    pub step: &'a ProvedStep,
    /// The joint that is told as free where the step's is.
    pub free: usize,
    pub reach: f64,
    pub slack: Slack,
    pub samples: Samples,
    /// The unknowns that tell whether joints are free.
    pub spreads: &'a [usize],
    /// The mechanism that all relations but the first belong to, where it is another, and where its target stands.
    pub partner: Option<(&'a Mechanism, &'a Layout)>,
}
