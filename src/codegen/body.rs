//! Bodies of the printed functions: charts, parameters, and the equations with their derivatives.

use super::demand::{Demand, ParameterDemand};
use super::names::Names;
use super::printer::{INDENT, Language, Printer, number};
use crate::solver::{Chart, Guard, JointValue, Operand, Program, Rule, Step};

/// What all bodies of one file share.
pub(super) struct Scene<'a> {
    pub program: &'a Program,
    pub language: &'a dyn Language,
    pub names: Names,
    /// Unknowns that the equations read and that are no joint's: charts hand their values over.
    pub extra: Vec<usize>,
}

impl Scene<'_> {
    fn printer(&self, demand: Demand) -> Printer<'_> {
        Printer::new(self.language, &self.names, demand)
    }

    /// The unknowns that a chart must find.
    pub fn wanted(&self) -> Vec<usize> {
        let joints = self.program.joints.iter().flat_map(|joint| match joint.value {
            JointValue::Angle { cosine, sine } => vec![cosine, sine],
            JointValue::Plain(unknown) => vec![unknown],
        });
        joints.chain(self.extra.iter().copied()).collect()
    }

    /// Declarations of the parameters that are computed.
    pub fn parameters(&self, demand: &ParameterDemand) -> Vec<String> {
        let mut lines = Vec::new();
        let mut registers = 0;
        for (index, parameter) in self.program.parameters.iter().enumerate().filter(|(i, _)| demand.computed[*i]) {
            let value = match &parameter.rule {
                Rule::Input(input) => format!("target[{input}]"),
                Rule::Cosine(input) => self.language.call("cos", &format!("target[{input}]")),
                Rule::Sine(input) => self.language.call("sin", &format!("target[{input}]")),
                Rule::Root { code, value } => {
                    let mut printer = self.printer(Demand::of_code(code, [value])).among_parameters(registers);
                    lines.extend(printer.code(code));
                    registers += code.len();
                    let square = printer.operand(*value);
                    self.language.call("sqrt", &self.language.greater(&square, "0.0"))
                }
            };
            lines.push(self.language.declare(&self.names.parameters[index], &value));
        }
        lines
    }

    /// The expression of the magnitude over the parameters' local names.
    pub fn magnitude(&self) -> String {
        let scale = number(self.program.scale);
        self.names.parameters.iter().fold(scale, |so_far, name| {
            let size = self.language.call("abs", name);
            self.language.greater(&so_far, &size)
        })
    }

    /// The unknown at joint values `q`, as an expression; the last joint that has it counts.
    pub fn unknown_at(&self, unknown: usize) -> Option<String> {
        let of_joint = |(index, joint): (usize, &crate::solver::Joint)| match joint.value {
            JointValue::Angle { sine, .. } if sine == unknown => {
                Some(self.language.call("sin", &format!("q[{index}]")))
            }
            JointValue::Angle { cosine, .. } if cosine == unknown => {
                Some(self.language.call("cos", &format!("q[{index}]")))
            }
            JointValue::Plain(plain) if plain == unknown => Some(format!("q[{index}]")),
            _ => None,
        };
        self.program.joints.iter().enumerate().rev().find_map(of_joint)
    }

    /// Code of the checks as far as `rows` ask for it, and the rows themselves as lists of expressions.
    pub fn checks(&self, rows: &[&[Operand]]) -> (Vec<String>, Vec<Vec<String>>) {
        let code = &self.program.checks.code;
        let mut printer = self.printer(Demand::of_code(code, rows.iter().copied().flatten()));
        let mut lines = Vec::new();
        for unknown in (0..self.program.unknowns.len()).filter(|&i| printer.demand().wants_unknown(i)) {
            let place = self.extra.iter().position(|&extra| extra == unknown);
            let value = place.map(|place| format!("extra[{place}]")).or_else(|| self.unknown_at(unknown));
            let value = value.expect("an unknown that is no joint's is among the extra ones");
            lines.push(self.language.declare(&self.names.unknowns[unknown], &value));
        }
        lines.extend(printer.code(code));
        let rows = rows.iter().map(|row| row.iter().map(|&operand| printer.operand(operand)).collect()).collect();
        (lines, rows)
    }

    /// The body of a chart, without indentation; an open chart's is its condition alone.
    pub fn chart(&self, chart: &Chart) -> Vec<String> {
        let mut printer = self.printer(Demand::of_chart(self.program, chart, &self.wanted()));
        let mut lines = printer.code(&chart.guard_code);
        if !chart.guards.is_empty() {
            let condition = self.condition(&chart.guards, &mut printer);
            lines.extend(self.language.leave_unless(&condition));
        }
        let mut walk = Walk { scene: self, chart, lines, depth: 0, branch: Vec::new() };
        walk.steps(&mut printer);
        walk.lines
    }

    /// The code before an open chart's condition, and the condition.
    pub fn open_chart(&self, chart: &Chart) -> (Vec<String>, String) {
        let mut printer = self.printer(Demand::of_chart(self.program, chart, &[]));
        let lines = printer.code(&chart.guard_code);
        (lines, self.condition(&chart.guards, &mut printer))
    }

    fn condition(&self, guards: &[Guard], printer: &mut Printer<'_>) -> String {
        let terms: Vec<String> = guards
            .iter()
            .map(|guard| {
                let (value, scale) = (printer.operand(guard.value), printer.operand(guard.scale));
                let test = if guard.near { "is_near" } else { "is_away" };
                format!("{test}({value}, {scale})")
            })
            .collect();
        if terms.is_empty() { "true".to_owned() } else { terms.join(" && ") }
    }
}

