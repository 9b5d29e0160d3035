//! Curves all along which the equations of a nearby mechanism almost hold. Where its formulas have a self-motion, the mechanism itself may have isolated answers
//! anywhere on what is left of that, and Newton's steps find none of them: along the curve the equations hardly change. A walk holds one joint after the other
//! while the others fit best; what is then missed changes its sign at each answer.
//!
//! As `six_axes/curve.rs`, for any number of joints and equations. (E. L. Allgower and K. Georg, Numerical Continuation Methods, 1990, chapter 3.)

use crate::answers::Answers;
use crate::counters::Phase;
use crate::joints::{beyond, differences, is_in, moved, stepped};
use crate::mechanism::{Equations, Found, Joints, Mechanism};
use crate::problem::Problem;
use crate::starts::{Starts, product};
use crate::tolerances::{ACCEPT, ALONE, NEAR, REGULAR, ROUNDING};

/// The most least-squares steps across the curve.
const ROUNDS: usize = 6;
/// None of them moves a joint by more (rad, or relative to the length scale).
const BOUND: f64 = 0.5;
/// The last one moves no joint by more.
const SETTLED: f64 = 1e-8;
/// Where another joint too hardly changes the equations, by this share of what others do, there is more than a curve.
const RANK: f64 = 1e-3;
/// The shortest, the first and the longest step along the curve (rad, or relative to the length scale).
const PACE: [f64; 3] = [1.5e-3, 2.5e-2, 0.1];
/// The most steps of a walk in one direction.
const PACES: usize = 400;
/// A step leads to no other curve where it ends no farther from the line of the step before than this share of its length.
const STRAIGHT: f64 = 0.5;
/// The square of the least cosine between what two places next to each other miss.
const ALIGNED: f64 = 0.5;
/// How many times as much the square of what is missed may be at one of them as at the other.
const FEWFOLD: f64 = 30.0;
/// Rounds of the false position between two steps.
const NARROWED: usize = 24;
/// The most parabolas that tell where a curve misses least.
const PARABOLAS: usize = 12;
/// Where a parabola's vertex misses more than this share of what the place before missed, the curve may stay away from zero.
const FALLEN: f64 = 0.5;
/// It does where so many do.
const STALLS: usize = 2;
/// A curve that misses no more than this all along is a self-motion: next to one that is exact an answer's tolerance has room for it.
const WHOLE: f64 = 10.0 * ACCEPT;

/// A place on a curve.
struct Place<M: Mechanism> {
    q: Joints<M>,
    /// What is missed there, as shares of the equations' sizes.
    miss: Equations<M>,
    /// The most of it.
    most: f64,
}

/// A walk along one curve.
struct Walk<M: Mechanism> {
    /// How its answers are found: as its start was, but isolated.
    found: Found,
    home: Place<M>,
    /// The place so far that misses least.
    best: Place<M>,
    /// The most that is missed so far.
    most: f64,
}

impl<M: Mechanism> Clone for Place<M> {
    fn clone(&self) -> Self {
        Place { q: self.q.clone(), miss: self.miss.clone(), most: self.most }
    }
}

impl<M: Mechanism> Place<M> {
    /// What is missed in the direction of what another place misses, times the length of that.
    fn along(&self, other: &Place<M>) -> f64 {
        product(self.miss.as_ref(), other.miss.as_ref())
    }

    /// Whether what is missed changes little from another place, or has its sign changed: then nothing between is overlooked.
    fn goes_on(&self, other: &Place<M>) -> bool {
        let [here, there, along] = [self.along(self), other.along(other), self.along(other)];
        let is_aligned = along * along > ALIGNED * here * there;
        let is_flat = (ROUNDING..=WHOLE).contains(&self.most);
        is_aligned && !is_flat && (along < 0.0 || f64::max(here, there) <= FEWFOLD * f64::min(here, there))
    }
}

impl<M: Mechanism> Walk<M> {
    fn pass(&mut self, place: &Place<M>) {
        self.most = f64::max(self.most, place.most);
        if place.most < self.best.most {
            self.best = place.clone();
        }
    }
}

