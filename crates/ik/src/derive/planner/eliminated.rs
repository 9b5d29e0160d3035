//! Steps that eliminate other joints: as many relations as unknown joints determine one joint.

use std::rc::Rc;

use super::one_joint::Candidate;
use super::types::{PlanStep, StepMethod};
use crate::derive::closure::{Factor, Mechanism};
use crate::derive::samples::echelon::Echelon;
use crate::derive::samples::evidence::Space;
use crate::derive::samples::sampled_relations::{
    SampledRelation, SampledRelations, SampledValue, is_number, members, set,
};
use crate::{Result, Watch};
use groebot_algebra::groebner::{basis_modulo_prime, normal_form};
use groebot_algebra::number::Ring;
use groebot_algebra::poly::Polynomial;
use groebot_algebra::random::SplitMix64;

/// The maximum degree of a step.
const GREATEST: usize = 4;
/// The maximum number of independent relations that are combined.
const CANDIDATES: usize = 4;
/// The maximum number of relations that are tested for independence.
const LOOKED_AT: usize = 24;

/// The effort of eliminating a joint that no sum of squares eliminates.
const HARD: usize = 15;
/// The effort of using linear relations among coefficients.
const LINEAR: usize = 20;

/// The index of a relation, and its coefficients at the sampled targets.
type IndexedRelation = (usize, Rc<SampledRelation>);

/// The steps to each joint of the set `joints` when those of `known` are known, with at most [`GREATEST`] solutions. There is at most one step per joint: that
/// of lowest degree, then of least effort.
///
/// # Errors
/// As [`SampledRelations::of`]. The error of `watch` if it stops the search.
pub fn eliminations(
    sampled: &mut SampledRelations<'_>,
    joints: u32,
    known: u32,
    watch: &Watch,
) -> Result<Vec<Candidate>> {
    let places = members(joints);
    let followers = followers(sampled.mechanism, joints);
    let laws = if followers == 0 { None } else { Some(Laws::new(sampled, &places)?) };
    let relations = independent(sampled, joints, known, laws.as_ref())?;
    let mut best: Vec<Option<Candidate>> = vec![None; places.len()];
    for chosen in combinations(relations.len(), places.len() - members(followers).len()) {
        watch.check()?;
        let some: Vec<IndexedRelation> = chosen.into_iter().map(|at| relations[at].clone()).collect();
        if !covers(sampled.mechanism, &some, joints) {
            continue;
        }
        let (degrees, symbols) = freed_degrees(sampled, &some, &places, watch)?;
        for (at, &degree) in degrees.iter().enumerate().filter(|(_, degree)| is_allowed(degree)) {
            let away: Vec<usize> = places.iter().copied().filter(|&place| place != places[at]).collect();
            let is_led = |joint: &usize| followers >> *joint & 1 == 1;
            let is_plain = match &laws {
                None => false,
                Some(laws) => some.iter().all(|(_, terms)| laws.degree(terms).is_ok_and(|degree| degree <= 1)),
            };
            let is_hard = |joint: &&usize| !is_led(joint) && !is_plain && !rotates_together(sampled, &some, **joint);
            let hard = away.iter().filter(is_hard).count();
            let effort = 10 * places.len() + symbols + HARD * hard;
            if best[at].as_ref().is_none_or(|(step, least)| (degree, effort) < (step.degree, *least)) {
                let relations = some.iter().map(|(index, _)| sampled.relations[*index].clone()).collect();
                let method = StepMethod::Eliminated { relations, away };
                best[at] = Some((PlanStep { joint: places[at], method, degree }, effort));
            }
        }
    }
    Ok(best.into_iter().flatten().collect())
}

/// Counts the values of a step's joint again, after elimination of the other joints.
///
/// The count is zero if there are no values or infinitely many, or if the planner does not use one of the step's relations.
///
/// # Errors
/// As [`SampledRelations::of`]. The error of `watch` if it stops the count.
pub fn count(sampled: &mut SampledRelations<'_>, step: &PlanStep, watch: &Watch) -> Result<usize> {
    let StepMethod::Eliminated { relations, away } = &step.method else { return Ok(step.degree) };
    let places = members(set(away) | 1 << step.joint);
    let mut some: Vec<IndexedRelation> = Vec::with_capacity(relations.len());
    for relation in relations {
        let Some(index) = sampled.relations.iter().position(|known| known == relation) else { return Ok(0) };
        let unknown = set(&places) & sampled.joints_of(index);
        some.push((index, sampled.of(index, unknown)?));
    }
    let (degrees, _) = freed_degrees(sampled, &some, &places, watch)?;
    Ok(places.iter().zip(degrees).find(|(place, _)| **place == step.joint).map_or(0, |(_, degree)| degree))
}

