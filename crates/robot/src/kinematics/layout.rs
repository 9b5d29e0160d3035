//! The numbers of a task's target. Main type: [`Layout`].

use std::fmt;

use nalgebra::{Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};

use super::task::{BaseAxis, Plane, Task};
use super::{LengthUnit, Target};
use crate::spatial::Pose;
use crate::{Error, ErrorKind, Result};

/// The physical quantity of a number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Quantity {
    /// A length, in the length unit of its description.
    #[default]
    Length,
    /// An angle \[rad\].
    Angle,
    /// A dimensionless number.
    Number,
}

impl Quantity {
    /// The symbol of its unit, with lengths in `length`: `m`, `mm`, `rad`, or empty.
    pub fn unit(self, length: LengthUnit) -> &'static str {
        match self {
            Quantity::Length => length.symbol(),
            Quantity::Angle => "rad",
            Quantity::Number => "",
        }
    }
}

/// A number of a target: a quantity of the tip in the base frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TargetNumber {
    /// A coordinate of the tip's position.
    Position(BaseAxis),
    /// An entry of the rotation matrix base_from_tip.
    Rotation {
        /// Its row.
        row: BaseAxis,
        /// Its column.
        column: BaseAxis,
    },
    /// A coordinate of the unit vector along the task's direction.
    Direction(BaseAxis),
    /// The angle about the normal of the task's plane, right-handed, from the zero configuration.
    PlaneAngle(Plane),
    /// The pitch of R = Rz(yaw) Ry(pitch) Rx(roll).
    Pitch,
    /// The roll of R = Rz(yaw) Ry(pitch) Rx(roll).
    Roll,
    /// The angle of the task's direction about an axis, measured from [`BaseAxis::across`].
    Yaw(BaseAxis),
}

impl TargetNumber {
    /// Its name as an input of a derived solver: `px`, `r11`, `dx`, `phi`, `pitch`, `roll`, `yaw`, `yaw_x`.
    pub fn name(self) -> String {
        match self {
            TargetNumber::Position(axis) => format!("p{}", axis.name()),
            TargetNumber::Rotation { row, column } => format!("r{}{}", row.coordinate() + 1, column.coordinate() + 1),
            TargetNumber::Direction(axis) => format!("d{}", axis.name()),
            TargetNumber::PlaneAngle(_) => "phi".to_owned(),
            TargetNumber::Pitch => "pitch".to_owned(),
            TargetNumber::Roll => "roll".to_owned(),
            TargetNumber::Yaw(BaseAxis::Z) => "yaw".to_owned(),
            TargetNumber::Yaw(axis) => format!("yaw_{}", axis.name()),
        }
    }

    /// Its physical quantity.
    pub fn quantity(self) -> Quantity {
        match self {
            TargetNumber::Position(_) => Quantity::Length,
            TargetNumber::Rotation { .. } | TargetNumber::Direction(_) => Quantity::Number,
            TargetNumber::PlaneAngle(_) | TargetNumber::Pitch | TargetNumber::Roll | TargetNumber::Yaw(_) => {
                Quantity::Angle
            }
        }
    }
}

/// Its meaning: `x of the position`.
impl fmt::Display for TargetNumber {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            TargetNumber::Position(axis) => write!(f, "{} of the position", axis.name()),
            TargetNumber::Rotation { row, column } => {
                write!(f, "row {}, column {} of the rotation matrix", row.coordinate() + 1, column.coordinate() + 1)
            }
            TargetNumber::Direction(axis) => write!(f, "{} of the direction", axis.name()),
            TargetNumber::PlaneAngle(plane) => write!(f, "angle about {}", BaseAxis::ALL[plane.normal()].name()),
            TargetNumber::Pitch => f.write_str("pitch"),
            TargetNumber::Roll => f.write_str("roll"),
            TargetNumber::Yaw(axis) => write!(f, "angle of the direction about {}", axis.name()),
        }
    }
}

use BaseAxis::{X, Y, Z};
use TargetNumber::{Direction, Pitch, PlaneAngle, Position, Roll, Yaw};

const fn entry(row: BaseAxis, column: BaseAxis) -> TargetNumber {
    TargetNumber::Rotation { row, column }
}

