//! The tree of strata: a proved basis at every stratum of the parameters ([`Node`]).

use crate::Result;
use crate::derive::equations::certify::Certified;
use crate::derive::equations::setting::{ParameterPoly, Poly, Setting};
use crate::derive::equations::triangular::Triangular;
use groebot_algebra::number::{Rationals, Ring};
use groebot_algebra::poly::{Expression, PolynomialRing};

/// One stratum of the parameters with what was derived and proved there.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// `generic`, or the conditions of the stratum: `pz = 0`.
    pub label: String,
    /// The factors that vanish here, one for each step from the root, as expressions of the root's parameters.
    pub factors: Vec<Expression>,
    /// The equations here.
    pub setting: Setting,
    /// What they amount to.
    pub outcome: Outcome,
    /// Strata inside this one where the proof does not reach.
    pub children: Vec<Node>,
    /// Factors of denominators that are never zero, with the reason.
    pub excluded: Vec<Excluded>,
    /// Whether the stratum has a description as substitutions, so that a prover was asked about it.
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

/// What the equations of a stratum amount to.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// Finitely many solutions.
    Solved(Box<Solved>),
    /// No solution: the unit ideal, with the proof.
    Inconsistent(Box<Certified>),
    /// Infinitely many: some joints are free.
    SelfMotion(Box<SelfMotion>),
    /// The same equations as at the stratum with this label, derived there.
    Seen(String),
    /// Not derived, for this reason.
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
    /// The parent's formulas hold here unchanged: the basis is the parent's, specialised.
    pub inherited: bool,
}

/// A stratum with free joints.
#[derive(Clone, Debug, PartialEq)]
pub struct SelfMotion {
    /// The joints (indices) that were chosen to be the free ones.
    pub free: Vec<usize>,
    /// Basis and proof of the equations themselves, in graded order: what was proved positive-dimensional.
    pub certified: Certified,
    /// The member with each free joint at zero, solved; its setting has the equations that put the joints there.
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

    /// Every denominator that the proofs divide by, distinct, as polynomials of the parameters.
    ///
    /// # Errors
    /// When the setting's field cannot be built.
    pub fn denominators(&self) -> Result<Vec<ParameterPoly>> {
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

/// Adds to `found` the denominators other than one that are not there yet.
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
