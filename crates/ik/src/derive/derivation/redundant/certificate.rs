//! The stored proof of a redundant chain: the claims about each joint as the given one.

use serde::{Deserialize, Serialize};

use super::{Part, RedundantChain, check, given, is_determined};
use crate::Result;
use crate::derive::equations::certificate::refused;
use crate::derive::{AnyView, ChainProblem, Derivation, eigenvalue, sequential};
use groebot_robot::document::{Certificate, Proves, head_of};

/// The claims about a redundant chain.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Claims {
    /// By joint, from base to tip.
    given: Vec<Proof>,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Proof {
    joint: String,
    claims: Claim,
}

/// The claims about a chain with one joint given.
#[derive(Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Claim {
    /// It is solved joint by joint.
    Chain(sequential::certificate::Claims),
    /// It is solved as an eigenvalue problem.
    EigenvalueProblem(eigenvalue::Claims),
    /// The target determines the joint.
    Constant {},
    /// Its range is scanned.
    Scanned {},
    /// There is no solver, for this reason.
    Unsolved(String),
}

/// The text of the certificate of `derivation` with its redundancy.
///
/// # Errors
/// As [`sequential::certificate::claims`].
pub(in crate::derive) fn certificate(derivation: &Derivation, redundancy: &RedundantChain) -> Result<String> {
    let problem = chain_of(derivation)?;
    let proof = |(joint, part): (usize, &Part)| {
        let claims = match part {
            Part::Main => claim(derivation)?,
            Part::Derived(other) => claim(other)?,
            Part::Constant => Claim::Constant {},
            Part::Scanned => Claim::Scanned {},
            Part::Unsolved(reason) => Claim::Unsolved(reason.clone()),
        };
        Ok(Proof { joint: problem.chain.joints()[joint].name.clone(), claims })
    };
    let claims = Claims { given: redundancy.parts.iter().enumerate().map(proof).collect::<Result<_>>()? };
    Ok(Certificate::new(Proves::RedundantChain, problem.chain.name(), claims).to_json())
}

fn chain_of(derivation: &Derivation) -> Result<&ChainProblem> {
    match derivation.view() {
        AnyView::Sequential(view) => Ok(view.problem),
        AnyView::Eigenvalue(view) => Ok(view.problem),
        _ => Err(refused("only a chain has redundant joints".to_owned())),
    }
}

fn claim(derivation: &Derivation) -> Result<Claim> {
    match derivation.view() {
        AnyView::Sequential(view) => Ok(Claim::Chain(sequential::certificate::claims(view)?)),
        AnyView::Eigenvalue(view) => Ok(Claim::EigenvalueProblem(view.claims())),
        _ => Err(refused("only a chain has redundant joints".to_owned())),
    }
}

/// Whether `text` is the certificate of a redundant chain.
pub(in crate::derive) fn is_certificate(text: &str) -> bool {
    head_of(text).is_some_and(|(proves, _)| proves == Proves::RedundantChain)
}

/// Proves the main derivation of `problem` and its redundancy again from the text of the certificate.
///
/// # Errors
/// [`crate::ErrorKind::Syntax`] with the line for text that is not a certificate; [`crate::ErrorKind::Certificate`] with the given joint for a false claim.
pub(in crate::derive) fn prove(problem: &ChainProblem, text: &str) -> Result<(Derivation, RedundantChain)> {
    let claims: Claims = Certificate::read(text, Proves::RedundantChain, problem.chain.name())?;
    let (scanned, joint) = check(&problem.chain)?;
    let names: Vec<&str> = problem.chain.joints().iter().map(|joint| joint.name.as_str()).collect();
    if !claims.given.iter().map(|proof| proof.joint.as_str()).eq(names.iter().copied()) {
        return Err(refused(format!("the parts are not those of the joints {}", names.join(", "))));
    }
    let (mut main, mut parts) = (None, Vec::with_capacity(names.len()));
    for (place, proof) in claims.given.into_iter().enumerate() {
        let part = if scanned.contains(&place) {
            scanned_part(&proof.claims)
        } else {
            given(problem, place).and_then(|problem| again(&problem, place, proof.claims))
        };
        parts.push(match part.map_err(|error| error.with_context(format!("{} given", names[place])))? {
            Part::Derived(derivation) if place == joint => {
                main = Some(*derivation);
                Part::Main
            }
            part => part,
        });
    }
    let main = main.ok_or_else(|| refused(format!("there is no proof for the given joint {}", names[joint])))?;
    Ok((main, RedundantChain { parts }))
}

/// The part of a scanned joint.
fn scanned_part(claim: &Claim) -> Result<Part> {
    match claim {
        Claim::Scanned {} => Ok(Part::Scanned),
        _ => Err(refused("the joint is scanned: there is nothing to prove".to_owned())),
    }
}

/// The part that the claims about `problem`, which gives `joint`, prove.
fn again(problem: &ChainProblem, joint: usize, claim: Claim) -> Result<Part> {
    Ok(match claim {
        Claim::Chain(claims) => {
            let solved = sequential::certificate::prove_claims(problem, claims)?;
            Part::Derived(Box::new(Derivation::sequential_of(problem.clone(), solved)))
        }
        Claim::EigenvalueProblem(claims) => {
            let solved = eigenvalue::Eigenvalue::prove_claims(problem, claims)?;
            Part::Derived(Box::new(Derivation::eigenvalue_of(problem.clone(), solved)))
        }
        Claim::Constant {} if is_determined(problem, joint)? => Part::Constant,
        Claim::Scanned {} => return Err(refused("the joint is not scanned".to_owned())),
        Claim::Constant {} => {
            return Err(refused("no relation proves that the target determines the joint".to_owned()));
        }
        Claim::Unsolved(reason) => Part::Unsolved(reason),
    })
}
