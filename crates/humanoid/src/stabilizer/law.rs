//! The feedback law. Main type: [`Stabilizer`].

use nalgebra::{Isometry3, Point2, Translation3, UnitQuaternion, Vector2, Vector3};

use super::descent::{Descent, least};
use super::distribution::{Part, distribute, within};
use super::estimate::{Estimate, Observer, PRESSED};
use super::floor::Floor;
use super::gains::StabilizerGains;
use super::planned::{Instant, PlannedWalk};
use super::sag::static_torques;
use super::state::{JointTargets, State};
use super::steps::Steps;
use crate::gait::{Footprint, GRAVITY, Posture, Side, Walker};
use crate::{Error, ErrorKind, Result};
use groebot_robot::motion::Trajectory;
use groebot_robot::spatial::{Pose, angle};

/// Greatest rotation of a sole by the admittance \[rad\].
const MOST_TILT: f64 = 0.2;
/// Greatest rotation of the torso \[rad\].
const MOST_LEAN: f64 = 0.25;
/// Greatest displacement of the torso, as a fraction of the height of the centre of mass.
const MOST_SWAY: f64 = 0.15;
/// The time in which a swinging foot returns to its plan \[s\].
const RETURN: f64 = 0.1;
/// The time in which corrections of standing feet fade \[s\].
const FADE: f64 = 2.0;
/// The least distance of the desired ZMP from the border of the support, as a fraction of half of the sole's width.
const MARGIN: f64 = 0.15;
/// A greater change of a joint within one step of the law is a jump to another solution \[rad\].
const JUMP: f64 = 0.5;
/// Longest time between two steps of the law that is integrated \[s\].
const MOST_STEP: f64 = 0.05;
/// The first change of the heading of a torso whose legs share an actuator, and the difference at which they agree \[rad\].
const FIRST_TURN: f64 = 1e-3;
const AGREED: f64 = 1e-9;
/// The number of iterations for the heading of a torso whose legs share an actuator.
const HEADINGS: usize = 4;

/// Feedback for a planned walk: joint targets from the measured state. It owns no clock: the time is that of the state.
#[derive(Clone, Debug)]
pub struct Stabilizer {
    walker: Walker,
    walk: PlannedWalk,
    gains: StabilizerGains,
    observer: Observer,
    last: Posture,
    before: Option<(f64, Vec<f64>)>,
    integral: Vector2<f64>,
    /// The rotation of each sole about its x and y axes \[rad\].
    tilts: [Vector2<f64>; 2],
    /// The rotation of the torso about x and y of its heading \[rad\].
    lean: Vector2<f64>,
    steps: Steps,
    floor: Floor,
    /// The displacement of the torso \[m\].
    sway: Vector2<f64>,
    /// The stiffness of each joint's position controller \[N m/rad or N/m\].
    stiffness: Option<Vec<f64>>,
    /// How much higher the left sole is than planned, and the right one lower \[m\].
    height: f64,
    descent: Descent,
    /// How much later in the plan the walk is than the time of the states \[s\], and the speed of the plan.
    ahead: f64,
    speed: f64,
}

impl Stabilizer {
    /// A stabiliser of `walk`, which was planned for `walker`.
    ///
    /// # Errors
    /// [`ErrorKind::MissingKey`] for a trajectory that is not a walk with its ZMP; [`ErrorKind::UnknownName`] for joints that the walker does not have;
    /// [`ErrorKind::BadValue`] when the centre of mass is not above the soles.
    pub fn new(walker: Walker, walk: &Trajectory) -> Result<Self> {
        let walk = PlannedWalk::new(&walker, walk)?;
        let last = walk.at(0.0).posture;
        Ok(Stabilizer {
            walker,
            walk,
            gains: StabilizerGains::default(),
            stiffness: None,
            observer: Observer::default(),
            last,
            before: None,
            steps: Steps::default(),
            floor: Floor::default(),
            integral: Vector2::zeros(),
            tilts: [Vector2::zeros(); 2],
            lean: Vector2::zeros(),
            sway: Vector2::zeros(),
            height: 0.0,
            descent: Descent::default(),
            ahead: 0.0,
            speed: 1.0,
        })
    }

    /// Sets the gains.
    #[must_use]
    pub fn gains(mut self, gains: StabilizerGains) -> Self {
        self.gains = gains;
        self
    }

