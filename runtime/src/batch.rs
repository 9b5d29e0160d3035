//! Many targets, several at once in the lanes of vector registers. Main type: [`Bundle`].

use crate::angles::{FAR_APART, acute, unfold};
use crate::approach::lead;
use crate::conditions::are_fulfilled;
use crate::effort::{MILD, MOST_STEPS};
use crate::lanes::{Lanes, Mask};
use crate::mechanism::{
    Abreast, Answered, Candidates, Facts, Found, Inputs, Joint, Joints, Mechanism, Parameters, Places, elected,
};
use crate::number::{Guard, Number};
use crate::problem::fit;
use crate::registers::{in_avx2, in_avx512, in_widest};
use crate::singly::{solve_one, solve_one_by_pairs};
use crate::solution::{Error, Pairs, Solution};
use crate::steps::Steps;
use crate::storage::Array;
use crate::tolerances::ACCEPTANCE;
use crate::trigonometry::in_turn;

/// The output format of a solution: angles or pairs.
pub(crate) trait Answer<M: Mechanism>: Clone {
    /// Whether it has joint values instead of cosines and sines.
    const IS_BY_ANGLES: bool;
    /// An empty entry.
    fn none(mechanism: &M) -> Self;
    /// The solution of an ordinary candidate in a lane.
    fn of<const W: usize>(facts: &Facts<'_>, bundle: &Bundle<M, W>, candidate: usize, lane: usize) -> Self;
    /// All solutions of one target.
    fn solve(mechanism: &M, target: &Inputs<M>, list: &mut [Self]) -> Result<usize, Error>;
}

impl<M: Mechanism> Answer<M> for Solution<M> {
    const IS_BY_ANGLES: bool = true;

    fn none(mechanism: &M) -> Self {
        Solution::empty(mechanism)
    }

    #[inline(always)]
    fn of<const W: usize>(facts: &Facts<'_>, bundle: &Bundle<M, W>, candidate: usize, lane: usize) -> Self {
        let joints = bundle.q.as_ref()[candidate].as_ref();
        debug_assert_eq!(joints.len(), facts.joints.len());
        Solution {
            q: Array::by(joints.len(), |i| joints[i].0[lane]),
            residual: bundle.residual.as_ref()[candidate].0[lane],
            relative: bundle.relative.as_ref()[candidate].0[lane],
            branch: bundle.branch.as_ref()[candidate],
            chosen: false,
            free: 0,
            settled: true,
        }
    }

    fn solve(mechanism: &M, target: &Inputs<M>, list: &mut [Self]) -> Result<usize, Error> {
        solve_one(mechanism, target, list, &mut Steps::at_most(MOST_STEPS))
    }
}

impl<M: Mechanism> Answer<M> for Pairs<M> {
    const IS_BY_ANGLES: bool = false;

    fn none(mechanism: &M) -> Self {
        Pairs::empty(mechanism)
    }

    #[inline(always)]
    fn of<const W: usize>(facts: &Facts<'_>, bundle: &Bundle<M, W>, candidate: usize, lane: usize) -> Self {
        let at = bundle.at.as_ref()[candidate].as_ref();
        Pairs {
            joints: Array::by(facts.joints.len(), |i| match facts.joints[i] {
                Joint::Angle([c, s]) => [at[c].0[lane] + 0.0, at[s].0[lane] + 0.0],
                Joint::Length(place) => [at[place].0[lane], 0.0],
            }),
            residual: bundle.residual.as_ref()[candidate].0[lane],
            branch: bundle.branch.as_ref()[candidate],
            free: 0,
            settled: true,
        }
    }

