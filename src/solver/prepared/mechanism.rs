//! What the run time asks of a mechanism, answered from a prepared program.

use groebot_runtime::mechanism::{Equations, Inputs, Joints, Parameters, Places, Sizes};
use groebot_runtime::storage::Array;
use groebot_runtime::{Candidates, Facts, Found, Mechanism, Number, Preference, Short, With};

use super::Solver;
use super::run::Run;
use super::storage::Dynamic;

impl Mechanism for Solver {
    type Storage = Dynamic;
    const IS_TOLD: bool = true;

    fn facts(&self) -> Facts<'_> {
        let facts = &self.facts;
        Facts {
            inputs: facts.inputs,
            joints: &self.kinds.joints,
            last_first: &facts.last_first,
            places: facts.places,
            has_extras: facts.has_extras,
            size_of: &facts.size_of,
            sizes: facts.sizes.len(),
            compared: &facts.compared,
            turned: &facts.turned,
            candidates: facts.candidates,
            twins: facts.twins,
            runs: &facts.runs,
            scale: facts.scale,
            capacity: facts.capacity,
            isolated: facts.isolated,
            freed: &facts.freed,
            conditions: &self.kinds.conditions,
            reached: &self.kinds.reached,
            nearby: facts.nearby.then_some(facts.shorts),
            preference: facts.preference.map(|(place, greatest)| Preference { place, greatest }),
        }
    }

    fn parameters<N: Number>(&self, target: &Inputs<Self, N>) -> Parameters<Self, N>
    where
        f64: With<N>,
    {
        let values = self.parameters.values(target.as_ref());
        Array::by(values.len(), |i| values[i])
    }

    fn walk<N: Number, C: Candidates<N, Self>>(&self, p: &Parameters<Self, N>, candidates: &mut C)
    where
        f64: With<N>,
    {
        let memory = self.blocks.memory.with(p.as_ref());
        Run { solver: self, memory, candidates }.block(0, Found::first(0, 0));
    }

    fn tip<N: Number>(&self, at: &Places<Self, N>) -> Equations<Self, N>
    where
        f64: With<N>,
    {
        let parameters = vec![N::of(0.0); self.parameters.len()];
        self.tip.row(&parameters, at.as_ref())
    }

    fn values<N: Number>(&self, p: &Parameters<Self, N>, at: &Places<Self, N>) -> Equations<Self, N>
    where
        f64: With<N>,
    {
        self.values.row(p.as_ref(), at.as_ref())
    }

    fn sizes<N: Number>(&self, p: &Parameters<Self, N>, at: &Places<Self, N>) -> Sizes<Self, N>
    where
        f64: With<N>,
    {
        self.sizes.row(p.as_ref(), at.as_ref())
    }

    fn jacobian(&self, p: &Parameters<Self>, at: &Places<Self>) -> Option<Equations<Self, Joints<Self>>> {
        let value = self.jacobian.as_ref()?.values(p.as_ref(), at.as_ref());
        let joints = self.facts.joints.len();
        Some(Array::by(self.facts.equations, |i| Array::by(joints, |j| value(i * joints + j))))
    }

    fn short<N: Number>(&self, p: &Parameters<Self, N>, at: &Places<Self, N>) -> Short<Self, N>
    where
        f64: With<N>,
    {
        let value = self.short.values(p.as_ref(), at.as_ref());
        let (count, joints) = (self.facts.shorts, self.facts.joints.len());
        Short {
            value: Array::by(count, &value),
            size: Array::by(count, |i| value(count + i)),
            columns: Array::by(joints, |j| Array::by(count, |i| value((2 + j) * count + i))),
        }
    }
}
