//! All arcs of solutions within limits ([`arcs`]).

use super::arm::{Arm, Given, Limits, MOST_JOINTS, Q, Redundant, Target};
use super::ends::{Ends, FREE, tied_at};
use super::model::Model;
use super::seeds::Seeds;
use super::step::Point;
use super::trace::{Start, Stop, trace};
use crate::solution::Error;
use crate::tolerances::PIVOTS;

/// Where two traces lead to one end point, both are repeated with steps of a quarter of the length, at most so many times.
const LEVELS: u32 = 3;

/// An end of an arc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct End {
    /// Joint values.
    pub q: Q,
    /// The joint that is at its limit; the first one if there are several. `None` for closed curves, and where a curve could not be followed.
    pub joint: Option<usize>,
    /// Whether it is at its upper limit.
    pub is_upper: bool,
}

/// A maximal connected curve of solutions within limits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    /// Where it begins. For a closed curve, some point on it.
    pub start: End,
    /// Where it ends.
    pub end: End,
    /// The length in the space of joint values: rad, where lengths are relative to [`Arm::length`].
    pub length: f64,
    /// Whether the curve is closed and reaches no limit.
    pub is_closed: bool,
    /// Whether something was not decided: the curve passes a point where it crosses another one, or it could not be followed to a known end point.
    pub is_unsure: bool,
    /// How it was traced, so that it can be traced again.
    pub(super) side: f64,
    pub(super) tied: u32,
    pub(super) level: u32,
    pub(super) is_frozen: bool,
}

impl Arc {
    /// An arc of length zero, with which a buffer is filled.
    pub const NONE: Arc = Arc {
        start: End { q: [0.0; MOST_JOINTS], joint: None, is_upper: false },
        end: End { q: [0.0; MOST_JOINTS], joint: None, is_upper: false },
        length: 0.0,
        is_closed: false,
        is_unsure: false,
        side: 1.0,
        tied: 0,
        level: 0,
        is_frozen: false,
    };
}

/// The result of [`arcs`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Outcome {
    /// The number of arcs. It is greater than the buffer's length when there was no room for all.
    pub count: usize,
    /// The number of solutions within limits with a joint at a limit, where an arc ends.
    pub ends: usize,
    /// Whether arcs may be missing, or some arc is unsure.
    pub is_unsure: bool,
    /// The number of closed curves.
    pub closed: usize,
    /// Whether closed curves that reach no limit were searched by a grid and sections only. A closed curve that is narrower than the grid
    /// may then be missing. This holds for all targets at present, except where solutions are a surface.
    pub is_grid_only: bool,
    /// Whether the solutions are a surface. The only arc is then one solution within limits, if one was found.
    pub is_surface: bool,
    /// Whether there are solutions, within limits or not.
    pub is_reachable: bool,
    /// The joints that are beyond their limits in the solution that exceeds limits least, as bits. 0 where there are arcs.
    pub beyond: u32,
}

/// Arcs in the caller's buffer.
struct Output<'o> {
    out: &'o mut [Arc],
    count: usize,
    is_unsure: bool,
}

impl Output<'_> {
    fn push(&mut self, arc: Arc) {
        self.is_unsure |= arc.is_unsure;
        if self.count < self.out.len() {
            self.out[self.count] = arc;
        } else {
            self.is_unsure = true;
        }
        self.count += 1;
    }
}

/// All maximal arcs of solutions within limits. Angles are moved into their limits by whole turns. A revolute joint whose range is at least one turn ends no arc.
///
/// The end points are all solutions with a joint at a limit, as far as the joints have solvers ([`Given`]), at most 256. Curves join them in pairs,
/// numerically: where two curves lead to one end point, the arcs are unsure. Closed curves that reach no limit are found by a grid.
///
/// # Errors
///
/// Those of [`Redundant::solve_given`], and [`Error::Limits`].
pub fn arcs(robot: &dyn Redundant, target: &Target, limits: &Limits, out: &mut [Arc]) -> Result<Outcome, Error> {
    let arm = robot.arm();
    let mut model = Model::new(arm, target, limits)?;
    let mut ends = Ends::NONE;
    let mut seeds = Seeds::NONE;
    let mut output = Output { out, count: 0, is_unsure: false };
    ends.find(robot, &model, target)?;
    seeds.find(robot, &model, target, &mut ends)?;
    if !ends.beyond.is_reachable {
        seeds.approach(&model, &mut ends);
    }
    if seeds.surfaces > 1 {
        return Ok(surface(&model, &seeds, &ends, &mut output));
    }
    freeze(&mut model, &mut ends, &seeds);
    pair(&model, &mut ends, &mut seeds);
    let count = ends.count;
    for k in 0..count {
        output_arc(&model, &ends, k, &mut output);
    }
    let closed = search_closed(&model, &mut ends, &mut seeds, &mut output);
    Ok(Outcome {
        count: output.count,
        ends: ends.count,
        is_unsure: output.is_unsure || ends.is_unsure || seeds.is_unsure,
        closed,
        is_grid_only: true,
        is_surface: false,
        is_reachable: ends.beyond.is_reachable,
        beyond: if output.count == 0 { ends.beyond.joints } else { 0 },
    })
}

