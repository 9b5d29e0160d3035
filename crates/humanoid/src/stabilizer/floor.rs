//! The slope of the floor, from the inclination of the soles that stand. Main type: [`Floor`].

use nalgebra::{UnitQuaternion, Vector2, Vector3};

use super::distribution::extent;
use super::estimate::Estimate;
use super::planned::Instant;
use crate::gait::{Biped, GRAVITY};

/// The rate at which the estimate follows the soles \[1/s\].
const RATE: f64 = 2.0;
/// A sole is flat on the floor if it carries this fraction of the weight, and its centre of pressure is so far from its border, as a fraction of half of its
/// size: a sole that tilts about an edge has its pressure there.
const CARRIES: f64 = 0.15;
const INSIDE: f64 = 0.1;
/// The greatest slope: 10 degrees.
const STEEPEST: f64 = 0.18;

/// A plane floor under the walk.
#[derive(Clone, Debug, Default)]
pub(super) struct Floor {
    /// The rise of the floor along x and y of the world, whose z axis is vertical.
    slope: Vector2<f64>,
}

impl Floor {
    /// Puts the planned soles on the floor: they are inclined and moved up or down. The floor is at the planned height below the centre of mass.
    pub fn incline(&self, plan: &mut Instant) {
        let turn = UnitQuaternion::from_scaled_axis(Vector3::new(self.slope.y, -self.slope.x, 0.0));
        for sole in &mut plan.soles {
            sole.translation.z += self.slope.dot(&(sole.translation.vector - plan.centre.coords).xy());
            sole.rotation = turn * sole.rotation;
        }
    }

    /// Moves the estimate towards the inclination of the soles while both are flat on the floor. One sole alone may tilt with a robot that tips.
    pub fn observe(&mut self, biped: &Biped, plan: &Instant, seen: &Estimate, dt: f64) {
        let weight = biped.model.mass() * GRAVITY;
        let is_flat = |side: usize| {
            let [low, high] = extent(biped, side);
            let (at, room) = (seen.pressure[side].coords, INSIDE * (high - low) / 2.0);
            let is_inside = at == at.sup(&(low + room)).inf(&(high - room));
            plan.stands[side] && seen.pressed[side] > CARRIES * weight && is_inside
        };
        if !(is_flat(0) && is_flat(1)) {
            return;
        }
        let rise = |side: usize| {
            let normal = seen.soles[side].rotation * Vector3::z();
            -normal.xy() / normal.z
        };
        let mean = (rise(0) * seen.pressed[0] + rise(1) * seen.pressed[1]) / (seen.pressed[0] + seen.pressed[1]);
        self.slope += (RATE * dt).min(1.0) * (mean - self.slope);
        self.slope = self.slope.map(|rise| rise.clamp(-STEEPEST, STEEPEST));
    }
}
