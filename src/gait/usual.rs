//! The figures that a robot's gait has unless others are given. Main type: [`Usual`].

use super::humanoid::Humanoid;
use super::plan::{Gait, Request};
use super::reference::Style;
use super::footprint::Route;
use super::schedule::Durations;

/// The usual figures of a gait. Metres, seconds, radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Usual {
    /// How the centre of mass is moved.
    pub gait: Gait,
    /// How far ahead of the standing foot the other one lands: `x_d` of NAO 6.8, `L_p` of RH0 3.5.
    pub length: f64,
    /// How high a foot is lifted: `z_d` of NAO 6.8, `H_p` of RH0 3.5.
    pub lift: f64,
    /// How far to the side the centre of mass goes.
    pub amplitude: f64,
    /// How far ahead of the ankles the centre of mass is held.
    pub ahead: f64,
    /// Heights of the axes of the hip over the floor; the first at which the walk can be walked is taken.
    pub hip_heights: &'static [f64],
    /// The time of a step.
    pub period: f64,
    /// The share of a step in which both feet stand.
    pub double_support: f64,
    /// How long the robot stands before the first and behind the last step.
    pub rest: f64,
    /// The least distance of the zero moment point from the border of the support polygon.
    pub margin: f64,
    /// The greatest share of its own speed that a joint may have.
    pub speed_share: f64,
    /// How far the robot turns in one step at most: `G_CM` of RH0 3.5.
    pub most_turn: f64,
    /// The time between two samples.
    pub tick: f64,
}

impl Usual {
    /// The request to walk `route` with the hips at `hip_height` \[m\].
    pub fn request(&self, humanoid: &Humanoid, route: Route, hip_height: f64) -> Request {
        let style = Style {
            lift: self.lift,
            amplitude: self.amplitude,
            half_width: humanoid.half_width(),
            ahead: self.ahead,
            torso_height: hip_height + humanoid.hip_to_torso(),
        };
        Request {
            route,
            gait: self.gait,
            style,
            durations: self.durations(),
            margin: self.margin,
            speed_share: self.speed_share,
            tick: self.tick,
        }
    }

    /// How long the phases last. A step of one-step-goal walks has two phases on both feet, one on each side of the swing; a step of the
    /// others has one.
    pub fn durations(&self) -> Durations {
        let (double, phases) = (self.period * self.double_support, if self.gait.is_one_step() { 2.0 } else { 1.0 });
        Durations { rest: self.rest, shift: double / phases, swing: self.period - double }
    }
}
