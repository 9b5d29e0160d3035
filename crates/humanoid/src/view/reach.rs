//! A reachability map in the format of a page.

use super::bytes::column;
use super::data::Reach;
use groebot_ik::reach::{Entry, Measure, ReachMap};
use groebot_ik::solver::Unit;

/// The map in the frame of the link `base`.
pub fn described(map: &ReachMap, base: usize) -> Reach {
    let metres = if map.unit == Unit::Millimetre.symbol() { 1e-3 } else { 1.0 };
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
