//! Comparison of a plan's claims with new counts.

use super::types::{Evidence, Plan, StepMethod};
use super::{eliminated, sampled_relations};
use crate::derive::closure::Mechanism;
use crate::{Error, ErrorKind, Result, Watch};

/// Checks that each step of `plan` that eliminates other joints has as many values as claimed.
///
/// # Errors
/// [`ErrorKind::Certificate`] with the joint if a number differs. The error of `watch` if it stops the count.
pub fn same_degrees(mechanism: &Mechanism, plan: &Plan, watch: &Watch) -> Result<()> {
    let mut eliminations =
        plan.steps.iter().filter(|step| matches!(step.method, StepMethod::Eliminated { .. })).peekable();
    if eliminations.peek().is_none() {
        return Ok(());
    }
    let relations = mechanism.relations();
    let mut sampled = sampled_relations(mechanism, &relations)?;
    for step in eliminations {
        let counted = eliminated::count(&mut sampled, step, watch)?;
        if counted != step.degree {
            let name = &mechanism.joints()[step.joint].name;
            return Err(refused(format!("`{name}` has {counted} values in its step, {} are claimed", step.degree)));
        }
    }
    Ok(())
}

/// Checks that the claimed evidence and number of solutions are equal to those counted at the same targets. `counted` is `None` for infinitely many solutions.
///
/// # Errors
/// [`ErrorKind::Certificate`] with both numbers if they differ.
pub fn same_evidence(counted: Option<&[Evidence]>, claimed: &[Evidence], dimension: usize) -> Result<()> {
    let counted = counted.ok_or_else(|| refused("there are infinitely many solutions".to_owned()))?;
    let least = counted.iter().map(|evidence| evidence.dimension).min().unwrap_or(0);
    if least != dimension {
        return Err(refused(format!("the input has {least} solutions, {dimension} are claimed")));
    }
    match counted == claimed {
        true => Ok(()),
        false => Err(refused("the solutions counted modulo primes differ from the recorded ones".to_owned())),
    }
}

fn refused(text: String) -> Error {
    Error::new(ErrorKind::Certificate, text)
}
