//! Displaced footsteps. Main type: [`Steps`].

use nalgebra::{Point2, Rotation2, UnitQuaternion, Vector2, Vector3};

use super::distribution::{extent, middle};
use super::planned::{Instant, PlannedWalk};
use crate::gait::{Biped, Footprint};
use groebot_robot::spatial::{Pose, angle};

/// The greatest displacement of a footstep from its plan, as a fraction of the height of the centre of mass.
const MOST: f64 = 0.2;
/// The least displacement for which a footstep moves, as such a fraction.
const LEAST: f64 = 0.02;
/// The least distance between two soles \[m\].
const BETWEEN: f64 = 0.01;
/// The fraction of the remaining swing in which the foot reaches its displaced place.
const EARLY: f64 = 0.8;
/// The time in which the reference follows the feet after the last step \[s\].
const SETTLE: f64 = 0.5;
/// The greatest factor on the speed of a swing.
const MOST_HURRY: f64 = 2.0;
/// The least time to a landing that is shortened \[s\].
const SHORTEST: f64 = 0.05;

/// The greatest correction of the heading in a footstep \[rad\].
const MOST_TURN: f64 = 0.06;
/// The time constant of the filter of the heading's error \[s\].
const HEADING: f64 = 0.5;

/// A displacement of the floor: a rotation about the origin, then a translation \[rad, m\].
#[derive(Clone, Copy, Debug, Default)]
struct Shift {
    angle: f64,
    offset: Vector2<f64>,
}

impl Shift {
    fn at(&self, point: &Point2<f64>) -> Point2<f64> {
        Rotation2::new(self.angle) * point + self.offset
    }

    fn of(&self, pose: &Pose) -> Pose {
        Pose::from_parts(self.offset.push(0.0).into(), UnitQuaternion::from_axis_angle(&Vector3::z_axis(), self.angle))
            * pose
    }

    /// This displacement, then a rotation about a point.
    fn turned(&self, angle: f64, about: &Point2<f64>) -> Self {
        let turn = Rotation2::new(angle);
        let offset = about.coords + turn * (self.offset - about.coords);
        Shift { angle: self.angle + angle, offset }
    }

    /// The displacement that moves `from` to `to`.
    fn between(from: &Footprint, to: &Footprint) -> Self {
        let angle = angle::difference(to.yaw, from.yaw);
        Shift { angle, offset: to.point().coords - Rotation2::new(angle) * from.point().coords }
    }

    /// Moves to `goal` in the remaining time.
    fn approach(&mut self, goal: &Shift, dt: f64, remaining: f64) {
        let share = (dt / remaining.max(dt)).min(1.0);
        self.angle += (goal.angle - self.angle) * share;
        self.offset += (goal.offset - self.offset) * share;
    }
}

/// The displacements of the feet and of the reference from the plan.
#[derive(Clone, Debug, Default)]
pub(super) struct Steps {
    /// The displacements of the soles, left and right.
    feet: [Shift; 2],
    /// That of the centre of mass, the zero moment point and the torso.
    reference: Shift,
    /// The foot that swings, and how much its next footstep moves after the correction of the heading \[m\].
    swing: Option<(usize, Vector2<f64>)>,
    /// Where the swinging foot has touched the floor before its planned landing.
    touched: Option<Footprint>,
    /// The measured heading of the torso minus the planned one: at the start, and its filtered change since then \[rad\].
    heading: Option<(f64, f64)>,
}

impl Steps {
    /// Measures the heading of the torso, beside the one of the plan without displacements, `dt` after the last time.
    pub fn measure(&mut self, heading: f64, planned: f64, dt: f64) {
        let off = angle::difference(heading, planned);
        let (start, error) = self.heading.unwrap_or((off, 0.0));
        let share = (dt / HEADING).min(1.0);
        self.heading = Some((start, error + share * (angle::difference(off, start) - error)));
    }

