//! The unit of lengths of a description: [`LengthUnit`].

use serde::{Deserialize, Serialize};

/// The unit of all lengths of a description.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum LengthUnit {
    /// 1 m.
    #[default]
    #[serde(rename = "m")]
    Metre,
    /// 0.001 m.
    #[serde(rename = "mm")]
    Millimetre,
}

impl LengthUnit {
    /// `m` or `mm`.
    pub fn symbol(self) -> &'static str {
        match self {
            LengthUnit::Metre => "m",
            LengthUnit::Millimetre => "mm",
        }
    }

    /// The length of one unit in metres.
    pub fn metres(self) -> f64 {
        match self {
            LengthUnit::Metre => 1.0,
            LengthUnit::Millimetre => 0.001,
        }
    }
}
