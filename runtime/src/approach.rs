//! The short way from a candidate of a nearby mechanism's formulas to the answer next to it: [`Problem::approached`], and [`Ways`] of several.

use crate::counters::{Event, Phase};
use crate::lanes::Lanes;
use crate::mechanism::{Abreast, Joint, Joints, Mechanism, Parameters, Places, Short, Shorts};
use crate::number::{Number, With};
use crate::problem::{Fit, Problem, everywhere, fit};
use crate::storage::Array;
use crate::tolerances::{APPROACHES, PLAIN, ROUNDING, TURN};
use crate::trigonometry::{cosine, in_turn, sine};

/// Where the short way has led.
pub(crate) struct Approach<M: Mechanism> {
    /// The joints there.
    pub end: Joints<M>,
    /// How well they solve the equations: within rounding.
    pub fit: Fit,
    /// What the candidate missed, as a share of the equations' sizes.
    pub missed: f64,
    /// The least pivot of the normal equations at the candidate, as a share of their size.
    pub pivot: f64,
}

impl<M: Mechanism> Problem<'_, M> {
    /// Where plain Newton steps by the normal equations lead from `q`, of which the equations read `at`, if these hold there within rounding and are
    /// regular on the way.
    pub fn approached(&mut self, at: &Places<M>, q: &Joints<M>) -> Option<Approach<M>> {
        let (mut at, mut end) = (at.clone(), q.clone());
        self.step_back(&Array::by(self.joints(), |_| 0.0), &mut at, &mut end)?;
        let mut first = None;
        for _ in 0..APPROACHES {
            Event::Short.count();
            let here = self.mechanism.short(self.parameters, &at);
            let mut sound = 1.0;
            let (step, pivot) = normal_step::<M, f64>(&here, self.joints(), &mut sound);
            let is_regular = sound > 0.0;
            if !is_regular {
                return None;
            }
            let (missed, pivot) = *first.get_or_insert_with(|| (missed_by::<M, f64>(&here), pivot));
            self.step_back(&step, &mut at, &mut end)?;
            let fit = self.measure_at(&at, &end);
            if fit.relative < ROUNDING {
                return fit.accepted.then_some(Approach { end, fit, missed, pivot });
            }
        }
        None
    }

    /// Takes a step from `q`, and what the equations read of it; none where a pair is far from the circle.
    fn step_back(&self, step: &Joints<M>, at: &mut Places<M>, q: &mut Joints<M>) -> Option<()> {
        let at = at.as_mut();
        for (i, joint) in self.facts().joints.iter().enumerate() {
            let (way, value) = (step.as_ref()[i], q.as_ref()[i] - step.as_ref()[i]);
            match *joint {
                Joint::Angle([c, s]) => {
                    let angle = in_turn(value);
                    let ([cosine_back, sine_back], norm) = turned_back(way, [at[c], at[s]]);
                    let is_round = (norm - 1.0).abs() <= TURN;
                    if !is_round {
                        return None;
                    }
                    q.as_mut()[i] = angle;
                    let is_long = way.abs() > TURN;
                    [at[c], at[s]] = if is_long { [cosine(angle), sine(angle)] } else { [cosine_back, sine_back] };
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

/// Coefficients of the series of sine and cosine.
const PARTS: [f64; 3] = [1.0 / 20.0, 1.0 / 6.0, 1.0 / 12.0];

/// A pair of a cosine and a sine turned back by a small way, nearer to the circle, and the factor that led there.
#[inline(always)]
fn turned_back<N: Number>(way: N, [c, s]: [N; 2]) -> ([N; 2], N)
where
    f64: With<N>,
{
    let (norm, square) = (1.5 - 0.5 * (c * c + s * s), way * way);
    let across = norm * way * (1.0 - square * (1.0 - square * PARTS[0]) * PARTS[1]);
    let along = norm * (1.0 - 0.5 * square * (1.0 - square * PARTS[2]));
    ([along * c + across * s, along * s - across * c], norm)
}

/// The largest share of a value in its size.
#[inline(always)]
fn missed_by<M: Mechanism, N: Number>(here: &Short<M, N>) -> N {
    let shares = here.value.as_ref().iter().zip(here.size.as_ref());
    shares.fold(N::of(0.0), |missed, (value, size)| missed.greater(value.abs() / size.max(N::of(f64::MIN_POSITIVE))))
}

/// The step `(J^T J)^-1 J^T f` by elimination without pivoting, and the least pivot as a share of the size; not `sound` where that is small.
#[inline(always)]
fn normal_step<M: Mechanism, N: Number>(here: &Short<M, N>, joints: usize, sound: &mut N) -> (Joints<M, N>, N) {
    let none = N::of(0.0);
    let dot =
        |a: &Shorts<M, N>, b: &Shorts<M, N>| a.as_ref().iter().zip(b.as_ref()).fold(none, |sum, (a, b)| sum + *a * *b);
    let columns = here.columns.as_ref();
    let mut square: Joints<M, Joints<M, N>> = Array::by(joints, |_| Array::by(joints, |_| none));
    let mut step: Joints<M, N> = Array::by(joints, |_| none);
    let mut inverse = step.clone();
    let (square, inverse) = (square.as_mut(), inverse.as_mut());
    let (mut size, mut least) = (none, N::of(f64::INFINITY));
    for i in 0..joints {
        for j in 0..=i {
            square[i].as_mut()[j] = dot(&columns[i], &columns[j]);
        }
        step.as_mut()[i] = dot(&columns[i], &here.value);
        size = size.greater(square[i].as_ref()[i]);
    }
    for k in 0..joints {
        let pivot = square[k].as_ref()[k];
        *sound = sound.where_below(size * PLAIN - pivot, 0.0);
        least = least.lesser(pivot);
        inverse[k] = N::of(1.0) / pivot;
        for i in k + 1..joints {
            let factor = square[i].as_ref()[k] * inverse[k];
            for j in k + 1..=i {
                let taken = factor * square[j].as_ref()[k];
                square[i].as_mut()[j] = square[i].as_ref()[j] - taken;
            }
            step.as_mut()[i] = step.as_ref()[i] - factor * step.as_ref()[k];
        }
    }
    for k in (0..joints).rev() {
        let above = (k + 1..joints).fold(step.as_ref()[k], |sum, j| sum - square[j].as_ref()[k] * step.as_ref()[j]);
        step.as_mut()[k] = above * inverse[k];
    }
    (step, least / size)
}

/// The short ways of candidates: the sums of their steps, how well the equations hold behind them, what they were missed by and the least pivot before, and
/// whether the equations are regular and near: 1, else 0.
pub(crate) struct Ways<M: Mechanism> {
    steps: Joints<M, Abreast<M>>,
    residual: Abreast<M>,
    pub relative: Abreast<M>,
    missed: Abreast<M>,
    pivot: Abreast<M>,
    pub sound: Abreast<M>,
}

impl<M: Mechanism> Ways<M> {
    /// Those of the first so many candidates.
    #[inline(never)]
    pub fn new(problem: &Problem<'_, M>, at: &Places<M, Abreast<M>>, waiting: usize) -> Self {
        let _phase = Phase::Waiting.begin();
        let (joints, room) = (problem.joints(), problem.facts().candidates);
        let none = || Array::by(room, |_| 0.0);
        let mut ways = Ways {
            steps: Array::by(joints, |_| none()),
            residual: none(),
            relative: none(),
            missed: none(),
            pivot: none(),
            sound: none(),
        };
        let p = everywhere::<M, LANES>(problem);
        for first in (0..waiting.min(room)).step_by(LANES) {
            ways.run(problem, &p, at, first, waiting);
        }
        ways
    }

    /// Those of [`LANES`] candidates.
    #[inline(always)]
    fn run(
        &mut self,
        problem: &Problem<'_, M>,
        p: &Parameters<M, Lanes<LANES>>,
        at: &Places<M, Abreast<M>>,
        first: usize,
        waiting: usize,
    ) {
        let joints = problem.joints();
        let mut here: Places<M, Lanes<LANES>> = abreast::<M, LANES>(at, first, 1);
        let mut steps: Joints<M, Lanes<LANES>> = Array::by(joints, |_| Lanes([0.0; LANES]));
        let mut sound = Lanes([1.0; LANES]);
        step_back_abreast(problem, &steps, &mut here, &mut sound);
        for round in 0..APPROACHES {
            Event::Short.count();
            let short = problem.mechanism.short(p, &here);
            let (step, pivot) = normal_step::<M, Lanes<LANES>>(&short, joints, &mut sound);
            step_back_abreast(problem, &step, &mut here, &mut sound);
            steps.as_mut().iter_mut().zip(step.as_ref()).for_each(|(sum, step)| *sum = *sum + *step);
            let [residual, relative] = fit::<M, LANES>(problem.mechanism, p, &here);
            let missed = missed_by::<M, Lanes<LANES>>(&short);
            let mut is_done = true;
            for lane in 0..LANES {
                let k = first + lane;
                if round == 0 {
                    (self.missed.as_mut()[k], self.pivot.as_mut()[k]) = (missed.0[lane], pivot.0[lane]);
                }
                (self.residual.as_mut()[k], self.relative.as_mut()[k]) = (residual.0[lane], relative.0[lane]);
                self.sound.as_mut()[k] = sound.0[lane];
                for i in 0..joints {
                    self.steps.as_mut()[i].as_mut()[k] = steps.as_ref()[i].0[lane];
                }
                let is_sound = sound.0[lane] > 0.0;
                is_done &= k >= waiting || !is_sound || relative.0[lane] < ROUNDING;
            }
            if is_done {
                return;
            }
        }
    }

    /// That of the candidate with index `k`, from `q`.
    pub fn approach(&self, problem: &Problem<'_, M>, k: usize, q: &Joints<M>) -> Approach<M> {
        let end = Array::by(problem.joints(), |i| {
            let value = q.as_ref()[i] - self.steps.as_ref()[i].as_ref()[k];
            if problem.facts().joints[i].is_angle() { in_turn(value) } else { value }
        });
        let (residual, relative) = (self.residual.as_ref()[k], self.relative.as_ref()[k]);
        let fit = Fit { residual, relative, accepted: true };
        Approach { end, fit, missed: self.missed.as_ref()[k], pivot: self.pivot.as_ref()[k] }
    }
}

/// How many candidates are measured at once.
pub(crate) const LANES: usize = 2;

/// What the equations read of so many candidates, each so many behind the one before.
#[inline(always)]
pub(crate) fn abreast<M: Mechanism, const W: usize>(
    at: &Places<M, Abreast<M>>,
    first: usize,
    stride: usize,
) -> Places<M, Lanes<W>> {
    let rows = at.as_ref();
    Array::by(rows.len(), |i| Lanes(core::array::from_fn(|lane| rows[i].as_ref()[first + lane * stride])))
}

/// As [`Problem::step_back`], of several candidates at once; those with a long step, or a pair far from the circle, are not sound.
#[inline(always)]
fn step_back_abreast<M: Mechanism>(
    problem: &Problem<'_, M>,
    step: &Joints<M, Lanes<LANES>>,
    at: &mut Places<M, Lanes<LANES>>,
    sound: &mut Lanes<LANES>,
) {
    let at = at.as_mut();
    for (way, joint) in step.as_ref().iter().zip(problem.facts().joints) {
        match *joint {
            Joint::Angle([c, s]) => {
                let (pair, norm) = turned_back(*way, [at[c], at[s]]);
                [at[c], at[s]] = pair;
                *sound = sound.where_below(way.abs(), TURN).where_below((norm - 1.0).abs(), TURN);
            }
            Joint::Length(place) => {
                at[place] = at[place] - *way;
                *sound = sound.where_below(way.abs(), f64::MAX);
            }
        }
    }
}
