//! The targets of a check: random reachable ones, the boundary of the workspace, strata and their neighbourhood, and far ones.

use crate::tolerances::WITNESS;
use std::f64::consts::PI;

use super::Draws;
use super::chain::model::Joints;
use super::check::Target;
use super::model::{Model, replaced};
use super::newton::newton;
use super::report::Kind;
use crate::derive::{ParameterSource, Quantity};
use crate::solver::Program;
use groebot_algebra::poly::{Expression, parse};
use groebot_algebra::random::SplitMix64;

/// The maximum number of draws for a target of one kind.
const DRAWS: usize = 20;
/// The factor from a reachable target to an unreachable one.
const FAR: f64 = 10.0;
/// The number of distances 10^-k from a stratum, k = 1..=DECADES, on both sides.
const DECADES: usize = 12;
/// The kinds of targets in every twelve rows.
const PLAN: [Slot; 12] = {
    use Slot::{Boundary, Far, Random, Round, Stratum};
    [
        Random,
        Round(15),
        Boundary,
        Stratum,
        Random,
        Far,
        Random,
        Round(30),
        Boundary,
        Random,
        Stratum,
        Random, //
    ]
};

/// The kinds of round targets, in turn, if only round targets are requested.
const ROUND: [Slot; 2] = [Slot::Round(15), Slot::Round(30)];

#[derive(Clone, Copy)]
enum Slot {
    Random,
    /// Angles in multiples of so many degrees.
    Round(u32),
    Boundary,
    Stratum,
    Far,
}

/// The source of targets for one program.
pub(super) struct Targets<'a> {
    model: &'a Model<'a>,
    random: SplitMix64,
    plan: &'static [Slot],
    /// Factors that vanish together, with their text.
    strata: Vec<(String, Vec<Expression>)>,
    boundaries_done: usize,
    strata_done: usize,
}

impl<'a> Targets<'a> {
    pub fn new(model: &'a Model<'a>, program: &Program, draws: Draws, seed: u64) -> Self {
        let (strata, random) = (strata(model, program), SplitMix64::new(seed));
        let plan: &[Slot] = if draws == Draws::Round { &ROUND } else { &PLAN };
        Targets { model, random, plan, strata, boundaries_done: 0, strata_done: 0 }
    }

    /// The target of row `number`; `None` if no draw gave one.
    pub fn draw(&mut self, number: usize) -> Option<Target> {
        let special = match self.plan[number % self.plan.len()] {
            Slot::Random => None,
            Slot::Round(degrees) => self.round(degrees),
            Slot::Boundary => self.boundary(),
            Slot::Stratum => self.stratum(),
            Slot::Far => self.far(),
        };
        special.or_else(|| self.reachable(Kind::Random, None))
    }

    fn joints(&mut self) -> Vec<f64> {
        let (model, random) = (self.model, &mut self.random);
        let limit = |joint| if model.turns(joint) { PI } else { model.unit };
        (0..model.system.joints.len()).map(|joint| random.between(-limit(joint), limit(joint))).collect()
    }

    /// The start of the search for inputs. Positive inputs keep these values.
    fn inputs(&mut self) -> Vec<f64> {
        let (model, random) = (self.model, &mut self.random);
        let draw = |(index, input): (usize, &crate::derive::Input)| {
            let size = if input.quantity == Quantity::Angle { PI } else { model.input_size(index) };
            if input.positive { random.between(0.5 * size, 2.0 * size) } else { random.between(-size, size) }
        };
        model.system.inputs.iter().enumerate().map(draw).collect()
    }

    /// A reachable target, optionally with one joint at a given value.
    fn reachable(&mut self, kind: Kind, held: Option<(usize, f64)>) -> Option<Target> {
        (0..DRAWS).find_map(|_| {
            let mut q = self.joints();
            if let Some((joint, value)) = held {
                q[joint] = value;
            }
            self.reached(kind.clone(), q)
        })
    }

    /// A target of angles in multiples of `degrees`.
    fn round(&mut self, degrees: u32) -> Option<Target> {
        let step = PI / f64::from(180 / degrees);
        (0..DRAWS).find_map(|_| {
            let mut q = self.joints();
            let angles = (0..q.len()).filter(|&joint| self.model.turns(joint));
            angles.for_each(|joint| q[joint] = (q[joint] / step).ceil() * step);
            self.reached(Kind::Round, q)
        })
    }

