//! Joints that are constant on every self-motion: [`constant_relation`], [`is_constant`].

use super::sampled_relations;
use crate::Result;
use crate::derive::closure::{Factor, Letter, Mechanism, Relation, Word, prove};
use crate::derive::samples::sampled_relations::{coefficient, is_sound};

/// A relation of the target and one joint alone, proved over Q. It shows that the joint (an index) is constant on every self-motion at all targets. `None` if no
/// relation of the planner shows this.
///
/// The joint is alone on one side of the relation, and the target on the other. So the coefficients of the joint's unknowns are numbers. They are not all zero,
/// so the joint has at most two values at each target. Values of given joints are disregarded.
///
/// # Errors
/// [`ErrorKind::BadValue`](crate::ErrorKind::BadValue) for an index beyond the last joint; as [`Mechanism::with_given`].
pub fn constant_relation(mechanism: &Mechanism, joint: usize) -> Result<Option<Relation>> {
    // As a given joint, it must be one of the chain.
    mechanism.clone().with_given(&[joint])?;
    let mechanism = mechanism.clone().with_given(&[])?;
    let relations = mechanism.relations();
    let alone = |word: &Word| word.0.len() == 1 && word.0[0].joint() == Some(joint);
    let still = |word: &Word| word.0.iter().all(|letter| letter.joint().is_none());
    let splits = |[a, b]: [&Word; 2]| alone(a) && still(b) && !a.0.contains(&Letter::Target);
    let mut sampled = sampled_relations(&mechanism, &relations)?;
    let candidates: Vec<usize> = sampled.among(1 << joint, 0).collect();
    for index in candidates {
        let relation = &relations[index];
        if !splits([&relation.left, &relation.right]) && !splits([&relation.right, &relation.left]) {
            continue;
        }
        let terms = sampled.of(index, 1 << joint)?;
        let factors = [Factor::Cosine(joint), Factor::Sine(joint), Factor::Length(joint), Factor::LengthSquared(joint)];
        if factors.iter().any(|factor| is_sound(&coefficient(&terms, &[*factor]))) {
            prove(&mechanism, relation)?;
            return Ok(Some(relation.clone()));
        }
    }
    Ok(None)
}

/// Whether a relation of the planner proves that a joint (an index) is constant on every self-motion ([`constant_relation`]): for example the elbow of an arm
/// with a spherical shoulder and a spherical wrist. Such a joint cannot be given.
///
/// # Errors
/// As [`constant_relation`].
pub fn is_constant(mechanism: &Mechanism, joint: usize) -> Result<bool> {
    Ok(constant_relation(mechanism, joint)?.is_some())
}
