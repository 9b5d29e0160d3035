//! The kinematic tree of the recursions: bodies with their own frames, whose z axes are the joint axes. Main type:
//! [`Tree`].

use nalgebra::{Rotation3, UnitVector3, Vector3};

use super::scalar::Scalar;
use super::six::{Frame, Mass, Matrix, Three};
use crate::dynamics::Model;
use crate::spatial::{Inertia, Pose, Screw};

/// Type of a joint: rotation about or translation along the z axis of the body's frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Freedom {
    /// Revolute.
    Turn,
    /// Prismatic.
    Slide,
}

/// A body with its joint.
#[derive(Clone, Debug, PartialEq)]
pub struct Body<S> {
    /// The joint of its parent; `None` for the base.
    pub parent: Option<usize>,
    /// The type of its joint.
    pub freedom: Freedom,
    /// Its frame in the parent's frame when the joint is at zero.
    pub frame: Frame<S>,
    /// Its inertia.
    pub mass: Mass<S>,
}

/// A base and bodies connected by joints.
#[derive(Clone, Debug, PartialEq)]
pub struct Tree<S> {
    /// The inertia of the base, in its own frame.
    pub base: Mass<S>,
    /// The body of each joint.
    pub bodies: Vec<Body<S>>,
    /// The joints, sorted topologically: each joint is after its parent.
    pub order: Vec<usize>,
}

/// The position of a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place<S> {
    /// The cosine and the sine of an angle.
    Turn([S; 2]),
    /// A displacement.
    Slide(S),
}

impl Place<f64> {
    /// The position for a joint's value \[rad or m\].
    pub fn of(freedom: Freedom, value: f64) -> Self {
        match freedom {
            Freedom::Turn => Place::Turn([value.cos(), value.sin()]),
            Freedom::Slide => Place::Slide(value),
        }
    }
}

impl<S: Scalar> Body<S> {
    /// The body's frame in its parent's frame for a joint position.
    pub fn placed(&self, place: &Place<S>) -> Frame<S> {
        let (rotation, position) = (&self.frame.rotation, &self.frame.position);
        match place {
            Place::Turn([cosine, sine]) => {
                let row = |r: &Three<S>| {
                    let [x, y, z] = r.clone();
                    let first = x.clone() * cosine.clone() + y.clone() * sine.clone();
                    [first, y * cosine.clone() - x * sine.clone(), z]
                };
                Frame { rotation: std::array::from_fn(|i| row(&rotation[i])), position: position.clone() }
            }
            Place::Slide(displacement) => {
                let moved = |i: usize| position[i].clone() + rotation[i][2].clone() * displacement.clone();
                Frame { rotation: rotation.clone(), position: std::array::from_fn(moved) }
            }
        }
    }
}

impl<S: Scalar> Tree<S> {
    /// Converts to another scalar type.
    pub fn map<T: Scalar>(&self, number: impl Fn(&S) -> T + Copy) -> Tree<T> {
        let body = |body: &Body<S>| Body {
            parent: body.parent,
            freedom: body.freedom,
            frame: body.frame.map(number),
            mass: body.mass.map(number),
        };
        Tree { base: self.base.map(number), bodies: self.bodies.iter().map(body).collect(), order: self.order.clone() }
    }
}

impl Tree<f64> {
    /// Builds the tree of a model.
    pub fn new(model: &Model) -> Self {
        Tree::with_poses(model).0
    }

    /// Builds the tree of a model. Also returns the frame of each joint's body in the base frame at the zero
    /// configuration.
    pub(crate) fn with_poses(model: &Model) -> (Self, Vec<Pose>) {
        let mut frames = vec![Pose::identity(); model.joints().len()];
        let mut bodies: Vec<Option<Body<f64>>> = vec![None; model.joints().len()];
        for &joint in &model.order {
            let own = &model.joints()[joint];
            let parent = own.parent.checked_sub(1);
            let base_from_parent = parent.map_or_else(Pose::identity, |parent| frames[parent]);
            let (freedom, base_from_body) = frame_of(&own.screw, &base_from_parent);
            frames[joint] = base_from_body;
            bodies[joint] = Some(Body {
                parent,
                freedom,
                frame: Frame::of(&base_from_parent.inv_mul(&base_from_body)),
                mass: mass(&model.bodies[joint + 1].placed(&base_from_body.inverse())),
            });
        }
        let bodies = bodies.into_iter().flatten().collect();
        (Tree { base: mass(&model.bodies[0]), bodies, order: model.order.clone() }, frames)
    }
}

