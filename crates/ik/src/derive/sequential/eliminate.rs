//! Elimination of joints from a step's relations ([`Elimination`]). The result is one polynomial in the step's own joint.
//!
//! Coefficients that are not constants become symbols, or sums of multiples of earlier symbols. The symbols are the smallest variables of an elimination order,
//! so the Groebner basis over Q never divides by them. Its element in the step's joint alone is a combination of the relations with polynomial cofactors, for
//! all values of the symbols.

use std::collections::BTreeMap;
use std::ops::Range;

use num_traits::{One, Zero};
use serde::{Deserialize, Serialize};

use super::combination::combination;
use super::determinant::by_determinant;
use super::squares::by_squares;
use super::symbolic::{Symbolic, TargetPoly};
use crate::derive::closure::{Coupling, Factor, Mechanism, Polynomials, Relation};
use crate::derive::planner::PlanStep;
use crate::{Error, ErrorKind, Result, Watch};
use groebot_algebra::groebner::{Options, Strategy, basis, divide};
use groebot_algebra::number::{BigRational, Rationals, Ring, Style};
use groebot_algebra::poly::{Block, Order, Polynomial, PolynomialRing, parse};

/// The maximum number of terms of an elimination's basis.
const MOST_TERMS: usize = 20_000;

type Poly = Polynomial<BigRational>;
/// A coefficient: polynomials in the target, by products of unknowns of known joints.
type Coefficient = BTreeMap<Vec<Factor>, TargetPoly>;

/// A product of unknowns with its coefficient: a sum of multiples of symbols and of one (`None`).
type Entry = (Vec<Factor>, Vec<(BigRational, Option<usize>)>);

/// The definition of a symbol: the coefficient of a product of unknowns in one of the relations.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct SymbolPlace {
    /// Index of the relation.
    pub relation: usize,
    /// The product.
    pub factors: Vec<Factor>,
}

/// A polynomial in one joint's unknowns that follows from relations in several joints.
#[derive(Clone, Debug, PartialEq)]
pub struct Elimination {
    /// Q[unknowns of the eliminated joints, unknowns of the joint, symbols].
    pub ring: PolynomialRing<Rationals>,
    /// The number of eliminated unknowns, and of the joint's own.
    pub sizes: [usize; 2],
    /// The relations with symbols, then the laws of joints that follow others, then the circles.
    pub generators: Vec<Poly>,
    /// The range of the generators that are laws.
    pub laws: Range<usize>,
    /// The symbols.
    pub symbols: Vec<SymbolPlace>,
    /// The polynomial in the joint's unknowns and the symbols.
    pub member: Poly,
    /// `member = sum over j of cofactors[j] * generators[j]`.
    pub cofactors: Vec<Poly>,
}

/// The stored proof.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Stored {
    member: String,
    cofactors: Vec<String>,
}

impl Elimination {
    /// Eliminates the joints `away` from the relations of `step`.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] if the result is not useful. The error of `watch` if it stops the computation.
    pub(super) fn derive(mechanism: &Mechanism, step: &PlanStep, away: &[usize], watch: &Watch) -> Result<Self> {
        let mut elimination = Setting::of_step(mechanism, step, away)?.finish()?;
        if let Some((member, cofactors)) = elimination.by_squares(mechanism, step, away) {
            (elimination.member, elimination.cofactors) = (member, cofactors);
            return elimination.proved();
        }
        let options = Options { strategy: Strategy::Sugar, cofactors: true };
        let limited = watch.clone().with_terms(MOST_TERMS);
        let found = match basis(&elimination.ring, &elimination.generators, &options, &limited) {
            Err(error) if error.kind() == ErrorKind::Budget && watch.check().is_ok() => {
                let text = format!("the elimination of other joints takes more than {MOST_TERMS} terms");
                return Err(Error::new(ErrorKind::Unsupported, text));
            }
            found => found?,
        };
        let degree = |f: &Poly| elimination.degree(f);
        let own = found.polynomials.iter().zip(&found.cofactors).filter(|(f, _)| elimination.is_own(f));
        let (member, cofactors) = own.min_by_key(|(f, _)| (degree(f), f.terms().len())).ok_or_else(|| {
            Error::new(
                ErrorKind::Unsupported,
                "elimination of the other joints from the relations gives no usable equation",
            )
        })?;
        (elimination.member, elimination.cofactors) = (member.clone(), cofactors.clone());
        elimination.proved()
    }

