//! The search for a shortest path over windows. Main type: [`Search`].
//!
//! A window is an interval of a lattice line that is visible from a root; through it the search enters a row. If its
//! end is a convex corner, a path may turn there, and the corner becomes a root.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use nalgebra::Point2;

use super::aim::{Aim, norm};
use super::corners::Corners;
use super::plane::{Plane, Spot};
use super::rows::Rows;
use super::windows::{Goal, NONE, Rays, Root, View, Window};
use crate::{Result, Watch};

/// The relative difference below which two lengths are equal.
const SAME: f64 = 1e-12;
/// The turn of a path at a corner: the interval of rays that it can continue in, and whether it follows the line to the
/// left or to the right.
#[derive(Clone, Copy)]
pub(super) struct Turn {
    pub view: View,
    pub rays: Rays,
    /// A cell of the row that touches the corner.
    pub cell: u32,
    pub follows: Option<bool>,
}

#[derive(Clone, Copy)]
enum Step {
    Window(Window),
    Turn(Turn),
}

/// A search from one start to one goal.
pub(super) struct Search<'a> {
    pub rows: &'a Rows,
    pub plane: Plane,
    pub goal: Goal,
    aim: Aim<'a>,
    pub roots: Vec<Root>,
    /// By lattice point, its root; zero where it has none.
    numbers: Vec<u32>,
    steps: Vec<Step>,
    /// Indices of steps that have been taken and can be used again.
    taken: Vec<u32>,
    /// Steps by the bits of the least length of a path through them. The bits of positive numbers sort correctly.
    queue: BinaryHeap<Reverse<(u64, u32)>>,
    fresh: Vec<Window>,
    /// The shortest known path: its length and its last root.
    pub best: (f64, u32),
    /// The number of the corner from which [`Corners`] give the rest of that path; zero for none.
    pub via: u32,
    pub distances: Option<&'a Corners>,
    /// The number of steps that have been taken.
    pub count: usize,
}

/// The end state of a search.
pub(super) enum End {
    /// No step below the limit is left.
    Closed,
    /// The effort is spent; this is a lower bound for all paths that are not known.
    Open(f64),
}

impl<'a> Search<'a> {
    pub fn new(rows: &'a Rows, plane: Plane, goal: Goal, aim: Aim<'a>) -> Self {
        let (numbers, queue) = (vec![0; rows.points()], BinaryHeap::new());
        let best = (f64::INFINITY, NONE);
        Search {
            rows,
            plane,
            goal,
            aim,
            roots: vec![],
            numbers,
            steps: vec![],
            taken: vec![],
            queue,
            fresh: vec![],
            best,
            via: 0,
            distances: None,
            count: 0,
        }
    }

    /// Expands the start in a cell.
    pub fn start(&mut self, real: Point2<f64>, cell: (usize, usize)) {
        let spot = self.plane.spot(&real, cell);
        self.roots.push(Root { spot, real, length: 0.0, before: NONE, turns: [None; 2] });
        self.begin(cell);
    }

