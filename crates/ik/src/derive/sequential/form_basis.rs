//! [`FormBasis`]: the equations of one joint with free symbols as coefficients, solved once by Groebner bases on all strata.
//!
//! A step of a plan is one or two equations in one joint. Their coefficients are known numbers when the step runs, but the derivation assumes nothing about
//! them. They are free symbols of a [`System`], whose tree of strata gives the solution for *all* their values. At run time the symbols get their values from
//! the target and the earlier joints.

use serde::{Deserialize, Serialize};

use crate::derive::equations::tree::Node;
use crate::derive::{
    Equation, Input, JointKindUnknown, JointUnknown, Orders, Parameter, ParameterSource, Quantity, System, SystemParts,
    derive_tree,
};
use crate::{Result, Watch};
use groebot_algebra::poly::parse;

/// The equation of a [`Form::Quartic`].
pub(super) const QUARTIC: &str = "A*c*s + B*s^2 + C*c + D*s + E";
/// The symbols of [`QUARTIC`].
pub(super) const QUARTIC_SYMBOLS: [&str; 5] = ["A", "B", "C", "D", "E"];

/// The shape of a step's equations in its joint: `c` and `s` are the cosine and sine of an angle, `d` is a length.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Form {
    /// `A c + B s + C = 0`. The auxiliary `w = A s - B c` has `w^2 = A^2 + B^2 - C^2`, so the only divisor is `A^2 + B^2`.
    Angle,
    /// `A c - B s = X` and `B c + A s = Y`: a rotation of `(A, B)` to `(X, Y)`.
    #[serde(rename = "turn")]
    Rotation,
    /// `A c + B s = X` and `E c + F s = Y`.
    Pair,
    /// `A d + B = 0`.
    Linear,
    /// `A c s + B s^2 + C c + D s + E = 0`, solved by [`super::HalfAngles`].
    Quartic,
    /// `A d^4 + B d^3 + C d^2 + D d + E = 0`.
    Lengths,
    /// `A d^2 + 2 B d + C = 0`. The auxiliary `w = A d + B` has `w^2 = B^2 - A C`.
    Quadratic,
}

/// The names and equations of a form.
struct Words {
    symbols: &'static [&'static str],
    /// The unknowns, the smallest last.
    unknowns: &'static [&'static str],
    equations: &'static [&'static str],
}

impl Form {
    fn words(self) -> Words {
        match self {
            Form::Angle => Words {
                symbols: &["A", "B", "C"],
                unknowns: &["c", "s", "w"],
                equations: &["A*c + B*s + C", "A*s - B*c - w", "c^2 + s^2 - 1"],
            },
            Form::Rotation => Words {
                symbols: &["A", "B", "X", "Y"],
                unknowns: &["c", "s"],
                equations: &["A*c - B*s - X", "B*c + A*s - Y"],
            },
            Form::Pair => Words {
                symbols: &["A", "B", "E", "F", "X", "Y"],
                unknowns: &["c", "s"],
                equations: &["A*c + B*s - X", "E*c + F*s - Y"],
            },
            Form::Linear => Words { symbols: &["A", "B"], unknowns: &["d"], equations: &["A*d + B"] },
            Form::Quartic => {
                Words { symbols: &QUARTIC_SYMBOLS, unknowns: &["c", "s"], equations: &[QUARTIC, "c^2 + s^2 - 1"] }
            }
            Form::Lengths => {
                Words { symbols: &QUARTIC_SYMBOLS, unknowns: &["d"], equations: &["A*d^4 + B*d^3 + C*d^2 + D*d + E"] }
            }
            Form::Quadratic => Words {
                symbols: &["A", "B", "C"],
                unknowns: &["d", "w"],
                equations: &["A*d^2 + 2*B*d + C", "A*d + B - w"],
            },
        }
    }

    /// The names of its symbols, in the order of their values in a step.
    pub fn symbols(self) -> &'static [&'static str] {
        self.words().symbols
    }

    /// The forms that a step of this form uses. If two equations are dependent, each is solved alone.
    pub fn needs(self) -> &'static [Form] {
        match self {
            Form::Angle => &[Form::Angle],
            Form::Rotation => &[Form::Rotation],
            Form::Pair => &[Form::Pair, Form::Angle],
            Form::Quartic => &[Form::Quartic],
            Form::Lengths => &[Form::Lengths],
            Form::Linear => &[Form::Linear],
            Form::Quadratic => &[Form::Quadratic],
        }
    }

    /// The number of solutions if they are finitely many and the equations are independent.
    pub(crate) fn degree(self) -> usize {
        match self {
            Form::Angle | Form::Quadratic => 2,
            Form::Quartic | Form::Lengths => 4,
            Form::Rotation | Form::Pair | Form::Linear => 1,
        }
    }

    /// A name for files, such as `angle` or `turn`.
    pub fn name(self) -> &'static str {
        match self {
            Form::Angle => "angle",
            Form::Rotation => "turn",
            Form::Pair => "pair",
            Form::Linear => "linear",
            Form::Quartic => "quartic",
            Form::Lengths => "lengths",
            Form::Quadratic => "quadratic",
        }
    }

    /// The equations, with the symbols as inputs.
    ///
    /// # Errors
    /// Does not fail: the names and equations of every form are a valid system.
    pub fn system(self) -> Result<System> {
        let words = self.words();
        let symbol = |(index, name): (usize, &&str)| Parameter {
            name: (*name).to_owned(),
            source: ParameterSource::Input(index),
            square: None,
        };
        let input = |name: &&str| Input { name: (*name).to_owned(), quantity: Quantity::Number, positive: false };
        let unknown = |name: &&str| JointUnknown {
            name: (*name).to_owned(),
            kind: JointKindUnknown::Value { unknown: (*name).to_owned() },
        };
        let equation = |text: &&str| Ok(Equation { label: String::new(), expression: parse(text)? });
        System::new(SystemParts {
            name: self.name().to_owned(),
            inputs: words.symbols.iter().map(input).collect(),
            parameters: words.symbols.iter().enumerate().map(symbol).collect(),
            joints: words.unknowns.iter().map(unknown).collect(),
            order: words.unknowns.iter().map(|name| (*name).to_owned()).collect(),
            equations: words.equations.iter().map(equation).collect::<Result<_>>()?,
            ..SystemParts::default()
        })
    }
}

/// A form and its proved solution for all values of the symbols.
#[derive(Clone, Debug, PartialEq)]
pub struct FormBasis {
    /// The form.
    pub form: Form,
    /// Its equations.
    pub system: System,
    /// The strata, each with its basis and proof.
    pub tree: Node,
}

impl FormBasis {
    /// Derives and proves `form`.
    ///
    /// # Errors
    /// The error of `watch` if it stops the derivation.
    pub fn derive<'w>(form: Form, watch: impl Into<Option<&'w Watch>>) -> Result<Self> {
        let watch = Watch::or_none(watch);
        let system = form.system()?;
        let tree = derive_tree(&system, Orders::Requested, watch)?;
        Ok(FormBasis { form, system, tree })
    }
}
