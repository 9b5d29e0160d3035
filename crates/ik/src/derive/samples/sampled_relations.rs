//! Relations at three random targets modulo one prime. They show which coefficients are constant and which are proportional.

use std::collections::{BTreeMap, HashMap};
use std::rc::Rc;

use super::random_sample::RandomSample;
use crate::Result;
use crate::derive::closure::{Arithmetic, Coupling, Factor, Factors, Mechanism, Modular, Multilinear, Relation};
use groebot_algebra::number::{Ring, Zp};
use groebot_algebra::random::SplitMix64;

/// The number of targets of a sample.
pub const SAMPLES: usize = 3;

/// The number of targets in a mixture: one more than the maximum number of free symbols.
const MIXED: usize = 12;

/// The values of a coefficient at all targets.
pub type SampledValue = [u64; SAMPLES];

/// A relation with some joints known: for each product of the unknown joints its coefficient, with product 1 first.
pub type SampledRelation = Vec<(Factors, SampledValue)>;

/// The relations of a mechanism at random targets.
#[non_exhaustive]
pub struct SampledRelations<'a> {
    pub mechanism: &'a Mechanism,
    pub relations: &'a [Relation],
    /// |w|^2 of each joint's axis.
    pub squares: Vec<u64>,
    arithmetic: Modular,
    samples: Vec<RandomSample>,
    /// Random weights with the sum 1, one for each target.
    weights: Vec<u64>,
    /// The joints of each relation, as a set.
    joints: Vec<u32>,
    /// For each relation, the leader that must be known before its follower's relation is used, unless the law is linear. As a set.
    leaders: Vec<u32>,
    seen: HashMap<(usize, u32), Rc<SampledRelation>>,
}

impl<'a> SampledRelations<'a> {
    pub fn new(
        mechanism: &'a Mechanism,
        relations: &'a [Relation],
        mut arithmetic: Modular,
        random: &mut SplitMix64,
    ) -> Result<Self> {
        let field = arithmetic.field();
        let mut weights: Vec<u64> = (1..MIXED).map(|_| random.unit(field.modulus())).collect();
        weights.push(weights.iter().fold(field.one(), |rest, weight| field.sub(&rest, weight)));
        let draw = |_| RandomSample::draw(mechanism, &mut arithmetic, random);
        let samples = (0..MIXED).map(draw).collect::<Result<_>>()?;
        let squares = mechanism.joints().iter().map(|joint| arithmetic.rational(&joint.square)).collect();
        let joints = relations.iter().map(|relation| set(&relation.joints())).collect();
        let leaders = relations.iter().map(|relation| nonlinear_leader(mechanism, relation)).collect();
        let seen = HashMap::new();
        Ok(SampledRelations { mechanism, relations, squares, arithmetic, samples, weights, joints, leaders, seen })
    }

    /// The prime field.
    pub fn field(&self) -> Zp {
        self.arithmetic.field()
    }

    /// The relations whose unknown joints are exactly the set `joints` when those of `known` are known.
    pub fn among(&self, joints: u32, known: u32) -> impl Iterator<Item = usize> + '_ {
        let is_linear = move |index: &usize| self.leaders[*index] & !known == 0;
        (0..self.relations.len()).filter(move |&index| self.joints[index] & !known == joints).filter(is_linear)
    }

    /// The joints of the relation `index`, as a set.
    pub fn joints_of(&self, index: usize) -> u32 {
        self.joints[index]
    }

    /// The relation `index` as a polynomial in the joints of the set `unknown`. The other joints have their sampled values.
    pub fn of(&mut self, index: usize, unknown: u32) -> Result<Rc<SampledRelation>> {
        if let Some(terms) = self.seen.get(&(index, unknown)) {
            return Ok(Rc::clone(terms));
        }
        let relation = &self.relations[index];
        let mut values = Vec::with_capacity(SAMPLES);
        for sample in &self.samples[..SAMPLES] {
            values.push(sample.evaluate(self.mechanism, relation, unknown, &mut self.arithmetic)?);
        }
        let terms = Rc::new(gather(&values));
        self.seen.insert((index, unknown), Rc::clone(&terms));
        Ok(terms)
    }

    /// The relation `index` with random coefficients that keep only their linear relations over the rational numbers. It is the mean of the relation over many
    /// targets, with random weights whose sum is 1.
    pub fn mixture(&mut self, index: usize, unknown: u32) -> Result<BTreeMap<Factors, u64>> {
        let (relation, field) = (&self.relations[index], self.field());
        let mut mixture: BTreeMap<Factors, u64> = BTreeMap::new();
        for (sample, weight) in self.samples.iter().zip(&self.weights) {
            let value = sample.evaluate(self.mechanism, relation, unknown, &mut self.arithmetic)?;
            for (product, coefficient) in value.terms() {
                let sum = mixture.entry(product.clone()).or_default();
                *sum = field.add(sum, &field.mul(weight, coefficient));
            }
        }
        Ok(mixture)
    }

    /// `a / b` if it is equal at all targets.
    pub fn ratio(&self, a: &SampledValue, b: &SampledValue) -> Option<u64> {
        let field = self.field();
        let ratio = field.checked_div(&a[0], &b[0])?;
        (0..SAMPLES).all(|k| a[k] == field.mul(&ratio, &b[k])).then_some(ratio)
    }
}

/// The leader of a relation of a joint that follows it by a non-linear law, as a set; empty otherwise.
fn nonlinear_leader(mechanism: &Mechanism, relation: &Relation) -> u32 {
    let Some([follower, leader, _]) = relation.followed() else { return 0 };
    let coupling = mechanism.joints()[follower].coupling.as_ref();
    if coupling.is_some_and(Coupling::is_linear) { 0 } else { 1 << leader }
}

/// The set of these joints, as a bit mask.
pub fn set(joints: &[usize]) -> u32 {
    joints.iter().fold(0, |set, joint| set | 1 << joint)
}

/// The joints of a set, ascending.
pub fn members(set: u32) -> Vec<usize> {
    (0..u32::BITS as usize).filter(|joint| set >> joint & 1 == 1).collect()
}

fn gather(values: &[Multilinear<u64>]) -> SampledRelation {
    let mut terms: HashMap<&Factors, SampledValue> = HashMap::new();
    for (k, value) in values.iter().enumerate() {
        for (product, &coefficient) in value.terms() {
            terms.entry(product).or_default()[k] = coefficient;
        }
    }
    let mut terms: SampledRelation = terms.into_iter().map(|(product, sample)| (product.clone(), sample)).collect();
    terms.sort();
    terms
}

/// The coefficient of a product; zero if the product does not occur.
pub fn coefficient(terms: &SampledRelation, factors: &[Factor]) -> SampledValue {
    let found = terms.iter().find(|(product, _)| product.list() == factors);
    found.map_or([0; SAMPLES], |(_, sample)| *sample)
}

/// Whether the coefficient is equal at all targets: then it is a rational constant of the mechanism.
pub fn is_number(sample: &SampledValue) -> bool {
    sample.iter().all(|value| *value == sample[0])
}

/// Whether the coefficient is nonzero at all targets.
pub fn is_sound(sample: &SampledValue) -> bool {
    !sample.contains(&0)
}
