//! The parameters of a program's equations as functions of its inputs: [`ParameterRule`], [`Rule`].

use serde::{Deserialize, Serialize};

use super::instruction::{Instruction, Operand};

/// A parameter of the equations.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ParameterRule {
    /// Its name in the equations.
    pub name: String,
    /// Its value as a function of the inputs.
    pub rule: Rule,
}

/// The value of a parameter as a function of the inputs and the parameters before it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Rule {
    /// The input with this index.
    Input(usize),
    /// The cosine of an input angle.
    Cosine(usize),
    /// The sine of an input angle.
    Sine(usize),
    /// A value that follows an input.
    Following(Following),
    /// The cosine of an angle that follows an input.
    CosineFollowing(Following),
    /// The sine of an angle that follows an input.
    SineFollowing(Following),
    /// The non-negative square root of a value computed from earlier parameters.
    Root {
        /// Code that computes the value.
        code: Vec<Instruction>,
        /// The value under the root.
        value: Operand,
    },
}

/// The value `factor * input + offset`, of a joint that follows a given one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Following {
    /// The index of the input.
    pub input: usize,
    /// The factor.
    pub factor: f64,
    /// The summand.
    pub offset: f64,
}

impl Following {
    /// The value for these inputs.
    pub fn value(&self, inputs: &[f64]) -> f64 {
        self.factor * inputs[self.input] + self.offset
    }
}

impl Rule {
    /// The rule with its input index mapped by `place`.
    ///
    /// # Errors
    /// Those of `place`.
    #[doc(hidden)]
    pub fn with_input<E>(self, place: impl Fn(usize) -> std::result::Result<usize, E>) -> std::result::Result<Rule, E> {
        let moved = |law: Following| Ok(Following { input: place(law.input)?, ..law });
        Ok(match self {
            Rule::Input(input) => Rule::Input(place(input)?),
            Rule::Cosine(input) => Rule::Cosine(place(input)?),
            Rule::Sine(input) => Rule::Sine(place(input)?),
            Rule::Following(law) => Rule::Following(moved(law)?),
            Rule::CosineFollowing(law) => Rule::CosineFollowing(moved(law)?),
            Rule::SineFollowing(law) => Rule::SineFollowing(moved(law)?),
            root @ Rule::Root { .. } => root,
        })
    }
}
