//! The interface of the run time to a mechanism, implemented for a prepared program.

use groebot_runtime::mechanism::{Equations, Inputs, Joints, Parameters, Places, Shorts, Sizes};
use groebot_runtime::storage::{Array, Storage};
use groebot_runtime::{Candidates, Facts, Found, Mechanism, Number, Preference, Short, With};

use super::run::Run;
use super::shaped::Shaped;

impl<S: Storage + 'static> Mechanism for Shaped<S> {
    type Storage = S;
    const INTERPRETED: bool = true;

    #[inline(always)]
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
            within: facts.within,
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
        self.blocks.memory.with(p.as_ref(), &[], |memory| {
            Run { solver: self, memory, candidates }.block(0, Found::first(0, 0));
        });
    }

    fn ordinary(&self, target: &Inputs<Self>, take: &mut impl FnMut(Joints<Self>, [f64; 2], usize)) -> bool {
        self.solve_ordinary(target, take)
    }

    fn tip<N: Number>(&self, at: &Places<Self, N>) -> Equations<Self, N>
    where
        f64: With<N>,
    {
        self.tip.row(&[], at.as_ref())
    }

    fn values<N: Number>(&self, p: &Parameters<Self, N>, at: &Places<Self, N>) -> Equations<Self, N>
    where
        f64: With<N>,
    {
        self.values.row(p.as_ref(), at.as_ref())
    }

    fn described<N: Number>(&self, p: &Parameters<Self, N>, at: &Places<Self, N>) -> Equations<Self, N>
    where
        f64: With<N>,
    {
        self.described.row(p.as_ref(), at.as_ref())
    }

    fn sizes<N: Number>(&self, p: &Parameters<Self, N>, at: &Places<Self, N>) -> Sizes<Self, N>
    where
        f64: With<N>,
    {
        self.sizes.row(p.as_ref(), at.as_ref())
    }

    fn jacobian(&self, p: &Parameters<Self>, at: &Places<Self>) -> Option<Equations<Self, Joints<Self>>> {
        let joints = self.facts.joints.len();
        Some(self.jacobian.as_ref()?.with(p.as_ref(), at.as_ref(), |value| {
            Array::by(self.facts.equations, |i| Array::by(joints, |j| value.at(i * joints + j)))
        }))
    }

    fn short<N: Number>(&self, p: &Parameters<Self, N>, at: &Places<Self, N>) -> Short<Self, N>
    where
        f64: With<N>,
    {
        let (count, joints) = (self.facts.shorts, self.facts.joints.len());
        self.short.with(p.as_ref(), at.as_ref(), |value| Short {
            value: Array::by(count, |i| value.at(i)),
            size: Array::by(count, |i| value.at(count + i)),
            columns: Array::by(joints, |j| Array::by(count, |i| value.at((2 + j) * count + i))),
        })
    }

    fn short_value<N: Number>(&self, p: &Parameters<Self, N>, at: &Places<Self, N>) -> Shorts<Self, N>
    where
        f64: With<N>,
    {
        self.short_value.row(p.as_ref(), at.as_ref())
    }
}