/// The steps of a chart on their way to text.
struct Walk<'a> {
    scene: &'a Scene<'a>,
    chart: &'a Chart,
    lines: Vec<String>,
    depth: usize,
    /// Terms of the branch number.
    branch: Vec<String>,
}

impl Walk<'_> {
    fn push(&mut self, lines: Vec<String>) {
        let indent = INDENT.repeat(self.depth);
        self.lines.extend(lines.into_iter().map(|line| format!("{indent}{line}")));
    }

    fn steps(&mut self, printer: &mut Printer<'_>) {
        if self.chart.first_branch > 0 {
            self.branch.push(self.chart.first_branch.to_string());
        }
        for (index, step) in self.chart.steps.iter().enumerate() {
            match step {
                Step::Compute(code) => {
                    let lines = printer.code(code);
                    self.push(lines);
                }
                Step::Set { unknown, value } if printer.demand().wants_unknown(*unknown) => {
                    let value = printer.operand(*value);
                    self.push(vec![printer.language().declare(&printer.names().unknowns[*unknown], &value)]);
                }
                Step::Set { .. } => {}
                Step::Sample { .. } => {}
                Step::Roots { unknown, polynomials, .. } => self.roots(index, *unknown, polynomials, printer),
            }
        }
        self.finish(printer);
        for depth in (0..self.depth).rev() {
            self.lines.push(format!("{}}}", INDENT.repeat(depth)));
        }
    }

    fn roots(&mut self, index: usize, unknown: usize, polynomials: &[Vec<Operand>], printer: &mut Printer<'_>) {
        let language = printer.language();
        let lists: Vec<Vec<String>> =
            polynomials.iter().map(|list| list.iter().map(|&c| printer.operand(c)).collect()).collect();
        let lines = printer.settle();
        self.push(lines);
        let typical = if self.scene.program.is_plain(unknown) { language.field("magnitude") } else { number(1.0) };
        self.push(language.find_roots(self.depth, &lists, &typical));
        let name = printer.demand().wants_unknown(unknown).then(|| printer.names().unknowns[unknown].as_str());
        self.push(language.open_loop(self.depth, name));
        let stride: usize = self.chart.steps[index + 1..].iter().map(Step::slots).product();
        self.branch.push(if stride == 1 { format!("i{}", self.depth) } else { format!("{stride} * i{}", self.depth) });
        self.depth += 1;
    }

    fn finish(&mut self, printer: &Printer<'_>) {
        let (scene, names) = (self.scene, printer.names());
        let q: Vec<String> = scene.program.joints.iter().map(|joint| joint_value(joint.value, names)).collect();
        let free: Vec<String> = (0..q.len()).map(|joint| self.chart.free.contains(&joint).to_string()).collect();
        let free = if self.chart.free.is_empty() { Vec::new() } else { free };
        let extra: Vec<String> = scene.extra.iter().map(|&unknown| names.unknowns[unknown].clone()).collect();
        let branch = if self.branch.is_empty() { "0".to_owned() } else { self.branch.join(" + ") };
        let last = self.chart.first_branch + Program::branches(self.chart);
        self.push(printer.language().finish(&format!("{branch}, {last}"), &q, &free, &extra));
    }
}

fn joint_value(value: JointValue, names: &Names) -> String {
    match value {
        JointValue::Angle { cosine, sine } => format!("angle({}, {})", names.unknowns[cosine], names.unknowns[sine]),
        JointValue::Plain(unknown) => names.unknowns[unknown].clone(),
    }
}
