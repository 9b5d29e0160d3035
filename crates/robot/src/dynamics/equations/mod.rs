//! The equations of motion of a robot, `M q'' + C q' + N + friction = torques`. Main type: [`Equations`].

mod changes;
mod checks;
mod formal;
mod formal_forward;
mod forward;
pub(super) mod identify;
mod inverse;
mod matrices;
mod workspace;

use nalgebra::Vector3;

use self::checks::{check_drives, check_freedoms};
pub use formal::pull;
pub use formal::{Formal, FormalState, Value};
pub use workspace::Workspace;

use super::Model;
use super::masses::check_masses;
use super::recursions::{Frame, Tree};
use crate::model::{Joint, Robot};
use crate::spatial::{Pose, Wrench};
use crate::{ErrorKind, Result};

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
        self.damping * rate + self.friction * sign(rate)
    }
}

/// Which way a rate goes: nowhere at rest.
fn sign(rate: f64) -> f64 {
    if rate == 0.0 { 0.0 } else { rate.signum() }
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
    /// Whether each joint is a freedom, in order.
    is_plain: bool,
    /// By link of the robot, the joint that moves it, if one does, and where its frame stands in the joint's body.
    frames: Vec<(Option<usize>, Frame<f64>)>,
    /// The link whose frame a body's ten numbers are told in, that of the base first.
    told_in: Vec<usize>,
    /// Its name.
    told_names: Vec<String>,
    notes: Vec<String>,
}

/// What the equations are asked at: where a robot is and how it moves.
#[derive(Clone, Copy, Debug)]
pub struct State<'a> {
    /// The configuration.
    pub q: &'a [f64],
    /// The velocity.
    pub velocity: &'a [f64],
    /// What acts on links from outside, each in the frame of a link, whose place in the robot is told.
    pub outside: &'a [(usize, Wrench)],
}

impl<'a> State<'a> {
    /// That of a robot on which nothing acts from outside.
    pub fn new(q: &'a [f64], velocity: &'a [f64]) -> Self {
        State { q, velocity, outside: &[] }
    }

    /// The same, and links are pushed so, each in the frame of the link with that place in the robot.
    #[must_use]
    pub fn pushed(self, outside: &'a [(usize, Wrench)]) -> Self {
        State { outside, ..self }
    }
}

impl Equations {
    /// Those of a robot. Gravity is 9.81 m/s^2 along -z of the root's frame (of a floating root: of the world). Joints that follow others by a multiplier of zero are fixed.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`], with the link's name, for a mass below zero, and where links that are fixed to one another have together an inertia that no
    /// body has: one of a mass that is not positive, or against the triangle inequality; with the joint's name for damping, friction or a rotor below zero.
    /// [`ErrorKind::Unsupported`] for planar and floating joints that do not hang on the root.
    pub fn new(robot: &Robot, base: Base) -> Result<Self> {
        let robot = robot.with_constants_fixed()?;
        check_drives(&robot)?;
        let model = Model::new(&robot)?;
        let rounded = check_masses(&robot, &model)?;
        let mut equations = Equations::of(&robot, &model, base)?;
        equations.notes.extend(rounded);
        Ok(equations)
    }

    /// Same as [`Equations::new`], but all masses, inertias and frictions are taken unchanged, whether bodies can have them or not.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a figure beyond doubles, [`ErrorKind::Unsupported`] as [`Equations::new`].
    pub fn as_told(robot: &Robot, base: Base) -> Result<Self> {
        let robot = robot.with_constants_fixed()?;
        Equations::of(&robot, &Model::new(&robot)?, base)
    }

