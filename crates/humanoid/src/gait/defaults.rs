//! The default parameters of a robot's gait. Main type: [`GaitDefaults`].

use std::borrow::Cow;
use std::fmt;

use super::biped::Biped;
use super::footprint::Route;
use super::legs::Legs;
use super::one_step::OneStep;
use super::plan::{Planner, SLOWEST, Walk, plan};
use super::reference::Style;
use super::request::{Gait, Request};
use super::schedule::Durations;
use crate::{Error, ErrorKind, Result, Watch};

/// The default parameters of a gait. Metres, seconds, radians.
#[derive(Clone, Debug, PartialEq)]
pub struct GaitDefaults {
    /// The law of motion of the centre of mass.
    pub gait: Gait,
    /// The distance from the supporting foot forward to the landing foot: `x_d` of NAO 6.8, `L_p` of RH0 3.5.
    pub length: f64,
    /// The height to which a foot is lifted: `z_d` of NAO 6.8, `H_p` of RH0 3.5.
    pub lift: f64,
    /// Half of the lateral distance between the feet; `None` is the half width of the hips.
    pub half_width: Option<f64>,
    /// The lateral displacement of the centre of mass.
    pub amplitude: f64,
    /// The distance of the centre of mass forward of the ankles.
    pub ahead: f64,
    /// Heights of the hip axes above the floor; the first feasible one is taken.
    pub hip_heights: Cow<'static, [f64]>,
    /// The height of the hip axes before the trunk is lowered and after it has risen, for one step goal.
    pub upright_hip: f64,
    /// The duration of a step.
    pub period: f64,
    /// The fraction of a step in double support.
    pub double_support: f64,
    /// The duration of the rest before the first and after the last step.
    pub rest: f64,
    /// The least distance of the zero moment point from the border of the support polygon.
    pub margin: f64,
    /// The greatest joint rate, as a fraction of the joint's limit.
    pub speed_share: f64,
    /// The greatest turn per step: `G_CM` of RH0 3.5.
    pub most_turn: f64,
    /// The time between two samples.
    pub tick: f64,
}

/// Changes of a gait that make a walk steadier.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Steadier {
    /// The factor on the duration of a step.
    pub slower: f64,
    /// The fraction by which the centre of mass moves nearer to the middle of the supporting foot, and the swinging
    /// foot is more level.
    pub nearer: f64,
    /// The factor on the lateral distance between the feet.
    pub wider: f64,
    /// The factor on the heights of the hip axes above the floor.
    pub lower: f64,
}

/// The changes that `--repair` tries in order.
pub const REPAIRS: [Steadier; 4] = [
    Steadier { slower: 1.25, nearer: 0.6, wider: 1.0, lower: 1.0 },
    Steadier { slower: 1.5, nearer: 0.6, wider: 1.1, lower: 0.98 },
    Steadier { slower: 1.75, nearer: 1.0, wider: 1.1, lower: 0.96 },
    Steadier { slower: 2.0, nearer: 1.0, wider: 1.2, lower: 0.94 },
];

impl fmt::Display for Steadier {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "steps that last {} times as long", self.slower)?;
        write!(f, ", the centre of mass {:.0} % nearer to the middle of the supporting foot", 1e2 * self.nearer)?;
        if self.wider > 1.0 {
            write!(f, ", feet {} times as far apart", self.wider)?;
        }
        if self.lower < 1.0 {
            write!(f, ", hips at {} of their height", self.lower)?;
        }
        Ok(())
    }
}

/// Factors that shorten turns and steps, tried in order when a walk is infeasible as requested.
const EASED: [f64; 5] = [1.0, 0.7, 0.5, 0.35, 0.25];

/// Plans the walk at `hip_height` \[m\], or at the first feasible one of `heights`. `request` makes the request for a
/// height and a factor on turns. The factor is 1 at first, and is reduced when no height is feasible.
///
/// # Errors
/// As [`plan`]; that of the first height when none is feasible.
pub fn plan_at<'w>(
    (biped, legs): (&Biped, &Legs),
    hip_height: Option<f64>,
    heights: &[f64],
    request: impl Fn(f64, f64) -> Result<Request>,
    watch: impl Into<Option<&'w Watch>>,
) -> Result<Walk> {
    let watch = Watch::or_none(watch);
    let heights = hip_height.map_or(heights.to_vec(), |height| vec![height]);
    let planner = Planner { biped, legs, watch };
    let mut first = None;
    for ease in EASED {
        for height in &heights {
            let request = request(*height, ease)?;
            let actions = request.gait.actions(request.route.steps.len());
            let slowed = planner.slowed(&request, &actions);
            match slowed.and_then(|slowed| planner.walk(&request, &actions, slowed)) {
                Err(error) if error.kind() == ErrorKind::BadValue => first = first.or(Some(request)),
                walk => return walk,
            }
        }
    }
    let first = first.ok_or_else(|| Error::new(ErrorKind::BadValue, "give the height of the hip"))?;
    plan(biped, legs, &first, watch)
}

impl GaitDefaults {
    /// Half of the lateral distance between the feet \[m\].
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

    /// Same as `self`, but with turns multiplied by `ease`, and steps by a factor between it and 1.
    #[must_use]
    pub fn eased(self, ease: f64) -> Self {
        GaitDefaults { most_turn: self.most_turn * ease, length: self.length * (1.0 + ease) / 2.0, ..self }
    }

    /// Same as `self`, but with these changes. The centre of mass keeps its distance from the supporting foot, or
    /// comes nearer to it.
    #[must_use]
    pub fn steadier(&self, biped: &Biped, by: &Steadier) -> Self {
        let half_width = self.half_width(biped);
        let from_foot = (half_width - self.amplitude) * (1.0 - by.nearer);
        let gait = match self.gait {
            Gait::OneStep(own) => Gait::OneStep(OneStep { pitch: own.pitch * (1.0 - by.nearer), ..own }),
            gait => gait,
        };
        GaitDefaults {
            gait,
            period: self.period * by.slower,
            half_width: Some(half_width * by.wider),
            amplitude: half_width * by.wider - from_foot,
            hip_heights: self.hip_heights.iter().map(|height| height * by.lower).collect(),
            ..self.clone()
        }
    }

    /// Adds a lowering before the first step and a rise after the last one, for one step goal.
    #[must_use]
    pub fn from_upright(mut self, biped: &Biped) -> Self {
        if let Gait::OneStep(one_step) = &mut self.gait {
            one_step.upright = Some(self.upright_hip + biped.hip_to_torso());
        }
        self
    }

    /// The durations of the phases. A step of a one-step-goal walk has two phases in double support, one on each side
    /// of the swing; a step of the other gaits has one.
    pub(crate) fn durations(&self) -> Durations {
        let (double, phases) = (self.period * self.double_support, if self.gait.is_one_step() { 2.0 } else { 1.0 });
        Durations { rest: self.rest, shift: double / phases, swing: self.period - double, lower: None }
    }
}