    fn reached(&mut self, kind: Kind, q: Vec<f64>) -> Option<Target> {
        let start = self.inputs();
        let inputs = self.model.inputs_at(&q, &start)?;
        Some(Target { kind, inputs, joints: Some(q) })
    }

    /// In turn: each angle at 0 and at pi, and a configuration where the Jacobian is singular.
    fn boundary(&mut self) -> Option<Target> {
        let angles: Vec<usize> = (0..self.model.system.joints.len()).filter(|&j| self.model.turns(j)).collect();
        let turn = self.boundaries_done % (2 * angles.len() + 2);
        self.boundaries_done += 1;
        match angles.get(turn / 2) {
            Some(&joint) => {
                self.reachable(Kind::Boundary, Some((joint, if turn.is_multiple_of(2) { 0.0 } else { PI })))
            }
            None => (0..DRAWS).find_map(|_| self.singular()),
        }
    }

    /// A zero of the Jacobian's determinant on a line between two random joint vectors, by bisection.
    fn singular(&mut self) -> Option<Target> {
        let (from, to, start) = (self.joints(), self.joints(), self.inputs());
        let at = |share: f64| -> Option<(Vec<f64>, Vec<f64>, f64)> {
            let q: Vec<f64> = from.iter().zip(&to).map(|(a, b)| a + share * (b - a)).collect();
            let inputs = self.model.inputs_at(&q, &start)?;
            let determinant = self.model.determinant(&inputs, &q)?;
            Some((q, inputs, determinant))
        };
        let (mut low, mut high) = (0.0, 1.0);
        let sign = at(low)?.2 > 0.0;
        if (at(high)?.2 > 0.0) == sign {
            return None;
        }
        for _ in 0..52 {
            let middle = 0.5 * (low + high);
            if (at(middle)?.2 > 0.0) == sign { low = middle } else { high = middle }
        }
        let (q, inputs, _) = at(low)?;
        Some(Target { kind: Kind::Boundary, inputs, joints: Some(self.model.wrapped(&q)) })
    }

    /// A reachable target with its lengths and numbers times [`FAR`].
    fn far(&mut self) -> Option<Target> {
        let mut target = self.reachable(Kind::Far, None)?;
        for (value, input) in target.inputs.iter_mut().zip(&self.model.system.inputs) {
            if !input.positive && input.quantity != Quantity::Angle {
                *value *= FAR;
            }
        }
        Some(Target { joints: None, ..target })
    }

    /// The next stratum at the next distance: on it, then 10^-k to either side.
    fn stratum(&mut self) -> Option<Target> {
        if self.strata.is_empty() {
            return None;
        }
        let (text, factors) = self.strata[self.strata_done % self.strata.len()].clone();
        let turn = (self.strata_done / self.strata.len()) % (2 * DECADES + 1);
        self.strata_done += 1;
        let (share, kind) = offset(turn);
        let kind = Kind::Stratum(format!("{text} = {kind}"));
        let found = (0..DRAWS).find_map(|_| {
            let (q, start) = (self.joints(), self.inputs());
            self.on_stratum(&factors, share, &q, &start)
        });
        if let Some((inputs, joints)) = found {
            return Some(Target { kind, inputs, joints: Some(joints) });
        }
        let inputs = self.beyond_reach(&factors, share)?;
        Some(Target { kind, inputs, joints: None })
    }

    /// Inputs where each factor is `share` of its typical size, reachable or not.
    fn beyond_reach(&mut self, factors: &[Expression], share: f64) -> Option<Vec<f64>> {
        let start = self.reachable(Kind::Random, None)?.inputs;
        let scales: Vec<f64> = (0..start.len()).map(|input| self.model.input_size(input)).collect();
        let (mut inputs, norm) = newton(start, &scales, &|x| self.misses(factors, share, x));
        if share == 0.0 {
            for (value, scale) in inputs.iter_mut().zip(&scales) {
                *value = if value.abs() <= WITNESS.near * scale { 0.0 } else { *value };
            }
        }
        let allowed =
            self.model.system.inputs.iter().zip(&inputs).all(|(input, value)| !input.positive || *value > 0.0);
        (allowed && norm <= WITNESS.exact).then_some(inputs)
    }

    /// The difference of each factor from `share` of its typical size, relative to that size.
    fn misses(&self, factors: &[Expression], share: f64, inputs: &[f64]) -> Vec<f64> {
        let miss = |factor: &Expression| {
            let (value, size) = self.model.factor(factor, inputs);
            value / size - share
        };
        factors.iter().map(miss).collect()
    }

