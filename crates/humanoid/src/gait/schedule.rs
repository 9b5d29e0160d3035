//! The phases of a walk in time: rest, shift of the weight, swing of a foot, shift, ... Main type: [`Schedule`].

use super::footprint::{Footprint, Route, Side};

/// The greatest number of samples of a phase.
const MOST_SAMPLES: usize = groebot_algebra::limits::PHASE_SAMPLES;

/// The kind of a phase.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Action {
    /// The robot rests in double support.
    Rest,
    /// In double support, the weight shifts to the supporting foot of the step with this number; after the last step it
    /// shifts to the middle.
    Shift(usize),
    /// The swing foot of the step with this number moves; single support.
    Swing(usize),
    /// In double support, the weight shifts from the supporting foot of the step with this number to the middle: phase
    /// 5 of RH0 3.3.
    Balance(usize),
    /// Before the first step the trunk descends until the legs can reach.
    Lower,
    /// After the last step the trunk rises again.
    Rise,
}

impl Action {
    /// The number of its step; `None` for a phase of no step.
    pub(super) fn step(self) -> Option<usize> {
        match self {
            Action::Rest | Action::Lower | Action::Rise => None,
            Action::Shift(step) | Action::Swing(step) | Action::Balance(step) => Some(step),
        }
    }

    /// Same as `self`, but with another number of its step.
    pub(super) fn with_step(self, number: impl Fn(usize) -> usize) -> Self {
        match self {
            Action::Rest | Action::Lower | Action::Rise => self,
            Action::Shift(step) => Action::Shift(number(step)),
            Action::Swing(step) => Action::Swing(number(step)),
            Action::Balance(step) => Action::Balance(number(step)),
        }
    }
}

/// A phase of a walk.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Phase {
    /// Its kind.
    pub action: Action,
    /// Its duration in samples.
    pub samples: usize,
    /// The factor between its duration and the requested one.
    pub slowed: f64,
}

/// All phases of a walk in order, with the footprints in each.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Schedule {
    /// The footsteps.
    pub route: Route,
    /// The phases.
    pub phases: Vec<Phase>,
    /// The time between two samples \[s\].
    pub tick: f64,
}

/// The durations of the phases \[s\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Durations {
    /// Each rest, before the first and after the last step.
    pub rest: f64,
    /// Each shift of the weight.
    pub shift: f64,
    /// Each swing.
    pub swing: f64,
    /// Lowering, and rising; without a value, two shifts and a swing.
    pub lower: Option<f64>,
}

impl Schedule {
    /// The phases of `route` for `actions` in order; `slowed[i]` is the factor on the duration of phase `i`.
    pub fn new(route: Route, actions: &[Action], durations: &Durations, slowed: &[f64], tick: f64) -> Self {
        let phase = |(place, action): (usize, &Action)| {
            let slowed = slowed.get(place).copied().unwrap_or(1.0);
            let seconds = match action {
                Action::Rest => durations.rest,
                Action::Shift(_) | Action::Balance(_) => durations.shift,
                Action::Swing(_) => durations.swing,
                Action::Lower | Action::Rise => durations.lower.unwrap_or(2.0 * durations.shift + durations.swing),
            };
            Phase {
                action: *action,
                samples: ((seconds * slowed / tick).round() as usize).clamp(1, MOST_SAMPLES),
                slowed,
            }
        };
        Schedule { phases: actions.iter().enumerate().map(phase).collect(), route, tick }
    }

    /// The number of samples, the first and the last instant included.
    pub fn samples(&self) -> usize {
        1 + self.phases.iter().map(|phase| phase.samples).sum::<usize>()
    }

    /// The first sample of each phase. The first instant, which belongs to the first phase, is not counted.
    pub(super) fn starts(&self) -> impl Iterator<Item = usize> + '_ {
        self.phases.iter().scan(1, |next, phase| {
            let start = *next;
            *next += phase.samples;
            Some(start)
        })
    }

    /// Each sample's phase and the completed fraction of the phase, in (0, 1]. The first instant belongs to the first
    /// phase.
    pub(crate) fn instants(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        let within = |(place, phase): (usize, &Phase)| {
            let count = phase.samples;
            (1..=count).map(move |done| (place, done as f64 / count as f64))
        };
        [(0, 0.0)].into_iter().chain(self.phases.iter().enumerate().flat_map(within))
    }

    /// The footprints at the start of `action`.
    pub fn feet(stands: &[[Footprint; 2]], action: Action, is_first: bool) -> [Footprint; 2] {
        match action {
            Action::Rest if is_first => stands[0],
            Action::Lower => stands[0],
            Action::Rest | Action::Rise => stands[stands.len() - 1],
            Action::Balance(step) => stands[step + 1],
            Action::Shift(step) | Action::Swing(step) => stands[step],
        }
    }

    /// The supporting foot of the step; `None` after the last step.
    pub(crate) fn stance(&self, step: usize) -> Option<Side> {
        self.route.steps.get(step).map(|step| step.side.other())
    }
}
