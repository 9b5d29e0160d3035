//! The legs of a biped, driven by an inverse-kinematics solver each. Main type: [`Legs`].

use std::sync::Arc;

use super::biped::Biped;
use super::footprint::Side;
use crate::{Error, ErrorKind, Result};
use groebot_robot::kinematics::{InverseKinematics, Target};
use groebot_robot::spatial::{Pose, angle};

/// A knee that is bent less than this against its sense is straight \[rad\]: there it is known to the root of what lengths are rounded by.
const STRAIGHT: f64 = 1e-6;

/// A configuration of a whole biped.
#[derive(Clone, Debug, PartialEq)]
pub struct Posture {
    /// The pose of the torso in the world.
    pub world_from_torso: Pose,
    /// The values of all joints \[rad\].
    pub q: Vec<f64>,
}

/// The solver of a leg: it brings the sole's link to a pose in the torso frame, with joint values in order from the torso to the sole.
pub type LegSolver = Arc<dyn InverseKinematics>;

/// The solver of both legs of a biped.
#[derive(Clone, Debug)]
pub struct Legs {
    legs: [Leg; 2],
    crouch: Vec<f64>,
    /// The joints, left and right, that one actuator turns.
    shared: Option<(usize, usize)>,
    /// Joints of the arms, each with the joint of a leg whose value it takes.
    coordinated: Vec<(usize, usize)>,
}

/// The solver of one leg.
#[derive(Clone, Debug)]
struct Leg {
    side: Side,
    solver: LegSolver,
    /// The joints from the torso to the sole, as places in a configuration.
    joints: Vec<usize>,
    /// The frame of the sole's link in the frame of the sole.
    sole_from_link: Pose,
    /// The knee's place in the leg, and the sense in which it bends.
    knee: (usize, f64),
}

impl Legs {
    /// The legs of `biped` with a solver each, left and right. `crouch` is a posture with bent knees, one value a joint \[rad\]: the joint of a leg
    /// that is bent most is its knee.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when `crouch` has not a value for each joint.
    pub fn new(biped: &Biped, solvers: [LegSolver; 2], crouch: Vec<f64>) -> Result<Self> {
        if crouch.len() != biped.joints.len() {
            let text = format!("{} values are given; {} has {} joints", crouch.len(), biped.name, biped.joints.len());
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let [left, right] = solvers;
        let leg = |side: Side, solver| Leg::new(biped, side, solver, &crouch);
        let legs = [leg(Side::Left, left), leg(Side::Right, right)];
        Ok(Legs { legs, crouch, shared: biped.shared.first().copied(), coordinated: Vec::new() })
    }

    /// The same legs, with joints of other limbs that take the value of a joint of a leg: pairs of the follower and the leader.
    #[must_use]
    pub fn with_coordinated(self, coordinated: Vec<(usize, usize)>) -> Self {
        Legs { coordinated, ..self }
    }

    /// The posture with the soles at the poses `world_from_soles`, left and right, and the torso at `world_from_torso`. Of several
    /// answers it is the nearest to `last` whose knees bend as they do in the crouch; the limits of the joints are not looked at. Where
    /// the legs share an actuator, they may disagree on it: [`Legs::disagreement`]. Joints of other limbs stay as in `last`, but for those
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

    /// Whether one actuator turns a joint of both legs, so that the torso's heading is not free.
    pub fn share_an_actuator(&self) -> bool {
        self.shared.is_some()
    }

    /// How far the legs disagree on the actuator that they share \[rad\]; 0 when they share none.
    pub fn disagreement(&self, posture: &Posture) -> f64 {
        self.shared.map_or(0.0, |(left, right)| angle::difference(posture.q[left], posture.q[right]))
    }

    /// Gives both legs the left one's value of the actuator that they share.
    pub fn agree(&self, posture: &mut Posture) {
        if let Some((left, right)) = self.shared {
            posture.q[right] = posture.q[left];
        }
    }

    /// A posture with bent knees, from which [`Legs::stand`] finds the right answers; the torso is at the origin.
    pub fn crouch(&self) -> Posture {
        Posture { world_from_torso: Pose::identity(), q: self.crouch.clone() }
    }

    /// All solutions of the leg of `side` for a sole at `torso_from_sole`, in the order of its solver: the joints from the torso to the sole
    /// \[rad\]; none where it is out of reach.
    pub fn solutions(&self, side: Side, torso_from_sole: &Pose) -> Vec<Vec<f64>> {
        self.legs[side as usize].answers(torso_from_sole).unwrap_or_default()
    }
}

impl Leg {
    fn new(biped: &Biped, side: Side, solver: LegSolver, crouch: &[f64]) -> Self {
        let foot = &biped.feet[side as usize];
        let (_, torso_from_link) = biped.model.link(foot.link);
        let bent = |place: &usize| crouch[foot.joints[*place]].abs();
        let knee = (0..foot.joints.len()).max_by(|a, b| bent(a).total_cmp(&bent(b))).unwrap_or_default();
        Leg {
            side,
            solver,
            joints: foot.joints.clone(),
            sole_from_link: foot.torso_from_sole.inv_mul(&torso_from_link),
            knee: (knee, crouch[foot.joints[knee]].signum()),
        }
    }

    /// The answers for a sole at `torso_from_sole`.
    fn answers(&self, torso_from_sole: &Pose) -> Result<Vec<Vec<f64>>> {
        let mut found = Vec::new();
        self.solver.solve(&Target::Pose(torso_from_sole * self.sole_from_link), &[], &mut found)?;
        Ok(found.into_iter().map(|answer| answer.q).collect())
    }

    /// Writes into `q` the answer for a sole at `torso_from_sole` that is nearest to `last`.
    fn stand(&self, torso_from_sole: &Pose, last: &[f64], q: &mut [f64]) -> Result<()> {
        let rank = |answer: &Vec<f64>| {
            let away = |(joint, value): (&usize, &f64)| angle::difference(*value, last[*joint]).abs();
            let distance = self.joints.iter().zip(answer).map(away).fold(0.0, f64::max);
            (answer[self.knee.0] * self.knee.1 < -STRAIGHT, distance)
        };
        let before = |a: &(bool, f64), b: &(bool, f64)| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1));
        let answers = self.answers(torso_from_sole)?.into_iter().map(|answer| (rank(&answer), answer));
        let best = answers.min_by(|(a, _), (b, _)| before(a, b));
        let (_, mut answer) = best.ok_or_else(|| self.out_of_reach(torso_from_sole))?;
        let (knee, sense) = self.knee;
        if (-STRAIGHT..0.0).contains(&(answer[knee] * sense)) {
            answer[knee] = 0.0;
        }
        for (joint, value) in self.joints.iter().zip(answer) {
            q[*joint] = value;
        }
        Ok(())
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
