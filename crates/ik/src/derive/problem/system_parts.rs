//! The parts of a system of equations ([`SystemParts`]): plain data, and its limits.

use serde::{Deserialize, Serialize};

use groebot_algebra::poly::Expression;
use groebot_robot::kinematics::{Choice, LengthUnit, Task};

pub use groebot_robot::kinematics::Quantity;

/// The maximum number of unknowns of a system.
pub(crate) const MAX_UNKNOWNS: usize = 16;
/// The maximum number of inputs, and of parameters, of a system.
pub(crate) const MAX_PARAMETERS: usize = 64;
/// The maximum number of terms in the expansion of an equation or a square, by [`Expression::expansion_bound`].
pub(crate) const MAX_TERMS: f64 = 1e5;
/// The maximum total degree of an equation or a square.
pub(crate) const MAX_DEGREE: u64 = 1000;
/// The maximum number of bits of a coefficient in such an expansion.
pub(crate) const MAX_BITS: f64 = 2e5;

/// One value that a user gives as the target.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Input {
    /// The name, unique among inputs.
    pub name: String,
    /// The quantity that it measures.
    pub quantity: Quantity,
    /// Whether the solver may assume that it is greater than zero.
    pub positive: bool,
}

/// The source of a parameter's value.
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

/// A name in the equations whose value is known when they are solved.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Parameter {
    /// The name, as used in the equations.
    pub name: String,
    /// The source of its value.
    pub source: ParameterSource,
    /// The square as an expression in earlier parameters, if the parameter is related to them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub square: Option<Expression>,
}

/// The relation between a joint's value and its unknowns.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum JointKindUnknown {
    /// An angle with two unknowns, related by cosine^2 + sine^2 = 1.
    Angle {
        /// The unknown that is the cosine of the joint's angle.
        cosine: String,
        /// The unknown that is the sine of the joint's angle.
        sine: String,
    },
    /// A length or a plain number with one unknown.
    Value {
        /// The unknown that is the joint's value.
        unknown: String,
    },
}

impl JointKindUnknown {
    /// The unknowns of this joint: cosine and sine, or the one value.
    pub(crate) fn unknowns(&self) -> Vec<&str> {
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
    /// The expression that is zero.
    pub expression: Expression,
}

/// The parts of a [`System`](super::System), not yet checked.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct SystemParts {
    /// An identifier for files and generated code.
    pub name: String,
    /// One line about the mechanism.
    pub description: String,
    /// The source of the equations, such as `NAO (6.7.1)-(6.7.4)`.
    pub source: String,
    /// The unit of all lengths.
    pub length_unit: LengthUnit,
    /// The task whose numbers are the inputs, of equations of a chain.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub task: Option<Task>,
    /// The values that a user gives as the target, in this order.
    pub inputs: Vec<Input>,
    /// The names in the equations other than the unknowns.
    pub parameters: Vec<Parameter>,
    /// The joints and their unknowns.
    pub joints: Vec<JointUnknown>,
    /// All unknowns, greatest first, for the lexicographic order.
    pub order: Vec<String>,
    /// The equations.
    pub equations: Vec<Equation>,
    /// The source's choice of root, if it makes one.
    pub choice: Option<Choice>,
}

impl SystemParts {
    /// The order used when none is requested: the cosines, then the sines, then plain unknowns, each in the order of joints.
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

    /// Moves `c^2 + s^2 - 1` of every angle to the end of the equations, once each. An existing label is kept.
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

/// Whether `a` and `b` are the cosine and the sine of one angle, in any order.
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
