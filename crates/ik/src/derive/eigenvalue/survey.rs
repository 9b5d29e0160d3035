//! Which formulations of a chain are accurate ([`survey`]): tried at random targets.

use groebot_runtime::six_axes::Rigid;

use crate::derive::samples::specimen::Random;
use crate::solver::eigenvalue::{Formulation, Layout};

/// Random targets that each formulation is tried at.
const TARGETS: usize = 100;
/// What the targets are drawn with.
const SEED: u64 = 11;
/// The most formulations that are kept.
const MOST: usize = 6;
/// The share of targets at which a formulation must be trusted.
const LEAST: f64 = 0.1;
/// The same for chains with two sliding joints or more, some of whose formulations find but half of the answers.
const LEAST_OF_SLIDING: f64 = 0.25;
/// How much worse than any miss a target counts at which the formulation is not trusted, in decades.
const DISTRUST: f64 = 4.0;

/// Of these formulations the best ones, most accurate first: by the mean order of magnitude of what their candidates miss before they are
/// polished. The best of each hidden joint come before all others.
pub fn survey(layout: &Layout, formulations: &[Formulation]) -> Vec<Formulation> {
    let mut ranked: Vec<(f64, Formulation)> = formulations.iter().filter_map(|f| rank(layout, *f)).collect();
    ranked.sort_by(|a, b| a.0.total_cmp(&b.0));
    let is_second = |index: usize| ranked[..index].iter().any(|(_, f)| f.hidden == ranked[index].1.hidden);
    let (second, first): (Vec<usize>, Vec<usize>) = (0..ranked.len()).partition(|&index| is_second(index));
    first.into_iter().chain(second).take(MOST).map(|index| ranked[index].1).collect()
}

/// The mean order of magnitude; `None` for a formulation that can hardly ever be trusted.
fn rank(layout: &Layout, formulation: Formulation) -> Option<(f64, Formulation)> {
    let solver = layout.chain(&Rigid::NONE, &[formulation]);
    let mut random = Random::new(SEED);
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
fn number(random: &mut Random) -> f64 {
    const FINE: u64 = 1 << 53;
    random.below(FINE) as f64 / FINE as f64 * 2.0 - 1.0
}
