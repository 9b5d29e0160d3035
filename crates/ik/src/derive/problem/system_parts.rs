//! What a system of equations is made of ([`SystemParts`]): plain data, with the limits of what is taken on.

use serde::{Deserialize, Serialize};

use groebot_algebra::poly::Expression;
use groebot_robot::kinematics::{Choice, LengthUnit};

/// The most unknowns that a system may have.
pub const MAX_UNKNOWNS: usize = 16;
/// The most inputs, and the most parameters, that a system may have.
pub const MAX_PARAMETERS: usize = 64;
/// The most terms that the expansion of an equation or a square may take, by [`Expression::expansion_bound`].
pub const MAX_TERMS: f64 = 1e5;
/// The highest total degree that an equation or a square may have.
pub const MAX_DEGREE: u64 = 1000;
/// The most bits that a coefficient of such an expansion may take.
pub const MAX_BITS: f64 = 2e5;

/// What an input measures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Quantity {
    /// A length, in the system's unit.
    #[default]
    Length,
    /// An angle in radians.
    Angle,
    /// A number without unit.
    Number,
}

/// One value that a user gives as the target.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Input {
    /// The name, unique among inputs.
    pub name: String,
    /// What it measures.
    pub quantity: Quantity,
    /// Whether the solver may assume that it is greater than zero.
    pub positive: bool,
}

/// Where a parameter's value comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ParameterSource {
    /// The input with this index: a length or a number.
    Input(usize),
    /// The cosine of the input angle with this index.
    Cosine(usize),
    /// The sine of the input angle with this index.
    Sine(usize),
    /// The positive root of [`Parameter::square`].
    SquareRoot,
}

/// A name that the equations mention and whose value is known when they are solved.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Parameter {
    /// The name, as used in the equations.
    pub name: String,
    /// Where its value comes from.
    pub source: ParameterSource,
    /// When the parameter is related to earlier ones: its square, as an expression in them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub square: Option<Expression>,
}

/// How unknowns make the value of a joint.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum JointKindUnknown {
    /// An angle by two unknowns, related by cosine^2 + sine^2 = 1.
    Angle {
        /// The unknown that is the cosine of the joint's angle.
        cosine: String,
        /// The unknown that is the sine of the joint's angle.
        sine: String,
    },
    /// A length or a plain number by one unknown.
    Value {
        /// The unknown that is the joint's value.
        unknown: String,
    },
}

impl JointKindUnknown {
    /// The unknowns of this joint: cosine and sine, or the one value.
    pub fn unknowns(&self) -> Vec<&str> {
        match self {
            JointKindUnknown::Angle { cosine, sine } => vec![cosine, sine],
            JointKindUnknown::Value { unknown } => vec![unknown],
        }
    }
}

/// A joint that the system determines.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct JointUnknown {
    /// The joint's name.
    pub name: String,
    /// Its unknowns.
    pub kind: JointKindUnknown,
}

/// An equation `expression = 0`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Equation {
    /// The source's name for it, such as `(6.7.1)`; may be empty.
    pub label: String,
    /// What is zero.
    pub expression: Expression,
}

/// What a [`System`](super::System) is made of, not yet checked.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct SystemParts {
    /// An identifier for files and generated code.
    pub name: String,
    /// One line about the mechanism.
    pub description: String,
    /// Where the equations come from, such as `NAO (6.7.1)-(6.7.4)`.
    pub source: String,
    /// The unit of all lengths.
    pub length_unit: LengthUnit,
    /// What a user gives as the target, in this order.
    pub inputs: Vec<Input>,
    /// What the equations mention beside the unknowns.
    pub parameters: Vec<Parameter>,
    /// How the unknowns make joint values.
    pub joints: Vec<JointUnknown>,
    /// All unknowns, greatest first, for the lexicographic order.
    pub order: Vec<String>,
    /// The equations.
    pub equations: Vec<Equation>,
    /// The source's choice of root, if it makes one.
    pub choice: Option<Choice>,
}

impl SystemParts {
    /// The order when none is asked for: the cosines, then the sines, then plain unknowns, each in the order of joints.
    pub fn default_order(&self) -> Vec<String> {
        let (mut cosines, mut sines, mut values) = (Vec::new(), Vec::new(), Vec::new());
        for joint in &self.joints {
            match &joint.kind {
                JointKindUnknown::Angle { cosine, sine } => {
                    cosines.push(cosine.clone());
                    sines.push(sine.clone());
                }
                JointKindUnknown::Value { unknown } => values.push(unknown.clone()),
            }
        }
        [cosines, sines, values].concat()
    }

    /// Puts `c^2 + s^2 - 1` of every angle at the end of the equations, once each, under its own label if it has one.
    pub(in crate::derive) fn complete_circles(&mut self) {
        for joint in &self.joints {
            let JointKindUnknown::Angle { cosine, sine } = &joint.kind else { continue };
            let mut label = format!("circle of {}", joint.name);
            self.equations.retain(|equation| {
                let circle = is_circle(&equation.expression, cosine, sine);
                if circle {
                    label.clone_from(&equation.label);
                }
                !circle
            });
            self.equations.push(Equation { label, expression: circle(cosine, sine) });
        }
    }

    /// Relates the later one of the cosine and the sine of an input angle to the earlier one.
    pub(in crate::derive) fn complete_squares(&mut self) {
        for later in 0..self.parameters.len() {
            let (before, rest) = self.parameters.split_at_mut(later);
            let partner = before.iter().find(|earlier| are_partners(earlier.source, rest[0].source));
            if let Some(partner) = partner {
                rest[0].square.get_or_insert_with(|| complement(&partner.name));
            }
        }
    }
}

/// Whether one is the cosine and the other the sine of one angle.
pub(in crate::derive) fn are_partners(a: ParameterSource, b: ParameterSource) -> bool {
    use ParameterSource::{Cosine, Sine};
    matches!((a, b), (Cosine(i), Sine(j)) | (Sine(i), Cosine(j)) if i == j)
}

fn squared(name: &str) -> Expression {
    Expression::name(name).power(2)
}

/// `1 - name^2`.
pub(in crate::derive) fn complement(name: &str) -> Expression {
    Expression::Sum(vec![Expression::integer(1), squared(name).negated()])
}

fn circle(cosine: &str, sine: &str) -> Expression {
    Expression::Sum(vec![squared(cosine), squared(sine), Expression::integer(1).negated()])
}

/// Whether `expression` is `c^2 + s^2 - 1` with its three terms in any order, or the negative of that.
pub(in crate::derive) fn is_circle(expression: &Expression, cosine: &str, sine: &str) -> bool {
    let Expression::Sum(terms) = expression else { return false };
    let has = |part: &Expression, negative: bool| {
        terms.iter().any(|term| match term {
            Expression::Negation(a) => negative && **a == *part,
            term => !negative && term == part,
        })
    };
    let both = |negative| {
        has(&squared(cosine), negative) && has(&squared(sine), negative) && has(&Expression::integer(1), !negative)
    };
    terms.len() == 3 && (both(false) || both(true))
}