/// The joints of a set that follow other joints of the set. Their laws determine them.
pub fn followers(mechanism: &Mechanism, joints: u32) -> u32 {
    let is_in = |joint: usize| joints >> joint & 1 == 1;
    let led =
        mechanism.followers().into_iter().filter(|(follower, coupling)| is_in(*follower) && is_in(coupling.leader));
    led.fold(0, |set, (follower, _)| set | 1 << follower)
}

/// Whether every joint of the set occurs in the relations, or is the leader of a joint that occurs.
fn covers(mechanism: &Mechanism, some: &[IndexedRelation], joints: u32) -> bool {
    let factors = some.iter().flat_map(|(_, terms)| terms.iter().flat_map(|(product, _)| product.list()));
    let occur = factors.fold(0, |set, factor| set | 1 << factor.joint());
    let leaders = mechanism.followers().into_iter().filter(|(follower, _)| occur >> follower & 1 == 1);
    leaders.fold(occur, |set, (_, coupling)| set | 1 << coupling.leader) & joints == joints
}

/// Whether the relations are constant combinations of coordinates of one vector that `joint` rotates.
///
/// The sum of the squares of such relations is independent of the joint, which eliminates it (Pieper 1968). Each relation has a row (A, B) from A c + B s'. The
/// condition holds if the map (A, B) -> (B, -n A), a rotation by 90 degrees, keeps the span of the rows at all targets.
fn rotates_together(sampled: &SampledRelations<'_>, some: &[IndexedRelation], joint: usize) -> bool {
    let (field, n) = (sampled.field(), sampled.squares[joint]);
    let mut rows = Echelon::new(field);
    let mut turned = Vec::new();
    for (_, terms) in some {
        let (mut row, mut turn) = (Vec::new(), Vec::new());
        for (product, sample) in terms.iter() {
            let rest: Vec<Factor> = product.list().iter().copied().filter(|factor| factor.joint() != joint).collect();
            let (cosine, sine) = (Factor::Cosine(joint), Factor::Sine(joint));
            for (k, &value) in sample.iter().enumerate() {
                if product.list().contains(&cosine) {
                    row.push(((false, rest.clone(), k), value));
                    turn.push(((true, rest.clone(), k), field.neg(&field.mul(&n, &value))));
                } else if product.list().contains(&sine) {
                    row.push(((true, rest.clone(), k), value));
                    turn.push(((false, rest.clone(), k), value));
                }
            }
        }
        rows.insert(row);
        turned.push(turn);
    }
    turned.into_iter().all(|turn| !rows.insert(turn))
}

/// The laws of joints that follow others, as an ideal for substitution into relations.
struct Laws {
    space: Space,
    ideal: Vec<Polynomial<u64>>,
}

impl Laws {
    fn new(sampled: &SampledRelations<'_>, places: &[usize]) -> Result<Self> {
        let space = Space::new(sampled.mechanism, places, sampled.field())?;
        let mut ideal = space.couplings(sampled.mechanism);
        ideal.extend(space.circles(&sampled.squares)?);
        Ok(Laws { space, ideal })
    }

    /// The degree of a relation after substitution of the laws.
    fn degree(&self, terms: &SampledRelation) -> Result<u32> {
        let polynomial = self.space.polynomial(terms.iter().map(|(product, sample)| (product, sample[0])))?;
        Ok(self.space.ring.degree(&normal_form(&self.space.ring, &polynomial, &self.ideal)?))
    }
}

/// The first linearly independent relations whose unknown joints are all in the set. If joints follow others, relations of least degree come first.
fn independent(
    sampled: &mut SampledRelations<'_>,
    joints: u32,
    known: u32,
    laws: Option<&Laws>,
) -> Result<Vec<IndexedRelation>> {
    let of_loop = |index: &usize| sampled.relations[*index].followed().is_none();
    let mut within: Vec<usize> =
        subsets(joints).flat_map(|subset| sampled.among(subset, known)).filter(of_loop).collect();
    within.sort_unstable();
    if let Some(laws) = laws {
        let mut sorted = Vec::with_capacity(within.len());
        for index in within {
            let terms = sampled.of(index, joints & sampled.joints_of(index))?;
            sorted.push((laws.degree(&terms)?, index));
        }
        sorted.sort_unstable();
        within = sorted.into_iter().filter(|(degree, _)| *degree > 0).map(|(_, index)| index).collect();
    }
    let mut rows = Echelon::new(sampled.field());
    let mut found = Vec::new();
    for index in within.into_iter().take(LOOKED_AT) {
        let terms = sampled.of(index, joints & sampled.joints_of(index))?;
        if rows.insert(terms.iter().map(|(product, sample)| (product.clone(), sample[0]))) {
            found.push((index, terms));
        }
        if found.len() == CANDIDATES {
            break;
        }
    }
    Ok(found)
}

