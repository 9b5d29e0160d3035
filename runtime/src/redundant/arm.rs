//! A redundant arm: its data ([`Arm`]) and its solvers with one joint given ([`Redundant`]).

use crate::six_axes::{Rigid, Vector};
use crate::solution::Error;

/// Maximal number of joints.
pub const MOST_JOINTS: usize = 7;

/// Maximal number of sections.
pub const MOST_SECTIONS: usize = 8;

/// Joint values: rad, or the unit of lengths. Entries from [`Arm::count`] on are 0.
pub type Q = [f64; MOST_JOINTS];

/// The least and the greatest value of each joint (rad, or the unit of lengths); infinite where there is none. Entries from [`Arm::count`] on are not read.
pub type Limits = [[f64; 2]; MOST_JOINTS];

/// The numbers of a target in the order of [`Task`]. The remaining ones are 0.
pub type Target = [f64; 12];

/// Which numbers of the tip's pose in the base frame a target specifies. Positions have the unit of lengths, angles are in rad, directions are unit vectors.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Task {
    /// Target: the position (3 numbers), then the rotation matrix base_from_tip by rows (9 numbers).
    Pose,
    /// Target: the position (3 numbers).
    Position,
    /// Target: the rotation matrix base_from_tip by rows (9 numbers).
    Rotation,
    /// Target: the position (3 numbers), then the image of a direction of the tip (3 numbers).
    Ray {
        /// The direction in the tip frame, a unit vector.
        direction: Vector,
    },
    /// Target: the image of a direction of the tip (3 numbers).
    Direction {
        /// The direction in the tip frame, a unit vector.
        direction: Vector,
    },
    /// Target: the position (3 numbers), then pitch and roll of R = Rz(yaw) Ry(pitch) Rx(roll).
    PositionPitchRoll,
    /// Target: the position (3 numbers), then the angle of a direction of the tip about an axis of the base. The tip rotates about this axis only, and the
    /// direction is perpendicular to it. The angle is measured from x about z, from y about x, from z about y.
    PositionYaw {
        /// The coordinate of the axis: 0, 1, 2 for x, y, z.
        axis: usize,
        /// The direction in the tip frame, a unit vector.
        direction: Vector,
    },
    /// Target: two coordinates of the position. The whole arm moves parallel to their plane.
    PlanarPosition {
        /// The two coordinates, in increasing order.
        coordinates: [usize; 2],
    },
    /// Target: two coordinates of the position, then the angle about the axis of the third one, right-handed, from the zero configuration. The whole arm moves
    /// parallel to the plane.
    PlanarPose {
        /// The two coordinates, in increasing order.
        coordinates: [usize; 2],
    },
}

impl Task {
    /// The number of independent equations: one less than the number of joints of an arm.
    #[must_use]
    pub fn equations(&self) -> usize {
        match self {
            Task::Pose => 6,
            Task::Ray { .. } | Task::PositionPitchRoll => 5,
            Task::PositionYaw { .. } => 4,
            Task::Position | Task::Rotation | Task::PlanarPose { .. } => 3,
            Task::Direction { .. } | Task::PlanarPosition { .. } => 2,
        }
    }
}

/// Which solver exists for the problem with a certain joint given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Given {
    /// [`Redundant::solve_given`] returns all solutions for any value of the joint.
    Solved,
    /// The joint is constant on every curve of solutions, which is proved. Its value is only compared with the limits.
    Constant,
    /// There is no solver. Limits of this joint are found along the curves only, so that completeness depends on a grid.
    Unsolved,
}

