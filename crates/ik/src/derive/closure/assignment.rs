//! The values of the joints and of the target at which relations are evaluated.

use super::arithmetic::Arithmetic;
use super::mechanism::Mechanism;
use super::vector;
use crate::{Error, ErrorKind, Result};
use groebot_robot::kinematics::Task;

/// The known value of a joint.
#[derive(Clone, Debug, PartialEq)]
pub enum JointValue<V> {
    /// No known value: the joint's unknowns remain.
    Unknown,
    /// The cosine c of its angle and s', the sine divided by the length of the axis vector.
    Angle {
        /// c.
        cosine: V,
        /// s'.
        sine: V,
    },
    /// d', its displacement divided by the length of the axis vector.
    Length(V),
}

/// The part of the target's rotation that the task specifies.
#[derive(Clone, Debug, PartialEq)]
pub enum TargetRotation<V> {
    /// No part.
    Unspecified,
    /// The image of the direction that the task orients, [`Mechanism::aim`].
    Direction([V; 3]),
    /// Its matrix, base_from_tip, by rows.
    Matrix([[V; 3]; 3]),
}

/// The target T: the parts of the tip's position and rotation that the task specifies.
#[derive(Clone, Debug, PartialEq)]
pub struct Target<V> {
    /// The position of the tip. If the task does not specify it, the position in the zero configuration.
    pub position: [V; 3],
    /// The rotation.
    pub rotation: TargetRotation<V>,
}

/// The values of the joints and of the target.
#[derive(Clone, Debug, PartialEq)]
pub struct Assignment<V> {
    /// One for each joint.
    pub joints: Vec<JointValue<V>>,
    /// The target.
    pub target: Target<V>,
}

impl<V: Clone> Target<V> {
    /// The target with these `parameters`, in the order of [`Mechanism::parameters`].
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] if their number differs from that of the task.
    pub fn new<A: Arithmetic<Value = V>>(mechanism: &Mechanism, parameters: &[V], arithmetic: &mut A) -> Result<Self> {
        let wanted = mechanism.parameters().len();
        if parameters.len() != wanted {
            let text = format!("{} numbers of the target are given; the task has {wanted}", parameters.len());
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let mut position = mechanism.tip_point().each_ref().map(|entry| arithmetic.rational(entry));
        let rotation = match mechanism.seen() {
            Task::Pose | Task::Ray | Task::PositionPitchRoll => {
                position.clone_from_slice(&parameters[..3]);
                TargetRotation::Matrix(std::array::from_fn(|i| {
                    std::array::from_fn(|j| parameters[3 + 3 * i + j].clone())
                }))
            }
            Task::Position => {
                position.clone_from_slice(parameters);
                TargetRotation::Unspecified
            }
            Task::PlanarPosition { plane } => {
                plane.coordinates().into_iter().zip(parameters).for_each(|(k, value)| position[k] = value.clone());
                TargetRotation::Unspecified
            }
            Task::Direction => TargetRotation::Direction(std::array::from_fn(|k| parameters[k].clone())),
            Task::Rotation => {
                TargetRotation::Matrix(std::array::from_fn(|i| std::array::from_fn(|j| parameters[3 * i + j].clone())))
            }
            Task::PositionYaw { axis } => {
                position.clone_from_slice(&parameters[..3]);
                TargetRotation::Matrix(about(axis.coordinate(), &parameters[3], &parameters[4], arithmetic))
            }
            Task::PlanarPose { plane } => {
                plane.coordinates().into_iter().zip(parameters).for_each(|(k, value)| position[k] = value.clone());
                TargetRotation::Matrix(about(plane.normal(), &parameters[2], &parameters[3], arithmetic))
            }
        };
        Ok(Target { position, rotation })
    }
}

/// The rotation about a coordinate axis with this cosine and sine.
fn about<A: Arithmetic>(normal: usize, c: &A::Value, s: &A::Value, arithmetic: &mut A) -> [[A::Value; 3]; 3] {
    let (a, b) = ((normal + 1) % 3, (normal + 2) % 3);
    let mut rows = vector::identity().map(|row| row.map(|entry| arithmetic.rational(&entry)));
    rows[a][a] = c.clone();
    rows[b][b] = c.clone();
    rows[b][a] = s.clone();
    rows[a][b] = arithmetic.neg(s);
    rows
}
