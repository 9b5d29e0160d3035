//! The stored proof of a derivation: `certificate.json`.
//!
//! It lists the basis and the cofactors of each stratum, in the order in which the tree grows. A reader builds the tree again from the equations:
//! [`groebot_algebra::groebner::verify`] checks every claim, and every denominator is factored and branched on again. The Groebner engine is used only for a
//! stratum that is claimed to be open: the engine must also leave it open. The result is proved [`Equations`], or an error that names the failed part.

use serde::{Deserialize, Serialize};

use crate::derive::System;
use crate::derive::equations::certify::Certified;
use crate::derive::equations::grow::grow;
use crate::derive::equations::prover::{Engine, MEMBER, Orders, Prover, joints_of, member_setting, specialises};
use crate::derive::equations::setting::{Poly, Setting, Unknowns};
use crate::derive::equations::tree::{Node, Outcome, SelfMotion, Solved};
use crate::derive::equations::triangular::triangularise;
use crate::derive::equations::{Equations, EquationsView};
use crate::solver::Program;
use crate::{Error, ErrorKind, Result, Watch};
use groebot_algebra::groebner::Basis;
use groebot_algebra::groebner::verify::Proof;
use groebot_algebra::number::{Ring, Style};
use groebot_algebra::poly::{Order, parse};
use groebot_robot::document::{Certificate, Proves};

/// The claims about equations.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Claims {
    requested: Vec<Entry>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    searched: Option<Vec<Entry>>,
}

/// The claim about one stratum.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::derive) struct Entry {
    stratum: String,
    claim: Claim,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Kind {
    /// Finitely many solutions, with a lexicographic basis.
    Solved,
    /// No solution: the unit ideal.
    Inconsistent,
    /// Free joints, with a graded basis. The next entry is the member with these joints at zero.
    SelfMotion,
    /// Not derived.
    Open,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Claim {
    kind: Kind,
    #[serde(default, skip_serializing_if = "String::is_empty")]
    reason: String,
    order: Vec<String>,
    basis: Vec<String>,
    /// `basis[i] = sum over j of cofactors[i][j] * equation j`.
    cofactors: Vec<Vec<String>>,
}

/// The text of `certificate.json`.
///
/// # Errors
/// If a setting's field cannot be built. This does not occur for a derivation that this crate made.
pub(in crate::derive) fn write(derivation: EquationsView<'_>) -> Result<String> {
    let claims = Claims {
        requested: entries(&derivation.method.requested)?,
        searched: derivation.method.searched.as_ref().map(entries).transpose()?,
    };
    Ok(Certificate::new(Proves::Equations, &derivation.problem.name, claims).to_json())
}

/// Proves the solution of `system` again from the text of its certificate, without the Groebner engine, and compiles its solver.
///
/// # Errors
/// [`ErrorKind::Syntax`] with the line for text that is not a certificate. [`ErrorKind::Certificate`] with the stratum for a claim that is false, missing or
/// superfluous.
pub(in crate::derive) fn prove(system: &System, text: &str) -> Result<(Equations, Program)> {
    let claims: Claims = Certificate::read(text, Proves::Equations, &system.name)?;
    let requested = replay(system, Orders::Requested, &claims.requested);
    let requested = requested.map_err(|error| error.with_context("requested order"))?;
    let searched = claims.searched.as_ref().map(|entries| replay(system, Orders::Searched, entries)).transpose();
    let searched = searched.map_err(|error| error.with_context("searched order"))?;
    let generic = requested.solved().map(|solved| solved.certified.order.as_slice());
    if generic != Some(system.order.as_slice()) {
        return Err(refused("the generic stratum is not solved in the order that the input requests".to_owned()));
    }
    Equations { requested, searched }.compiled(system)
}

/// The error of a false claim.
pub(in crate::derive) fn refused(text: String) -> Error {
    Error::new(ErrorKind::Certificate, text)
}

/// The proved tree of strata of `system` in these orders, from its claims.
///
/// # Errors
/// [`ErrorKind::Certificate`] with the stratum for a claim that is false, missing or superfluous, or that is weaker than the derivation's.
pub(in crate::derive) fn replay(system: &System, orders: Orders, entries: &[Entry]) -> Result<Node> {
    let mut replay = Replay { system, orders, entries: entries.iter() };
    let node = grow(system, &mut replay)?;
    match (replay.entries.next(), &node.outcome) {
        (Some(entry), _) => Err(refused(format!("stratum `{}` does not belong to this derivation", entry.stratum))),
        (None, Outcome::Solved(_)) => Ok(node),
        (None, _) => Err(refused("the generic stratum is not solved".to_owned())),
    }
}

pub(in crate::derive) fn entries(node: &Node) -> Result<Vec<Entry>> {
    let mut list = Vec::new();
    for node in node.walk() {
        push_entry(node, &mut list)?;
    }
    Ok(list)
}

fn push_entry(node: &Node, list: &mut Vec<Entry>) -> Result<()> {
    let (kind, certified, reason) = match &node.outcome {
        Outcome::Solved(solved) => (Kind::Solved, Some(&solved.certified), ""),
        Outcome::Inconsistent(certified) => (Kind::Inconsistent, Some(certified.as_ref()), ""),
        Outcome::SelfMotion(self_motion) => (Kind::SelfMotion, Some(&self_motion.certified), ""),
        Outcome::Open(reason) if node.derivable => (Kind::Open, None, reason.as_str()),
        Outcome::Open(_) | Outcome::Seen(_) => return Ok(()),
    };
    let mut claim =
        Claim { kind, reason: reason.to_owned(), order: Vec::new(), basis: Vec::new(), cofactors: Vec::new() };
    if let Some(certified) = certified {
        let ring = certified.ring(&node.setting)?;
        let texts = |list: &[Poly]| list.iter().map(|f| ring.format(f, Style::Text)).collect::<Vec<_>>();
        claim.order.clone_from(&certified.order);
        claim.basis = texts(&certified.basis);
        claim.cofactors = certified.cofactors.iter().map(|row| texts(row)).collect();
    }
    list.push(Entry { stratum: node.label.clone(), claim });
    if let Outcome::SelfMotion(self_motion) = &node.outcome {
        push_entry(&self_motion.member, list)?;
    }
    Ok(())
}

/// A prover that checks stored claims, in order.
struct Replay<'a> {
    system: &'a System,
    orders: Orders,
    entries: std::slice::Iter<'a, Entry>,
}

