//! Parameters from the numbers of a target. Main type: [`Parameters`].

use groebot_runtime::{Number, With};

use super::code::{Assembler, Code, Memory};
use crate::{Demand, Program, Rule};

/// The rules of all parameters.
#[derive(Clone, Debug)]
pub(super) struct Parameters {
    scale: f64,
    rules: Vec<Computed>,
}

#[derive(Clone, Debug)]
enum Computed {
    /// A rule of the target.
    Rule(Rule),
    /// The square root of a value that code computes.
    Root { code: Code, memory: Memory, value: u32 },
}

impl Parameters {
    pub fn new(program: &Program) -> Self {
        let computed = |(index, parameter): (usize, &crate::ParameterRule)| match &parameter.rule {
            Rule::Root { code, value } => {
                let mut assembler = Assembler::new(index, Vec::new());
                let prepared = assembler.code(code, &Demand::of_code(code, [value]));
                let value = assembler.place(*value);
                Computed::Root { code: prepared, memory: assembler.memory(), value }
            }
            rule => Computed::Rule(rule.clone()),
        };
        Parameters { scale: program.scale, rules: program.parameters.iter().enumerate().map(computed).collect() }
    }

    /// The values, and the magnitude after them.
    pub fn values<N: Number>(&self, target: &[N]) -> Vec<N>
    where
        f64: With<N>,
    {
        let mut values: Vec<N> = Vec::with_capacity(self.rules.len() + 1);
        for rule in &self.rules {
            values.push(match rule {
                Computed::Rule(rule) => of_target(rule, target),
                Computed::Root { code, memory, value } => memory.with(&values, &[], |memory| {
                    code.run(memory);
                    memory[*value as usize].0.root()
                }),
            });
        }
        values.push(N::largest(self.scale, &values));
        values
    }
}

fn of_target<N: Number>(rule: &Rule, target: &[N]) -> N
where
    f64: With<N>,
{
    match rule {
        Rule::Input(index) => target[*index],
        Rule::Cosine(index) => target[*index].cos(),
        Rule::Sine(index) => target[*index].sin(),
        Rule::Following(law) => law.factor * target[law.input] + law.offset,
        Rule::CosineFollowing(law) => (law.factor * target[law.input] + law.offset).cos(),
        Rule::SineFollowing(law) => (law.factor * target[law.input] + law.offset).sin(),
        Rule::Root { .. } => N::of(f64::NAN),
    }
}
