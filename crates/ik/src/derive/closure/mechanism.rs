//! A chain as exact screws with its task: what relations are made of. Main type: [`Mechanism`].

use super::coupling::Coupling;
use super::relation::Relation;
use super::vector;
use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::BigRational;
use groebot_robot::document::shown;
use groebot_robot::kinematics::upright::Upright;
use groebot_robot::kinematics::{Chain, ExactMatrix, ExactVector, Joint, JointKind, Mimic, TargetNumber, Task};

/// A joint's screw in the base frame at the zero configuration. A revolute joint has the unknowns c, the cosine of its angle, and
/// s' = s / |w|; a prismatic one d' = d / |w|: so no root enters the algebra.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ScrewJoint {
    /// The name of the joint.
    pub name: String,
    /// What follows c, s or d in the names of its unknowns.
    pub symbol: String,
    /// How it moves.
    pub kind: JointKind,
    /// w: along the axis; of length one where that is rational, else of coprime integers while they are short.
    pub axis: ExactVector,
    /// |w|^2, so that c^2 + |w|^2 s'^2 = 1.
    pub square: BigRational,
    /// o: a point of the axis.
    pub point: ExactVector,
    /// The place of the joint that it follows, the factor and the summand.
    pub follows: Option<(usize, [f64; 2])>,
    /// The same as an exact law, where its leader is not given.
    pub coupling: Option<Coupling>,
    /// The limits of a slide, if it has two, in the chain's unit.
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

    /// Whether it turns.
    pub fn is_revolute(&self) -> bool {
        self.kind == JointKind::Revolute
    }
}

/// A chain as exact screws, what is asked of its tip, and which joints the user gives.
///
/// With T the pose asked for and M that of the tip at zero, the loop is E1 ... En = G, where G = T M^-1 moves the whole body from
/// where it is at zero (RH0 2-20).
///
/// A ray does not say how the tip is turned about it. Any turn is chosen, which makes the ray a pose, and a joint behind the last one,
/// [`Mechanism::hidden`], turns the tip about the ray from where the chain brings it: so the turn is an unknown like the others, and
/// where the axes behind a point are known but for it, its sphere is met by a circle.
#[derive(Clone, Debug, PartialEq)]
pub struct Mechanism {
    joints: Vec<ScrewJoint>,
    tip_point: ExactVector,
    tip_rotation: ExactMatrix,
    aim: ExactVector,
    task: Task,
    given: Vec<usize>,
    /// Motions of the tip that the task does not see, as joints behind the last one.
    unseen: Vec<ScrewJoint>,
    /// What the joints are of, where they are the loop of the task `position_pitch_roll`.
    upright: Option<Box<Standing>>,
}

/// The loop of a [chain that stands upright](Chain::upright), as a mechanism with a target that never changes.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Standing {
    /// The chain itself.
    pub plain: Mechanism,
    /// The loop.
    pub upright: Upright,
}

impl Mechanism {
    /// The mechanism of `chain`, with its task and the joints that it gives.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a given joint that the chain has not; as [`Chain::check_leaders`].
    pub fn new(chain: &Chain) -> Result<Self> {
        if chain.task() != Task::PositionPitchRoll {
            return Mechanism::of_chain(chain);
        }
        let upright = chain.upright()?;
        let plain = Mechanism::of_chain(chain)?;
        let closed = Mechanism::of_joints(&upright.chain)?;
        let given = upright.chain.given();
        let standing = Some(Box::new(Standing { plain, upright }));
        Ok(Mechanism { task: Task::PositionPitchRoll, given, upright: standing, ..closed })
    }

    /// The mechanism of `chain` itself, whatever its task: what forward kinematics takes.
    ///
    /// # Errors
    /// As [`Chain::check_leaders`].
    pub fn of_chain(chain: &Chain) -> Result<Self> {
        Mechanism::of_joints(chain)?.with_given(&chain.given())
    }

    /// The mechanism of the joints of `chain`, none of them given.
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
        // The angle of a planar pose is counted from the zero configuration, and so are the turns about a ray and about an axis.
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

