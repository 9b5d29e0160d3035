//! References of the feet and the centre of mass at each sample. Main type: [`Reference`].

use nalgebra::Point2;

use super::footprint::{Footprint, Side};
use super::schedule::{Action, Schedule};
use groebot_robot::spatial::Pose;

/// The parameters of a gait. Metres, seconds, radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// The height to which a foot is lifted: `z_d` of NAO 6.8.
    pub lift: f64,
    /// The lateral displacement of the centre of mass, from the middle of feet that are `half_width` to each side: `A`
    /// of NAO (6.8.1).
    pub amplitude: f64,
    /// Half of the lateral distance between the feet.
    pub half_width: f64,
    /// The distance of the centre of mass forward of the ankles.
    pub ahead: f64,
    /// The height of the torso's origin above the floor.
    pub torso_height: f64,
}

/// The reference at a sample.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Reference {
    /// The index of the phase in the schedule.
    pub phase: usize,
    /// The poses of the soles in the world, left and right.
    pub world_from_soles: [Pose; 2],
    /// Whether each foot supports, left and right.
    pub stands: [bool; 2],
    /// The position of the centre of mass, seen from above \[m\].
    pub centre: Point2<f64>,
    /// The height of the torso's origin above the floor \[m\].
    pub torso_height: f64,
    /// The heading of the torso \[rad\]. Where the legs share an actuator, the legs determine the heading instead.
    pub heading: f64,
}

/// The minimum-jerk profile from 0 to 1 (Flash and Hogan 1985): velocity and acceleration are zero at both ends.
pub fn smooth(share: f64) -> f64 {
    let s = share.clamp(0.0, 1.0);
    s * s * s * (10.0 - s * (15.0 - 6.0 * s))
}

/// A smooth profile from 0 to 1 and back: velocity and acceleration are zero at both ends.
pub fn arch(share: f64) -> f64 {
    let s = share.clamp(0.0, 1.0);
    (4.0 * s * (1.0 - s)).powi(3)
}

impl Style {
    /// The position of the centre of mass in single support on the foot of `side` at `print`: at `y = +-A` when the
    /// foot is at `+-half_width`.
    pub fn over(&self, side: Side, print: &Footprint) -> Point2<f64> {
        print.carry(&Point2::new(self.ahead, side.sign() * (self.amplitude - self.half_width)))
    }

    /// The position of the centre of mass at rest in double support.
    pub(crate) fn between(&self, feet: &[Footprint; 2]) -> Point2<f64> {
        feet[0].middle(&feet[1]).carry(&Point2::new(self.ahead, 0.0))
    }

    /// The start and the end of the path of the centre of mass in the shift to step `step`.
    pub(crate) fn ends(&self, schedule: &Schedule, step: usize, feet: &[Footprint; 2]) -> [Point2<f64>; 2] {
        let before = step.checked_sub(1).and_then(|before| schedule.stance(before));
        let at = |side: Option<Side>| match side {
            Some(side) => self.over(side, &feet[side as usize]),
            None => self.between(feet),
        };
        [at(before), at(schedule.stance(step))]
    }
}

/// The centre of mass by the law of NAO (6.8.1). In double support it follows `y = A sin(pi x / x_d)` with x from
/// `-x_d/2` to `x_d/2`; in single support it rests. The first shift starts, and the last one ends, at `x = 0`, where
/// the curve crosses the middle.
pub(crate) fn sine_centre(
    style: &Style,
    schedule: &Schedule,
    action: Action,
    feet: &[Footprint; 2],
    share: f64,
) -> Point2<f64> {
    between_stances(style, schedule, action, feet, |step, [mut from, mut to]| {
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

/// A point that rests between the feet or above one foot, and moves from one to the other in a shift. `shifting` gets
/// the step and both ends of the path.
pub(super) fn between_stances(
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

/// The point at `u = x / x_d` of the sine from `from` (`u = -1/2`) to `to` (`u = 1/2`), with x along the heading of
/// `middle`.
fn along_sine(from: &Point2<f64>, to: &Point2<f64>, middle: &Footprint, u: f64) -> Point2<f64> {
    let offset = to - from;
    let ahead = middle.ahead() * offset.dot(&middle.ahead());
    let aside = offset - ahead;
    nalgebra::center(from, to) + ahead * u + aside * (0.5 * (std::f64::consts::PI * u).sin())
}

/// The interval of a swing, as fractions, in which the foot moves forward. Lift-off is before it and landing after it,
/// so that a robot whose servos sag does not drag the foot.
const AHEAD: (f64, f64) = (0.05, 0.9);

/// The poses of the soles, and which feet support, at the fraction `share` of a phase. The swing foot is lifted in the
/// vertical plane of its path.
pub(crate) fn soles(
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
