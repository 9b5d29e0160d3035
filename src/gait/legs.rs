//! The legs of a humanoid, driven by the derived solvers of both. Main type: [`Legs`].
//!
//! The solvers are those of `derivations/`, printed as Rust: bit for bit what `Program::solve` answers.

use nalgebra::Vector3;

use super::footprint::Side;
use crate::robots::{Whole, WholeLimb};
use crate::spatial::{Pose, angle};
use crate::{Error, ErrorKind, Result};

#[rustfmt::skip]
#[path = "../../derivations/nao_left_leg/5_solver.rs"]
mod nao_left_leg;
#[rustfmt::skip]
#[path = "../../derivations/nao_right_leg/5_solver.rs"]
mod nao_right_leg;
#[rustfmt::skip]
#[path = "../../derivations/rh0_left_leg/5_solver.rs"]
mod rh0_left_leg;
#[rustfmt::skip]
#[path = "../../derivations/rh0_right_leg/5_solver.rs"]
mod rh0_right_leg;
#[rustfmt::skip]
#[path = "../../derivations/teo_leg/5_solver.rs"]
mod teo_leg;

/// The joints of a leg, in the order of its chain \[rad\].
pub type LegValues = [f64; 6];

/// Calls back with every solution of a target: position, then the rotation by rows. `None` when the target is no pose.
type Solver = fn(&[f64; 12], &mut dyn FnMut(&LegValues)) -> Option<()>;

macro_rules! printed {
    ($solver:ident) => {
        |target, answer| {
            let mut out = [$solver::Solution::EMPTY; $solver::CAPACITY];
            let count = $solver::solve(target, &mut out).ok()?;
            out[..count].iter().for_each(|solution| answer(&solution.q));
            Some(())
        }
    };
}

/// The printed solver of the chain `name`.
fn solver(name: &str) -> Option<Solver> {
    Some(match name {
        "nao_left_leg" => printed!(nao_left_leg),
        "nao_right_leg" => printed!(nao_right_leg),
        "rh0_left_leg" => printed!(rh0_left_leg),
        "rh0_right_leg" => printed!(rh0_right_leg),
        "teo_leg" => printed!(teo_leg),
        _ => return None,
    })
}

