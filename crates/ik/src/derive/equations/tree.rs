//! The tree of strata: a proved basis at every stratum of the parameters ([`Node`]).

use crate::Result;
use crate::derive::equations::certify::Certified;
use crate::derive::equations::setting::{ParameterPoly, Poly, Setting};
use crate::derive::equations::triangular::Triangular;
use groebot_algebra::number::{Rationals, Ring};
use groebot_algebra::poly::{Expression, PolynomialRing};

/// One stratum of the parameters, with its derived and proved outcome.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// `generic`, or the conditions of the stratum, such as `pz = 0`.
    pub label: String,
    /// The factors that vanish here, one for each step from the root, as expressions of the root's parameters.
    pub factors: Vec<Expression>,
    /// The equations on this stratum.
    pub setting: Setting,
    /// The outcome of the equations.
    pub outcome: Outcome,
    /// Strata inside this one where the proof does not hold.
    pub children: Vec<Node>,
    /// Factors of denominators that are never zero, with the reason.
    pub excluded: Vec<Excluded>,
    /// Whether the stratum has a description as substitutions, so that a prover was applied to it.
    pub derivable: bool,
}

/// A factor of a denominator that is never zero on real parameters under the assumptions.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Excluded {
    /// The factor.
    pub factor: Expression,
    /// Why it is never zero.
    pub reason: String,
}

/// The outcome of the equations of a stratum.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// Finitely many solutions.
    Solved(Box<Solved>),
    /// No solution: the unit ideal, with the proof.
    Inconsistent(Box<Certified>),
    /// Infinitely many solutions: some joints are free.
    SelfMotion(Box<SelfMotion>),
    /// Equations that were already derived at the stratum with this label.
    Seen(String),
    /// Not derived, with the reason.
    Open(String),
}

/// A lexicographic basis with its proof and triangular form.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Solved {
    /// The basis and its proof.
    pub certified: Certified,
    /// The triangular form.
    pub triangular: Triangular,
    /// Whether the parent's formulas hold here too: the basis is the parent's, specialised.
    pub inherited: bool,
}

/// A stratum with free joints.
#[derive(Clone, Debug, PartialEq)]
pub struct SelfMotion {
    /// The joints (indices) that were chosen as free.
    pub free: Vec<usize>,
    /// Basis and proof of the equations themselves, in graded order. They prove that the solutions have positive dimension.
    pub certified: Certified,
    /// The member with each free joint at zero, solved. Its setting has the equations that fix these joints.
    pub member: Box<Node>,
}

impl Node {
    /// A node without factors, children and exclusions.
    pub(in crate::derive) fn leaf(label: &str, setting: Setting, outcome: Outcome) -> Node {
        let label = label.to_owned();
        Node {
            label,
            factors: Vec::new(),
            setting,
            outcome,
            children: Vec::new(),
            excluded: Vec::new(),
            derivable: true,
        }
    }

    /// The proofs of this node: its own, and that of a self-motion's member.
    pub fn proofs(&self) -> Vec<(&Setting, &Certified)> {
        match &self.outcome {
            Outcome::Solved(solved) => vec![(&self.setting, &solved.certified)],
            Outcome::Inconsistent(certified) => vec![(&self.setting, certified)],
            Outcome::SelfMotion(self_motion) => {
                let mut proofs = vec![(&self.setting, &self_motion.certified)];
                proofs.extend(self_motion.member.proofs());
                proofs
            }
            Outcome::Open(_) | Outcome::Seen(_) => Vec::new(),
        }
    }

    /// Every denominator of the proofs, once each, as polynomials of the parameters.
    ///
    /// # Errors
    /// If the setting's field cannot be built.
    pub(crate) fn denominators(&self) -> Result<Vec<ParameterPoly>> {
        let mut found = Vec::new();
        for (setting, certified) in self.proofs() {
            let ring = certified.ring(setting)?;
            let generators = setting.generators(&ring)?;
            let polynomials = generators.iter().chain(&certified.basis).chain(certified.cofactors.iter().flatten());
            collect_denominators(ring.field().ring(), polynomials, &mut found);
        }
        Ok(found)
    }

    /// This node and all below it, depth first.
    pub fn walk(&self) -> Vec<&Node> {
        let mut nodes = vec![self];
        nodes.extend(self.children.iter().flat_map(Node::walk));
        nodes
    }

    /// The solved form, if there is one.
    pub fn solved(&self) -> Option<&Solved> {
        match &self.outcome {
            Outcome::Solved(solved) => Some(solved),
            _ => None,
        }
    }
}

/// Adds to `found` the denominators that it does not contain yet, except one.
pub(in crate::derive) fn collect_denominators<'a>(
    ground: &PolynomialRing<Rationals>,
    polynomials: impl Iterator<Item = &'a Poly>,
    found: &mut Vec<ParameterPoly>,
) {
    for term in polynomials.flat_map(|f| f.terms()) {
        let denominator = term.coefficient.denominator();
        if !ground.is_one(denominator) && !found.contains(denominator) {
            found.push(denominator.clone());
        }
    }
}
