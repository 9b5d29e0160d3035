//! Traversal of the blocks as text: nested loops, with a separate function for each block that several cases lead to.
//! Main type: [`Walk`].

use super::body::Scene;
use super::dialect::{Applies, Dialect, GuardText, How};
use super::names::remark;
use super::printer::{INDENT, Printer};
use super::samples::Table;
use crate::solver::Demand;
use crate::solver::eigenvalue::SixAxes;
use crate::solver::{Block, Case, JointValue, Operand, Program, Step, square};

/// A block as a separate function.
pub(super) struct Function {
    /// Its number, from 1.
    pub number: usize,
    pub label: String,
    /// The known values that are its arguments, in addition to the parameters.
    pub known: Vec<String>,
    pub lines: Vec<String>,
    /// Whether it has one call that runs often, so that a language should inline it.
    pub is_inlined: bool,
    /// Whether a rare case calls it.
    pub is_led_to_rarely: bool,
}

/// All functions, the first block's last.
pub(super) fn functions(scene: &Scene<'_>, dialect: &dyn Dialect) -> Vec<Function> {
    let blocks = &scene.program.blocks;
    let mut functions: Vec<Function> = Vec::new();
    for index in (0..blocks.len()).rev().filter(|&index| stands_alone(blocks, index)) {
        let mut walk = Walk {
            scene,
            dialect,
            functions: &functions,
            lines: Vec::new(),
            depth: 0,
            loops: 0,
            claims: 0,
            found: index,
        };
        walk.block(index, 0);
        let lines = walk.lines;
        let known = scene.layout.known_before(index);
        let is_read = |unknown: &usize| known[*unknown] && reads(&lines, &scene.names.unknowns[*unknown]);
        let known = (0..known.len()).filter(is_read).map(|unknown| scene.names.unknowns[unknown].clone()).collect();
        let before = index.checked_sub(1).map_or(&[][..], |before| &blocks[before].cases);
        let is_inlined = index == 0 || before.iter().filter(|case| !case.is_rare()).count() == 1;
        functions.push(Function {
            number: index + 1,
            label: remark(&blocks[index].label),
            known,
            lines,
            is_inlined,
            is_led_to_rarely: before.iter().any(|case| case.is_rare() && !case.open),
        });
    }
    functions
}

/// Whether the number of cases that lead to the block with this index is not one.
fn stands_alone(blocks: &[Block], index: usize) -> bool {
    index == 0 || blocks[index - 1].cases.iter().filter(|case| !case.open).count() != 1
}

/// Whether a word occurs in lines.
pub(super) fn reads(lines: &[String], word: &str) -> bool {
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    lines.iter().any(|line| {
        line.match_indices(word).any(|(at, _)| {
            !line[..at].ends_with(|c| is_part(c) || c == '.') && !line[at + word.len()..].starts_with(is_part)
        })
    })
}

/// A function while it is printed.
struct Walk<'a> {
    scene: &'a Scene<'a>,
    dialect: &'a dyn Dialect,
    /// The functions of later blocks.
    functions: &'a [Function],
    lines: Vec<String>,
    depth: usize,
    /// The number of loops and claims so far.
    loops: usize,
    claims: usize,
    /// The number in the name of the record of the choices so far.
    found: usize,
}

impl<'a> Walk<'a> {
    fn push(&mut self, lines: impl IntoIterator<Item = String>) {
        let indent = INDENT.repeat(self.depth);
        self.lines.extend(lines.into_iter().map(|line| format!("{indent}{line}")));
    }

    fn open(&mut self, lines: impl IntoIterator<Item = String>) {
        self.push(lines);
        self.depth += 1;
    }

    fn close(&mut self, depth: usize) {
        while self.depth > depth {
            self.depth -= 1;
            self.push(["}".to_owned()]);
        }
    }

    fn comment(&mut self, text: &str) {
        let comment = self.dialect.comment(text);
        self.push([comment]);
    }