impl Prover for Replay<'_> {
    fn prove(&mut self, label: &str, setting: &Setting, parent: Option<&Solved>) -> Result<Outcome> {
        let claim = match self.entries.next() {
            Some(entry) if entry.stratum == label => &entry.claim,
            Some(entry) => {
                return Err(refused(format!("stratum `{label}` is missing; `{}` is in its place", entry.stratum)));
            }
            None => return Err(refused(format!("stratum `{label}` is missing"))),
        };
        self.check(claim, label, setting, parent).map_err(|error| {
            let text = format!("stratum `{label}`: {}", error.message());
            Error::new(ErrorKind::Certificate, text)
        })
    }
}

impl Replay<'_> {
    fn check(&mut self, claim: &Claim, label: &str, setting: &Setting, parent: Option<&Solved>) -> Result<Outcome> {
        if claim.kind == Kind::Open {
            return self.open(claim, label, setting, parent);
        }
        let (ring, certified) = verified(claim, setting)?;
        let basis = Basis { ring: ring.clone(), polynomials: certified.basis.clone(), cofactors: Vec::new() };
        match (claim.kind, basis.independent_variables()) {
            (Kind::Inconsistent, None) => Ok(Outcome::Inconsistent(Box::new(certified))),
            (Kind::Solved, Some(free)) if free.is_empty() => {
                let inherited = parent.map(|parent| specialises(parent, setting, &basis)).transpose()?.unwrap_or(false);
                let triangular = triangularise(&ring, &certified.basis)?;
                Ok(Outcome::Solved(Box::new(Solved { certified, triangular, inherited })))
            }
            (Kind::SelfMotion, Some(free)) if !free.is_empty() => {
                let free = joints_of(self.system, &ring, &free);
                let member = member_setting(self.system, setting, &free);
                if label == MEMBER {
                    return Err(refused("a member of a self-motion is a self-motion again".to_owned()));
                }
                let outcome = self.prove(MEMBER, &member, None)?;
                let member = Box::new(Node::leaf(MEMBER, member, outcome));
                Ok(Outcome::SelfMotion(Box::new(SelfMotion { free, certified, member })))
            }
            _ => Err(refused("the basis is not of the claimed kind".to_owned())),
        }
    }
}

impl Replay<'_> {
    /// Accepts an open stratum only if the derivation also leaves it open, for the same reason. The engine runs again.
    fn open(&self, claim: &Claim, label: &str, setting: &Setting, parent: Option<&Solved>) -> Result<Outcome> {
        let mut engine = Engine { system: self.system, orders: self.orders, watch: &Watch::none() };
        match engine.prove(label, setting, parent)? {
            Outcome::Open(reason) if reason == claim.reason => Ok(Outcome::Open(reason)),
            Outcome::Open(reason) => Err(refused(format!("it is open, but for another reason: {reason}"))),
            _ => Err(refused("it is claimed to be open, but it can be derived".to_owned())),
        }
    }
}

/// The claimed basis, verified against the setting's equations.
fn verified(claim: &Claim, setting: &Setting) -> Result<(Unknowns, Certified)> {
    let graded = claim.kind != Kind::Solved;
    let mut names = claim.order.clone();
    let mut unknowns = setting.unknowns.clone();
    names.sort();
    unknowns.sort();
    if names != unknowns {
        return Err(refused("the order is not one of the unknowns".to_owned()));
    }
    let ring = setting.ring(&claim.order, if graded { Order::GrevLex } else { Order::Lex })?;
    let read =
        |list: &[String]| -> Result<Vec<Poly>> { list.iter().map(|text| parse(text)?.evaluate(&ring)).collect() };
    let basis = read(&claim.basis)?;
    let cofactors = claim.cofactors.iter().map(|row| read(row)).collect::<Result<_>>()?;
    let order = claim.order.clone();
    let mut certified = Certified { order, graded, basis, cofactors, proof: Proof::default() };
    certified.proof = certified.verify(setting)?;
    Ok((ring, certified))
}
