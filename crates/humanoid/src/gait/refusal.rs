//! Messages for infeasible walks: the cause, the parameter that would make it feasible with its option of `groebot
//! walk`, then the place and the time.

use nalgebra::Point2;

use super::biped::Biped;
use super::check::{Fault, Found, MOST_TILT};
use super::one_step::{Laws, OneStep};
use super::reference::Style;
use super::request::{Gait, Request};
use super::schedule::{Action, Schedule};
use crate::{Error, ErrorKind};

/// Whether a slower walk may remove a fault.
pub(super) fn is_healed_by_time(fault: &Fault) -> bool {
    matches!(fault, Fault::Dynamic { .. } | Fault::Speed { .. })
}

/// The error for a fault.
pub(super) fn of(biped: &Biped, schedule: &Schedule, request: &Request, found: &Found) -> Error {
    let time = found.sample as f64 * request.tick;
    let text = match &found.fault {
        Fault::Static { margin } => {
            let required = request.margin;
            format!(
                "the centre of mass is {} the border of the support polygon, {:.1} mm inside it are required; {}",
                measured(*margin),
                1e3 * required,
                feasible(biped, request)
            )
        }
        Fault::Dynamic { margin } => format!(
            "the zero moment point is {} the border of the support polygon, {:.1} mm inside it are required, and no slower walk helps; {}",
            measured(*margin),
            1e3 * request.margin,
            feasible(biped, request)
        ),
        Fault::Limit { joint, value } => {
            let range = &biped.joints[*joint];
            format!(
                "joint `{}` would be at {:.2} deg, its limits are {:.2}..{:.2} deg; give less --lift, --length or turn (--max-turn), or another --hip-height",
                range.name,
                value.to_degrees(),
                range.limits.0.to_degrees(),
                range.limits.1.to_degrees()
            )
        }
        Fault::Speed { joint, rate } => {
            let range = &biped.joints[*joint];
            format!(
                "joint `{}` would turn at {:.2} rad/s, its limit is {:.2} rad/s times {}; give a longer --period or less --length",
                range.name, rate, range.speed, request.speed_share
            )
        }
        Fault::Feet { apart } => {
            format!(
                "the feet come within {:.1} mm of each other; turn less in a step (--max-turn, or more --steps) or widen them (--half-width)",
                1e3 * apart
            )
        }
        Fault::Tilt { angle } => format!(
            "a supporting sole would tilt by {:.1} deg, because a leg of five joints does not hold this rotation; at most {:.1} deg are allowed, because only its \
             edge would touch the floor; move the body less to the sides (--amplitude)",
            angle.to_degrees(),
            MOST_TILT.to_degrees()
        ),
    };
    Error::new(ErrorKind::BadValue, format!("{text} (t = {time:.2} s, {})", phase(schedule, found.phase)))
}

fn phase(schedule: &Schedule, place: usize) -> String {
    let steps = schedule.route.steps.len();
    match schedule.phases[place].action {
        Action::Rest if place == 0 => "rest before the first step".into(),
        Action::Rest => "rest after the last step".into(),
        Action::Lower => "lowering of the trunk".into(),
        Action::Rise => "rise of the trunk".into(),
        Action::Balance(step) => format!("balance after step {}", step + 1),
        Action::Shift(step) if step == steps => "shift after the last step".into(),
        Action::Shift(step) => format!("shift before step {}", step + 1),
        Action::Swing(step) => format!("swing of step {} ({} foot)", step + 1, schedule.route.steps[step].side.name()),
    }
}

fn measured(margin: f64) -> String {
    let side = if margin < 0.0 { "outside" } else { "inside" };
    format!("{:.1} mm {side}", 1e3 * margin.abs())
}

/// The parameters that keep the centre of mass above one sole.
fn feasible(biped: &Biped, request: &Request) -> String {
    let corners = &biped.feet[0].corners;
    let range = |coordinate: fn(&Point2<f64>) -> f64| {
        let values = corners.iter().map(coordinate);
        (values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max))
    };
    let ((back, front), (right, left)) = (range(|corner| corner.x), range(|corner| corner.y));
    let (margin, style) = (request.margin, &request.style);
    let most = ((front - back).min(left - right)) / 2.0;
    if margin > most {
        return format!("the sole allows a margin of {most:.4} m at most (--margin)");
    }
    format!(
        "the soles allow an amplitude of {:.4}..{:.4} m (--amplitude) and a centre of mass {:.4}..{:.4} m forward of the ankles (--ahead)",
        style.half_width + right + margin,
        style.half_width + left - margin,
        back + margin,
        front - margin
    )
}

/// Checks the parameters that every walk has.
pub(super) fn check(request: &Request) -> crate::Result<()> {
    let (style, durations) = (&request.style, &request.durations);
    let positive = [
        ("half width", style.half_width),
        ("torso height", style.torso_height),
        ("shift's duration", durations.shift),
        ("swing's duration", durations.swing),
        ("lowering's duration", durations.lower.unwrap_or(1.0)),
        ("speed fraction", request.speed_share),
        ("time between samples", request.tick),
        ("greatest factor of slower phases", request.slowest),
    ];
    let not_negative = [
        ("lift", style.lift),
        ("amplitude", style.amplitude),
        ("rest's duration", durations.rest),
        ("margin", request.margin),
    ];
    let refuse = |name: &str, value: f64, wanted: &str| {
        Err(Error::new(ErrorKind::BadValue, format!("the {name} is {value}; give {wanted}")))
    };
    if let Some((name, value)) = positive.iter().find(|(_, value)| !(value.is_finite() && *value > 0.0)) {
        return refuse(name, *value, "a positive number");
    }
    if let Some((name, value)) = not_negative.iter().find(|(_, value)| !(value.is_finite() && *value >= 0.0)) {
        return refuse(name, *value, "zero or a positive number");
    }
    if !style.ahead.is_finite() {
        return refuse("forward distance of the centre of mass", style.ahead, "a finite number");
    }
    match &request.gait {
        Gait::OneStep(one_step) => check_one_step(one_step, style),
        Gait::Sine | Gait::Preview => Ok(()),
    }
}

/// Checks the parameters of one-step-goal walks.
fn check_one_step(one_step: &OneStep, style: &Style) -> crate::Result<()> {
    let refuse = |name: &str, value: f64, wanted: &str| {
        Err(Error::new(ErrorKind::BadValue, format!("the {name} is {value}; give {wanted}")))
    };
    if !(one_step.dip.is_finite() && one_step.dip >= 0.0) {
        return refuse("dip", one_step.dip, "zero or a positive number");
    }
    if !one_step.pitch.is_finite() {
        return refuse("pitch of the foot", one_step.pitch, "a finite number");
    }
    if let Some(upright) = one_step.upright.filter(|upright| !(upright.is_finite() && *upright > 0.0)) {
        return refuse("upright height", upright, "a positive number");
    }
    match one_step.laws {
        Laws::Rh0 { power } if !(power.is_finite() && power >= 1.0) => refuse("power", power, "a number of at least 1"),
        Laws::Generic if style.amplitude > style.half_width => refuse(
            "amplitude",
            style.amplitude,
            "at most half of the feet's width: the circle of support has the rest as radius",
        ),
        _ => Ok(()),
    }
}