    /// Prints the block with this index, whose registers begin at `base`.
    fn block(&mut self, index: usize, base: usize) {
        let scene = self.scene;
        let block = &scene.program.blocks[index];
        if self.depth > 0 {
            self.comment(&format!("Block {}: {}.", index + 1, remark(&block.label)));
        }
        if block.cases.iter().any(Case::is_of_stratum) {
            let count = self.dialect.count(index + 1);
            self.push([count]);
        }
        let demand = Demand::of_block(scene.program, block, &scene.layout.wanted_of(index));
        let lines = scene.printer(demand, base).code(&block.code);
        self.push(lines);
        let next_base = base + block.registers();
        for first in (0..block.cases.len()).filter(|&case| block.opens_group(case)) {
            let group = block.cases[first].pivot.map(|pivot| pivot.group);
            if group.is_some() {
                let is_member = |case: &usize| block.cases[*case].pivot.map(|pivot| pivot.group) == group;
                self.elect(index, base, next_base, (0..block.cases.len()).filter(is_member).collect());
            } else {
                self.described_case(index, first, base, next_base);
            }
        }
    }

    /// Prints a case with its description.
    fn described_case(&mut self, index: usize, case: usize, base: usize, next_base: usize) {
        let block = &self.scene.program.blocks[index];
        let depth = self.depth;
        if block.cases.len() > 1 {
            self.comment(&description(self.scene.program, case, &block.cases[case]));
            if self.dialect.needs_scopes() {
                self.open(["{".to_owned()]);
            }
        }
        self.case(index, &block.cases[case], base, next_base);
        self.close(depth);
    }

    /// Prints one of the cases of a pivot group.
    fn elect(&mut self, index: usize, base: usize, next_base: usize, members: Vec<usize>) {
        let (scene, block) = (self.scene, &self.scene.program.blocks[index]);
        let first = self.claims;
        for &member in &members {
            let case = &block.cases[member];
            let mut printer = scene.printer(Demand::of_claim(case), base);
            let lines = printer.code(&case.guard_code);
            let guards = guards(case, &mut printer);
            let condition = (!guards.is_empty()).then(|| self.dialect.guard(&guards));
            let pivot = case.pivot.map_or_else(String::new, |pivot| printer.operand(pivot.value));
            let lines = self.dialect.claim(self.claims, lines, &pivot, condition.as_deref());
            self.push(lines);
            self.claims += 1;
        }
        let claims: Vec<usize> = (first..self.claims).collect();
        let bodies = members.into_iter().map(|member| self.apart(index, member, base, next_base)).collect();
        let lines = self.dialect.elect(&claims, bodies);
        self.push(lines);
    }

    /// The lines of a case as a separate text.
    fn apart(&mut self, index: usize, member: usize, base: usize, next_base: usize) -> Vec<String> {
        let (lines, depth) = (std::mem::take(&mut self.lines), std::mem::take(&mut self.depth));
        let case = &self.scene.program.blocks[index].cases[member];
        self.comment(&description(self.scene.program, member, case));
        self.case(index, case, base, next_base);
        self.close(0);
        self.depth = depth;
        std::mem::replace(&mut self.lines, lines)
    }

    fn case(&mut self, index: usize, case: &'a Case, base: usize, next_base: usize) {
        let (scene, dialect) = (self.scene, self.dialect);
        let is_last = index + 1 == scene.program.blocks.len();
        let wanted = if is_last { scene.layout.wanted() } else { scene.layout.wanted_of(index) };
        let mut printer = scene.printer(Demand::of_case(scene.program, case, &wanted), base);
        let lines = printer.code(&case.guard_code);
        self.push(lines);
        let guards = guards(case, &mut printer);
        if case.open {
            let number = 1 + scene
                .program
                .cases()
                .filter(|case| case.open)
                .position(|other| std::ptr::eq(other, case))
                .unwrap_or(0);
            let line = dialect.is_open(number, &dialect.guard(&guards));
            return self.push([line]);
        }
        if !guards.is_empty() && case.pivot.is_none() {
            let guard = dialect.guard(&guards);
            let applies = if case.is_of_stratum() {
                Applies::Near { count: index + 1, guard }
            } else if case.is_rare() {
                Applies::Rarely(guard)
            } else {
                Applies::Usually(guard)
            };
            self.open([dialect.open_case(&applies)]);
        }
        self.steps(index, case, &mut printer, next_base);
    }

