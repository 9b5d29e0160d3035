//! Newton steps from a candidate of a nearby mechanism's formulas to the solution next to it: [`Problem::approached`], and [`Approaches`] for several candidates.

use crate::counters::{Event, Phase};
use crate::effort::{APPROACHES, CHORD, DOUBTFUL, INVERSIONS, MILD, STEEP, TURN, TWIN, TWIN_AT, TWIN_WITHIN};
use crate::lanes::{Lanes, Mask};
use crate::mechanism::{Abreast, Found, Joint, Joints, Mechanism, Parameters, Places, Shorts};
use crate::normal::Normal;
use crate::number::{Number, With};
use crate::problem::{Fit, Problem, everywhere, fit};
use crate::storage::Array;
use crate::tolerances::ACCEPTANCE;
use crate::trigonometry::{cosine_and_sine, in_turn};

/// The end of the Newton steps from a candidate.
pub(crate) struct Approach<M: Mechanism> {
    /// The joint values.
    pub end: Joints<M>,
    /// Their residuals, which are within rounding.
    pub fit: Fit,
    /// The relative residual of the candidate.
    pub missed: f64,
    /// The least pivot of the normal equations at the candidate, relative to their size.
    pub pivot: f64,
    /// Whether a second solution may be near where a pivot is small.
    pub is_doubled: bool,
}

impl<M: Mechanism> Problem<'_, M> {
    /// The end of plain Newton steps by the normal equations from `q`, whose cosines and sines are `at`. `None` unless the equations hold there within rounding
    /// and are regular at each step.
    pub fn approached(&mut self, at: &Places<M>, q: &Joints<M>) -> Option<Approach<M>> {
        let (mut at, mut end) = (at.clone(), q.clone());
        self.step_back(&Array::by(self.joints(), |_| 0.0), &mut at, &mut end)?;
        let mut first = None;
        for _ in 0..APPROACHES {
            Event::Short.count();
            let here = self.mechanism.short(self.parameters, &at);
            let mut sound = 1.0;
            let normal = Normal::<M, f64>::new(here.columns, self.joints(), &mut sound);
            let is_regular = sound > 0.0;
            if !is_regular {
                return None;
            }
            let missed = missed_by::<M, f64>(&here.value, &here.size);
            first = first.or(Some((missed, normal.pivot)));
            let mut value = here.value;
            for second in [false, true] {
                if second {
                    value = self.mechanism.short_value(self.parameters, &at);
                }
                self.step_back(&normal.step(&value), &mut at, &mut end)?;
                let is_near = second || missed <= CHORD;
                let fit = if is_near { self.measure_at(&at, &end) } else { continue };
                if fit.relative < ACCEPTANCE.rounding {
                    let (missed, pivot) = first?;
                    return fit.accepted.then_some(Approach { end, fit, missed, pivot, is_doubled: true });
                }
            }
        }
        None
    }

    /// Subtracts a step from `q` and updates the cosines and sines. `None` where a pair is far from the unit circle.
    fn step_back(&self, step: &Joints<M>, at: &mut Places<M>, q: &mut Joints<M>) -> Option<()> {
        let at = at.as_mut();
        for (i, joint) in self.facts().joints.iter().enumerate() {
            let (delta, value) = (step.as_ref()[i], q.as_ref()[i] - step.as_ref()[i]);
            match *joint {
                Joint::Angle([c, s]) => {
                    let angle = in_turn(value);
                    let ([cosine_back, sine_back], norm) = turned_back(delta, [at[c], at[s]]);
                    let is_round = (norm - 1.0).abs() <= TURN;
                    if !is_round {
                        return None;
                    }
                    q.as_mut()[i] = angle;
                    let is_long = delta.abs() > TURN;
                    [at[c], at[s]] = if is_long { cosine_and_sine(angle) } else { [cosine_back, sine_back] };
                }
                Joint::Length(place) => {
                    q.as_mut()[i] = value;
                    at[place] = value;
                }
            }
        }
        Some(())
    }
}

/// Coefficients of the Taylor series of sine and cosine.
const PARTS: [f64; 3] = [1.0 / 20.0, 1.0 / 6.0, 1.0 / 12.0];

