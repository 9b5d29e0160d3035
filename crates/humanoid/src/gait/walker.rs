//! Walking robots: NAO, RH0 and TEO of [`groebot_robot::robots`], or any other biped. Main type: [`Walker`].

use std::borrow::Cow;

use nalgebra::{Point2, UnitQuaternion, Vector2};

use super::biped::{Biped, Foot, above};
use super::defaults::GaitDefaults;
use super::footprint::Side;
use super::legs::{LegSolver, Legs};
use super::limbs::{leg_length, sagittal};
use super::one_step::{Laws, OneStep};
use super::plan::TICK;
use super::polygon::Polygon;
use super::request::Gait;
use super::zmp::GRAVITY;
use crate::{Error, ErrorKind, Result};
use groebot_robot::kinematics::Target;
use groebot_robot::model::Robot;
use groebot_robot::spatial::Pose;

/// A walking robot with its gaits by name, the default first, each with its default parameters.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Walker {
    /// The robot.
    pub biped: Biped,
    /// The solvers of its legs.
    pub legs: Legs,
    /// Its gaits.
    pub gaits: Vec<(&'static str, GaitDefaults)>,
}

/// Heights of the hip that are tried in order, as fractions of the leg's length above the ankle.
const HEIGHTS: [f64; 9] = [0.965, 0.96, 0.955, 0.94, 0.925, 0.91, 0.89, 0.87, 0.84];
/// The height of the hip before the trunk is lowered, as such a fraction.
const UPRIGHT: f64 = 0.985;
/// The least distance of a joint that does not walk from its limits \[rad or m\].
const ASIDE: f64 = 1e-3;
/// Heights of the hip by preview control that are tried in order, as such fractions. Higher ones are for ankles with
/// little pitch, as those of TEO.
const BENT: [f64; 7] = [0.94, 0.925, 0.955, 0.965, 0.91, 0.89, 0.87];
/// The length of a step by preview control, as a fraction of the leg's length, its duration in units of
/// sqrt(leg length / gravity), and the fraction of it on both feet. TALOS then walks 0.2 m/s. With 25 % of steps of
/// 2.8 units on both feet, Unitree G1 fell in MuJoCo on a level floor.
const PACE: f64 = 0.3;
const PENDULUMS: f64 = 3.2;
const BOTH_FEET: f64 = 0.4;
/// The least torque of the motor that rolls the hip, as a multiple of [`hip_strength`]'s unit, with which steps by
/// preview control have their full length and turn. Weaker robots take shorter steps, and turn less in a step, in
/// proportion. With full steps Booster T1 (0.86) and the Berkeley Humanoid (0.79) fell in MuJoCo on a level floor.
const STRONG: f64 = 1.5;
/// The greatest distance of a foot from the middle by preview control, as a fraction of the leg's length. At zero it is
/// 0.4 in the Berkeley Humanoid, whose centre of mass does not get over such a foot: its legs have two thirds of the mass.
const WIDE: f64 = 0.26;
/// The duration of the rest before and after a walk by preview control in that unit: the motion that begins before the
/// first step, and fades after the last one, by `exp(-t)`, is then below 0.1 %.
const REST: f64 = 7.0;
/// The duration of a step by one step goal in units of sqrt(leg length / gravity), a pendulum's unit of time.
const PERIOD: f64 = 19.0;

impl Walker {
    /// Makes a walker of `robot` with the soles of `biped` and a solver for each leg. A solver moves the sole's link to
    /// a pose in the torso frame. The parameters of the gaits follow from the lengths of the legs and the size of the
    /// soles. Joints that do not walk are at zero, or at the nearest limit.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when no posture with bent knees within the limits has the soles below the hips.
    /// [`ErrorKind::Unsupported`] for legs that do not have five or six joints.
    pub fn new(robot: &Robot, biped: Biped, solvers: [LegSolver; 2]) -> Result<Self> {
        if let Some(foot) = biped.feet.iter().find(|foot| !matches!(foot.joints.len(), 5 | 6)) {
            let text = format!(
                "{}: a leg has {} joints between the torso and its sole; legs with five or six joints are supported; other links are given by --left and --right",
                biped.name,
                foot.joints.len()
            );
            return Err(Error::new(ErrorKind::Unsupported, text));
        }
        let mut crouch = at_rest(robot, &biped);
        for (foot, solver) in biped.feet.iter().zip(&solvers) {
            let answer = crouched(&biped, foot, solver)?;
            foot.joints.iter().zip(answer).for_each(|(joint, value)| crouch[*joint] = value);
        }
        let legs = Legs::new(&biped, solvers, crouch)?.starting_from_crouch(&biped)?;
        let gaits = vec![("osg", one_step(&biped)), ("preview", preview_defaults(&biped))];
        Ok(Walker { biped, legs, gaits })
    }

    /// The default parameters of its gait `name`.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a gait that it does not have, with the names of its gaits.
    pub fn gait(&self, name: &str) -> Result<&GaitDefaults> {
        let found = self.gaits.iter().find(|(own, _)| *own == name);
        found.map(|(_, defaults)| defaults).ok_or_else(|| {
            let names = self.gaits.iter().map(|(name, _)| format!("`{name}`")).collect::<Vec<_>>().join(", ");
            Error::new(ErrorKind::BadValue, format!("this robot does not have the gait `{name}`; give one of {names}"))
        })
    }
}

/// All joints at zero, or at the nearest limit; joints that follow others take the value of their leader.
fn at_rest(robot: &Robot, biped: &Biped) -> Vec<f64> {
    let mut q: Vec<f64> = biped.joints.iter().map(|range| rest(range.limits)).collect();
    robot.follow(&mut q);
    q
}

