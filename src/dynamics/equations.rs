//! The equations of motion of a robot, `M q'' + C q' + N + friction = torques`. Main type: [`Equations`].

use nalgebra::{DMatrix, DVector, Quaternion, UnitQuaternion, Vector3};

use super::Model;
use super::articulated::{self, Articulation, Cause, Massless};
use super::data::{Data, Matrices, Motion};
use super::masses::check_masses;
use super::six::Six;
use super::tree::{Place, Tree};
use crate::model::{Joint, Robot};
use crate::{Error, ErrorKind, Result};

/// How far the length of a quaternion may be from one.
const ROUNDED: f64 = 1e-3;

/// Whether the root link stands still.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Base {
    /// It does. A configuration has a value for each independent joint.
    Fixed,
    /// It moves freely. Before the joints a configuration has the root's position (x, y, z) and orientation (a quaternion x, y, z, w) in the world, and a
    /// velocity the root's linear and angular velocity in its own frame.
    Floating,
}

/// How a joint is moved, and what of its own moves with it: its value is `factor` times that of a freedom, and `offset`.
#[derive(Clone, Debug, PartialEq)]
struct Drive {
    freedom: usize,
    factor: f64,
    offset: f64,
    armature: f64,
    damping: f64,
    friction: f64,
}

impl Drive {
    /// The torque against which the joint turns at a rate: viscous and Coulomb friction.
    fn friction(&self, rate: f64) -> f64 {
        let sign = if rate == 0.0 { 0.0 } else { rate.signum() };
        self.damping * rate + self.friction * sign
    }
}

/// The equations of motion of a robot: metres, kilograms, seconds, radians. They do not change, and calls write to a [`Workspace`] alone.
#[derive(Clone, Debug, PartialEq)]
pub struct Equations {
    tree: Tree<f64>,
    base: Base,
    /// In the frame of the root at the zero configuration.
    gravity: Vector3<f64>,
    names: Vec<String>,
    /// By independent joint, the link behind it.
    links: Vec<String>,
    drives: Vec<Drive>,
}

/// What the equations are asked at: where a robot is and how it moves.
#[derive(Clone, Copy, Debug)]
pub struct State<'a> {
    /// The configuration.
    pub q: &'a [f64],
    /// The velocity.
    pub velocity: &'a [f64],
}

/// Room for the equations of one robot: made once; what calls allocate are vectors and matrices that they return, and vectors of zeros.
#[derive(Clone, Debug)]
pub struct Workspace {
    data: Data<f64>,
    articulation: Articulation<f64>,
    /// By joint, its rotor's inertia.
    rotors: Vec<f64>,
    /// By joint, its rate, what that changes by, and its torque.
    rates: Vec<f64>,
    accelerations: Vec<f64>,
    torques: Vec<f64>,
    full: Matrices<f64>,
    motion: [Six<f64>; 2],
}