/// The non-empty subsets of a set.
fn subsets(joints: u32) -> impl Iterator<Item = u32> {
    (1..=joints).filter(move |subset| subset & !joints == 0)
}

/// All subsets of `size` of `count` indices. Those with low indices come first.
fn combinations(count: usize, size: usize) -> Vec<Vec<usize>> {
    (0_u32..1 << count).filter(|set| set.count_ones() as usize == size).map(members).collect()
}

/// The numbers of values of the joints when non-constant coefficients are free symbols, as in the symbolic basis, and the number of symbols.
///
/// Proportional coefficients remain proportional. If this gives too many values for a step, the other linear relations of the coefficients are kept too. These
/// count as [`LINEAR`] additional symbols.
fn freed_degrees(
    sampled: &mut SampledRelations<'_>,
    some: &[IndexedRelation],
    places: &[usize],
    watch: &Watch,
) -> Result<(Vec<usize>, usize)> {
    let space = Space::new(sampled.mechanism, places, sampled.field())?;
    let mut actual = Vec::new();
    for (_, terms) in some {
        actual.push(space.polynomial(terms.iter().map(|(product, sample)| (product, sample[0])))?);
    }
    // Free coefficients may give finitely many solutions where the actual coefficients do not, but never fewer solutions.
    if !degrees(sampled, actual, &space, places, watch)?.iter().any(is_allowed) {
        return Ok((vec![0; places.len()], 0));
    }
    let mut random = SplitMix64::new(some.iter().fold(1, |seed, (index, _)| seed * 1009 + *index as u64));
    let (polynomials, symbols) = freed(sampled, some, &space, &mut random)?;
    let free = degrees(sampled, polynomials, &space, places, watch)?;
    if free.iter().any(is_allowed) {
        return Ok((free, symbols));
    }
    let mut mixtures = Vec::new();
    for (index, _) in some {
        let unknown = set(places) & sampled.joints_of(*index);
        let mixture = sampled.mixture(*index, unknown)?;
        mixtures.push(space.polynomial(mixture.iter().map(|(product, &value)| (product, value)))?);
    }
    Ok((degrees(sampled, mixtures, &space, places, watch)?, symbols + LINEAR))
}

/// Whether a step may have this number of solutions.
fn is_allowed(degree: &usize) -> bool {
    (1..=GREATEST).contains(degree)
}

/// The number of values of each joint; zero if there are no solutions or infinitely many.
fn degrees(
    sampled: &SampledRelations<'_>,
    polynomials: Vec<Polynomial<u64>>,
    space: &Space,
    places: &[usize],
    watch: &Watch,
) -> Result<Vec<usize>> {
    let mut generators = space.circles(&sampled.squares)?;
    generators.extend(space.couplings(sampled.mechanism));
    generators.extend(polynomials);
    let basis = basis_modulo_prime(&space.ring, &generators, watch)?;
    match basis.quotient_dimension() {
        None | Some(0) => Ok(vec![0; places.len()]),
        Some(_) => space.degrees(&basis, places, &mut SplitMix64::new(sampled.field().modulus()), watch),
    }
}

/// The relations with random numbers in place of symbols, and the number of symbols.
fn freed(
    sampled: &SampledRelations<'_>,
    some: &[IndexedRelation],
    space: &Space,
    random: &mut SplitMix64,
) -> Result<(Vec<Polynomial<u64>>, usize)> {
    let field = sampled.field();
    let mut symbols: Vec<(SampledValue, u64)> = Vec::new();
    let mut value = |sample: &SampledValue| {
        if is_number(sample) {
            return sample[0];
        }
        for (symbol, value) in &symbols {
            if let Some(ratio) = sampled.ratio(sample, symbol) {
                return field.mul(&ratio, value);
            }
        }
        let value = random.unit(field.modulus());
        symbols.push((*sample, value));
        value
    };
    let polynomial = |(_, terms): &IndexedRelation| {
        let terms: Vec<_> = terms.iter().map(|(product, sample)| (product, value(sample))).collect();
        space.polynomial(terms.into_iter())
    };
    let polynomials = some.iter().map(polynomial).collect::<Result<_>>()?;
    Ok((polynomials, symbols.len()))
}
