//! Joints of a robot, what places them and what moves them. Main type: [`Joint`].

use std::fmt;

use num_traits::{One, ToPrimitive, Zero};
use serde::{Deserialize, Serialize};

use crate::document::shown;
use crate::spatial::exact::{ExactVector, Placement, serde as exact_serde};
use crate::spatial::{Pose, rotation};
use crate::{Error, ErrorKind};
use groebot_algebra::number::BigRational;

/// The most turns of a joint for one of its leader, where both are found.
const MOST_TURNS: i32 = 8;

/// How a joint of a robot moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointType {
    /// Not at all.
    Fixed,
    /// It turns about its axis, between limits.
    Revolute,
    /// It turns about its axis without limits.
    Continuous,
    /// It slides along its axis.
    Prismatic,
    /// In all six directions; no chain can have one.
    Floating,
    /// In a plane; no chain can have one.
    Planar,
}

impl JointType {
    /// All of them.
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

    /// Whether one number says where it is: it turns or slides.
    pub fn is_single(self) -> bool {
        matches!(self, JointType::Revolute | JointType::Continuous | JointType::Prismatic)
    }
}

/// A frame in another one, and how a file gives its rotation.
#[derive(Clone, Debug, PartialEq)]
pub struct Origin {
    /// The frame, exactly.
    pub placement: Placement,
    /// Roll, pitch and yaw as given \[rad\]; `None` where the rotation is given in another form.
    pub rpy: Option<ExactVector>,
}

impl Origin {
    /// The outer frame itself.
    pub fn identity() -> Self {
        Placement::identity().into()
    }

    /// The frame in doubles \[m\].
    pub fn pose(&self) -> Pose {
        self.placement.pose()
    }

    /// Roll, pitch and yaw \[rad\]: those that are given, else such that the rotation is the same.
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
    /// How it moves.
    pub kind: JointType,
    /// The link that it hangs on.
    pub parent: String,
    /// The link that it moves; the frame of that link is the joint's.
    pub child: String,
    /// Its frame in the parent's frame, at the value zero.
    pub origin: Origin,
    /// The direction of its axis in its own frame, of any length; not looked at when it has none.
    pub axis: ExactVector,
    /// Its symbol in the source's formulas: `q3` there is `3` here.
    pub symbol: Option<String>,
    /// Least and greatest value \[rad or m\].
    pub limits: Option<(f64, f64)>,
    /// The greatest rate \[rad/s or m/s\].
    pub speed: Option<f64>,
    /// The greatest torque or force \[N m or N\].
    pub effort: Option<f64>,
    /// Viscous friction \[N m s/rad or N s/m\].
    pub damping: f64,
    /// Coulomb friction \[N m or N\].
    pub friction: f64,
    /// The inertia of the rotor, seen from the joint \[kg m^2 or kg\].
    pub armature: f64,
    /// The joint that it follows.
    pub mimic: Option<Mimic>,
    /// What the reader made of its numbers.
    pub notes: Vec<String>,
    /// Its line in the file.
    pub line: Option<usize>,
}

impl Joint {
    /// A joint with its frame at that of `parent`, its axis along x and nothing else known of it.
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

/// An actuator, and the joints that it moves: NAO's two hips are turned by one.
#[derive(Clone, Debug, PartialEq)]
pub struct Actuator {
    /// Its name, unique in the robot.
    pub name: String,
    /// The joints that it moves, each with the turns of the actuator for one of the joint.
    pub joints: Vec<(String, f64)>,
}

/// That a joint follows another one: value = multiplier * leader + offset, as `<mimic>` says in a URDF.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mimic {
    /// The joint that is followed.
    pub leader: String,
    /// The factor.
    #[serde(with = "exact_serde::number")]
    pub multiplier: BigRational,
    /// The summand, in radians or the length unit.
    #[serde(with = "exact_serde::number")]
    pub offset: BigRational,
}

impl Mimic {
    /// The factor and the summand.
    pub fn law(&self) -> [f64; 2] {
        [&self.multiplier, &self.offset].map(|number| number.to_f64().unwrap_or(f64::NAN))
    }

    /// The value of the joint where its leader has the value `leader`.
    pub fn value(&self, leader: f64) -> f64 {
        let [factor, summand] = self.law();
        factor * leader + summand
    }

    /// The factor, when it is a whole number of a few turns at most.
    pub fn whole(&self) -> Option<i32> {
        let factor = self.multiplier.is_integer().then(|| self.multiplier.to_i32()).flatten()?;
        (factor.abs() <= MOST_TURNS).then_some(factor)
    }

    /// That of a joint that follows the one that this is about by `outer`.
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