    fn solve(mechanism: &M, target: &Inputs<M>, list: &mut [Self]) -> Result<usize, Error> {
        solve_one_by_pairs(mechanism, target, list)
    }
}

/// Solves a batch in the widest registers that the processor has.
pub(crate) fn solve_widest<M: Mechanism, A: Answer<M>>(
    mechanism: &M,
    targets: &[Inputs<M>],
    out: &mut [A],
    counts: &mut [Result<usize, Error>],
) -> usize {
    if M::IS_SINGLE {
        return solve_singly(mechanism, targets, out, counts);
    }
    if M::INTERPRETED {
        return if mechanism.facts().runs.is_empty() {
            solve_singly(mechanism, targets, out, counts)
        } else {
            in_widest(
                #[inline(always)]
                || solve_by::<M, A, 16>(mechanism, targets, out, counts),
            )
        };
    }
    let by_8 = in_avx512(
        #[inline(always)]
        || solve_by::<M, A, 8>(mechanism, targets, out, counts),
    );
    if let Ok(done) = by_8 {
        return done;
    }
    let by_4 = in_avx2(
        #[inline(always)]
        || solve_by::<M, A, 4>(mechanism, targets, out, counts),
    );
    if let Ok(done) = by_4 {
        return done;
    }
    const WIDTH: usize = if cfg!(target_feature = "avx512f") {
        8
    } else if cfg!(target_feature = "avx2") {
        4
    } else {
        2
    };
    solve_by::<M, A, WIDTH>(mechanism, targets, out, counts)
}

/// Solves the targets of a batch one after the other.
fn solve_singly<M: Mechanism, A: Answer<M>>(
    mechanism: &M,
    targets: &[Inputs<M>],
    out: &mut [A],
    counts: &mut [Result<usize, Error>],
) -> usize {
    let (mut done, mut filled) = (0, 0);
    for (target, count) in targets.iter().zip(counts) {
        let room = &mut out[filled..];
        let found = solve_into(mechanism, target, room);
        if found.is_ok_and(|found| found > room.len()) {
            return done;
        }
        *count = found;
        filled += found.unwrap_or(0);
        done += 1;
    }
    done
}

#[inline(always)]
fn solve_by<M: Mechanism, A: Answer<M>, const W: usize>(
    mechanism: &M,
    targets: &[Inputs<M>],
    out: &mut [A],
    counts: &mut [Result<usize, Error>],
) -> usize {
    let (mut done, mut filled) = (0, 0);
    let facts = mechanism.facts();
    let mut bundle = Bundle::<M, W>::empty(&facts);
    for targets in targets[..targets.len().min(counts.len())].chunks(W) {
        bundle.find(mechanism, &facts, targets, A::IS_BY_ANGLES);
        for (lane, target) in targets.iter().enumerate() {
            let room = &mut out[filled..];
            let is_ordinary = bundle.doubt.0[lane] == 0 && room.len() >= facts.candidates;
            let count =
                if is_ordinary { Ok(bundle.write(&facts, lane, room)) } else { solve_into(mechanism, target, room) };
            if count.is_ok_and(|count| count > room.len()) {
                return done;
            }
            counts[done] = count;
            done += 1;
            filled += count.unwrap_or(0);
        }
    }
    done
}

/// Writes all solutions of one target, or none if there is not enough room.
#[cold]
#[inline(never)]
fn solve_into<M: Mechanism, A: Answer<M>>(mechanism: &M, target: &Inputs<M>, room: &mut [A]) -> Result<usize, Error> {
    let mut list: Answered<M, A> = Array::by(mechanism.facts().capacity, |_| A::none(mechanism));
    let count = A::solve(mechanism, target, list.as_mut())?;
    if count <= room.len() {
        room[..count].clone_from_slice(&list.as_ref()[..count]);
    }
    Ok(count)
}

/// The candidates of several targets. The alignment keeps each row within a cache line.
#[repr(C, align(64))]
pub(crate) struct Bundle<M: Mechanism, const W: usize> {
    at: Abreast<M, Places<M, Lanes<W>>>,
    pub q: Abreast<M, Joints<M, Lanes<W>>>,
    pub residual: Abreast<M, Lanes<W>>,
    relative: Abreast<M, Lanes<W>>,
    /// Which targets do not have this candidate.
    pub dead: Abreast<M, Mask<W>>,
    /// Which targets are not ordinary: a case of a stratum may run, roots are close, a candidate has a large residual, or two candidates are close.
    pub doubt: Mask<W>,
    pub branch: Abreast<M, usize>,
    count: usize,
}

impl<M: Mechanism, const W: usize> Candidates<Lanes<W>, M> for Bundle<M, W> {
    #[inline(always)]
    fn is_usual(&mut self, guard: Guard<Lanes<W>>) -> bool {
        self.doubt = self.doubt | guard.here.inverted();
        true
    }