impl Equations {
    /// Those of a robot. Gravity is 9.81 m/s^2 along -z of the root's frame (of a floating root: of the world).
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`], with the link's name, for a mass below zero, and where links that are fixed to one another have together an inertia that no
    /// body has: one of a mass that is not positive, or against the triangle inequality.
    pub fn new(robot: &Robot, base: Base) -> Result<Self> {
        let model = Model::new(robot)?;
        check_masses(robot, &model)?;
        Equations::of(robot, &model, base)
    }

    /// The same with all figures as they are told, whether bodies can have them or not.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a figure beyond doubles.
    pub fn as_told(robot: &Robot, base: Base) -> Result<Self> {
        Equations::of(robot, &Model::new(robot)?, base)
    }

    fn of(robot: &Robot, model: &Model, base: Base) -> Result<Self> {
        let moving: Vec<&Joint> = robot.moving().into_iter().map(|place| &robot.joints()[place]).collect();
        let laws: Vec<_> = moving.iter().map(|joint| robot.law(joint)).collect();
        let leads = |(joint, law): &(&&Joint, &crate::model::Mimic)| law.leader == joint.name;
        let leading = || moving.iter().zip(&laws).filter(leads).map(|(joint, _)| joint);
        let names: Vec<String> = leading().map(|joint| joint.name.clone()).collect();
        let links = leading().map(|joint| joint.child.clone()).collect();
        let drive = |(joint, law): (&&Joint, &crate::model::Mimic)| {
            let [factor, offset] = law.law();
            let unknown =
                || joint.error(ErrorKind::BadValue, &format!("it follows `{}`, which does not move", law.leader));
            let freedom = names.iter().position(|name| *name == law.leader).ok_or_else(unknown)?;
            let Joint { armature, damping, friction, .. } = **joint;
            Ok(Drive { freedom, factor, offset, armature, damping, friction })
        };
        let drives = moving.iter().zip(&laws).map(drive).collect::<Result<_>>()?;
        Ok(Equations { tree: Tree::new(model), base, gravity: Vector3::new(0.0, 0.0, -9.81), names, links, drives })
    }

    /// The same under another gravity \[m/s^2\].
    #[must_use]
    pub fn with_gravity(mut self, gravity: Vector3<f64>) -> Self {
        self.gravity = gravity;
        self
    }

    /// The same without the friction of joints.
    #[must_use]
    pub fn without_friction(mut self) -> Self {
        self.drives.iter_mut().for_each(|drive| (drive.damping, drive.friction) = (0.0, 0.0));
        self
    }

    /// The independent joints, in the order of a configuration.
    pub fn joints(&self) -> &[String] {
        &self.names
    }

    /// How many numbers a velocity has.
    pub fn freedoms(&self) -> usize {
        self.names.len() + if self.base == Base::Floating { 6 } else { 0 }
    }

    /// How many numbers a configuration has.
    pub fn coordinates(&self) -> usize {
        self.names.len() + if self.base == Base::Floating { 7 } else { 0 }
    }

    /// Room for calls.
    pub fn workspace(&self) -> Workspace {
        let joints = self.drives.len();
        let size = joints + if self.base == Base::Floating { 6 } else { 0 };
        Workspace {
            data: Data::new(&self.tree),
            articulation: Articulation::new(&self.tree),
            rotors: vec![0.0; joints],
            rates: vec![0.0; joints],
            accelerations: vec![0.0; joints],
            torques: vec![0.0; joints],
            full: Matrices::new(size),
            motion: [Six::zero(); 2],
        }
    }

    /// Inverse dynamics: the torques (of a floating base first its force and moment, in its own frame) that a motion asks for, friction and rotors
    /// included.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a wrong count of numbers, one that is not finite, or a quaternion whose length is not one within 1e-3.
    pub fn inverse(&self, room: &mut Workspace, state: State<'_>, acceleration: &[f64]) -> Result<DVector<f64>> {
        self.check(state, Some(("acceleration", acceleration)))?;
        self.place(room, state.q);
        self.set_in_motion(room, state, acceleration, true);
        let mut torques = self.newton_euler(room);
        for (joint, drive) in self.drives.iter().enumerate() {
            let own = drive.armature * room.accelerations[joint] + drive.friction(room.rates[joint]);
            torques[self.first() + drive.freedom] += drive.factor * own;
        }
        Ok(torques)
    }

    /// The torques that hold the robot against gravity where it stands, `N`.
    ///
    /// # Errors
    /// As [`Equations::inverse`].
    pub fn gravity(&self, room: &mut Workspace, q: &[f64]) -> Result<DVector<f64>> {
        let still = vec![0.0; self.freedoms()];
        self.check(State { q, velocity: &still }, None)?;
        self.place(room, q);
        self.set_in_motion(room, State { q, velocity: &still }, &still, true);
        Ok(self.newton_euler(room))
    }

    /// The inertia matrix, rotors included.
    ///
    /// # Errors
    /// As [`Equations::inverse`].
    pub fn inertia(&self, room: &mut Workspace, q: &[f64]) -> Result<DMatrix<f64>> {
        let still = vec![0.0; self.freedoms()];
        self.matrices(room, State { q, velocity: &still }).map(|[inertia, _]| inertia)
    }

    /// The Coriolis matrix of Christoffel's symbols, RH0 (2-42): `M' - 2 C` is skew.
    ///
    /// # Errors
    /// As [`Equations::inverse`].
    pub fn coriolis(&self, room: &mut Workspace, state: State<'_>) -> Result<DMatrix<f64>> {
        self.matrices(room, state).map(|[_, coriolis]| coriolis)
    }