const fn planar(first: BaseAxis, second: BaseAxis, plane: Plane) -> [TargetNumber; 3] {
    [Position(first), Position(second), PlaneAngle(plane)]
}

const fn with_yaw(axis: BaseAxis) -> [TargetNumber; 4] {
    [Position(X), Position(Y), Position(Z), Yaw(axis)]
}

/// A position, then a rotation matrix by rows.
#[rustfmt::skip]
const POSE: [TargetNumber; 12] = [
    Position(X), Position(Y), Position(Z),
    entry(X, X), entry(X, Y), entry(X, Z),
    entry(Y, X), entry(Y, Y), entry(Y, Z),
    entry(Z, X), entry(Z, Y), entry(Z, Z),
];
const RAY: [TargetNumber; 6] = [Position(X), Position(Y), Position(Z), Direction(X), Direction(Y), Direction(Z)];
const PITCH_AND_ROLL: [TargetNumber; 5] = [Position(X), Position(Y), Position(Z), Pitch, Roll];
/// By plane, in the order of [`Plane`].
const PLANAR: [[TargetNumber; 3]; 3] = [planar(X, Y, Plane::Xy), planar(X, Z, Plane::Xz), planar(Y, Z, Plane::Yz)];
/// By axis.
const WITH_YAW: [[TargetNumber; 4]; 3] = [with_yaw(X), with_yaw(Y), with_yaw(Z)];

/// The numbers of a task's target in the order of a derived solver, and their values in a [`Target`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    task: Task,
    numbers: &'static [TargetNumber],
}

impl Task {
    /// The numbers of a target: a position, then a rotation row by row, a direction, or angles.
    pub fn layout(self) -> Layout {
        let numbers: &[TargetNumber] = match self {
            Task::Pose => &POSE,
            Task::Position => &POSE[..3],
            Task::Rotation => &POSE[3..],
            Task::Ray => &RAY,
            Task::Direction => &RAY[3..],
            Task::PositionPitchRoll => &PITCH_AND_ROLL,
            Task::PositionYaw { axis } => &WITH_YAW[axis.coordinate()],
            Task::PlanarPosition { plane } => &PLANAR[plane as usize][..2],
            Task::PlanarPose { plane } => &PLANAR[plane as usize],
        };
        Layout { task: self, numbers }
    }
}

impl Layout {
    /// The task.
    pub fn task(&self) -> Task {
        self.task
    }

    /// The numbers, in order.
    pub fn numbers(&self) -> &'static [TargetNumber] {
        self.numbers
    }

    /// The names of the numbers, in order.
    pub fn names(&self) -> Vec<String> {
        self.numbers.iter().map(|number| number.name()).collect()
    }

    /// The index of a number of the task.
    pub fn place(&self, number: TargetNumber) -> Option<usize> {
        self.numbers.iter().position(|own| *own == number)
    }

    /// The index of the first of the nine entries of a rotation matrix, which are stored by rows.
    pub fn rotation(&self) -> Option<usize> {
        self.place(entry(X, X))
    }

    /// The index of the first of the three coordinates of a direction.
    pub fn direction(&self) -> Option<usize> {
        self.place(Direction(X))
    }

    /// The number of lengths, which come first.
    pub fn lengths(&self) -> usize {
        self.numbers.iter().take_while(|number| number.quantity() == Quantity::Length).count()
    }

    /// The values of the numbers in `target`.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a target of another task.
    pub fn values(&self, target: &Target) -> Result<Vec<f64>> {
        let parts = Parts::of(target);
        let value = |number: &TargetNumber| parts.value(*number, self.task);
        let values = target.is_of(self.task).then(|| self.numbers.iter().map(value).collect::<Option<_>>());
        values.flatten().ok_or_else(|| {
            let text = format!("the task is `{}`; give a target of that kind", self.task.name());
            Error::new(ErrorKind::BadValue, text)
        })
    }

    /// The target with these values of the numbers. A rotation matrix is not checked.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a wrong number of values.
    pub fn target(&self, values: &[f64]) -> Result<Target> {
        if values.len() != self.numbers.len() {
            let text = format!("{} numbers are not a target of the task `{}`", values.len(), self.task.name());
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let value = |number: TargetNumber| self.place(number).map_or(0.0, |place| values[place]);
        let vector = |of: fn(BaseAxis) -> TargetNumber| Vector3::from(BaseAxis::ALL.map(|axis| value(of(axis))));
        let (point, direction) = (vector(Position), vector(Direction));
        let entry = |row: usize, column: usize| value(entry(BaseAxis::ALL[row], BaseAxis::ALL[column]));
        let rotation = || {
            let matrix = Rotation3::from_matrix_unchecked(Matrix3::from_fn(entry));
            UnitQuaternion::from_rotation_matrix(&matrix)
        };
        let in_plane = |plane: Plane| plane.coordinates().map(|axis| point[axis]);
        Ok(match self.task {
            Task::Pose => Target::Pose(Pose::from_parts(Translation3::from(point), rotation())),
            Task::Position => Target::Position(point.into()),
            Task::Ray => Target::Ray { point: point.into(), direction },
            Task::Direction => Target::Direction(direction),
            Task::Rotation => Target::Rotation(rotation()),
            Task::PositionPitchRoll => {
                Target::PositionPitchRoll { point: point.into(), pitch: value(Pitch), roll: value(Roll) }
            }
            Task::PositionYaw { axis } => Target::PositionYaw { point: point.into(), yaw: value(Yaw(axis)) },
            Task::PlanarPosition { plane } => Target::PlanarPosition(in_plane(plane)),
            Task::PlanarPose { plane } => {
                let [x, y] = in_plane(plane);
                Target::PlanarPose([x, y, value(PlaneAngle(plane))])
            }
        })
    }
}