impl Tree<f64> {
    /// Regroups the inertial parameters: an equivalent tree with as many zero parameters as possible. The part of an
    /// inertia that does not depend on the joint's position is moved to the parent. For a revolute joint these are the
    /// mass, its first moment along z, and the inertia of a thin rod on the axis. For a prismatic joint it is the
    /// inertia tensor. A fixed base gets no inertia. Source: M. Gautier and W. Khalil, IEEE Trans. Robotics and
    /// Automation 6 (1990).
    #[must_use]
    pub(crate) fn regrouped(&self, is_fixed: bool) -> Self {
        let mut tree = self.clone();
        for &joint in tree.order.iter().rev() {
            let Body { parent, freedom, frame, mass } = &mut tree.bodies[joint];
            let [xx, xy, yy, xz, yz, zz] = mass.tensor;
            let [x, y, z] = mass.moment;
            let carried = match freedom {
                Freedom::Turn => Mass { mass: mass.mass, moment: [0.0, 0.0, z], tensor: [yy, 0.0, yy, 0.0, 0.0, 0.0] },
                Freedom::Slide => Mass { mass: 0.0, moment: [0.0; 3], tensor: mass.tensor },
            };
            *mass = match freedom {
                Freedom::Turn => Mass { mass: 0.0, moment: [x, y, 0.0], tensor: [xx - yy, xy, 0.0, xz, yz, zz] },
                Freedom::Slide => Mass { mass: mass.mass, moment: mass.moment, tensor: [0.0; 6] },
            };
            let (carried, parent) = (carried.outward(frame), *parent);
            let below = parent.map_or(&mut tree.base, |parent| &mut tree.bodies[parent].mass);
            *below = below.plus(&carried);
        }
        if is_fixed {
            tree.base = Mass::zero();
        }
        tree
    }
}

/// The type of a joint, and a frame of its body in the base frame whose z axis is the joint's axis. Its other axes are
/// parallel to the parent's where possible.
fn frame_of(screw: &Screw, base_from_parent: &Pose) -> (Freedom, Pose) {
    let (freedom, direction, origin) = match screw {
        Screw::Prismatic(direction) => (Freedom::Slide, *direction, base_from_parent.translation.vector),
        Screw::Revolute(axis) => (Freedom::Turn, axis.direction(), axis.point().coords),
    };
    let along = base_from_parent.inverse_transform_unit_vector(&direction);
    let rotation = base_from_parent.rotation * nalgebra::UnitQuaternion::from_rotation_matrix(&upright(&along));
    (freedom, Pose::from_parts(origin.into(), rotation))
}

/// A rotation whose last column is the given direction. For a coordinate axis its columns are coordinate axes, so that
/// most entries are zero.
fn upright(direction: &UnitVector3<f64>) -> Rotation3<f64> {
    let farthest = direction.iamax();
    let across = Vector3::ith((farthest + 1) % 3, 1.0);
    let first = (across - direction.into_inner() * across.dot(direction)).normalize();
    Rotation3::from_basis_unchecked(&[first, direction.cross(&first), direction.into_inner()])
}

impl Frame<f64> {
    /// Converts a pose.
    pub(crate) fn of(pose: &Pose) -> Self {
        let rotation = pose.rotation.to_rotation_matrix();
        let entry = |i: usize, j: usize| rounded(rotation[(i, j)]);
        let rotation: Matrix<f64> = std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)));
        Frame { rotation, position: std::array::from_fn(|i| without_rounding(pose.translation.vector[i], 1.0)) }
    }
}

/// Threshold for values that are zero up to rounding along a chain: relative to one in rotations, to a metre, and to a
/// body's largest parameter.
const ROUNDING: f64 = 1e-13;

/// A rotation's entry, rounded to an integer if they differ by rounding only.
fn rounded(entry: f64) -> f64 {
    if (entry - entry.round()).abs() <= ROUNDING { entry.round() } else { entry }
}

/// Zero if the entry is a rounding error relative to this size, else the entry.
fn without_rounding(entry: f64, size: f64) -> f64 {
    if entry.abs() <= ROUNDING * size { 0.0 } else { entry }
}

/// A body's ten inertial parameters about the origin of the frame in which they are given.
fn mass(inertia: &Inertia) -> Mass<f64> {
    let generalised = inertia.generalised();
    let entry = |i: usize, j: usize| generalised[(3 + i, 3 + j)];
    let tensor = [entry(0, 0), entry(1, 0), entry(1, 1), entry(2, 0), entry(2, 1), entry(2, 2)];
    let moment = inertia.centre_of_mass().coords * inertia.mass();
    let size = tensor.iter().fold(0.0, |size: f64, entry| size.max(entry.abs()));
    Mass {
        mass: inertia.mass(),
        moment: std::array::from_fn(|i| without_rounding(moment[i], inertia.mass())),
        tensor: tensor.map(|entry| without_rounding(entry, size)),
    }
}