    /// Prints the steps of a case, and the blocks after it.
    fn steps(&mut self, index: usize, case: &'a Case, printer: &mut Printer<'_>, next_base: usize) {
        let scene = self.scene;
        let mut terms = if case.first_branch > 0 { vec![case.first_branch.to_string()] } else { Vec::new() };
        let mut how: Vec<How> = Vec::new();
        for (place, step) in case.steps.iter().enumerate() {
            let number = self.loops + 1;
            let stride: usize = case.steps[place + 1..].iter().map(Step::slots).product();
            match step {
                Step::Compute(code) => {
                    let lines = printer.code(code);
                    self.push(lines);
                }
                Step::Set { unknown, value } if printer.demand().wants_unknown(*unknown) => {
                    let value = printer.operand(*value);
                    self.push([self.dialect.declare(&printer.unknowns()[*unknown], &value)]);
                }
                Step::Set { .. } => {}
                Step::Roots { unknown, polynomials, typical, half_angle } => {
                    let is_pair = scene.layout.is_mirror(case);
                    self.roots(step, (*unknown, polynomials, *typical, *half_angle), is_pair, printer);
                    how.push(if is_pair { How::Pair(number) } else { How::Root(number) });
                    if !is_pair {
                        terms.push(multiple(stride, &format!("i{number}")));
                    }
                }
                Step::SixAxes(six) => {
                    how.push(self.six_axes(six, printer));
                    terms.push(multiple(stride, &format!("i{number}")));
                }
                Step::Sample { joint, values } => self.samples(*joint, values, printer),
            }
        }
        let branch = if terms.is_empty() { "0".to_owned() } else { terms.join(" + ") };
        let radix = scene.program.blocks[index].branches();
        match index {
            0 => how.insert(0, How::First { branch, last: case.first_branch + Program::branches(case) }),
            _ if radix > 1 => how.insert(0, How::Next { radix, branch }),
            _ => {}
        }
        if !case.free.is_empty() {
            how.push(How::Free(case.free.iter().fold(0, |free, joint| free | 1 << joint)));
        }
        let before = self.found;
        if !how.is_empty() {
            self.push([self.dialect.found(before, index + 1, &how)]);
            self.found = index + 1;
        }
        self.go_on(index, case, printer, next_base);
        self.found = before;
    }

    fn go_on(&mut self, index: usize, case: &Case, printer: &Printer<'_>, next_base: usize) {
        let (scene, next) = (self.scene, index + 1);
        if next == scene.program.blocks.len() {
            let at: Vec<String> = scene.layout.places().into_iter().map(|unknown| printer.unknown(unknown)).collect();
            let lines = self.dialect.finish(self.found, &at);
            self.push(lines);
        } else if let Some(function) = self.functions.iter().find(|function| function.number == next + 1) {
            let lines = self.dialect.go_on(next + 1, self.found, case.is_rare(), &function.known);
            self.push(lines);
        } else {
            self.block(next, next_base);
        }
    }

    fn roots(
        &mut self,
        step: &Step,
        (unknown, polynomials, typical, half_angle): (usize, &[Vec<Operand>], Option<Operand>, bool),
        is_pair: bool,
        printer: &mut Printer<'_>,
    ) {
        let (program, dialect) = (self.scene.program, self.dialect);
        self.loops += 1;
        let number = self.loops;
        let usual = if program.is_plain(unknown) { Operand::Magnitude } else { Operand::Constant(1.0) };
        let mut typed = |operand: Operand| printer.operand(operand);
        let finds = match square(polynomials).filter(|_| !half_angle) {
            Some(constant) => {
                let (constant, typical) = (typed(constant), typed(typical.unwrap_or(usual)));
                vec![dialect.find_square_roots(number, &constant, &typical, program.degree() > 2)]
            }
            None => {
                let lists: Vec<Vec<String>> =
                    polynomials.iter().map(|list| list.iter().map(|&c| typed(c)).collect()).collect();
                let typical = typed(typical.unwrap_or(usual));
                dialect.find_roots(number, step.slots(), &lists, &typical, half_angle)
            }
        };
        let lines = printer.settle();
        self.push(lines);
        self.push(finds);
        let name = printer.demand().wants_unknown(unknown).then(|| printer.unknowns()[unknown].as_str());
        self.open(dialect.open_roots(number, name, is_pair));
    }

