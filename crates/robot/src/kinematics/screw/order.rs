//! The orders of subproblems for a chain: the best one, and for each of its steps an alternative without this step.
//!
//! A step may degenerate at a pose that is not singular. For example two axes with joints between them become parallel,
//! and a direction along them does not determine a joint that other equations determine. Then an order is used that
//! does not solve the same joints at that position.

use std::sync::OnceLock;

use super::feature::Scale;
use super::model::Model;
use super::plan::{Plan, PlanStep, describe};
use super::refine::MOST_JOINTS;
use super::search::{Move, Sample, Search};
use super::step::Step;
use crate::Result;
use crate::kinematics::Chain;
use crate::spatial::{Half, Screw};

/// An order of steps.
#[derive(Clone, Debug)]
pub(super) struct Order {
    pub steps: Vec<Step>,
    pub plan: Plan,
    /// The number of its first branch.
    pub first_branch: usize,
}

/// The best order, and for each of its steps the best order without it, which is computed on demand.
#[derive(Clone, Debug)]
pub(super) struct Orders {
    pub first: Order,
    samples: Vec<Sample>,
    scale: Scale,
    spares: Vec<(Move, OnceLock<Option<Order>>)>,
}

impl Orders {
    /// The orders of a chain with these samples; `None` when no order of the known subproblems solves it.
    pub fn find(samples: Vec<Sample>, scale: Scale) -> Option<Orders> {
        let found = Search::new(&samples, scale).plan()?;
        let spares = found.iter().map(|(_, does)| (*does, OnceLock::new())).collect();
        let first = Order::of(found, &samples[0], scale, 0);
        Some(Orders { first, samples, scale, spares })
    }

    /// The order that does not solve the same joints at the position of step `at` of the first order; `None` if there
    /// is none.
    pub fn without(&self, at: usize) -> Option<&Order> {
        let (avoided, spare) = &self.spares[at];
        let find = || {
            let found = Search::new(&self.samples, self.scale).avoiding(*avoided).plan()?;
            Some(Order::of(found, &self.samples[0], self.scale, self.first.plan.most_solutions()))
        };
        spare.get_or_init(find).as_ref()
    }
}

impl Order {
    fn of(found: Vec<(Step, Move)>, sample: &Sample, scale: Scale, first_branch: usize) -> Order {
        let steps: Vec<Step> = found.into_iter().map(|(step, _)| step).collect();
        let plan = described(&steps, sample, scale);
        Order { steps, plan, first_branch }
    }
}

/// Two sample configurations in general position.
pub(super) fn samples(chain: &Chain, model: &Model) -> Result<Vec<Sample>> {
    const TURNS: [[f64; MOST_JOINTS]; 2] = [
        [0.7391, -1.1217, 0.8713, 0.5347, -0.9241, 1.3129, 0.6173, 0.9677, 0.4519, -0.7283],
        [-0.4177, 0.6911, -1.2371, 1.0939, 0.7727, -0.5813, -0.8447, 0.3821, -1.0537, 0.8563],
    ];
    let length = if chain.reach() > 0.0 { chain.reach() } else { 1.0 };
    let sample = |turns: &[f64; MOST_JOINTS]| {
        let value = |(screw, turn): (&Screw, &f64)| if screw.axis().is_some() { *turn } else { turn * length };
        let q: Vec<f64> = chain.screws().iter().zip(turns).map(value).collect();
        let (q, goal) = model.values(chain, &q)?;
        let start = model.start(goal, model.given.iter().map(|&joint| Half::new(q[joint])));
        Ok(Sample { start, q })
    };
    TURNS.iter().map(sample).collect()
}

/// Describes the steps.
fn described(steps: &[Step], sample: &Sample, scale: Scale) -> Plan {
    let mut reduced = sample.start.clone();
    let mut described_steps: Vec<PlanStep> = Vec::new();
    for step in steps {
        described_steps.push(describe(step, &reduced, step.most_answers(&reduced), scale));
        for joint in step.solved(&reduced) {
            if let Some(place) = reduced.place(joint) {
                reduced.absorb(place, Half::new(sample.q[joint]));
            }
        }
    }
    Plan { steps: described_steps }
}
