//! The proof that a relation is in the ideal of the loop.
//!
//! {G_ij - (E1 ... En)_ij, c_i^2 + |w_i|^2 s'_i^2 - 1} is a Groebner basis in an order with the entries of G first and c_i before s'_i, because its leading
//! terms are coprime. So a polynomial is in the ideal exactly if it becomes zero after the substitution G := E1 ... En and the reduction of the squares of the
//! cosines.
//!
//! In a word, E E^-1 = 1 holds modulo the circle, so neighbours cancel before any multiplication. Each joint then occurs at most once, and the multilinear
//! polynomial is its own normal form. The laws of joints that follow others are additional generators, which only enlarge the ideal.

use super::arithmetic::Exact;
use super::assignment::{Assignment, JointValue, Target, TargetRotation};
use super::evaluate::evaluate;
use super::feature::leaves;
use super::mechanism::{Mechanism, ScrewJoint};
use super::relation::{Letter, Measure, Relation, Word};
use super::vector;
use crate::{Error, ErrorKind, Result};

/// Proves over Q that `relation` is in the ideal of the loop. Also proves that it uses only those parts of the target that the task specifies. So it holds
/// wherever the joints reach the target.
///
/// # Errors
/// [`ErrorKind::Certificate`] if the proof fails; as [`evaluate`] if it is not a relation of the mechanism.
pub fn prove(mechanism: &Mechanism, relation: &Relation) -> Result<()> {
    if relation.measure == Measure::Follow {
        return if mechanism.couplings().contains(relation) {
            Ok(())
        } else {
            Err(refused(relation, "no joint follows by this law"))
        };
    }
    if !sees(mechanism, relation) {
        return Err(refused(relation, "it uses parts of the target that the task does not specify"));
    }
    let closed = |word: &Word| closed(mechanism, relation.measure, word);
    let substituted = Relation { left: closed(&relation.left), right: closed(&relation.right), ..relation.clone() };
    let target = Target { position: vector::zero(), rotation: TargetRotation::Unspecified };
    let assignment = Assignment { joints: vec![JointValue::Unknown; mechanism.joints().len()], target };
    let normal_form = evaluate(mechanism, &substituted, &assignment, &mut Exact)?;
    if normal_form.is_zero() {
        return Ok(());
    }
    Err(refused(relation, &format!("its normal form has {} terms", normal_form.terms().len())))
}

fn refused(relation: &Relation, why: &str) -> Error {
    Error::new(ErrorKind::Certificate, format!("`{relation}` does not follow from the loop: {why}"))
}

/// Whether a relation has equal values at all targets that differ only by motions U that the task does not constrain: G U in place of G. This holds if the
/// moved object is invariant under each U, or if the relation uses only directions and no U rotates.
fn sees(mechanism: &Mechanism, relation: &Relation) -> bool {
    let unseen = mechanism.unseen();
    let turns = unseen.iter().any(ScrewJoint::is_revolute);
    let whole = unseen.is_empty() || relation.measure == Measure::Angle && !turns;
    let stays = unseen.iter().all(|motion| leaves(motion, &relation.moved, relation.measure));
    let word = |word: &Word| {
        word.0.iter().enumerate().all(|(place, letter)| match letter {
            Letter::Joint(_) | Letter::Inverse(_) => true,
            Letter::Target => whole || stays && place + 1 == word.0.len(),
            Letter::TargetInverse => whole,
        })
    };
    word(&relation.left) && word(&relation.right)
}

/// `word` after the substitution G := E1 ... En and the cancellation of E E^-1. For angles, prismatic joints are removed; they do not change directions.
fn closed(mechanism: &Mechanism, measure: Measure, word: &Word) -> Word {
    let joints = mechanism.joints();
    let mut letters: Vec<Letter> = Vec::new();
    let mut push = |letter: Letter| match (letter.joint(), letters.last()) {
        (Some(joint), _)
            if measure == Measure::Angle && joints.get(joint).is_some_and(|joint| !joint.is_revolute()) => {}
        (_, Some(last)) if *last == letter.inverse() => drop(letters.pop()),
        _ => letters.push(letter),
    };
    for &letter in &word.0 {
        match letter {
            Letter::Joint(_) | Letter::Inverse(_) => push(letter),
            Letter::Target => (0..joints.len()).map(Letter::Joint).for_each(&mut push),
            Letter::TargetInverse => (0..joints.len()).rev().map(Letter::Inverse).for_each(&mut push),
        }
    }
    Word(letters)
}