    /// Sets the stiffness of position controllers without integral action \[N m/rad\]: the targets then contain the deflection of the joints under the weight.
    #[must_use]
    pub fn stiffness(mut self, stiffness: f64) -> Self {
        self.stiffness = Some(vec![stiffness; self.walker.biped.joints.len()]);
        self
    }

    /// Sets the stiffness of each joint's controller \[N m/rad; N/m of a prismatic joint\], in the order of `Biped::joints`; infinite for one without
    /// deflection. Otherwise same as [`Stabilizer::stiffness`].
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for another number of joints, and for a stiffness that is not positive.
    pub fn joint_stiffness(mut self, stiffness: Vec<f64>) -> Result<Self> {
        let biped = &self.walker.biped;
        if stiffness.len() != biped.joints.len() {
            let text = format!(
                "there are {} numbers of stiffness; {} has {} joints",
                stiffness.len(),
                biped.name,
                biped.joints.len()
            );
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        if let Some((value, joint)) =
            stiffness.iter().zip(&biped.joints).find(|(value, _)| value.is_nan() || **value <= 0.0)
        {
            let text = format!("the stiffness of `{}` is {value}; give a positive number", joint.name);
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        self.stiffness = Some(stiffness);
        Ok(self)
    }

    /// The joint targets at a state. The states of a walk are given in the order of time, for example at 200 Hz.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a state with the wrong number of joint values, or with values that are not finite, for a time before that of the last
    /// state, and when a corrected sole is out of reach.
    pub fn step(&mut self, state: &State) -> Result<JointTargets> {
        self.check(state)?;
        let dt = self.before.as_ref().map_or(0.0, |(time, _)| (state.time - time).min(MOST_STEP));
        self.ahead += dt * (self.speed - 1.0);
        let time = state.time + self.ahead;
        let mut plan = self.walk.at(time);
        let weight = self.walker.biped.model.mass() * GRAVITY;
        let is_pressed = state.soles.map(|sole| sole.force.z > PRESSED * weight);
        let torso = state.orientation * self.walker.biped.torso_from_root.rotation.inverse();
        self.steps.measure(yaw(&torso), yaw(&plan.posture.world_from_torso.rotation), dt);
        self.steps.displace(&self.walk, (time, dt), (is_pressed, self.gains.heading), &mut plan);
        self.floor.incline(&mut plan);
        let rate = (GRAVITY / plan.height()).sqrt();
        let seen = self.observer.estimate(&self.walker.biped, &plan, state, (dt, rate, self.gains.observer))?;
        self.floor.observe(&self.walker.biped, &plan, &seen, dt);
        let parts = self.balance(&plan, &seen, rate, (time, dt));
        self.turn_soles(&plan, &seen, &parts, dt);
        self.straighten(&plan, &seen, dt);
        self.adapt_heights(&plan, &seen, &parts, dt);
        let (mut posture, soles) = self.posture(&plan, dt)?;
        self.last = posture.clone();
        if let Some(stiffness) = &self.stiffness {
            let torques = static_torques(&self.walker.biped, &posture, &soles, &parts)?;
            let sags = torques.into_iter().zip(stiffness).map(|(torque, stiffness)| torque / stiffness);
            posture.q.iter_mut().zip(sags).for_each(|(value, sag)| *value += sag);
        }
        Ok(self.targets(posture, state.time))
    }

    fn check(&self, state: &State) -> Result<()> {
        let bad = |text: String| Err(Error::new(ErrorKind::BadValue, text));
        let count = self.walker.biped.joints.len();
        if state.q.len() != count {
            return bad(format!(
                "the state has {} joint values; {} has {count}",
                state.q.len(),
                self.walker.biped.name
            ));
        }
        let forces = state.soles.iter().flat_map(|sole| sole.force.iter().chain(sole.moment.iter()));
        let numbers = state.q.iter().chain(state.orientation.coords.iter()).chain(state.angular_velocity.iter());
        if !state.time.is_finite() || numbers.chain(forces).any(|number| !number.is_finite()) {
            return bad("the state has a number that is not finite".to_owned());
        }
        match &self.before {
            Some((time, _)) if state.time < *time => {
                bad(format!("the state is of {} s, but the last one was of {time} s", state.time))
            }
            _ => Ok(()),
        }
    }

    /// The desired centres of pressure: the DCM returns to that of the plan.
    fn balance(&mut self, plan: &Instant, seen: &Estimate, rate: f64, (time, dt): (f64, f64)) -> [Part; 2] {
        let biped = &self.walker.biped;
        let wanted = plan.centre.xy() + plan.velocity.xy() / rate;
        let error = seen.dcm - wanted;
        let prints = plan.soles.map(|sole| Footprint::below(&sole));
        let standing: Vec<(Side, Pose)> = [Side::Left, Side::Right]
            .into_iter()
            .filter(|side| plan.stands[*side as usize])
            .map(|side| (side, prints[side as usize].at_height(0.0)))
            .collect();
        let support = biped.support(&standing, f64::INFINITY);
        let margin = MARGIN * half_width(biped);
        let inside = within(&support, &centroid(&support), &plan.zmp, margin);
        let zmp = plan.zmp + (1.0 + self.gains.dcm) * error + self.integral;
        let held = within(&support, &inside, &zmp, margin);
        self.speed = 1.0;
        if held == zmp {
            self.integral += dt * self.gains.integral * error;
        } else if let [left, right] = plan.stands
            && left != right
            && let Some(landing) = self.walk.landing(usize::from(left), time)
        {
            let times = (rate, landing - time, self.walk.spare);
            self.speed = self.steps.adjust(biped, plan, (error, held - plan.zmp), times);
        }
        distribute(biped, &prints, plan.stands, &held, margin)
    }

    /// Turns the soles until the moments on them are the desired ones.
    fn turn_soles(&mut self, plan: &Instant, seen: &Estimate, parts: &[Part; 2], dt: f64) {
        let biped = &self.walker.biped;
        let weight = biped.model.mass() * GRAVITY;
        let gain = self.gains.ankle / (self.gains.stiffness * weight * plan.height());
        for side in [0, 1] {
            let tilt = &mut self.tilts[side];
            if plan.stands[side] && seen.pressed[side] > PRESSED * weight {
                let away = parts[side].pressure - seen.pressure[side];
                let moment = Vector2::new(away.y, -away.x) * seen.pressed[side];
                *tilt -= dt * (gain * moment + *tilt / FADE);
            } else {
                *tilt *= 1.0 - (dt / RETURN).min(1.0);
            }
            *tilt = tilt.map(|angle| angle.clamp(-MOST_TILT, MOST_TILT));
        }
    }

    /// Turns the torso to its planned inclination.
    fn straighten(&mut self, plan: &Instant, seen: &Estimate, dt: f64) {
        let [should, is] = [&plan.posture.world_from_torso, &seen.torso].map(|pose| pose.rotation);
        let error = (is * should.inverse()).scaled_axis();
        self.lean -= dt * self.gains.torso * error.xy();
        self.lean = self.lean.map(|angle| angle.clamp(-MOST_LEAN, MOST_LEAN));
        let most = MOST_SWAY * plan.height();
        self.sway -= dt * self.gains.sway * (seen.centre.xy() - plan.centre.xy());
        self.sway = self.sway.map(|sway| sway.clamp(-most, most));
    }

    /// Moves the feet up or down until the weight is shared as desired.
    fn adapt_heights(&mut self, plan: &Instant, seen: &Estimate, parts: &[Part; 2], dt: f64) {
        let weight = self.walker.biped.model.mass() * GRAVITY;
        let share = |side: usize| seen.pressed[side] / weight;
        let excess = (share(0) - share(1)) - (parts[0].share - parts[1].share);
        let yielding = self.walker.biped.half_width().powi(2) / (self.gains.stiffness * plan.height());
        self.height += dt * (self.gains.height * yielding * excess - self.height / FADE);
    }

    /// The corrected posture, and the soles in it.
    fn posture(&mut self, plan: &Instant, dt: f64) -> Result<(Posture, [Pose; 2])> {
        let heights = [self.height, -self.height];
        let soles = [0, 1].map(|side| {
            let tilt = UnitQuaternion::from_scaled_axis(Vector3::new(self.tilts[side].x, self.tilts[side].y, 0.0));
            let lift = Translation3::new(0.0, 0.0, 0.5 * heights[side]);
            lift * plan.soles[side] * Isometry3::from_parts(Translation3::identity(), tilt)
        });
        let lean = UnitQuaternion::from_scaled_axis(Vector3::new(self.lean.x, self.lean.y, 0.0));
        let planned = plan.posture.world_from_torso;
        let sway = Translation3::new(self.sway.x, self.sway.y, 0.0);
        let torso = Pose::from_parts(sway * planned.translation, lean * planned.rotation);
        let last = Posture { world_from_torso: torso, q: self.held(plan) };
        let lowered = |by: f64| self.stand(&soles, &(Translation3::new(0.0, 0.0, -by) * torso), &last);
        let comes_near = |by: f64| lowered(by).ok().filter(|posture| self.is_near(posture));
        let needed = least(plan.height(), |by| comes_near(by).is_some());
        let Some(needed) = needed else {
            let by = least(plan.height(), |by| lowered(by).is_ok()).unwrap_or(0.0);
            return Ok((lowered(by)?, soles));
        };
        let mut descent = self.descent;
        let posture = comes_near(descent.follow(needed, plan.height(), dt));
        let posture = posture.map_or_else(|| lowered(needed), Ok)?;
        self.descent = descent;
        Ok((posture, soles))
    }

    /// Whether the legs come from their last posture without a jump: out of its reach, a leg may have solutions with another hip or ankle.
    fn is_near(&self, posture: &Posture) -> bool {
        let legs = self.walker.biped.feet.iter().flat_map(|foot| &foot.joints);
        legs.into_iter().all(|joint| angle::difference(posture.q[*joint], self.last.q[*joint]).abs() < JUMP)
    }

    /// The last joint values of the legs, and the planned ones of all other joints.
    fn held(&self, plan: &Instant) -> Vec<f64> {
        let mut q = plan.posture.q.clone();
        for joint in self.walker.biped.feet.iter().flat_map(|foot| &foot.joints) {
            q[*joint] = self.last.q[*joint];
        }
        q
    }

    /// The posture with the soles and the torso at these poses. Legs that share an actuator turn the torso until they agree.
    fn stand(&self, soles: &[Pose; 2], torso: &Pose, last: &Posture) -> Result<Posture> {
        let legs = &self.walker.legs;
        let turned = |heading: f64| {
            let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), heading);
            legs.stand(soles, &Pose::from_parts(torso.translation, turn * torso.rotation), last)
        };
        let mut posture = turned(0.0)?;
        if !legs.share_an_actuator() {
            return Ok(posture);
        }
        let (mut from, mut heading) = ((0.0, legs.disagreement(&posture)), FIRST_TURN);
        for _ in 0..HEADINGS {
            posture = turned(heading)?;
            let off = legs.disagreement(&posture);
            let slope = (off - from.1) / (heading - from.0);
            if slope == 0.0 || off.abs() < AGREED {
                break;
            }
            from = (heading, off);
            heading = angle::wrap(heading - off / slope);
        }
        legs.agree(&mut posture);
        Ok(posture)
    }

