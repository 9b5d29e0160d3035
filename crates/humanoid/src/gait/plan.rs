//! Planning of a walk, from a request to checked joint angles. Phases that would fall are slowed down; infeasible walks are rejected. Main type: [`Walk`].

use nalgebra::Point2;

use super::balance::{Balance, realised};
use super::biped::Biped;
use super::check::{Demand, faults, feet_meet};
use super::legs::Legs;
use super::motion::{Motion, Samples};
use super::one_step::Instant;
use super::preview;
use super::reference::{Reference, sine_centre, soles};
use super::refusal;
use super::request::{Gait, Request};
use super::schedule::{Action, Schedule};
use super::shortened::Shortened;
use super::slower::slow_down;
use super::trials;
use crate::{Error, ErrorKind, Result, Watch};
use groebot_robot::spatial::angle;

/// The time between two samples of NAO's walks \[s\]: 100 Hz.
pub const TICK: f64 = 0.01;
/// The greatest factor between a phase's duration and the requested one, unless another is given.
pub(super) const SLOWEST: f64 = 12.0;
/// The greatest number of samples of a walk.
const MOST_SAMPLES: usize = groebot_algebra::limits::WALK_SAMPLES;

/// A checked walk.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Walk {
    /// The request.
    pub request: Request,
    /// The phases with their final durations.
    pub schedule: Schedule,
    /// The references of feet and centre of mass, one per sample.
    pub references: Vec<Reference>,
    /// Postures and centres of mass, one per sample.
    pub motion: Motion,
    /// Zero moment point and margins, one per sample.
    pub balances: Vec<Balance>,
}

impl Walk {
    /// The time of a sample \[s\].
    pub fn time(&self, sample: usize) -> f64 {
        // Rounding to nanoseconds keeps decimals such as 0.07 and 0.108.
        (sample as f64 * self.schedule.tick * 1e9).round() / 1e9
    }
}

impl Walk {
    /// The factors on the durations of its phases.
    fn factors(&self) -> Vec<f64> {
        self.schedule.phases.iter().map(|phase| phase.slowed).collect()
    }
}

/// Plans the walk of `request`. A phase in which the zero moment point would leave its margin, or a joint would exceed
/// its rate, is slowed down. Faults that no slower walk removes are errors.
///
/// # Errors
/// [`ErrorKind::BadValue`] with the first time and the reason: a foot out of reach, a joint beyond its limits, feet
/// that collide, a centre of mass too near to the border, a margin that no slower phase keeps, a parameter that is not
/// finite or not positive. [`ErrorKind::Cancelled`] and [`ErrorKind::Budget`].
pub fn plan<'w>(biped: &Biped, legs: &Legs, request: &Request, watch: impl Into<Option<&'w Watch>>) -> Result<Walk> {
    let watch = Watch::or_none(watch);
    plan_actions(biped, legs, request, &request.gait.actions(request.route.steps.len()), watch)
}

/// Same as [`plan`], but with given phases: `actions` in order, which refer to steps of the route.
///
/// # Errors
/// As [`plan`].
pub(crate) fn plan_actions<'w>(
    biped: &Biped,
    legs: &Legs,
    request: &Request,
    actions: &[Action],
    watch: impl Into<Option<&'w Watch>>,
) -> Result<Walk> {
    let watch = Watch::or_none(watch);
    let planner = Planner { biped, legs, watch };
    let slowed = match planner.slowed(request, actions) {
        // The whole walk is solved for its reason with the time and the step.
        Err(error) if error.kind() == ErrorKind::BadValue => vec![1.0; actions.len()],
        slowed => slowed?,
    };
    planner.walk(request, actions, slowed)
}

/// The robot that walks, and the watch of the work.
#[derive(Clone, Copy)]
pub(super) struct Planner<'a> {
    pub biped: &'a Biped,
    pub legs: &'a Legs,
    pub watch: &'a Watch,
}

