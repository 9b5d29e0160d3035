//! One step goal (OSG; UPA in the thesis), RH0 3.3 and 3.5: orient, lean, lift, land, balance. Main type: [`OneStep`].
//!
//! A step is a shift of the weight (phases 1 and 2), a swing (3 and 4) and a balance (5). There are two versions of its
//! laws. [`Laws::Rh0`] is that of RH0 3.5, equations (3-46)..(3-53), corrected where the printed ones cannot work
//! (docs/errata.md). [`Laws::Generic`] is that of RH0 3.3, for any biped: the centre of mass stays on a circle on the
//! sole.

use std::f64::consts::PI;

use nalgebra::{Point2, Point3, UnitQuaternion, Vector2, Vector3};

use super::footprint::{Footprint, Side, heading_of};
use super::reference::{Reference, Style, smooth};
use super::schedule::{Action, Phase, Schedule};
use groebot_robot::spatial::intersection::of_line_and_sphere;
use groebot_robot::spatial::{Axis, Pose};

/// The tolerance for a line that is tangent to the circle \[m\].
const TOUCHES: f64 = 1e-12;

/// The laws of motion of the centre of mass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Laws {
    /// RH0 3.5: the lateral motion is a power of time; the motion forward happens while the foot swings.
    Rh0 {
        /// `Po_CM`: the exponent of the lateral motion.
        power: f64,
    },
    /// RH0 3.3: on a circle about the middle of the supporting sole.
    Generic,
}

/// Parameters of one-step-goal walks that other gaits do not have. Metres, radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OneStep {
    /// The laws of the centre of mass.
    pub laws: Laws,
    /// `K_CM`: half of the trunk's descent while the legs are stretched most, at lift-off and landing.
    pub dip: f64,
    /// The greatest pitch of the swing foot, at its highest point, toes down: 20 degrees in RH0 (3-47).
    pub pitch: f64,
    /// The torso's height before it is lowered for the first step and after it has risen at the end. With `None` the
    /// walk starts and ends crouched.
    pub upright: Option<f64>,
}

/// An instant of a schedule.
#[derive(Clone, Copy, Debug)]
pub struct Instant<'a> {
    /// The index of the phase.
    pub phase: usize,
    /// The feet at the beginning of the phase.
    pub feet: &'a [Footprint; 2],
    /// The fraction of the phase that is over.
    pub share: f64,
}

impl OneStep {
    /// The phases of a walk of `steps` steps.
    pub(crate) fn actions(&self, steps: usize) -> Vec<Action> {
        let step = |step| [Action::Shift(step), Action::Swing(step), Action::Balance(step)];
        let walk = (0..steps).flat_map(step);
        if self.upright.is_some() {
            [Action::Lower].into_iter().chain(walk).chain([Action::Rise]).collect()
        } else {
            walk.collect()
        }
    }

    /// The reference at an instant of the schedule. A foot pitches about its ankle, `ankle_height` \[m\] above the sole.
    pub(crate) fn reference(
        &self,
        style: &Style,
        schedule: &Schedule,
        at: &Instant<'_>,
        ankle_height: f64,
    ) -> Reference {
        let Instant { phase: place, feet, share } = *at;
        let phase = &schedule.phases[place];
        let (world_from_soles, stands) = self.soles(style, schedule, phase.action, feet, (share, ankle_height));
        let trunk = self.trunk(style, schedule, phase.action, &world_from_soles, share);
        let torso_height = self.height(style, phase, share);
        Reference { phase: place, world_from_soles, stands, centre: trunk.point(), torso_height, heading: trunk.yaw }
    }

    /// The position of the centre of mass, seen from above, and the heading of the trunk: `Q_rCM`.
    fn trunk(
        &self,
        style: &Style,
        schedule: &Schedule,
        action: Action,
        world_from_soles: &[Pose; 2],
        share: f64,
    ) -> Footprint {
        let rest = |place: usize| {
            let rest = schedule.route.rests[place];
            let at = rest.carry(&Point2::new(style.ahead, 0.0));
            Footprint { x: at.x, y: at.y, ..rest }
        };
        let step = match action {
            Action::Rest | Action::Lower => return rest(0),
            Action::Rise => return rest(schedule.route.rests.len() - 1),
            Action::Shift(step) | Action::Swing(step) | Action::Balance(step) => step,
        };
        let (before, after) = (rest(step), rest(step + 1));
        match self.laws {
            Laws::Rh0 { power } => {
                let (aside, ahead) = match action {
                    Action::Shift(_) => (1.0 - (1.0 - smooth(share)).powf(power), 0.0),
                    Action::Swing(_) => (1.0, smooth(share)),
                    _ => (1.0 - smooth(share).powf(power), 1.0),
                };
                let stance = schedule.route.steps[step].side.other();
                let world_from_stance = &world_from_soles[stance as usize];
                let aside = outwards(stance, world_from_stance) * (style.amplitude * aside);
                let middle = before.towards(&after, ahead);
                Footprint { x: middle.x + aside.x, y: middle.y + aside.y, ..middle }
            }
            Laws::Generic => {
                let over = self.on_circle(style, schedule, step, world_from_soles, &before);
                let (from, to, along, turned) = match action {
                    Action::Shift(_) => (before, over, smooth(share), smooth(share)),
                    Action::Swing(_) => (over, over, 0.0, 1.0),
                    _ => (over, after, smooth(share), 1.0),
                };
                let at = from.towards(&to, along);
                Footprint { yaw: before.towards(&after, turned).yaw, ..at }
            }
        }
    }

