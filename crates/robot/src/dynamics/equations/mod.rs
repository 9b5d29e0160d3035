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

/// Whether the base is fixed or floating.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Base {
    /// Fixed base. A configuration has one value for each independent joint.
    Fixed,
    /// Floating base. A configuration begins with the root's position (x, y, z) and orientation (a quaternion x, y, z,
    /// w) in the world frame. A velocity begins with the root's linear and angular velocity in its own frame.
    Floating,
}

/// The drive of a joint, with rotor and friction. The joint's value is `factor` times that of a degree of freedom, plus
/// `offset`.
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
    /// The friction torque at a joint velocity: viscous and Coulomb friction.
    fn friction(&self, rate: f64) -> f64 {
        self.damping * rate + self.friction * sign(rate)
    }
}

/// The sign of a velocity; zero at rest.
fn sign(rate: f64) -> f64 {
    if rate == 0.0 { 0.0 } else { rate.signum() }
}

/// The equations of motion of a robot in metres, kilograms, seconds and radians. They are immutable; methods write to a
/// [`Workspace`] only.
#[derive(Clone, Debug, PartialEq)]
pub struct Equations {
    tree: Tree<f64>,
    base: Base,
    /// Gravity in the frame of the root at the zero configuration.
    gravity: Vector3<f64>,
    names: Vec<String>,
    /// The child link of each independent joint.
    links: Vec<String>,
    drives: Vec<Drive>,
    /// Whether each joint is a degree of freedom, in order: no mimic joints.
    is_plain: bool,
    /// For each link of the robot, the joint that moves it, if any, and the link's frame in the frame of that joint's
    /// body.
    frames: Vec<(Option<usize>, Frame<f64>)>,
    /// The link in whose frame the ten inertial parameters of each body are given, the base first.
    parameter_links: Vec<usize>,
    /// The names of these links.
    parameter_link_names: Vec<String>,
    notes: Vec<String>,
}

/// A state: configuration, velocity and external wrenches.
#[derive(Clone, Copy, Debug)]
pub struct State<'a> {
    /// The configuration.
    pub q: &'a [f64],
    /// The velocity.
    pub velocity: &'a [f64],
    /// External wrenches: the index of a link in the robot, and the wrench in the frame of that link.
    pub outside: &'a [(usize, Wrench)],
}

impl<'a> State<'a> {
    /// Builds a state without external wrenches.
    pub fn new(q: &'a [f64], velocity: &'a [f64]) -> Self {
        State { q, velocity, outside: &[] }
    }

    /// Adds external wrenches, each in the frame of the link with the given index in the robot.
    #[must_use]
    pub fn with_wrenches(self, outside: &'a [(usize, Wrench)]) -> Self {
        State { outside, ..self }
    }
}

impl Equations {
    /// Builds the equations of a robot. Gravity is 9.81 m/s^2 along -z of the root's frame; for a floating base, of the
    /// world frame. Mimic joints with a multiplier of zero are fixed.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`], with the link's name, for a negative mass, and where links that are fixed to one
    /// another have an impossible total inertia: a mass that is not positive, or a violation of the triangle
    /// inequality. With the joint's name, for negative damping, friction or rotor inertia. [`ErrorKind::Unsupported`]
    /// for planar and floating joints that are not attached to the root.
    pub fn new(robot: &Robot, base: Base) -> Result<Self> {
        let robot = robot.with_constants_fixed()?;
        check_drives(&robot)?;
        let model = Model::new(&robot)?;
        let rounded = check_masses(&robot, &model)?;
        let mut equations = Equations::of(&robot, &model, base)?;
        equations.notes.extend(rounded);
        Ok(equations)
    }

    /// Same as [`Equations::new`], but without the checks of masses, inertias and friction coefficients.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a number outside the range of doubles, [`ErrorKind::Unsupported`] as in
    /// [`Equations::new`].
    #[doc(hidden)]
    pub fn unchecked(robot: &Robot, base: Base) -> Result<Self> {
        let robot = robot.with_constants_fixed()?;
        Equations::of(&robot, &Model::new(&robot)?, base)
    }

    /// Builds the equations of a model of the robot, which may have another root or smaller masses:
    /// [`Model::rooted_at`], [`Model::halves`]. The root's frame is that of the model.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] where a joint mimics a fixed one, [`ErrorKind::Unsupported`] as in [`Equations::new`].
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
                || joint.error(ErrorKind::BadValue, &format!("it mimics `{}`, which does not move", law.leader));
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
        // Of the two links at a joint, the child belongs to the joint's body.
        let child_link = |(joint, place): (usize, usize)| {
            let (parent, child) = robot.ends(place);
            if model.link(child).0 == joint + 1 { child } else { parent }
        };
        let of_base = |link: &usize| model.link(*link) == (0, Pose::identity());
        let root = Some(robot.root_place()).filter(of_base).or_else(|| (0..robot.links().len()).find(of_base));
        let child_link = robot.moving().into_iter().enumerate().map(child_link);
        let parameter_links: Vec<usize> =
            std::iter::once(root.unwrap_or(robot.root_place())).chain(child_link).collect();
        let parameter_link_names: Vec<String> =
            parameter_links.iter().map(|link| robot.links()[*link].name.clone()).collect();
        let leads = |(joint, drive): &(usize, &Drive)| names[drive.freedom] == moving[*joint].name;
        let leading = drives.iter().enumerate().filter(leads);
        Ok(Equations {
            tree,
            base,
            gravity: Vector3::new(0.0, 0.0, -9.81),
            links: leading.map(|(joint, _)| parameter_link_names[joint + 1].clone()).collect(),
            names,
            drives,
            is_plain,
            frames: (0..robot.links().len()).map(frame_of).collect(),
            parameter_link_names,
            parameter_links,
            notes,
        })
    }

    /// Same equations, but with another base.
    #[must_use]
    pub fn with_base(mut self, base: Base) -> Self {
        self.base = base;
        self
    }

    /// Same equations, but with another gravity \[m/s^2\].
    #[must_use]
    pub fn with_gravity(mut self, gravity: Vector3<f64>) -> Self {
        self.gravity = gravity;
        self
    }

    /// Same equations, but without joint friction.
    #[must_use]
    pub fn without_friction(mut self) -> Self {
        self.drives.iter_mut().for_each(|drive| (drive.damping, drive.friction) = (0.0, 0.0));
        self
    }

    /// Same equations, but without rotor inertia.
    #[must_use]
    pub(crate) fn without_rotors(mut self) -> Self {
        self.drives.iter_mut().for_each(|drive| drive.armature = 0.0);
        self
    }

    /// Notes: parts of the robot that were ignored, and values that were treated as rounding errors.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// The names of the independent joints, in the order of a configuration.
    pub fn joints(&self) -> &[String] {
        &self.names
    }

    /// Whether the base is floating.
    pub fn is_floating(&self) -> bool {
        self.base == Base::Floating
    }

    /// Number of degrees of freedom: the length of a velocity.
    pub fn freedoms(&self) -> usize {
        self.names.len() + if self.base == Base::Floating { 6 } else { 0 }
    }

    /// Length of a configuration.
    pub fn coordinates(&self) -> usize {
        self.names.len() + if self.base == Base::Floating { 7 } else { 0 }
    }

    /// Index of the first joint among the degrees of freedom.
    fn first(&self) -> usize {
        self.freedoms() - self.names.len()
    }
}