    #[inline(always)]
    fn is_rare(&mut self, guard: Guard<Lanes<W>>) -> bool {
        self.doubt = self.doubt | guard.here;
        false
    }

    #[inline(always)]
    fn is_due(&mut self, _: usize, guard: Guard<Lanes<W>>) -> bool {
        self.is_rare(guard)
    }

    #[inline(always)]
    fn count(&self) -> usize {
        0
    }

    #[inline(always)]
    fn is_open(&mut self, _: usize, guard: Guard<Lanes<W>>) {
        self.doubt = self.doubt | guard.here;
    }

    /// All targets must agree.
    #[inline(always)]
    fn elect(&mut self, claims: &[Lanes<W>]) -> usize {
        let of = |lane: usize| elected(claims.iter().map(|claim| claim.0[lane]));
        let first = of(0);
        for lane in 1..W {
            self.doubt.0[lane] |= if of(lane) == first { 0 } else { !0 };
        }
        first
    }

    #[inline(always)]
    fn take(&mut self, found: Found<Lanes<W>>, at: &Places<M, Lanes<W>>) {
        let k = self.count % self.branch.as_ref().len();
        self.at.as_mut()[k] = at.clone();
        self.dead.as_mut()[k] = found.close.dead;
        self.branch.as_mut()[k] = found.branch;
        self.doubt = self.doubt | (found.close.close & found.close.dead.inverted());
        self.count = k + 1;
    }
}

impl<M: Mechanism, const W: usize> Bundle<M, W> {
    pub fn empty(facts: &Facts<'_>) -> Self {
        let (none, room) = (Lanes([0.0; W]), facts.candidates);
        Bundle {
            at: Array::by(room, |_| Array::by(facts.places, |_| none)),
            q: Array::by(room, |_| Array::by(facts.joints.len(), |_| none)),
            residual: Array::by(room, |_| none),
            relative: Array::by(room, |_| none),
            dead: Array::by(room, |_| Mask::NONE),
            doubt: Mask::NONE,
            branch: Array::by(room, |_| 0),
            count: 0,
        }
    }

    /// Finds the candidates of 1 to `W` targets, and their angles if `wants_angles`.
    #[inline(always)]
    pub fn find(&mut self, mechanism: &M, facts: &Facts<'_>, targets: &[Inputs<M>], wants_angles: bool) {
        let number = |i: usize, lane: usize| targets[lane.min(targets.len() - 1)].as_ref()[i];
        let mut target: Inputs<M, Lanes<W>> =
            Array::by(facts.inputs, |i| Lanes(core::array::from_fn(|lane| number(i, lane))));
        let fine = are_fulfilled(facts.conditions, target.as_mut());
        let p = mechanism.parameters(&target);
        (self.doubt, self.count) = (fine.inverted(), 0);
        mechanism.walk(&p, self);
        if facts.nearby.is_some() {
            self.lead(mechanism, facts, &p, wants_angles);
        } else {
            self.measure(mechanism, facts, &p);
        }
        self.tell_apart(facts);
        self.find_joints(facts, wants_angles);
    }

    /// Marks targets with a candidate whose residual is too large.
    #[inline(always)]
    fn measure(&mut self, mechanism: &M, facts: &Facts<'_>, p: &Parameters<M, Lanes<W>>) {
        for k in (0..facts.candidates).step_by(facts.twins) {
            let [residual, relative] = fit::<M, W>(mechanism, p, &self.at.as_ref()[k]);
            self.residual.as_mut()[k..k + facts.twins].fill(residual);
            self.relative.as_mut()[k..k + facts.twins].fill(relative);
            let holds = Lanes::of(ACCEPTANCE.rounding).exceeds(relative);
            self.doubt = self.doubt | holds.or_not(self.dead.as_ref()[k]);
        }
    }