/// A pair of a cosine and a sine turned back by a small angle and normalised, and the normalising factor.
#[inline(always)]
fn turned_back<N: Number>(delta: N, [c, s]: [N; 2]) -> ([N; 2], N)
where
    f64: With<N>,
{
    let (norm, square) = (1.5 - 0.5 * (c * c + s * s), delta * delta);
    let across = norm * delta * (1.0 - square * (1.0 - square * PARTS[0]) * PARTS[1]);
    let along = norm * (1.0 - 0.5 * square * (1.0 - square * PARTS[2]));
    ([along * c + across * s, along * s - across * c], norm)
}

/// The largest relative residual.
#[inline(always)]
fn missed_by<M: Mechanism, N: Number>(value: &Shorts<M, N>, size: &Shorts<M, N>) -> N {
    let shares = value.as_ref().iter().zip(size.as_ref());
    shares.fold(N::of(0.0), |missed, (value, size)| missed.greater(value.abs() / size.max(N::of(f64::MIN_POSITIVE))))
}

/// Newton steps of several candidates: their sums, the residuals at their ends, and the relative residuals and least pivots at the candidates. `sound` is 1
/// where the equations are regular and the steps short, else 0.
pub(crate) struct Approaches<M: Mechanism> {
    steps: Joints<M, Abreast<M>>,
    residual: Abreast<M>,
    pub relative: Abreast<M>,
    missed: Abreast<M>,
    pivot: Abreast<M>,
    pub sound: Abreast<M>,
    /// Where a second solution may be near: 1, else 0.
    doubled: Abreast<M>,
}

impl<M: Mechanism> Approaches<M> {
    /// Takes the steps for the first `waiting` candidates, `W` at once. The result of one does not depend on the others.
    #[inline(always)]
    pub fn new<const W: usize>(
        problem: &Problem<'_, M>,
        at: &Places<M, Abreast<M>>,
        found: &[Found],
        waiting: usize,
    ) -> Self {
        let _phase = Phase::Waiting.begin();
        let (joints, room) = (problem.joints(), problem.facts().candidates);
        let none = || Array::by(room, |_| 0.0);
        let mut approaches = Approaches {
            steps: Array::by(joints, |_| none()),
            residual: none(),
            relative: none(),
            missed: none(),
            pivot: none(),
            sound: none(),
            doubled: none(),
        };
        let p = everywhere::<M, W>(problem);
        for first in (0..waiting.min(room)).step_by(W) {
            let none = Mask(core::array::from_fn(|lane| if first + lane < waiting { 0 } else { !0 }));
            let ends = lead(problem.mechanism, &p, abreast::<M, W>(at, first, 1), none);
            approaches.write(first, &ends);
            let most = Lanes(core::array::from_fn(|lane| if found[first + lane].close { STEEP } else { MILD }));
            let is_steep = (ends.missed * most).exceeds(ends.pivot) & none.inverted();
            if is_steep.any() {
                let doubled = is_doubled(problem.mechanism, &p, &ends);
                approaches.doubled.as_mut()[first..first + W].copy_from_slice(&doubled.0);
            }
        }
        approaches
    }

    #[inline(always)]
    fn write<const W: usize>(&mut self, first: usize, ends: &Ends<M, W>) {
        let Approaches { steps, residual, relative, missed, pivot, sound, .. } = self;
        let write = |row: &mut Abreast<M>, lanes: &Lanes<W>| row.as_mut()[first..first + W].copy_from_slice(&lanes.0);
        steps.as_mut().iter_mut().zip(ends.steps.as_ref()).for_each(|(row, lanes)| write(row, lanes));
        write(residual, &ends.residual);
        write(relative, &ends.relative);
        write(missed, &ends.missed);
        write(pivot, &ends.pivot);
        write(sound, &ends.sound);
    }

    /// The result for the candidate with index `k`, which begins at `q`.
    pub fn approach(&self, problem: &Problem<'_, M>, k: usize, q: &Joints<M>) -> Approach<M> {
        let end = Array::by(problem.joints(), |i| {
            let value = q.as_ref()[i] - self.steps.as_ref()[i].as_ref()[k];
            if problem.facts().joints[i].is_angle() { in_turn(value) } else { value }
        });
        let (residual, relative) = (self.residual.as_ref()[k], self.relative.as_ref()[k]);
        let fit = Fit { residual, relative, accepted: true };
        let (missed, pivot) = (self.missed.as_ref()[k], self.pivot.as_ref()[k]);
        Approach { end, fit, missed, pivot, is_doubled: self.doubled.as_ref()[k] > 0.0 }
    }
}

