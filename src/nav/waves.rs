//! The thesis' modified fast marching, RH0 4.3: wave after wave over four neighbours.

use super::grid::{Costs, Grid};
use crate::{Result, Watch};

/// More levels of costs than this are put in order by a heap.
const LEVELS: f64 = 65_536.0;

/// T of RH0 (4-17) and (4-18) by cell of the grid.
pub(super) fn arrivals(grid: &Grid, goals: &[usize], watch: &Watch) -> Result<Vec<f64>> {
    match &grid.costs {
        Costs::Even(cost) => even(grid, goals, *cost, watch),
        Costs::Own(costs) => own(grid, goals, costs, watch),
    }
}

/// Where all cells cost the same, a wave is all that is one cell farther.
fn even(grid: &Grid, goals: &[usize], cost: f64, watch: &Watch) -> Result<Vec<f64>> {
    let mut times = grid.untouched.clone();
    let mut wave: Vec<u32> = goals.iter().map(|goal| grid.place(*goal) as u32).collect();
    wave.iter().for_each(|place| times[*place as usize] = 0.0);
    let (mut next, mut count) = (Vec::with_capacity(wave.len() + 1024), 0u32);
    while !wave.is_empty() {
        if count.is_multiple_of(256) {
            watch.check()?;
        }
        count += 1;
        let time = f64::from(count) * cost;
        for place in wave.drain(..) {
            let place = place as usize;
            for beside in [place - 1, place + 1, place - grid.stride, place + grid.stride] {
                if times[beside] == f64::INFINITY {
                    times[beside] = time;
                    next.push(beside as u32);
                }
            }
        }
        std::mem::swap(&mut wave, &mut next);
    }
    Ok(times)
}

/// Where they differ, trial values wait in levels as wide as the least cost, so that none in a level changes another one there (R. Dial, Communications of the ACM 12, 1969).
fn own(grid: &Grid, goals: &[usize], costs: &[f64], watch: &Watch) -> Result<Vec<f64>> {
    let mut times = grid.untouched.clone();
    let finite = || costs.iter().copied().filter(|cost| cost.is_finite());
    let (least, most) = (finite().fold(f64::INFINITY, f64::min), finite().fold(0.0, f64::max));
    let width = least.max(most / LEVELS);
    let count = (most / width).ceil() as usize + 2;
    let mut levels: Vec<Vec<u32>> = vec![Vec::new(); count];
    levels[0].extend(goals.iter().map(|goal| grid.place(*goal) as u32));
    levels[0].iter().for_each(|place| times[*place as usize] = 0.0);
    let (mut level, mut waiting) = (0usize, levels[0].len());
    while waiting > 0 {
        if level.is_multiple_of(256) {
            watch.check()?;
        }
        while let Some(place) = levels[level % count].pop() {
            waiting -= 1;
            let (place, time) = (place as usize, times[place as usize]);
            // One that was put forward since has been dealt with.
            if (time / width) as usize != level {
                continue;
            }
            for beside in [place - 1, place + 1, place - grid.stride, place + grid.stride] {
                let new = time + costs[beside];
                if new < times[beside] {
                    times[beside] = new;
                    levels[(new / width) as usize % count].push(beside as u32);
                    waiting += 1;
                }
            }
        }
        level += 1;
    }
    Ok(times)
}
