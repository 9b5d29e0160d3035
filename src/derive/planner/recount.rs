//! The numbers of solutions that a plan claims, counted again from the mechanism alone.

use super::types::{Evidence, Plan, Way};
use super::{eliminated, evidence, sights};
use crate::derive::closure::Mechanism;
use crate::{Error, ErrorKind, Result, Watch};

/// Counts the solutions of `plan` again, and the values of joints that it finds by eliminating others.
///
/// # Errors
/// [`ErrorKind::Certificate`] where the plan claims other numbers; what `watch` stops with.
pub fn same_plan(mechanism: &Mechanism, plan: &Plan, watch: &Watch) -> Result<()> {
    same_evidence(mechanism, &plan.evidence, plan.dimension, watch)?;
    let eliminations = plan.steps.iter().filter(|step| matches!(step.way, Way::Eliminated { .. }));
    let relations = mechanism.relations();
    let mut seen = None;
    for step in eliminations {
        let seen = match &mut seen {
            Some(seen) => seen,
            none => none.insert(sights(mechanism, &relations)?),
        };
        let counted = eliminated::count(seen, step, watch)?;
        if counted != step.degree {
            let name = &mechanism.joints()[step.joint].name;
            let text = format!("`{name}` has {counted} values in its step, {} are claimed", step.degree);
            return Err(Error::new(ErrorKind::Certificate, text));
        }
    }
    Ok(())
}

/// Counts the solutions again at the targets modulo primes that every derivation takes.
///
/// # Errors
/// [`ErrorKind::Certificate`] where the evidence or the number that is claimed is another; what `watch` stops with.
pub fn same_evidence(mechanism: &Mechanism, claimed: &[Evidence], dimension: usize, watch: &Watch) -> Result<()> {
    let counted = evidence::gather(mechanism, &mechanism.relations(), watch)?;
    let counted = counted.ok_or_else(|| refused("there are infinitely many solutions".to_owned()))?;
    let least = counted.iter().map(|evidence| evidence.dimension).min().unwrap_or(0);
    if least != dimension {
        return Err(refused(format!("the input has {least} solutions, {dimension} are claimed")));
    }
    if counted != claimed {
        return Err(refused("the solutions counted modulo primes are not those that are recorded".to_owned()));
    }
    Ok(())
}

fn refused(text: String) -> Error {
    Error::new(ErrorKind::Certificate, text)
}