/// The quantities of a target, each computed once.
#[derive(Default)]
struct Parts {
    position: Option<Vector3<f64>>,
    rotation: Option<Matrix3<f64>>,
    direction: Option<Vector3<f64>>,
    /// The two coordinates in a plane.
    in_plane: Option<[f64; 2]>,
    /// The angle of a planar pose or a yaw.
    angle: Option<f64>,
    pitch_and_roll: Option<[f64; 2]>,
}

impl Parts {
    fn of(target: &Target) -> Self {
        let none = Parts::default();
        let matrix = |rotation: &UnitQuaternion<f64>| Some(rotation.to_rotation_matrix().into_inner());
        match target {
            Target::Pose(pose) => {
                Parts { position: Some(pose.translation.vector), rotation: matrix(&pose.rotation), ..none }
            }
            Target::Position(point) => Parts { position: Some(point.coords), ..none },
            Target::Ray { point, direction } => {
                Parts { position: Some(point.coords), direction: Some(*direction), ..none }
            }
            Target::Direction(direction) => Parts { direction: Some(*direction), ..none },
            Target::Rotation(rotation) => Parts { rotation: matrix(rotation), ..none },
            Target::PositionPitchRoll { point, pitch, roll } => {
                Parts { position: Some(point.coords), pitch_and_roll: Some([*pitch, *roll]), ..none }
            }
            Target::PositionYaw { point, yaw } => Parts { position: Some(point.coords), angle: Some(*yaw), ..none },
            Target::PlanarPosition(at) => Parts { in_plane: Some(*at), ..none },
            Target::PlanarPose([x, y, phi]) => Parts { in_plane: Some([*x, *y]), angle: Some(*phi), ..none },
        }
    }

    /// The value of a number of `task`.
    fn value(&self, number: TargetNumber, task: Task) -> Option<f64> {
        match number {
            Position(axis) => match (self.position, task.plane()) {
                (Some(position), _) => Some(position[axis.coordinate()]),
                (None, plane) => {
                    let place = plane?.coordinates().iter().position(|own| *own == axis.coordinate())?;
                    self.in_plane.map(|at| at[place])
                }
            },
            TargetNumber::Rotation { row, column } => {
                self.rotation.map(|matrix| matrix[(row.coordinate(), column.coordinate())])
            }
            Direction(axis) => self.direction.map(|direction| direction[axis.coordinate()]),
            PlaneAngle(_) | Yaw(_) => self.angle,
            Pitch => self.pitch_and_roll.map(|[pitch, _]| pitch),
            Roll => self.pitch_and_roll.map(|[_, roll]| roll),
        }
    }
}