/// The value of a joint with these limits that does not walk: zero, or the nearest limit.
pub(super) fn rest(limits: (f64, f64)) -> f64 {
    match limits {
        (low, high) if low < 0.0 && high > 0.0 => 0.0,
        (low, high) if high - low > 2.0 * ASIDE => 0f64.clamp(low + ASIDE, high - ASIDE),
        (low, high) => (low + high) / 2.0,
    }
}

/// The first posture of a leg within its limits with the sole below the hip and a bent knee.
fn crouched(biped: &Biped, foot: &Foot, solver: &LegSolver) -> Result<Vec<f64>> {
    let (_, torso_from_link) = biped.model.link(foot.link);
    let sole_from_link = foot.torso_from_sole.inv_mul(&torso_from_link);
    let within = |answer: &Vec<f64>| {
        let ranges = foot.joints.iter().map(|joint| biped.joints[*joint].limits);
        answer.iter().zip(ranges).all(|(value, (low, high))| low <= *value && *value <= high)
    };
    let size = |answer: &Vec<f64>| answer.iter().map(|value| value.abs()).fold(0.0, f64::max);
    let (hip, (length, ankle)) = (biped.hips[0].z, leg(biped));
    for share in HEIGHTS.into_iter().rev() {
        let mut torso_from_sole = Pose::from_parts(foot.torso_from_sole.translation, UnitQuaternion::identity());
        torso_from_sole.translation.z = hip - share * length - ankle;
        let mut found = Vec::new();
        solver.solve(&Target::Pose(torso_from_sole * sole_from_link), &[], &mut found)?;
        let best = found.into_iter().map(|answer| answer.q).filter(within).min_by(|a, b| size(a).total_cmp(&size(b)));
        if let Some(answer) = best {
            return Ok(answer);
        }
    }
    let text = format!("{}: no posture within the limits of a leg brings its sole below the hip", biped.name);
    Err(Error::new(ErrorKind::BadValue, text))
}

/// The length of the left leg, and the height of the end of this length above the sole \[m\].
fn leg(biped: &Biped) -> (f64, f64) {
    let foot = &biped.feet[0];
    let [_, _, ankle] = sagittal(&biped.model, &foot.joints);
    let axis = biped.model.joints()[ankle].screw.axis();
    let height = axis.map_or(0.0, |axis| above(&foot.torso_from_sole, &axis.point().coords));
    (leg_length(&biped.model, &foot.joints), height)
}

/// The distance of the sole's middle forward of its frame, and the distance from there to the border \[m\].
fn sole(biped: &Biped) -> (f64, f64) {
    let corners = &biped.feet[Side::Left as usize].corners;
    let ends = corners.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), p| (low.min(p.x), high.max(p.x)));
    let ahead = (ends.0 + ends.1) / 2.0;
    (ahead, Polygon::hull(corners).signed_distance(&Point2::from(Vector2::new(ahead, 0.0))).max(0.0))
}

/// One step goal by the generic laws of RH0 3.3: all parameters are fractions of the leg's length and of the sole's
/// half width.
fn one_step(biped: &Biped) -> GaitDefaults {
    let ((length, ankle), (ahead, room)) = (leg(biped), sole(biped));
    let height = |share: f64| share * length + ankle;
    GaitDefaults {
        gait: Gait::OneStep(OneStep { laws: Laws::Generic, dip: 0.006 * length, pitch: 0.0, upright: None }),
        length: 0.16 * length,
        lift: 0.07 * length,
        half_width: None,
        amplitude: biped.half_width() - 0.17 * room,
        ahead,
        hip_heights: Cow::Owned(HEIGHTS.map(height).to_vec()),
        upright_hip: height(UPRIGHT),
        period: PERIOD * (length / GRAVITY).sqrt(),
        double_support: 0.66,
        rest: 0.0,
        margin: 0.25 * room,
        speed_share: 0.9,
        most_turn: 0.15,
        tick: TICK,
    }
}

/// Preview control: steps at a pace of pendulums of the legs' length, so that robots of all sizes move alike.
pub(crate) fn preview_defaults(biped: &Biped) -> GaitDefaults {
    let ((length, ankle), (ahead, room)) = (leg(biped), sole(biped));
    let ease = (hip_strength(biped) / STRONG).min(1.0);
    let half_width = biped.half_width().min(WIDE * length);
    GaitDefaults {
        gait: Gait::Preview,
        length: PACE * length * ease,
        lift: 0.05 * length,
        half_width: (half_width < biped.half_width()).then_some(half_width),
        amplitude: half_width,
        hip_heights: Cow::Owned(BENT.map(|share| share * length + ankle).to_vec()),
        period: PENDULUMS * (length / GRAVITY).sqrt(),
        double_support: BOTH_FEET,
        rest: REST * (length / GRAVITY).sqrt(),
        ahead,
        margin: 0.25 * room,
        most_turn: 0.25 * ease,
        ..one_step(biped)
    }
}

/// The greatest torque of the motor that rolls the left hip, in units of the torque that holds the robot at rest on the
/// left foot: the weight of the robot times the distance of the foot from the middle. Infinite where the description has
/// no effort.
fn hip_strength(biped: &Biped) -> f64 {
    let foot = &biped.feet[Side::Left as usize];
    let axis = |joint: usize| biped.model.joints()[joint].screw.axis();
    let forward = |joint: usize| axis(joint).map_or(0.0, |axis| axis.direction().x.abs());
    let hip = foot.joints.iter().copied().take(3).max_by(|a, b| forward(*a).total_cmp(&forward(*b)));
    let effort = hip.and_then(|joint| biped.joints[joint].effort).unwrap_or(f64::INFINITY);
    effort / (biped.model.mass() * GRAVITY * biped.half_width())
}
