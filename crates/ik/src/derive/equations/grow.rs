//! Construction of the tree of strata: a proof, its denominators, and a branch for each denominator that may vanish.

use crate::derive::System;
use crate::derive::equations::prover::{Engine, GENERIC, Orders, Prover, is_final};
use crate::derive::equations::setting::{ParameterPoly, Setting, Substitution, expression_of};
use crate::derive::equations::strata::{self, ZeroSet};
use crate::derive::equations::tree::{Excluded, Node, Outcome, Solved};
use crate::{Error, ErrorKind, Result, Watch};
use groebot_algebra::poly::Expression;

/// The maximum depth of nested strata.
const MAX_DEPTH: usize = 8;

/// Derives and proves the equations of `system` on every stratum of its parameters.
///
/// # Errors
/// For generic parameters: [`ErrorKind::Inconsistent`], and [`ErrorKind::PositiveDimensional`] with the free unknowns. The error of `watch` if it stops the
/// derivation.
pub fn derive_tree<'w>(system: &System, orders: Orders, watch: impl Into<Option<&'w Watch>>) -> Result<Node> {
    let watch = Watch::or_none(watch);
    let node = grow(system, &mut Engine { system, orders, watch })?;
    match &node.outcome {
        Outcome::Solved(_) => Ok(node),
        Outcome::Inconsistent(_) => {
            let text = "the equations contradict each other for generic targets: the ideal is {1}; \
                        remove an equation or make one of its constants a parameter";
            Err(Error::new(ErrorKind::Inconsistent, text))
        }
        Outcome::SelfMotion(self_motion) => {
            let names: Vec<_> = self_motion.free.iter().map(|&joint| system.joints[joint].name.as_str()).collect();
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

/// The tree of `system` with outcomes from `prover`.
pub(in crate::derive) fn grow(system: &System, prover: &mut dyn Prover) -> Result<Node> {
    let place = Place { label: GENERIC.to_owned(), factors: Vec::new() };
    Builder { prover, seen: Vec::new() }.node(place, Setting::new(system), None, 0)
}

struct Place {
    label: String,
    factors: Vec<Expression>,
}

struct Builder<'a> {
    prover: &'a mut dyn Prover,
    /// The settings that have been derived, with their labels.
    seen: Vec<(Setting, String)>,
}

impl Builder<'_> {
    fn node(&mut self, place: Place, setting: Setting, parent: Option<&Solved>, depth: usize) -> Result<Node> {
        let before = self.seen.iter().find(|(other, _)| other.same_equations(&setting));
        let outcome = match before {
            Some((_, label)) => Outcome::Seen(label.clone()),
            None => self.prover.prove(&place.label, &setting, parent)?,
        };
        self.seen.push((setting.clone(), place.label.clone()));
        let mut node = Node { factors: place.factors, ..Node::leaf(&place.label, setting, outcome) };
        let denominators = node.denominators()?;
        let ground = node.setting.field()?.ring().clone();
        for factor in strata::factors(&ground, &denominators)? {
            self.branch(&mut node, &factor, depth)?;
        }
        Ok(node)
    }

    /// Derives the stratum where `factor` vanishes, or records why the stratum is empty.
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
            let label = place.label.clone();
            let child = match self.node(place, setting.clone(), parent, depth + 1) {
                Ok(child) => child,
                Err(error) if is_final(&error) => return Err(error),
                Err(error) => {
                    let open = open_node(node, expression.clone(), error.message().to_owned());
                    Node { label, setting, ..open }
                }
            };
            node.children.push(child);
        }
        Ok(())
    }
}

/// Applies all substitutions of a zero set, one after the other.
pub(in crate::derive) fn apply(setting: &Setting, substitutions: &[Substitution]) -> Result<Setting> {
    substitutions.iter().try_fold(setting.clone(), |setting, substitution| setting.substitute(substitution))
}

fn place_of(node: &Node, factor: &Expression, setting: &Setting) -> Place {
    let new = &setting.substitutions[node.setting.substitutions.len()..];
    let label = new.iter().map(|s| format!("{} = {}", s.name, s.value)).collect::<Vec<_>>().join(", ");
    let label = if node.label == GENERIC { label } else { format!("{}, {label}", node.label) };
    let mut factors = node.factors.clone();
    factors.push(factor.clone());
    Place { label, factors }
}

fn open_node(node: &Node, factor: Expression, reason: String) -> Node {
    let label = format!("{factor} = 0");
    let label = if node.label == GENERIC { label } else { format!("{}, {label}", node.label) };
    let mut factors = node.factors.clone();
    factors.push(factor);
    Node { factors, derivable: false, ..Node::leaf(&label, node.setting.clone(), Outcome::Open(reason)) }
}

/// One line that summarises the solution of a stratum.
pub(crate) fn describe(node: &Node) -> String {
    match &node.outcome {
        Outcome::Solved(solved) if solved.inherited => "the formulas of the stratum around it hold here too".to_owned(),
        Outcome::Solved(solved) => match solved.triangular.bound() {
            1 => "one solution".to_owned(),
            bound => format!("up to {bound} solutions, formulas of its own"),
        },
        Outcome::Inconsistent(_) => "no solution: the ideal is {1}".to_owned(),
        Outcome::SelfMotion(_) => "infinitely many solutions: joints are free".to_owned(),
        Outcome::Seen(label) => format!("derived above, as `{label}`"),
        Outcome::Open(reason) => format!("not derived: {reason}"),
    }
}
