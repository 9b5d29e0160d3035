//! The input for compiling the block of a step ([`Context`]).

use super::ProvedStep;
use super::layout::Layout;
use super::samples::Samples;
use super::slack::Slack;
use crate::derive::closure::Mechanism;

/// A step and the data that are known when it runs.
pub(super) struct Context<'a> {
    pub mechanism: &'a Mechanism,
    pub known: &'a [usize],
    pub step: &'a ProvedStep,
    /// The joint that is reported as free where the step's joint is free.
    pub free: usize,
    pub reach: f64,
    pub slack: Slack,
    pub samples: Samples,
    /// The unknowns that record whether joints are free.
    pub spreads: &'a [usize],
    /// The other mechanism of a shared joint and its layout: all relations but the first belong to it.
    pub partner: Option<(&'a Mechanism, &'a Layout)>,
}
