//! Targets from rational joint values, where solutions are counted exactly.

use super::count::Counter;
use super::exact::Value;
use super::is_random;
use super::model::{Configuration, Model};
use crate::witness::check::Target;
use crate::witness::report::Kind;
use crate::{Result, Watch};
use groebot_algebra::number::{BigInt, BigRational};
use groebot_algebra::random::SplitMix64;
use groebot_robot::kinematics::Chain;

/// The maximum numerator and denominator of the half-angle tangents.
const HEIGHT: f64 = 7.0;

/// A target from rational joint values with its exact number of real solutions.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Counted {
    /// The target's numbers, rounded.
    pub inputs: Vec<f64>,
    /// The joint values that made the target, rounded.
    pub joints: Vec<f64>,
    /// The number of distinct real solutions; `None` if there are infinitely many or multiple ones.
    pub solutions: Option<usize>,
}

/// `number` counted targets of `chain`. Equal seeds give equal targets.
///
/// # Errors
/// The error of `watch` if it stops the count.
pub fn count_exactly<'w>(
    chain: &Chain,
    number: usize,
    seed: u64,
    watch: impl Into<Option<&'w Watch>>,
) -> Result<Vec<Counted>> {
    let watch = Watch::or_none(watch);
    let model = Model::new(chain);
    let mut rationals = Rationals::new(Counter::new(chain, &model.given), seed);
    (0..number).map(|_| rationals.counted(&model, watch)).collect()
}

/// The source of such targets.
pub(super) struct Rationals {
    counter: Counter,
    random: SplitMix64,
    done: usize,
}

impl Rationals {
    pub fn new(counter: Counter, seed: u64) -> Self {
        Rationals { counter, random: SplitMix64::new(seed ^ 0x5eed), done: 0 }
    }

    /// A counted target in place of a random one, while fewer than `wanted` were counted. Other targets are returned unchanged.
    pub fn in_place_of(
        &mut self,
        model: &dyn Configuration,
        target: Target,
        wanted: usize,
        watch: &Watch,
    ) -> Result<(Target, Option<usize>)> {
        if self.done >= wanted || !is_random(&target.kind) {
            return Ok((target, None));
        }
        self.done += 1;
        let Counted { inputs, joints, solutions } = self.counted(model, watch)?;
        Ok((Target { kind: Kind::Rational, inputs, joints: Some(joints) }, solutions))
    }

    fn counted(&mut self, model: &dyn Configuration, watch: &Watch) -> Result<Counted> {
        let values: Vec<Value> = (0..model.count()).filter_map(|joint| self.value(model, joint)).collect();
        let double = |(joint, value): (usize, &Value)| self.counter.double(joint, value);
        let joints: Vec<f64> = values.iter().enumerate().map(double).collect();
        let solutions = self.counter.count(&values, watch)?;
        Ok(Counted { inputs: model.target(&joints), joints, solutions })
    }

    /// A fraction with small numerator and denominator, neither zero nor one. For a prismatic joint, it is multiplied by a part of the reach.
    fn value(&mut self, model: &dyn Configuration, joint: usize) -> Option<Value> {
        let mut whole = |low: f64, high: f64| BigInt::from(self.random.between(low - 1.0, high).ceil() as i64);
        let (mut numerator, denominator) = (whole(1.0, HEIGHT), whole(2.0, HEIGHT));
        if whole(0.0, 1.0) == BigInt::from(0) {
            numerator = -numerator;
        }
        if numerator.magnitude() == denominator.magnitude() {
            numerator *= 2;
        }
        let share = BigRational::new(numerator, denominator);
        if model.turns(joint) {
            return self.counter.value(joint, &share);
        }
        // Not a round part: lengths of robots are round, and round displacements would give singular values.
        let thousandths = BigInt::from((model.length() * 237.1).round() as i64);
        self.counter.value(joint, &(share * BigRational::new(thousandths, 1000.into())))
    }
}
