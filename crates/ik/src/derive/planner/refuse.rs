//! Error messages for chains without a plan: which joints are free, or which geometric properties are missing.

use super::constant::is_constant;
use super::types::Evidence;
use crate::derive::closure::Mechanism;
use crate::derive::samples::evidence::is_finite;
use crate::{Error, ErrorKind, Result, Watch};
use groebot_robot::kinematics::ExactVector;

/// A mechanism without a plan.
pub struct Refusal {
    pub error: Error,
    /// The result of the search in one clause, without advice.
    pub result: String,
}

/// The refusal of a mechanism with infinitely many solutions. It names the joints of which one may be given.
///
/// # Errors
/// The error of `watch` if it stops the search.
pub fn free(mechanism: &Mechanism, watch: &Watch) -> Result<Refusal> {
    let (constant, rest) = constant_among(mechanism)?;
    if !constant.is_empty() {
        let others = free(&mechanism.clone().with_given(&rest)?, watch)?;
        let result = format!("the target alone determines {}", constant.join(", "));
        let text = format!("{result}: constant on every self-motion, so not to be given; {}", others.error.message());
        return Ok(Refusal { error: Error::new(ErrorKind::PositiveDimensional, text), result });
    }
    let (unknown, freedoms) = (driven(mechanism), mechanism.task().freedoms());
    let suits = if unknown.len() <= freedoms + 1 { suitable(mechanism, watch)? } else { Vec::new() };
    let advice = match suits.as_slice() {
        [] if unknown.len() > freedoms => format!("give the values of at least {}", unknown.len() - freedoms),
        [] if unknown.len() > 1 => "give more than one joint, or choose another task".to_owned(),
        [] => "choose another task".to_owned(),
        [one] => format!("give the value of the joint {one}"),
        list => format!("give the value of one of the joints {}", list.join(", ")),
    };
    let result =
        format!("the `{}` task leaves some of the {} unknown joints free", mechanism.task().name(), unknown.len());
    Ok(Refusal { error: Error::new(ErrorKind::PositiveDimensional, format!("{result}: {advice}")), result })
}

/// The names of given joints that are constant on every self-motion, and the indices of the other given joints.
fn constant_among(mechanism: &Mechanism) -> Result<(Vec<String>, Vec<usize>)> {
    let (mut constant, mut rest) = (Vec::new(), Vec::new());
    let leads = |joint: &&usize| mechanism.joints()[**joint].follows.is_none();
    for &joint in mechanism.given().iter().filter(leads) {
        match mechanism.upright_loop().is_none() && is_constant(mechanism, joint)? {
            true => constant.push(format!("`{}`", mechanism.joints()[joint].name)),
            false => rest.push(joint),
        }
    }
    Ok((constant, rest))
}

/// The indices of the chain's own joints that are not given and follow no other.
pub(super) fn driven(mechanism: &Mechanism) -> Vec<usize> {
    let leads = |joint: &usize| mechanism.hidden() != Some(*joint) && mechanism.joints()[*joint].coupling.is_none();
    mechanism.unknown().into_iter().filter(leads).collect()
}

/// The error for a mechanism with one redundant joint if none can be given. It reports the result for each joint.
pub fn none_to_give(mechanism: &Mechanism, results: &[(usize, String)]) -> Error {
    let count = results.len();
    let result =
        |(joint, result): &(usize, String)| format!("with `{}` given, {result}", mechanism.joints()[*joint].name);
    let results: Vec<String> = results.iter().map(result).collect();
    let text = format!(
        "the `{}` task leaves one of the {} joints free, and no joint that is given leaves others that can be found one at a time with \
         at most 4 values each (an eigenvalue problem is for a pose): {}",
        mechanism.task().name(),
        count,
        results.join("; ")
    );
    Error::new(ErrorKind::Unsupported, text)
}

/// The names of the joints that leave finitely many solutions when their value is given.
fn suitable(mechanism: &Mechanism, watch: &Watch) -> Result<Vec<String>> {
    let relations = mechanism.relations();
    let mut names = Vec::new();
    for joint in driven(mechanism) {
        let given: Vec<usize> = mechanism.given().iter().copied().chain([joint]).collect();
        if given.len() < mechanism.driven().len()
            && is_finite(&mechanism.clone().with_given(&given)?, &relations, watch)?
        {
            names.push(format!("`{}`", mechanism.joints()[joint].name));
        }
    }
    Ok(names)
}

/// The refusal of a mechanism whose joints cannot be found one at a time with at most four solutions each.
pub fn no_plan(mechanism: &Mechanism, evidence: &Evidence, product: Option<usize>) -> Refusal {
    let found = match product {
        None => "no order of the joints determines one at a time with at most 4 values each".to_owned(),
        Some(product) => format!("the best order of the joints gives {product} instead"),
    };
    solved_by_none(mechanism, evidence, &found)
}

/// The error for a mechanism whose plan fails with `error` when its equations are derived.
pub fn not_derived(mechanism: &Mechanism, evidence: &Evidence, error: &Error) -> Error {
    solved_by_none(mechanism, evidence, error.message()).error
}

/// The refusal of a mechanism without a solver because of `found`. It gives the number of solutions and the missing geometric properties.
fn solved_by_none(mechanism: &Mechanism, evidence: &Evidence, found: &str) -> Refusal {
    let degree = |&joint: &usize| format!("`{}` {}", mechanism.joints()[joint].name, evidence.degrees[joint]);
    let degrees: Vec<String> = driven(mechanism).iter().map(degree).collect();
    let result =
        format!("a target of the `{}` task has {} complex solutions", mechanism.task().name(), evidence.dimension);
    let text = format!(
        "{result} (values of the joints: {}); {found}; {}; a search (`groebot ik --numeric`) may find some of them",
        degrees.join(", "),
        lacking(mechanism)
    );
    Refusal { error: Error::new(ErrorKind::Unsupported, text), result }
}

/// Text that lists neighbouring axes that meet or are parallel, and those that would have to.
fn lacking(mechanism: &Mechanism) -> String {
    let count = mechanism.driven().len();
    let triples: Vec<usize> = (0..count.saturating_sub(2)).collect();
    let names = |first: &usize| format!("{}-{}-{}", first + 1, first + 2, first + 3);
    let list = |triples: &[usize]| triples.iter().map(names).collect::<Vec<_>>().join(", ");
    let (good, bad): (Vec<usize>, Vec<usize>) = triples.into_iter().partition(|&first| is_special(mechanism, first));
    match (good.as_slice(), bad.as_slice()) {
        ([], []) => "no three axes are neighbours".to_owned(),
        ([], bad) => format!(
            "three neighbouring axes would have to meet in one point or be parallel (joints {}); none do",
            list(bad)
        ),
        (good, _) => {
            format!("joints {} meet in one point, are parallel or are prismatic, which is not enough", list(good))
        }
    }
}

/// Whether three neighbouring joints have parallel axes or axes through one point, or are prismatic.
fn is_special(mechanism: &Mechanism, first: usize) -> bool {
    let joints = &mechanism.joints()[first..first + 3];
    let along = |a: &ExactVector, b: &ExactVector| (0..3).all(|k| &a[k] * &b[(k + 1) % 3] == &a[(k + 1) % 3] * &b[k]);
    joints.iter().all(|joint| along(&joint.axis, &joints[0].axis))
        || joints.iter().filter(|joint| !joint.is_revolute()).count() > 1
        || crate::derive::closure::common_point(joints).is_some()
}
