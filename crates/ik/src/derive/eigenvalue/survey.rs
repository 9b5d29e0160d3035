//! Selection of a chain's accurate formulations ([`survey`]), by tests at random targets.
//!
//! Given joints between the six move some of the axes, so their values matter. They are random values within the limits, and round ones: zero, right angles and
//! the limits. If a formulation fails at a round value, another one that does not is among the first.

use std::f64::consts::{FRAC_PI_2, PI};

use groebot_runtime::six_axes::{Given, Rigid};

use super::given::Between;
use crate::solver::eigenvalue::{Formulation, Layout};
use groebot_algebra::random::SplitMix64;

/// The number of random targets for each formulation.
const TARGETS: usize = 100;
/// The random seed of the targets.
const SEED: u64 = 11;
/// The maximum number of formulations that are kept.
const MOST: usize = 6;
/// The minimum fraction of targets at which a formulation must give a trusted result.
const LEAST: f64 = 0.1;
/// Same as [`LEAST`], but for chains with at least two prismatic joints. Some of their formulations find only half of the solutions.
const LEAST_OF_SLIDING: f64 = 0.25;
/// The number of random targets for each formulation and each round value of given joints.
const ROUND_TARGETS: usize = 20;
/// The minimum fraction of these targets at which a formulation must give a trusted result.
const LEAST_OF_ROUND: f64 = 0.5;
/// The number of formulations that are tried at the target itself ([`groebot_runtime::tolerances::EIGENVALUES`]).
const FIRST: usize = 4;
/// One of so many targets has round values of given joints.
const ROUND_EVERY: usize = 4;
/// The accuracy, in decades, of a target at which the formulation is not trusted. It is worse than any error.
const DISTRUST: f64 = 4.0;

/// The best of these formulations, the most accurate first. The criterion is the mean order of magnitude of their candidates' errors before polishing. The best
/// formulation of each hidden joint comes before all others.
pub fn survey(layout: &Layout, formulations: &[Formulation]) -> Vec<Formulation> {
    with_given(layout, &[], formulations)
}

/// Same as [`survey`], but with given joints between the six.
pub(super) fn with_given(layout: &Layout, between: &[Between], formulations: &[Formulation]) -> Vec<Formulation> {
    let joints: Vec<GivenJoint> = between.iter().map(|joint| GivenJoint::new(joint, layout.length)).collect();
    let sliding = layout.slides.iter().filter(|slides| **slides).count();
    let least = if sliding > 1 { LEAST_OF_SLIDING } else { LEAST };
    let mixed = |index: usize, random: &mut SplitMix64| values(&joints, index, random);
    let rank = |f: &Formulation| Some(rank(layout, &joints, *f, TARGETS, &mixed)).filter(|rank| rank.share >= least);
    let mut ranked: Vec<(f64, Formulation)> = formulations.iter().filter_map(|f| Some((rank(f)?.error, *f))).collect();
    ranked.sort_by(|a, b| a.0.total_cmp(&b.0));
    let is_second = |index: usize| ranked[..index].iter().any(|(_, f)| f.hidden == ranked[index].1.hidden);
    let (second, first): (Vec<usize>, Vec<usize>) = (0..ranked.len()).partition(|&index| is_second(index));
    let mut order: Vec<Formulation> = first.into_iter().chain(second).map(|index| ranked[index].1).collect();
    for round in 0..joints.iter().map(|joint| joint.round.len()).max().unwrap_or(0) {
        promote(layout, &joints, round, &mut order);
    }
    order.truncate(MOST);
    order
}

/// Moves a formulation that is trusted at round values of given joints to the last place of the first ones, if none of these is.
fn promote(layout: &Layout, joints: &[GivenJoint], round: usize, order: &mut Vec<Formulation>) {
    let fixed = |_: usize, _: &mut SplitMix64| joints.iter().flat_map(|joint| joint.at(round)).collect();
    let trusted = |f: &Formulation| {
        Some(rank(layout, joints, *f, ROUND_TARGETS, &fixed)).filter(|rank| rank.share >= LEAST_OF_ROUND)
    };
    if order.iter().take(FIRST).any(|f| trusted(f).is_some()) {
        return;
    }
    let others = (FIRST..order.len()).filter_map(|index| Some((trusted(&order[index])?.error, index)));
    if let Some((_, index)) = others.min_by(|a, b| a.0.total_cmp(&b.0)) {
        let found = order.remove(index);
        order.insert(FIRST - 1, found);
    }
}

/// A given joint between the six, with its limits and its round values.
struct GivenJoint {
    given: Given,
    limits: (f64, f64),
    round: Vec<f64>,
}

impl GivenJoint {
    fn new(between: &Between, length: f64) -> Self {
        let given = between.line.scaled(length);
        let range = if given.slides { length } else { PI };
        let limits = between.joint.limits.filter(|(low, high)| low.is_finite() && high.is_finite() && low <= high);
        let (low, high) = limits.unwrap_or((-range, range));
        let angles = if given.slides { &[0.0][..] } else { &[0.0, FRAC_PI_2, -FRAC_PI_2, PI] };
        let round = angles.iter().copied().filter(|value| (low..=high).contains(value)).chain([low, high]).collect();
        GivenJoint { given, limits: (low, high), round }
    }

    /// The numbers of a value for the run time.
    fn numbers(&self, value: f64) -> [f64; 2] {
        if self.given.slides { [value, 0.0] } else { [value.cos(), value.sin()] }
    }

    /// The numbers of a round value.
    fn at(&self, round: usize) -> [f64; 2] {
        self.numbers(self.round[round % self.round.len()])
    }
}

/// The values of given joints at a target: random ones, or round ones at every fourth target.
fn values(joints: &[GivenJoint], index: usize, random: &mut SplitMix64) -> Vec<f64> {
    let value = |joint: &GivenJoint| {
        let (low, high) = joint.limits;
        let share = 0.5 + 0.5 * number(random);
        match index % ROUND_EVERY {
            0 => joint.at(index / ROUND_EVERY),
            _ => joint.numbers(low + share * (high - low)),
        }
    };
    joints.iter().flat_map(value).collect()
}

/// The result of tests at random targets.
struct Rank {
    /// The mean order of magnitude of the errors.
    error: f64,
    /// The fraction of targets with a trusted result.
    share: f64,
}

/// Tests a formulation at so many random targets, with the values of given joints by the index of the target.
fn rank(
    layout: &Layout,
    joints: &[GivenJoint],
    formulation: Formulation,
    targets: usize,
    values: &dyn Fn(usize, &mut SplitMix64) -> Vec<f64>,
) -> Rank {
    let base = layout.chain(&Rigid::NONE, &[formulation]);
    let given: Vec<Given> = joints.iter().map(|joint| joint.given).collect();
    let mut random = SplitMix64::new(SEED);
    let (mut sum, mut trusted) = (0.0, 0);
    for index in 0..targets {
        let q = layout.slides.map(|slides| {
            let value = number(&mut random);
            value * if slides { layout.length } else { PI }
        });
        let solver = base.with_given(&given, &values(index, &mut random));
        let accuracy = solver.attempt(&solver.forward(&q)).accuracy;
        trusted += usize::from(accuracy.is_some());
        sum += accuracy.map_or(DISTRUST, |miss| miss.max(f64::EPSILON).log10());
    }
    Rank { error: sum / targets as f64, share: trusted as f64 / targets as f64 }
}

/// A random number in [-1, 1).
fn number(random: &mut SplitMix64) -> f64 {
    const FINE: u64 = 1 << 53;
    random.unit(FINE) as f64 / FINE as f64 * 2.0 - 1.0
}
