//! Fast marching with differences of the second order: the eikonal equation `|grad T| F = 1`, RH0 (4-11), with upwind
//! differences.
//!
//! J. A. Sethian, Level Set Methods and Fast Marching Methods (1999). A difference of the first order is used where the
//! second neighbour is not known.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::grid::Grid;
use crate::{Result, Watch};

/// T by place of the grid, from zero at the goals.
pub(super) fn arrivals(grid: &Grid, mut times: Vec<f64>, goals: &[usize], watch: &Watch) -> Result<Vec<f64>> {
    let mut accepted = vec![false; times.len()];
    // Trial values are ordered by the bits of their times, which sort correctly for numbers that are not negative.
    let mut band: BinaryHeap<Reverse<(u64, u32)>> = goals.iter().map(|place| Reverse((0, *place as u32))).collect();
    let mut count = 0u32;
    while let Some(Reverse((_, place))) = band.pop() {
        let place = place as usize;
        if std::mem::replace(&mut accepted[place], true) {
            continue;
        }
        count = count.wrapping_add(1);
        if count.is_multiple_of(4096) {
            watch.check()?;
        }
        for beside in grid.beside(place) {
            // NaN compares false with everything.
            if accepted[beside] || times[beside].is_nan() {
                continue;
            }
            let time = solve(grid, &times, &accepted, beside);
            if time < times[beside] {
                times[beside] = time;
                band.push(Reverse((time.to_bits(), beside as u32)));
            }
        }
    }
    Ok(times)
}

/// The root of the equation from the accepted neighbours.
fn solve(grid: &Grid, times: &[f64], accepted: &[bool], place: usize) -> f64 {
    let cost = grid.costs.of(place);
    // Along each axis `a T - b` is the difference, of the nearer neighbour: (T - T1), or (3 T - 4 T1 + T2) / 2.
    let axis = |step: usize| {
        let known = |at: usize| if accepted[at] { times[at] } else { f64::INFINITY };
        let (before, after) = (known(place - step), known(place + step));
        let (first, farther) =
            if before <= after { (before, place.checked_sub(2 * step)) } else { (after, Some(place + 2 * step)) };
        let second = farther.filter(|at| *at < times.len()).map_or(f64::INFINITY, known);
        if second <= first { (first, 1.5, 2.0 * first - 0.5 * second) } else { (first, 1.0, first) }
    };
    let mut axes = [axis(1), axis(grid.stride)];
    if axes[1].0 < axes[0].0 {
        axes.swap(0, 1);
    }
    let [(_, a, b), (farther, c, d)] = axes;
    let alone = (b + cost) / a;
    if alone <= farther {
        return alone;
    }
    // (a T - b)^2 + (c T - d)^2 = cost^2.
    let (square, half, rest) = (a * a + c * c, a * b + c * d, b * b + d * d - cost * cost);
    let discriminant = half * half - square * rest;
    if discriminant < 0.0 { alone } else { (half + discriminant.sqrt()) / square }
}
