//! A walk from request to checked joint angles; what would fall is slowed down or refused. Main type: [`Walk`].

use nalgebra::Point2;

use super::balance::{Balance, realised};
use super::biped::Biped;
use super::check::{Demand, Found, faults, feet_meet};
use super::legs::Legs;
use super::motion::Motion;
use super::preview;
use super::reference::{Reference, seed_centre, soles};
use super::refusal;
use super::request::{Gait, Request};
use super::schedule::{Action, Schedule};
use crate::{Error, ErrorKind, Result, Watch};
use groebot_robot::spatial::angle;

/// The time between two samples of NAO's walks \[s\]: 100 Hz.
pub const TICK: f64 = 0.01;
/// The factor by which a phase is slowed down at a time.
const SLOWER: f64 = 1.15;
/// No phase lasts longer than this many times what was asked for, unless another figure is given.
pub(super) const SLOWEST: f64 = 12.0;
/// The most samples of a walk.
const MOST_SAMPLES: usize = groebot_algebra::limits::WALK_SAMPLES;

/// A checked walk.
#[derive(Clone, Debug, PartialEq)]
pub struct Walk {
    /// What was wanted.
    pub request: Request,
    /// The phases as they are walked.
    pub schedule: Schedule,
    /// What was asked of feet and centre of mass, one a sample.
    pub references: Vec<Reference>,
    /// Postures and centres of mass, one a sample.
    pub motion: Motion,
    /// Zero moment point and margins, one a sample.
    pub balances: Vec<Balance>,
}

impl Walk {
    /// The time of a sample \[s\].
    pub fn time(&self, sample: usize) -> f64 {
        // Rounding to nanoseconds keeps decimals such as 0.07 and 0.108 as they are written.
        (sample as f64 * self.schedule.tick * 1e9).round() / 1e9
    }
}

/// Plans the walk that `request` asks for. A phase in which the zero moment point would leave its margin, or a joint would turn too fast, is
/// slowed down; what no slower walk would heal is refused.
///
/// # Errors
/// [`ErrorKind::BadValue`] with the first time and the reason: a foot out of reach, a joint beyond its limits, feet that meet, a centre of
/// mass too near to the border, a margin that no slower phase keeps, a figure of the gait that is not finite or not positive;
/// [`ErrorKind::Cancelled`] and [`ErrorKind::Budget`].
pub fn plan(biped: &Biped, legs: &Legs, request: &Request, watch: &Watch) -> Result<Walk> {
    plan_actions(biped, legs, request, &request.gait.actions(request.route.steps.len()), watch)
}

/// The same with phases of one's own: `actions` in turn, which are about steps of the route.
///
/// # Errors
/// As [`plan`].
pub fn plan_actions(biped: &Biped, legs: &Legs, request: &Request, actions: &[Action], watch: &Watch) -> Result<Walk> {
    refusal::check(request)?;
    let mut slowed = vec![1.0; actions.len()];
    loop {
        let schedule = Schedule::new(request.route.clone(), actions, &request.durations, &slowed, request.tick);
        if schedule.samples() > MOST_SAMPLES {
            let text = format!(
                "the walk would last {:.0} s, which are {} samples, one each {:e} s, and {MOST_SAMPLES} are the most; walk fewer steps (--steps, --goal), \
                 faster (--period), or with a longer --tick",
                schedule.samples() as f64 * request.tick,
                schedule.samples(),
                request.tick
            );
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let mut references = references(biped, request, &schedule);
        if let Some(found) = feet_meet(biped, &schedule, &references) {
            return Err(refusal::of(biped, &schedule, request, &found));
        }
        let (motion, balances) = match request.gait {
            Gait::Seed | Gait::OneStep(_) => realised(biped, legs, &references, None, request.tick, watch)?,
            Gait::Preview => preview::moved(biped, legs, request, &schedule, &mut references, watch)?,
        };
        let demand = Demand {
            margin: request.margin,
            statically: request.gait == Gait::Seed,
            keeps_way: request.gait.is_one_step(),
            speed_share: request.speed_share,
        };
        let found = faults(biped, &references, &motion, &balances, &demand, request.tick);
        if found.is_empty() {
            return Ok(Walk { request: request.clone(), schedule, references, motion, balances });
        }
        slow_down(biped, &schedule, request, &found, &mut slowed)?;
    }
}

/// What is asked of feet and torso at each sample, for preview control with the seed's law for the centre of mass.
fn references(biped: &Biped, request: &Request, schedule: &Schedule) -> Vec<Reference> {
    let ankle_height = biped.feet[0].ankle_height;
    let style = &request.style;
    let stands = schedule.route.stands();
    let reference = |(phase, share): (usize, f64)| {
        let action = schedule.phases[phase].action;
        let feet = Schedule::feet(&stands, action, phase == 0);
        if let Gait::OneStep(one_step) = &request.gait {
            return one_step.reference(style, schedule, phase, &feet, share, ankle_height);
        }
        let (world_from_soles, standing) = soles(style, schedule, action, &feet, share);
        let centre: Point2<f64> = seed_centre(style, schedule, action, &feet, share);
        let [left, right] = world_from_soles.each_ref().map(|sole| sole.rotation.euler_angles().2);
        let heading = left + angle::difference(right, left) / 2.0;
        let torso_height = style.torso_height;
        Reference { phase, world_from_soles, stands: standing, centre, torso_height, heading }
    };
    schedule.instants().map(reference).collect()
}

/// Slows down the phases in which something is wrong.
///
/// # Errors
/// The reason when no slower walk helps.
fn slow_down(biped: &Biped, schedule: &Schedule, request: &Request, found: &[Found], slowed: &mut [f64]) -> Result<()> {
    if let Some(hard) = found.iter().find(|found| !refusal::is_healed_by_time(&found.fault)) {
        return Err(refusal::of(biped, schedule, request, hard));
    }
    let mut slow = vec![request.gait == Gait::Preview; slowed.len()];
    for found in found {
        slow[found.phase] = true;
        // A sample's acceleration also comes from the phase beside it.
        let start: usize = 1 + schedule.phases[..found.phase].iter().map(|phase| phase.samples).sum::<usize>();
        if found.sample <= start + 1 && found.phase > 0 {
            slow[found.phase - 1] = true;
        }
        if found.sample + 1 >= start + schedule.phases[found.phase].samples && found.phase + 1 < slow.len() {
            slow[found.phase + 1] = true;
        }
    }
    for (factor, slow) in slowed.iter_mut().zip(slow) {
        *factor *= if slow { SLOWER } else { 1.0 };
        if *factor > request.slowest {
            return Err(refusal::of(biped, schedule, request, &found[0]));
        }
    }
    Ok(())
}