impl<M: Mechanism> Answers<'_, M> {
    /// Remembers a candidate next to which there is a curve, for [a walk](Answers::walk_curves) behind all candidates; whether there is one.
    #[cold]
    pub fn begin_curve(&mut self, found: &Found, q: &Joints<M>) -> bool {
        let _phase = Phase::Curve.begin();
        // Another candidate's numbers that follow from no joint would not fit.
        let place = if self.problem.facts().has_extras { None } else { self.problem.start(q, found.free) };
        let Some((start, held)) = place else { return false };
        let free = if is_in(found.free, held) { found.free } else { 0 };
        if self.starts.as_ref().is_some_and(Starts::is_full) {
            self.walk_curves();
        }
        self.starts.get_or_insert(Starts::NONE).add(Found { free, ..*found }, start.q);
        true
    }

    /// Walks along the curves next to candidates, and keeps the answers on them.
    #[cold]
    pub fn walk_curves(&mut self) {
        let _phase = Phase::Curve.begin();
        let Some(mut starts) = self.starts.take() else { return };
        for index in 0..starts.count {
            if let Some((found, q)) = starts.list[index].take() {
                self.walk_curve(&found, q, &mut starts);
            }
        }
    }

    /// Walks along the curve next to a candidate, both ways if it does not close; of one that misses nothing, a self-motion, a member is kept.
    fn walk_curve(&mut self, found: &Found, q: Joints<M>, starts: &mut Starts<M>) {
        let Some((home, held)) = self.problem.start(&q, found.free) else { return };
        let sides = [-PACE[1], PACE[1]].map(|way| {
            let side = moved::<M>(&self.problem.facts(), &home.q, held, way);
            self.problem.settled(side, held)
        });
        let most = home.most;
        let mut walk = Walk { found: Found { free: 0, ..*found }, best: home.clone(), home, most };
        if walk.home.most <= ALONE {
            self.keep_on_curve(&walk.found, walk.home.q.clone());
        }
        if let [Some(before), Some(behind)] = &sides {
            self.dip(&walk.found, [before, &walk.home, behind]);
        }
        for side in sides.into_iter().flatten() {
            if self.leads_home(&mut walk, side, starts) {
                break;
            }
        }
        if walk.most <= WHOLE {
            self.keep_whole_curve(found, held, walk.best.q);
        }
    }

    /// Walks from home through `at` until the curve closes or ends; whether it closed.
    fn leads_home(&mut self, walk: &mut Walk<M>, mut at: Place<M>, starts: &mut Starts<M>) -> bool {
        let (mut before, mut pace, mut last, mut is_away) = (walk.home.clone(), PACE[1], PACE[1], false);
        self.change(&walk.found, &before, &at);
        for _ in 0..PACES {
            let facts = self.problem.facts();
            starts.pass(&facts, &before.q, &at.q);
            walk.pass(&at);
            let way = facts.farthest(at.q.as_ref(), walk.home.q.as_ref());
            is_away |= way > 3.0 * PACE[2];
            if is_away && way <= PACE[2] {
                self.change(&walk.found, &at, &walk.home);
                return true;
            }
            let Some((next, length)) = self.problem.pace(&before, &at, last, &mut pace) else { return false };
            self.change(&walk.found, &at, &next);
            self.dip(&walk.found, [&before, &at, &next]);
            // Places that miss nothing but rounding are one answer, or several next to each other.
            if (at.most <= ALONE) != (next.most <= ALONE) {
                self.keep_on_curve(&walk.found, if at.most <= ALONE { at.q.clone() } else { next.q.clone() });
            }
            (before, at, last) = (at, next, length);
        }
        false
    }

    /// Keeps the answer between two places where what is missed changes its sign, by false position (the Illinois rule: M. Dowell and P. Jarratt,
    /// BIT 11 (1971) 168-174).
    fn change(&mut self, found: &Found, a: &Place<M>, b: &Place<M>) {
        if a.along(b) > 0.0 || f64::max(a.most, b.most) <= ALONE {
            return;
        }
        let unit = if a.most > b.most { a } else { b };
        let (mut low, mut high) = (a.along(unit), b.along(unit));
        let (mut near, mut far, mut side) = (a.clone(), b.clone(), 0.0);
        for _ in 0..NARROWED {
            let Some(middle) = self.problem.between(&near, &far, low / (low - high)) else { break };
            let (value, is_exact) = (middle.along(unit), middle.most <= ROUNDING);
            if (value <= 0.0) == (low <= 0.0) {
                high = if side < 0.0 { 0.5 * high } else { far.along(unit) };
                (near, low, side) = (middle, value, -1.0);
            } else {
                low = if side > 0.0 { 0.5 * low } else { near.along(unit) };
                (far, high, side) = (middle, value, 1.0);
            }
            if is_exact {
                break;
            }
        }
        self.keep_on_curve(found, if near.most <= far.most { near.q } else { far.q });
    }

    /// Where what is missed falls and rises again with one sign, there may be two answers, or a double one: it is least at the vertex of a parabola.
    fn dip(&mut self, found: &Found, [a, b, c]: [&Place<M>; 3]) {
        let unit = if a.most > c.most { a } else { c };
        let (middle, ends) = (b.along(unit), f64::min(a.along(unit), c.along(unit)));
        let is_zero = b.most <= ALONE;
        if !(f64::min(a.most, c.most) > ALONE && ends > middle && (is_zero || middle > 0.0)) {
            return;
        }
        let (mut least, mut sides, mut stalls) = (b.clone(), [a.clone(), c.clone()], 0);
        for _ in 0..PARABOLAS {
            if f64::max(sides[0].most, sides[1].most) <= ALONE {
                break;
            }
            let Some((side, vertex)) = self.problem.vertex(unit, &least, &sides) else { break };
            if vertex.along(unit) < 0.0 {
                sides.iter().for_each(|side| self.change(found, &vertex, side));
                // Rounding alone may have changed the sign.
                return if least.most <= ALONE {
                    self.keep_on_curve(found, least.q)
                };
            }
            stalls += usize::from(vertex.most > FALLEN * least.most);
            if vertex.most < least.most {
                sides[1 - side] = core::mem::replace(&mut least, vertex);
            } else {
                sides[side] = vertex;
            }
            if least.most > ALONE && stalls >= STALLS {
                break;
            }
        }
        if is_zero || least.most <= FALLEN * b.most {
            self.keep_on_curve(found, least.q);
        }
    }

    /// Keeps what a place on a curve is polished to, if that is an answer that is not known: a member of a self-motion where one joint moves.
    fn keep_on_curve(&mut self, found: &Found, q: Joints<M>) {
        let end = self.problem.polished(q, 0);
        if self.is_listed(&end.0) {
            return;
        }
        let is_singular = self.problem.regularity(&end.0) <= REGULAR;
        let free = if is_singular { self.problem.joint_on_long_self_motion(&end.0) } else { None }.unwrap_or(0);
        self.keep(&Found { free, ..*found }, end);
    }

    /// Keeps a member of a self-motion, of the joints that the candidate freed, or of the one that was held first.
    fn keep_whole_curve(&mut self, found: &Found, held: usize, q: Joints<M>) {
        let free = if found.free == 0 { 1 << held } else { found.free };
        let end = self.problem.polished(q, free);
        self.keep(&Found { free, ..*found }, end);
    }
}

