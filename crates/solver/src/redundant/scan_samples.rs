//! Samples of scanned joints: [`ScanLimits`], [`samples`], [`between`].

use super::{Absence, JointLimits};
use crate::MOST_SCANNED;

/// The number of samples of one scanned joint, the ends of its range included. Each further joint multiplies it by [`FACTOR`].
pub(super) const SAMPLES: usize = 33;
/// The factor of the number of samples for each further scanned joint.
const FACTOR: usize = 4;
/// The bases of the sequences of samples (J. H. Halton, Numerische Mathematik 2 (1960) 84-90).
const BASES: [usize; MOST_SCANNED] = [2, 3, 5];

/// Limits of all joints of the chain, for the scanned ones and the others.
pub(super) struct ScanLimits {
    /// By scanned joint, the least and the greatest value.
    pub ranges: Vec<[f64; 2]>,
    pub own: JointLimits,
}

/// Values of the scanned joints: the middle of the ranges first, then a sequence that fills them evenly. The last ones are the corners.
pub(super) fn samples(ranges: &[[f64; 2]]) -> Vec<Vec<f64>> {
    let count = ranges.len();
    let corners = 1 << count;
    let inner = (SAMPLES * FACTOR.pow(count as u32 - 1)).saturating_sub(corners);
    let place = |share: f64, [low, high]: &[f64; 2]| low + share * (high - low);
    let inside = (1..=inner).map(|index| {
        ranges.iter().zip(BASES).map(|(range, base)| place(radical_inverse(index, base), range)).collect()
    });
    let corner = |corner: usize| {
        ranges.iter().enumerate().map(|(k, range)| place((corner >> k & 1) as f64, range)).collect::<Vec<f64>>()
    };
    inside.chain((0..corners).map(corner)).collect()
}

/// Values between neighbouring samples of one scanned joint of which at least one is reachable beyond limits: quarters of the intervals.
pub(super) fn between(absences: &[(Vec<f64>, Option<Absence>)]) -> Vec<Vec<f64>> {
    let is_beyond = |absence: &Option<Absence>| matches!(absence, Some(Absence::Beyond(_)));
    let mut row: Vec<(f64, bool)> = absences
        .iter()
        .filter(|(values, _)| values.len() == 1)
        .map(|(values, absence)| (values[0], is_beyond(absence)))
        .collect();
    row.sort_by(|a, b| a.0.total_cmp(&b.0));
    let pairs = row.windows(2).filter(|pair| pair[0].1 || pair[1].1);
    pairs.flat_map(|pair| [0.25, 0.5, 0.75].map(|share| vec![pair[0].0 + share * (pair[1].0 - pair[0].0)])).collect()
}

/// The digits of `index` in a base, mirrored at the point.
fn radical_inverse(mut index: usize, base: usize) -> f64 {
    let (mut value, mut share) = (0.0, 1.0);
    while index > 0 {
        share /= base as f64;
        value += share * (index % base) as f64;
        index /= base;
    }
    value
}