/// Number of candidates that are measured at once.
pub(crate) const LANES: usize = 2;

/// The cosines and sines of `W` candidates, with the given stride between them.
#[inline(always)]
pub(crate) fn abreast<M: Mechanism, const W: usize>(
    at: &Places<M, Abreast<M>>,
    first: usize,
    stride: usize,
) -> Places<M, Lanes<W>> {
    let rows = at.as_ref();
    Array::by(rows.len(), |i| Lanes(core::array::from_fn(|lane| rows[i].as_ref()[first + lane * stride])))
}

/// The ends of Newton steps from several candidates, each as in [`Approaches`].
pub(crate) struct Ends<M: Mechanism, const W: usize> {
    here: Places<M, Lanes<W>>,
    pub steps: Joints<M, Lanes<W>>,
    pub residual: Lanes<W>,
    pub relative: Lanes<W>,
    pub missed: Lanes<W>,
    pub pivot: Lanes<W>,
    pub sound: Lanes<W>,
}

/// Takes Newton steps from candidates with these cosines and sines, except where there is `none`. The result of one does not depend on the others.
#[inline(always)]
pub(crate) fn lead<M: Mechanism, const W: usize>(
    mechanism: &M,
    p: &Parameters<M, Lanes<W>>,
    here: Places<M, Lanes<W>>,
    none: Mask<W>,
) -> Ends<M, W> {
    let joints = mechanism.facts().joints;
    let zero = Lanes([0.0; W]);
    let zeros: Joints<M, Lanes<W>> = Array::by(joints.len(), |_| zero);
    let mut ends: Ends<M, W> =
        Ends { here, steps: zeros.clone(), residual: zero, relative: zero, missed: zero, pivot: zero, sound: zero };
    let mut walkers =
        Walkers::<M, W> { here: ends.here.clone(), steps: zeros.clone(), sound: Lanes([1.0; W]), done: none };
    walkers.step_back(joints, &zeros);
    for round in 0..APPROACHES {
        Event::Short.count();
        let short = mechanism.short(p, &walkers.here);
        let missed = missed_by::<M, Lanes<W>>(&short.value, &short.size);
        let normal = Normal::<M, Lanes<W>>::new(short.columns, joints.len(), &mut walkers.sound);
        if round == 0 {
            (ends.missed, ends.pivot) = (missed, normal.pivot);
        }
        walkers.step_back(joints, &normal.step(&short.value));
        if walkers.write(mechanism, p, missed.at_most(Lanes::of(CHORD)), &mut ends) {
            break;
        }
        let value = mechanism.short_value(p, &walkers.here);
        walkers.step_back(joints, &normal.step(&value));
        if walkers.write(mechanism, p, Mask([!0; W]), &mut ends) {
            break;
        }
    }
    ends
}

/// Where a second solution may be near the ends of Newton steps: 1, else 0. The estimate is that of [`crate::answers::Answers::arrive`] for a single candidate,
/// with normal equations and a margin: where it is 0, that one finds no second solution and no self-motion.
#[inline(always)]
fn is_doubled<M: Mechanism, const W: usize>(mechanism: &M, p: &Parameters<M, Lanes<W>>, ends: &Ends<M, W>) -> Lanes<W> {
    let (facts, one) = (mechanism.facts(), Lanes([1.0; W]));
    let joints = facts.joints.len();
    let mut regular = one;
    let normal = Normal::<M, Lanes<W>>::new(mechanism.short(p, &ends.here).columns, joints, &mut regular);
    let product = |a: &Joints<M, Lanes<W>>, b: &Joints<M, Lanes<W>>| {
        a.as_ref().iter().zip(b.as_ref()).fold(Lanes([0.0; W]), |sum, (a, b)| sum + *a * *b)
    };
    let (mut still, mut square): (Joints<M, Lanes<W>>, _) = (Array::by(joints, |_| one), one);
    for _ in 0..INVERSIONS {
        let next = normal.solved(still.clone());
        square = product(&still, &next) / product(&next, &next);
        let longest = next.as_ref().iter().zip(facts.joints).fold(Lanes([0.0; W]), |longest, (delta, joint)| {
            longest.greater(if joint.is_angle() { delta.abs() } else { delta.abs() / facts.scale })
        });
        still = Array::by(joints, |i| next.as_ref()[i] / longest);
    }
    let is_far = square.exceeds(ends.missed * normal.most * (DOUBTFUL * TWIN * DOUBTFUL * TWIN));
    let nearby = ends.missed.root();
    let ahead = nearby * TWIN_AT;
    let back: Joints<M, Lanes<W>> = Array::by(joints, |i| -(ahead * still.as_ref()[i]));
    let mut there = ends.here.clone();
    turn_back::<M, Lanes<W>>(facts.joints, &mut there, &back);
    let short = mechanism.short(p, &there);
    let step = Normal::<M, Lanes<W>>::new(short.columns, joints, &mut regular).step(&short.value);
    let arrived = ahead - product(&step, &still) / product(&still, &still);
    let distance = 2.0 * ahead - ahead * ahead / arrived;
    let is_off = distance.abs().exceeds(nearby * (DOUBTFUL * TWIN_WITHIN));
    let is_alone = (is_far | is_off) & regular.exceeds(Lanes([0.0; W]));
    Lanes([0.0; W]).or(one, is_alone)
}