    /// The sum of the squares of two relations that rotate a vector by one joint, if some form has a high enough degree for it.
    fn by_squares(&self, mechanism: &Mechanism, step: &PlanStep, away: &[usize]) -> Option<(Poly, Vec<Poly>)> {
        let followers = mechanism.followers();
        let is_led = |joint: &usize| {
            let law = followers.iter().find(|(follower, _)| follower == joint);
            law.is_some_and(|(_, law)| law.leader == step.joint || away.contains(&law.leader))
        };
        let mut leading = away.iter().filter(|joint| !is_led(joint));
        let (Some(joint), None, 2) = (leading.next(), leading.next(), step.method.relations().len()) else {
            return None;
        };
        let screw = &mechanism.joints()[*joint];
        if !screw.is_revolute() {
            return None;
        }
        let [f, g] = [self.by_laws(0)?, self.by_laws(1)?];
        let squares = |pair: [&Poly; 2]| by_squares(&self.ring, pair, &screw.square, self.sizes[0] - 2);
        let (member, [first, second, circle]) = match squares([&f.0, &g.0]) {
            Some(found) => found,
            None => squares([&g.0, &f.0]).map(|(member, [second, first, circle])| (member, [first, second, circle]))?,
        };
        let mut cofactors = self.without_laws([(&first, &f.1), (&second, &g.1)]);
        let own = usize::from(mechanism.joints()[step.joint].is_revolute());
        let place = cofactors.len().checked_sub(1 + own)?;
        cofactors[place] = self.ring.add(&cofactors[place], &circle);
        let member = match mechanism.joints()[step.joint].is_revolute() {
            true => self.without_square(&member, cofactors.last_mut()?)?,
            false => member,
        };
        let most = if mechanism.joints()[step.joint].is_revolute() { 2 } else { 4 };
        (self.is_own(&member) && self.degree(&member) <= most).then_some((member, cofactors))
    }

    /// A relation after substitution of the laws, reduced to the first power of each cosine, and the cofactors of the laws and circles. The cofactors give its
    /// difference from its generator. Without a law it is the generator itself.
    fn by_laws(&self, relation: usize) -> Option<(Poly, Vec<Poly>)> {
        let f = &self.generators[relation];
        if self.laws.is_empty() {
            return Some((f.clone(), Vec::new()));
        }
        let division = divide(&self.ring, f, &self.generators[self.laws.start..]).ok()?;
        Some((division.remainder, division.quotients))
    }

    /// The cofactors of a combination of relations from which multiples of laws and circles were subtracted.
    fn without_laws(&self, parts: [(&Poly, &Vec<Poly>); 2]) -> Vec<Poly> {
        let ring = &self.ring;
        let mut cofactors: Vec<Poly> = parts.iter().map(|(factor, _)| (*factor).clone()).collect();
        cofactors.resize(self.generators.len(), ring.zero());
        for (factor, quotients) in parts {
            for (cofactor, quotient) in cofactors[self.laws.start..].iter_mut().zip(quotients) {
                *cofactor = ring.sub(cofactor, &ring.mul(factor, quotient));
            }
        }
        cofactors
    }

    /// The remainder of `f` by the joint's own circle, the last generator. It does not contain the square of the cosine.
    fn without_square(&self, f: &Poly, cofactor: &mut Poly) -> Option<Poly> {
        let division = divide(&self.ring, f, std::slice::from_ref(self.generators.last()?)).ok()?;
        *cofactor = self.ring.sub(cofactor, division.quotients.first()?);
        Some(division.remainder)
    }

    /// Proves a stored elimination again.
    ///
    /// # Errors
    /// [`ErrorKind::Certificate`] if it is false.
    pub(super) fn reprove(mechanism: &Mechanism, step: &PlanStep, away: &[usize], stored: &Stored) -> Result<Self> {
        Setting::of_step(mechanism, step, away)?.finish()?.replayed(stored)
    }