/// The value of each joint of `whole` \[rad\]: those that `values` names for a side, without the `L` or `R` of their names, zero elsewhere.
///
/// # Errors
/// [`ErrorKind::UnknownName`] when a named joint is missing on one side.
pub(super) fn posture<V>(whole: &Whole, values: impl Fn(Side) -> V) -> Result<Vec<f64>>
where
    V: IntoIterator<Item = (&'static str, f64)>,
{
    let mut posture = vec![0.0; whole.links.len()];
    for (side, prefix) in [(Side::Left, 'L'), (Side::Right, 'R')] {
        for (name, value) in values(side) {
            posture[whole.joint(&format!("{prefix}{name}"))?] = value;
        }
    }
    Ok(posture)
}

/// All solutions of the printed solver of the chain `name` for the pose of its tip in its root.
///
/// # Errors
/// [`ErrorKind::UnknownName`] when no solver of that name is built in, [`ErrorKind::BadValue`] when the pose is not finite.
pub(super) fn answers(name: &str, root_from_tip: &Pose) -> Result<Vec<LegValues>> {
    let missing = || Error::new(ErrorKind::UnknownName, format!("no derived solver of `{name}` is built in"));
    let mut found = Vec::new();
    let solved = solver(name).ok_or_else(missing)?(&numbers(root_from_tip, 1.0), &mut |q| found.push(*q));
    solved.ok_or_else(|| Error::new(ErrorKind::BadValue, "the pose is not finite"))?;
    Ok(found)
}

/// What a solver is asked for a pose: position, then the rotation by rows; of its mirror image in y = 0 when `mirror` is -1.
fn numbers(pose: &Pose, mirror: f64) -> [f64; 12] {
    let (p, r) = (pose.translation.vector, pose.rotation.to_rotation_matrix().into_inner());
    let mirror = Vector3::new(1.0, mirror, 1.0);
    std::array::from_fn(|place| match place.checked_sub(3) {
        None => p[place] * mirror[place],
        Some(entry) => r[(entry / 3, entry % 3)] * mirror[entry / 3] * mirror[entry % 3],
    })
}

/// A knee that is bent less than this against its sense counts as straight \[rad\].
const STRAIGHT: f64 = 1e-6;

/// A configuration of a whole humanoid.
#[derive(Clone, Debug, PartialEq)]
pub struct Posture {
    /// The pose of the torso in the world.
    pub world_from_torso: Pose,
    /// The values of all joints \[rad\].
    pub q: Vec<f64>,
}

/// The solver of both legs of a humanoid.
#[derive(Clone, Debug)]
pub struct Legs {
    legs: [Leg; 2],
    crouch: Vec<f64>,
    /// The joints, left and right, that one motor turns.
    shared: Option<[usize; 2]>,
    /// Joints of the arms, each with the joint of a leg whose value it takes.
    coordinated: Vec<(usize, usize)>,
}

/// The solver of one leg.
#[derive(Clone, Debug)]
struct Leg {
    side: Side,
    solve: Solver,
    limb: WholeLimb,
    sole_from_base: Pose,
    /// In what sense each joint turns in the solver's leg, which is a mirror image of this one where the limb is mirrored.
    senses: LegValues,
    /// The knee's place in the leg, and the sense in which it bends.
    knee: (usize, f64),
}

impl Legs {
    /// The solver of the legs of `whole`, which carry its soles. `crouch` is a posture with bent knees, one value a joint \[rad\], and
    /// `knee` a part of the names of the knees' joints.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] when there is no derived solver of a leg's chain, or no knee; [`ErrorKind::BadValue`] when `crouch` has
    /// not a value for each joint.
    pub fn new(whole: &Whole, crouch: Vec<f64>, knee: &str) -> Result<Self> {
        if crouch.len() != whole.links.len() {
            let text = format!("{} values are given; {} has {} joints", crouch.len(), whole.name, whole.links.len());
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let leg = |side: Side| Leg::new(whole, side, &crouch, knee);
        let [left, right] = [leg(Side::Left)?, leg(Side::Right)?];
        let both = |pair: &&(usize, usize)| left.has(pair.0) && right.has(pair.1);
        let shared = whole.shared.iter().find(both).map(|pair| [pair.0, pair.1]);
        Ok(Legs { legs: [left, right], crouch, shared, coordinated: whole.coordinated.clone() })
    }

    /// The posture with the soles at the poses `world_from_soles`, left and right, and the torso at `world_from_torso`. Of several
    /// answers it is the nearest to `last` whose knees bend as they do in the crouch; the limits of the joints are not looked at. Where
    /// the legs share a motor, they may disagree on it: [`Legs::disagreement`]. Joints of other limbs stay as in `last`, but for those
    /// that are coordinated with the legs.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when a foot is out of reach.
    pub fn stand(&self, world_from_soles: &[Pose; 2], world_from_torso: &Pose, last: &Posture) -> Result<Posture> {
        let mut q = last.q.clone();
        for (leg, world_from_sole) in self.legs.iter().zip(world_from_soles) {
            leg.stand(&world_from_torso.inv_mul(world_from_sole), &last.q, &mut q)?;
        }
        for (joint, leader) in &self.coordinated {
            q[*joint] = q[*leader];
        }
        Ok(Posture { world_from_torso: *world_from_torso, q })
    }

    /// Whether one motor turns a joint of both legs, so that the torso's heading is not free.
    pub fn share_a_motor(&self) -> bool {
        self.shared.is_some()
    }

    /// How far the legs disagree on the motor that they share \[rad\]; 0 when they share none.
    pub fn disagreement(&self, posture: &Posture) -> f64 {
        self.shared.map_or(0.0, |[left, right]| angle::difference(posture.q[left], posture.q[right]))
    }

    /// Gives both legs the left one's value of the motor that they share.
    pub fn agree(&self, posture: &mut Posture) {
        if let Some([left, right]) = self.shared {
            posture.q[right] = posture.q[left];
        }
    }

    /// A posture with bent knees, from which [`Legs::stand`] finds the right answers; the torso is at the origin.
    pub fn crouch(&self) -> Posture {
        Posture { world_from_torso: Pose::identity(), q: self.crouch.clone() }
    }

    /// All solutions of the leg of `side` for a sole at `torso_from_sole`, in the order of the printed solver: the joints of its chain
    /// \[rad\].
    pub fn solutions(&self, side: Side, torso_from_sole: &Pose) -> Vec<LegValues> {
        let leg = &self.legs[side as usize];
        let mut found = Vec::new();
        (leg.solve)(&leg.target(torso_from_sole), &mut |q| found.push(leg.own(q)));
        found
    }
}

impl Leg {
    fn new(whole: &Whole, side: Side, crouch: &[f64], knee: &str) -> Result<Self> {
        let sole = &whole.soles[side as usize];
        let unknown = |text: String| Error::new(ErrorKind::UnknownName, text);
        let limb = whole.limbs.iter().find(|limb| limb.joints.contains(&sole.link));
        let limb = limb.ok_or_else(|| unknown(format!("{}: no limb carries the {} sole", whole.name, side.name())))?;
        let no_solver = || unknown(format!("no derived solver of `{}` is built in", limb.chain));
        let solve = solver(&limb.chain).filter(|_| limb.joints.len() == 6).ok_or_else(no_solver)?;
        let no_knee = || unknown(format!("{}: no joint has `{knee}` in its name", limb.chain));
        let place =
            limb.joints.iter().position(|joint| whole.links[*joint].joint.contains(knee)).ok_or_else(no_knee)?;
        Ok(Leg {
            side,
            solve,
            sole_from_base: sole.base_from_sole.inverse(),
            senses: std::array::from_fn(|joint| limb.sense(&whole.links[limb.joints[joint]].screw)),
            knee: (place, crouch[limb.joints[place]].signum()),
            limb: limb.clone(),
        })
    }

    fn has(&self, joint: usize) -> bool {
        self.limb.joints.contains(&joint)
    }

    /// Writes into `q` the answer for a sole at `torso_from_sole` that is nearest to `last`.
    fn stand(&self, torso_from_sole: &Pose, last: &[f64], q: &mut [f64]) -> Result<()> {
        let mut best: Option<((bool, f64), LegValues)> = None;
        let solved = (self.solve)(&self.target(torso_from_sole), &mut |answer| {
            let answer = self.own(answer);
            let away = |(joint, value): (&usize, &f64)| angle::difference(*value, last[*joint]).abs();
            let distance = self.limb.joints.iter().zip(&answer).map(away).fold(0.0, f64::max);
            let rank = (answer[self.knee.0] * self.knee.1 < -STRAIGHT, distance);
            if best.as_ref().is_none_or(|(other, _)| rank < *other) {
                best = Some((rank, answer));
            }
        });
        let (_, answer) = solved.and(best).ok_or_else(|| self.out_of_reach(torso_from_sole))?;
        for (joint, value) in self.limb.joints.iter().zip(answer) {
            q[*joint] = value;
        }
        Ok(())
    }

    /// What the solver is asked for a sole at `torso_from_sole`.
    fn target(&self, torso_from_sole: &Pose) -> [f64; 12] {
        let root = self.limb.base_from_root;
        let pose = if self.limb.reversed {
            // The chain's root is fixed to the sole and its tip to the torso.
            (torso_from_sole * self.sole_from_base * root).inv_mul(&self.limb.base_from_tip)
        } else {
            root.inv_mul(&(torso_from_sole * self.sole_from_base * self.limb.base_from_tip))
        };
        numbers(&pose, if self.limb.mirrored { -1.0 } else { 1.0 })
    }

    /// The values of this leg's joints for an answer of the solver.
    fn own(&self, answer: &LegValues) -> LegValues {
        std::array::from_fn(|joint| self.senses[joint] * answer[joint])
    }

    fn out_of_reach(&self, torso_from_sole: &Pose) -> Error {
        let at = torso_from_sole.translation.vector;
        let text = format!(
            "the {} sole is out of reach at ({:.3}, {:.3}, {:.3}) m from the torso; lower the hip (--hip-height) or shorten the steps (--length)",
            self.side.name(),
            at.x,
            at.y,
            at.z
        );
        Error::new(ErrorKind::BadValue, text)
    }
}
