//! The equations of a chain: forward kinematics as exact polynomials in the joints' cosines, sines and lengths.
//!
//! The product of exponentials `e^(S1 q1) ... e^(Sn qn)` (RH0 2-20) transforms the tip, by Rodrigues' formula. Each coordinate of the task gives one equation,
//! tip - target = 0.

use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

use crate::derive::equations::setting::{Coefficients, Poly, Unknowns, expression_of};
use crate::derive::{
    Choice, Equation, Input, JointKindUnknown, JointUnknown, Parameter, ParameterSource, System, SystemParts,
};
use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::{BigRational, Rationals, Ring};
use groebot_algebra::poly::{Expression, Fractions, Order, PolynomialRing, rational_root};
use groebot_robot::document::{shown, word};
use groebot_robot::kinematics::{Chain, ExactVector, Joint, JointKind, Plane, TargetNumber, Task};
use groebot_robot::spatial::exact::vector::{dot, unit};

/// The equations of `chain` for its task.
///
/// The inputs are those of `px`, `py`, `pz` that the task has, then `phi` for a planar pose. `phi` is the rotation angle of the tip frame about the plane's
/// normal, from the zero configuration.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for the pose task: its nine orientation parameters are related and need the planner of blocks. [`ErrorKind::Unsupported`] also
/// for given joints and for joints that follow others (mimic). [`ErrorKind::DuplicateName`] when a joint's symbol collides with a parameter.
pub fn formulate(chain: &Chain) -> Result<System> {
    let task = chain.task();
    if task.plane().is_none() && task != Task::Position {
        let text = format!(
            "the `{}` task has related orientation parameters, which one system of equations does not represent; give `position`, \
             `planar_position` or `planar_pose`",
            task.name()
        );
        return Err(Error::new(ErrorKind::Unsupported, text));
    }
    if !chain.given().is_empty() {
        let text = "joints with given values need the planner of blocks; omit `given`";
        return Err(Error::new(ErrorKind::Unsupported, text));
    }
    if let Some(joint) = chain.joints().iter().find(|joint| joint.mimic.is_some()) {
        let text = format!(
            "joint `{}` follows another one (mimic), which needs the planner of blocks; omit `order` and `choice`",
            shown(&joint.name)
        );
        return Err(Error::new(ErrorKind::Unsupported, text));
    }
    let model = Model::new(chain)?;
    let mut parts = SystemParts {
        name: word(chain.name()),
        description: chain.parts().description.clone().unwrap_or_default(),
        source: chain.parts().source.clone().unwrap_or_default(),
        length_unit: chain.length_unit(),
        task: Some(task),
        parameters: model.roots.iter().map(Root::parameter).collect(),
        joints: chain.joints().iter().map(joint_unknown).collect(),
        choice: chain.choice().map(|choice| Choice { unknown: choice.unknown.clone(), root: choice.root }),
        ..SystemParts::default()
    };
    let tip = model.carry(chain, chain.tip().point.clone(), true)?;
    for number in task.layout().numbers() {
        let name = number.name();
        match *number {
            TargetNumber::Position(axis) => {
                let (axis, label) = (axis.coordinate(), axis.name());
                add_input(&mut parts, *number, &[(&name, ParameterSource::Input)]);
                parts.equations.push(model.equation(label, &tip[axis], &name));
            }
            TargetNumber::PlaneAngle(plane) => {
                let [cosine, sine] = ["c", "s"].map(|letter| format!("{letter}{name}"));
                let sources: [(&str, Source); 2] = [(&cosine, ParameterSource::Cosine), (&sine, ParameterSource::Sine)];
                add_input(&mut parts, *number, &sources);
                let (first, second) = oriented_axes(plane);
                let turned = model.carry(chain, unit(first), false)?;
                parts.equations.push(model.equation(&format!("cos {name}"), &turned[first], &cosine));
                parts.equations.push(model.equation(&format!("sin {name}"), &turned[second], &sine));
            }
            _ => {}
        }
    }
    parts.order = chain.order().map_or_else(|| parts.default_order(), <[String]>::to_vec);
    System::new(parts)
}

