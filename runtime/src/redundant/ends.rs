//! End points of arcs: solutions where a joint is at a limit ([`Ends`]).

use super::arm::{Given, MOST_JOINTS, Members, Q, Redundant, Target};
use super::elimination::Rows;
use super::model::Model;
use super::step::{Piece, Point, is_on};
use crate::solution::Error;
use crate::tolerances::{ACCEPTANCE, MERGING, PIVOTS};

/// Maximal number of end points of a target.
pub(super) const MOST_ENDS: usize = 256;

/// A solution within limits that has a joint at a limit.
#[derive(Clone, Copy)]
pub(super) struct End {
    /// The point with the oriented direction.
    pub at: Point,
    /// The joints that are at their lower and at their upper limits, as bits.
    pub sides: [u32; 2],
    /// The sign of the direction that leads along the curve within limits; 0 where none does.
    pub inward: f64,
    /// Joints that remain at their limits along the curve, as bits.
    pub tied: u32,
    /// Whether the equations are singular here: curves may cross, and the direction is not certain.
    pub is_singular: bool,
    /// The number of the end point at the other end of the arc. [`FREE`] while there is none.
    pub partner: usize,
    /// Whether the arc was traced from here, its length, and whether something about it was not decided.
    pub is_start: bool,
    pub length: f64,
    pub is_unsure: bool,
    /// Steps are divided by four so many times.
    pub level: u32,
}

/// The partner of an end point that belongs to no arc.
pub(super) const FREE: usize = usize::MAX;

/// The end points of a target.
pub(super) struct Ends {
    pub list: [End; MOST_ENDS],
    pub count: usize,
    /// Whether something was not decided, or there was no room.
    pub is_unsure: bool,
    /// Solutions on curves along which a joint remains at its limit, or that only touch a limit, with the joints that remain.
    pub touching: [(Q, u32); MOST_TOUCHING],
    pub touches: usize,
    /// Joints beyond limits of the solution that exceeds them least, and by how much; for reasons.
    pub beyond: Beyond,
}

/// Maximal number of solutions on curves along which a joint remains at its limit.
pub(super) const MOST_TOUCHING: usize = 32;

/// The solution that exceeds limits least.
#[derive(Clone, Copy)]
pub(super) struct Beyond {
    pub joints: u32,
    pub excess: f64,
    pub is_reachable: bool,
}

impl Beyond {
    pub const NONE: Beyond = Beyond { joints: 0, excess: f64::INFINITY, is_reachable: false };

    /// Compares with another solution, whose angles are lifted.
    pub fn pass(&mut self, model: &Model<'_>, x: &Q, joints: u32) {
        let mut excess = 0.0;
        for i in 0..model.count {
            if joints & 1 << i != 0 {
                let [low, high] = model.limits[i];
                excess += f64::max(low - x[i], x[i] - high);
            }
        }
        self.is_reachable = true;
        if excess < self.excess {
            self.excess = excess;
            self.joints = joints;
        }
    }
}

const NONE: End = End {
    at: Point::NONE,
    sides: [0; 2],
    inward: 0.0,
    tied: 0,
    is_singular: false,
    partner: FREE,
    is_start: false,
    length: 0.0,
    is_unsure: false,
    level: 0,
};

impl Ends {
    pub const NONE: Ends = Ends {
        list: [NONE; MOST_ENDS],
        count: 0,
        is_unsure: false,
        touching: [([0.0; MOST_JOINTS], 0); MOST_TOUCHING],
        touches: 0,
        beyond: Beyond::NONE,
    };

    /// Solves all problems with a joint at a limit.
    pub fn find(&mut self, robot: &dyn Redundant, model: &Model<'_>, target: &Target) -> Result<(), Error> {
        let mut members = Members::NONE;
        for joint in 0..model.count {
            if model.turns[joint] || model.arm.given[joint] != Given::Solved {
                continue;
            }
            for side in 0..2 {
                let limit = model.limits[joint][side];
                if !limit.is_finite() || side == 1 && limit == model.limits[joint][0] {
                    continue;
                }
                members.clear();
                robot.solve_given(target, joint, limit * model.units[joint], &mut members)?;
                self.add_all(model, &members, joint, limit);
            }
        }
        self.classify(model);
        Ok(())
    }

    fn add_all(&mut self, model: &Model<'_>, members: &Members, joint: usize, limit: f64) {
        self.is_unsure |= members.is_short();
        for member in members.as_slice() {
            self.is_unsure |= !member.settled;
            let mut x = model.scaled(&member.q);
            x[joint] = limit;
            let beyond = model.lift(&mut x);
            self.beyond.pass(model, &x, beyond);
            if beyond == 0 && member.free != 0 {
                // Along a curve through this solution, the joint remains at its limit.
                self.touch(model, &x, tied_at(model, &x));
            } else if beyond == 0 {
                self.add(model, &x);
            }
        }
    }

