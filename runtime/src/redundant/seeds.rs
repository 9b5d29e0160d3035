//! Solutions for values of some joints: a grid, the sections of the arm, and one value of each unlimited joint. Those that are on no traced curve lead to closed
//! curves ([`Seeds`]).

use core::f64::consts::{PI, TAU};

use super::approach::{STARTS, approach};
use super::arm::{Given, MOST_JOINTS, MOST_SECTIONS, Members, Q, Redundant, Section, Target};
use super::crossing::extrema;
use super::ends::{Ends, tied_at};
use super::model::Model;
use super::step::{ON, Piece};
use crate::arithmetic::Arithmetic;
use crate::solution::Error;
use crate::tolerances::{ACCEPTANCE, MERGING};

/// Maximal number of solutions that are waiting for a curve.
pub(super) const MOST_SEEDS: usize = 384;
/// The number of values of the grid at first.
const LEVELS: usize = 16;
/// Between two values, so many times the middle is added where the number of solutions changes, or where solutions are close to each other.
const HALVINGS: usize = 2;
/// Maximal number of values, with those of solutions by Newton's method.
const MOST_GROUPS: usize = LEVELS + (LEVELS - 1) * HALVINGS + MOST_SECTIONS + MOST_JOINTS + STARTS;
/// A value that each closed curve passes along which an unlimited joint makes a whole turn.
const ANY_VALUE: f64 = 1.0;
/// Solutions for one value are close when no joint differs by more than this (rad, or relative to the characteristic length).
const CLOSE: f64 = 0.1;
/// Steps of Newton's method for a root of a cubic.
const ROOT_STEPS: usize = 4;

/// Solutions of the list that have one value of a joint: from `first` on, so many.
#[derive(Clone, Copy)]
struct Group {
    joint: usize,
    value: f64,
    first: usize,
    count: usize,
}

/// Solutions within limits that are on no known curve.
pub(super) struct Seeds {
    list: [Q; MOST_SEEDS],
    /// The number of solutions that were added; some of them are on known curves by now.
    added: usize,
    groups: [Group; MOST_GROUPS],
    values: usize,
    pub is_unsure: bool,
    /// The number of values of the grid for which the problem itself has a self-motion, and one of their solutions within limits.
    pub surfaces: usize,
    pub surface: Option<Q>,
    members: Members,
}

/// What is compared between neighbouring values.
#[derive(Clone, Copy, PartialEq)]
struct Level {
    value: f64,
    solutions: usize,
    has_close: bool,
}

/// The range of a joint's values that are tried.
pub(super) fn range(model: &Model<'_>, joint: usize) -> [f64; 2] {
    let [low, high] = model.limits[joint];
    if model.turns[joint] {
        let low = if low.is_finite() { low } else { -PI };
        return [low, low + TAU];
    }
    [f64::max(low, -10.0), f64::min(high, 10.0)]
}

impl Seeds {
    pub const NONE: Seeds = Seeds {
        list: [[0.0; MOST_JOINTS]; MOST_SEEDS],
        added: 0,
        groups: [Group { joint: 0, value: 0.0, first: 0, count: 0 }; MOST_GROUPS],
        values: 0,
        is_unsure: false,
        surfaces: 0,
        surface: None,
        members: Members::NONE,
    };

    /// Solves the problems with the values of joints.
    pub fn find(
        &mut self,
        robot: &dyn Redundant,
        model: &Model<'_>,
        target: &Target,
        ends: &mut Ends,
    ) -> Result<(), Error> {
        for section in &model.arm.sections[..model.arm.section_count] {
            let Section { joint, value } = *section;
            let value = value / model.units[joint];
            if model.turns[joint] || value >= model.limits[joint][0] && value <= model.limits[joint][1] {
                self.solve(robot, model, target, Section { joint, value }, ends)?;
            }
        }
        for joint in 0..model.count {
            if model.turns[joint] && model.arm.given[joint] == Given::Solved && joint != model.arm.grid {
                self.solve(robot, model, target, Section { joint, value: ANY_VALUE }, ends)?;
            }
        }
        let joint = model.arm.grid;
        let [low, high] = range(model, joint);
        let width = (high - low) / LEVELS as f64;
        let mut before: Option<Level> = None;
        for k in 0..LEVELS {
            let level =
                self.solve(robot, model, target, Section { joint, value: low + (k as f64 + 0.5) * width }, ends)?;
            if let Some(before) = before {
                self.between(robot, model, target, [before, level], ends)?;
            }
            before = Some(level);
        }
        Ok(())
    }

    /// Searches solutions by Newton's method, where there is none for any value of a joint.
    #[cold]
    pub fn approach(&mut self, model: &Model<'_>, ends: &mut Ends) {
        for number in 0..STARTS {
            let Some(mut x) = approach(model, number) else { continue };
            let beyond = model.lift(&mut x);
            ends.beyond.pass(model, &x, beyond);
            if beyond == 0 {
                self.list[self.added] = x;
                let joint = model.arm.grid;
                self.groups[self.values] = Group { joint, value: x[joint], first: self.added, count: 1 };
                self.added += 1;
                self.values += 1;
            }
        }
    }

    /// Adds values between two neighbouring ones, where solutions appear or vanish.
    fn between(
        &mut self,
        robot: &dyn Redundant,
        model: &Model<'_>,
        target: &Target,
        [mut low, mut high]: [Level; 2],
        ends: &mut Ends,
    ) -> Result<(), Error> {
        for _ in 0..HALVINGS {
            if self.added + 2 * Members::ROOM > MOST_SEEDS {
                return Ok(());
            }
            let differ = low.solutions != high.solutions;
            if !(differ || low.has_close && high.has_close) {
                return Ok(());
            }
            let section = Section { joint: model.arm.grid, value: 0.5 * (low.value + high.value) };
            let middle = self.solve(robot, model, target, section, ends)?;
            if middle.solutions == low.solutions {
                low = middle;
            } else {
                high = middle;
            }
        }
        Ok(())
    }

