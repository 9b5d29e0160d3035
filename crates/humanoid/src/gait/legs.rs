//! The legs of a biped, each with an inverse-kinematics solver. Main type: [`Legs`].

use std::sync::Arc;

use nalgebra::{Vector2, Vector3};

use super::biped::Biped;
use super::footprint::Side;
use super::nearby::Nearby;
use crate::{Error, ErrorKind, Result};
use groebot_robot::kinematics::{InverseKinematics, Solution, Target};
use groebot_robot::spatial::{Pose, angle};

/// A knee within this angle of zero is straight \[rad\]. There its angle is known only to the square root of the
/// lengths' rounding error.
const STRAIGHT: f64 = 1e-6;

/// A configuration of a whole biped.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Posture {
    /// The pose of the torso in the world.
    pub world_from_torso: Pose,
    /// The values of all joints \[rad\].
    pub q: Vec<f64>,
}

/// The solver of a leg: it moves the sole's link to a pose in the torso frame. The joint values are ordered from the
/// torso to the sole.
pub type LegSolver = Arc<dyn InverseKinematics>;

/// A solver for poses of a sole that holds its position and a direction; the rotation about the direction is free.
#[derive(Debug)]
struct Pointing {
    /// The solver of the position and the direction.
    ray: LegSolver,
    /// The direction in the frame of the sole's link.
    direction: Vector3<f64>,
}

/// Makes a solver for poses of a sole's link from the solver of a ray. It holds the link's position and its direction
/// `direction`, a unit vector of the link's frame; the rotation about it is free.
pub(super) fn pointing(ray: LegSolver, direction: Vector3<f64>) -> impl InverseKinematics {
    Pointing { ray, direction }
}

impl InverseKinematics for Pointing {
    fn solve(&self, target: &Target, given: &[f64], out: &mut Vec<Solution>) -> Result<()> {
        let Target::Pose(pose) = target else { return self.ray.solve(target, given, out) };
        let direction = pose.rotation * self.direction;
        self.ray.solve(&Target::Ray { point: pose.translation.vector.into(), direction }, given, out)
    }

    fn uses_eigenvalues(&self) -> bool {
        self.ray.uses_eigenvalues()
    }
}

/// The solvers of both legs of a biped.
#[derive(Clone, Debug)]
pub struct Legs {
    legs: [Leg; 2],
    crouch: Vec<f64>,
    /// The joints, left and right, that one actuator moves.
    shared: Option<(usize, usize)>,
    /// Joints of the arms, each with the joint of a leg whose value it takes.
    coordinated: Vec<(usize, usize)>,
    /// The offset of the torso from the centre of mass, seen from above, from which the search for postures starts
    /// \[m\].
    lead: Vector2<f64>,
}

/// The solver of one leg.
#[derive(Clone, Debug)]
struct Leg {
    side: Side,
    solver: LegSolver,
    /// The joints from the torso to the sole, as indices into a configuration.
    joints: Vec<usize>,
    /// The frame of the sole's link in the frame of the sole.
    sole_from_link: Pose,
    /// The index of the knee in the leg, and the sign of its bend.
    knee: (usize, f64),
    /// Finds the nearest solution without the others, where they take longer.
    nearby: Option<Nearby>,
}

