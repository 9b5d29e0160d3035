//! The equations at one target: residuals of joint values ([`Fit`]) and derivatives by the joints.

use crate::counters::Event;
use crate::derivatives::{of_affine, of_affine_at_once};
use crate::joints::place;
use crate::lanes::Lanes;
use crate::mechanism::{Equations, Facts, Joints, Mechanism, Parameters, Places, Sizes};
use crate::number::Number;
use crate::steps::Steps;
use crate::storage::Array;
use crate::tolerances::ACCEPTANCE;

/// A mechanism's equations at a target.
pub(crate) struct Problem<'a, M: Mechanism> {
    pub mechanism: &'a M,
    pub parameters: &'a Parameters<M>,
    /// The candidate's numbers, of which some follow from no joint.
    pub extras: Option<Places<M>>,
    /// The remaining steps of the target.
    pub steps: &'a mut Steps,
}

/// Residuals of joint values.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fit {
    /// The largest magnitude of an equation's value.
    pub residual: f64,
    /// The largest value of an equation relative to its size.
    pub relative: f64,
    /// Whether every equation holds.
    pub accepted: bool,
}

/// Joint values with their residuals.
pub(crate) type End<M> = (Joints<M>, Fit);

impl<'a, M: Mechanism> Problem<'a, M> {
    #[inline(always)]
    pub fn new(mechanism: &'a M, parameters: &'a Parameters<M>, steps: &'a mut Steps) -> Self {
        Problem { mechanism, parameters, extras: None, steps }
    }

    /// Constants that hold for all targets.
    #[inline(always)]
    pub fn facts(&self) -> Facts<'a> {
        self.mechanism.facts()
    }

    /// Number of joints.
    #[inline(always)]
    pub fn joints(&self) -> usize {
        self.facts().joints.len()
    }

    /// The numbers that the equations read of joint values.
    pub fn place(&self, q: &Joints<M>) -> Places<M> {
        place::<M>(&self.facts(), q, self.extras.as_ref())
    }

    /// The equations' values and sizes.
    pub fn equations(&self, at: &Places<M>) -> (Equations<M>, Sizes<M>) {
        (self.mechanism.values(self.parameters, at), self.mechanism.sizes(self.parameters, at))
    }

    /// The residuals of joint values.
    pub fn measure(&mut self, q: &Joints<M>) -> Fit {
        self.measure_at(&self.place(q), q)
    }

    /// The joint values with their residuals.
    pub fn measured(&mut self, q: Joints<M>) -> End<M> {
        let fit = self.measure(&q);
        (q, fit)
    }

    /// Same as [`Problem::measure`], where the cosines and sines of `q` are known.
    pub fn measure_at(&mut self, at: &Places<M>, q: &Joints<M>) -> Fit {
        self.steps.take(Event::Evaluation);
        let (values, sizes) = self.equations(at);
        let (size_of, sizes) = (self.facts().size_of, sizes.as_ref());
        let are_finite = q.as_ref().iter().all(|value| value.is_finite());
        let mut fit = Fit { residual: 0.0, relative: 0.0, accepted: are_finite };
        let mut largest: Sizes<M> = Array::by(self.facts().sizes, |_| 0.0);
        for (value, &size) in values.as_ref().iter().zip(size_of) {
            largest.as_mut()[size] = f64::max(largest.as_ref()[size], value.abs());
            fit.accepted &= value.abs() <= ACCEPTANCE.residual * sizes[size];
        }
        for (largest, size) in largest.as_ref().iter().zip(sizes) {
            fit.residual = f64::max(fit.residual, *largest);
            fit.relative = f64::max(fit.relative, largest / f64::max(*size, f64::MIN_POSITIVE));
        }
        fit.accepted &= fit.residual.is_finite();
        fit
    }

    /// The derivative of each equation by each joint.
    pub fn derivatives(&self, at: &Places<M>) -> Equations<M, Joints<M>> {
        let own = self.mechanism.jacobian(self.parameters, at);
        own.unwrap_or_else(|| of_affine(self.mechanism, self.parameters, at))
    }

    /// The derivative of each equation by each joint, and its value.
    pub fn linearised(&self, at: &Places<M>) -> (Equations<M, Joints<M>>, Equations<M>) {
        let (mechanism, p) = (self.mechanism, self.parameters);
        match mechanism.jacobian(p, at) {
            Some(slopes) => (slopes, mechanism.values(p, at)),
            None if M::INTERPRETED => of_affine_at_once(mechanism, p, at),
            None => (of_affine(mechanism, p, at), mechanism.values(p, at)),
        }
    }

    /// The influence of each joint on the equations: the greatest derivative relative to its equation's size, at most one. It is one for a length.
    pub fn weights(&self, q: &Joints<M>) -> Joints<M> {
        let at = self.place(q);
        let rows = self.derivatives(&at);
        let sizes = self.mechanism.sizes(self.parameters, &at);
        Array::by(self.joints(), |i| {
            if !self.facts().joints[i].is_angle() {
                return 1.0;
            }
            let share = |(row, size): (&Joints<M>, &usize)| {
                row.as_ref()[i].abs() / f64::max(sizes.as_ref()[*size], f64::MIN_POSITIVE)
            };
            let greatest = rows.as_ref().iter().zip(self.facts().size_of).map(share).fold(0.0, f64::max);
            f64::min(greatest, 1.0)
        })
    }
}

/// The parameters repeated in all lanes.
#[inline(always)]
pub(crate) fn everywhere<M: Mechanism, const W: usize>(problem: &Problem<'_, M>) -> Parameters<M, Lanes<W>> {
    let numbers = problem.parameters.as_ref();
    Array::by(numbers.len(), |i| Lanes::of(numbers[i]))
}

/// The largest magnitude of an equation's value, and the largest relative one.
#[inline(always)]
pub(crate) fn fit<M: Mechanism, const W: usize>(
    mechanism: &M,
    p: &Parameters<M, Lanes<W>>,
    at: &Places<M, Lanes<W>>,
) -> [Lanes<W>; 2] {
    let facts = mechanism.facts();
    let mut largest: Sizes<M, Lanes<W>> = Array::by(facts.sizes, |_| Lanes([0.0; W]));
    for (value, &size) in mechanism.values(p, at).as_ref().iter().zip(facts.size_of) {
        largest.as_mut()[size] = largest.as_ref()[size].greater(value.abs());
    }
    let [mut residual, mut relative] = [Lanes([0.0; W]); 2];
    for (largest, size) in largest.as_ref().iter().zip(mechanism.sizes(p, at).as_ref()) {
        residual = residual.greater(*largest);
        relative = relative.greater(*largest / size.max(Lanes::of(f64::MIN_POSITIVE)));
    }
    [residual, relative]
}
