//! Heuristics: the least, or the approximate, distance from a window to the goal. Main type: [`Aim`].

use super::plane::Spot;
use super::rows::Rows;
use super::windows::{Goal, Root, Window};

/// The heuristic of a search.
pub(super) enum Aim<'a> {
    /// The straight line to the goal: a lower bound.
    Straight,
    /// The distance to the window: there is no goal.
    Nearest,
    /// The times of a field by cell, with the factor to cells, which approximate the distance; the straight line where
    /// that is longer.
    Field(&'a [f64], f64),
}

impl Aim<'_> {
    /// The length of a path through a window of a root.
    pub fn through(&self, rows: &Rows, goal: &Goal, root: &Root, window: &Window) -> f64 {
        let line = window.view.line() as f64;
        let at = |ray: Spot| root.real.x + ray.x as f64 / ray.y as f64 * (line - root.real.y);
        let ends = window.rays.map(at);
        let height = (line - root.real.y).abs();
        let straight = || by_straight(goal, root.real.x, height, line, ends);
        let beyond = match self {
            Aim::Straight => straight(),
            Aim::Nearest => norm((ends[0] - root.real.x).max(root.real.x - ends[1]).max(0.0), height),
            Aim::Field(times, scale) => {
                let far = |x: f64| norm(x - root.real.x, height) + scale * on_line(rows, times, window, x);
                straight().max(least(far, ends))
            }
        };
        root.length + beyond
    }

    /// The distance from a corner to the goal.
    pub fn from(&self, rows: &Rows, goal: &Goal, x: usize, y: usize) -> f64 {
        let straight = norm(goal.real.x - x as f64, goal.real.y - y as f64);
        match self {
            Aim::Straight => straight,
            Aim::Nearest => 0.0,
            Aim::Field(times, scale) => straight.max(scale * about(rows, times, x, y)),
        }
    }
}

/// The square root of the sum of squares; coordinates of a map do not overflow.
pub(super) fn norm(x: f64, y: f64) -> f64 {
    (x * x + y * y).sqrt()
}

/// The time at a corner: the mean of the free cells around it.
fn about(rows: &Rows, times: &[f64], x: usize, y: usize) -> f64 {
    let cells = [(x - 1, y - 1), (x, y - 1), (x - 1, y), (x, y)];
    let free = cells.iter().filter(|(x, y)| rows.has(*x, *y));
    let sum = free.map(|(x, y)| times[rows.cell(*x, *y)]).sum::<f64>();
    // The corner is convex, so one of the four cells is an obstacle.
    sum / 3.0
}

/// The straight distance from a root through an interval of a line to the goal. Where the goal is on the root's side,
/// its mirror image in the line is used.
fn by_straight(goal: &Goal, root: f64, height: f64, line: f64, ends: [f64; 2]) -> f64 {
    let depth = (goal.real.y - line).abs();
    let share = if height + depth > 0.0 { height / (height + depth) } else { 0.0 };
    let crossing = root + (goal.real.x - root) * share;
    let through = crossing.clamp(ends[0], ends[1].max(ends[0]));
    if through == crossing {
        norm(goal.real.x - root, height + depth)
    } else {
        norm(through - root, height) + norm(goal.real.x - through, depth)
    }
}

/// The time on the line of a window, interpolated between the adjacent cells.
fn on_line(rows: &Rows, times: &[f64], window: &Window, x: f64) -> f64 {
    let (first, last) = (f64::from(window.opening.0), f64::from(window.opening.1));
    let place = (x - 0.5).clamp(first, last - 1.0);
    let (left, share) = (place.floor() as usize, place.fract());
    let right = (left + 1).min(window.opening.1 as usize - 1);
    let line = window.view.line();
    let at = |x: usize| times[rows.cell(x, line)] + times[rows.cell(x, line - 1)];
    0.5 * ((1.0 - share) * at(left) + share * at(right))
}

/// The minimum of a unimodal function.
fn least(of: impl Fn(f64) -> f64, [mut low, mut high]: [f64; 2]) -> f64 {
    let mut found = of(low).min(of(high));
    while high - low > 0.5 {
        let third = (high - low) / 3.0;
        let [left, right] = [low + third, high - third].map(&of);
        found = found.min(left.min(right));
        if left < right { high -= third } else { low += third }
    }
    found
}
