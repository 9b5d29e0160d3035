//! Bodies of the printed functions: blocks, parameters, and the equations with their derivatives. Main type: [`Scene`].

use super::demand::{Demand, ParameterDemand};
use super::language::Language;
use super::mirror::Mirror;
use super::names::Names;
use super::needs::has_self_motions;
use super::printer::{Printer, number};
use super::samples::Table;
use crate::solver::{Block, Case, Following, Guard, JointValue, Operand, Program, Rule, Step};

/// What all bodies of one file share.
pub(super) struct Scene<'a> {
    pub program: &'a Program,
    pub language: &'a dyn Language,
    pub names: Names,
    /// Unknowns that the equations read and that are no joint's: cases hand their values over.
    pub extra: Vec<usize>,
    /// Values at which cases put free joints.
    pub tables: Vec<Table>,
    /// The case whose candidates come in pairs.
    pub mirror: Option<Mirror>,
    /// Whether the file takes candidates in by several at once, and angles from them only then.
    pub lanes: bool,
}

impl Scene<'_> {
    fn printer(&self, demand: Demand) -> Printer<'_> {
        Printer::new(self.language, &self.names, demand)
    }

    /// Whether answers can be members of self-motions.
    pub fn has_self_motions(&self) -> bool {
        has_self_motions(self.program)
    }

    /// By unknown: whether a block before the one with this index finds it.
    pub fn known_before(&self, block: usize) -> Vec<bool> {
        let mut known = vec![false; self.program.unknowns.len()];
        for case in self.program.blocks[..block].iter().flat_map(|block| &block.cases) {
            case.steps.iter().flat_map(found).for_each(|unknown| known[unknown] = true);
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

    /// What a block's code and cases ask for when these unknowns are wanted of it.
    pub fn block_demands(&self, block: &Block, wanted: &[usize]) -> Vec<Demand> {
        let mut demands = vec![Demand::of_block(self.program, block, wanted)];
        for case in &block.cases {
            demands.push(Demand::of_case(self.program, case, if case.open { &[] } else { wanted }));
            demands.push(Demand::of_claim(case));
        }
        demands
    }

    /// Unknowns that go from block to block.
    fn passed(&self) -> Vec<usize> {
        (0..self.program.blocks.len() - 1).flat_map(|block| self.wanted_of(block)).collect()
    }

    /// Names of the angles that go from block to block.
    fn passed_angles(&self) -> Vec<String> {
        let is_passed = |&joint: &usize| {
            let is_angle = matches!(self.program.joints[joint].value, JointValue::Angle { .. });
            is_angle && !self.lanes && self.finder(joint) + 1 < self.program.blocks.len()
        };
        (0..self.program.joints.len()).filter(is_passed).map(|joint| format!("q{joint}")).collect()
    }

    /// The names of all that blocks pass on: unknowns, then angles.
    pub fn passed_names(&self) -> Vec<String> {
        let unknowns = self.passed().into_iter().map(|unknown| self.names.unknowns[unknown].clone());
        unknowns.chain(self.passed_angles()).collect()
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

    /// By joint: where its cosine and its sine, or its value, stand among the places.
    pub fn stands(&self) -> Vec<Vec<usize>> {
        let unknowns = self.program.joints.iter().map(|joint| joint.value.unknowns());
        unknowns.map(|unknowns| unknowns.into_iter().map(|unknown| self.place(unknown)).collect()).collect()
    }

    /// By joint that is an angle: where its cosine and its sine stand among the places.
    pub fn circles(&self) -> Vec<Vec<usize>> {
        self.stands().into_iter().filter(|stands| stands.len() == 2).collect()
    }

    fn place(&self, unknown: usize) -> usize {
        self.places().iter().position(|&other| other == unknown).expect("a joint's unknowns have places")
    }

    /// The value of the joint with this index behind the last block.
    pub fn joint_value(&self, index: usize) -> String {
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
    pub fn finder(&self, joint: usize) -> usize {
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
    pub fn angles(&self, block: usize, printer: &Printer<'_>) -> Vec<(String, String)> {
        let found = (0..self.program.joints.len()).filter(|&joint| !self.lanes && self.finder(joint) == block);
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
                Rule::Following(law) => following(law),
                Rule::CosineFollowing(law) => self.language.call("cos", &format!("({})", following(law))),
                Rule::SineFollowing(law) => self.language.call("sin", &format!("({})", following(law))),
                Rule::Root { code, value } => {
                    let mut printer = self.printer(Demand::of_code(code, [value])).among_parameters(registers);
                    lines.extend(printer.code(code));
                    registers += code.len();
                    let square = printer.operand(*value);
                    self.language.root(&square)
                }
            };
            lines.push(self.language.declare(&self.names.parameters[index], &value));
        }
        lines
    }

    /// The expression of the magnitude over the parameters' local names.
    pub fn magnitude(&self) -> String {
        let scale = self.language.alone(number(self.program.scale));
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
        let name =
            |unknown: usize| printer.demand().wants_unknown(unknown).then_some(self.names.unknowns[unknown].as_str());
        let mut lines = self.language.declare_places(&self.places().into_iter().map(name).collect::<Vec<_>>());
        lines.extend(printer.code(code));
        let rows = rows.iter().map(|row| row.iter().map(|&operand| printer.operand(operand)).collect()).collect();
        (lines, rows)
    }

    /// A printer for a case of the block with this index, or for its code if nothing is `shared` yet.
    pub fn block_printer(&self, block: usize, demand: Demand, shared: usize) -> Printer<'_> {
        self.printer(demand).within_block(self.known_before(block), shared)
    }

    /// The code of the block with this index, and the registers that its cases read.
    pub fn block_code(&self, index: usize) -> (Vec<String>, Vec<String>) {
        let (block, wanted) = (&self.program.blocks[index], self.wanted_of(index));
        let demand = Demand::of_block(self.program, block, &wanted);
        let demands = self.block_demands(block, &wanted);
        let cases = &demands[1..];
        let read = |register: &usize| cases.iter().any(|demand| demand.register(*register) > 0);
        let shared = (0..block.code.len()).filter(read).map(|register| format!("r{register}")).collect();
        (self.block_printer(index, demand, 0).code(&block.code), shared)
    }

    /// The code before the condition of an open case or one with a pivot, the condition, and the pivot.
    pub fn claim(&self, index: usize, case: &Case) -> (Vec<String>, String, String) {
        let shared = self.program.blocks[index].code.len();
        let mut printer = self.block_printer(index, Demand::of_claim(case), shared);
        let lines = printer.code(&case.guard_code);
        let condition = self.condition(&case.guards, &mut printer);
        let value = case.pivot.map_or_else(String::new, |pivot| printer.operand(pivot.value));
        (lines, condition, value)
    }

    /// Whether all of these guards hold, as an expression.
    pub fn condition(&self, guards: &[Guard], printer: &mut Printer<'_>) -> String {
        let terms: Vec<String> = guards
            .iter()
            .map(|guard| {
                let (value, scale) = (printer.operand(guard.value), printer.operand(guard.scale));
                if guard.near {
                    format!("is_near({value}, {scale}, NEAR)")
                } else {
                    format!("is_away({value}, {scale})")
                }
            })
            .collect();
        if terms.is_empty() { "true".to_owned() } else { terms.join(" && ") }
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

/// The value that follows an input.
fn following(law: &Following) -> String {
    let Following { input, factor, offset } = *law;
    format!("{} * target[{input}] + {}", number(factor), number(offset))
}
