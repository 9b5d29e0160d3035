//! Newton's method with all that keeps it from going astray next to singular configurations.

use crate::arithmetic::Arithmetic;
use crate::counters::Event;
use crate::joints::{beyond, is_in, shifted, stepped};
use crate::mechanism::{Equations, Joints, Mechanism};
use crate::problem::{End, Problem};
use crate::storage::{Array, Storage};
use crate::tolerances::{
    ALONE, BLUR, DAMPINGS, FITTING_STEPS, INVERSIONS, LEAPS, NEAR, OVERSHOT, PATIENCE, POLISH_STEPS, POLISHED, RETURNS,
    ROUNDING, SHORT, STEEP, STIFF,
};

/// A triangle of columns, the right side in the last one.
pub(crate) struct Triangle<M: Mechanism> {
    numbers: <M::Storage as Storage>::Triangle,
    /// The length of a column: one entry for each equation, then one for each joint.
    rows: usize,
    joints: usize,
    /// In all columns the entries are zero after those of so many joints. Before the reflection of a pivot they are zero after that of its joint.
    damped: usize,
}

impl<M: Mechanism> Problem<'_, M> {
    /// Newton steps from joints with their fit, damped where a plain one fails; each is taken only if the relative residual falls, at once or
    /// after a leap. Joints that are `held` stay.
    pub fn polish(&mut self, start: End<M>, held: u32) -> End<M> {
        let (mut end, mut slow) = (start, 0);
        for _ in 0..POLISH_STEPS {
            if end.1.relative <= POLISHED || slow == PATIENCE || self.steps.are_spent() {
                return end;
            }
            let Some(next) = self.improved(&end, held) else { return end };
            slow = if next.1.relative <= f64::max(0.5 * end.1.relative, ROUNDING) { 0 } else { slow + 1 };
            let step: Joints<M> = Array::by(self.joints(), |i| next.0.as_ref()[i] - end.0.as_ref()[i]);
            end = next;
            if end.1.relative < ROUNDING && self.facts().longest(step.as_ref()) <= SHORT {
                return end;
            }
        }
        end
    }

    /// The same from joints that are not measured yet.
    pub fn polished(&mut self, q: Joints<M>, held: u32) -> End<M> {
        let start = self.measured(q);
        self.polish(start, held)
    }

    /// The least damped step that lowers the relative residual: where it is more than rounding, to half of it, else a leap, else at all. Where
    /// it is rounding and a plain step is short, that is the last.
    fn improved(&mut self, (q, fit): &End<M>, held: u32) -> Option<End<M>> {
        let leaps = (ROUNDING..=NEAR).contains(&fit.relative);
        let enough = if leaps { 0.5 * fit.relative } else { fit.relative };
        let last = if held == 0 { ALONE } else { ROUNDING };
        let (derivatives, values) = self.slopes(q);
        let mut fallen = None;
        for damping in DAMPINGS {
            let triangle = self.triangle_of(&derivatives, &values, damping, held);
            let Some(step) = triangle.substituted() else { continue };
            let next = self.measured(stepped::<M>(&self.facts(), q, &step));
            if next.1.relative < enough {
                return Some(next);
            }
            if damping == 0.0 && fit.relative < ROUNDING && self.facts().longest(step.as_ref()) <= SHORT {
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

    /// Newton steps on until the equations are missed by less than `relative`: from between two roots next to each other the first step leads
    /// beyond one of them, and from there on each quarters the miss.
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

    /// A Newton step, or a part of it, and behind it damped steps back, until the equations hold within `enough`: next to a self-motion the miss
    /// hardly changes along a bent way, and rises on each straight one.
    fn leap(&mut self, q: &Joints<M>, enough: f64, held: u32) -> Option<End<M>> {
        let step = self.newton_step(q, 0.0, held)?;
        let longest = self.facts().longest(step.as_ref());
        if !longest.is_finite() {
            return None;
        }
        for most in LEAPS {
            let share = f64::min(most / longest, 1.0);
            let way: Joints<M> = Array::by(self.joints(), |i| share * step.as_ref()[i]);
            let mut next = stepped::<M>(&self.facts(), q, &way);
            for _ in 0..RETURNS {
                let Some(back) = self.newton_step(&next, STIFF, held) else { break };
                next = stepped::<M>(&self.facts(), &next, &back);
                let fit = self.measure(&next);
                if fit.relative < enough {
                    return Some((next, fit));
                }
            }
        }
        None
    }

    /// Whether the equations hold half-way between two places next to each other, on a way that may be bent, within `bound`.
    pub fn are_joined(&mut self, a: &Joints<M>, b: &Joints<M>, bound: f64, held: u32) -> bool {
        if self.facts().farthest(a.as_ref(), b.as_ref()) > BLUR {
            return false;
        }
        let mut middle = beyond::<M>(&self.facts(), a, b, -0.5);
        let mut fit = self.measure(&middle);
        for _ in 0..RETURNS {
            if fit.relative <= bound {
                return true;
            }
            let Some(back) = self.newton_step(&middle, STIFF, held) else { return false };
            middle = stepped::<M>(&self.facts(), &middle, &back);
            fit = self.measure(&middle);
        }
        fit.relative <= bound
    }

    /// The least-squares step `(J^T J + d |J^T J|)^-1 J^T f`; none when it is singular, or no steps are left. The rows are turned into a triangle by reflections.
    pub fn newton_step(&mut self, q: &Joints<M>, damping: f64, held: u32) -> Option<Joints<M>> {
        if self.steps.are_spent() {
            return None;
        }
        self.triangle(q, damping, held).substituted()
    }

    /// Damped Gauss-Newton steps from `q` to where the sum of the squares of what the equations are missed by, as shares of their sizes, is least; each is
    /// taken only if it falls, and no joint goes farther in it than `most` (rad, or relative to the length scale). Joints that are `held` stay.
    pub fn fitted(&mut self, q: Joints<M>, held: u32, most: f64) -> End<M> {
        let (mut q, mut squares) = (q.clone(), self.squares(&q));
        for _ in 0..FITTING_STEPS {
            if squares <= POLISHED * POLISHED || self.steps.are_spent() {
                break;
            }
            let Some((next, fallen, longest)) = self.fallen(&q, squares, held, most) else { break };
            (q, squares) = (next, fallen);
            if longest <= SHORT {
                break;
            }
        }
        self.measured(q)
    }

    /// Where the least damped step leads that lowers the sum of squares, what that is there, and how long the step is.
    fn fallen(&mut self, q: &Joints<M>, squares: f64, held: u32, most: f64) -> Option<(Joints<M>, f64, f64)> {
        for damping in DAMPINGS {
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

    /// The sum of the squares of what the equations are missed by, as shares of their sizes.
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

    /// The least pivot of the Jacobian's triangle at `q` as a share of the largest: rounding where the joints can move while the equations
    /// hold, or a root is double.
    pub fn regularity(&mut self, q: &Joints<M>) -> f64 {
        self.regularity_of(q, 0)
    }

    /// The same where joints are `held`.
    pub fn regularity_of(&mut self, q: &Joints<M>, held: u32) -> f64 {
        self.triangle(q, 0.0, held).regularity()
    }

    /// The direction in which the equations change least where they have this triangle, its longest way one, and by what share of the largest pivot they do.
    /// By inverse iteration; none where a pivot is zero, or no steps are left.
    pub fn stillest(&self, mut triangle: Triangle<M>) -> Option<(Joints<M>, f64)> {
        if self.steps.are_spent() {
            return None;
        }
        let joints = self.joints();
        let most = (0..joints).fold(0.0, |most, i| f64::max(most, triangle.entry(i, i).abs()));
        let mut way: Joints<M> = Array::by(joints, |_| 1.0);
        let mut share = 1.0;
        for _ in 0..INVERSIONS {
            for row in 0..joints {
                let above =
                    (0..row).fold(way.as_ref()[row], |sum, k| sum - triangle.entry(row, k) * triangle.entry(joints, k));
                let solved = above / triangle.entry(row, row);
                triangle.column_mut(joints)[row] = solved;
            }
            let before = norm(&triangle.column(joints)[..joints]);
            way = triangle.substituted()?;
            share = before / (norm(way.as_ref()) * most);
        }
        let longest = self.facts().longest(way.as_ref());
        let unit = Array::by(joints, |i| way.as_ref()[i] / longest);
        (longest.is_finite() && longest > 0.0).then_some((unit, share))
    }

    /// How far along a way from a root another one is, if the equations are a parabola there: by a Newton step from so far along the way.
    pub fn second_root(&mut self, root: &Joints<M>, way: &Joints<M>, ahead: f64) -> Option<f64> {
        let there: Joints<M> = Array::by(self.joints(), |i| ahead * way.as_ref()[i]);
        let start = shifted::<M>(&self.facts(), root, &there);
        let step = self.newton_step(&start, 0.0, 0)?;
        let (mut along, mut square) = (0.0, 0.0);
        for (step, way) in step.as_ref().iter().zip(way.as_ref()) {
            along += step * way;
            square += way * way;
        }
        let arrived = ahead - along / square;
        let distance = 2.0 * ahead - ahead * ahead / arrived;
        distance.is_finite().then_some(distance)
    }

    /// The triangle of a step's equations.
    pub fn triangle(&mut self, q: &Joints<M>, damping: f64, held: u32) -> Triangle<M> {
        let (derivatives, right) = self.slopes(q);
        self.triangle_of(&derivatives, &right, damping, held)
    }

    /// The equations' derivatives by the joints, and their values.
    fn slopes(&self, q: &Joints<M>) -> (Equations<M, Joints<M>>, Equations<M>) {
        let at = self.place(q);
        (self.derivatives(&at), self.mechanism.values(self.parameters, &at))
    }

    /// The same with the equations as shares of their sizes.
    pub(crate) fn shares(&mut self, q: &Joints<M>, damping: f64, held: u32) -> Triangle<M> {
        let (derivatives, right) = self.shared(q);
        self.triangle_of(&derivatives, &right, damping, held)
    }

    /// The derivatives of the equations and their values, as shares of their sizes.
    pub(crate) fn shared(&self, q: &Joints<M>) -> (Equations<M, Joints<M>>, Equations<M>) {
        let at = self.place(q);
        let (mut derivatives, (mut right, sizes)) = (self.derivatives(&at), self.equations(&at));
        for (i, &size) in self.facts().size_of.iter().enumerate() {
            let size = f64::max(sizes.as_ref()[size], f64::MIN_POSITIVE);
            right.as_mut()[i] /= size;
            derivatives.as_mut()[i].as_mut().iter_mut().for_each(|entry| *entry /= size);
        }
        (derivatives, right)
    }

    /// Room for a triangle, all zeros.
    pub(crate) fn no_triangle(&self) -> Triangle<M> {
        let joints = self.joints();
        let rows = self.facts().size_of.len() + joints;
        Triangle { numbers: Array::by((joints + 1) * rows, |_| 0.0), rows, joints, damped: joints }
    }

    /// The triangle of equations with these derivatives and values.
    pub(crate) fn triangle_of(
        &mut self,
        derivatives: &Equations<M, Joints<M>>,
        right: &Equations<M>,
        damping: f64,
        held: u32,
    ) -> Triangle<M> {
        self.steps.take(Event::Step);
        let (joints, equations) = (self.joints(), self.facts().size_of.len());
        let mut triangle = self.no_triangle();
        let mut size = 0.0;
        for i in (0..joints).filter(|i| !is_in(held, *i)) {
            let mut square = 0.0;
            for (entry, row) in triangle.column_mut(i).iter_mut().zip(derivatives.as_ref()) {
                *entry = row.as_ref()[i];
                square += *entry * *entry;
            }
            size = f64::max(size, square);
        }
        triangle.column_mut(joints)[..equations].copy_from_slice(right.as_ref());
        triangle.damped = if damping > 0.0 { joints } else { (u32::BITS - held.leading_zeros()) as usize };
        for i in 0..joints {
            let damped = if is_in(held, i) { 1.0 } else { Arithmetic::sqrt(damping * size) };
            triangle.column_mut(i)[equations + i] = damped;
        }
        triangle.reflect();
        triangle
    }
}

impl<M: Mechanism> Triangle<M> {
    fn column(&self, column: usize) -> &[f64] {
        &self.numbers.as_ref()[column * self.rows..][..self.rows]
    }

    pub fn column_mut(&mut self, column: usize) -> &mut [f64] {
        &mut self.numbers.as_mut()[column * self.rows..][..self.rows]
    }

    pub fn entry(&self, column: usize, row: usize) -> f64 {
        self.numbers.as_ref()[column * self.rows + row]
    }

    /// Turns columns into a triangle by reflections.
    pub fn reflect(&mut self) {
        for pivot in 0..self.joints {
            let end = self.rows - self.joints + usize::min(pivot + 1, self.damped);
            let (before, behind) = self.numbers.as_mut().split_at_mut((pivot + 1) * self.rows);
            let mirror = &mut before[pivot * self.rows..][pivot..end];
            let square = mirror.iter().fold(0.0, |sum, x| sum + x * x);
            if square == 0.0 {
                continue;
            }
            let length = Arithmetic::sqrt(square).copysign(mirror[0]);
            mirror[0] += length;
            let half = length * mirror[0];
            for column in behind.chunks_exact_mut(self.rows) {
                let column = &mut column[pivot..end];
                let along = mirror.iter().zip(&*column).fold(0.0, |sum, (x, y)| sum + x * y) / half;
                column.iter_mut().zip(&*mirror).for_each(|(x, y)| *x -= along * y);
            }
            mirror[0] = -length;
        }
    }

    /// The least pivot as a share of the largest.
    pub fn regularity(&self) -> f64 {
        let pivots = (0..self.joints).map(|i| self.entry(i, i).abs());
        let (least, most) =
            pivots.fold((f64::INFINITY, 0.0), |(least, most), pivot| (f64::min(least, pivot), f64::max(most, pivot)));
        least / most
    }

    /// Whether the least pivot outweighs the equations' values: no place nearby solves them better than where the plain step leads.
    fn is_regular(&self) -> bool {
        let pivots = (0..self.joints).map(|i| self.entry(i, i).abs());
        let (least, most) =
            pivots.fold((f64::INFINITY, 0.0), |(least, most), pivot| (f64::min(least, pivot), f64::max(most, pivot)));
        least * least > STEEP * most * norm(self.column(self.joints))
    }

    /// The solution of the triangular system; none for a zero or non-finite pivot.
    pub fn substituted(&self) -> Option<Joints<M>> {
        let mut solution: Joints<M> = Array::by(self.joints, |_| 0.0);
        for row in (0..self.joints).rev() {
            let pivot = self.entry(row, row);
            if pivot == 0.0 || !pivot.is_finite() {
                return None;
            }
            let mut sum = self.entry(self.joints, row);
            for k in row + 1..self.joints {
                sum -= self.entry(k, row) * solution.as_ref()[k];
            }
            solution.as_mut()[row] = sum / pivot;
        }
        Some(solution)
    }
}

fn norm(vector: &[f64]) -> f64 {
    Arithmetic::sqrt(vector.iter().fold(0.0, |sum, x| sum + x * x))
}