impl<M: Mechanism> Problem<'_, M> {
    /// The place on the curve next to joints, and the joint that is held to come there: a free one, or where none is or others move without it, the one that
    /// moves farthest where the equations hardly change.
    fn start(&mut self, q: &Joints<M>, free: u32) -> Option<(Place<M>, usize)> {
        let of_free = if free == 0 { None } else { self.start_with(q, free.trailing_zeros() as usize) };
        if of_free.is_some() {
            return of_free;
        }
        let triangle = self.triangle(q, 0.0, 0);
        let held = farthest(self.stillest(triangle)?.0.as_ref());
        self.start_with(q, held)
    }

    /// The place next to joints that is come to with one joint held, if it is on a curve, along which all others follow.
    fn start_with(&mut self, q: &Joints<M>, held: usize) -> Option<(Place<M>, usize)> {
        let place = self.settled(q.clone(), held)?;
        (self.regularity_of(&place.q, 1 << held) > RANK).then_some((place, held))
    }

    /// Least-squares steps with one joint held, until they are short.
    fn settled(&mut self, mut q: Joints<M>, held: usize) -> Option<Place<M>> {
        for _ in 0..ROUNDS {
            if self.steps.are_spent() {
                return None;
            }
            let (derivatives, mut miss) = self.shared(&q);
            let step = self.triangle_of(&derivatives, &miss, 0.0, 1 << held).substituted()?;
            let longest = self.facts().longest(step.as_ref());
            if longest > BOUND {
                return None;
            }
            q = stepped::<M>(&self.facts(), &q, &step);
            if longest <= SETTLED {
                for (value, row) in miss.as_mut().iter_mut().zip(derivatives.as_ref()) {
                    let slopes = row.as_ref().iter().zip(step.as_ref());
                    *value = slopes.fold(*value, |rest, (slope, way)| rest - slope * way);
                }
                let most = miss.as_ref().iter().fold(0.0, |most, value| f64::max(most, value.abs()));
                return (most <= NEAR).then_some(Place { q, miss, most });
            }
        }
        None
    }

    /// The place on the curve at a share of the way from `a` to `b`.
    fn between(&mut self, a: &Place<M>, b: &Place<M>, share: f64) -> Option<Place<M>> {
        let facts = self.facts();
        let held = farthest(differences::<M>(&facts, &b.q, &a.q).as_ref());
        self.settled(beyond::<M>(&facts, &b.q, &a.q, -share), held)
    }

    /// A step along the curve from `at`, shorter where it bends, and its length; none where the curve ends.
    fn pace(&mut self, before: &Place<M>, at: &Place<M>, last: f64, pace: &mut f64) -> Option<(Place<M>, f64)> {
        let facts = self.facts();
        let held = farthest(differences::<M>(&facts, &at.q, &before.q).as_ref());
        while *pace >= PACE[0] {
            let ahead = beyond::<M>(&facts, &before.q, &at.q, *pace / last);
            let is_straight = |next: &Place<M>| {
                let is_near = facts.farthest(next.q.as_ref(), ahead.as_ref()) <= STRAIGHT * *pace;
                is_near && (*pace <= PACE[1] || next.goes_on(at))
            };
            if let Some(next) = self.settled(ahead.clone(), held).filter(is_straight) {
                let length = facts.farthest(next.q.as_ref(), at.q.as_ref());
                *pace = f64::min(2.0 * *pace, PACE[2]);
                return Some((next, length));
            }
            *pace *= 0.5;
        }
        None
    }

    /// Where a parabola through what three places miss of a direction is least, the one between missing less than the others, and towards which of these that is.
    fn vertex(&mut self, unit: &Place<M>, least: &Place<M>, sides: &[Place<M>; 2]) -> Option<(usize, Place<M>)> {
        let [low, middle, high] = [&sides[0], least, &sides[1]].map(|place| place.along(unit));
        let lengths = sides.each_ref().map(|side| self.facts().farthest(side.q.as_ref(), least.q.as_ref()));
        let (fall, rise) = ((middle - low) / lengths[0], (high - middle) / lengths[1]);
        let way = 0.5 * (fall * lengths[1] + rise * lengths[0]) / (fall - rise);
        let side = usize::from(way >= 0.0);
        Some((side, self.between(least, &sides[side], way.abs() / lengths[side])?))
    }
}

/// The place of the entry with the greatest magnitude, the first of equals.
fn farthest(way: &[f64]) -> usize {
    let farther = |best: usize, i: usize| if way[i].abs() > way[best].abs() { i } else { best };
    (1..way.len()).fold(0, farther)
}
