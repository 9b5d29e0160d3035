//! How far it is at least, or about, from a window to the goal. Main type: [`Aim`].

use super::plane::Spot;
use super::rows::Rows;
use super::windows::{Goal, Root, Window};

/// What a search goes by.
pub(super) enum Aim<'a> {
    /// The straight line to the goal: no way is shorter.
    Straight,
    /// How far it is to the window: there is no goal.
    Nearest,
    /// The times of a field by cell, and by how much to multiply them to have cells, about as far as it is; the straight line where that is longer.
    Field(&'a [f64], f64),
}

impl Aim<'_> {
    /// The length of a way by a window of a root.
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

    /// How far it is from a corner.
    pub fn from(&self, rows: &Rows, goal: &Goal, x: usize, y: usize) -> f64 {
        let straight = norm(goal.real.x - x as f64, goal.real.y - y as f64);
        match self {
            Aim::Straight => straight,
            Aim::Nearest => 0.0,
            Aim::Field(times, scale) => straight.max(scale * about(rows, times, x, y)),
        }
    }
}

/// The square root of the squares' sum; coordinates of a map do not overflow.
pub(super) fn norm(x: f64, y: f64) -> f64 {
    (x * x + y * y).sqrt()
}

/// The time at a corner: the mean of those of the free cells about it.
fn about(rows: &Rows, times: &[f64], x: usize, y: usize) -> f64 {
    let cells = [(x - 1, y - 1), (x, y - 1), (x - 1, y), (x, y)];
    let free = cells.iter().filter(|(x, y)| rows.has(*x, *y));
    let sum = free.map(|(x, y)| times[rows.cell(*x, *y)]).sum::<f64>();
    // It is convex: one of the four is an obstacle.
    sum / 3.0
}

/// From a root by a stretch of a line to the goal, which is seen in the line's mirror where it is on the root's side.
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

/// The time on the line of a window, between those of the cells beside.
fn on_line(rows: &Rows, times: &[f64], window: &Window, x: f64) -> f64 {
    let (first, last) = (f64::from(window.opening.0), f64::from(window.opening.1));
    let place = (x - 0.5).clamp(first, last - 1.0);
    let (left, share) = (place.floor() as usize, place.fract());
    let right = (left + 1).min(window.opening.1 as usize - 1);
    let line = window.view.line();
    let at = |x: usize| times[rows.cell(x, line)] + times[rows.cell(x, line - 1)];
    0.5 * ((1.0 - share) * at(left) + share * at(right))
}

/// The least value of a function that falls and rises.
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