    fn targets(&mut self, mut posture: Posture, time: f64) -> JointTargets {
        for (value, joint) in posture.q.iter_mut().zip(&self.walker.biped.joints) {
            *value = value.clamp(joint.limits.0, joint.limits.1);
        }
        let velocities = match &self.before {
            Some((last, q)) if time > *last => {
                posture.q.iter().zip(q).map(|(value, before)| (value - before) / (time - last)).collect()
            }
            _ => vec![0.0; posture.q.len()],
        };
        self.before = Some((time, posture.q.clone()));
        JointTargets { positions: posture.q, velocities }
    }
}

/// The heading of the x axis \[rad\].
fn yaw(orientation: &UnitQuaternion<f64>) -> f64 {
    let ahead = orientation * Vector3::x();
    ahead.y.atan2(ahead.x)
}

/// Half of the width of the left sole \[m\].
fn half_width(biped: &crate::gait::Biped) -> f64 {
    let [low, high] = super::distribution::extent(biped, 0);
    0.5 * (high.y - low.y)
}

/// The mean of the corners.
fn centroid(polygon: &crate::gait::Polygon) -> Point2<f64> {
    let corners = polygon.corners();
    let sum: Vector2<f64> = corners.iter().map(|corner| corner.coords).sum();
    Point2::from(sum / corners.len().max(1) as f64)
}
