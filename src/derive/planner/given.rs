//! Which joint's value is to be given when a task leaves one joint too many: [`joint_to_give`].

use std::cmp::Reverse;

use super::plan;
use super::refuse::{self, driven};
use super::types::Plan;
use crate::derive::closure::Mechanism;
use crate::derive::template::fits;
use crate::kinematics::Chain;
use crate::{ErrorKind, Result, Watch};

/// The joint of `chain` with which, when its value is given, the others are found most easily: by polynomials of the least degree, then
/// with the fewest solutions; of equals the last. Where the others have no order whichever is given, the last, if the other six are found
/// together. `None` for a chain that has a joint given, or not just one too many for its task.
///
/// # Errors
/// [`ErrorKind::Unsupported`] when there is no such joint, with the number of solutions for each; what `watch` stops with.
pub fn joint_to_give(chain: &Chain, watch: &Watch) -> Result<Option<String>> {
    if !chain.given().is_empty() || chain.joints().len() != chain.task().freedoms() + 1 {
        return Ok(None);
    }
    let mechanism = Mechanism::new(chain)?;
    let places = driven(&mechanism);
    let mut plans = Vec::new();
    let mut refusals = Vec::new();
    for &joint in &places {
        watch.report("choose the joint that is given", joint, places.len() - joint);
        match plan(&mechanism.clone().with_given(&[joint])?, watch) {
            Ok(plan) => plans.push((joint, plan)),
            Err(error) if is_refusal(error.kind()) => refusals.push((joint, error)),
            Err(error) => return Err(error),
        }
    }
    let best = plans.iter().min_by_key(|(joint, plan)| (hardest(plan), plan.dimension, Reverse(*joint)));
    let best = best.map(|(joint, _)| *joint).or_else(|| together(chain));
    match best {
        Some(joint) => Ok(Some(chain.joints()[joint].name.clone())),
        None => Err(refuse::none_to_give(&mechanism, &refusals)),
    }
}

/// The joint that leaves six which are found together: the last one, or the first.
fn together(chain: &Chain) -> Option<usize> {
    let fits_with = |place: &usize| {
        let given = vec![chain.joints()[*place].name.clone()];
        let asked = chain.with_task(chain.task(), chain.direction().clone(), given);
        asked.is_ok_and(|chain| fits(&chain).is_ok())
    };
    [chain.joints().len() - 1, 0].into_iter().find(fits_with)
}

fn is_refusal(kind: ErrorKind) -> bool {
    matches!(kind, ErrorKind::Unsupported | ErrorKind::PositiveDimensional)
}

fn hardest(plan: &Plan) -> usize {
    plan.steps.iter().map(|step| step.degree).max().unwrap_or(0)
}
