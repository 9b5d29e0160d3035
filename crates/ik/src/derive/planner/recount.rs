//! The numbers of solutions that a plan claims, beside those that are counted again.

use super::types::{Evidence, Plan, Way};
use super::{eliminated, sights};
use crate::derive::closure::Mechanism;
use crate::{Error, ErrorKind, Result, Watch};

/// Whether the values of joints that `plan` finds by eliminating others are as many as it claims.
///
/// # Errors
/// [`ErrorKind::Certificate`] with the joint where they are not; what `watch` stops with.
pub fn same_degrees(mechanism: &Mechanism, plan: &Plan, watch: &Watch) -> Result<()> {
    let mut eliminations = plan.steps.iter().filter(|step| matches!(step.way, Way::Eliminated { .. })).peekable();
    if eliminations.peek().is_none() {
        return Ok(());
    }
    let relations = mechanism.relations();
    let mut sights = sights(mechanism, &relations)?;
    for step in eliminations {
        let counted = eliminated::count(&mut sights, step, watch)?;
        if counted != step.degree {
            let name = &mechanism.joints()[step.joint].name;
            return Err(refused(format!("`{name}` has {counted} values in its step, {} are claimed", step.degree)));
        }
    }
    Ok(())
}

/// Whether the evidence that is claimed, and the number of solutions, are what was counted at the same targets; none was counted where solutions
/// are infinitely many.
///
/// # Errors
/// [`ErrorKind::Certificate`] with both numbers where they are not.
pub fn same_evidence(counted: Option<&[Evidence]>, claimed: &[Evidence], dimension: usize) -> Result<()> {
    let counted = counted.ok_or_else(|| refused("there are infinitely many solutions".to_owned()))?;
    let least = counted.iter().map(|evidence| evidence.dimension).min().unwrap_or(0);
    if least != dimension {
        return Err(refused(format!("the input has {least} solutions, {dimension} are claimed")));
    }
    match counted == claimed {
        true => Ok(()),
        false => Err(refused("the solutions counted modulo primes are not those that are recorded".to_owned())),
    }
}

fn refused(text: String) -> Error {
    Error::new(ErrorKind::Certificate, text)
}