    /// Takes the most promising step until none is below the best length, or until `effort` steps are taken and a path
    /// is known.
    pub fn run<'w>(&mut self, effort: Option<usize>, watch: impl Into<Option<&'w Watch>>) -> Result<End> {
        let watch = Watch::or_none(watch);
        let mut checked = self.count;
        while let Some(Reverse((bits, step))) = self.queue.pop() {
            let least = f64::from_bits(bits);
            if least >= self.best.0 * (1.0 - SAME) {
                return Ok(End::Closed);
            }
            if self.best.0.is_finite() && effort.is_some_and(|effort| self.count >= effort) {
                return Ok(End::Open(least));
            }
            if self.count >= checked + 1024 {
                checked = self.count;
                watch.report("shortest path", self.count, self.queue.len());
                watch.check()?;
            }
            self.taken.push(step);
            match self.steps[step as usize] {
                Step::Window(window) => self.enter(window),
                Step::Turn(turn) => self.turn(&turn),
            }
        }
        Ok(End::Closed)
    }

    /// Enters the row after a window, and continues while there is only one successor.
    fn enter(&mut self, mut window: Window) {
        loop {
            self.count += 1;
            if self.is_overtaken(&window.view) || self.is_dominated(&window) {
                return;
            }
            let run = self.rows.run(window.opening.0 as usize, window.view.row as usize);
            self.corners(&window);
            self.spread(&window.view, window.rays.map(Some), run);
            let least = self.queue.peek().map_or(f64::INFINITY, |Reverse((bits, _))| f64::from_bits(*bits));
            match self.fresh[..] {
                [only] if self.through(&only) <= least.min(self.best.0) => window = only,
                _ => return self.queue_fresh(),
            }
        }
    }

    /// Continues from a corner.
    fn turn(&mut self, turn: &Turn) {
        self.count += 1;
        if self.is_overtaken(&turn.view) {
            return;
        }
        self.look(&turn.view, turn.rays, turn.cell as usize);
        if let Some(is_right) = turn.follows {
            let corner = self.plane.floor(self.roots[turn.view.root as usize].spot);
            self.walk(turn.view.root, corner, is_right, [true; 2]);
        }
    }

    /// Whether a shorter path to the root has been found since.
    fn is_overtaken(&self, view: &View) -> bool {
        view.length > self.roots[view.root as usize].length * (1.0 + SAME)
    }

    /// Whether the whole window is reached sooner along its line, from a corner at an end of its opening.
    fn is_dominated(&self, window: &Window) -> bool {
        let root = &self.roots[window.view.root as usize];
        let line = window.view.line();
        let height = line as f64 - root.real.y;
        let sooner = |end: u32, ray: Spot| {
            let number = self.numbers[self.rows.point(end as usize, line)];
            let across = ray.x as f64 / ray.y as f64 * height;
            // In the window the difference is least at the end that is farther from the corner.
            let along = (root.real.x + across - f64::from(end)).abs();
            let here = (root.length + norm(across, height)) * (1.0 - SAME);
            number > 0 && self.roots[number as usize].length + along < here
        };
        sooner(window.opening.0, window.rays[1]) || sooner(window.opening.1, window.rays[0])
    }

    /// All windows that are visible from a root, at the border of a row or inside it.
    pub fn look(&mut self, view: &View, rays: Rays, cell: usize) {
        let run = self.rows.run(cell, view.row as usize);
        self.spread(view, rays, run);
        self.queue_fresh();
    }

    /// Adds the windows through which a path leaves a run of a row; the goal where it is visible in the run.
    fn spread(&mut self, view: &View, rays: Rays, run: (usize, usize)) {
        self.fresh.clear();
        if self.goal.cell.1 == view.row as usize && (run.0..run.1).contains(&self.goal.cell.0) {
            self.see_goal(view, rays);
        }
        let root = self.roots[view.root as usize].spot;
        let next = if view.is_up { view.row + 1 } else { view.row - 1 };
        let beyond = View { row: next, ..*view };
        let from = |x: usize| self.plane.lattice(x, beyond.line()).from(root);
        let (mut x, end) = self.reach(&beyond, rays, run);
        loop {
            let first = self.rows.next(x, next as usize, true);
            if first >= end {
                return;
            }
            let last = self.rows.next(first, next as usize, false).min(end);
            let ends = [from(first), from(last)];
            let is_left = |ray: Option<Spot>, end: Spot| ray.is_some_and(|ray| view.side(ray, end) < 0);
            let is_right = |ray: Option<Spot>, end: Spot| ray.is_some_and(|ray| view.side(ray, end) > 0);
            if is_right(rays[1], ends[0]) {
                return;
            }
            if !is_left(rays[0], ends[1]) {
                let low = rays[0].filter(|_| is_left(rays[0], ends[0])).unwrap_or(ends[0]);
                let high = rays[1].filter(|_| is_right(rays[1], ends[1])).unwrap_or(ends[1]);
                let opening = (first as u32, last as u32);
                self.fresh.push(Window { view: beyond, rays: [low, high], opening });
            }
            x = last;
        }
    }

    /// The part of a run next to which rays meet the far line, with one more cell on both sides.
    fn reach(&self, beyond: &View, rays: Rays, run: (usize, usize)) -> (usize, usize) {
        let root = &self.roots[beyond.root as usize].real;
        let at = |ray: Spot| root.x + ray.x as f64 / ray.y as f64 * (beyond.line() as f64 - root.y);
        let low = rays[0].map_or(0.0, |ray| at(ray).floor() - 1.0).max(run.0 as f64);
        let high = rays[1].map_or(f64::INFINITY, |ray| at(ray).ceil() + 1.0).min(run.1 as f64);
        (low as usize, high.max(0.0) as usize)
    }

    fn see_goal(&mut self, view: &View, rays: Rays) {
        let away = self.goal.spot.from(self.roots[view.root as usize].spot);
        let is_seen =
            rays[0].is_none_or(|ray| view.side(ray, away) >= 0) && rays[1].is_none_or(|ray| view.side(ray, away) <= 0);
        if is_seen {
            self.reach_goal(view.root);
        }
    }

    /// The goal is reached from a root that sees it.
    pub fn reach_goal(&mut self, root: u32) {
        let own = &self.roots[root as usize];
        let length = own.length + (self.goal.real - own.real).norm();
        if length < self.best.0 {
            (self.best, self.via) = ((length, root), 0);
        }
    }

    /// By lattice point, the number of its root; zero where it has none.
    pub fn into_numbers(self) -> Vec<u32> {
        self.numbers
    }

    /// The least, or the approximate, length of a path through a window: the key of the queue.
    fn through(&self, window: &Window) -> f64 {
        self.aim.through(self.rows, &self.goal, &self.roots[window.view.root as usize], window)
    }

    fn queue_fresh(&mut self) {
        for place in 0..self.fresh.len() {
            let window = self.fresh[place];
            let least = self.through(&window);
            self.put(least, Step::Window(window));
        }
    }

    fn put(&mut self, least: f64, step: Step) {
        if least >= self.best.0 {
            return;
        }
        let place = self.taken.pop().unwrap_or(self.steps.len() as u32);
        match self.steps.get_mut(place as usize) {
            Some(own) => *own = step,
            None => self.steps.push(step),
        }
        self.queue.push(Reverse((least.to_bits(), place)));
    }

    /// A path from a root turns at a corner, left if `is_left` or right, and arrives in a direction. It is expanded
    /// unless it is longer than another one, or another one of equal length sees as much.
    pub fn turn_at(&mut self, from: u32, (x, y): (usize, usize), is_left: bool, turn: Turn) {
        let before = &self.roots[from as usize];
        let spot = self.plane.lattice(x, y);
        let real = Point2::new(x as f64, y as f64);
        let (length, came) =
            (before.length + norm(real.x - before.real.x, real.y - before.real.y), spot.from(before.spot));
        let point = self.rows.point(x, y);
        if let Some(distances) = self.distances {
            let known = distances.corner(point).filter(|(_, rest)| length + rest < self.best.0);
            if let Some((corner, rest)) = known {
                (self.best, self.via) = ((length + rest, from), corner);
            }
            return;
        }
        if self.numbers[point] == 0 {
            self.numbers[point] = self.roots.len() as u32;
            self.roots.push(Root { spot, real, length, before: from, turns: [None; 2] });
        }
        let number = self.numbers[point];
        let own = &mut self.roots[number as usize];
        if length > own.length * (1.0 + SAME) {
            return;
        }
        if length < own.length * (1.0 - SAME) {
            (own.length, own.before, own.turns) = (length, from, [None; 2]);
        }
        // A path that arrives from farther outside sees more.
        let is_wider = |known: Spot| if is_left { came.cross(known) > 0 } else { came.cross(known) < 0 };
        let known = &mut own.turns[usize::from(!is_left)];
        if known.is_none_or(is_wider) {
            *known = Some(came);
            let turn = Turn { view: View { root: number, length: own.length, ..turn.view }, ..turn };
            let least = length + self.aim.from(self.rows, &self.goal, x, y);
            self.put(least, Step::Turn(turn));
        }
    }
}
