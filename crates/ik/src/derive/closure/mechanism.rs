//! A chain as exact screws, with its task. It is the input for relations. Main type: [`Mechanism`].

use super::coupling::Coupling;
use super::relation::Relation;
use super::vector;
use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::BigRational;
use groebot_robot::document::shown;
use groebot_robot::kinematics::upright::Upright;
use groebot_robot::kinematics::{Chain, ExactMatrix, ExactVector, Joint, JointKind, Mimic, TargetNumber, Task};

/// A joint's screw in the base frame in the zero configuration. A revolute joint has the unknowns c, the cosine of its angle, and s' = s / |w|. A prismatic
/// joint has d' = d / |w|. So the algebra needs no square root.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ScrewJoint {
    /// The name of the joint.
    pub name: String,
    /// The suffix after c, s or d in the names of its unknowns.
    pub symbol: String,
    /// The type of the joint.
    pub kind: JointKind,
    /// w, along the axis. Its length is one if that is rational; otherwise w consists of coprime integers unless they are long.
    pub axis: ExactVector,
    /// |w|^2, so that c^2 + |w|^2 s'^2 = 1.
    pub square: BigRational,
    /// o: a point of the axis.
    pub point: ExactVector,
    /// If the joint follows another one: the index of that joint, the factor and the offset.
    pub follows: Option<(usize, [f64; 2])>,
    /// The law in exact form, if the leader is not given.
    pub coupling: Option<Coupling>,
    /// The limits of a prismatic joint, if it has both, in the chain's unit.
    pub travel: Option<(f64, f64)>,
    /// w / |w|^2.
    pub(super) dual: ExactVector,
}

impl ScrewJoint {
    fn new(name: &str, symbol: &str, kind: JointKind, axis: &ExactVector, point: &ExactVector) -> Self {
        let axis = vector::normalised(axis);
        let (square, point) = (vector::dot(&axis, &axis), point.clone());
        let dual = vector::scale(&axis, &square.recip());
        let (name, symbol) = (name.to_owned(), symbol.to_owned());
        ScrewJoint { name, symbol, kind, axis, square, point, follows: None, coupling: None, travel: None, dual }
    }

    /// The screw of a chain's joint.
    fn of(joint: &Joint) -> Self {
        let is_travel = |(low, high): &(f64, f64)| joint.kind == JointKind::Prismatic && (high - low).is_finite();
        let travel = joint.limits.filter(is_travel);
        ScrewJoint { travel, ..ScrewJoint::new(&joint.name, &joint.symbol, joint.kind, &joint.axis, &joint.point) }
    }

    /// Whether the joint is revolute.
    pub(crate) fn is_revolute(&self) -> bool {
        self.kind == JointKind::Revolute
    }
}

/// A chain as exact screws, with its task and the joints that the user gives.
///
/// Let T be the target pose and M the pose of the tip in the zero configuration. The loop is E1 ... En = G, where G = T M^-1 moves the last body from its zero
/// pose to the target (RH0 2-20).
///
/// A ray does not specify the rotation of the tip about it. An arbitrary rotation makes the ray a pose. An additional joint after the last one,
/// [`Mechanism::hidden`], rotates the tip about the ray, so that this angle is an unknown like the others. If it is
/// the only unknown after a point of the chain, that point moves on a circle, and the joints before it constrain it to a sphere.
#[derive(Clone, Debug, PartialEq)]
pub struct Mechanism {
    joints: Vec<ScrewJoint>,
    tip_point: ExactVector,
    tip_rotation: ExactMatrix,
    aim: ExactVector,
    task: Task,
    given: Vec<usize>,
    /// Motions of the tip that the task does not constrain, as joints after the last one.
    unseen: Vec<ScrewJoint>,
    /// The chain and its loop for the task `position_pitch_roll`; the joints are then those of the loop.
    upright: Option<Box<UprightLoop>>,
}

/// The loop of a [chain with a vertical first axis](Chain::upright), as a mechanism with a constant target.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct UprightLoop {
    /// The chain itself.
    pub plain: Mechanism,
    /// The loop.
    pub upright: Upright,
}

impl Mechanism {
    /// The mechanism of `chain`, with its task and given joints.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a given joint that the chain does not have; as [`Chain::check_leaders`].
    pub fn new(chain: &Chain) -> Result<Self> {
        if chain.task() != Task::PositionPitchRoll {
            return Mechanism::of_chain(chain);
        }
        let upright = chain.upright()?;
        let plain = Mechanism::of_chain(chain)?;
        let closed = Mechanism::of_joints(&upright.chain)?;
        let given = upright.chain.given();
        let upright_loop = Some(Box::new(UprightLoop { plain, upright }));
        Ok(Mechanism { task: Task::PositionPitchRoll, given, upright: upright_loop, ..closed })
    }