    /// Eliminates the joint `away` from one relation of each of two mechanisms. Both have the joints `away` and `own` at the same indices, with axes of the
    /// same length. Both relations must be linear and homogeneous in the cosine and sine of `away`.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] if they are not, or if the result is not useful.
    pub(super) fn of_two(sides: &[(&Mechanism, &Relation); 2], [away, own]: [usize; 2]) -> Result<Self> {
        let mut elimination = Setting::new(sides, vec![away, own])?.finish()?;
        let found = match elimination.generators.as_slice() {
            [f, g, ..] => by_determinant(&elimination.ring, [f, g], &sides[0].0.joints()[away].square),
            _ => None,
        };
        let unfit = || Error::new(ErrorKind::Unsupported, "the relations are not linear in the joint that they share");
        let (member, [first, second, circle]) = found.ok_or_else(unfit)?;
        let mut cofactors = vec![first, second, circle, elimination.ring.zero()];
        let reduced = cofactors.last_mut().and_then(|cofactor| elimination.without_square(&member, cofactor));
        (elimination.member, elimination.cofactors) = (reduced.ok_or_else(unfit)?, cofactors);
        elimination.proved()
    }

    /// Proves a stored elimination of [`Elimination::of_two`] again.
    ///
    /// # Errors
    /// [`ErrorKind::Certificate`] if it is false.
    pub(super) fn reprove_two(
        sides: &[(&Mechanism, &Relation); 2],
        [away, own]: [usize; 2],
        stored: &Stored,
    ) -> Result<Self> {
        Setting::new(sides, vec![away, own])?.finish()?.replayed(stored)
    }

    /// The elimination with the stored member and cofactors, proved.
    fn replayed(mut self, stored: &Stored) -> Result<Self> {
        let elimination = &mut self;
        let read = |text: &String| -> Result<Poly> { parse(text)?.evaluate(&elimination.ring) };
        let member = read(&stored.member)?;
        let cofactors = stored.cofactors.iter().map(read).collect::<Result<_>>()?;
        (elimination.member, elimination.cofactors) = (member, cofactors);
        self.proved()
    }

    /// The text of the proof.
    pub(super) fn stored(&self) -> Stored {
        let text = |f: &Poly| self.ring.format(f, Style::Text);
        Stored { member: text(&self.member), cofactors: self.cofactors.iter().map(text).collect() }
    }

    fn proved(self) -> Result<Self> {
        let refuse = |text: &str| Err(Error::new(ErrorKind::Certificate, text.to_owned()));
        if self.cofactors.len() != self.generators.len() {
            return refuse("an elimination has a cofactor for each equation");
        }
        let mut sum = self.ring.zero();
        for (cofactor, f) in self.cofactors.iter().zip(&self.generators) {
            sum = self.ring.add(&sum, &self.ring.checked_mul(cofactor, f)?);
        }
        if sum != self.member || !self.is_own(&self.member) {
            return refuse("the cofactors of an elimination do not multiply out to a polynomial in its joint");
        }
        Ok(self)
    }

    /// Whether a polynomial contains only unknowns of the step's joint, its cosine at most in the first power, and is not the joint's circle.
    fn is_own(&self, f: &Poly) -> bool {
        let [away, own] = self.sizes;
        let foreign = (0..away).any(|v| self.ring.degree_in(f, v) > 0);
        let circle =
            self.generators.last().is_some_and(|circle| own == 2 && self.ring.monic(circle) == self.ring.monic(f));
        let reduced = own == 1 || self.ring.degree_in(f, away) <= 1;
        !foreign && !circle && reduced && self.degree(f) > 0
    }

    /// The total degree in the joint's unknowns.
    pub(super) fn degree(&self, f: &Poly) -> u32 {
        let [away, own] = self.sizes;
        let degree = |exponents: Vec<u32>| exponents[away..away + own].iter().sum();
        f.terms().iter().map(|term| degree(self.ring.layout().exponents(&term.monomial))).max().unwrap_or(0)
    }

