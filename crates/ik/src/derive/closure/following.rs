//! The values of relations of joints that follow others: [`follow`].

use num_traits::One;

use super::arithmetic::{Arithmetic, Factor, Multilinear};
use super::assignment::{Assignment, JointValue};
use super::coupling::Coupling;
use super::mechanism::Mechanism;
use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::BigRational;

/// An unknown of the joint `follower` minus its value by the law of `leader`. The numbers are those of [`super::Relation::followed`].
///
/// # Errors
/// [`ErrorKind::BadValue`] if the joint does not follow, or if the leader is unknown and the law is not linear.
pub(super) fn follow<A: Arithmetic>(
    mechanism: &Mechanism,
    [follower, leader, unknown]: [usize; 3],
    assignment: &Assignment<A::Value>,
    arithmetic: &mut A,
) -> Result<Multilinear<A::Value>> {
    let unfit = || Error::new(ErrorKind::BadValue, "no joint follows by this relation");
    let coupling = mechanism.joints().get(follower).and_then(|joint| joint.coupling.as_ref()).ok_or_else(unfit)?;
    let value = |joint: usize| assignment.joints.get(joint).ok_or_else(unfit);
    let place = unknown % 2;
    let law = match value(leader)? {
        JointValue::Angle { cosine, sine } => {
            known(coupling.follow(&[cosine.clone(), sine.clone()], arithmetic), place, arithmetic)
        }
        JointValue::Length(length) => {
            known(coupling.follow(std::slice::from_ref(length), arithmetic), place, arithmetic)
        }
        JointValue::Unknown if coupling.is_linear() => Some(linear(coupling, unknown, arithmetic)),
        JointValue::Unknown => None,
    };
    let own = match value(follower)? {
        JointValue::Angle { cosine, sine } => Multilinear::constant([cosine, sine][place].clone(), arithmetic),
        JointValue::Length(length) => Multilinear::constant(length.clone(), arithmetic),
        JointValue::Unknown => unit(factor(follower, unknown), arithmetic),
    };
    Ok(own.sub(&law.ok_or_else(unfit)?, arithmetic))
}

/// An entry of a law with known values.
fn known<A: Arithmetic>(values: Vec<A::Value>, place: usize, arithmetic: &A) -> Option<Multilinear<A::Value>> {
    values.into_iter().nth(place).map(|value| Multilinear::constant(value, arithmetic))
}

/// A linear law in the unknowns of the leader.
fn linear<A: Arithmetic>(coupling: &Coupling, unknown: usize, arithmetic: &mut A) -> Multilinear<A::Value> {
    let rows = coupling.coefficients();
    let row = &rows[unknown % 2];
    let one = arithmetic.rational(&BigRational::one());
    let factors = if unknown < 2 {
        vec![factor(coupling.leader, 0), factor(coupling.leader, 1)]
    } else {
        vec![factor(coupling.leader, 2)]
    };
    let constant = Multilinear::constant(one, arithmetic).scale(&row[factors.len()], arithmetic);
    factors.into_iter().zip(row).fold(constant, |sum, (factor, number)| {
        let term = unit(factor, arithmetic).scale(number, arithmetic);
        sum.add(&term, arithmetic)
    })
}

/// The polynomial that is one unknown.
fn unit<A: Arithmetic>(factor: Factor, arithmetic: &mut A) -> Multilinear<A::Value> {
    let one = arithmetic.rational(&BigRational::one());
    Multilinear::constant(one, arithmetic).times_unknown(factor, arithmetic)
}

/// The unknown of a joint with this number.
fn factor(joint: usize, unknown: usize) -> Factor {
    match unknown {
        0 => Factor::Cosine(joint),
        1 => Factor::Sine(joint),
        _ => Factor::Length(joint),
    }
}