fn joint_unknown(joint: &Joint) -> JointUnknown {
    let kind = match joint.kind {
        JointKind::Revolute => {
            JointKindUnknown::Angle { cosine: format!("c{}", joint.symbol), sine: format!("s{}", joint.symbol) }
        }
        JointKind::Prismatic => JointKindUnknown::Value { unknown: format!("d{}", joint.symbol) },
    };
    JointUnknown { name: joint.name.clone(), kind }
}

type Source = fn(usize) -> ParameterSource;

fn add_input(parts: &mut SystemParts, number: TargetNumber, parameters: &[(&str, Source)]) {
    let index = parts.inputs.len();
    parts.inputs.push(Input { name: number.name(), quantity: number.quantity(), positive: false });
    let parameter =
        |(name, source): &(&str, Source)| Parameter { name: (*name).to_owned(), source: source(index), square: None };
    parts.parameters.extend(parameters.iter().map(parameter));
}

/// The in-plane axes `(a, b)` such that a rotation about the plane's normal takes `a` towards `b`.
fn oriented_axes(plane: Plane) -> (usize, usize) {
    let normal = plane.normal();
    ((normal + 1) % 3, (normal + 2) % 3)
}

/// A square root of an integer, in the length of an axis.
#[derive(Clone, Debug, PartialEq)]
struct Root {
    radicand: BigInt,
}

impl Root {
    fn name(&self) -> String {
        format!("root{}", self.radicand)
    }

    fn parameter(&self) -> Parameter {
        let square = Some(Expression::Number(BigRational::from_integer(self.radicand.clone())));
        Parameter { name: self.name(), source: ParameterSource::SquareRoot, square }
    }
}

/// The polynomial ring of the forward kinematics.
struct Model {
    ring: Unknowns,
    roots: Vec<Root>,
}

impl Model {
    fn new(chain: &Chain) -> Result<Self> {
        let mut roots: Vec<Root> = Vec::new();
        for joint in chain.joints() {
            if let Some(root) = axis_root(&joint.axis)
                && !roots.contains(&root)
            {
                roots.push(root);
            }
        }
        let names: Vec<String> = roots.iter().map(Root::name).collect();
        let mut field: Coefficients = Fractions::new(Rationals, &names)?;
        for (index, root) in roots.iter().enumerate() {
            let square = field.ring().from_integer(&root.radicand);
            field = field.with_square(index, &square)?;
        }
        Ok(Model { ring: PolynomialRing::new(field, &chain.unknowns(), Order::Lex)?, roots })
    }

    fn number(&self, q: &BigRational) -> Poly {
        let field = self.ring.field();
        self.ring.constant(field.embed(&field.ring().constant(q.clone())))
    }

    fn variable(&self, letter: char, joint: &Joint) -> Result<Poly> {
        let name = format!("{letter}{}", joint.symbol);
        let missing = || Error::new(ErrorKind::UnknownName, format!("no unknown `{name}`"));
        self.ring.index_of(&name).map(|index| self.ring.variable(index)).ok_or_else(missing)
    }

    /// The unit vector `u / |u|` of an axis. `1 / |u|` is a rational, or a rational times a square root.
    fn direction(&self, axis: &ExactVector) -> [Poly; 3] {
        let square = dot(axis, axis);
        let scale = match axis_root(axis) {
            None => self.number(&rational_root(&square).unwrap_or_else(BigRational::one).recip()),
            Some(root) => {
                // 1/sqrt(n) = sqrt(d) k / n with n = d (k/..)^2: its square is 1/n.
                let radicand = BigRational::from_integer(root.radicand.clone());
                let factor = rational_root(&(square * radicand).recip()).unwrap_or_else(BigRational::one);
                let name = self.ring.generator(&root.name()).unwrap_or_else(|| self.ring.one());
                self.ring.mul(&self.number(&factor), &name)
            }
        };
        axis.each_ref().map(|entry| self.ring.mul(&self.number(entry), &scale))
    }