    /// Inputs and joints near the given ones where the equations hold and each factor is `share` of its typical size.
    fn on_stratum(&self, factors: &[Expression], share: f64, q: &[f64], start: &[f64]) -> Option<(Vec<f64>, Vec<f64>)> {
        let mut start = start.to_vec();
        let mut pinned = Vec::new();
        for input in factors.iter().filter_map(|factor| self.single_input(factor)) {
            start[input] = share * self.model.input_size(input);
            pinned.push(input);
        }
        let (inputs, joints) = self.descend(factors, share, q, &start, &pinned)?;
        let tiny = |&input: &usize| inputs[input].abs() <= WITNESS.near * self.model.input_size(input);
        let zeros: Vec<usize> = (0..inputs.len()).filter(|input| !pinned.contains(input)).filter(tiny).collect();
        if share != 0.0 || zeros.is_empty() {
            return Some((inputs, joints));
        }
        let snapped = replaced(&inputs, &zeros, &vec![0.0; zeros.len()]);
        pinned.extend(zeros);
        self.descend(factors, share, &joints, &snapped, &pinned).or(Some((inputs, joints)))
    }

    fn descend(
        &self,
        factors: &[Expression],
        share: f64,
        q: &[f64],
        start: &[f64],
        pinned: &[usize],
    ) -> Option<(Vec<f64>, Vec<f64>)> {
        let model = self.model;
        let variables: Vec<usize> = (0..start.len()).filter(|input| !pinned.contains(input)).collect();
        let mut scales: Vec<f64> = variables.iter().map(|&input| model.input_size(input)).collect();
        scales.extend(model.joint_sizes(start));
        let mut first: Vec<f64> = variables.iter().map(|&input| start[input]).collect();
        first.extend(q);
        let place = |x: &[f64]| (replaced(start, &variables, x), x[variables.len()..].to_vec());
        let residual = |x: &[f64]| {
            let (inputs, joints) = place(x);
            let mut values = model.shares(&inputs, &joints);
            values.extend(self.misses(factors, share, &inputs));
            values
        };
        let (x, norm) = newton(first, &scales, &residual);
        let (inputs, joints) = place(&x);
        let joints = model.wrapped(&joints);
        let inputs = (norm <= WITNESS.exact).then(|| model.reached(inputs, &joints)).flatten()?;
        Some((inputs, joints))
    }

    /// The input that is equal to a factor, if there is one.
    fn single_input(&self, factor: &Expression) -> Option<usize> {
        let Expression::Name(name) = factor else { return None };
        let parameter = self.model.system.parameters.iter().find(|parameter| parameter.name == *name)?;
        match parameter.source {
            ParameterSource::Input(index) => Some(index),
            _ => None,
        }
    }
}

/// The fraction of a factor's size for a turn, and its text: 0, then plus and minus each 10^-k, large and small in alternation.
fn offset(turn: usize) -> (f64, String) {
    if turn == 0 {
        return (0.0, "0".to_owned());
    }
    let k = 1 + (5 * ((turn - 1) / 2)) % DECADES;
    let (sign, text) = if turn % 2 == 1 { (1.0, "") } else { (-1.0, "-") };
    (sign * 10.0_f64.powi(-(k as i32)), format!("{text}1e-{k}"))
}

/// Every factor of a guard alone, and those that vanish together on a case. Factors with symbols that a stratum introduced are left out, because these are not
/// parameters of the system.
fn strata(model: &Model<'_>, program: &Program) -> Vec<(String, Vec<Expression>)> {
    let known = |factor: &Expression| {
        let parameters = &model.system.parameters;
        factor.names().iter().all(|name| parameters.iter().any(|parameter| parameter.name == *name))
    };
    let read = |text: &str| parse(text).ok().filter(known);
    let mut found: Vec<(String, Vec<Expression>)> = Vec::new();
    let mut add = |texts: Vec<&str>| {
        let label = texts.join(", ");
        let factors: Option<Vec<Expression>> = texts.iter().map(|text| read(text)).collect();
        if let Some(factors) = factors.filter(|_| !label.is_empty() && !found.iter().any(|(other, _)| *other == label))
        {
            found.push((label, factors));
        }
    };
    for case in program.cases() {
        case.guards.iter().for_each(|guard| add(vec![&guard.text]));
        add(case.guards.iter().filter(|guard| guard.near).map(|guard| guard.text.as_str()).collect());
    }
    found
}