impl Legs {
    /// The legs of `biped` with a solver each, left and right. `crouch` is a posture with bent knees, one value a joint
    /// \[rad\]. The joint of a leg with the greatest angle in it is the knee.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when `crouch` does not have one value for each joint.
    pub fn new(biped: &Biped, solvers: [LegSolver; 2], crouch: Vec<f64>) -> Result<Self> {
        if crouch.len() != biped.joints.len() {
            let text = format!("{} values are given; {} has {} joints", crouch.len(), biped.name, biped.joints.len());
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let [left, right] = solvers;
        let leg = |side: Side, solver| Leg::new(biped, side, solver, &crouch);
        let legs = [leg(Side::Left, left), leg(Side::Right, right)];
        Ok(Legs {
            legs,
            crouch,
            shared: biped.shared.first().copied(),
            coordinated: Vec::new(),
            lead: Vector2::zeros(),
        })
    }

    /// Adds joints of other limbs that take the value of a joint of a leg: pairs of the follower and the leader.
    #[must_use]
    pub(crate) fn with_coordinated(self, coordinated: Vec<(usize, usize)>) -> Self {
        Legs { coordinated, ..self }
    }

    /// Starts the search for postures with the torso and the centre of mass as in the crouch.
    ///
    /// # Errors
    /// None for the biped of these legs.
    pub(crate) fn starting_from_crouch(self, biped: &Biped) -> Result<Self> {
        let centre = biped.model.place(&Pose::identity(), &self.crouch)?.centre_of_mass();
        Ok(Legs { lead: -centre.coords.xy(), ..self })
    }

    /// The offset of the torso from the centre of mass from which the search for postures starts, in the axes of the
    /// torso \[m\].
    pub(crate) fn lead(&self) -> Vector2<f64> {
        self.lead
    }

    /// The posture with the soles at the poses `world_from_soles`, left and right, and the torso at `world_from_torso`.
    /// Of several solutions it takes the nearest to `last` whose knees bend as in the crouch. Joint limits are not
    /// checked. Legs that share an actuator may disagree on its value: [`Legs::disagreement`]. Joints of other limbs
    /// stay as in `last`, except those coordinated with the legs.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when a foot is out of reach.
    pub(crate) fn stand(
        &self,
        world_from_soles: &[Pose; 2],
        world_from_torso: &Pose,
        last: &Posture,
    ) -> Result<Posture> {
        let mut q = last.q.clone();
        for (leg, world_from_sole) in self.legs.iter().zip(world_from_soles) {
            leg.stand(&world_from_torso.inv_mul(world_from_sole), &last.q, &mut q)?;
        }
        for (joint, leader) in &self.coordinated {
            q[*joint] = q[*leader];
        }
        Ok(Posture { world_from_torso: *world_from_torso, q })
    }

    /// Whether one actuator moves a joint of both legs, so that the torso's heading is not free.
    pub(crate) fn share_an_actuator(&self) -> bool {
        self.shared.is_some()
    }

    /// The difference between the legs' values of the actuator that they share \[rad\]; 0 when they share none.
    pub(crate) fn disagreement(&self, posture: &Posture) -> f64 {
        self.shared.map_or(0.0, |(left, right)| angle::difference(posture.q[left], posture.q[right]))
    }

    /// Sets both legs to the left one's value of the actuator that they share.
    pub fn agree(&self, posture: &mut Posture) {
        if let Some((left, right)) = self.shared {
            posture.q[right] = posture.q[left];
        }
    }

    /// A posture with bent knees, from which [`Legs::stand`] finds the right solutions; the torso is at the origin.
    pub(crate) fn crouch(&self) -> Posture {
        Posture { world_from_torso: Pose::identity(), q: self.crouch.clone() }
    }

    /// All solutions of the leg of `side` for a sole at `torso_from_sole`, in the order of its solver. Each has the
    /// joint values from the torso to the sole \[rad\]. Empty when the pose is out of reach.
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
            nearby: solver.uses_eigenvalues().then(|| Nearby::new(biped, foot)).flatten(),
            solver,
            joints: foot.joints.clone(),
            sole_from_link: foot.torso_from_sole.inv_mul(&torso_from_link),
            knee: (knee, crouch[foot.joints[knee]].signum()),
        }
    }

    /// The solutions for a sole at `torso_from_sole`.
    fn answers(&self, torso_from_sole: &Pose) -> Result<Vec<Vec<f64>>> {
        let mut found = Vec::new();
        self.solver.solve(&Target::Pose(torso_from_sole * self.sole_from_link), &[], &mut found)?;
        Ok(found.into_iter().map(|answer| answer.q).collect())
    }

    /// Writes into `q` the solution for a sole at `torso_from_sole` that is nearest to `last`.
    fn stand(&self, torso_from_sole: &Pose, last: &[f64], q: &mut [f64]) -> Result<()> {
        let mut answer = match self.near(torso_from_sole, last) {
            Some(answer) => answer.to_vec(),
            None => self.nearest(torso_from_sole, last)?,
        };
        let (knee, sense) = self.knee;
        if (-STRAIGHT..0.0).contains(&(answer[knee] * sense)) {
            answer[knee] = 0.0;
        }
        for (joint, value) in self.joints.iter().zip(answer) {
            q[*joint] = value;
        }
        Ok(())
    }

    /// The solution that [`Leg::nearest`] would return, if that is known without the other ones.
    fn near(&self, torso_from_sole: &Pose, last: &[f64]) -> Option<[f64; 6]> {
        let nearby = self.nearby.as_ref()?;
        let last: Vec<f64> = self.joints.iter().map(|joint| last[*joint]).collect();
        let answer = nearby.solve(&(torso_from_sole * self.sole_from_link), last.as_slice().try_into().ok()?)?;
        (!self.bends_back(&answer)).then_some(answer)
    }

    /// Of all solutions the nearest to `last`, of those whose knee bends as in the crouch if there are any.
    fn nearest(&self, torso_from_sole: &Pose, last: &[f64]) -> Result<Vec<f64>> {
        let rank = |answer: &Vec<f64>| {
            let away = |(joint, value): (&usize, &f64)| angle::difference(*value, last[*joint]).abs();
            let distance = self.joints.iter().zip(answer).map(away).fold(0.0, f64::max);
            (self.bends_back(answer), distance)
        };
        let before = |a: &(bool, f64), b: &(bool, f64)| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1));
        let answers = self.answers(torso_from_sole)?.into_iter().map(|answer| (rank(&answer), answer));
        let best = answers.min_by(|(a, _), (b, _)| before(a, b));
        best.map(|(_, answer)| answer).ok_or_else(|| self.out_of_reach(torso_from_sole))
    }

    /// Whether the knee bends in the direction opposite to that in the crouch.
    fn bends_back(&self, answer: &[f64]) -> bool {
        answer[self.knee.0] * self.knee.1 < -STRAIGHT
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
