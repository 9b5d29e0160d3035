//! Selection of a chain's accurate formulations ([`survey`]), by tests at random targets.

use groebot_runtime::six_axes::Rigid;

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
/// The accuracy, in decades, of a target at which the formulation is not trusted. It is worse than any error.
const DISTRUST: f64 = 4.0;

/// The best of these formulations, the most accurate first. The criterion is the mean order of magnitude of their candidates' errors before polishing. The best
/// formulation of each hidden joint comes before all others.
pub fn survey(layout: &Layout, formulations: &[Formulation]) -> Vec<Formulation> {
    let mut ranked: Vec<(f64, Formulation)> = formulations.iter().filter_map(|f| rank(layout, *f)).collect();
    ranked.sort_by(|a, b| a.0.total_cmp(&b.0));
    let is_second = |index: usize| ranked[..index].iter().any(|(_, f)| f.hidden == ranked[index].1.hidden);
    let (second, first): (Vec<usize>, Vec<usize>) = (0..ranked.len()).partition(|&index| is_second(index));
    first.into_iter().chain(second).take(MOST).map(|index| ranked[index].1).collect()
}

/// The mean order of magnitude of the errors. `None` for a formulation that is rarely trusted.
fn rank(layout: &Layout, formulation: Formulation) -> Option<(f64, Formulation)> {
    let solver = layout.chain(&Rigid::NONE, &[formulation]);
    let mut random = SplitMix64::new(SEED);
    let (mut sum, mut trusted) = (0.0, 0);
    for _ in 0..TARGETS {
        let q = layout.slides.map(|slides| {
            let value = number(&mut random);
            value * if slides { layout.length } else { std::f64::consts::PI }
        });
        let accuracy = solver.attempt(&solver.forward(&q)).accuracy;
        trusted += usize::from(accuracy.is_some());
        sum += accuracy.map_or(DISTRUST, |miss| miss.max(f64::EPSILON).log10());
    }
    let share = trusted as f64 / TARGETS as f64;
    let sliding = layout.slides.iter().filter(|slides| **slides).count();
    let least = if sliding > 1 { LEAST_OF_SLIDING } else { LEAST };
    (share >= least).then_some((sum / TARGETS as f64, formulation))
}

/// A random number in [-1, 1).
fn number(random: &mut SplitMix64) -> f64 {
    const FINE: u64 = 1 << 53;
    random.unit(FINE) as f64 / FINE as f64 * 2.0 - 1.0
}