    /// The inertia and the Coriolis matrix.
    ///
    /// # Errors
    /// As [`Equations::inverse`].
    pub fn matrices(&self, room: &mut Workspace, state: State<'_>) -> Result<[DMatrix<f64>; 2]> {
        self.check(state, None)?;
        self.place(room, state.q);
        self.set_in_motion(room, state, state.velocity, false);
        let Workspace { data, rates, accelerations, full, motion, .. } = room;
        let [base, base_acceleration] = *motion;
        let motion = Motion { base, base_acceleration, rates, accelerations };
        data.matrices(&self.tree, &motion, full);
        let mut matrices = [&full.inertia, &full.coriolis].map(|all| self.independent(all, full.size));
        for drive in &self.drives {
            let at = self.first() + drive.freedom;
            matrices[0][(at, at)] += drive.factor * drive.factor * drive.armature;
        }
        Ok(matrices)
    }

    /// Forward dynamics: what torques (of a floating base first a force and a moment on it, in its own frame) change the velocity by.
    ///
    /// # Errors
    /// As [`Equations::inverse`], and where bodies without mass would have to move, with the names of the link and its joint.
    pub fn forward(&self, room: &mut Workspace, state: State<'_>, torques: &[f64]) -> Result<DVector<f64>> {
        self.check(state, Some(("torques", torques)))?;
        let leads = |(at, drive): (usize, &Drive)| drive.freedom == at && drive.factor == 1.0;
        if self.drives.iter().enumerate().all(leads) {
            self.forward_by_bodies(room, state, torques)
        } else {
            self.forward_by_inertia(room, state, torques)
        }
    }

    /// By articulated bodies, where each joint is on its own.
    fn forward_by_bodies(&self, room: &mut Workspace, state: State<'_>, torques: &[f64]) -> Result<DVector<f64>> {
        let first = self.first();
        self.place(room, state.q);
        // Of the accelerations only that of gravity is known.
        self.set_in_motion(room, state, &vec![0.0; self.freedoms()], true);
        let Workspace { data, articulation, rates, accelerations, torques: own, rotors, motion, .. } = room;
        for (joint, drive) in self.drives.iter().enumerate() {
            let left = torques[first + joint] - drive.friction(rates[joint]);
            (own[joint], rotors[joint]) = (left, drive.armature);
        }
        let [base, pull] = *motion;
        let base_cause = match self.base {
            Base::Fixed => Cause::Acceleration(pull),
            Base::Floating => Cause::Force(Six {
                linear: std::array::from_fn(|i| torques[i]),
                angular: std::array::from_fn(|i| torques[3 + i]),
            }),
        };
        let moving = articulated::Drive { base, base_cause, rates, torques: own, rotors };
        let found = articulation.forward(&self.tree, data, &moving, |pivot| *pivot > 0.0, accelerations);
        let of_base = found.map_err(|Massless(joint)| self.massless(joint))?;
        let mut changes = DVector::zeros(self.freedoms());
        (0..first).for_each(|at| changes[at] = of_base.at(at) - pull.at(at));
        changes.rows_mut(first, accelerations.len()).copy_from_slice(accelerations);
        Ok(changes)
    }

    /// By the inertia matrix, where joints follow others.
    fn forward_by_inertia(&self, room: &mut Workspace, state: State<'_>, torques: &[f64]) -> Result<DVector<f64>> {
        let still = vec![0.0; self.freedoms()];
        let missing = DVector::from_column_slice(torques) - self.inverse(room, state, &still)?;
        let inertia = self.inertia(room, state.q)?;
        if let Some(factors) = inertia.clone().cholesky() {
            return Ok(factors.solve(&missing));
        }
        let block = |at: usize| inertia.view((0, 0), (at + 1, at + 1)).into_owned();
        let massless = (0..inertia.nrows()).find(|&at| block(at).cholesky().is_none());
        Err(self.massless(massless.and_then(|at| at.checked_sub(self.first()))))
    }