/// The outcome where solutions are surfaces.
#[cold]
fn surface(model: &Model<'_>, seeds: &Seeds, ends: &Ends, output: &mut Output<'_>) -> Outcome {
    let mut member = seeds.surface;
    if member.is_none() {
        member = seeds.all().next().copied();
    }
    if member.is_none() && ends.count > 0 {
        member = Some(ends.list[0].at.x);
    }
    if let Some(x) = member {
        let end = End { q: model.unscaled(&x), joint: None, is_upper: false };
        output.push(Arc { start: end, end, is_unsure: true, ..Arc::NONE });
    }
    Outcome {
        count: output.count,
        ends: 0,
        is_unsure: true,
        closed: 0,
        is_grid_only: false,
        is_surface: true,
        is_reachable: true,
        beyond: if output.count == 0 { ends.beyond.joints } else { 0 },
    }
}

/// The joint that is constant on every curve, which the arm has at most once.
pub(super) fn constant(arm: &Arm) -> Option<usize> {
    (0..arm.count).find(|&joint| arm.given[joint] == Given::Constant)
}

/// Where the equations are singular at all solutions, the joint that is constant is left out, as with a straight elbow. Rounding of the target bends a straight
/// elbow, so that all equations whose solutions are not isolated count as singular.
fn freeze(model: &mut Model<'_>, ends: &mut Ends, seeds: &Seeds) {
    let Some(joint) = constant(model.arm) else { return };
    if ends.count + ends.touches + seeds.all().count() == 0 {
        return;
    }
    let is_regular = |x: &Q| model.place(x).linear.pivot > PIVOTS.isolated;
    let is_any_regular = ends.list[..ends.count].iter().any(|end| is_regular(&end.at.x))
        || ends.touching[..ends.touches].iter().any(|(x, _)| is_regular(x))
        || seeds.all().any(is_regular);
    if is_any_regular {
        return;
    }
    model.frozen = Some(joint);
    // Of singular equations, no direction is known: an end point may have been taken for a solution that touches a limit.
    let (touching, touches) = (ends.touching, ends.touches);
    ends.touches = 0;
    for (x, _) in &touching[..touches] {
        ends.add(model, x);
    }
    ends.classify(model);
}

/// Traces from each end point to its partner.
fn pair(model: &Model<'_>, ends: &mut Ends, seeds: &mut Seeds) {
    for is_singular in [false, true] {
        let mut k = 0;
        while k < ends.count {
            let end = &ends.list[k];
            if end.partner != FREE || end.inward == 0.0 || end.is_singular != is_singular {
                k += 1;
                continue;
            }
            let start = Start { at: end.at, side: end.inward, tied: end.tied, level: end.level, is_inside: false };
            let start = Start { at: turned(&start.at, start.side), ..start };
            let traced = trace(model, &start, ends, seeds);
            let partner = match traced.stop {
                Stop::End(partner) => partner,
                Stop::Closed => FREE,
                Stop::Lost(x) => lost(ends, model, &x),
            };
            if partner == FREE || partner == k {
                join(ends, k, k, traced.length, true);
            } else if ends.list[partner].partner == FREE {
                join(ends, k, partner, traced.length, traced.is_unsure);
            } else {
                let other = ends.list[partner].partner;
                let level = ends.list[k].level;
                if level == LEVELS {
                    // Not decided: this arc ends at an end point of another one.
                    ends.list[partner].is_unsure = true;
                    ends.list[other].is_unsure = true;
                    let end = &mut ends.list[k];
                    (end.partner, end.is_start, end.length, end.is_unsure) = (partner, true, traced.length, true);
                } else {
                    for number in [k, partner, other] {
                        let end = &mut ends.list[number];
                        (end.partner, end.is_start, end.level) = (FREE, false, level + 1);
                    }
                    k = usize::min(k, usize::min(partner, other));
                }
            }
        }
    }
}