    /// The mechanism of `chain` itself, without the loop of its task, for forward kinematics.
    ///
    /// # Errors
    /// As [`Chain::check_leaders`].
    pub(crate) fn of_chain(chain: &Chain) -> Result<Self> {
        Mechanism::of_joints(chain)?.with_given(&chain.given())
    }

    /// The mechanism of the joints of `chain`, without given joints.
    fn of_joints(chain: &Chain) -> Result<Self> {
        chain.check_leaders()?;
        let plain: Vec<ScrewJoint> = chain.joints().iter().map(ScrewJoint::of).collect();
        let (mut joints, given) = (plain.clone(), chain.given());
        for (place, joint) in joints.iter_mut().enumerate() {
            let Some((leader, mimic)) = chain.leader(place) else { continue };
            joint.follows = Some((leader, mimic.law()));
            if !given.contains(&place) {
                joint.coupling = Some(coupling([&plain[place], &plain[leader]], leader, mimic)?);
            }
        }
        let task = chain.task();
        // The angle of a planar pose is relative to the zero configuration. So are the angles about a ray and about an axis.
        let tip_rotation = match task {
            Task::PlanarPose { .. } | Task::Ray | Task::PositionYaw { .. } => vector::identity(),
            _ => chain.tip().rotation.clone(),
        };
        let tip_point = chain.tip().point.clone();
        let aim = vector::normalised(&vector::turn(&chain.tip().rotation, chain.direction()));
        if task == Task::Ray {
            let symbol = hidden_symbol(&joints);
            joints.push(ScrewJoint::new("turn about the ray", &symbol, JointKind::Revolute, &aim, &tip_point));
        }
        let unseen = unseen(task, &tip_point, &aim);
        Ok(Mechanism { joints, tip_point, tip_rotation, aim, task, given: Vec::new(), unseen, upright: None })
    }