    fn massless(&self, joint: Option<usize>) -> Error {
        let text = match joint {
            Some(joint) => format!(
                "link `{}` behind joint `{}` and what it carries have no mass that the joint moves, and torques would move it without limit; give masses",
                self.links[joint], self.names[joint]
            ),
            None => "the base and what it carries have no mass that torques move; give masses".to_owned(),
        };
        Error::new(ErrorKind::BadValue, text)
    }

    /// Where the joints stand among the freedoms.
    fn first(&self) -> usize {
        self.freedoms() - self.names.len()
    }

    fn check(&self, state: State<'_>, third: Option<(&str, &[f64])>) -> Result<()> {
        let lists = [("q", state.q, self.coordinates()), ("velocity", state.velocity, self.freedoms())];
        let third = third.map(|(name, list)| (name, list, self.freedoms()));
        for (name, list, count) in lists.into_iter().chain(third) {
            let text = if list.len() != count {
                format!("{name}: {} numbers are given, the robot has {count}", list.len())
            } else if let Some(at) = list.iter().position(|value| !value.is_finite()) {
                format!("{name}{at} is {}; give a finite number", list[at])
            } else {
                continue;
            };
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        if self.base == Base::Floating {
            let length = DVector::from_column_slice(&state.q[3..7]).norm();
            if (length - 1.0).abs() > ROUNDED {
                let text = format!("the quaternion q3..q6 has length {length}; give one of length 1");
                return Err(Error::new(ErrorKind::BadValue, text));
            }
        }
        Ok(())
    }

    fn place(&self, room: &mut Workspace, q: &[f64]) {
        let joints = &q[q.len() - self.names.len()..];
        let place = |(drive, body): (&Drive, &super::tree::Body<f64>)| {
            Place::of(body.freedom, drive.factor * joints[drive.freedom] + drive.offset)
        };
        room.data.place(&self.tree, self.drives.iter().zip(&self.tree.bodies).map(place));
    }

    /// Fills in how all joints and the base move.
    fn set_in_motion(&self, room: &mut Workspace, state: State<'_>, acceleration: &[f64], weighs: bool) {
        let first = self.first();
        for (joint, drive) in self.drives.iter().enumerate() {
            room.rates[joint] = drive.factor * state.velocity[first + drive.freedom];
            room.accelerations[joint] = drive.factor * acceleration[first + drive.freedom];
        }
        let mut pull = if weighs { self.gravity } else { Vector3::zeros() };
        let mut motion = [Six::zero(); 2];
        if self.base == Base::Floating {
            let [x, y, z, w] = [3, 4, 5, 6].map(|at| state.q[at]);
            pull = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)).inverse() * pull;
            motion = [state.velocity, acceleration].map(|list| Six {
                linear: std::array::from_fn(|i| list[i]),
                angular: std::array::from_fn(|i| list[3 + i]),
            });
        }
        (0..3).for_each(|i| motion[1].linear[i] -= pull[i]);
        room.motion = motion;
    }

    /// The torques of the independent joints and the base.
    fn newton_euler(&self, room: &mut Workspace) -> DVector<f64> {
        let Workspace { data, rates, accelerations, torques, motion, .. } = room;
        let [base, base_acceleration] = *motion;
        let motion = Motion { base, base_acceleration, rates, accelerations };
        let force = data.inverse(&self.tree, &motion, &[], torques);
        let first = self.first();
        let mut all = DVector::zeros(self.freedoms());
        (0..first).for_each(|at| all[at] = *force.at(at));
        for (drive, torque) in self.drives.iter().zip(torques) {
            all[first + drive.freedom] += drive.factor * *torque;
        }
        all
    }

    /// A matrix of all joints for the independent ones.
    fn independent(&self, all: &[f64], size: usize) -> DMatrix<f64> {
        let first = self.first();
        let freedom = |at: usize| match at.checked_sub(first) {
            Some(joint) => (first + self.drives[joint].freedom, self.drives[joint].factor),
            None => (at, 1.0),
        };
        let mut matrix = DMatrix::zeros(self.freedoms(), self.freedoms());
        for (at, entry) in all.iter().enumerate() {
            let ((row, above), (column, beside)) = (freedom(at / size), freedom(at % size));
            matrix[(row, column)] += above * beside * entry;
        }
        matrix
    }
}
