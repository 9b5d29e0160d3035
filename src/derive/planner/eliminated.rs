//! Steps that find one joint after others are eliminated from as many relations as unknown joints.

use std::rc::Rc;

use super::evidence::Space;
use super::one_joint::Candidate;
use super::sights::{Sample, Sight, Sights, is_number, members};
use super::specimen::Random;
use super::types::{PlanStep, Way};
use crate::derive::closure::Factors;
use crate::groebner::basis_modulo_prime;
use crate::number::{Field, Ring};
use crate::poly::Polynomial;
use crate::{Result, Watch};

/// The greatest degree that a step may have.
const GREATEST: usize = 4;
/// So many independent relations are combined.
const CANDIDATES: usize = 4;
/// So many relations are looked at for independent ones.
const LOOKED_AT: usize = 24;

/// The steps to one of the joints of the set `joints`, given those of `known`, that have at most [`GREATEST`] solutions: for each
/// joint the one of lowest degree.
///
/// # Errors
/// As [`Sights::of`]; what `watch` stops with.
pub fn eliminations(sights: &mut Sights<'_>, joints: u32, known: u32, watch: &Watch) -> Result<Vec<Candidate>> {
    let places = members(joints);
    let relations = independent(sights, joints, known)?;
    let mut best: Vec<Option<Candidate>> = vec![None; places.len()];
    for chosen in combinations(relations.len(), places.len()) {
        watch.check()?;
        let some: Vec<(usize, Rc<Sight>)> = chosen.into_iter().map(|at| relations[at].clone()).collect();
        if !covers(&some, joints) {
            continue;
        }
        let Some(degrees) = degrees(sights, &some, &places, watch)? else { continue };
        for (at, &degree) in degrees.iter().enumerate() {
            let is_better = best[at].as_ref().is_none_or(|(step, _)| degree < step.degree);
            if is_better && (1..=GREATEST).contains(&degree) {
                best[at] = Some(step(sights, &some, &places, at, degree));
            }
        }
    }
    Ok(best.into_iter().flatten().collect())
}

fn step(sights: &Sights<'_>, some: &[(usize, Rc<Sight>)], places: &[usize], at: usize, degree: usize) -> Candidate {
    let relations = some.iter().map(|(index, _)| sights.relations[*index].clone()).collect();
    let away = places.iter().copied().filter(|&place| place != places[at]).collect();
    let step = PlanStep { joint: places[at], way: Way::Eliminated { relations, away }, degree };
    (step, 10 * places.len())
}

/// Whether every joint of the set occurs.
fn covers(some: &[(usize, Rc<Sight>)], joints: u32) -> bool {
    let factors = some.iter().flat_map(|(_, sight)| sight.iter().flat_map(|(product, _)| product.list()));
    factors.fold(0, |set, factor| set | 1 << factor.joint()) == joints
}

/// The first linearly independent relations in which only joints of the set are unknown.
fn independent(sights: &mut Sights<'_>, joints: u32, known: u32) -> Result<Vec<(usize, Rc<Sight>)>> {
    let field = sights.field();
    let within: Vec<usize> = subsets(joints).flat_map(|subset| sights.among(subset, known)).collect();
    let mut within = within;
    within.sort_unstable();
    let mut rows: Vec<Vec<(Factors, u64)>> = Vec::new();
    let mut found = Vec::new();
    for index in within.into_iter().take(LOOKED_AT) {
        let unknown = joints & sights.joints_of(index);
        let sight = sights.of(index, unknown)?;
        let mut row: Vec<(Factors, u64)> = sight.iter().map(|(product, sample)| (product.clone(), sample[0])).collect();
        for own in &rows {
            cancel(field, &mut row, own);
        }
        row.retain(|(_, value)| *value != 0);
        if !row.is_empty() {
            rows.push(row);
            found.push((index, sight));
        }
        if found.len() == CANDIDATES {
            break;
        }
    }
    Ok(found)
}

/// Takes as much of `own` from `row` as cancels the last product of `own`.
fn cancel<F: Field<Element = u64>>(field: F, row: &mut Vec<(Factors, u64)>, own: &[(Factors, u64)]) {
    let Some((lead, value)) = own.last() else { return };
    let Some(at) = row.iter().position(|(product, _)| product == lead) else { return };
    let Some(factor) = field.checked_div(&row[at].1, value) else { return };
    for (product, value) in own {
        let change = field.mul(&factor, value);
        match row.iter_mut().find(|(own, _)| own == product) {
            Some((_, sum)) => *sum = field.sub(sum, &change),
            None => row.push((product.clone(), field.neg(&change))),
        }
    }
    row.sort();
}

/// The subsets that are not empty.
fn subsets(joints: u32) -> impl Iterator<Item = u32> {
    (1..=joints).filter(move |subset| subset & !joints == 0)
}

/// All ways to choose `size` of `count` things, the first ones first.
fn combinations(count: usize, size: usize) -> Vec<Vec<usize>> {
    (0_u32..1 << count).filter(|set| set.count_ones() as usize == size).map(members).collect()
}

/// The numbers of values of the joints when all coefficients that are no numbers are free, as they are for the basis with symbols;
/// proportional ones stay so. `None` when they are not finite, or zero.
fn degrees(
    sights: &Sights<'_>,
    some: &[(usize, Rc<Sight>)],
    places: &[usize],
    watch: &Watch,
) -> Result<Option<Vec<usize>>> {
    let mut random = Random::new(some.iter().fold(1, |seed, (index, _)| seed * 1009 + *index as u64));
    let space = Space::new(sights.mechanism, places, sights.field())?;
    let mut generators = space.circles(&sights.squares)?;
    generators.extend(freed(sights, some, &space, &mut random)?);
    let basis = basis_modulo_prime(&space.ring, &generators, watch)?;
    match basis.quotient_dimension() {
        None | Some(0) => Ok(None),
        Some(_) => space.degrees(&basis, places, &mut random, watch).map(Some),
    }
}

/// The relations with random numbers for symbols.
fn freed(
    sights: &Sights<'_>,
    some: &[(usize, Rc<Sight>)],
    space: &Space,
    random: &mut Random,
) -> Result<Vec<Polynomial<u64>>> {
    let field = sights.field();
    let mut symbols: Vec<(Sample, u64)> = Vec::new();
    let mut value = |sample: &Sample| {
        if is_number(sample) {
            return sample[0];
        }
        for (symbol, value) in &symbols {
            if let Some(ratio) = sights.ratio(sample, symbol) {
                return field.mul(&ratio, value);
            }
        }
        let value = random.below(field.modulus());
        symbols.push((*sample, value));
        value
    };
    let polynomial = |(_, sight): &(usize, Rc<Sight>)| {
        let terms: Vec<_> = sight.iter().map(|(product, sample)| (product, value(sample))).collect();
        space.polynomial(terms.into_iter())
    };
    some.iter().map(polynomial).collect()
}