/// The data of an arm: axes at zero in the base frame, and limits. The numbers are those of the robot as described, not of its idealisation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arm {
    /// The number of joints, at most [`MOST_JOINTS`]; one more than [`Task::equations`].
    pub count: usize,
    /// The directions of the axes at zero, unit vectors in the base frame.
    pub directions: [Vector; MOST_JOINTS],
    /// A point on each axis at zero in the base frame; of no meaning for a prismatic joint.
    pub points: [Vector; MOST_JOINTS],
    /// Whether a joint is prismatic.
    pub slides: [bool; MOST_JOINTS],
    /// The pose base_from_tip at zero.
    pub tip: Rigid,
    /// The task.
    pub task: Task,
    /// The characteristic length: an error of this length counts as much as one of 1 rad.
    pub length: f64,
    /// The described limits.
    pub limits: Limits,
    /// By joint: which solver exists with this joint given.
    pub given: [Given; MOST_JOINTS],
    /// The joint whose values are tried for first solutions. Its [`Arm::given`] is [`Given::Solved`]. Best is a joint with a fast solver that has solutions for
    /// most values.
    pub scanned: usize,
    /// The joint whose values are a grid for curves that touch no limit. Its [`Arm::given`] is [`Given::Solved`]. Best is a joint that moves far along short
    /// closed curves.
    pub grid: usize,
    /// Sections that short closed curves pass; those from `section_count` on are not read.
    pub sections: [Section; MOST_SECTIONS],
    /// The number of sections.
    pub section_count: usize,
}

/// The solutions of a target with a joint at a value.
///
/// Where the derivatives of the tip's pose are dependent, closed curves of solutions begin. On many arms a joint has the same value at all these places. Short
/// closed curves around them then pass this value, however short they are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section {
    /// The joint. Its [`Arm::given`] is [`Given::Solved`].
    pub joint: usize,
    /// Its value (rad, or the unit of lengths).
    pub value: f64,
}

impl Arm {
    /// An arm without joints, from which others are made by `Arm { count: 7, ..Arm::NONE }`.
    pub const NONE: Arm = Arm {
        count: 0,
        directions: [[0.0, 0.0, 1.0]; MOST_JOINTS],
        points: [[0.0; 3]; MOST_JOINTS],
        slides: [false; MOST_JOINTS],
        tip: Rigid::NONE,
        task: Task::Pose,
        length: 1.0,
        limits: [[f64::NEG_INFINITY, f64::INFINITY]; MOST_JOINTS],
        given: [Given::Unsolved; MOST_JOINTS],
        scanned: 0,
        grid: 0,
        sections: [Section { joint: 0, value: 0.0 }; MOST_SECTIONS],
        section_count: 0,
    };
}

/// A solution of a problem with one joint given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Member {
    /// Joint values: rad in (-pi, pi], or the unit of lengths; the given joint has the given value.
    pub q: Q,
    /// Bit `j` is set where joint `j` is free: the problem itself has a self-motion, of which this is one member.
    pub free: u32,
    /// False where the solver's work was bounded: other solutions may be missing.
    pub settled: bool,
}

/// A list of solutions with fixed room.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Members {
    list: [Member; Members::ROOM],
    count: usize,
    is_short: bool,
}

impl Members {
    /// Maximal number of solutions.
    pub const ROOM: usize = 64;
    /// The empty list.
    pub const NONE: Members = Members {
        list: [Member { q: [0.0; MOST_JOINTS], free: 0, settled: true }; Members::ROOM],
        count: 0,
        is_short: false,
    };

    /// Removes all solutions.
    pub fn clear(&mut self) {
        self.count = 0;
        self.is_short = false;
    }

    /// Adds a solution. If there is no room, it is dropped, and [`Members::is_short`] is true from then on.
    pub fn push(&mut self, member: Member) {
        if self.count == Members::ROOM {
            self.is_short = true;
            return;
        }
        self.list[self.count] = member;
        self.count += 1;
    }

    /// The solutions.
    #[must_use]
    pub fn as_slice(&self) -> &[Member] {
        &self.list[..self.count]
    }

    /// Whether solutions were dropped because there was no room.
    #[must_use]
    pub fn is_short(&self) -> bool {
        self.is_short
    }
}

/// An arm with its solvers.
pub trait Redundant {
    /// The data of the arm.
    fn arm(&self) -> &Arm;

    /// All solutions of the target with `joint` given at `value` (rad, or the unit of lengths), whatever the limits of the other joints. `out` is cleared
    /// first. Only called for joints whose [`Arm::given`] is [`Given::Solved`].
    ///
    /// # Errors
    ///
    /// Those of a target that is not valid: [`Error::NotFinite`], [`Error::NotRotation`], [`Error::NotUnit`]. [`Error::OpenStratum`] and [`Error::Unsettled`]
    /// for a target that the solver could not decide.
    fn solve_given(&self, target: &Target, joint: usize, value: f64, out: &mut Members) -> Result<(), Error>;
}
