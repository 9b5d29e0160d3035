//! NAO's legs, driven by the derived solver: the closed form of each leg, and the torso's heading at which both legs ask the same of the
//! one motor that turns HipYawPitch of both. Main type: [`NaoLegs`].

use nalgebra::{Point3, UnitQuaternion, Vector3};

use super::footprint::Side;
use super::humanoid::Humanoid;
use super::legs::{Legs, Posture};
use crate::robots::Whole;
use crate::spatial::{Pose, angle};
use crate::{Error, ErrorKind, Result};

/// The derived solver of the left leg, printed as Rust: bit for bit what `Program::solve` answers.
#[rustfmt::skip]
#[path = "../../derivations/nao_left_leg/5_solver.rs"]
mod left_leg;
/// The derived solver of the right leg.
#[rustfmt::skip]
#[path = "../../derivations/nao_right_leg/5_solver.rs"]
mod right_leg;

/// How far the legs may disagree on the shared motor \[rad\]: what is left moves a foot by less than the solver's own rounding.
const AGREED: f64 = 1e-13;
/// What rounding may leave of the disagreement near a stretched leg \[rad\].
const ROUNDED: f64 = 1e-10;
/// The most steps of the search for the torso's heading; a secant needs three to five.
const MOST_STEPS: usize = 24;
/// How far the heading is moved for the first secant \[rad\].
const ASIDE: f64 = 1e-4;

/// The joints of a leg in the order of its chain.
const LEG: [&str; 6] = ["HipYawPitch", "HipRoll", "HipPitch", "KneePitch", "AnklePitch", "AnkleRoll"];
/// Bent knees, soles below the hips \[rad\].
const CROUCH: [f64; 6] = [0.0, 0.0, -0.5, 1.0, -0.5, 0.0];
/// Arms that hang near the trunk, NAO 6.8: the values of the left arm \[rad\]; the right one mirrors all but the first.
const ARM: [(&str, f64); 5] =
    [("ShoulderPitch", 1.55), ("ShoulderRoll", 0.15), ("ElbowYaw", -1.2), ("ElbowRoll", -0.5), ("WristYaw", 0.0)];

type Leg = [f64; 6];

/// The solver of NAO's legs.
#[derive(Clone, Debug)]
pub struct NaoLegs {
    legs: [[usize; 6]; 2],
    crouch: Vec<f64>,
}

impl NaoLegs {
    /// The solver of the legs of `whole`, which is NAO.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] when a joint of NAO is not there.
    pub fn new(whole: &Whole) -> Result<Self> {
        let joint = |name: String| {
            let unknown = || Error::new(ErrorKind::UnknownName, format!("{} has no joint `{name}`", whole.name));
            whole.joint(&name).ok_or_else(unknown)
        };
        let mut crouch = vec![0.0; whole.links.len()];
        let mut legs = [[0; 6]; 2];
        for side in [Side::Left, Side::Right] {
            let prefix = if side == Side::Left { "L" } else { "R" };
            for (place, name) in LEG.into_iter().enumerate() {
                legs[side as usize][place] = joint(format!("{prefix}{name}"))?;
                crouch[legs[side as usize][place]] = CROUCH[place];
            }
            for (name, value) in ARM {
                let mirrored = if name == "ShoulderPitch" { 1.0 } else { side.sign() };
                crouch[joint(format!("{prefix}{name}"))?] = mirrored * value;
            }
        }
        Ok(NaoLegs { legs, crouch })
    }

    /// The answers of both legs nearest to `last` when the torso is at `world_from_torso`.
    fn both(&self, world_from_torso: &Pose, world_from_soles: &[Pose; 2], last: &Posture) -> Result<[Leg; 2]> {
        let mut legs = [[0.0; 6]; 2];
        for side in [Side::Left, Side::Right] {
            let near = self.legs[side as usize].map(|joint| last.q[joint]);
            let target = target(&world_from_torso.inv_mul(&world_from_soles[side as usize]));
            legs[side as usize] = nearest(side, &target, &near).ok_or_else(|| out_of_reach(side, &target))?;
        }
        Ok(legs)
    }
}

