//! The proof that a relation is in the ideal of the loop.
//!
//! {G_ij - (E1 ... En)_ij, c_i^2 + |w_i|^2 s'_i^2 - 1} is a Groebner basis in an order with the entries of G first and c_i before s'_i:
//! its leading terms are coprime. So a polynomial is in the ideal exactly when substituting G := E1 ... En and reducing the squares of
//! the cosines gives zero. In a word, E E^-1 = 1 holds modulo the circle, so neighbours cancel before anything is multiplied out; each
//! joint is then left once at most, and the multilinear polynomial is its own normal form. Where joints follow others, these laws are generators too:
//! what is in the ideal without them is in it with them.

use super::arithmetic::Exact;
use super::assignment::{Assignment, JointValue, Target, Turn};
use super::evaluate::evaluate;
use super::feature::leaves;
use super::mechanism::{Mechanism, ScrewJoint};
use super::relation::{Letter, Measure, Relation, Word};
use super::vector;
use crate::{Error, ErrorKind, Result};

/// Proves over Q that `relation` is in the ideal of the loop, and that it asks of the target only what the task sees: that it holds wherever the
/// joints reach the target.
///
/// # Errors
/// [`ErrorKind::Certificate`] when it is not; as [`evaluate`] when it is no relation of the mechanism.
pub fn prove(mechanism: &Mechanism, relation: &Relation) -> Result<()> {
    if relation.measure == Measure::Follow {
        return if mechanism.couplings().contains(relation) {
            Ok(())
        } else {
            Err(refused(relation, "no joint follows so"))
        };
    }
    if !sees(mechanism, relation) {
        return Err(refused(relation, "it needs more of the target than the task sees"));
    }
    let closed = |word: &Word| closed(mechanism, relation.measure, word);
    let substituted = Relation { left: closed(&relation.left), right: closed(&relation.right), ..relation.clone() };
    let target = Target { position: vector::zero(), turn: Turn::Nothing };
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

/// Whether a relation is the same at all targets that differ by what the task does not see of them, which are motions U behind the last joint: G U in the
/// place of G. That is so where each U leaves what is moved in place, or where only directions count and U turns nothing.
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

/// `word` with G := E1 ... En, and E E^-1 cancelled. Sliding joints do not act on directions, which is all that angles see.
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
