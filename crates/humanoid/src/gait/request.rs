//! The request for a walk. Main types: [`Request`], [`Gait`].

use super::footprint::Route;
use super::one_step::OneStep;
use super::reference::Style;
use super::schedule::{Action, Durations};

/// The law of motion of the centre of mass.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Gait {
    /// The sine of NAO (6.8.1): in single support the centre of mass rests.
    #[default]
    Sine,
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

    /// The phases of a walk of `steps` steps; without steps the robot stands.
    pub(crate) fn actions(&self, steps: usize) -> Vec<Action> {
        if let Gait::OneStep(one_step) = self {
            let actions = one_step.actions(steps);
            return if actions.is_empty() { vec![Action::Rest] } else { actions };
        }
        if steps == 0 {
            return vec![Action::Rest];
        }
        let walk = (0..steps).flat_map(|step| [Action::Shift(step), Action::Swing(step)]);
        [Action::Rest].into_iter().chain(walk).chain([Action::Shift(steps), Action::Rest]).collect()
    }
}

/// The request for a walk.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    /// The footsteps.
    pub route: Route,
    /// The law of motion of the centre of mass.
    pub gait: Gait,
    /// The parameters of the gait.
    pub style: Style,
    /// The durations of the phases.
    pub durations: Durations,
    /// The least distance of the zero moment point from the border of the support polygon \[m\].
    pub margin: f64,
    /// The greatest joint rate, as a fraction of the joint's limit.
    pub speed_share: f64,
    /// The time between two samples \[s\].
    pub tick: f64,
    /// The greatest factor between a phase's duration and the requested one.
    pub slowest: f64,
}
