//! Joints of a robot, with their frames, limits and actuators. Main type: [`Joint`].

use std::fmt;

use num_traits::{One, ToPrimitive, Zero};
use serde::{Deserialize, Serialize};

use crate::document::shown;
use crate::spatial::exact::{ExactVector, Placement, serde as exact_serde};
use crate::spatial::{Pose, rotation};
use crate::{Error, ErrorKind};
use groebot_algebra::number::BigRational;

/// Maximum integer multiplier of a mimic joint for which both joints are solved.
const MOST_TURNS: i32 = 8;

/// Type of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointType {
    /// Fixed.
    Fixed,
    /// Rotates about its axis, with limits.
    Revolute,
    /// Rotates about its axis without limits.
    Continuous,
    /// Translates along its axis.
    Prismatic,
    /// Six degrees of freedom. It cannot be in a chain.
    Floating,
    /// Moves in a plane. It cannot be in a chain.
    Planar,
}

impl JointType {
    /// All joint types.
    pub const ALL: [JointType; 6] = [
        JointType::Revolute,
        JointType::Continuous,
        JointType::Prismatic,
        JointType::Fixed,
        JointType::Floating,
        JointType::Planar,
    ];

    /// Its name in a URDF: `fixed`, `revolute`, `continuous`, `prismatic`, `floating` or `planar`.
    pub fn name(self) -> &'static str {
        match self {
            JointType::Fixed => "fixed",
            JointType::Revolute => "revolute",
            JointType::Continuous => "continuous",
            JointType::Prismatic => "prismatic",
            JointType::Floating => "floating",
            JointType::Planar => "planar",
        }
    }

    /// Whether it has an axis.
    pub fn has_axis(self) -> bool {
        !matches!(self, JointType::Fixed | JointType::Floating)
    }

    /// Whether it has one degree of freedom: it is revolute or prismatic.
    pub fn is_single(self) -> bool {
        matches!(self, JointType::Revolute | JointType::Continuous | JointType::Prismatic)
    }
}

/// A frame in another one, with the form of its rotation in the file.
#[derive(Clone, Debug, PartialEq)]
pub struct Origin {
    /// The frame, exactly.
    pub placement: Placement,
    /// Roll, pitch and yaw as given \[rad\]; `None` if the rotation is given in another form.
    pub rpy: Option<ExactVector>,
}

impl Origin {
    /// The identity.
    pub fn identity() -> Self {
        Placement::identity().into()
    }

    /// The frame in doubles \[m\].
    pub fn pose(&self) -> Pose {
        self.placement.pose()
    }

    /// Roll, pitch and yaw \[rad\]: the given ones, or angles of the same rotation.
    pub fn angles(&self) -> [f64; 3] {
        match &self.rpy {
            Some(rpy) => rpy.each_ref().map(|angle| angle.to_f64().unwrap_or(f64::NAN)),
            None => rotation::rpy(&self.pose().rotation),
        }
    }
}

impl From<Placement> for Origin {
    fn from(placement: Placement) -> Self {
        Origin { placement, rpy: None }
    }
}

/// A joint between two links. Metres, radians, kilograms, newtons.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// Its name, unique in the robot.
    pub name: String,
    /// The type of the joint.
    pub kind: JointType,
    /// The parent link.
    pub parent: String,
    /// The child link. Its frame is the joint's frame.
    pub child: String,
    /// Its frame in the parent's frame, at the value zero.
    pub origin: Origin,
    /// The direction of its axis in its own frame, of any length; ignored for a joint without an axis.
    pub axis: ExactVector,
    /// Its symbol in the source's formulas: `3` if the source writes `q3`.
    pub symbol: Option<String>,
    /// Minimum and maximum value \[rad or m\].
    pub limits: Option<(f64, f64)>,
    /// Maximum velocity \[rad/s or m/s\].
    pub speed: Option<f64>,
    /// Maximum torque or force \[N m or N\].
    pub effort: Option<f64>,
    /// Viscous friction \[N m s/rad or N s/m\].
    pub damping: f64,
    /// Coulomb friction \[N m or N\].
    pub friction: f64,
    /// The rotor inertia reflected to the joint \[kg m^2 or kg\].
    pub armature: f64,
    /// Its position servo, if the description has one (MJCF).
    pub servo: Option<Servo>,
    /// The law of a mimic joint.
    pub mimic: Option<Mimic>,
    /// Notes of the reader about its numbers.
    pub notes: Vec<String>,
    /// Its line in the file.
    pub line: Option<usize>,
}