    /// Adds the solutions with a joint at a scaled value.
    fn solve(
        &mut self,
        robot: &dyn Redundant,
        model: &Model<'_>,
        target: &Target,
        Section { joint, value }: Section,
        ends: &mut Ends,
    ) -> Result<Level, Error> {
        let is_grid = joint == model.arm.grid;
        self.members.clear();
        robot.solve_given(target, joint, value * model.units[joint], &mut self.members)?;
        self.is_unsure |= self.members.is_short();
        let first = self.added;
        let (mut is_surface, mut solutions) = (false, 0);
        for k in 0..self.members.as_slice().len() {
            let member = self.members.as_slice()[k];
            self.is_unsure |= !member.settled;
            solutions += 1;
            let mut x = model.scaled(&member.q);
            x[joint] = value;
            let beyond = model.lift(&mut x);
            ends.beyond.pass(model, &x, beyond);
            is_surface |= is_grid && member.free != 0;
            if beyond != 0 {
                continue;
            }
            if member.free != 0 && is_grid {
                self.surface = Some(x);
            } else if member.free != 0 {
                // Along a curve through this solution, the joint keeps its value.
                ends.touch(model, &x, tied_at(model, &x));
            } else if self.added < MOST_SEEDS {
                self.list[self.added] = x;
                self.added += 1;
            } else {
                self.is_unsure = true;
            }
        }
        self.groups[self.values] = Group { joint, value, first, count: self.added - first };
        self.values += 1;
        self.surfaces += usize::from(is_surface);
        Ok(Level { value, solutions, has_close: self.has_close(model, first) })
    }

    /// Whether two of the solutions from this one on are close to each other.
    fn has_close(&self, model: &Model<'_>, first: usize) -> bool {
        for i in first..self.added {
            for j in first..i {
                if model.are_close(&self.list[i], &self.list[j], CLOSE) {
                    return true;
                }
            }
        }
        false
    }

    /// Removes the solutions on a piece of a curve.
    pub fn pass(&mut self, model: &Model<'_>, piece: &Piece) {
        for number in 0..self.values {
            let Group { joint, mut value, count, .. } = self.groups[number];
            if count == 0 {
                continue;
            }
            let [least, greatest] = bounds(piece, joint);
            if model.turns[joint] {
                value += TAU * Arithmetic::ceil((least - value) / TAU);
            }
            if value >= least && value <= greatest {
                self.pass_group(model, piece, value, number);
            }
        }
    }

    /// Removes the solutions of a group on a piece of a curve, which may pass the value several times.
    fn pass_group(&mut self, model: &Model<'_>, piece: &Piece, value: f64, number: usize) {
        let Group { joint, first, mut count, .. } = self.groups[number];
        let [c, b, a] = piece.cubic(joint);
        let mut low = 0.0;
        for high in extrema(a, b, c) {
            if high <= low {
                continue;
            }
            let x = on(piece, joint, value, [low, high]);
            let mut k = first;
            while k < first + count {
                if model.are_close(&x, &self.list[k], ON * piece.length + MERGING.joints) {
                    count -= 1;
                    self.list[k] = self.list[first + count];
                } else {
                    k += 1;
                }
            }
            low = high;
        }
        self.groups[number].count = count;
    }

    /// Takes a solution that is on no known curve from the list.
    pub fn take(&mut self) -> Option<Q> {
        while self.values > 0 {
            let group = &mut self.groups[self.values - 1];
            if group.count > 0 {
                group.count -= 1;
                return Some(self.list[group.first + group.count]);
            }
            self.values -= 1;
        }
        None
    }

    /// The solutions that are on no known curve.
    pub fn all(&self) -> impl Iterator<Item = &Q> {
        self.groups[..self.values].iter().flat_map(|group| &self.list[group.first..group.first + group.count])
    }
}

/// Bounds of a joint's values on a piece: those of the control points of its cubic.
fn bounds(piece: &Piece, joint: usize) -> [f64; 2] {
    let third = piece.length / 3.0;
    let (first, last) = (piece.from.x[joint], piece.to.x[joint]);
    let (second, third) = (first + third * piece.from.t[joint], last - third * piece.to.t[joint]);
    let (low, high) = (f64::min(f64::min(second, third), last), f64::max(f64::max(second, third), last));
    [f64::min(first, low) - ACCEPTANCE.input, f64::max(first, high) + ACCEPTANCE.input]
}

/// The point of a part of the piece, along which a joint increases or decreases, where the joint has a certain value; else an end of the part.
fn on(piece: &Piece, joint: usize, value: f64, [low, high]: [f64; 2]) -> Q {
    let [c, b, a] = piece.cubic(joint);
    let at = |share: f64| piece.from.x[joint] + share * (c + share * (b + share * a)) - value;
    let (first, last) = (at(low), at(high));
    let within = |share: f64| f64::min(f64::max(share, low), high);
    let mut share =
        if first == last { 0.5 * (low + high) } else { within(low - first * (high - low) / (last - first)) };
    for _ in 0..ROOT_STEPS {
        let slope = c + share * (2.0 * b + share * 3.0 * a);
        if slope != 0.0 {
            share = within(share - at(share) / slope);
        }
    }
    piece.at(share)
}
