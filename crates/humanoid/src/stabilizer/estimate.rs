//! Pose of the torso, centre of mass and DCM from the measured state. Main type: [`Observer`].

use nalgebra::{Isometry3, Point2, Point3, Translation3, UnitQuaternion, Vector2, Vector3};

use super::planned::Instant;
use super::state::State;
use crate::Result;
use crate::gait::{Biped, Footprint};
use groebot_robot::spatial::{Pose, angle};

/// Fraction of the weight above which a sole is in contact.
pub(super) const PRESSED: f64 = 0.05;

/// What is known of the robot at one time, in the world of the plan.
#[derive(Clone, Debug)]
pub(super) struct Estimate {
    /// The pose of the torso.
    pub torso: Pose,
    /// The centre of mass \[m\].
    pub centre: Point3<f64>,
    /// The DCM \[m\].
    pub dcm: Point2<f64>,
    /// The poses of the soles.
    pub soles: [Pose; 2],
    /// The normal force on each sole \[N\].
    pub pressed: [f64; 2],
    /// The centre of pressure of each sole, in its frame \[m\].
    pub pressure: [Point2<f64>; 2],
}

/// Observer of the horizontal motion of the centre of mass: a pendulum, corrected by forward kinematics.
#[derive(Clone, Debug, Default)]
pub(super) struct Observer {
    /// The position \[m\] and the velocity \[m/s\].
    motion: Option<(Vector2<f64>, Vector2<f64>)>,
}

impl Observer {
    /// The estimate at a state, `dt` after the last one. `rate` is that of the pendulum, `bandwidth` that of the
    /// observer \[rad/s\].
    pub fn estimate(
        &mut self,
        biped: &Biped,
        plan: &Instant,
        state: &State,
        (dt, rate, bandwidth): (f64, f64, f64),
    ) -> Result<Estimate> {
        let weight = biped.model.mass() * crate::gait::GRAVITY;
        let pressed = state.soles.map(|sole| sole.force.z.max(0.0));
        let shares = shares(plan, pressed, weight);
        let orientation = state.orientation * biped.torso_from_root.rotation.inverse();
        let upright = Isometry3::from_parts(Translation3::identity(), orientation);
        let placed = biped.model.place(&upright, &state.q)?;
        let own = [0, 1].map(|side| {
            let foot = &biped.feet[side];
            let (_, torso_from_link) = biped.model.link(foot.link);
            placed.world_from_link(foot.link) * torso_from_link.inv_mul(&foot.torso_from_sole)
        });
        // The heading and the place are those of the soles that stand.
        let turns = [0, 1].map(|side| {
            angle::wrap(Footprint::below(&plan.soles[side]).yaw - Footprint::below(&own[side]).yaw) * shares[side]
        });
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), turns[0] + turns[1]);
        let places = [0, 1]
            .map(|side| (plan.soles[side].translation.vector - turn * own[side].translation.vector) * shares[side]);
        let moved = Isometry3::from_parts((places[0] + places[1]).into(), turn);
        let centre = moved * placed.centre_of_mass();
        let pressure = [0, 1].map(|side| {
            let moment = state.soles[side].moment;
            if pressed[side] > PRESSED * weight {
                Point2::new(-moment.y / pressed[side], moment.x / pressed[side])
            } else {
                Point2::origin()
            }
        });
        let soles = own.map(|sole| moved * sole);
        let zmp = zmp(&soles, pressed, pressure);
        let at = centre.xy().coords;
        let (mut place, mut velocity) = self.motion.unwrap_or((at, plan.velocity.xy()));
        let error = at - place;
        let fall = zmp.map_or(Vector2::zeros(), |zmp| (at - zmp.coords) * rate * rate);
        place += dt * (velocity + 1.4 * bandwidth * error);
        velocity += dt * (fall + bandwidth * bandwidth * error);
        self.motion = Some((place, velocity));
        let dcm = Point2::from(place + velocity / rate);
        Ok(Estimate { torso: moved * upright, centre, dcm, soles, pressed, pressure })
    }
}

/// The share of each sole in the support: by the forces, or by the plan where there are none.
fn shares(plan: &Instant, pressed: [f64; 2], weight: f64) -> [f64; 2] {
    let pressed = if pressed[0] + pressed[1] > PRESSED * weight { pressed } else { plan.stands.map(f64::from) };
    let sum = pressed[0] + pressed[1];
    if sum > 0.0 { [pressed[0] / sum, pressed[1] / sum] } else { [0.5, 0.5] }
}

/// The measured zero moment point \[m\], if a sole is pressed.
fn zmp(soles: &[Pose; 2], pressed: [f64; 2], pressure: [Point2<f64>; 2]) -> Option<Point2<f64>> {
    let at = |side: usize| {
        let point = soles[side] * Point3::new(pressure[side].x, pressure[side].y, 0.0);
        point.xy().coords * pressed[side]
    };
    let sum = pressed[0] + pressed[1];
    (sum > 0.0).then(|| Point2::from((at(0) + at(1)) / sum))
}