    /// Same mechanism, but with these joints (indices) given by the user, together with those that follow them.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for an index beyond the last joint.
    pub fn with_given(mut self, given: &[usize]) -> Result<Self> {
        match &self.upright {
            None => {}
            Some(upright_loop) if given == upright_loop.plain.given() => return Ok(self),
            Some(_) => {
                let text = "the task `position_pitch_roll` needs as many independent joints as it has numbers: name the given joints (`given`)";
                return Err(Error::new(ErrorKind::Unsupported, text));
            }
        }
        let count = self.driven().len();
        if let Some(place) = given.iter().find(|&&place| place >= count) {
            let text = format!("joint {} cannot be given: the chain has {count} joints", place + 1);
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        self.given = given.to_vec();
        let leads = |place: &usize| self.joints[*place].follows.is_some_and(|(leader, _)| given.contains(&leader));
        self.given.extend((0..count).filter(leads));
        self.given.sort_unstable();
        self.given.dedup();
        Ok(self)
    }

    /// The joints from base to tip, then [`Mechanism::hidden`].
    pub fn joints(&self) -> &[ScrewJoint] {
        &self.joints
    }

    /// The joints of the chain itself.
    pub(crate) fn driven(&self) -> &[ScrewJoint] {
        match &self.upright {
            Some(upright_loop) => &upright_loop.plain.joints,
            None => &self.joints[..self.hidden().unwrap_or(self.joints.len())],
        }
    }

    /// The chain itself and the loop of these joints, for the task `position_pitch_roll`.
    pub fn upright_loop(&self) -> Option<&UprightLoop> {
        self.upright.as_deref()
    }

    /// The mechanism of the chain itself.
    pub(crate) fn plain(&self) -> &Mechanism {
        self.upright_loop().map_or(self, |upright_loop| &upright_loop.plain)
    }

    /// The index of the hidden joint, if the task leaves a rotation of the tip open. It rotates the tip about the ray, after the last joint, or about the
    /// vertical. Its angle is found with the others but is not part of a solution.
    pub fn hidden(&self) -> Option<usize> {
        match self.task {
            Task::Ray => Some(self.joints.len() - 1),
            // After it come the radius, the height and the first joint.
            Task::PositionPitchRoll => self.upright.as_ref().map(|_| self.joints.len() - 4),
            _ => None,
        }
    }

    /// The origin of the tip in the zero configuration, in the base frame.
    pub(crate) fn tip_point(&self) -> &ExactVector {
        &self.tip_point
    }

    /// The rotation of the tip in the zero configuration, base_from_tip. It is the identity for a planar pose, a ray and an angle about an axis, whose angles
    /// are relative to the zero configuration.
    pub(crate) fn tip_rotation(&self) -> &ExactMatrix {
        &self.tip_rotation
    }

    /// The direction that the tasks `ray` and `direction` orient, in the zero configuration and the base frame. Its length is one if that is rational;
    /// otherwise it consists of coprime integers unless they are long. The parameters dx, dy, dz of the relations are a vector of *this* length.
    pub fn aim(&self) -> &ExactVector {
        &self.aim
    }

    /// The task of the tip.
    pub fn task(&self) -> Task {
        self.task
    }

    /// The task that relations use: the pose for a ray and for `position_pitch_roll`, else the task itself.
    pub(crate) fn seen(&self) -> Task {
        if matches!(self.task, Task::Ray | Task::PositionPitchRoll) { Task::Pose } else { self.task }
    }

    /// The indices of the joints that the user gives, ascending.
    pub(crate) fn given(&self) -> &[usize] {
        &self.given
    }

    /// The indices of the joints that are not given, ascending, including the hidden one.
    pub fn unknown(&self) -> Vec<usize> {
        (0..self.joints.len()).filter(|joint| !self.given.contains(joint)).collect()
    }

    /// The indices of the joints that follow others and are not given, ascending, each with its law.
    pub(crate) fn followers(&self) -> Vec<(usize, &Coupling)> {
        let coupled = |place: usize| self.joints[place].coupling.as_ref().map(|coupling| (place, coupling));
        self.unknown().into_iter().filter_map(coupled).collect()
    }

    /// The number of joints that are not given and follow no other, including the hidden one.
    pub(crate) fn independent(&self) -> usize {
        self.unknown().len() - self.followers().len()
    }

    /// The relations of the joints that follow others.
    pub(crate) fn couplings(&self) -> Vec<Relation> {
        let each = |(place, coupling): (usize, &Coupling)| {
            Relation::following(place, coupling.leader, self.joints[place].is_revolute())
        };
        self.followers().into_iter().flat_map(each).collect()
    }

    /// Whether the task has at most as many numbers as there are independent joints.
    pub(crate) fn is_tight(&self) -> bool {
        self.seen().freedoms() <= self.independent()
    }

    /// Whether the steps of a plan must have as many solutions as the loop. If the task is overdetermined (more numbers than independent joints), or joints
    /// follow others, steps may have more. The unused equations are then evaluated at run time.
    pub(crate) fn counts_exactly(&self) -> bool {
        self.is_tight() && self.followers().is_empty()
    }

    /// The motions that the task does not constrain, as joints after the tip. For a position these are all rotations about the tip's point.
    pub(super) fn unseen(&self) -> &[ScrewJoint] {
        &self.unseen
    }

    /// The names of the target's numbers in relations, in the order of [`super::Target::new`]: px, py, pz, r11 ... r33 and so on.
    pub fn parameters(&self) -> Vec<String> {
        numbers(self.seen())
    }
}

/// The law by which a joint follows the joint at index `leader`.
fn coupling([joint, other]: [&ScrewJoint; 2], leader: usize, mimic: &Mimic) -> Result<Coupling> {
    let revolute = [joint, other].map(ScrewJoint::is_revolute);
    Coupling::new(leader, revolute, [&joint.square, &other.square], mimic).ok_or_else(|| {
        let text = format!(
            "joint `{}` follows `{}` by a law that is not a polynomial over the rational numbers: the ratio of the lengths of their axis vectors is irrational; \
             a search (`groebot ik --numeric`) finds joint values",
            shown(&joint.name),
            shown(&other.name)
        );
        Error::new(ErrorKind::Unsupported, text)
    })
}

/// The names of the numbers of a task's target.
fn numbers(task: Task) -> Vec<String> {
    let names = |number: &TargetNumber| match number {
        TargetNumber::PlaneAngle(_) | TargetNumber::Yaw(_) => vec!["cphi".to_owned(), "sphi".to_owned()],
        number => vec![number.name()],
    };
    task.layout().numbers().iter().flat_map(names).collect()
}

/// A symbol that no joint uses.
fn hidden_symbol(joints: &[ScrewJoint]) -> String {
    let is_free = |symbol: &String| !joints.iter().any(|joint| joint.symbol == *symbol);
    ["r", "ray"].map(String::from).into_iter().chain((0..).map(|k| format!("ray{k}"))).find(is_free).unwrap_or_default()
}

/// The motions of the tip that `task` does not constrain, as joints after the last one.
fn unseen(task: Task, tip: &ExactVector, aim: &ExactVector) -> Vec<ScrewJoint> {
    let joint = |kind, axis: &ExactVector| ScrewJoint::new("", "", kind, axis, tip);
    let every = |kind| (0..3).map(move |k| joint(kind, &vector::unit(k)));
    let about_aim = joint(JointKind::Revolute, aim);
    match task {
        Task::Pose | Task::PlanarPose { .. } | Task::Ray | Task::PositionPitchRoll | Task::PositionYaw { .. } => {
            Vec::new()
        }
        Task::Position | Task::PlanarPosition { .. } => every(JointKind::Revolute).collect(),
        Task::Direction => every(JointKind::Prismatic).chain([about_aim]).collect(),
        Task::Rotation => every(JointKind::Prismatic).collect(),
    }
}