    /// The same of a model of the robot, which may have another root or weigh less: [`Model::rooted_at`], [`Model::halves`]. The root's frame is that of the model.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] where a joint follows one that does not move, [`ErrorKind::Unsupported`] as [`Equations::new`].
    pub fn of(robot: &Robot, model: &Model, base: Base) -> Result<Self> {
        let notes = check_freedoms(robot)?;
        let moving: Vec<&Joint> = robot.moving().into_iter().map(|place| &robot.joints()[place]).collect();
        let laws: Vec<_> = moving.iter().map(|joint| robot.law(joint)).collect();
        let leads = |(joint, law): &(&&Joint, &crate::model::Mimic)| law.leader == joint.name;
        let leading = || moving.iter().zip(&laws).filter(leads).map(|(joint, _)| joint);
        let names: Vec<String> = leading().map(|joint| joint.name.clone()).collect();
        let drive = |(joint, law): (&&Joint, &crate::model::Mimic)| {
            let [factor, offset] = law.law();
            let unknown =
                || joint.error(ErrorKind::BadValue, &format!("it follows `{}`, which does not move", law.leader));
            let freedom = names.iter().position(|name| *name == law.leader).ok_or_else(unknown)?;
            let Joint { armature, damping, friction, .. } = **joint;
            Ok(Drive { freedom, factor, offset, armature, damping, friction })
        };
        let drives: Vec<Drive> = moving.iter().zip(&laws).map(drive).collect::<Result<_>>()?;
        let leads = |(at, drive): (usize, &Drive)| drive.freedom == at && drive.factor == 1.0;
        let is_plain = drives.iter().enumerate().all(leads);
        let (tree, base_from_body) = Tree::with_poses(model);
        let frame_of = |link: usize| {
            let (body, base_from_link) = model.link(link);
            let joint = body.checked_sub(1);
            let body_from_link = joint.map_or(base_from_link, |joint| base_from_body[joint].inv_mul(&base_from_link));
            (joint, Frame::of(&body_from_link))
        };
        // Of two links at a joint one belongs to the body behind it.
        let behind = |(joint, place): (usize, usize)| {
            let (parent, child) = robot.ends(place);
            if model.link(child).0 == joint + 1 { child } else { parent }
        };
        let of_base = |link: &usize| model.link(*link) == (0, Pose::identity());
        let root = Some(robot.root_place()).filter(of_base).or_else(|| (0..robot.links().len()).find(of_base));
        let behind = robot.moving().into_iter().enumerate().map(behind);
        let told_in: Vec<usize> = std::iter::once(root.unwrap_or(robot.root_place())).chain(behind).collect();
        let told_names: Vec<String> = told_in.iter().map(|link| robot.links()[*link].name.clone()).collect();
        let leads = |(joint, drive): &(usize, &Drive)| names[drive.freedom] == moving[*joint].name;
        let leading = drives.iter().enumerate().filter(leads);
        Ok(Equations {
            tree,
            base,
            gravity: Vector3::new(0.0, 0.0, -9.81),
            links: leading.map(|(joint, _)| told_names[joint + 1].clone()).collect(),
            names,
            drives,
            is_plain,
            frames: (0..robot.links().len()).map(frame_of).collect(),
            told_names,
            told_in,
            notes,
        })
    }

    /// The same on another base.
    #[must_use]
    pub fn with_base(mut self, base: Base) -> Self {
        self.base = base;
        self
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

    /// The same without the inertia of rotors.
    #[must_use]
    pub fn without_rotors(mut self) -> Self {
        self.drives.iter_mut().for_each(|drive| drive.armature = 0.0);
        self
    }

    /// What was left out of the robot, or taken for rounding.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// The independent joints, in the order of a configuration.
    pub fn joints(&self) -> &[String] {
        &self.names
    }

    /// Whether the root moves freely.
    pub fn is_floating(&self) -> bool {
        self.base == Base::Floating
    }

    /// How many numbers a velocity has.
    pub fn freedoms(&self) -> usize {
        self.names.len() + if self.base == Base::Floating { 6 } else { 0 }
    }

    /// How many numbers a configuration has.
    pub fn coordinates(&self) -> usize {
        self.names.len() + if self.base == Base::Floating { 7 } else { 0 }
    }

    /// Where the joints stand among the freedoms.
    fn first(&self) -> usize {
        self.freedoms() - self.names.len()
    }
}
