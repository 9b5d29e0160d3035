//! What walk is wanted. Main types: [`Request`], [`Gait`].

use super::footprint::Route;
use super::one_step::OneStep;
use super::reference::Style;
use super::schedule::{Action, Durations};

/// How the centre of mass is moved.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Gait {
    /// The seed's sine, NAO (6.8.1): over one foot the centre of mass rests.
    #[default]
    Seed,
    /// Preview control of the zero moment point (Kajita and others 2003): the centre of mass never rests.
    Preview,
    /// One step goal, RH0 3.3 and 3.5: orient, lean, lift, land, balance.
    OneStep(OneStep),
}

impl Gait {
    /// Whether it is a one-step-goal gait.
    pub fn is_one_step(&self) -> bool {
        matches!(self, Gait::OneStep(_))
    }

    /// The phases of a walk of `steps` steps.
    pub fn actions(&self, steps: usize) -> Vec<Action> {
        if let Gait::OneStep(one_step) = self {
            return one_step.actions(steps);
        }
        let walk = (0..steps).flat_map(|step| [Action::Shift(step), Action::Swing(step)]);
        [Action::Rest].into_iter().chain(walk).chain([Action::Shift(steps), Action::Rest]).collect()
    }
}

/// What walk is wanted.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    /// The way.
    pub route: Route,
    /// How the centre of mass is moved.
    pub gait: Gait,
    /// The figures of the gait.
    pub style: Style,
    /// How long the phases are to last.
    pub durations: Durations,
    /// The least distance of the zero moment point from the border of the support polygon \[m\].
    pub margin: f64,
    /// The greatest share of its own speed that a joint may have.
    pub speed_share: f64,
    /// The time between two samples \[s\].
    pub tick: f64,
    /// No phase lasts longer than this many times its duration.
    pub slowest: f64,
}