    /// `vector` in the base frame after all joints have moved: a point if `is_point`, otherwise a free vector.
    fn carry(&self, chain: &Chain, vector: ExactVector, is_point: bool) -> Result<[Poly; 3]> {
        let start = vector.each_ref().map(|entry| self.number(entry));
        chain.joints().iter().rev().try_fold(start, |vector, joint| match joint.kind {
            JointKind::Revolute => self.rotate(joint, &vector, is_point),
            JointKind::Prismatic if is_point => {
                let length = self.variable('d', joint)?;
                let axis = self.direction(&joint.axis);
                Ok(std::array::from_fn(|k| self.ring.add(&vector[k], &self.ring.mul(&length, &axis[k]))))
            }
            JointKind::Prismatic => Ok(vector),
        })
    }

    /// Rodrigues' rotation formula, `x + s (w x x) + (1 - c) (w x (w x x))`. A point is rotated about a point of the axis.
    fn rotate(&self, joint: &Joint, vector: &[Poly; 3], is_point: bool) -> Result<[Poly; 3]> {
        let ring = &self.ring;
        let (cosine, sine) = (self.variable('c', joint)?, self.variable('s', joint)?);
        let axis = self.direction(&joint.axis);
        let centre = if is_point { joint.point.each_ref().map(|e| self.number(e)) } else { unit_zero(ring) };
        let arm: [Poly; 3] = std::array::from_fn(|k| ring.sub(&vector[k], &centre[k]));
        let once = self.cross(&axis, &arm);
        let twice = self.cross(&axis, &once);
        let versine = ring.sub(&ring.one(), &cosine);
        Ok(std::array::from_fn(|k| {
            let turn = ring.add(&ring.mul(&sine, &once[k]), &ring.mul(&versine, &twice[k]));
            ring.add(&vector[k], &turn)
        }))
    }

    fn cross(&self, a: &[Poly; 3], b: &[Poly; 3]) -> [Poly; 3] {
        let ring = &self.ring;
        std::array::from_fn(|k| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            ring.sub(&ring.mul(&a[i], &b[j]), &ring.mul(&a[j], &b[i]))
        })
    }

    fn equation(&self, label: &str, value: &Poly, target: &str) -> Equation {
        let value = expression_of(&self.ring, value);
        let target = Expression::name(target).negated();
        let expression = match value {
            Expression::Sum(mut terms) => {
                terms.push(target);
                Expression::Sum(terms)
            }
            single => Expression::Sum(vec![single, target]),
        };
        Equation { label: label.to_owned(), expression }
    }
}

fn unit_zero(ring: &Unknowns) -> [Poly; 3] {
    std::array::from_fn(|_| ring.zero())
}

/// The square root in the length of an axis: that of the square-free part of `n` when `|u|^2` is `n` times a square.
fn axis_root(axis: &ExactVector) -> Option<Root> {
    let square = dot(axis, axis);
    let product = square.numer() * square.denom();
    let radicand = square_free_part(product.abs());
    (!radicand.is_one()).then_some(Root { radicand })
}

/// `n` without the squares of small factors. Axes of equal direction or shape then share one root.
fn square_free_part(mut n: BigInt) -> BigInt {
    if n.sqrt().pow(2) == n {
        return BigInt::one();
    }
    for factor in 2u32..1000 {
        let square = BigInt::from(factor * factor);
        while (&n % &square).is_zero() {
            n /= &square;
        }
    }
    n
}

/// The equations of `chain`, if its task can be solved as one system.
pub(crate) fn formulated(chain: &Chain) -> Result<Option<System>> {
    let by_steps = chain.order().is_none() && chain.choice().is_none();
    let follows = chain.joints().iter().any(|joint| joint.mimic.is_some());
    match formulate(chain) {
        Ok(system) => Ok(Some(system)),
        Err(error) if error.kind() == ErrorKind::Unsupported && (by_steps || !follows) => Ok(None),
        // Equations need valid names; a chain that is solved joint by joint does not.
        Err(_) if by_steps => Ok(None),
        Err(error) => Err(error),
    }
}