    fn samples(&mut self, joint: JointValue, values: &[f64], printer: &mut Printer<'_>) {
        self.loops += 1;
        let lines = printer.settle();
        self.push(lines);
        let name =
            |unknown: usize| printer.demand().wants_unknown(unknown).then(|| printer.unknowns()[unknown].as_str());
        let names: Vec<Option<&str>> = joint.unknowns().into_iter().map(name).collect();
        let table = Table::new(joint, values);
        let place = self.scene.parts.tables.iter().position(|other| *other == table);
        let table_number = 1 + place.expect("the tables are those of all steps");
        self.open(self.dialect.open_samples(self.loops, &names, table_number, table.len()));
    }

    /// Prints the loop over solutions for six axes. Returns the record of the choice.
    fn six_axes(&mut self, six: &SixAxes, printer: &mut Printer<'_>) -> How {
        let (scene, dialect) = (self.scene, self.dialect);
        self.loops += 1;
        let number = self.loops;
        let target: Vec<String> = six.operands().into_iter().map(|operand| printer.operand(operand)).collect();
        let given = six.parts().given.len();
        let lines = printer.settle();
        self.push(lines);
        let chain = scene.parts.six_axes.iter().position(|other| std::ptr::eq(*other, six));
        let chain = 1 + chain.expect("the steps are those of all programs");
        self.open(dialect.open_six_axes(number, chain, &target, given));
        let mut joints = Vec::new();
        for (place, joint) in six.parts().joints.iter().enumerate() {
            let value = dialect.six_axes_joint(number, place);
            let values = match joint {
                JointValue::Angle { cosine, sine } => {
                    vec![(*cosine, dialect.call("cos", &value)), (*sine, dialect.call("sin", &value))]
                }
                JointValue::Plain(unknown) => vec![(*unknown, value)],
            };
            let wanted = values.into_iter().filter(|(unknown, _)| printer.demand().wants_unknown(*unknown));
            let lines: Vec<String> =
                wanted.map(|(unknown, value)| dialect.declare(&printer.unknowns()[unknown], &value)).collect();
            self.push(lines);
            joints.push(scene.program.joints.iter().position(|other| other.value == *joint));
        }
        How::SixAxes { number, joints }
    }
}

fn guards(case: &Case, printer: &mut Printer<'_>) -> Vec<GuardText> {
    let text = |guard: &crate::solver::Guard| GuardText {
        value: printer.operand(guard.value),
        scale: printer.operand(guard.scale),
        near: guard.near,
    };
    case.guards.iter().map(text).collect()
}

/// The description of a case: its label, its condition and its free joints.
fn description(program: &Program, index: usize, case: &Case) -> String {
    let guard = |guard: &crate::solver::Guard| {
        format!("{} is {}", remark(&guard.text), if guard.near { "near zero" } else { "not zero" })
    };
    let guards: Vec<String> = case.guards.iter().map(guard).collect();
    let free: Vec<String> = case.free.iter().map(|&joint| remark(&program.joints[joint].name)).collect();
    let at = if guards.is_empty() { String::new() } else { format!(", where {}", guards.join(" and ")) };
    let frees = if free.is_empty() { String::new() } else { format!("; free: {}", free.join(", ")) };
    let open = if case.open { ", which could not be derived" } else { "" };
    format!("Case {}: {}{at}{open}{frees}.", index + 1, remark(&case.label))
}

fn multiple(factor: usize, value: &str) -> String {
    if factor == 1 { value.to_owned() } else { format!("{factor} * {value}") }
}
