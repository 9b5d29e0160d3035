//! What is asked of the tip of a chain. Main type: [`Task`].

use serde::{Deserialize, Serialize};

/// A coordinate plane of the base frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
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
    /// The coordinate (0, 1, 2 for x, y, z) along its normal.
    pub fn normal(self) -> usize {
        match self {
            Plane::Xy => 2,
            Plane::Xz => 1,
            Plane::Yz => 0,
        }
    }

    /// Its two coordinates, in the order of its name.
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

/// What is asked of the tip.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Task {
    /// The position: three numbers.
    Position,
    /// The position in a plane in which the whole chain moves: two numbers.
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
    /// The position, and where [`super::Chain::direction`] points: five numbers.
    Ray,
    /// Where [`super::Chain::direction`] points: two numbers.
    Direction,
    /// The orientation: three numbers.
    Rotation,
    /// The position, and pitch and roll of the tip, whatever its yaw, in R = Rz(yaw) Ry(pitch) Rx(roll): five numbers.
    PositionPitchRoll,
}

impl Task {
    /// The plane of a planar task.
    pub fn plane(self) -> Option<Plane> {
        match self {
            Task::PlanarPosition { plane } | Task::PlanarPose { plane } => Some(plane),
            Task::Position | Task::Pose | Task::Ray | Task::Direction | Task::Rotation | Task::PositionPitchRoll => {
                None
            }
        }
    }

    /// The most joints that it determines: its number of independent values.
    pub fn freedoms(self) -> usize {
        match self {
            Task::Pose => 6,
            Task::Ray | Task::PositionPitchRoll => 5,
            Task::Position | Task::PlanarPose { .. } | Task::Rotation => 3,
            Task::PlanarPosition { .. } | Task::Direction => 2,
        }
    }

    /// How many of its numbers are lengths; they come first.
    pub fn lengths(self) -> usize {
        match self {
            Task::Position | Task::Pose | Task::Ray | Task::PositionPitchRoll => 3,
            Task::PlanarPosition { .. } | Task::PlanarPose { .. } => 2,
            Task::Direction | Task::Rotation => 0,
        }
    }

    /// The names of the numbers of a target, in the order of a derived solver: `px`, `r11` by rows, `dx`, `phi`, `pitch`.
    pub fn numbers(self) -> Vec<String> {
        let along = |prefix: &str, axes: &[usize]| -> Vec<String> {
            axes.iter().map(|&axis| format!("{prefix}{}", ["x", "y", "z"][axis])).collect()
        };
        let (position, direction) = (along("p", &[0, 1, 2]), along("d", &[0, 1, 2]));
        let rows = (1..=3).flat_map(|row| (1..=3).map(move |column| format!("r{row}{column}"))).collect();
        let angles = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
        match self {
            Task::Pose => [position, rows].concat(),
            Task::Position => position,
            Task::Ray => [position, direction].concat(),
            Task::Direction => direction,
            Task::Rotation => rows,
            Task::PositionPitchRoll => [position, angles(&["pitch", "roll"])].concat(),
            Task::PlanarPosition { plane } => along("p", &plane.coordinates()),
            Task::PlanarPose { plane } => [along("p", &plane.coordinates()), angles(&["phi"])].concat(),
        }
    }

    /// Whether it aims a direction of the tip frame.
    pub fn aims(self) -> bool {
        matches!(self, Task::Ray | Task::Direction)
    }

    /// Its name in a file: `position`, `planar_position`, `planar_pose`, `pose`, `ray`, `direction`, `rotation` or
    /// `position_pitch_roll`.
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
        }
    }
}
