//! The [`Form`] of a step's equations in their joint, determined from their exact coefficients.

use std::collections::BTreeMap;

use num_traits::{One, Zero};

use super::eliminate::Elimination;
use super::form_basis::Form;
use super::symbolic::{Symbolic, TargetPoly};
use crate::derive::closure::{Factor, Mechanism, Multilinear, Relation};
use crate::derive::planner::{PlanStep, StepMethod};
use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::BigRational;

/// The form of a step's equations, and its constant.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    /// The form.
    pub form: Form,
    /// For a [`Form::Rotation`]: `k` with `b2 = k a1` and `k b1 = -n a2`, where `ai c + bi s'` are the two equations.
    pub ratio: Option<BigRational>,
}

/// The form of the equations of `step` in its joint.
///
/// # Errors
/// [`ErrorKind::Unsupported`] if the equations do not have the structure that the step claims. [`ErrorKind::Certificate`] if an equation does not contain the
/// joint, as 0 = 0.
pub(super) fn shape(mechanism: &Mechanism, step: &PlanStep) -> Result<Shape> {
    let plain = |form| Ok(Shape { form, ratio: None });
    let revolute = mechanism.joints()[step.joint].is_revolute();
    match &step.method {
        StepMethod::Single(relation) if revolute => {
            contains(&Symbolic::new(mechanism)?.polynomial(mechanism, relation)?, step.joint)?;
            plain(Form::Angle)
        }
        StepMethod::Single(relation) => {
            let polynomial = Symbolic::new(mechanism)?.polynomial(mechanism, relation)?;
            contains(&polynomial, step.joint)?;
            let square = !part(&polynomial, Factor::LengthSquared(step.joint)).is_empty();
            plain(if square { Form::Quadratic } else { Form::Linear })
        }
        StepMethod::Pair([cosine, sine]) if follows(step.joint, [cosine, sine]) => {
            Ok(Shape { form: Form::Rotation, ratio: Some(BigRational::one()) })
        }
        StepMethod::Pair(relations) if revolute => {
            let ratio = turn(mechanism, step.joint, relations)?;
            Ok(Shape { form: if ratio.is_some() { Form::Rotation } else { Form::Pair }, ratio })
        }
        StepMethod::Pair(_) => Err(Error::new(ErrorKind::Unsupported, "two equations for one length; one is enough")),
        StepMethod::Eliminated { .. } => {
            Err(Error::new(ErrorKind::Unsupported, "the other joints are not eliminated yet"))
        }
    }
}

/// Whether these are the relations of a joint that follows another one: `c = ..` and `s' = ..`.
fn follows(joint: usize, relations: [&Relation; 2]) -> bool {
    relations
        .map(Relation::followed)
        .iter()
        .zip(0..)
        .all(|(followed, unknown)| followed.is_some_and(|[follower, _, own]| follower == joint && own == unknown))
}

/// Checks that an equation contains the joint. Otherwise every value of the joint would solve it.
fn contains(polynomial: &Multilinear<TargetPoly>, joint: usize) -> Result<()> {
    let is_contained =
        polynomial.terms().any(|(product, _)| product.list().iter().any(|factor| factor.joint() == joint));
    let text = "an equation of the step does not contain its joint";
    is_contained.then_some(()).ok_or_else(|| Error::new(ErrorKind::Certificate, text))
}

/// The form of the result of an elimination.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for a degree that no form has.
pub(super) fn eliminated(mechanism: &Mechanism, step: &PlanStep, elimination: &Elimination) -> Result<Shape> {
    let degree = elimination.degree(&elimination.member);
    let form = match (mechanism.joints()[step.joint].is_revolute(), degree) {
        (true, 1) => Form::Angle,
        (true, 2) => Form::Quartic,
        (false, 1) => Form::Linear,
        (false, 2) => Form::Quadratic,
        (false, 3 | 4) => Form::Lengths,
        _ => {
            let text = format!(
                "the result of the elimination has degree {degree}; at most 2 is allowed for an angle, 4 for a length"
            );
            return Err(Error::new(ErrorKind::Unsupported, text));
        }
    };
    Ok(Shape { form, ratio: None })
}

/// The coefficient of `factor`, by the unknowns of the other joints.
fn part(polynomial: &Multilinear<TargetPoly>, factor: Factor) -> BTreeMap<Vec<Factor>, TargetPoly> {
    let with = polynomial.terms().filter(|(product, _)| product.list().contains(&factor));
    let rest = |list: &[Factor]| list.iter().copied().filter(|other| *other != factor).collect();
    with.map(|(product, value)| (rest(product.list()), value.clone())).collect()
}

/// The constant `k` of [`Shape::ratio`], if the two equations are a rotation.
fn turn(mechanism: &Mechanism, joint: usize, relations: &[Relation; 2]) -> Result<Option<BigRational>> {
    let mut symbolic = Symbolic::new(mechanism)?;
    let mut parts = Vec::new();
    for relation in relations {
        let polynomial = symbolic.polynomial(mechanism, relation)?;
        contains(&polynomial, joint)?;
        parts.push((part(&polynomial, Factor::Cosine(joint)), part(&polynomial, Factor::Sine(joint))));
    }
    let square = &mechanism.joints()[joint].square;
    let [(a1, b1), (a2, b2)] = &parts[..] else { return Ok(None) };
    // The conditions are b2 = k a1 and -n a2 = k b1.
    let negative: BTreeMap<_, _> =
        a2.iter().map(|(product, value)| (product.clone(), symbolic.ring.scale(value, &-square))).collect();
    let ratio = quotient(b2, a1).or_else(|| quotient(&negative, b1));
    let fits = |ratio: &BigRational| {
        let is = |top: &BTreeMap<Vec<Factor>, TargetPoly>, bottom: &BTreeMap<Vec<Factor>, TargetPoly>| {
            top.len() == bottom.len()
                && bottom.iter().all(|(product, value)| top.get(product) == Some(&symbolic.ring.scale(value, ratio)))
        };
        is(b2, a1) && is(&negative, b1)
    };
    Ok(ratio.filter(|ratio| !ratio.is_zero() && fits(ratio)))
}

/// The quotient of the leading coefficients of the first terms.
fn quotient(
    top: &BTreeMap<Vec<Factor>, TargetPoly>,
    bottom: &BTreeMap<Vec<Factor>, TargetPoly>,
) -> Option<BigRational> {
    let (product, value) = bottom.iter().next()?;
    let (top, bottom) = (top.get(product)?.leading()?, value.leading()?);
    Some(&top.coefficient / &bottom.coefficient)
}
