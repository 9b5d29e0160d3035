//! Running a [`Program`]: every chart that applies, every root, each candidate polished, measured and merged.

use serde::Serialize;

use super::instruction::{Instruction, Operand, Operation};
use super::program::{Chart, Guard, JointValue, Program, Rule, Step};
use super::{BLUR, MERGE, NEAR, PIVOT, ROUNDING, TINY, refine};
use crate::{Error, ErrorKind, Result, roots};

/// One answer of a program.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Solution {
    /// Joint values in the program's joint order: radians in (-pi, pi], lengths in the program's unit.
    pub q: Vec<f64>,
    /// The largest magnitude among the equations' values at `q`, in the equations' own unit.
    pub residual: f64,
    /// Which chart and which roots gave it: the same number for the same branch at every target.
    pub branch: usize,
    /// Joints (indices) that may take any value here: this is one member of a family.
    pub free: Vec<usize>,
    /// Whether the source document would choose this one.
    pub chosen: bool,
}

/// A solution with the largest share of an equation's value in its scale.
struct Answer {
    solution: Solution,
    relative: f64,
}

/// The values that operands refer to.
pub(super) struct Frame<'a> {
    pub parameters: &'a [f64],
    pub magnitude: f64,
    pub unknowns: Vec<f64>,
    pub registers: Vec<f64>,
}

impl Frame<'_> {
    pub fn value(&self, operand: Operand) -> f64 {
        match operand {
            Operand::Constant(value) => value,
            Operand::Parameter(index) => self.parameters[index],
            Operand::Unknown(index) => self.unknowns[index],
            Operand::Register(index) => self.registers[index],
            Operand::Magnitude => self.magnitude,
        }
    }

    pub fn run(&mut self, code: &[Instruction]) {
        for instruction in code {
            let result = match instruction.operation {
                Operation::Add(a, b) => self.value(a) + self.value(b),
                Operation::Sub(a, b) => self.value(a) - self.value(b),
                Operation::Mul(a, b) => self.value(a) * self.value(b),
                Operation::Div(a, b) => self.value(a) / self.value(b),
                Operation::Abs(a) => self.value(a).abs(),
            };
            self.registers.truncate(instruction.target);
            self.registers.push(result);
        }
    }

    fn holds(&self, guard: &Guard) -> bool {
        let (value, scale) = (self.value(guard.value).abs(), self.value(guard.scale));
        if guard.near { value <= NEAR * scale } else { value > TINY * scale }
    }
}

impl Program {
    /// All real solutions for `target` (one number an input, in order and unit of [`Program::inputs`]), by branch. Empty when the
    /// target is unreachable. The program must be valid ([`Program::validate`]).
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a wrong count of numbers, NaN or infinity; [`ErrorKind::Unsupported`] when the target lies on a
    /// stratum that could not be derived.
    pub fn solve(&self, target: &[f64]) -> Result<Vec<Solution>> {
        self.check_target(target)?;
        let parameters = self.parameter_values(target);
        let largest = parameters.iter().fold(self.scale, |largest, value| largest.max(value.abs()));
        let mut answers = Vec::new();
        for chart in &self.charts {
            let unknowns = vec![0.0; self.unknowns.len()];
            let mut frame = Frame { parameters: &parameters, magnitude: largest, unknowns, registers: Vec::new() };
            frame.run(&chart.guard_code);
            if chart.guards.iter().all(|guard| frame.holds(guard)) {
                if chart.open {
                    let text = format!("the target lies on `{}`, a stratum that could not be derived", chart.label);
                    return Err(Error::new(ErrorKind::Unsupported, text));
                }
                self.walk(chart, 0, chart.first_branch, &mut frame, &mut answers);
            }
        }
        let mut answers: Vec<Solution> = answers.into_iter().map(|answer| answer.solution).collect();
        answers.sort_by_key(|answer| answer.branch);
        self.mark_choice(&mut answers);
        Ok(answers)
    }

