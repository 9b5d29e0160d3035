//! The mechanical model of a robot: bodies, each moved by a joint with one degree of freedom, in doubles. Main type:
//! [`Model`].
//!
//! The motion of a body is the product of exponentials along its path, as in RH0 (2-20), after the pose of the base.

use crate::kinematics::jacobian::{self, Jacobian};
use crate::model::{self, JointType, Robot};
use crate::spatial::exact::normalized;
use crate::spatial::{Inertia, Pose, Screw};
use crate::{Error, ErrorKind, Result};

/// A joint of a model, which moves a body relative to its parent.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ModelJoint {
    /// Its name in the robot.
    pub name: String,
    /// The parent body; 0 is the base, `k + 1` the body of joint `k`.
    pub parent: usize,
    /// Its screw, in the base frame at the zero configuration.
    pub screw: Screw,
}

/// The mechanical model of a robot in metres, kilograms and radians. The base is the root link with all links fixed to
/// it. Each revolute or prismatic joint moves a body: joint `k` moves body `k + 1`. Joints are in the order of
/// [`Robot::moving`]. The model is immutable.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    pub(super) joints: Vec<ModelJoint>,
    /// The joints, sorted topologically: each joint is after its parent.
    pub(super) order: Vec<usize>,
    /// The inertia of each body, in the base frame at the zero configuration.
    pub(super) bodies: Vec<Inertia>,
    /// The body of each link of the robot, and the link's frame in the base frame at the zero configuration.
    pub(super) links: Vec<(usize, Pose)>,
    pub(super) mass: f64,
}

impl Model {
    /// Builds the model of `robot`. Floating and planar joints are fixed.
    ///
    /// # Errors
    /// Those of [`Robot::check`]; [`ErrorKind::BadValue`] when a frame or mass is outside the range of doubles.
    pub fn new(robot: &Robot) -> Result<Self> {
        robot.check()?;
        let moving = robot.moving();
        let still = Screw::Prismatic(nalgebra::Vector3::x_axis());
        let joint = |place: &usize| ModelJoint { name: robot.joints()[*place].name.clone(), parent: 0, screw: still };
        let mut model = Model {
            joints: moving.iter().map(joint).collect(),
            order: Vec::with_capacity(moving.len()),
            bodies: vec![Inertia::none(); moving.len() + 1],
            links: vec![(0, Pose::identity()); robot.links().len()],
            mass: 0.0,
        };
        for &place in robot.order() {
            model.append(robot, place, &moving)?;
        }
        for (link, (body, base_from_link)) in robot.links().iter().zip(&model.links) {
            let inertia = link.inertia().placed(base_from_link);
            model.bodies[*body] = model.bodies[*body].with(&inertia);
        }
        model.mass = model.bodies.iter().map(Inertia::mass).sum();
        let is_finite = |inertia: &Inertia| inertia.generalised().iter().all(|x| x.is_finite());
        if model.bodies.iter().all(is_finite) {
            return Ok(model);
        }
        Err(Error::new(ErrorKind::BadValue, "a mass or a frame exceeds the range of doubles; give smaller numbers"))
    }

    /// Appends the child link of the robot's joint `place`. Its parent is already in the model. `moving` has the
    /// indices of the movable joints.
    fn append(&mut self, robot: &Robot, place: usize, moving: &[usize]) -> Result<()> {
        let joint = &robot.joints()[place];
        let (parent, child) = robot.ends(place);
        let (mut body, base_from_parent) = self.links[parent];
        let base_from_joint = base_from_parent * joint.origin.pose();
        if let Ok(number) = moving.binary_search(&place) {
            self.joints[number].screw = screw(joint, &base_from_joint)?;
            self.joints[number].parent = body;
            self.order.push(number);
            body = number + 1;
        }
        self.links[child] = (body, base_from_joint);
        Ok(())
    }

    /// The joints, in the order of a configuration `q`.
    pub fn joints(&self) -> &[ModelJoint] {
        &self.joints
    }

    /// The index of the joint `name` in a configuration `q`.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] when no revolute or prismatic joint has this name.
    pub fn joint(&self, name: &str) -> Result<usize> {
        let unknown =
            || Error::new(ErrorKind::UnknownName, format!("there is no revolute or prismatic joint `{name}`"));
        self.joints.iter().position(|joint| joint.name == name).ok_or_else(unknown)
    }

    /// The inertia of a body, in the base frame at the zero configuration: 0 is the base, `k + 1` is moved by joint
    /// `k`.
    ///
    /// # Panics
    /// When there is no such body.
    #[doc(hidden)]
    pub fn inertia_of(&self, body: usize) -> &Inertia {
        &self.bodies[body]
    }

    /// The body that a link of the robot belongs to, and the link's frame in the base frame at the zero configuration.
    ///
    /// # Panics
    /// When there is no such link.
    pub fn link(&self, link: usize) -> (usize, Pose) {
        self.links[link]
    }

    /// The mass of all bodies \[kg\].
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// The joints from the base to a body, in this order.
    ///
    /// # Panics
    /// When there is no such body.
    #[doc(hidden)]
    pub fn path(&self, body: usize) -> Vec<usize> {
        let up = |body: usize| body.checked_sub(1);
        let mut path: Vec<usize> = std::iter::successors(up(body), |joint| up(self.joints[*joint].parent)).collect();
        path.reverse();
        path
    }

    /// The body Jacobian at `q` of a frame of `body`, RH0 (2-24): 6 x n, zero in the columns of joints that do not move
    /// it. `base_from_frame` is the pose of the frame at the zero configuration.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when there is no such body, or unless `q` has one finite value per joint.
    pub fn body_jacobian(&self, body: usize, base_from_frame: &Pose, q: &[f64]) -> Result<Jacobian> {
        self.check(q)?;
        self.check_body(body)?;
        let path = self.path(body);
        let screws: Vec<Screw> = path.iter().map(|joint| self.joints[*joint].screw).collect();
        let values: Vec<f64> = path.iter().map(|joint| q[*joint]).collect();
        let moving = jacobian::body(&screws, base_from_frame, &values)?;
        let mut jacobian = Jacobian::zeros(q.len());
        for (joint, column) in path.iter().zip(moving.column_iter()) {
            jacobian.set_column(*joint, &column);
        }
        Ok(jacobian)
    }

    pub(super) fn check_body(&self, body: usize) -> Result<()> {
        let most = self.bodies.len() - 1;
        let text = || format!("there is no body {body}; the base is 0, the others are counted from 1 to {most}");
        if body <= most { Ok(()) } else { Err(Error::new(ErrorKind::BadValue, text())) }
    }

    /// Checks that `q` has one finite value for each joint.
    pub(super) fn check(&self, q: &[f64]) -> Result<()> {
        let text = if q.len() != self.joints.len() {
            format!("{} joint values are given; the robot has {} joints", q.len(), self.joints.len())
        } else if let Some(joint) = q.iter().position(|value| !value.is_finite()) {
            format!("joint `{}`: the value {} is not finite", self.joints[joint].name, q[joint])
        } else {
            return Ok(());
        };
        Err(Error::new(ErrorKind::BadValue, text))
    }
}

/// The screw of a revolute or prismatic joint with the frame `base_from_joint`.
fn screw(joint: &model::Joint, base_from_joint: &Pose) -> Result<Screw> {
    let direction = base_from_joint.rotation * normalized(&joint.axis).into_inner();
    let screw = match joint.kind {
        JointType::Prismatic => Screw::prismatic(direction),
        _ => Screw::revolute(direction, base_from_joint.translation.vector.into()),
    };
    screw.map_err(|error| joint.error(error.kind(), error.message()))
}
