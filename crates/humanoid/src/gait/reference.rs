//! What a walk asks of the feet and of the centre of mass at each sample. Main type: [`Reference`].

use nalgebra::Point2;

use super::footprint::{Footprint, Side};
use super::schedule::{Action, Schedule};
use groebot_robot::spatial::Pose;

/// The figures of a gait. Metres, seconds, radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// `z_d` of NAO 6.8: how high a foot is lifted.
    pub lift: f64,
    /// `A` of NAO (6.8.1): how far to the side the centre of mass goes, seen from the middle of feet that stand `half_width` to each side.
    pub amplitude: f64,
    /// Half of the way from foot to foot, sideways.
    pub half_width: f64,
    /// How far ahead of the ankles the centre of mass is held.
    pub ahead: f64,
    /// The height of the torso's origin over the floor.
    pub torso_height: f64,
}

/// What is asked at a sample.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    /// The phase, by its place in the schedule.
    pub phase: usize,
    /// The poses of the soles in the world, left and right.
    pub world_from_soles: [Pose; 2],
    /// Which feet stand.
    pub stands: [bool; 2],
    /// Where the centre of mass is to be, seen from above.
    pub centre: Point2<f64>,
    /// The height of the torso's origin over the floor \[m\].
    pub torso_height: f64,
    /// Where the torso is to look \[rad\]; where the legs share an actuator, the actuator has the last word.
    pub heading: f64,
}

/// The smoothest way from 0 to 1 with rest at both ends: velocity and acceleration are zero there (the minimum-jerk profile, Flash and
/// Hogan 1985).
pub fn smooth(share: f64) -> f64 {
    let s = share.clamp(0.0, 1.0);
    s * s * s * (10.0 - s * (15.0 - 6.0 * s))
}

/// The smoothest way from 0 up to 1 and back: velocity and acceleration are zero at both ends.
pub fn arch(share: f64) -> f64 {
    let s = share.clamp(0.0, 1.0);
    (4.0 * s * (1.0 - s)).powi(3)
}

impl Style {
    /// Where the centre of mass is while the foot of `side`, at `print`, stands alone: at `y = +-A` when the foot is at `+-half_width`.
    pub fn over(&self, side: Side, print: &Footprint) -> Point2<f64> {
        print.carry(&Point2::new(self.ahead, side.sign() * (self.amplitude - self.half_width)))
    }

    /// Where the centre of mass is at rest on both feet.
    pub fn between(&self, feet: &[Footprint; 2]) -> Point2<f64> {
        feet[0].middle(&feet[1]).carry(&Point2::new(self.ahead, 0.0))
    }

    /// The two ends of the way of the centre of mass in the shift to step `step`.
    pub fn ends(&self, schedule: &Schedule, step: usize, feet: &[Footprint; 2]) -> [Point2<f64>; 2] {
        let before = step.checked_sub(1).and_then(|before| schedule.stance(before));
        let at = |side: Option<Side>| match side {
            Some(side) => self.over(side, &feet[side as usize]),
            None => self.between(feet),
        };
        [at(before), at(schedule.stance(step))]
    }
}

/// The seed's law, NAO (6.8.1): on both feet the centre of mass follows `y = A sin(pi x / x_d)` with x from `-x_d/2` to `x_d/2`; over one
/// foot it stays. The first shift starts, and the last one ends, at `x = 0`, where the curve crosses the middle.
pub fn seed_centre(
    style: &Style,
    schedule: &Schedule,
    action: Action,
    feet: &[Footprint; 2],
    share: f64,
) -> Point2<f64> {
    on_the_way(style, schedule, action, feet, |step, [mut from, mut to]| {
        let (mut low, mut high) = (-0.5, 0.5);
        if step == 0 {
            (low, from) = (0.0, from + (from - to));
        } else if schedule.stance(step).is_none() {
            (high, to) = (0.0, to + (to - from));
        }
        let u = low + (high - low) * smooth(share);
        along_sine(&from, &to, &feet[0].middle(&feet[1]), u)
    })
}

/// A point that rests between the feet or over one foot, and goes from one place to the other in a shift: `shifting` gets the step and
/// the two ends of its way.
pub(super) fn on_the_way(
    style: &Style,
    schedule: &Schedule,
    action: Action,
    feet: &[Footprint; 2],
    shifting: impl FnOnce(usize, [Point2<f64>; 2]) -> Point2<f64>,
) -> Point2<f64> {
    match action {
        Action::Rest | Action::Lower | Action::Rise | Action::Balance(_) => style.between(feet),
        Action::Swing(step) => style.ends(schedule, step, feet)[1],
        Action::Shift(step) => shifting(step, style.ends(schedule, step, feet)),
    }
}

/// The point at `u = x / x_d` of the sine from `from` (`u = -1/2`) to `to` (`u = 1/2`), with x along the heading of `middle`.
fn along_sine(from: &Point2<f64>, to: &Point2<f64>, middle: &Footprint, u: f64) -> Point2<f64> {
    let way = to - from;
    let ahead = middle.ahead() * way.dot(&middle.ahead());
    let aside = way - ahead;
    nalgebra::center(from, to) + ahead * u + aside * (0.5 * (std::f64::consts::PI * u).sin())
}

/// The shares of a swing between which the foot moves ahead: it leaves the floor before, and lands behind, so that a robot whose servos
/// sag does not drag it.
const AHEAD: (f64, f64) = (0.05, 0.9);

/// The poses of the soles, and which feet stand, at the share `share` of a phase: the swinging foot is lifted in the plane of its way.
pub fn soles(
    style: &Style,
    schedule: &Schedule,
    action: Action,
    feet: &[Footprint; 2],
    share: f64,
) -> ([Pose; 2], [bool; 2]) {
    let mut poses = feet.map(|print| print.at_height(0.0));
    let mut stands = [true; 2];
    if let Action::Swing(step) = action {
        let step = schedule.route.steps[step];
        let place = step.side as usize;
        poses[place] = feet[place]
            .towards(&step.print, smooth((share - AHEAD.0) / (AHEAD.1 - AHEAD.0)))
            .at_height(style.lift * arch(share));
        stands[place] = share >= 1.0;
    }
    (poses, stands)
}
