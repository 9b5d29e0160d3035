//! Bodies of the printed functions: blocks, parameters, and the equations with their derivatives. Main type: [`Scene`].

use super::language::Expressions;
use super::names::Names;
use super::parts::Parts;
use super::printer::Printer;
use crate::solver::{Demand, Following, Instruction, Layout, Operand, ParameterDemand, Program, Rule};

/// The data that all bodies of one file share.
pub(super) struct Scene<'a> {
    pub program: &'a Program,
    pub layout: Layout<'a>,
    pub language: &'a dyn Expressions,
    pub names: Names,
    /// All programs of the file.
    pub parts: &'a Parts<'a>,
}

impl Scene<'_> {
    /// A printer for code whose registers begin at `base`.
    pub fn printer(&self, demand: Demand, base: usize) -> Printer<'_> {
        Printer::new(self.language, &self.names, demand, base)
    }

    /// The code of the checks in a language, as far as `rows` need it, and the rows as lists of expressions.
    pub fn checks(&self, language: &dyn Expressions, rows: &[&[Operand]]) -> (Vec<String>, Vec<Vec<String>>) {
        self.equations(language, &self.program.checks.code, rows)
    }

    /// Same as [`Scene::checks`], for other code over the same parameters and unknowns.
    pub fn equations(
        &self,
        language: &dyn Expressions,
        code: &[Instruction],
        rows: &[&[Operand]],
    ) -> (Vec<String>, Vec<Vec<String>>) {
        let demand = Demand::of_code(code, rows.iter().copied().flatten());
        let mut printer = Printer::new(language, &self.names, demand, 0);
        let name =
            |unknown: usize| printer.demand().wants_unknown(unknown).then_some(self.names.unknowns[unknown].as_str());
        let mut lines = language.declare_places(&self.layout.places().into_iter().map(name).collect::<Vec<_>>());
        lines.extend(printer.code(code));
        let rows = rows.iter().map(|row| row.iter().map(|&operand| printer.operand(operand)).collect()).collect();
        (lines, rows)
    }

    /// Declarations of the computed parameters.
    pub fn parameters(&self, demand: &ParameterDemand) -> Vec<String> {
        let mut lines = Vec::new();
        let mut registers = 0;
        for (index, parameter) in self.program.parameters.iter().enumerate().filter(|(i, _)| demand.computed[*i]) {
            let value = match &parameter.rule {
                Rule::Input(input) => format!("target[{input}]"),
                Rule::Cosine(input) => self.language.call("cos", &format!("target[{input}]")),
                Rule::Sine(input) => self.language.call("sin", &format!("target[{input}]")),
                Rule::Following(law) => self.following(law),
                Rule::CosineFollowing(law) => self.language.call("cos", &format!("({})", self.following(law))),
                Rule::SineFollowing(law) => self.language.call("sin", &format!("({})", self.following(law))),
                Rule::Root { code, value } => {
                    let mut printer = self.printer(Demand::of_code(code, [value]), registers);
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

    /// The expression of a joint value that is an affine function of an input.
    fn following(&self, law: &Following) -> String {
        let Following { input, factor, offset } = *law;
        format!("{} * target[{input}] + {}", self.language.literal(factor), self.language.literal(offset))
    }
}