    /// The coefficients by the exponents of the joint's unknowns. Each is a list of terms with exponents of the symbols.
    pub(super) fn coefficients(&self) -> BTreeMap<Vec<u32>, Vec<(BigRational, Vec<u32>)>> {
        let [away, own] = self.sizes;
        let mut parts: BTreeMap<Vec<u32>, Vec<(BigRational, Vec<u32>)>> = BTreeMap::new();
        for term in self.member.terms() {
            let exponents = self.ring.layout().exponents(&term.monomial);
            let (own, symbols) = exponents[away..].split_at(own);
            parts.entry(own.to_vec()).or_default().push((term.coefficient.clone(), symbols.to_vec()));
        }
        parts
    }
}

/// The equations of an elimination, under construction.
struct Setting<'a> {
    /// A mechanism with these joints; the first if there are two.
    mechanism: &'a Mechanism,
    /// The eliminated joints, then the step's own.
    joints: Vec<usize>,
    /// By relation: its products of unknowns with their coefficients.
    relations: Vec<Vec<Entry>>,
    symbols: Vec<(SymbolPlace, Coefficient)>,
    /// The index of the first symbol of the current mechanism.
    first: usize,
    /// Those of these joints that follow others of them.
    followers: Vec<(usize, &'a Coupling)>,
}

impl<'a> Setting<'a> {
    fn of_step(mechanism: &'a Mechanism, step: &PlanStep, away: &[usize]) -> Result<Self> {
        let sides: Vec<_> = step.method.relations().iter().map(|relation| (mechanism, relation)).collect();
        let joints = [away, &[step.joint]].concat();
        let is_in = |joint: usize| joints.contains(&joint);
        let mut followers = mechanism.followers();
        followers.retain(|(follower, coupling)| is_in(*follower) && is_in(coupling.leader));
        let is_led = |joint: &&usize| followers.iter().any(|(follower, _)| follower == *joint);
        // Followers are eliminated first, by their laws only.
        let (led, others): (Vec<usize>, Vec<usize>) = away.iter().partition(is_led);
        Ok(Setting { followers, ..Setting::new(&sides, [led, others, vec![step.joint]].concat())? })
    }