    /// Leads the candidates of a nearby mechanism's formulas to solutions by Newton steps, whose sums are written in place of the joint values. Marks targets
    /// where this fails, or where the equations are so ill-conditioned that a second solution may be near.
    #[inline(always)]
    fn lead(&mut self, mechanism: &M, facts: &Facts<'_>, p: &Parameters<M, Lanes<W>>, wants_angles: bool) {
        if !wants_angles || facts.has_extras {
            self.doubt = Mask([!0; W]);
        }
        for k in 0..facts.candidates {
            let none = self.dead.as_ref()[k] | self.doubt;
            if !none.inverted().any() {
                continue;
            }
            let ends = lead(mechanism, p, self.at.as_ref()[k].clone(), none);
            self.q.as_mut()[k] = ends.steps;
            self.residual.as_mut()[k] = ends.residual;
            self.relative.as_mut()[k] = ends.relative;
            let holds = Lanes::of(ACCEPTANCE.rounding).exceeds(ends.relative) & ends.sound.exceeds(Lanes::of(0.0));
            let holds = holds & (ends.missed * MILD).at_most(ends.pivot);
            self.doubt = self.doubt | holds.or_not(self.dead.as_ref()[k]);
        }
    }

    /// Marks targets with two candidates close to each other. One of each group of twins is compared: its twins have equal distances.
    #[inline(always)]
    fn tell_apart(&mut self, facts: &Facts<'_>) {
        let (mut doubt, at, dead) = (self.doubt, self.at.as_ref(), self.dead.as_ref());
        for k in (0..facts.candidates).step_by(facts.twins) {
            for other in (0..k + facts.twins).filter(|&other| other != k) {
                let (a, b) = (at[k].as_ref(), at[other].as_ref());
                let mut near = (dead[k] | dead[other]).inverted();
                for &i in facts.last_first {
                    let Joint::Angle([c, s]) = facts.joints[i] else { continue };
                    near = near & Lanes::of(FAR_APART).exceeds(a[c] * b[c] + a[s] * b[s]).inverted();
                    if !near.any() {
                        break;
                    }
                }
                doubt = doubt | near;
            }
        }
        self.doubt = doubt;
    }

    /// Computes the joint values, angles only if they are wanted. Marks targets where these are not finite.
    #[inline(always)]
    fn find_joints(&mut self, facts: &Facts<'_>, wants_angles: bool) {
        let mut doubt = self.doubt;
        let (at, dead, q) = (self.at.as_ref(), self.dead.as_ref(), self.q.as_mut());
        for (i, joint) in facts.joints.iter().enumerate() {
            let (mut sound, mut size) = (Mask::NONE, Lanes::of(0.0));
            for k in 0..facts.candidates {
                match *joint {
                    Joint::Angle([c, s]) => {
                        let (c, s) = (at[k].as_ref()[c], at[k].as_ref()[s]);
                        if k % facts.runs[i] == 0 {
                            sound = Lanes::of(ACCEPTANCE.rounding).exceeds((c * c + s * s - 1.0).abs());
                            size = if wants_angles { acute(c.abs(), s.abs()) } else { size };
                        }
                        if wants_angles {
                            let angle = unfold(size, c, s);
                            let led = |steps: Lanes<W>| Lanes((angle - steps).0.map(in_turn));
                            let value = &mut q[k].as_mut()[i];
                            *value = if facts.nearby.is_some() { led(*value) } else { angle };
                        }
                    }
                    Joint::Length(place) => {
                        let length = at[k].as_ref()[place];
                        let value = &mut q[k].as_mut()[i];
                        *value = if facts.nearby.is_some() { length - *value } else { length };
                        sound = Lanes::of(f64::MAX).exceeds(length.abs());
                    }
                }
                doubt = doubt | sound.or_not(dead[k]);
            }
        }
        self.doubt = doubt;
    }

    /// Writes the solutions of the target in a lane and returns their number. `room` must hold all candidates.
    #[inline(always)]
    fn write<A: Answer<M>>(&self, facts: &Facts<'_>, lane: usize, room: &mut [A]) -> usize {
        let mut count = 0;
        for k in 0..facts.candidates {
            // Single numbers are read; otherwise the compiler copies a whole vector.
            room[count] = A::of(facts, self, k, lane);
            count += usize::from(self.dead.as_ref()[k].0[lane] == 0);
        }
        count
    }
}
