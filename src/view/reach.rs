//! A map of what a limb reaches as a page shows it.

use super::bytes::column;
use super::data::Reach;
use crate::reach::{Entry, Measure, ReachMap};

/// The map in the frame of the link `base`, whose unit of length is so many metres.
pub fn described(map: &ReachMap, base: usize, metres: f64) -> Reach {
    let numbers = |number: fn(&Entry) -> f64| column(map.entries.iter().map(number));
    Reach {
        base,
        of: format!("{}, {}", map.solver, map.task),
        axes: map.grid.axes().map(|axis| (axis.from * metres, axis.to * metres, axis.count)),
        orientations: map.orientations,
        limited: map.limited,
        reached: numbers(|entry| f64::from(entry.reached)),
        answers: numbers(|entry| f64::from(entry.answers)),
        manipulability: (map.measure == Measure::Manipulability).then(|| numbers(|entry| entry.mean.into())),
    }
}