    /// The same mechanism with these joints, by their places, given by the user, and those that follow them.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a place beyond the last joint.
    pub fn with_given(mut self, given: &[usize]) -> Result<Self> {
        match &self.upright {
            None => {}
            Some(standing) if given == standing.plain.given() => return Ok(self),
            Some(_) => {
                let text = "the task `position_pitch_roll` is for as many joints as it has numbers: name the joints that are given (`given`)";
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

    /// The joints from base to tip, [`Mechanism::hidden`] behind them.
    pub fn joints(&self) -> &[ScrewJoint] {
        &self.joints
    }

    /// The joints of the chain itself.
    pub fn driven(&self) -> &[ScrewJoint] {
        match &self.upright {
            Some(standing) => &standing.plain.joints,
            None => &self.joints[..self.hidden().unwrap_or(self.joints.len())],
        }
    }

    /// The chain itself and the loop that these joints are of, for the task `position_pitch_roll`.
    pub fn standing(&self) -> Option<&Standing> {
        self.upright.as_deref()
    }

    /// The mechanism of the chain itself.
    pub fn plain(&self) -> &Mechanism {
        self.standing().map_or(self, |standing| &standing.plain)
    }

    /// The place of the joint that turns the tip about its ray, behind the last one, or about the vertical, when the task leaves that turn open.
    /// Its angle is found with the others and is no part of an answer.
    pub fn hidden(&self) -> Option<usize> {
        match self.task {
            Task::Ray => Some(self.joints.len() - 1),
            // Behind it are the radius, the height and the first joint.
            Task::PositionPitchRoll => self.upright.as_ref().map(|_| self.joints.len() - 4),
            _ => None,
        }
    }

    /// The origin of the tip at zero, in the base frame.
    pub fn tip_point(&self) -> &ExactVector {
        &self.tip_point
    }

    /// The rotation of the tip at zero, base_from_tip; for a planar pose, a ray and an angle about an axis, whose turns are counted from there, the identity.
    pub fn tip_rotation(&self) -> &ExactMatrix {
        &self.tip_rotation
    }

    /// The direction that the tasks `ray` and `direction` aim, at zero in the base frame: of length one where that is rational, else
    /// of coprime integers while they are short. The parameters dx, dy, dz of the relations are a vector of *this* length.
    pub fn aim(&self) -> &ExactVector {
        &self.aim
    }

    /// What is asked of the tip.
    pub fn task(&self) -> Task {
        self.task
    }

    /// What relations see of the tip: what is asked, and of a ray the pose with the turn that is chosen.
    pub fn seen(&self) -> Task {
        if matches!(self.task, Task::Ray | Task::PositionPitchRoll) { Task::Pose } else { self.task }
    }

    /// The places of the joints that the user gives, ascending.
    pub fn given(&self) -> &[usize] {
        &self.given
    }

    /// The places of the joints that are not given, ascending, that of the hidden one too.
    pub fn unknown(&self) -> Vec<usize> {
        (0..self.joints.len()).filter(|joint| !self.given.contains(joint)).collect()
    }

    /// The places of the joints that follow others and are not given, ascending, each with its law.
    pub fn followers(&self) -> Vec<(usize, &Coupling)> {
        let coupled = |place: usize| self.joints[place].coupling.as_ref().map(|coupling| (place, coupling));
        self.unknown().into_iter().filter_map(coupled).collect()
    }

    /// The number of joints that are not given and follow no other, the hidden one too.
    pub fn independent(&self) -> usize {
        self.unknown().len() - self.followers().len()
    }

    /// The relations of the joints that follow others.
    pub fn couplings(&self) -> Vec<Relation> {
        let each = |(place, coupling): (usize, &Coupling)| {
            Relation::following(place, coupling.leader, self.joints[place].is_revolute())
        };
        self.followers().into_iter().flat_map(each).collect()
    }

    /// Whether the task asks for no more numbers than there are independent joints.
    pub fn is_tight(&self) -> bool {
        self.seen().freedoms() <= self.independent()
    }

    /// Whether the steps of a plan must have as many solutions as the loop. Where more is asked than the joints can do, or joints follow others,
    /// steps may have more: what they leave out is measured at run time.
    pub fn counts_exactly(&self) -> bool {
        self.is_tight() && self.followers().is_empty()
    }

    /// The motions that relations do not see, as joints behind the tip: for a position all turns about the tip's point, and so on.
    pub(super) fn unseen(&self) -> &[ScrewJoint] {
        &self.unseen
    }

    /// The names of the numbers of the target that relations hold, in the order of [`super::Target::new`]: px, py, pz, r11 ... r33 and
    /// so on.
    pub fn parameters(&self) -> Vec<String> {
        numbers(self.seen())
    }
}

/// The law by which a joint follows another one, which is at the place `leader`.
fn coupling([joint, other]: [&ScrewJoint; 2], leader: usize, mimic: &Mimic) -> Result<Coupling> {
    let turn = [joint, other].map(ScrewJoint::is_revolute);
    Coupling::new(leader, turn, [&joint.square, &other.square], mimic).ok_or_else(|| {
        let text = format!(
            "joint `{}` follows `{}` by a law that is no polynomial in rational numbers: the ratio of the lengths of their axis vectors is irrational; \
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

/// A symbol that no joint has.
fn hidden_symbol(joints: &[ScrewJoint]) -> String {
    let is_free = |symbol: &String| !joints.iter().any(|joint| joint.symbol == *symbol);
    ["r", "ray"].map(String::from).into_iter().chain((0..).map(|k| format!("ray{k}"))).find(is_free).unwrap_or_default()
}

/// The motions of the tip that `task` does not see, as joints behind the last one.
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