    /// The equations of relations, each with its mechanism. Coefficients of different mechanisms get different symbols.
    fn new(sides: &[(&'a Mechanism, &Relation)], joints: Vec<usize>) -> Result<Self> {
        let none = || Error::new(ErrorKind::Unsupported, "there is no relation to eliminate from");
        let mut mechanism = sides.first().ok_or_else(none)?.0;
        let mut setting =
            Setting { mechanism, joints, relations: Vec::new(), symbols: Vec::new(), first: 0, followers: Vec::new() };
        let mut symbolic = Symbolic::new(mechanism)?;
        for (relation, &(own, words)) in sides.iter().enumerate() {
            if !std::ptr::eq(own, mechanism) {
                (mechanism, symbolic, setting.first) = (own, Symbolic::new(own)?, setting.symbols.len());
            }
            let polynomial = symbolic.polynomial(mechanism, words)?;
            let mut parts: BTreeMap<Vec<Factor>, Coefficient> = BTreeMap::new();
            for (product, value) in polynomial.terms() {
                let is_unknown = |factor: &&Factor| setting.joints.contains(&factor.joint());
                let (own, rest): (Vec<&Factor>, Vec<&Factor>) = product.list().iter().partition(is_unknown);
                let copied = |list: Vec<&Factor>| list.into_iter().copied().collect::<Vec<Factor>>();
                parts.entry(copied(own)).or_default().insert(copied(rest), value.clone());
            }
            let entries =
                parts.into_iter().map(|(factors, c)| setting.entry(&symbolic, relation, factors, c)).collect();
            setting.relations.push(entries);
        }
        Ok(setting)
    }

    /// A coefficient in terms of constants and existing symbols if possible, otherwise as a new symbol.
    fn entry(&mut self, symbolic: &Symbolic, relation: usize, factors: Vec<Factor>, coefficient: Coefficient) -> Entry {
        let one = Coefficient::from([(Vec::new(), symbolic.ring.one())]);
        let basis = [&one].into_iter().chain(self.symbols[self.first..].iter().map(|(_, known)| known));
        let row = |coefficient: &Coefficient| -> BTreeMap<(Vec<Factor>, Vec<u32>), BigRational> {
            let terms = coefficient.iter().flat_map(|(product, f)| f.terms().iter().map(move |term| (product, term)));
            let place = |monomial| symbolic.ring.layout().exponents(monomial);
            terms.map(|(product, term)| ((product.clone(), place(&term.monomial)), term.coefficient.clone())).collect()
        };
        if let Some(numbers) = combination(&row(&coefficient), &basis.map(row).collect::<Vec<_>>()) {
            let symbol = |index: usize| index.checked_sub(1).map(|place| self.first + place);
            let parts = numbers.into_iter().enumerate().map(|(index, number)| (number, symbol(index)));
            return (factors, parts.filter(|(number, _)| !number.is_zero()).collect());
        }
        self.symbols.push((SymbolPlace { relation, factors: factors.clone() }, coefficient));
        (factors, vec![(BigRational::one(), Some(self.symbols.len() - 1))])
    }

    /// The ring and the generators. The member is still zero.
    fn finish(self) -> Result<Elimination> {
        let unknowns = |joint: &usize| match self.mechanism.joints()[*joint].is_revolute() {
            true => vec![Factor::Cosine(*joint), Factor::Sine(*joint)],
            false => vec![Factor::Length(*joint)],
        };
        let factors: Vec<Factor> = self.joints.iter().flat_map(unknowns).collect();
        let own = self.joints.last().map_or(0, |joint| unknowns(joint).len());
        let sizes = [factors.len() - own, own];
        let is_led = |factor: &&Factor| self.followers.iter().any(|(follower, _)| *follower == factor.joint());
        let led = factors[..sizes[0]].iter().filter(is_led).count();
        let names = (0..factors.len()).map(|k| format!("x{k}")).chain((0..self.symbols.len()).map(|k| format!("S{k}")));
        let blocks = [led, sizes[0] - led, sizes[1], self.symbols.len()].into_iter().filter(|size| *size > 0);
        let order = Order::Block(blocks.map(|size| Block { size, graded: true }).collect());
        let ring = PolynomialRing::new(Rationals, &names.collect::<Vec<_>>(), order)?;
        let place = |factor: &Factor| factors.iter().position(|other| other == factor);
        let mut generators = Vec::new();
        for entries in &self.relations {
            let mut sum = ring.zero();
            for (product, parts) in entries {
                let mut term = ring.zero();
                for (number, symbol) in parts {
                    let value = symbol.map_or_else(|| ring.one(), |symbol| ring.variable(factors.len() + symbol));
                    term = ring.add(&term, &ring.scale(&value, number));
                }
                for factor in product {
                    let power = match factor {
                        Factor::LengthSquared(joint) => place(&Factor::Length(*joint)).map(|v| (v, 2)),
                        factor => place(factor).map(|v| (v, 1)),
                    };
                    let (v, exponent) = power.ok_or_else(|| Error::new(ErrorKind::UnknownName, "no such unknown"))?;
                    term = ring.mul(&term, &ring.pow(&ring.variable(v), exponent));
                }
                sum = ring.add(&sum, &term);
            }
            generators.push(sum);
        }
        let relations = generators.len();
        for (follower, coupling) in &self.followers {
            let [own, leader]: [Vec<Poly>; 2] = [*follower, coupling.leader]
                .map(|joint| unknowns(&joint).iter().filter_map(place).map(|v| ring.variable(v)).collect());
            let law = coupling.follow(&leader, &mut Polynomials(&ring));
            generators.extend(own.iter().zip(&law).map(|(own, law)| ring.sub(own, law)));
        }
        let laws = relations..generators.len();
        for joint in self.joints.iter().filter(|joint| self.mechanism.joints()[**joint].is_revolute()) {
            let square =
                |factor: Factor| place(&factor).map(|v| ring.pow(&ring.variable(v), 2)).unwrap_or_else(|| ring.zero());
            let sine = ring.scale(&square(Factor::Sine(*joint)), &self.mechanism.joints()[*joint].square);
            generators.push(ring.sub(&ring.add(&square(Factor::Cosine(*joint)), &sine), &ring.one()));
        }
        let symbols = self.symbols.into_iter().map(|(place, _)| place).collect();
        let (member, cofactors) = (ring.zero(), Vec::new());
        Ok(Elimination { ring, sizes, generators, laws, symbols, member, cofactors })
    }
}