/// Subtracts a step from cosines, sines and lengths.
#[inline(always)]
fn turn_back<M: Mechanism, N: Number>(joints: &[Joint], at: &mut Places<M, N>, step: &Joints<M, N>)
where
    f64: With<N>,
{
    let at = at.as_mut();
    for (delta, joint) in step.as_ref().iter().zip(joints) {
        match *joint {
            Joint::Angle([c, s]) => [at[c], at[s]] = turned_back(*delta, [at[c], at[s]]).0,
            Joint::Length(place) => at[place] = at[place] - *delta,
        }
    }
}

/// Newton iterations of several candidates side by side: for each its cosines and sines, the sum of its steps, whether its equations are regular and its steps
/// short (1, else 0), and whether it is finished.
struct Walkers<M: Mechanism, const W: usize> {
    here: Places<M, Lanes<W>>,
    steps: Joints<M, Lanes<W>>,
    sound: Lanes<W>,
    done: Mask<W>,
}

impl<M: Mechanism, const W: usize> Walkers<M, W> {
    /// Same as [`Problem::step_back`]. A candidate with a long step, or with a pair far from the unit circle, becomes unsound.
    #[inline(always)]
    fn step_back(&mut self, joints: &[Joint], step: &Joints<M, Lanes<W>>) {
        let at = self.here.as_mut();
        for (delta, joint) in step.as_ref().iter().zip(joints) {
            match *joint {
                Joint::Angle([c, s]) => {
                    let (pair, norm) = turned_back(*delta, [at[c], at[s]]);
                    [at[c], at[s]] = pair;
                    self.sound = self.sound.where_below(delta.abs(), TURN).where_below((norm - 1.0).abs(), TURN);
                }
                Joint::Length(place) => {
                    at[place] = at[place] - *delta;
                    self.sound = self.sound.where_below(delta.abs(), f64::MAX);
                }
            }
        }
        self.steps.as_mut().iter_mut().zip(step.as_ref()).for_each(|(sum, step)| *sum = *sum + *step);
    }

    /// Writes the results of the given candidates that were not finished before, and returns whether all candidates are finished: each has converged or failed.
    #[inline(always)]
    fn write(&mut self, mechanism: &M, p: &Parameters<M, Lanes<W>>, these: Mask<W>, ends: &mut Ends<M, W>) -> bool {
        let these = these & self.done.inverted();
        if these.any() {
            let [residual, relative] = fit::<M, W>(mechanism, p, &self.here);
            let write = |end: &mut Lanes<W>, now: &Lanes<W>| *end = now.or(*end, these);
            ends.here.as_mut().iter_mut().zip(self.here.as_ref()).for_each(|(end, now)| write(end, now));
            ends.steps.as_mut().iter_mut().zip(self.steps.as_ref()).for_each(|(end, now)| write(end, now));
            write(&mut ends.residual, &residual);
            write(&mut ends.relative, &relative);
            write(&mut ends.sound, &self.sound);
            let goes_on =
                self.sound.exceeds(Lanes([0.0; W])) & Lanes::of(ACCEPTANCE.rounding).exceeds(relative).inverted();
            self.done = self.done | (these & goes_on.inverted());
        }
        !self.done.inverted().any()
    }
}
