//! The task of a chain's tip. Main type: [`Task`].

use std::fmt;

use serde::{Deserialize, Serialize};

use super::ExactVector;
use crate::spatial::exact::vector::{show, unit};

/// A coordinate plane of the base frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Plane {
    /// z = const.
    Xy,
    /// y = const.
    Xz,
    /// x = const.
    Yz,
}

impl Plane {
    /// The index (0, 1, 2 for x, y, z) of the coordinate along its normal.
    pub fn normal(self) -> usize {
        match self {
            Plane::Xy => 2,
            Plane::Xz => 1,
            Plane::Yz => 0,
        }
    }

    /// The indices of its two coordinates, in the order of its name.
    pub fn coordinates(self) -> [usize; 2] {
        match self {
            Plane::Xy => [0, 1],
            Plane::Xz => [0, 2],
            Plane::Yz => [1, 2],
        }
    }

    /// `xy`, `xz` or `yz`.
    pub fn name(self) -> &'static str {
        match self {
            Plane::Xy => "xy",
            Plane::Xz => "xz",
            Plane::Yz => "yz",
        }
    }
}

/// A coordinate axis of the base frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum BaseAxis {
    /// x.
    X,
    /// y.
    Y,
    /// z.
    Z,
}

impl BaseAxis {
    /// All base axes.
    pub const ALL: [BaseAxis; 3] = [BaseAxis::X, BaseAxis::Y, BaseAxis::Z];

    /// The index of its coordinate: 0, 1, 2 for x, y, z.
    pub fn coordinate(self) -> usize {
        self as usize
    }

    /// The coordinate axis from which an angle about this axis is measured, and the one at a quarter turn.
    pub fn across(self) -> [usize; 2] {
        [1, 2].map(|step| (self.coordinate() + step) % 3)
    }

    /// `x`, `y` or `z`.
    pub fn name(self) -> &'static str {
        ["x", "y", "z"][self.coordinate()]
    }
}

/// The task: which numbers of the tip's pose a target specifies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Task {
    /// The position: three numbers.
    Position,
    /// The position in a plane that the whole chain does not leave: two numbers.
    PlanarPosition {
        /// The plane.
        plane: Plane,
    },
    /// The position in a plane and the angle about its normal: three numbers.
    PlanarPose {
        /// The plane.
        plane: Plane,
    },
    /// Position and orientation.
    Pose,
    /// The position, and the direction of [`super::Chain::direction`]: five numbers.
    Ray,
    /// The direction of [`super::Chain::direction`]: two numbers.
    Direction,
    /// The orientation: three numbers.
    Rotation,
    /// The position, and pitch and roll of the tip for any yaw, in R = Rz(yaw) Ry(pitch) Rx(roll): five numbers.
    PositionPitchRoll,
    /// The position, and the angle of [`super::Chain::direction`] about an axis of the base: four numbers. The tip
    /// rotates about this axis only, and the direction is perpendicular to it. The angle is measured from x about z,
    /// from y about x, from z about y.
    PositionYaw {
        /// The axis.
        axis: BaseAxis,
    },
}

impl Task {
    /// The plane of a planar task.
    pub fn plane(self) -> Option<Plane> {
        match self {
            Task::PlanarPosition { plane } | Task::PlanarPose { plane } => Some(plane),
            _ => None,
        }
    }

    /// The axis of a position with an angle about it.
    pub fn axis(self) -> Option<BaseAxis> {
        match self {
            Task::PositionYaw { axis } => Some(axis),
            _ => None,
        }
    }

    /// The default direction in the tip frame: z, or the axis from which an angle about an axis is measured.
    pub fn usual_direction(self) -> ExactVector {
        let along = self.axis().map_or(2, |axis| axis.across()[0]);
        unit(along)
    }

    /// The number of independent values: the maximum number of joints that the task determines.
    pub fn freedoms(self) -> usize {
        match self {
            Task::Pose => 6,
            Task::Ray | Task::PositionPitchRoll => 5,
            Task::PositionYaw { .. } => 4,
            Task::Position | Task::PlanarPose { .. } | Task::Rotation => 3,
            Task::PlanarPosition { .. } | Task::Direction => 2,
        }
    }

    /// Every task, in each plane and about each axis.
    pub fn all() -> Vec<Task> {
        let mut all =
            vec![Task::Pose, Task::Position, Task::Ray, Task::Direction, Task::Rotation, Task::PositionPitchRoll];
        all.extend(BaseAxis::ALL.map(|axis| Task::PositionYaw { axis }));
        for plane in [Plane::Xy, Plane::Xz, Plane::Yz] {
            all.extend([Task::PlanarPosition { plane }, Task::PlanarPose { plane }]);
        }
        all
    }

    /// Whether it uses a direction of the tip frame.
    pub fn aims(self) -> bool {
        matches!(self, Task::Ray | Task::Direction | Task::PositionYaw { .. })
    }

    /// Its name in a file: `position`, `planar_position`, `planar_pose`, `pose`, `ray`, `direction`, `rotation` or
    /// `position_pitch_roll`, `position_yaw`.
    pub fn name(self) -> &'static str {
        match self {
            Task::Position => "position",
            Task::PlanarPosition { .. } => "planar_position",
            Task::PlanarPose { .. } => "planar_pose",
            Task::Pose => "pose",
            Task::Ray => "ray",
            Task::Direction => "direction",
            Task::Rotation => "rotation",
            Task::PositionPitchRoll => "position_pitch_roll",
            Task::PositionYaw { .. } => "position_yaw",
        }
    }
}

/// Its name, with the plane or the axis: `planar_pose in xz`, `position_yaw about z`.
impl fmt::Display for Task {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())?;
        self.plane().map_or(Ok(()), |plane| write!(f, " in {}", plane.name()))?;
        self.axis().map_or(Ok(()), |axis| write!(f, " about {}", axis.name()))
    }
}

/// A task with the direction in the tip frame that it uses, for output: `ray of [1, 0, 0]`.
pub struct Stated<'a> {
    /// The task.
    pub task: Task,
    /// The direction, of a task that [uses one](Task::aims).
    pub direction: Option<&'a ExactVector>,
}

impl fmt::Display for Stated<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.task)?;
        self.direction.map_or(Ok(()), |direction| write!(f, " of {}", show(direction)))
    }
}
