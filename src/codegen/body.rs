//! Bodies of the printed functions: charts, parameters, and the equations with their derivatives.

use super::demand::{Demand, ParameterDemand};
use super::names::Names;
use super::outline::has_families;
use super::printer::{Finish, INDENT, Language, Printer, State, number};
use super::samples::Table;
use super::six_axes;
use crate::solver::template::SixAxes;
use crate::solver::{Block, Chart, Guard, JointValue, Operand, Program, Rule, Step, square};

/// What all bodies of one file share.
pub(super) struct Scene<'a> {
    pub program: &'a Program,
    pub language: &'a dyn Language,
    pub names: Names,
    /// Unknowns that the equations read and that are no joint's: charts hand their values over.
    pub extra: Vec<usize>,
    /// Values at which charts put free joints.
    pub tables: Vec<Table>,
}

impl Scene<'_> {
    fn printer(&self, demand: Demand) -> Printer<'_> {
        Printer::new(self.language, &self.names, demand)
    }

    /// Whether answers can be members of families.
    pub fn has_families(&self) -> bool {
        has_families(self.program)
    }

    /// By unknown: whether a block before the one with this index finds it.
    pub fn known_before(&self, block: usize) -> Vec<bool> {
        let mut known = vec![false; self.program.unknowns.len()];
        for chart in self.program.blocks[..block].iter().flat_map(|block| &block.charts) {
            chart.steps.iter().flat_map(found).for_each(|unknown| known[unknown] = true);
        }
        known
    }

    /// The unknowns that the block with this index must find: of those of answers and of what later blocks read, its own.
    pub fn wanted_of(&self, block: usize) -> Vec<usize> {
        let (before, after) = (self.known_before(block), self.known_before(block + 1));
        let mut wanted = vec![false; self.program.unknowns.len()];
        self.wanted().into_iter().for_each(|unknown| wanted[unknown] = true);
        for later in self.program.blocks[block + 1..].iter().rev() {
            let own: Vec<usize> = (0..wanted.len()).filter(|&unknown| wanted[unknown]).collect();
            for demand in self.block_demands(later, &own) {
                (0..wanted.len()).for_each(|unknown| wanted[unknown] |= demand.wants_unknown(unknown));
            }
        }
        (0..wanted.len()).filter(|&unknown| wanted[unknown] && after[unknown] && !before[unknown]).collect()
    }

    /// What a block's code and charts ask for when these unknowns are wanted of it.
    pub fn block_demands(&self, block: &Block, wanted: &[usize]) -> Vec<Demand> {
        let mut demands = vec![Demand::of_block(self.program, block, wanted)];
        for chart in &block.charts {
            demands.push(Demand::of_chart(self.program, chart, if chart.open { &[] } else { wanted }));
            demands.push(Demand::of_claim(chart));
        }
        demands
    }

    /// Unknowns that go from block to block.
    pub fn passed(&self) -> Vec<usize> {
        (0..self.program.blocks.len() - 1).flat_map(|block| self.wanted_of(block)).collect()
    }

    /// Names of the angles that go from block to block.
    pub fn passed_angles(&self) -> Vec<String> {
        let is_passed = |&joint: &usize| {
            let is_angle = matches!(self.program.joints[joint].value, JointValue::Angle { .. });
            is_angle && self.finder(joint) + 1 < self.program.blocks.len()
        };
        (0..self.program.joints.len()).filter(is_passed).map(|joint| format!("q{joint}")).collect()
    }

    /// The unknowns that answers need.
    pub fn wanted(&self) -> Vec<usize> {
        let joints = self.program.joints.iter().flat_map(|joint| match joint.value {
            JointValue::Angle { cosine, sine } => vec![cosine, sine],
            JointValue::Plain(unknown) => vec![unknown],
        });
        joints.chain(self.extra.iter().copied()).collect()
    }

    /// The unknowns that the equations can read, each once.
    pub fn places(&self) -> Vec<usize> {
        let mut places: Vec<usize> = Vec::new();
        for unknown in self.wanted() {
            if !places.contains(&unknown) {
                places.push(unknown);
            }
        }
        places
    }

    /// The values of these unknowns at joint values `q`.
    pub fn placed(&self) -> Vec<String> {
        let value = |&unknown: &usize| {
            let place = self.extra.iter().position(|&extra| extra == unknown);
            let value = place.map(|place| format!("extra[{place}]")).or_else(|| self.unknown_at(unknown));
            value.expect("an unknown that is no joint's is among the extra ones")
        };
        self.places().iter().map(value).collect()
    }

    /// By joint that is an angle: where its cosine and its sine stand among the places.
    pub fn circles(&self) -> Vec<[usize; 2]> {
        let circle = |joint: &crate::solver::Joint| match joint.value {
            JointValue::Angle { cosine, sine } => Some([self.place(cosine), self.place(sine)]),
            JointValue::Plain(_) => None,
        };
        self.program.joints.iter().filter_map(circle).collect()
    }

    fn place(&self, unknown: usize) -> usize {
        self.places().iter().position(|&other| other == unknown).expect("a joint's unknowns have places")
    }

    /// The value of the joint with this index behind the last block.
    fn joint_value(&self, index: usize) -> String {
        match self.program.joints[index].value {
            JointValue::Angle { .. } if self.finder(index) + 1 < self.program.blocks.len() => {
                self.language.known(&format!("q{index}"))
            }
            JointValue::Angle { cosine, sine } => {
                format!("angle(at[{}], at[{}])", self.place(cosine), self.place(sine))
            }
            JointValue::Plain(unknown) => format!("at[{}]", self.place(unknown)),
        }
    }

    /// The index of the block that finds the joint with this index.
    fn finder(&self, joint: usize) -> usize {
        let unknowns = self.program.joints[joint].value.unknowns();
        let known = |block: usize| unknowns.iter().all(|&unknown| self.known_before(block + 1)[unknown]);
        (0..self.program.blocks.len()).find(|&block| known(block)).unwrap_or(self.program.blocks.len() - 1)
    }

    /// The joints, those that are found last first: in these answers differ most.
    pub fn last_first(&self) -> Vec<usize> {
        let mut joints: Vec<usize> = (0..self.program.joints.len()).collect();
        joints.sort_by_key(|&joint| std::cmp::Reverse(self.finder(joint)));
        joints
    }

    /// The angles that the block with this index finds: their names, and their values as expressions.
    fn angles(&self, block: usize, printer: &Printer<'_>) -> Vec<(String, String)> {
        let found = (0..self.program.joints.len()).filter(|&joint| self.finder(joint) == block);
        let angle = |joint: usize| match self.program.joints[joint].value {
            JointValue::Angle { cosine, sine } => {
                let value = format!("angle({}, {})", printer.unknown(cosine), printer.unknown(sine));
                Some((format!("q{joint}"), value))
            }
            JointValue::Plain(_) => None,
        };
        found.filter_map(angle).collect()
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
        for (place, &unknown) in self.places().iter().enumerate().filter(|(_, i)| printer.demand().wants_unknown(**i)) {
            lines.push(self.language.declare(&self.names.unknowns[unknown], &format!("at[{place}]")));
        }
        lines.extend(printer.code(code));
        let rows = rows.iter().map(|row| row.iter().map(|&operand| printer.operand(operand)).collect()).collect();
        (lines, rows)
    }

    /// A printer for a chart of the block with this index, or for its code if nothing is `shared` yet.
    fn block_printer(&self, block: usize, demand: Demand, shared: usize) -> Printer<'_> {
        self.printer(demand).within_block(self.known_before(block), shared)
    }

    /// The code of the block with this index, and the registers that its charts read.
    pub fn block_code(&self, index: usize) -> (Vec<String>, Vec<String>) {
        let (block, wanted) = (&self.program.blocks[index], self.wanted_of(index));
        let demand = Demand::of_block(self.program, block, &wanted);
        let demands = self.block_demands(block, &wanted);
        let charts = &demands[1..];
        let read = |register: &usize| charts.iter().any(|demand| demand.register(*register) > 0);
        let shared = (0..block.code.len()).filter(read).map(|register| format!("r{register}")).collect();
        (self.block_printer(index, demand, 0).code(&block.code), shared)
    }

    /// The body of a chart of the block with this index, without indentation; an open chart's is its condition alone.
    pub fn chart(&self, index: usize, chart: &Chart) -> Vec<String> {
        let (block, wanted) = (&self.program.blocks[index], self.wanted_of(index));
        let wanted = if index + 1 < self.program.blocks.len() { wanted } else { self.wanted() };
        let demand = Demand::of_chart(self.program, chart, &wanted);
        let mut printer = self.block_printer(index, demand, block.code.len());
        let mut lines = printer.code(&chart.guard_code);
        if !chart.guards.is_empty() {
            let condition = self.condition(&chart.guards, &mut printer);
            lines.extend(self.language.leave_unless(&condition));
        }
        let (finds_roots, branch, loose, lost) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        let mut walk = Walk { scene: self, block: index, chart, lines, depth: 0, finds_roots, branch, loose, lost };
        walk.steps(&mut printer);
        walk.lines
    }

    /// The code before the condition of an open chart or one with a pivot, the condition, and the pivot.
    pub fn claim(&self, index: usize, chart: &Chart) -> (Vec<String>, String, String) {
        let shared = self.program.blocks[index].code.len();
        let mut printer = self.block_printer(index, Demand::of_claim(chart), shared);
        let lines = printer.code(&chart.guard_code);
        let condition = self.condition(&chart.guards, &mut printer);
        let value = chart.pivot.map_or_else(String::new, |pivot| printer.operand(pivot.value));
        (lines, condition, value)
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
    block: usize,
    chart: &'a Chart,
    lines: Vec<String>,
    depth: usize,
    /// By loop that is open: whether it goes over roots.
    finds_roots: Vec<bool>,
    /// Terms of the branch number.
    branch: Vec<String>,
    /// Joints that may be free at an answer, and the expression that tells.
    loose: Vec<(usize, String)>,
    /// Expressions that tell whether a candidate may have others next to it.
    lost: Vec<String>,
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
                Step::SixAxes(six) => {
                    self.six_axes(six, printer);
                    let stride: usize = self.chart.steps[index + 1..].iter().map(Step::slots).product();
                    self.branch.push(multiple(stride, &format!("i{}", self.depth)));
                    self.finds_roots.push(false);
                    self.depth += 1;
                }
                Step::Roots { unknown, polynomials, typical } => {
                    self.roots(*unknown, polynomials, *typical, printer);
                    let stride: usize = self.chart.steps[index + 1..].iter().map(Step::slots).product();
                    self.branch.push(multiple(stride, &format!("i{}", self.depth)));
                    self.finds_roots.push(true);
                    self.depth += 1;
                }
                Step::Sample { joint, values } => {
                    self.samples(*joint, values, printer);
                    self.finds_roots.push(false);
                    self.depth += 1;
                }
            }
        }
        if self.block + 1 < self.scene.program.blocks.len() {
            self.go_on(printer)
        } else {
            self.finish(printer)
        }
        for depth in (0..self.depth).rev() {
            self.lines.push(format!("{}}}", INDENT.repeat(depth)));
        }
    }

    fn roots(
        &mut self,
        unknown: usize,
        polynomials: &[Vec<Operand>],
        typical: Option<Operand>,
        printer: &mut Printer<'_>,
    ) {
        let language = printer.language();
        let usual = if self.scene.program.is_plain(unknown) { Operand::Magnitude } else { Operand::Constant(1.0) };
        let finds = match square(polynomials) {
            Some(constant) => {
                let (constant, typical) = (printer.operand(constant), printer.operand(typical.unwrap_or(usual)));
                language.find_square_roots(self.depth, &constant, &typical)
            }
            None => {
                let list = |list: &Vec<Operand>| list.iter().map(|&c| printer.operand(c)).collect();
                let lists: Vec<Vec<String>> = polynomials.iter().map(list).collect();
                let typical = printer.operand(typical.unwrap_or(usual));
                language.find_roots(self.depth, &lists, &typical)
            }
        };
        let lines = printer.settle();
        self.push(lines);
        self.push(finds);
        let name = printer.demand().wants_unknown(unknown).then(|| printer.names().unknowns[unknown].as_str());
        self.push(language.open_loop(self.depth, name));
    }

    fn samples(&mut self, joint: JointValue, values: &[f64], printer: &mut Printer<'_>) {
        let lines = printer.settle();
        self.push(lines);
        let name = |unknown: usize| {
            printer.demand().wants_unknown(unknown).then(|| printer.names().unknowns[unknown].as_str())
        };
        let names: Vec<Option<&str>> = joint.unknowns().into_iter().map(name).collect();
        let table = Table::new(joint, values);
        let place = self.scene.tables.iter().position(|other| *other == table);
        let number = 1 + place.expect("the tables are those of all steps");
        self.push(printer.language().open_samples(self.depth, &names, number, table.len()));
    }

    fn six_axes(&mut self, six: &SixAxes, printer: &mut Printer<'_>) {
        let (language, depth) = (printer.language(), self.depth);
        let target: Vec<String> = six.parts().target.iter().map(|&operand| printer.operand(operand)).collect();
        let lines = printer.settle();
        self.push(lines);
        let place = six_axes::steps(self.scene.program).iter().position(|other| std::ptr::eq(*other, six));
        let number = 1 + place.expect("the step is one of the program's");
        self.push(language.open_six_axes(depth, number, &target));
        self.lost.push(language.six_axes_lost(depth));
        for (place, joint) in six.parts().joints.iter().enumerate() {
            let value = language.six_axes_joint(depth, place);
            let values = match joint {
                JointValue::Angle { cosine, sine } => {
                    vec![(*cosine, language.call("cos", &value)), (*sine, language.call("sin", &value))]
                }
                JointValue::Plain(unknown) => vec![(*unknown, value)],
            };
            let wanted = values.into_iter().filter(|(unknown, _)| printer.demand().wants_unknown(*unknown));
            let lines = wanted.map(|(unknown, value)| language.declare(&printer.names().unknowns[unknown], &value));
            let lines: Vec<String> = lines.map(|line| format!("{INDENT}{line}")).collect();
            self.push(lines);
            let index = self.scene.program.joints.iter().position(|other| other.value == *joint);
            self.loose.extend(index.map(|index| (index, language.six_axes_free(depth, place))));
        }
    }

    /// The branch number so far and the end of the numbers of the first block's chart.
    fn numbers(&self, language: &dyn Language) -> [String; 2] {
        if self.block == 0 {
            let branch = if self.branch.is_empty() { "0".to_owned() } else { self.branch.join(" + ") };
            return [branch, (self.chart.first_branch + Program::branches(self.chart)).to_string()];
        }
        let radix = self.scene.program.blocks[self.block].branches();
        let before = multiple(radix, &language.known("branch"));
        let branch = [before].into_iter().chain(self.branch.iter().cloned()).collect::<Vec<_>>().join(" + ");
        [branch, multiple(radix, &language.known("last"))]
    }

    /// Whether roots on the way are close to one another, as an expression.
    fn close(&self, language: &dyn Language) -> String {
        let before = (self.block > 0).then(|| language.known("close"));
        let own = (0..self.depth).filter(|depth| self.finds_roots[*depth]).map(|depth| format!("roots{depth}.close"));
        let all: Vec<String> = before.into_iter().chain(own).chain(self.lost.iter().cloned()).collect();
        if all.is_empty() { "false".to_owned() } else { all.join(" || ") }
    }

    /// By joint whether it is free; empty when the chart adds none.
    fn free(&self, language: &dyn Language) -> Vec<String> {
        let usual = |joint: usize| match self.block {
            0 => "false".to_owned(),
            _ => language.known(&format!("free[{joint}]")),
        };
        let told = |joint: usize| self.loose.iter().find(|(index, _)| *index == joint).map(|(_, told)| told.clone());
        let is_free = |joint| match told(joint) {
            _ if self.chart.free.contains(&joint) => "true".to_owned(),
            Some(told) if self.block == 0 => told,
            Some(told) => format!("{} || {told}", usual(joint)),
            None => usual(joint),
        };
        let is_usual = self.chart.free.is_empty() && self.loose.is_empty();
        let joints = if is_usual { 0 } else { self.scene.program.joints.len() };
        (0..joints).map(is_free).collect()
    }

    fn go_on(&mut self, printer: &Printer<'_>) {
        let language = printer.language();
        let names = &printer.names().unknowns;
        let mut found: Vec<String> = self.scene.wanted_of(self.block).into_iter().map(|u| names[u].clone()).collect();
        let angles = self.scene.angles(self.block, printer);
        self.push(angles.iter().map(|(name, value)| language.declare(name, value)).collect());
        found.extend(angles.into_iter().map(|(name, _)| name));
        let state = State {
            next: self.block + 2,
            goes_on: self.block > 0,
            branch: self.numbers(language),
            free: &self.free(language),
            found: &found,
            close: self.close(language),
            is_rare: self.chart.is_rare(),
        };
        self.push(language.go_on(&state));
    }

    fn finish(&mut self, printer: &Printer<'_>) {
        let (scene, language) = (self.scene, printer.language());
        let q: Vec<String> = (0..scene.program.joints.len()).map(|joint| scene.joint_value(joint)).collect();
        let at: Vec<String> = scene.places().into_iter().map(|unknown| printer.unknown(unknown)).collect();
        let passed = self.block > 0 && scene.has_families();
        let answer = Finish {
            branch: self.numbers(language),
            at: &at,
            close: self.close(language),
            q: &q,
            free: &self.free(language),
            usual: if passed { language.known("free") } else { "NONE_FREE".to_owned() },
            extra: &scene.extra.iter().map(|&unknown| printer.unknown(unknown)).collect::<Vec<_>>(),
        };
        self.push(language.finish(&answer));
    }
}

/// The unknowns that a step finds.
fn found(step: &Step) -> Vec<usize> {
    match step {
        Step::Compute(_) => vec![],
        Step::Set { unknown, .. } | Step::Roots { unknown, .. } => vec![*unknown],
        Step::Sample { joint, .. } => unknowns(*joint),
        Step::SixAxes(six) => six.parts().joints.iter().flat_map(|joint| unknowns(*joint)).collect(),
    }
}

fn unknowns(joint: JointValue) -> Vec<usize> {
    match joint {
        JointValue::Angle { cosine, sine } => vec![cosine, sine],
        JointValue::Plain(unknown) => vec![unknown],
    }
}

fn multiple(factor: usize, value: &str) -> String {
    if factor == 1 { value.to_owned() } else { format!("{factor} * {value}") }
}
