//! The bodies of cases: their steps as nested loops of text ([`Walk`]).

use super::body::Scene;
use super::demand::Demand;
use super::language::{Finish, Language, State};
use super::mirror::Mirror;
use super::printer::{INDENT, Printer};
use super::samples::Table;
use super::six_axes;
use crate::solver::eigenvalue::SixAxes;
use crate::solver::{Case, JointValue, Operand, Program, Step, square};

impl Scene<'_> {
    /// The body of a case of the block with this index, without indentation; an open case's is its condition alone.
    pub fn case(&self, index: usize, case: &Case) -> Vec<String> {
        let (block, wanted) = (&self.program.blocks[index], self.wanted_of(index));
        let wanted = if index + 1 < self.program.blocks.len() { wanted } else { self.wanted() };
        let demand = Demand::of_case(self.program, case, &wanted);
        let mut printer = self.block_printer(index, demand, block.code.len());
        let mut lines = printer.code(&case.guard_code);
        if !case.guards.is_empty() {
            let condition = self.condition(&case.guards, &mut printer);
            let beside = case.is_of_stratum().then(|| condition.replace(", NEAR)", ", BESIDE)"));
            lines.extend(self.language.leave_unless(&condition, case.is_rare(), beside.as_deref()));
        }
        Walk::new(self, index, case, lines).steps(&mut printer)
    }
}

/// The steps of a case on their way to text.
struct Walk<'a> {
    scene: &'a Scene<'a>,
    block: usize,
    case: &'a Case,
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

impl<'a> Walk<'a> {
    /// At the case's first step, behind `lines`, in the block with this index.
    fn new(scene: &'a Scene<'a>, block: usize, case: &'a Case, lines: Vec<String>) -> Self {
        let (finds_roots, branch, loose, lost) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        Walk { scene, block, case, lines, depth: 0, finds_roots, branch, loose, lost }
    }

    fn push(&mut self, lines: Vec<String>) {
        let indent = INDENT.repeat(self.depth);
        self.lines.extend(lines.into_iter().map(|line| format!("{indent}{line}")));
    }

    /// Whether the case's second root is that of a pair of candidates.
    fn mirrors(&self) -> bool {
        let is_here =
            |mirror: &Mirror| std::ptr::eq(&self.scene.program.blocks[mirror.block].cases[mirror.case], self.case);
        self.scene.mirror.as_ref().is_some_and(is_here)
    }

    /// The lines of the whole case.
    fn steps(mut self, printer: &mut Printer<'_>) -> Vec<String> {
        if self.case.first_branch > 0 {
            self.branch.push(self.case.first_branch.to_string());
        }
        for (index, step) in self.case.steps.iter().enumerate() {
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
                    let stride: usize = self.case.steps[index + 1..].iter().map(Step::slots).product();
                    self.branch.push(multiple(stride, &format!("i{}", self.depth)));
                    self.finds_roots.push(false);
                    self.depth += 1;
                }
                Step::Roots { unknown, polynomials, typical } => {
                    self.roots(*unknown, polynomials, *typical, printer);
                    let stride: usize = self.case.steps[index + 1..].iter().map(Step::slots).product();
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
        self.lines
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
        self.push(language.open_loop(self.depth, name, self.mirrors()));
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

    /// The branch number so far and the end of the numbers of the first block's case.
    fn numbers(&self, language: &dyn Language) -> [String; 2] {
        if self.block == 0 {
            let branch = if self.branch.is_empty() { "0".to_owned() } else { self.branch.join(" + ") };
            return [branch, (self.case.first_branch + Program::branches(self.case)).to_string()];
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

    /// By joint whether it is free; empty when the case adds none.
    fn free(&self, language: &dyn Language) -> Vec<String> {
        let usual = |joint: usize| match self.block {
            0 => "false".to_owned(),
            _ => language.known(&format!("free[{joint}]")),
        };
        let told = |joint: usize| self.loose.iter().find(|(index, _)| *index == joint).map(|(_, told)| told.clone());
        let is_free = |joint| match told(joint) {
            _ if self.case.free.contains(&joint) => "true".to_owned(),
            Some(told) if self.block == 0 => told,
            Some(told) => format!("{} || {told}", usual(joint)),
            None => usual(joint),
        };
        let is_usual = self.case.free.is_empty() && self.loose.is_empty();
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
            pair: self.mirrors().then(|| self.pair(language)),
            is_rare: self.case.is_rare(),
        };
        self.push(language.go_on(&state));
    }

    fn finish(&mut self, printer: &Printer<'_>) {
        let (scene, language) = (self.scene, printer.language());
        let joints = if scene.lanes { 0 } else { scene.program.joints.len() };
        let q: Vec<String> = (0..joints).map(|joint| scene.joint_value(joint)).collect();
        let at: Vec<String> = scene.places().into_iter().map(|unknown| printer.unknown(unknown)).collect();
        let passed = self.block > 0 && scene.has_self_motions();
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
        let is_behind = |mirror: &&Mirror| self.mirrors() || mirror.block < self.block;
        if let Some(mirror) = scene.mirror.as_ref().filter(is_behind) {
            self.finish_mirrored(mirror, &answer, printer);
        }
    }

    /// Hands over the second candidate of a pair.
    fn finish_mirrored(&mut self, mirror: &Mirror, answer: &Finish<'_>, printer: &Printer<'_>) {
        let (scene, language) = (self.scene, printer.language());
        let places = scene.places();
        let turned = |place: usize| mirror.odd[places[place]];
        let value =
            |place: usize| if turned(place) { format!("-{}", answer.at[place]) } else { answer.at[place].clone() };
        let at: Vec<String> = (0..places.len()).map(value).collect();
        let stands = scene.stands();
        let joint = |(joint, same): (usize, &String)| match stands[joint][..] {
            [cosine, sine] if turned(cosine) || turned(sine) => format!("angle(at[{cosine}], at[{sine}])"),
            _ => same.clone(),
        };
        let q: Vec<String> = answer.q.iter().enumerate().map(joint).collect();
        let [branch, last] = &answer.branch;
        let second = Finish {
            branch: [format!("{branch} + 1"), last.clone()],
            at: &at,
            close: answer.close.clone(),
            q: &q,
            free: answer.free,
            usual: answer.usual.clone(),
            extra: answer.extra,
        };
        let lines = language.finish(&second).into_iter().map(|line| format!("{INDENT}{line}"));
        let lines = [language.only_if(&self.pair(language))].into_iter().chain(lines).chain(["}".to_owned()]).collect();
        self.push(lines);
    }

    /// Whether a candidate stands for two, as an expression.
    fn pair(&self, language: &dyn Language) -> String {
        match self.finds_roots.iter().rposition(|&finds| finds) {
            Some(depth) if self.mirrors() => format!("roots{depth}.count == 2"),
            _ => language.known("pair"),
        }
    }
}

fn multiple(factor: usize, value: &str) -> String {
    if factor == 1 { value.to_owned() } else { format!("{factor} * {value}") }
}
