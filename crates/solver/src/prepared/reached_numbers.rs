//! The target numbers that joint values reach, with derivatives. Main type: [`ReachedNumbers`].

use groebot_runtime as runtime;
use groebot_runtime::mechanism::{Equations, Inputs, Mechanism, Parameters, Places};
use groebot_runtime::storage::{Array, Storage};
use groebot_runtime::trigonometry::{cosine, sine};

use super::shaped::Shaped;

/// The numbers of a target that joint values reach: an angle has two, its cosine and its sine; a given joint has none.
#[derive(Clone, Debug, Default)]
pub(crate) struct ReachedNumbers {
    pub values: Vec<f64>,
    /// By joint, the derivatives of the values; empty if they are not requested.
    pub by_joint: Vec<Vec<f64>>,
}

impl<S: Storage + 'static> Shaped<S> {
    /// The numbers that `q` reaches, if the equations compare the tip with the target.
    pub fn reached_numbers(&self, q: &[f64], with_derivatives: bool) -> Option<ReachedNumbers> {
        let facts = self.facts();
        if facts.has_extras || facts.reached.len() != facts.inputs || q.len() != facts.joints.len() {
            return None;
        }
        let mut p = Mechanism::parameters(self, &Array::by(facts.inputs, |_| 0.0) as &Inputs<Self>);
        p.as_mut().fill(0.0);
        let at = self.places(q);
        let values = self.seen(&p, &at);
        let picked = |row: &Equations<Self>| {
            let mut list = Vec::with_capacity(facts.inputs + 2);
            for reached in facts.reached {
                match *reached {
                    runtime::Reached::Value(equation) => list.push(row.as_ref()[equation]),
                    runtime::Reached::Angle(pair) => list.extend(pair.map(|equation| row.as_ref()[equation])),
                    runtime::Reached::Joint(_) => {}
                }
            }
            list
        };
        let by_joint = if with_derivatives { self.columns(&p, &at).iter().map(picked).collect() } else { Vec::new() };
        Some(ReachedNumbers { values: picked(&values), by_joint })
    }

    /// The numbers that the equations read of joint values.
    fn places(&self, q: &[f64]) -> Places<Self> {
        let mut at: Places<Self> = Array::by(self.facts.places, |_| 0.0);
        for (joint, &value) in self.kinds.joints.iter().zip(q) {
            match *joint {
                runtime::Joint::Angle([c, s]) => (at.as_mut()[c], at.as_mut()[s]) = (cosine(value), sine(value)),
                runtime::Joint::Length(place) => at.as_mut()[place] = value,
            }
        }
        at
    }

    /// The values that the equations compare, of the mechanism as described.
    fn seen(&self, p: &Parameters<Self>, at: &Places<Self>) -> Equations<Self> {
        if self.facts.within.is_some() { Mechanism::described(self, p, at) } else { Mechanism::tip(self, at) }
    }

    /// By joint, the derivative of the values that the equations compare. Most are affine in the numbers of each joint: the derivative is the value at the derivatives of
    /// these numbers, less that at zeros.
    fn columns(&self, p: &Parameters<Self>, at: &Places<Self>) -> Vec<Equations<Self>> {
        let (joints, equations) = (self.kinds.joints.len(), self.facts.equations);
        if let Some(rows) = self.jacobian(p, at) {
            let column = |joint| Array::by(equations, |i| rows.as_ref()[i].as_ref()[joint]);
            return (0..joints).map(column).collect();
        }
        let column = |joint: &runtime::Joint| {
            let (mut along, mut without) = (at.clone(), at.clone());
            match *joint {
                runtime::Joint::Angle([c, s]) => {
                    (along.as_mut()[c], along.as_mut()[s]) = (-at.as_ref()[s], at.as_ref()[c]);
                    (without.as_mut()[c], without.as_mut()[s]) = (0.0, 0.0);
                }
                runtime::Joint::Length(place) => {
                    along.as_mut()[place] = 1.0;
                    without.as_mut()[place] = 0.0;
                }
            }
            let (along, without) = (self.seen(p, &along), self.seen(p, &without));
            Array::by(equations, |i| along.as_ref()[i] - without.as_ref()[i])
        };
        self.kinds.joints.iter().map(column).collect()
    }
}
