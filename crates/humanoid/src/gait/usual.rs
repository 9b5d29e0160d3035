//! The figures that a robot's gait has unless others are given. Main type: [`Usual`].

use std::borrow::Cow;

use super::biped::Biped;
use super::footprint::Route;
use super::legs::Legs;
use super::plan::{SLOWEST, Walk, plan};
use super::reference::Style;
use super::request::{Gait, Request};
use super::schedule::Durations;
use crate::{ErrorKind, Result, Watch};

/// The usual figures of a gait. Metres, seconds, radians.
#[derive(Clone, Debug, PartialEq)]
pub struct Usual {
    /// How the centre of mass is moved.
    pub gait: Gait,
    /// How far ahead of the standing foot the other one lands: `x_d` of NAO 6.8, `L_p` of RH0 3.5.
    pub length: f64,
    /// How high a foot is lifted: `z_d` of NAO 6.8, `H_p` of RH0 3.5.
    pub lift: f64,
    /// Half of the way from foot to foot, sideways; `None` is as wide as the hips are.
    pub half_width: Option<f64>,
    /// How far to the side the centre of mass goes.
    pub amplitude: f64,
    /// How far ahead of the ankles the centre of mass is held.
    pub ahead: f64,
    /// Heights of the axes of the hip over the floor; the first at which the walk can be walked is taken.
    pub hip_heights: Cow<'static, [f64]>,
    /// The height of the axes of the hip before the trunk is lowered and when it has risen, for one step goal.
    pub upright_hip: f64,
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

/// How far turns and steps are shortened in turn, where a walk is refused as it was asked for.
const EASED: [f64; 5] = [1.0, 0.7, 0.5, 0.35, 0.25];

/// The walk at `hip_height` \[m\], or at the first of `heights` at which it can be walked; `request` makes the request for a height, with
/// turns that are shortened to a share where no height helps: 1 at first.
///
/// # Errors
/// As [`plan`]; that of the first height when it can be walked at none.
pub fn plan_at(
    (biped, legs): (&Biped, &Legs),
    hip_height: Option<f64>,
    heights: &[f64],
    request: impl Fn(f64, f64) -> Result<Request>,
    watch: &Watch,
) -> Result<Walk> {
    let heights = hip_height.map_or(heights.to_vec(), |height| vec![height]);
    let is_refused = |walk: &Result<Walk>| walk.as_ref().is_err_and(|error| error.kind() == ErrorKind::BadValue);
    let mut first = None;
    for ease in EASED {
        for height in &heights {
            let walk = plan(biped, legs, &request(*height, ease)?, watch);
            if !is_refused(&walk) {
                return walk;
            }
            first = first.or(Some(walk));
        }
    }
    first.unwrap_or_else(|| Err(crate::Error::new(ErrorKind::BadValue, "give the height of the hip")))
}

impl Usual {
    /// Half of the way from foot to foot, sideways \[m\].
    pub fn half_width(&self, biped: &Biped) -> f64 {
        self.half_width.unwrap_or(biped.half_width())
    }

    /// The request to walk `route` with the hips at `hip_height` \[m\].
    pub fn request(&self, biped: &Biped, route: Route, hip_height: f64) -> Request {
        let style = Style {
            lift: self.lift,
            amplitude: self.amplitude,
            half_width: self.half_width(biped),
            ahead: self.ahead,
            torso_height: hip_height + biped.hip_to_torso(),
        };
        Request {
            route,
            gait: self.gait,
            style,
            durations: self.durations(),
            margin: self.margin,
            speed_share: self.speed_share,
            tick: self.tick,
            slowest: SLOWEST,
        }
    }

    /// The same figures with turns shortened to the share `ease`, and steps to a share between it and 1.
    #[must_use]
    pub fn eased(self, ease: f64) -> Self {
        Usual { most_turn: self.most_turn * ease, length: self.length * (1.0 + ease) / 2.0, ..self }
    }

    /// The figures with a lowering before the first step and a rise behind the last one, for one step goal.
    #[must_use]
    pub fn from_upright(mut self, biped: &Biped) -> Self {
        if let Gait::OneStep(one_step) = &mut self.gait {
            one_step.upright = Some(self.upright_hip + biped.hip_to_torso());
        }
        self
    }

    /// How long the phases last. A step of one-step-goal walks has two phases on both feet, one on each side of the swing; a step of the
    /// others has one.
    pub fn durations(&self) -> Durations {
        let (double, phases) = (self.period * self.double_support, if self.gait.is_one_step() { 2.0 } else { 1.0 });
        Durations { rest: self.rest, shift: double / phases, swing: self.period - double, lower: None }
    }
}