    /// Adds a solution within limits, unless it is known from another joint.
    pub fn add(&mut self, model: &Model<'_>, x: &Q) -> Option<usize> {
        let mut sides = [0; 2];
        for i in 0..model.count {
            for side in 0..2 {
                let is_at = !model.turns[i] && (x[i] - model.limits[i][side]).abs() <= MERGING.joints;
                if is_at && model.is_limited(i) {
                    sides[side] |= 1 << i;
                }
            }
        }
        for k in 0..self.count {
            let end = &mut self.list[k];
            if model.are_close(&end.at.x, x, MERGING.joints) {
                end.sides[0] |= sides[0];
                end.sides[1] |= sides[1];
                return Some(k);
            }
        }
        if self.count == MOST_ENDS {
            self.is_unsure = true;
            return None;
        }
        self.list[self.count] = End { at: Point { x: *x, ..Point::NONE }, sides, ..NONE };
        self.count += 1;
        Some(self.count - 1)
    }

    /// Stores a solution with joints at limits from which the curve leads within limits in both directions.
    pub fn touch(&mut self, model: &Model<'_>, x: &Q, tied: u32) {
        for k in 0..self.touches {
            if model.are_close(&self.touching[k].0, x, MERGING.joints) {
                return;
            }
        }
        if self.touches == MOST_TOUCHING {
            self.is_unsure = true;
            return;
        }
        self.touching[self.touches] = (*x, tied);
        self.touches += 1;
    }

    /// Removes the solutions that touch limits on a piece of a curve.
    pub fn pass(&mut self, model: &Model<'_>, piece: &Piece) {
        let mut k = 0;
        while k < self.touches {
            if is_on(model, piece, &self.touching[k].0) {
                self.touches -= 1;
                self.touching[k] = self.touching[self.touches];
            } else {
                k += 1;
            }
        }
    }

    /// Decides by derivatives in which direction the curve leads within limits. Solutions where both do are no end points.
    pub fn classify(&mut self, model: &Model<'_>) {
        let mut kept = 0;
        for k in 0..self.count {
            let mut end = self.list[k];
            let (place, bend) = model.bent(&end.at.x);
            let is_solution = largest(&place.values) <= 10.0 * MERGING.joints;
            if !is_solution {
                self.is_unsure = true;
                continue;
            }
            end.at = Point::of(&place, 1.0, &bend);
            let (forward, backward, tied) = open(model, &end);
            end.tied = tied;
            end.is_singular = place.linear.pivot <= PIVOTS.regular;
            if forward && backward {
                self.touch(model, &end.at.x, tied);
                continue;
            }
            end.inward = if forward {
                1.0
            } else if backward {
                -1.0
            } else {
                0.0
            };
            self.list[kept] = end;
            kept += 1;
        }
        self.count = kept;
    }
}

/// Whether the curve leads within limits along the oriented direction and against it, and the joints that remain at their limits.
fn open(model: &Model<'_>, end: &End) -> (bool, bool, u32) {
    let (mut forward, mut backward, mut tied) = (true, true, 0);
    for i in 0..model.count {
        for side in 0..2 {
            if end.sides[side] & 1 << i == 0 {
                continue;
            }
            let inward = if side == 0 { 1.0 } else { -1.0 };
            let (rate, bend) = (inward * end.at.t[i], inward * end.at.bend[i]);
            if rate.abs() <= PIVOTS.regular && bend.abs() <= PIVOTS.regular {
                tied |= 1 << i;
            } else if bend > 0.0 && rate * rate <= 2.0 * bend * ACCEPTANCE.input {
                // Touches the limit from within, or exceeds it by less than the tolerance.
            } else if bend < 0.0 && rate.abs() <= PIVOTS.regular {
                forward = false;
                backward = false;
            } else {
                forward &= rate > 0.0;
                backward &= rate < 0.0;
            }
        }
    }
    (forward, backward, tied)
}

/// The joints that remain at their limits along the curve through a point.
pub(super) fn tied_at(model: &Model<'_>, x: &Q) -> u32 {
    let mut at = 0;
    for i in 0..model.count {
        let [low, high] = model.limits[i];
        let distance = f64::min((x[i] - low).abs(), (x[i] - high).abs());
        if model.is_limited(i) && distance <= MERGING.joints {
            at |= 1 << i;
        }
    }
    if at == 0 {
        return 0;
    }
    let (place, bend) = model.bent(x);
    let mut tied = 0;
    for i in 0..model.count {
        if at & 1 << i != 0 && place.linear.tangent[i].abs() <= PIVOTS.regular && bend[i].abs() <= PIVOTS.regular {
            tied |= 1 << i;
        }
    }
    tied
}

/// The largest magnitude of an equation's value.
fn largest(values: &Rows) -> f64 {
    let mut largest = 0.0;
    for value in values {
        largest = f64::max(largest, value.abs());
    }
    largest
}