/// The point with the direction of travel instead of the oriented one.
fn turned(at: &Point, side: f64) -> Point {
    let mut t = at.t;
    for value in &mut t {
        *value *= side;
    }
    Point { t, ..*at }
}

/// An end point where a curve was lost.
#[cold]
fn lost(ends: &mut Ends, model: &Model<'_>, x: &Q) -> usize {
    ends.is_unsure = true;
    ends.add(model, x).unwrap_or(FREE)
}

/// Makes an arc of two end points.
fn join(ends: &mut Ends, start: usize, end: usize, length: f64, is_unsure: bool) {
    ends.list[end].partner = start;
    ends.list[end].is_start = false;
    let first = &mut ends.list[start];
    (first.partner, first.is_start, first.length) = (end, true, length);
    first.is_unsure |= is_unsure;
}

/// Adds the arc that was traced from an end point, or an end point from which no direction leads within limits.
fn output_arc(model: &Model<'_>, ends: &Ends, k: usize, output: &mut Output<'_>) {
    let start = &ends.list[k];
    let is_isolated = start.partner == FREE;
    if !start.is_start && !is_isolated {
        return;
    }
    let partner = if is_isolated { k } else { start.partner };
    output.push(Arc {
        start: end_of(model, ends, k),
        end: end_of(model, ends, partner),
        length: start.length,
        is_unsure: start.is_unsure || ends.list[partner].is_unsure || start.is_singular,
        side: start.inward,
        tied: start.tied,
        level: start.level,
        is_frozen: model.frozen.is_some(),
        ..Arc::NONE
    });
}

fn end_of(model: &Model<'_>, ends: &Ends, k: usize) -> End {
    let end = &ends.list[k];
    let mut joint = None;
    for i in (0..model.count).rev() {
        if (end.sides[0] | end.sides[1]) & 1 << i != 0 {
            joint = Some(i);
        }
    }
    let is_upper = joint.is_some_and(|i| end.sides[1] & 1 << i != 0);
    End { q: model.unscaled(&end.at.x), joint, is_upper }
}

/// Traces curves from the solutions that are on no arc. Returns the number of closed ones.
fn search_closed(model: &Model<'_>, ends: &mut Ends, seeds: &mut Seeds, output: &mut Output<'_>) -> usize {
    let mut closed = 0;
    while ends.touches > 0 {
        ends.touches -= 1;
        let (x, tied) = ends.touching[ends.touches];
        closed += usize::from(search_from(model, &x, tied, ends, seeds, output));
    }
    while let Some(x) = seeds.take() {
        closed += usize::from(search_from(model, &x, tied_at(model, &x), ends, seeds, output));
    }
    closed
}

/// Traces the curve through a solution. If it leads to an end point of a known arc, the solution is on that arc. Returns whether it is closed and not known.
fn search_from(
    model: &Model<'_>,
    x: &Q,
    tied: u32,
    ends: &mut Ends,
    seeds: &mut Seeds,
    output: &mut Output<'_>,
) -> bool {
    let (place, bend) = model.bent(x);
    let start = Start { at: Point::of(&place, 1.0, &bend), side: 1.0, tied, level: 0, is_inside: true };
    let count = ends.count;
    let traced = trace(model, &start, ends, seeds);
    let point = End { q: model.unscaled(x), joint: None, is_upper: false };
    let arc =
        Arc { start: point, end: point, length: traced.length, tied, is_frozen: model.frozen.is_some(), ..Arc::NONE };
    match traced.stop {
        Stop::Closed => {
            // Of singular equations, no direction is known: the solutions may be a surface.
            let is_unsure = traced.is_unsure || place.linear.pivot <= PIVOTS.regular;
            output.push(Arc { is_closed: true, is_unsure, ..arc });
            true
        }
        Stop::End(end) if end >= count => {
            // The limit of a joint without a solver.
            pair(model, ends, seeds);
            for k in count..ends.count {
                output_arc(model, ends, k, output);
            }
            false
        }
        Stop::End(_) => false,
        Stop::Lost(_) => {
            output.is_unsure = true;
            if output.count == 0 {
                output.push(Arc { is_unsure: true, length: 0.0, ..arc });
            }
            false
        }
    }
}
