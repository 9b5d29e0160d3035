//! The original equations in floating point, the reference of all checks. It uses nothing of the program.

use super::chain::model::Joints;
use super::chain::singular::smallest_singular_value;
use super::newton::{jacobian, largest, newton};
use crate::derive::{JointKindUnknown, ParameterSource, Quantity, System};
use crate::tolerances::WITNESS;
use groebot_algebra::poly::Expression;
use groebot_robot::spatial::angle;

/// A name with its value and its size. A cosine or sine has size one, because its rounding error does not decrease with its value.
struct Named<'a> {
    name: &'a str,
    value: f64,
    size: f64,
}

/// The equations of a system without the circle relations of its joints, and a typical length.
pub(super) struct Model<'a> {
    pub system: &'a System,
    /// A typical length of the mechanism.
    pub unit: f64,
    equations: Vec<&'a Expression>,
}

impl<'a> Model<'a> {
    /// The model of `system`, whose lengths are about `unit`.
    pub fn new(system: &'a System, unit: f64) -> Self {
        // The circle relations are the last equations, one for each angle. Joint values satisfy them by construction.
        let circles = system.joints.iter().filter(|joint| matches!(joint.kind, JointKindUnknown::Angle { .. })).count();
        let kept = system.equations.len() - circles;
        let equations = system.equations[..kept].iter().map(|equation| &equation.expression).collect();
        Model { system, unit, equations }
    }

    /// The typical size of input `index`.
    pub fn input_size(&self, index: usize) -> f64 {
        match self.system.inputs[index].quantity {
            Quantity::Length => self.unit,
            Quantity::Angle | Quantity::Number => 1.0,
        }
    }

    /// The typical size of the plain joints at `target`.
    fn length(&self, target: &[f64]) -> f64 {
        let lengths = self.system.inputs.iter().zip(target).filter(|(input, _)| input.quantity == Quantity::Length);
        lengths.fold(self.unit, |longest, (_, value)| longest.max(value.abs()))
    }

    /// The typical size of each joint at `target`: one radian, or a length.
    pub fn joint_sizes(&self, target: &[f64]) -> Vec<f64> {
        let length = self.length(target);
        (0..self.system.joints.len()).map(|joint| if self.turns(joint) { 1.0 } else { length }).collect()
    }