impl Joint {
    /// A joint with the frame of `parent`, its axis along x, and default values.
    pub fn new(name: &str, kind: JointType, parent: &str, child: &str) -> Self {
        Joint {
            name: name.to_owned(),
            kind,
            parent: parent.to_owned(),
            child: child.to_owned(),
            origin: Origin::identity(),
            axis: [BigRational::one(), BigRational::zero(), BigRational::zero()],
            symbol: None,
            limits: None,
            speed: None,
            effort: None,
            damping: 0.0,
            friction: 0.0,
            armature: 0.0,
            servo: None,
            mimic: None,
            notes: Vec::new(),
            line: None,
        }
    }

    /// An error about this joint, with its name and line.
    pub(crate) fn error(&self, kind: ErrorKind, message: &str) -> Error {
        let error = Error::new(kind, format!("joint `{}`: {message}", shown(&self.name)));
        if let Some(line) = self.line { error.at_line(line) } else { error }
    }
}

/// A position servo at a joint: torque = stiffness (target - value) - damping velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Servo {
    /// \[N m/rad or N/m\]
    pub stiffness: f64,
    /// \[N m s/rad or N s/m\]
    pub damping: f64,
}

/// An actuator and the joints that it moves. For example NAO has one actuator for two hip joints.
#[derive(Clone, Debug, PartialEq)]
pub struct Actuator {
    /// Its name, unique in the robot.
    pub name: String,
    /// The joints that it moves, each with the actuator's rotation for a unit rotation of the joint.
    pub joints: Vec<(String, f64)>,
}

/// The law of a mimic joint: value = multiplier * leader + offset, as in URDF's `<mimic>`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mimic {
    /// The leader joint.
    pub leader: String,
    /// The multiplier.
    #[serde(with = "exact_serde::number")]
    pub multiplier: BigRational,
    /// The offset, in radians or the length unit.
    #[serde(with = "exact_serde::number")]
    pub offset: BigRational,
}

impl Mimic {
    /// The multiplier and the offset.
    pub fn law(&self) -> [f64; 2] {
        [&self.multiplier, &self.offset].map(|number| number.to_f64().unwrap_or(f64::NAN))
    }

    /// The value of the joint for the value `leader` of its leader.
    pub fn value(&self, leader: f64) -> f64 {
        let [factor, summand] = self.law();
        factor * leader + summand
    }

    /// The multiplier, if it is a small integer.
    pub fn whole(&self) -> Option<i32> {
        let factor = self.multiplier.is_integer().then(|| self.multiplier.to_i32()).flatten()?;
        (factor.abs() <= MOST_TURNS).then_some(factor)
    }

    /// The composed law of a joint that follows this joint by `outer`.
    #[must_use]
    pub fn then(&self, outer: &Mimic) -> Mimic {
        let offset = &outer.multiplier * &self.offset + &outer.offset;
        Mimic { leader: self.leader.clone(), multiplier: &outer.multiplier * &self.multiplier, offset }
    }
}

/// `leader`, or `2 * leader + 0.1`.
impl fmt::Display for Mimic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let leader = shown(&self.leader);
        match self.law() {
            [1.0, 0.0] => f.write_str(&leader),
            [factor, 0.0] => write!(f, "{factor} * {leader}"),
            [factor, summand] => write!(f, "{factor} * {leader} + {summand}"),
        }
    }
}
