//! The joints of a program's solutions. Main type: [`Joint`].

use serde::{Deserialize, Serialize};

use groebot_robot::kinematics::{LengthUnit, Quantity};

/// The unit of an input or joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Unit {
    /// Metres.
    Metre,
    /// Millimetres.
    Millimetre,
    /// Radians.
    Radian,
    /// A dimensionless number.
    One,
}

impl Unit {
    /// The unit of a quantity, with lengths in `length`.
    pub fn of(quantity: Quantity, length: LengthUnit) -> Self {
        match (quantity, length) {
            (Quantity::Length, LengthUnit::Metre) => Unit::Metre,
            (Quantity::Length, LengthUnit::Millimetre) => Unit::Millimetre,
            (Quantity::Angle, _) => Unit::Radian,
            (Quantity::Number, _) => Unit::One,
        }
    }

    /// `m`, `mm`, `rad`, or empty for a dimensionless number.
    pub fn symbol(self) -> &'static str {
        match self {
            Unit::Metre => "m",
            Unit::Millimetre => "mm",
            Unit::Radian => "rad",
            Unit::One => "",
        }
    }
}

/// The value of a joint as a function of the unknowns.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum JointValue {
    /// `atan2(sine, cosine)` of two unknowns (indices), in (-pi, pi].
    Angle {
        /// Index of the unknown cosine.
        cosine: usize,
        /// Index of the unknown sine.
        sine: usize,
    },
    /// The unknown with this index itself.
    Plain(usize),
}

impl JointValue {
    /// The indices of its unknowns: of the cosine and the sine, or of the value itself.
    #[doc(hidden)]
    pub fn unknowns(self) -> Vec<usize> {
        match self {
            JointValue::Angle { cosine, sine } => vec![cosine, sine],
            JointValue::Plain(unknown) => vec![unknown],
        }
    }
}

/// A joint of the solution.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Joint {
    /// Its name, such as `HipPitch`.
    pub name: String,
    /// The unit of its value.
    pub unit: Unit,
    /// Its value as a function of the unknowns.
    pub value: JointValue,
}
