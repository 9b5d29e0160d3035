//! Slower phases: which phases of a walk are made longer, and by how much. Main function: [`slow_down`].
//!
//! Where the path of the robot does not depend on its speed, a phase that takes `r` times as long has joint rates of `1 / r` and accelerations of `1 / r^2`
//! (dynamic scaling, Hollerbach 1984). So one solved motion shows how much longer a phase has to be.

use nalgebra::Point2;

use super::balance::Balance;
use super::biped::Biped;
use super::check::{Fault, Found};
use super::preview::wanted;
use super::refusal;
use super::request::{Gait, Request};
use super::schedule::Schedule;
use crate::Result;

/// The factor by which a phase is slowed down once.
const SLOWER: f64 = 1.15;
/// The number of bisections for the factor that a phase needs: more precise than [`SLOWER`].
const HALVINGS: usize = 16;

/// Slows down the phases that have faults, and their neighbours where a fault is at a border. Where a phase has to be
/// much slower, the last factor is left to the next trial: the law of dynamic scaling ignores the time between samples.
///
/// # Errors
/// The reason when no slower walk helps.
pub(super) fn slow_down(
    biped: &Biped,
    (schedule, request): (&Schedule, &Request),
    balances: &[Balance],
    found: &[Found],
    slowed: &mut [f64],
) -> Result<()> {
    let refused = |found: &Found| refusal::of(biped, schedule, request, found);
    if let Some(hard) = found.iter().find(|found| !refusal::is_healed_by_time(&found.fault)) {
        return Err(refused(hard));
    }
    let mut times = vec![0; slowed.len()];
    let starts: Vec<usize> = schedule.starts().collect();
    let slow = resting_pressures(schedule, request);
    for fault in found {
        let factor = factor(biped, request, (&balances[fault.sample], slow.get(fault.sample)), fault);
        // By preview control a slower walk has another path, which may keep the margin.
        let count = if factor.is_infinite() && !slow.is_empty() { 1 } else { repetitions(factor) };
        let mut delay = |phase: usize| times[phase] = times[phase].max(count);
        delay(fault.phase);
        // A sample's acceleration also depends on the neighbouring phase.
        let start = starts[fault.phase];
        if fault.sample <= start + 1 && fault.phase > 0 {
            delay(fault.phase - 1);
        }
        if fault.sample + 1 >= start + schedule.phases[fault.phase].samples && fault.phase + 1 < starts.len() {
            delay(fault.phase + 1);
        }
    }
    for (phase, times) in times.into_iter().enumerate() {
        for _ in 0..times {
            slowed[phase] *= SLOWER;
            if slowed[phase] > request.slowest {
                return Err(refused(found.iter().find(|found| found.phase == phase).unwrap_or(&found[0])));
            }
        }
    }
    Ok(())
}

/// The zero moment points of an infinitely slow walk by preview control: their references. Other gaits have those of
/// their balances.
fn resting_pressures(schedule: &Schedule, request: &Request) -> Vec<Point2<f64>> {
    if request.gait == Gait::Preview { wanted(&request.style, schedule) } else { Vec::new() }
}

/// The number of times that a phase is slowed down before the next trial, if it has to be slower by `factor`: one less
/// than that, but at least once.
fn repetitions(factor: f64) -> usize {
    ((factor.ln() / SLOWER.ln()).ceil() as usize).saturating_sub(1).max(1)
}

/// The factor by which a phase has to be longer to remove a fault, by dynamic scaling; infinite where none removes it.
fn factor(biped: &Biped, request: &Request, (balance, slow): (&Balance, Option<&Point2<f64>>), found: &Found) -> f64 {
    match found.fault {
        Fault::Speed { joint, rate } => rate.abs() / (biped.joints[joint].speed * request.speed_share),
        Fault::Dynamic { .. } => {
            // In an infinitely slow walk the zero moment point is the projection of the centre of mass, or its reference.
            let slow = slow.unwrap_or(&balance.pressure);
            let keeps = |share: f64| {
                let zmp = slow + (balance.zmp - slow) * share;
                balance.support.signed_distance(&zmp) >= request.margin
            };
            let (mut low, mut high) = (0.0, 1.0);
            for _ in 0..HALVINGS {
                let middle = (low + high) / 2.0;
                if keeps(middle) { low = middle } else { high = middle }
            }
            1.0 / low.sqrt()
        }
        Fault::Static { .. } | Fault::Limit { .. } | Fault::Feet { .. } | Fault::Tilt { .. } => f64::INFINITY,
    }
}