impl Legs for NaoLegs {
    fn stand(&self, world_from_soles: &[Pose; 2], torso: &Point3<f64>, last: &Posture) -> Result<Posture> {
        let at =
            |yaw: f64| Pose::from_parts(torso.coords.into(), UnitQuaternion::from_axis_angle(&Vector3::z_axis(), yaw));
        let solve = |yaw: f64| {
            let legs = self.both(&at(yaw), world_from_soles, last)?;
            Ok((legs, angle::difference(legs[0][0], legs[1][0])))
        };
        let start = last.world_from_torso.rotation.scaled_axis().z;
        let (yaw, mut legs) = shared_motor(start, solve)?;
        legs[1][0] = legs[0][0];
        let mut q = last.q.clone();
        for (places, values) in self.legs.iter().zip(&legs) {
            for (place, value) in places.iter().zip(values) {
                q[*place] = *value;
            }
        }
        Ok(Posture { world_from_torso: at(yaw), q })
    }

    fn crouch(&self) -> Posture {
        Posture { world_from_torso: Pose::identity(), q: self.crouch.clone() }
    }
}

/// The heading of the torso, from `start` on, at which the legs agree on the shared motor, by secants.
fn shared_motor(start: f64, solve: impl Fn(f64) -> Result<([Leg; 2], f64)>) -> Result<(f64, [Leg; 2])> {
    let (mut yaw, (mut legs, mut miss)) = (start, solve(start)?);
    let (mut other, mut other_miss) = (start + ASIDE, f64::NAN);
    for _ in 0..MOST_STEPS {
        if miss.abs() <= AGREED {
            break;
        }
        if other_miss.is_nan() {
            other_miss = solve(other)?.1;
        }
        let slope = (miss - other_miss) / (yaw - other);
        let next = yaw - miss / slope;
        if !next.is_finite() || next == yaw {
            break;
        }
        (other, other_miss, yaw) = (yaw, miss, next);
        (legs, miss) = solve(next)?;
    }
    if miss.abs() <= ROUNDED {
        return Ok((yaw, legs));
    }
    let text =
        "no heading of the torso lets both legs share the motor of HipYawPitch; turn the feet less against one another";
    Err(Error::new(ErrorKind::BadValue, text))
}

/// The target of a leg's solver: position, then the rotation by rows.
fn target(torso_from_sole: &Pose) -> [f64; 12] {
    let (p, r) = (torso_from_sole.translation.vector, torso_from_sole.rotation.to_rotation_matrix());
    let r = r.matrix();
    [p.x, p.y, p.z, r[(0, 0)], r[(0, 1)], r[(0, 2)], r[(1, 0)], r[(1, 1)], r[(1, 2)], r[(2, 0)], r[(2, 1)], r[(2, 2)]]
}

/// The solution of a leg that is nearest to `near`; `None` when the target is out of reach.
fn nearest(side: Side, target: &[f64; 12], near: &Leg) -> Option<Leg> {
    match side {
        Side::Left => {
            let mut out = [left_leg::Solution::EMPTY; left_leg::CAPACITY];
            let count = left_leg::solve(target, &mut out).ok()?;
            closest(out[..count].iter().map(|solution| &solution.q), near)
        }
        Side::Right => {
            let mut out = [right_leg::Solution::EMPTY; right_leg::CAPACITY];
            let count = right_leg::solve(target, &mut out).ok()?;
            closest(out[..count].iter().map(|solution| &solution.q), near)
        }
    }
}

fn closest<'q>(answers: impl Iterator<Item = &'q Leg>, near: &Leg) -> Option<Leg> {
    let distance = |q: &Leg| q.iter().zip(near).map(|(a, b)| angle::difference(*a, *b).abs()).fold(0.0, f64::max);
    answers.min_by(|a, b| distance(a).total_cmp(&distance(b))).copied()
}

fn out_of_reach(side: Side, target: &[f64; 12]) -> Error {
    let [x, y, z, ..] = target;
    let text = format!(
        "the {} sole is out of reach at ({x:.3}, {y:.3}, {z:.3}) m from the torso; lower the hip or shorten the steps",
        side.name()
    );
    Error::new(ErrorKind::BadValue, text)
}

/// NAO V5 on the measured or the seed's soles, and the solver of its legs.
///
/// # Errors
/// None with the crate's own data; those of [`Humanoid::new`] and [`NaoLegs::new`] otherwise.
pub fn nao(outline: super::Outline) -> Result<(Humanoid, NaoLegs)> {
    let whole = crate::robots::nao_v5();
    Ok((Humanoid::new(&whole, outline)?, NaoLegs::new(&whole)?))
}
