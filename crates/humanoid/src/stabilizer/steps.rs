//! Displaced footsteps. Main type: [`Steps`].

use nalgebra::Vector2;

use super::distribution::{extent, middle};
use super::planned::{Instant, PlannedWalk};
use crate::gait::{Biped, Footprint};

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

/// The displacements of the feet and of the reference from the plan \[m\].
#[derive(Clone, Debug, Default)]
pub(super) struct Steps {
    /// The displacements of the soles, left and right.
    feet: [Vector2<f64>; 2],
    /// That of the centre of mass, the zero moment point and the torso.
    reference: Vector2<f64>,
    /// The foot that swings, and the displacement of its next footstep.
    swing: Option<(usize, Vector2<f64>)>,
}

impl Steps {
    /// The displaced plan, `dt` after the last time.
    pub fn displace(&mut self, walk: &PlannedWalk, time: f64, dt: f64, plan: &mut Instant) {
        let swinging = match plan.stands {
            [true, false] => Some(1),
            [false, true] => Some(0),
            _ => None,
        };
        self.swing = swinging.map(|side| match self.swing {
            Some((same, step)) if same == side => (side, step),
            _ => (side, self.reference),
        });
        match self.swing {
            Some((side, step)) => {
                let remaining = walk.landing(side, time).map_or(0.0, |landing| EARLY * (landing - time));
                approach(&mut self.feet[side], step, dt, remaining);
                approach(&mut self.reference, self.feet[1 - side], dt, remaining);
            }
            None => {
                let (end, goal) = match walk.lift(time) {
                    // The next foot to lift is left behind.
                    Some((lift, side)) => (lift - time, self.feet[1 - side]),
                    None => (SETTLE, (self.feet[0] + self.feet[1]) / 2.0),
                };
                approach(&mut self.reference, goal, dt, end);
            }
        }
        for side in [0, 1] {
            plan.soles[side].translation.vector += self.feet[side].push(0.0);
        }
        let moved = self.reference.push(0.0);
        plan.centre += moved;
        plan.zmp += self.reference;
        plan.posture.world_from_torso.translation.vector += moved;
    }

    /// Moves the next footstep: with the zero moment point off by `held` from its plan, the error of the DCM grows until the landing. The footstep moves by
    /// the error then, so that the next step begins without one. Returns the factor on the speed of the swing: where the error would be greater than a footstep
    /// can move, the foot lands earlier.
    pub fn adjust(
        &mut self,
        biped: &Biped,
        plan: &Instant,
        (error, held): (Vector2<f64>, Vector2<f64>),
        (rate, remaining): (f64, f64),
    ) -> f64 {
        let Some((side, _)) = self.swing else { return 1.0 };
        let most = MOST * plan.height();
        // In this time the error grows to `most`.
        let left = ((most + held.norm()) / (error - held).norm()).ln() / rate;
        let hurry = if remaining > SHORTEST { (remaining / left.max(SHORTEST)).clamp(1.0, MOST_HURRY) } else { 1.0 };
        let grown = held + (error - held) * (rate * remaining / hurry).exp();
        let moved = grown * (most / grown.norm().max(most));
        if moved.norm() < LEAST * plan.height() {
            return hurry;
        }
        // In the frame of the standing foot, the swinging one stays on its side.
        let print = Footprint::below(&plan.soles[1 - side]);
        let turn = |vector: &Vector2<f64>, sign: f64| {
            let (sine, cosine) = (sign * print.yaw).sin_cos();
            Vector2::new(cosine * vector.x - sine * vector.y, sine * vector.x + cosine * vector.y)
        };
        let outward = if side == 0 { 1.0 } else { -1.0 };
        let widths = [0, 1].map(|side| extent(biped, side)).map(|[low, high]| high.y - low.y);
        let apart = 0.5 * (widths[0] + widths[1]) + BETWEEN;
        let planned = 2.0 * biped.half_width() + outward * (middle(biped, side) - middle(biped, 1 - side)).y;
        let mut own = turn(&moved, -1.0);
        own.y = outward * (outward * own.y).max((apart - planned).min(0.0));
        self.swing = Some((side, self.reference + turn(&own, 1.0)));
        hurry
    }
}

/// Moves a value to its goal in the remaining time.
fn approach(value: &mut Vector2<f64>, goal: Vector2<f64>, dt: f64, remaining: f64) {
    *value += (goal - *value) * (dt / remaining.max(dt)).min(1.0);
}
