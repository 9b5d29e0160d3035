//! The phases of a walk in time: rest, shift of the weight, swing of a foot, shift, ... Main type: [`Schedule`].

use super::footprint::{Footprint, Route, Side};

/// The most samples of a phase.
const MOST_SAMPLES: usize = groebot_algebra::limits::PHASE_SAMPLES;

/// What happens in a phase.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// The robot stands still on both feet.
    Rest,
    /// On both feet, the weight goes over to the foot that the step with this number leaves standing; behind the last step it goes to
    /// the middle.
    Shift(usize),
    /// The foot of the step with this number swings.
    Swing(usize),
    /// On both feet, the weight goes from the foot that stood in the step with this number to the middle: phase 5 of RH0 3.3.
    Balance(usize),
    /// Before the first step the trunk goes down until the legs can reach.
    Lower,
    /// Behind the last step the trunk goes up again.
    Rise,
}

/// A phase of a walk.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phase {
    /// What happens.
    pub action: Action,
    /// The number of samples that it lasts.
    pub samples: usize,
    /// How many times as long it lasts as was asked for.
    pub slowed: f64,
}

/// All phases of a walk in turn, with the feet in each.
#[derive(Clone, Debug, PartialEq)]
pub struct Schedule {
    /// The way.
    pub route: Route,
    /// The phases.
    pub phases: Vec<Phase>,
    /// The time between two samples \[s\].
    pub tick: f64,
}

/// How long the phases last \[s\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Durations {
    /// Each rest, before the first and behind the last step.
    pub rest: f64,
    /// Each shift of the weight.
    pub shift: f64,
    /// Each swing.
    pub swing: f64,
    /// Lowering, and rising; without it as long as two shifts and a swing.
    pub lower: Option<f64>,
}

impl Schedule {
    /// The phases of `route`, `actions` in turn; `slowed[i]` is the factor by which phase `i` lasts longer.
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

    /// Each sample's phase and the share of the phase that is over, in (0, 1]; the first instant belongs to the first phase.
    pub fn instants(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        let within = |(place, phase): (usize, &Phase)| {
            let count = phase.samples;
            (1..=count).map(move |done| (place, done as f64 / count as f64))
        };
        [(0, 0.0)].into_iter().chain(self.phases.iter().enumerate().flat_map(within))
    }

    /// Where the feet stand when `action` begins.
    pub fn feet(stands: &[[Footprint; 2]], action: Action, is_first: bool) -> [Footprint; 2] {
        match action {
            Action::Rest if is_first => stands[0],
            Action::Lower => stands[0],
            Action::Rest | Action::Rise => stands[stands.len() - 1],
            Action::Balance(step) => stands[step + 1],
            Action::Shift(step) | Action::Swing(step) => stands[step],
        }
    }

    /// The foot that stands while the step swings; `None` behind the last step.
    pub fn stance(&self, step: usize) -> Option<Side> {
        self.route.steps.get(step).map(|step| step.side.other())
    }
}
