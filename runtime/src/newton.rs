//! Newton's method with damping and other safeguards near singular configurations.

use crate::counters::Event;
use crate::effort::{FITTING_STEPS, LEAPS, OVERSHOT, PATIENCE, POLISH_STEPS, RETURNS};
use crate::joints::{beyond, shifted, stepped};
use crate::mechanism::{Joints, Mechanism};
use crate::problem::{End, Problem};
use crate::storage::Array;
use crate::tolerances::{ACCEPTANCE, MERGING, PIVOTS, POLISHING, SELF_MOTIONS, STRATA};

impl<M: Mechanism> Problem<'_, M> {
    /// Takes Newton steps from joint values with known residuals, damped where a plain step fails. A step is accepted only if the relative residual decreases,
    /// at once or after a leap. Joints that are `held` do not move.
    pub fn polish(&mut self, start: End<M>, held: u32) -> End<M> {
        let (mut end, mut slow) = (start, 0);
        for _ in 0..POLISH_STEPS {
            if end.1.relative <= POLISHING.done || slow == PATIENCE || self.steps.are_spent() {
                return end;
            }
            let Some(next) = self.improved(&end, held) else { return end };
            slow = if next.1.relative <= f64::max(0.5 * end.1.relative, ACCEPTANCE.rounding) { 0 } else { slow + 1 };
            let step: Joints<M> = Array::by(self.joints(), |i| next.0.as_ref()[i] - end.0.as_ref()[i]);
            end = next;
            if end.1.relative < ACCEPTANCE.rounding && self.facts().longest(step.as_ref()) <= POLISHING.step {
                return end;
            }
        }
        end
    }

    /// Same as [`Problem::polish`], from joint values that are not measured yet.
    pub fn polished(&mut self, q: Joints<M>, held: u32) -> End<M> {
        let start = self.measured(q);
        self.polish(start, held)
    }

    /// The least damped step that lowers the relative residual. Where the residual exceeds rounding, the first choice is a step that halves it, then a leap,
    /// then any decrease. Where it is within rounding, a short plain step is the last one.
    fn improved(&mut self, (q, fit): &End<M>, held: u32) -> Option<End<M>> {
        let leaps = (ACCEPTANCE.rounding..=STRATA.near).contains(&fit.relative);
        let enough = if leaps { 0.5 * fit.relative } else { fit.relative };
        let last = if held == 0 { SELF_MOTIONS.member } else { ACCEPTANCE.rounding };
        let (derivatives, values) = self.slopes(q);
        let mut fallen = None;
        for damping in POLISHING.dampings {
            let triangle = self.triangle_of(&derivatives, &values, damping, held);
            let Some(step) = triangle.substituted() else { continue };
            let next = self.measured(stepped::<M>(&self.facts(), q, &step));
            if next.1.relative < enough {
                return Some(next);
            }
            if damping == 0.0
                && fit.relative < ACCEPTANCE.rounding
                && self.facts().longest(step.as_ref()) <= POLISHING.step
            {
                return None;
            }
            if damping == 0.0 && fit.relative > last && triangle.is_regular() {
                return (next.1.relative < fit.relative).then_some(next);
            }
            if leaps && damping == 0.0 && held == 0 && next.1.relative <= OVERSHOT * fit.relative {
                let end = self.returned(next.0.clone(), fit.relative, held);
                if end.is_some() {
                    return end;
                }
            }
            if next.1.relative < fit.relative && fallen.is_none() {
                fallen = Some(next);
            }
        }
        let leap = if leaps { self.leap(q, enough, held) } else { None };
        leap.or(fallen)
    }

    /// Takes Newton steps until the relative residual is less than `relative`. Between two close roots the first step leads beyond one of them; each further
    /// one divides the residual by four.
    fn returned(&mut self, mut q: Joints<M>, relative: f64, held: u32) -> Option<End<M>> {
        for _ in 0..RETURNS {
            let step = self.newton_step(&q, 0.0, held)?;
            q = stepped::<M>(&self.facts(), &q, &step);
            let fit = self.measure(&q);
            if fit.relative < relative {
                return Some((q, fit));
            }
        }
        None
    }

    /// Takes a full or partial Newton step, then damped steps until the relative residual is at most `enough`. Next to a self-motion the residual changes
    /// little along a curved path, but increases along each straight one.
    fn leap(&mut self, q: &Joints<M>, enough: f64, held: u32) -> Option<End<M>> {
        let step = self.newton_step(q, 0.0, held)?;
        let longest = self.facts().longest(step.as_ref());
        if !longest.is_finite() {
            return None;
        }
        for most in LEAPS {
            let share = f64::min(most / longest, 1.0);
            let direction: Joints<M> = Array::by(self.joints(), |i| share * step.as_ref()[i]);
            let mut next = stepped::<M>(&self.facts(), q, &direction);
            for _ in 0..RETURNS {
                let Some(back) = self.newton_step(&next, PIVOTS.regular, held) else { break };
                next = stepped::<M>(&self.facts(), &next, &back);
                let fit = self.measure(&next);
                if fit.relative < enough {
                    return Some((next, fit));
                }
            }
        }
        None
    }

    /// Whether the equations hold within `bound` half-way between two close configurations, on a path that may be curved.
    pub fn are_joined(&mut self, a: &Joints<M>, b: &Joints<M>, bound: f64, held: u32) -> bool {
        if self.facts().farthest(a.as_ref(), b.as_ref()) > MERGING.blur {
            return false;
        }
        let mut middle = beyond::<M>(&self.facts(), a, b, -0.5);
        let mut fit = self.measure(&middle);
        for _ in 0..RETURNS {
            if fit.relative <= bound {
                return true;
            }
            let Some(back) = self.newton_step(&middle, PIVOTS.regular, held) else { return false };
            middle = stepped::<M>(&self.facts(), &middle, &back);
            fit = self.measure(&middle);
        }
        fit.relative <= bound
    }

    /// The least-squares step `(J^T J + d |J^T J|)^-1 J^T f`, by QR factorisation. `None` when it is singular, or when no steps are left.
    pub fn newton_step(&mut self, q: &Joints<M>, damping: f64, held: u32) -> Option<Joints<M>> {
        if self.steps.are_spent() {
            return None;
        }
        self.triangle(q, damping, held).substituted()
    }

    /// Takes damped Gauss-Newton steps from `q` to the minimum of the sum of squared relative residuals. A step is accepted only if the sum decreases, and
    /// moves each joint by at most `most` (rad, or relative to the length scale). Joints that are `held` do not move.
    pub fn fitted(&mut self, q: Joints<M>, held: u32, most: f64) -> End<M> {
        let (mut q, mut squares) = (q.clone(), self.squares(&q));
        for _ in 0..FITTING_STEPS {
            if squares <= POLISHING.done * POLISHING.done || self.steps.are_spent() {
                break;
            }
            let Some((next, fallen, longest)) = self.fallen(&q, squares, held, most) else { break };
            (q, squares) = (next, fallen);
            if longest <= POLISHING.step {
                break;
            }
        }
        self.measured(q)
    }

    /// The end of the least damped step that lowers the sum of squares, the sum there, and the length of the step.
    fn fallen(&mut self, q: &Joints<M>, squares: f64, held: u32, most: f64) -> Option<(Joints<M>, f64, f64)> {
        for damping in POLISHING.dampings {
            let Some(step) = self.shares(q, damping, held).substituted() else { continue };
            let longest = self.facts().longest(step.as_ref());
            if longest <= most {
                let next = stepped::<M>(&self.facts(), q, &step);
                let fallen = self.squares(&next);
                if fallen < squares {
                    return Some((next, fallen, longest));
                }
            }
        }
        None
    }

    /// The sum of the squared relative residuals.
    fn squares(&mut self, q: &Joints<M>) -> f64 {
        self.steps.take(Event::Evaluation);
        let (values, sizes) = self.equations(&self.place(q));
        let mut sum = 0.0;
        for (value, &size) in values.as_ref().iter().zip(self.facts().size_of) {
            let share = value / f64::max(sizes.as_ref()[size], f64::MIN_POSITIVE);
            sum += share * share;
        }
        sum
    }

    /// The distance along `direction` from a root to a second one, if the equations are quadratic there. It is computed by a Newton step at the distance
    /// `ahead`.
    pub fn second_root(&mut self, root: &Joints<M>, direction: &Joints<M>, ahead: f64) -> Option<f64> {
        let there: Joints<M> = Array::by(self.joints(), |i| ahead * direction.as_ref()[i]);
        let start = shifted::<M>(&self.facts(), root, &there);
        let step = self.newton_step(&start, 0.0, 0)?;
        let (mut along, mut square) = (0.0, 0.0);
        for (step, direction) in step.as_ref().iter().zip(direction.as_ref()) {
            along += step * direction;
            square += direction * direction;
        }
        let arrived = ahead - along / square;
        let distance = 2.0 * ahead - ahead * ahead / arrived;
        distance.is_finite().then_some(distance)
    }
}