    fn parameters(&self, target: &[f64]) -> Vec<Named<'a>> {
        let mut named: Vec<Named<'a>> = Vec::new();
        for parameter in &self.system.parameters {
            let (value, size) = match parameter.source {
                ParameterSource::Input(index) => (target[index], target[index].abs()),
                ParameterSource::Cosine(index) => (target[index].cos(), 1.0),
                ParameterSource::Sine(index) => (target[index].sin(), 1.0),
                ParameterSource::SquareRoot => {
                    let square = parameter.square.as_ref().map_or(f64::NAN, |square| evaluate(square, &named));
                    (square.sqrt(), square.sqrt())
                }
            };
            named.push(Named { name: &parameter.name, value, size });
        }
        named
    }

    fn names(&self, target: &[f64], q: &[f64]) -> Vec<Named<'a>> {
        let mut named = self.parameters(target);
        for (joint, &q) in self.system.joints.iter().zip(q) {
            match &joint.kind {
                JointKindUnknown::Angle { cosine, sine } => {
                    named.push(Named { name: cosine, value: q.cos(), size: 1.0 });
                    named.push(Named { name: sine, value: q.sin(), size: 1.0 });
                }
                JointKindUnknown::Value { unknown } => named.push(Named { name: unknown, value: q, size: q.abs() }),
            }
        }
        named
    }

    /// The value of each equation at the joint vector `q`, as a fraction of the sum of its terms' sizes.
    pub fn shares(&self, target: &[f64], q: &[f64]) -> Vec<f64> {
        let named = self.names(target, q);
        let share = |equation: &&Expression| evaluate(equation, &named) / size(equation, &named).max(f64::MIN_POSITIVE);
        self.equations.iter().map(share).collect()
    }

    /// The largest magnitude of [`Model::shares`]; infinite if one of them is NaN.
    pub fn misfit(&self, target: &[f64], q: &[f64]) -> f64 {
        largest(&self.shares(target, q))
    }

    /// The value of an expression in the parameters, and its size at typical parameters.
    pub fn factor(&self, factor: &Expression, target: &[f64]) -> (f64, f64) {
        let mut named = self.parameters(target);
        let value = evaluate(factor, &named);
        for (named, parameter) in named.iter_mut().zip(&self.system.parameters) {
            if let ParameterSource::Input(index) = parameter.source {
                named.size = self.input_size(index);
            }
        }
        (value, size(factor, &named))
    }

    /// The smallest singular value of the derivative of [`Model::shares`] by the joints in units of their typical sizes.
    pub fn sigma(&self, target: &[f64], q: &[f64]) -> f64 {
        smallest_singular_value(jacobian(q, &self.joint_sizes(target), &|q| self.shares(target, q)))
    }

    /// The determinant of that derivative; `None` if it is not square.
    pub fn determinant(&self, target: &[f64], q: &[f64]) -> Option<f64> {
        let matrix = jacobian(q, &self.joint_sizes(target), &|q| self.shares(target, q));
        matrix.is_square().then(|| matrix.determinant())
    }

    /// The largest difference of two joint vectors: in rad, or as a fraction of the typical length.
    pub fn distance(&self, target: &[f64], a: &[f64], b: &[f64]) -> f64 {
        let sizes = self.joint_sizes(target);
        self.differences(a, b).iter().zip(sizes).fold(0.0, |most, (d, size)| most.max(d.abs() / size))
    }

    fn differences(&self, to: &[f64], from: &[f64]) -> Vec<f64> {
        let one = |(joint, (to, from)): (usize, (&f64, &f64))| self.difference(joint, *to, *from);
        to.iter().zip(from).enumerate().map(one).collect()
    }

    /// Whether `b` is the same solution as `a`: within 1e-9 if `a` is ordinary, otherwise within max(1e-7, 1e-13 / sigma). Then the equations must also hold
    /// everywhere between the two.
    pub fn matches(&self, target: &[f64], a: &[f64], b: &[f64]) -> bool {
        let (distance, sigma) = (self.distance(target, a, b), self.sigma(target, a));
        if sigma > WITNESS.ordinary {
            return distance <= WITNESS.equal;
        }
        distance <= (WITNESS.exact / sigma).max(WITNESS.moved) && self.holds_between(target, a, b)
    }

    fn holds_between(&self, target: &[f64], a: &[f64], b: &[f64]) -> bool {
        let differences = self.differences(b, a);
        [0.25, 0.5, 0.75].iter().all(|share| {
            let point: Vec<f64> = a.iter().zip(&differences).map(|(a, difference)| a + share * difference).collect();
            self.misfit(target, &point) <= WITNESS.residual
        })
    }

    /// Inputs near `start` at which the joint vector `q` solves the equations. Inputs that are assumed positive change only if necessary.
    pub fn inputs_at(&self, q: &[f64], start: &[f64]) -> Option<Vec<f64>> {
        let inputs = &self.system.inputs;
        let free: Vec<usize> = (0..inputs.len()).filter(|&input| !inputs[input].positive).collect();
        let all: Vec<usize> = (0..inputs.len()).collect();
        [free, all].iter().find_map(|variables| {
            let place = |x: &[f64]| replaced(start, variables, x);
            let scales: Vec<f64> = variables.iter().map(|&input| self.input_size(input)).collect();
            let first = variables.iter().map(|&input| start[input]).collect();
            let (x, _) = newton(first, &scales, &|x| self.shares(&place(x), q));
            self.reached(place(&x), q)
        })
    }

    /// The inputs with angles in (-pi, pi], if they are allowed and `q` solves the equations.
    pub fn reached(&self, mut target: Vec<f64>, q: &[f64]) -> Option<Vec<f64>> {
        for (value, input) in target.iter_mut().zip(&self.system.inputs) {
            if input.quantity == Quantity::Angle {
                *value = angle::wrap(*value);
            }
        }
        let allowed = self.system.inputs.iter().zip(&target).all(|(input, value)| !input.positive || *value > 0.0);
        (allowed && self.misfit(&target, q) <= WITNESS.exact).then_some(target)
    }
}

impl Joints for Model<'_> {
    fn count(&self) -> usize {
        self.system.joints.len()
    }

    fn turns(&self, joint: usize) -> bool {
        matches!(self.system.joints[joint].kind, JointKindUnknown::Angle { .. })
    }
}

/// `values` with the entries at `indices` replaced by `x`.
pub(super) fn replaced(values: &[f64], indices: &[usize], x: &[f64]) -> Vec<f64> {
    let mut values = values.to_vec();
    for (&index, x) in indices.iter().zip(x) {
        values[index] = *x;
    }
    values
}

fn find<'n>(named: &'n [Named<'_>], name: &str) -> Option<&'n Named<'n>> {
    named.iter().find(|entry| entry.name == name)
}

fn evaluate(expression: &Expression, named: &[Named<'_>]) -> f64 {
    expression.evaluate_f64(&|name| find(named, name).map(|entry| entry.value)).unwrap_or(f64::NAN)
}

/// The sum of the magnitudes of the expanded terms, or more.
fn size(expression: &Expression, named: &[Named<'_>]) -> f64 {
    match expression {
        Expression::Number(_) => evaluate(expression, named).abs(),
        Expression::Name(name) => find(named, name).map_or(f64::NAN, |entry| entry.size),
        Expression::Negation(a) => size(a, named),
        Expression::Inverse(_) => evaluate(expression, named).abs(),
        Expression::Sum(terms) => terms.iter().map(|term| size(term, named)).sum(),
        Expression::Product(factors) => factors.iter().map(|factor| size(factor, named)).product(),
        Expression::Power(a, n) => size(a, named).powi(i32::try_from(*n).unwrap_or(i32::MAX)),
    }
}
