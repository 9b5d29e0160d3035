//! The derivation proper: a proved basis at every stratum of the parameters ([`Node`]), found by recursion.

use super::certify::{self, Certified};
use super::setting::{ParameterPoly, Poly, Setting, Substitution, expression_of};
use super::strata::{self, ZeroSet};
use super::triangular::{Triangular, triangularise};
use super::{JointKindUnknown, System};
use crate::groebner::{Basis, Options, Quotient, Strategy, basis};
use crate::number::{Rationals, Ring};
use crate::poly::{Expression, Order, PolynomialRing};
use crate::{Error, ErrorKind, Result, Watch};

/// The deepest nesting of strata.
const MAX_DEPTH: usize = 8;

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
}

/// A factor of a denominator that is never zero on real parameters under the assumptions.
#[derive(Clone, Debug, PartialEq)]
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
    Family(Box<Family>),
    /// The same equations as at the stratum with this label, derived there.
    Seen(String),
    /// Not derived, for this reason.
    Open(String),
}

/// A lexicographic basis with its proof and triangular form.
#[derive(Clone, Debug, PartialEq)]
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
pub struct Family {
    /// The joints (indices) that were chosen to be the free ones.
    pub free: Vec<usize>,
    /// Basis and proof of the equations themselves, in graded order: what was proved positive-dimensional.
    pub certified: Certified,
    /// The member with each free joint at zero, solved; its setting has the equations that put the joints there.
    pub member: Box<Node>,
}

/// How a tree is built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Orders {
    /// The system's own order at every stratum.
    Requested,
    /// At every stratum the order whose formulas break down least.
    Searched,
}

/// Derives and proves the equations of `system` on every stratum of its parameters.
///
/// # Errors
/// [`ErrorKind::Inconsistent`] and [`ErrorKind::PositiveDimensional`] (naming the free unknowns) when that is so for generic
/// parameters; what `watch` stops with.
pub fn derive_tree(system: &System, orders: Orders, watch: &Watch) -> Result<Node> {
    let mut builder = Builder { system, orders, watch, seen: Vec::new() };
    let place = Place { label: "generic".to_owned(), factors: Vec::new() };
    let node = builder.node(place, Setting::new(system), None, 0)?;
    match &node.outcome {
        Outcome::Solved(_) => Ok(node),
        Outcome::Inconsistent(_) => {
            let text = "the equations contradict each other for generic targets: the ideal is {1}; \
                        take away an equation or make one of its constants a parameter";
            Err(Error::new(ErrorKind::Inconsistent, text))
        }
        Outcome::Family(family) => {
            let names: Vec<_> = family.free.iter().map(|&joint| system.joints[joint].name.as_str()).collect();
            let text = format!(
                "more joints than equations determine: {} stay free; fix them by an equation or give a task with more constraints",
                names.join(", ")
            );
            Err(Error::new(ErrorKind::PositiveDimensional, text))
        }
        Outcome::Open(reason) => Err(Error::new(ErrorKind::Unsupported, reason.clone())),
        Outcome::Seen(_) => Ok(node),
    }
}

struct Place {
    label: String,
    factors: Vec<Expression>,
}

struct Builder<'a> {
    system: &'a System,
    orders: Orders,
    watch: &'a Watch,
    /// Settings that have been derived, with their labels.
    seen: Vec<(Setting, String)>,
}