    fn check_target(&self, target: &[f64]) -> Result<()> {
        let names = || self.inputs.iter().map(|input| input.name.as_str()).collect::<Vec<_>>().join(", ");
        if target.len() != self.inputs.len() {
            let text = format!("{} numbers given, {} expected: {}", target.len(), self.inputs.len(), names());
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        match self.inputs.iter().zip(target).find(|(_, value)| !value.is_finite()) {
            Some((input, value)) => {
                let text = format!("`{}` is {value}; give a finite number", input.name);
                Err(Error::new(ErrorKind::BadValue, text))
            }
            None => Ok(()),
        }
    }

    /// The parameters' values for a checked target.
    pub(super) fn parameter_values(&self, target: &[f64]) -> Vec<f64> {
        let mut values: Vec<f64> = Vec::with_capacity(self.parameters.len());
        for parameter in &self.parameters {
            let value = match &parameter.rule {
                Rule::Input(index) => target[*index],
                Rule::Cosine(index) => target[*index].cos(),
                Rule::Sine(index) => target[*index].sin(),
                Rule::Root { code, value } => {
                    let mut frame =
                        Frame { parameters: &values, magnitude: 0.0, unknowns: Vec::new(), registers: Vec::new() };
                    frame.run(code);
                    frame.value(*value).max(0.0).sqrt()
                }
            };
            values.push(value);
        }
        values
    }

    /// Runs the steps of `chart` from number `next` on, once for each choice of roots.
    fn walk(&self, chart: &Chart, next: usize, branch: usize, frame: &mut Frame<'_>, answers: &mut Vec<Answer>) {
        let Some(step) = chart.steps.get(next) else {
            return self.finish(chart, branch, frame, answers);
        };
        match step {
            Step::Compute(code) => {
                frame.run(code);
                self.walk(chart, next + 1, branch, frame, answers);
            }
            Step::Set { unknown, value } => {
                frame.unknowns[*unknown] = frame.value(*value);
                self.walk(chart, next + 1, branch, frame, answers);
            }
            Step::Roots { unknown, polynomials } => {
                let stride: usize = chart.steps[next + 1..].iter().map(Step::slots).product();
                let registers = frame.registers.len();
                for (index, root) in self.find_roots(*unknown, polynomials, frame).as_slice().iter().enumerate() {
                    frame.unknowns[*unknown] = *root;
                    frame.registers.truncate(registers);
                    self.walk(chart, next + 1, branch + index * stride, frame, answers);
                }
            }
        }
    }

    /// The real roots of the first polynomial whose leading coefficient is not negligible.
    fn find_roots(&self, unknown: usize, polynomials: &[Vec<Operand>], frame: &Frame<'_>) -> roots::Roots {
        let typical = if self.is_plain(unknown) { frame.magnitude } else { 1.0 };
        let values = |coefficients: &[Operand]| {
            let mut line = [0.0; roots::MAX_DEGREE + 1];
            for (slot, operand) in line.iter_mut().zip(coefficients) {
                *slot = frame.value(*operand);
            }
            line
        };
        let (last, earlier) = polynomials.split_last().expect("a valid program has a polynomial for each root step");
        for coefficients in earlier {
            let line = values(coefficients);
            let line = &line[..coefficients.len()];
            let largest = line.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
            if line.last().is_some_and(|lead| lead.abs() > PIVOT * largest) {
                return roots::real_roots(line, typical);
            }
        }
        roots::real_roots(&values(last)[..last.len()], typical)
    }

    /// Whether an unknown is a joint's value itself, not a cosine or sine: its typical size is the length scale, not one.
    pub(crate) fn is_plain(&self, unknown: usize) -> bool {
        self.joints.iter().any(|joint| joint.value == JointValue::Plain(unknown))
    }

    /// Turns the unknowns into joints, polishes them, and keeps what solves the equations. The frame is left as it was.
    fn finish(&self, chart: &Chart, branch: usize, frame: &mut Frame<'_>, answers: &mut Vec<Answer>) {
        let unknowns = frame.unknowns.clone();
        let mut q: Vec<f64> = self.joints.iter().map(|joint| joint_value(joint.value, &unknowns)).collect();
        if chart.free.is_empty() {
            refine::polish(self, &mut q, frame);
            for mut start in self.around(&q, frame) {
                refine::polish(self, &mut start, frame);
                self.keep(chart, branch, start, frame, answers);
            }
        }
        self.keep(chart, branch, q, frame, answers);
        frame.unknowns = unknowns;
    }

    /// Where a candidate stands at a singular configuration and misses the equations by little, it is a double root that rounding
    /// made of two: points to either side of it, as far as the square root of the miss leads.
    fn around(&self, q: &[f64], frame: &mut Frame<'_>) -> Vec<Vec<f64>> {
        let miss = refine::measure(self, q, frame).relative;
        if !(ROUNDING..=NEAR).contains(&miss) {
            return Vec::new();
        }
        let moved = |(joint, sign): (usize, f64)| {
            let mut q = q.to_vec();
            let way = 2.0 * sign * miss.sqrt();
            q[joint] = match self.joints[joint].value {
                JointValue::Angle { .. } => refine::wrap(q[joint] + way),
                JointValue::Plain(_) => q[joint] + way * self.scale.max(q[joint].abs()),
            };
            q
        };
        (0..q.len()).flat_map(|joint| [(joint, -1.0), (joint, 1.0)]).map(moved).collect()
    }

    /// Adds an answer if the equations hold, in place of a worse equal one. A second root of a double one takes the next number.
    fn keep(&self, chart: &Chart, branch: usize, q: Vec<f64>, frame: &mut Frame<'_>, answers: &mut Vec<Answer>) {
        let fit = refine::measure(self, &q, frame);
        if !fit.accepted {
            return;
        }
        let taken = |branch: &usize| answers.iter().any(|answer| answer.solution.branch == *branch);
        let last = chart.first_branch + Program::branches(chart);
        let branch = (branch..last).find(|branch| !taken(branch)).unwrap_or(branch);
        let solution = Solution { q, residual: fit.residual, branch, free: chart.free.clone(), chosen: false };
        let mut answer = Answer { solution, relative: fit.relative };
        let same: Vec<bool> =
            answers.iter().map(|other| self.same(other, &answer) || self.blurred(other, &answer, frame)).collect();
        let doubles = || answers.iter().zip(&same).filter(|(_, same)| **same).map(|(other, _)| other);
        if doubles().any(|other| other.relative <= answer.relative) {
            return;
        }
        if let Some(other) = doubles().next() {
            answer.solution.branch = other.solution.branch;
        }
        let mut same = same.into_iter();
        answers.retain(|_| !same.next().unwrap_or(false));
        if answers.len() < self.capacity {
            answers.push(answer);
        }
    }

    /// Whether two answers are one within [`MERGE`], joints left out that are free in either.
    fn same(&self, a: &Answer, b: &Answer) -> bool {
        self.close(&a.solution, &b.solution, MERGE)
    }

    /// Whether two answers next to each other are one at a singular configuration, where the equations leave the joints open
    /// beyond [`MERGE`]: half-way between them the equations hold as well as at the worse of the two, or within rounding.
    fn blurred(&self, a: &Answer, b: &Answer, frame: &mut Frame<'_>) -> bool {
        let isolated = a.solution.free.is_empty() && b.solution.free.is_empty();
        if !isolated || !self.close(&a.solution, &b.solution, BLUR) {
            return false;
        }
        let way = self.differences(&a.solution.q, &b.solution.q);
        let middle: Vec<f64> = b.solution.q.iter().zip(way).map(|(q, way)| q + 0.5 * way).collect();
        refine::measure(self, &middle, frame).relative <= ROUNDING.max(a.relative).max(b.relative)
    }

    fn close(&self, a: &Solution, b: &Solution, tolerance: f64) -> bool {
        let close = |(index, difference): (usize, f64)| match self.joints[index].value {
            _ if a.free.contains(&index) || b.free.contains(&index) => true,
            JointValue::Angle { .. } => difference.abs() <= tolerance,
            JointValue::Plain(_) => difference.abs() <= tolerance * self.scale.max(a.q[index].abs()),
        };
        self.differences(&a.q, &b.q).into_iter().enumerate().all(close)
    }

    /// `a - b`, for angles by the shorter way round.
    fn differences(&self, a: &[f64], b: &[f64]) -> Vec<f64> {
        let turn = std::f64::consts::TAU;
        let one = |(joint, (a, b)): (&super::Joint, (&f64, &f64))| match joint.value {
            JointValue::Angle { .. } => a - b - turn * ((a - b) / turn).round(),
            JointValue::Plain(_) => a - b,
        };
        self.joints.iter().zip(a.iter().zip(b)).map(one).collect()
    }

    fn mark_choice(&self, answers: &mut [Solution]) {
        let Some(preference) = self.preference else { return };
        let sign = if preference.greatest { -1.0 } else { 1.0 };
        let value = |answer: &Solution| {
            let mut unknowns = vec![0.0; self.unknowns.len()];
            refine::unknowns_of(self, &answer.q, &mut unknowns);
            sign * unknowns[preference.unknown]
        };
        let least = answers.iter().map(value).fold(f64::INFINITY, f64::min);
        for answer in answers {
            answer.chosen = value(answer) <= least + MERGE;
        }
    }
}

fn joint_value(value: JointValue, unknowns: &[f64]) -> f64 {
    match value {
        JointValue::Angle { cosine, sine } => half_open(unknowns[sine].atan2(unknowns[cosine])),
        JointValue::Plain(unknown) => unknowns[unknown],
    }
}

/// The angle in (-pi, pi]: -pi, which atan2 gives for a negative zero sine, becomes pi.
pub(super) fn half_open(angle: f64) -> f64 {
    if angle <= -std::f64::consts::PI { angle + std::f64::consts::TAU } else { angle }
}