impl Planner<'_> {
    /// The factors on the durations of the phases, by trials of single steps or of a shortened walk.
    ///
    /// # Errors
    /// As [`plan`], but with the time and the number of the step in its trial.
    pub fn slowed(&self, request: &Request, actions: &[Action]) -> Result<Vec<f64>> {
        if request.gait == Gait::Preview {
            let Some(short) = Shortened::of(request)? else { return Ok(vec![1.0; actions.len()]) };
            let own = request.gait.actions(short.request.route.steps.len());
            let walk = self.walk(&short.request, &own, vec![1.0; own.len()])?;
            return Ok(short.expanded(actions, &walk.factors()));
        }
        trials::slowed(request, actions, |request, actions| {
            let walk = self.walk(request, actions, vec![1.0; actions.len()])?;
            Ok(walk.factors())
        })
    }

    /// The walk whose phases are at least as slow as `slowed`.
    ///
    /// # Errors
    /// As [`plan`].
    pub fn walk(&self, request: &Request, actions: &[Action], mut slowed: Vec<f64>) -> Result<Walk> {
        let Planner { biped, legs, watch } = *self;
        refusal::check(request)?;
        loop {
            let schedule = Schedule::new(request.route.clone(), actions, &request.durations, &slowed, request.tick);
            check_length(&schedule)?;
            let mut references = references(biped, request, &schedule);
            if let Some(found) = feet_meet(biped, &schedule, &references) {
                return Err(refusal::of(biped, &schedule, request, &found));
            }
            let (motion, balances) = match request.gait {
                Gait::Sine | Gait::OneStep(_) => {
                    realised(biped, legs, &Samples::new(&references, request.tick), watch)?
                }
                Gait::Preview => preview::moved(biped, legs, request, &schedule, &mut references, watch)?,
            };
            let demand = Demand {
                margin: request.margin,
                statically: request.gait == Gait::Sine,
                keeps_path: request.gait.is_one_step(),
                speed_share: request.speed_share,
            };
            let found = faults(biped, &Samples::new(&references, request.tick), &motion, &balances, &demand);
            if found.is_empty() {
                return Ok(Walk { request: request.clone(), schedule, references, motion, balances });
            }
            slow_down(biped, (&schedule, request), &balances, &found, &mut slowed)?;
        }
    }
}

/// Refuses a schedule with too many samples.
fn check_length(schedule: &Schedule) -> Result<()> {
    let (samples, tick) = (schedule.samples(), schedule.tick);
    if samples <= MOST_SAMPLES {
        return Ok(());
    }
    let text = format!(
        "the walk would last {:.0} s, which is {samples} samples of {tick:e} s; at most {MOST_SAMPLES} are allowed; walk fewer steps (--steps, --goal), \
         faster (--period), or with a longer --tick",
        samples as f64 * tick,
    );
    Err(Error::new(ErrorKind::BadValue, text))
}

/// The references of feet and torso at each sample. For preview control the centre of mass has the law of the sine at
/// first.
fn references(biped: &Biped, request: &Request, schedule: &Schedule) -> Vec<Reference> {
    let ankle_height = biped.feet[0].ankle_height;
    let style = &request.style;
    let stands = schedule.route.stands();
    let reference = |(phase, share): (usize, f64)| {
        let action = schedule.phases[phase].action;
        let feet = Schedule::feet(&stands, action, phase == 0);
        if let Gait::OneStep(one_step) = &request.gait {
            return one_step.reference(style, schedule, &Instant { phase, feet: &feet, share }, ankle_height);
        }
        let (world_from_soles, supporting) = soles(style, schedule, action, &feet, share);
        let centre: Point2<f64> = sine_centre(style, schedule, action, &feet, share);
        let [left, right] = world_from_soles.each_ref().map(|sole| sole.rotation.euler_angles().2);
        let heading = left + angle::difference(right, left) / 2.0;
        let torso_height = style.torso_height;
        Reference { phase, world_from_soles, stands: supporting, centre, torso_height, heading }
    };
    schedule.instants().map(reference).collect()
}