impl Builder<'_> {
    fn node(&mut self, place: Place, setting: Setting, parent: Option<&Solved>, depth: usize) -> Result<Node> {
        self.watch.check()?;
        let before = self.seen.iter().find(|(other, _)| other.same_equations(&setting));
        let outcome = match before {
            Some((_, label)) => Outcome::Seen(label.clone()),
            None => self.outcome(&setting, parent)?,
        };
        self.seen.push((setting.clone(), place.label.clone()));
        let mut node = Node {
            label: place.label,
            factors: place.factors,
            setting,
            outcome,
            children: Vec::new(),
            excluded: Vec::new(),
        };
        let denominators = node.denominators()?;
        let ground = node.setting.field()?.ring().clone();
        for factor in strata::factors(&ground, &denominators) {
            self.branch(&mut node, &factor, depth)?;
        }
        Ok(node)
    }

    /// The basis of one setting, in the order asked for.
    fn outcome(&self, setting: &Setting, parent: Option<&Solved>) -> Result<Outcome> {
        let ring = setting.ring(&setting.unknowns, Order::GrevLex)?;
        let generators = match setting.generators(&ring) {
            Ok(generators) => generators,
            Err(error) => return Ok(Outcome::Open(format!("the equations are not defined here: {}", error.message()))),
        };
        let options = Options { strategy: Strategy::Normal, cofactors: true };
        let graded = basis(&ring, &generators, &options, self.watch)?;
        match graded.independent_variables() {
            None => Ok(Outcome::Inconsistent(Box::new(certify::certified(&graded, &graded, &generators)?))),
            Some(free) if free.is_empty() => self.solved(setting, &graded, &generators, parent),
            Some(free) => self.family(setting, &graded, &generators, &free),
        }
    }

    fn solved(
        &self,
        setting: &Setting,
        graded: &Basis<super::setting::Coefficients>,
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
            Orders::Searched if !inherited => super::plan::best_order(setting, &quotient, self.watch)?,
            _ => lex,
        };
        let certified = certify::certified(graded, &lex, generators)?;
        let triangular = triangularise(&lex.ring, &lex.polynomials)?;
        Ok(Outcome::Solved(Box::new(Solved { certified, triangular, inherited })))
    }

    /// Frees the joints of the independent unknowns and solves the member that has them at zero.
    fn family(
        &self,
        setting: &Setting,
        graded: &Basis<super::setting::Coefficients>,
        generators: &[Poly],
        free: &[usize],
    ) -> Result<Outcome> {
        let names: Vec<&str> = free.iter().map(|&v| graded.ring.variables()[v].as_str()).collect();
        let joints: Vec<usize> = (0..self.system.joints.len())
            .filter(|&j| self.system.joints[j].kind.unknowns().iter().any(|unknown| names.contains(unknown)))
            .collect();
        let certified = certify::certified(graded, graded, generators)?;
        let mut member = setting.clone();
        for &joint in &joints {
            let (name, value) = match &self.system.joints[joint].kind {
                JointKindUnknown::Angle { cosine, sine } => {
                    member.equations.push(Expression::name(sine.clone()));
                    (cosine, 1)
                }
                JointKindUnknown::Value { unknown } => (unknown, 0),
            };
            let difference = vec![Expression::name(name.clone()), Expression::integer(value).negated()];
            member.equations.push(Expression::sum(difference));
        }
        let outcome = self.outcome(&member, None)?;
        let label = "free joints at zero".to_owned();
        let member =
            Node { label, factors: Vec::new(), setting: member, outcome, children: Vec::new(), excluded: Vec::new() };
        Ok(Outcome::Family(Box::new(Family { free: joints, certified, member: Box::new(member) })))
    }

    /// Derives the stratum where `factor` vanishes, or says why there is none.
    fn branch(&mut self, node: &mut Node, factor: &ParameterPoly, depth: usize) -> Result<()> {
        let ground = node.setting.field()?.ring().clone();
        let expression = expression_of(&ground, factor);
        let substitutions = match strata::zero_set(&node.setting, factor)? {
            ZeroSet::Empty(reason) => {
                node.excluded.push(Excluded { factor: expression, reason });
                return Ok(());
            }
            ZeroSet::Open(reason) => {
                node.children.push(open_node(node, expression, reason));
                return Ok(());
            }
            ZeroSet::Graph(substitutions) => apply(&node.setting, &substitutions),
            ZeroSet::Root { substitution, symbol } => node.setting.with_symbol(symbol).substitute(&substitution),
        };
        let settings = match substitutions.and_then(|setting| setting.split_roots()) {
            Ok(_) if depth >= MAX_DEPTH => {
                node.children.push(open_node(node, expression, "strata nest too deep".to_owned()));
                return Ok(());
            }
            Ok(settings) => settings,
            Err(error) => {
                node.children.push(open_node(node, expression, error.message().to_owned()));
                return Ok(());
            }
        };
        for setting in settings {
            let place = place_of(node, &expression, &setting);
            let parent = match &node.outcome {
                Outcome::Solved(solved) => Some(solved.as_ref()),
                _ => None,
            };
            let child = self.node(place, setting, parent, depth + 1)?;
            node.children.push(child);
        }
        Ok(())
    }
}

/// All substitutions of a zero set, one after the other.
pub(super) fn apply(setting: &Setting, substitutions: &[Substitution]) -> Result<Setting> {
    substitutions.iter().try_fold(setting.clone(), |setting, substitution| setting.substitute(substitution))
}

fn place_of(node: &Node, factor: &Expression, setting: &Setting) -> Place {
    let new = &setting.substitutions[node.setting.substitutions.len()..];
    let label = new.iter().map(|s| format!("{} = {}", s.name, s.value)).collect::<Vec<_>>().join(", ");
    let label = if node.label == "generic" { label } else { format!("{}, {label}", node.label) };
    let mut factors = node.factors.clone();
    factors.push(factor.clone());
    Place { label, factors }
}

fn open_node(node: &Node, factor: Expression, reason: String) -> Node {
    let label = format!("{factor} = 0");
    let label = if node.label == "generic" { label } else { format!("{}, {label}", node.label) };
    let mut factors = node.factors.clone();
    factors.push(factor);
    let setting = node.setting.clone();
    Node { label, factors, setting, outcome: Outcome::Open(reason), children: Vec::new(), excluded: Vec::new() }
}

/// Whether the parent's basis, with this setting's new substitutions put in, is `lex`: its formulas hold on.
pub(super) fn specialises(
    parent: &Solved,
    setting: &Setting,
    lex: &Basis<super::setting::Coefficients>,
) -> Result<bool> {
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

impl Node {
    /// The proofs of this node: its own, and that of a family's member.
    pub fn proofs(&self) -> Vec<(&Setting, &Certified)> {
        match &self.outcome {
            Outcome::Solved(solved) => vec![(&self.setting, &solved.certified)],
            Outcome::Inconsistent(certified) => vec![(&self.setting, certified)],
            Outcome::Family(family) => {
                let mut proofs = vec![(&self.setting, &family.certified)];
                proofs.extend(family.member.proofs());
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
pub(super) fn collect_denominators<'a>(
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
