//! Provers, which give the outcomes of a growing tree: the engine here, a stored certificate in [`crate::derive::equations::certificate`].

use crate::derive::equations::certify;
use crate::derive::equations::generic::generic_basis;
use crate::derive::equations::setting::{Coefficients, Poly, Setting, expression_of};
use crate::derive::equations::tree::{Node, Outcome, SelfMotion, Solved};
use crate::derive::equations::triangular::triangularise;
use crate::derive::{JointKindUnknown, System};
use crate::{Error, ErrorKind, Result, Watch};
use groebot_algebra::groebner::{Basis, Quotient};
use groebot_algebra::poly::{Expression, Order};

/// A prover of the outcome of a setting's equations.
pub(in crate::derive) trait Prover {
    /// The outcome at the stratum called `label`. `parent` is the solved form of the surrounding stratum.
    fn prove(&mut self, label: &str, setting: &Setting, parent: Option<&Solved>) -> Result<Outcome>;
}

/// The choice of the order at each stratum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Orders {
    /// The system's own order at every stratum.
    Requested,
    /// At every stratum, the order with the fewest singularities.
    Searched,
}

/// A prover that computes Groebner bases.
pub(in crate::derive) struct Engine<'a> {
    pub system: &'a System,
    pub orders: Orders,
    pub watch: &'a Watch,
}

impl Prover for Engine<'_> {
    fn prove(&mut self, label: &str, setting: &Setting, parent: Option<&Solved>) -> Result<Outcome> {
        self.watch.check()?;
        match self.outcome(setting, parent) {
            // A stratum that cannot be derived remains open and is recorded; the derivation continues.
            Err(error) if label != GENERIC && !is_final(&error) => Ok(Outcome::Open(error.message().to_owned())),
            outcome => outcome,
        }
    }
}

impl Engine<'_> {
    /// The outcome of one setting, in the requested or the best order.
    fn outcome(&self, setting: &Setting, parent: Option<&Solved>) -> Result<Outcome> {
        let ring = setting.ring(&setting.unknowns, Order::GrevLex)?;
        let generators = match setting.generators(&ring) {
            Ok(generators) => generators,
            Err(error) => return Ok(Outcome::Open(format!("the equations are not defined here: {}", error.message()))),
        };
        let graded = generic_basis(setting, &ring, &generators, self.watch)?;
        match graded.independent_variables() {
            None => Ok(Outcome::Inconsistent(Box::new(certify::certified(&graded, &graded, &generators, self.watch)?))),
            Some(free) if free.is_empty() => self.solved(setting, &graded, &generators, parent),
            Some(free) => self.self_motion(setting, &graded, &generators, &free),
        }
    }

    fn solved(
        &self,
        setting: &Setting,
        graded: &Basis<Coefficients>,
        generators: &[Poly],
        parent: Option<&Solved>,
    ) -> Result<Outcome> {
        let quotient = Quotient::new(graded)?;
        let in_order = |names: &[String]| quotient.basis_in(&setting.ring(names, Order::Lex)?, self.watch);
        let (lex, inherited) = match parent {
            Some(parent) => {
                let lex = in_order(parent.triangular.ring.variables())?;
                let same = specialises(parent, setting, &lex)?;
                (lex, same)
            }
            None => (in_order(&setting.unknowns)?, false),
        };
        let lex = match self.orders {
            Orders::Searched if !inherited => {
                crate::derive::equations::plan::best_order(setting, &quotient, self.watch)?
            }
            _ => lex,
        };
        let certified = certify::certified(graded, &lex, generators, self.watch)?;
        let triangular = triangularise(&lex.ring, &lex.polynomials)?;
        Ok(Outcome::Solved(Box::new(Solved { certified, triangular, inherited })))
    }

    /// Chooses the joints of the independent unknowns as free joints, and solves the member that has them at zero.
    fn self_motion(
        &self,
        setting: &Setting,
        graded: &Basis<Coefficients>,
        generators: &[Poly],
        free: &[usize],
    ) -> Result<Outcome> {
        let joints = joints_of(self.system, &graded.ring, free);
        let certified = certify::certified(graded, graded, generators, self.watch)?;
        let member = member_setting(self.system, setting, &joints);
        let outcome = self.outcome(&member, None)?;
        let member = Box::new(Node::leaf(MEMBER, member, outcome));
        Ok(Outcome::SelfMotion(Box::new(SelfMotion { free: joints, certified, member })))
    }
}

/// Whether `lex` is the parent's basis with this setting's new substitutions applied. The parent's formulas then hold here too.
pub(in crate::derive) fn specialises(parent: &Solved, setting: &Setting, lex: &Basis<Coefficients>) -> Result<bool> {
    let source = &parent.triangular.ring;
    if parent.certified.basis.len() != lex.polynomials.len() {
        return Ok(false);
    }
    let value = |name: &str| {
        let found = setting.substitutions.iter().rev().find(|s| s.name == name);
        found.map(|s| s.value.clone())
    };
    for (f, g) in parent.certified.basis.iter().zip(&lex.polynomials) {
        let text = expression_of(source, f);
        // Substituted values may mention names that later substitutions replace.
        let replaced = setting.substitutions.iter().fold(text, |text, _| text.substitute(&value));
        match replaced.evaluate(&lex.ring) {
            Ok(image) if image == *g => {}
            _ => return Ok(false),
        }
    }
    Ok(true)
}

/// Whether an error ends the whole derivation. Other errors leave one stratum open.
pub(in crate::derive) fn is_final(error: &Error) -> bool {
    matches!(error.kind(), ErrorKind::Cancelled | ErrorKind::Budget | ErrorKind::Certificate)
}

/// The label of the root.
pub(in crate::derive) const GENERIC: &str = "generic";

/// The label of a self-motion's member.
pub(in crate::derive) const MEMBER: &str = "free joints at zero";

/// The joints that the unknowns with these indices belong to.
pub(in crate::derive) fn joints_of(
    system: &System,
    ring: &crate::derive::equations::setting::Unknowns,
    free: &[usize],
) -> Vec<usize> {
    let names: Vec<&str> = free.iter().map(|&v| ring.variables()[v].as_str()).collect();
    let is_free =
        |joint: &crate::derive::JointUnknown| joint.kind.unknowns().iter().any(|unknown| names.contains(unknown));
    (0..system.joints.len()).filter(|&joint| is_free(&system.joints[joint])).collect()
}

/// The setting with additional equations that fix `joints` at zero.
pub(in crate::derive) fn member_setting(system: &System, setting: &Setting, joints: &[usize]) -> Setting {
    let mut member = setting.clone();
    for &joint in joints {
        match &system.joints[joint].kind {
            JointKindUnknown::Angle { cosine, sine } => {
                let one = Expression::integer(1).negated();
                member.equations.push(Expression::sum(vec![Expression::name(cosine.clone()), one]));
                member.equations.push(Expression::name(sine.clone()));
            }
            JointKindUnknown::Value { unknown } => member.equations.push(Expression::name(unknown.clone())),
        }
    }
    member
}