    /// The point where the line from the middle of the supporting sole to that of the other one leaves the circle of
    /// support. These are `q_CM2`, `q_CM3` and `q_CM4` of RH0 3.3.2 and all points between them. The radius keeps the
    /// centre of mass at [`Style::amplitude`] when the feet are parallel.
    fn on_circle(
        &self,
        style: &Style,
        schedule: &Schedule,
        step: usize,
        world_from_soles: &[Pose; 2],
        near: &Footprint,
    ) -> Footprint {
        let moving = schedule.route.steps[step].side;
        let middle = |side: Side| {
            let sole = &world_from_soles[side as usize];
            let print = Footprint { x: sole.translation.x, y: sole.translation.y, yaw: heading_of(sole) };
            let at = print.carry(&Point2::new(style.ahead, 0.0));
            Point3::new(at.x, at.y, 0.0)
        };
        let (fixed, other) = (middle(moving.other()), middle(moving));
        let radius = style.half_width - style.amplitude;
        let crossing = Axis::through(&fixed, &other).ok();
        let crossing = crossing.and_then(|line| of_line_and_sphere(&line, &fixed, radius, TOUCHES));
        // The line runs from the supporting sole to the other one: it leaves the circle at its second point.
        let at = crossing.map_or(fixed, |[_, out]| out);
        Footprint { x: at.x, y: at.y, ..*near }
    }

    /// The height of the torso: RH0 (3-46)..(3-52), second component. From the crouch it descends by twice `K_CM` until
    /// lift-off. It is up again when the foot is highest, and down at landing. Lowering and rising are linear from
    /// sample to sample, as in Fig. 5-16.
    fn height(&self, style: &Style, phase: &Phase, share: f64) -> f64 {
        let crouch = style.torso_height;
        let cosine = |angle: f64| crouch - self.dip + self.dip * angle.cos();
        match phase.action {
            Action::Shift(_) => cosine(PI * share),
            Action::Swing(_) => cosine(PI * (2.0 * share - 1.0)),
            Action::Balance(_) => cosine(PI * (share - 1.0)),
            Action::Rest => crouch,
            Action::Lower | Action::Rise => {
                let upright = self.upright.unwrap_or(crouch);
                let done = linear(phase.samples, share);
                let done = if phase.action == Action::Lower { done } else { 1.0 - done };
                upright + (crouch - upright) * done
            }
        }
    }

    /// The poses of the soles and which feet support: `Q_rPM`, RH0 (3-47), (3-49), (3-51), (3-53). The foot's path is a
    /// cosine in space.
    fn soles(
        &self,
        style: &Style,
        schedule: &Schedule,
        action: Action,
        feet: &[Footprint; 2],
        (share, ankle_height): (f64, f64),
    ) -> ([Pose; 2], [bool; 2]) {
        let mut poses = feet.map(|print| print.at_height(0.0));
        let mut stands = [true; 2];
        if let Action::Swing(step) = action {
            let step = schedule.route.steps[step];
            let along = smooth(share);
            let lift = (1.0 + (PI * (2.0 * along - 1.0)).cos()) / 2.0;
            let print = feet[step.side as usize].towards(&step.print, along);
            let ankle = Vector3::z() * ankle_height;
            let pitched = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), self.pitch * lift);
            let about_ankle = Pose::from_parts((ankle - pitched * ankle).into(), pitched);
            poses[step.side as usize] = print.at_height(style.lift * lift) * about_ankle;
            stands[step.side as usize] = share >= 1.0;
        }
        (poses, stands)
    }
}

/// The completed fraction of a linear motion at the fraction `share` of a phase of `samples` samples. The first sample
/// is at its start, the last at its end, as in the tables of RH0 5.3.1.
fn linear(samples: usize, share: f64) -> f64 {
    if samples < 2 {
        return share;
    }
    ((share * samples as f64 - 1.0) / (samples - 1) as f64).max(0.0)
}

/// The outward unit vector from the robot's middle to the foot of `side`, along the sole's own axis.
fn outwards(side: Side, world_from_sole: &Pose) -> Vector2<f64> {
    (world_from_sole.rotation * Vector3::y()).xy() * side.sign()
}