    /// The displaced plan, `dt` after the last time. A swinging foot that presses the floor in the second half of its swing stays where it is. The next footstep
    /// turns about the standing foot by `gain` times the error of the heading.
    pub fn displace(
        &mut self,
        walk: &PlannedWalk,
        (time, dt): (f64, f64),
        (is_pressed, gain): ([bool; 2], f64),
        plan: &mut Instant,
    ) {
        let swinging = match plan.stands {
            [true, false] => Some(1),
            [false, true] => Some(0),
            _ => None,
        };
        if swinging.is_none() {
            self.touched = None;
        }
        self.swing = swinging.map(|side| match self.swing {
            Some((same, moved)) if same == side => (side, moved),
            _ => (side, Vector2::zeros()),
        });
        match self.swing {
            Some((side, moved)) => {
                let left = walk.swing_left(side, time);
                let remaining = left.map_or(0.0, |(left, _)| EARLY * left);
                let [planned, stands] = [side, 1 - side].map(|side| Footprint::below(&plan.soles[side]));
                let is_late = left.is_some_and(|(_, share)| share < 0.5);
                match self.touched {
                    Some(place) => self.feet[side] = Shift::between(&planned, &place),
                    None if is_late && is_pressed[side] => {
                        self.touched = Some(Footprint::below(&self.feet[side].of(&plan.soles[side])));
                    }
                    None => {
                        let stand = self.feet[1 - side];
                        let error = self.heading.map_or(0.0, |(_, error)| gain * error);
                        let mut goal = stand.turned(-error.clamp(-MOST_TURN, MOST_TURN), &stand.at(&stands.point()));
                        goal.offset += moved;
                        self.feet[side].approach(&goal, dt, remaining);
                    }
                }
                let stand = self.feet[1 - side];
                self.reference.approach(&stand, dt, remaining);
            }
            None => {
                let (end, goal) = match walk.lift(time) {
                    // The next foot to lift is left behind.
                    Some((lift, side)) => (lift - time, self.feet[1 - side]),
                    None => {
                        let [left, right] = self.feet;
                        let middle = (left.offset + right.offset) / 2.0;
                        (SETTLE, Shift { angle: (left.angle + right.angle) / 2.0, offset: middle })
                    }
                };
                self.reference.approach(&goal, dt, end);
            }
        }
        for side in [0, 1] {
            plan.soles[side] = self.feet[side].of(&plan.soles[side]);
        }
        plan.centre = self.reference.at(&plan.centre.xy()).coords.push(plan.centre.z).into();
        plan.velocity = (Rotation2::new(self.reference.angle) * plan.velocity.xy()).push(plan.velocity.z);
        plan.zmp = self.reference.at(&plan.zmp);
        plan.posture.world_from_torso = self.reference.of(&plan.posture.world_from_torso);
    }

    /// Moves the next footstep: with the zero moment point off by `held` from its plan, the error of the DCM grows until the landing. The footstep moves by
    /// the error then, so that the next step begins without one. Returns the factor on the speed of the swing: where the error would be greater than a footstep
    /// can move, the foot lands earlier. `spare` is the factor that the joints' speed limits permit.
    pub fn adjust(
        &mut self,
        biped: &Biped,
        plan: &Instant,
        (error, held): (Vector2<f64>, Vector2<f64>),
        (rate, remaining, spare): (f64, f64, f64),
    ) -> f64 {
        let Some((side, _)) = self.swing else { return 1.0 };
        let most = MOST * plan.height();
        // In this time the error grows to `most`.
        let left = ((most + held.norm()) / (error - held).norm()).ln() / rate;
        let hurry =
            if remaining > SHORTEST { (remaining / left.max(SHORTEST)).clamp(1.0, spare.min(MOST_HURRY)) } else { 1.0 };
        let grown = held + (error - held) * (rate * remaining / hurry).exp();
        let moved = grown * (most / grown.norm().max(most));
        if moved.norm() < LEAST * plan.height() {
            return hurry;
        }
        // In the frame of the standing foot, the swinging one stays on its side.
        let turn = Rotation2::new(Footprint::below(&plan.soles[1 - side]).yaw);
        let outward = if side == 0 { 1.0 } else { -1.0 };
        let widths = [0, 1].map(|side| extent(biped, side)).map(|[low, high]| high.y - low.y);
        let apart = 0.5 * (widths[0] + widths[1]) + BETWEEN;
        let planned = 2.0 * biped.half_width() + outward * (middle(biped, side) - middle(biped, 1 - side)).y;
        let mut own = turn.inverse() * moved;
        own.y = outward * (outward * own.y).max((apart - planned).min(0.0));
        self.swing = Some((side, turn * own));
        hurry
    }
}
