//! The expression printer: straight-line code as declarations and expressions of a language.
//!
//! A register that is read once becomes part of the expression that reads it. No operation is moved, merged or
//! reordered, so each printed expression rounds exactly as the instructions do.

use std::collections::HashMap;

use super::language::Expressions;
use super::names::Names;
use crate::solver::Demand;
use crate::solver::{Instruction, Operand, Operation};

/// The greatest length of an expression that becomes part of another one, in characters.
const INLINE: usize = 44;

/// The greatest length of a line of listed values, in characters, without indentation.
const LINE: usize = 96;

/// One level of indentation.
pub(super) const INDENT: &str = "    ";

/// The precedence of a text, which determines whether it needs parentheses.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum Binding {
    Sum,
    Product,
    Sign,
    Atom,
}

/// A printed expression.
#[derive(Clone)]
struct Expression {
    text: String,
    binding: Binding,
}

impl Expression {
    fn atom(text: impl Into<String>) -> Self {
        Expression { text: text.into(), binding: Binding::Atom }
    }

    /// The text, in parentheses if its precedence is below `least`.
    fn within(self, least: Binding) -> String {
        if self.binding < least { format!("({})", self.text) } else { self.text }
    }
}

/// `head`, the items and `tail` on one line, or on separate lines if that is too long.
pub(super) fn spread(head: &str, items: &[String], tail: &str) -> Vec<String> {
    let line = format!("{head}{}{tail}", items.join(", "));
    if line.len() <= LINE {
        return vec![line];
    }
    let items = packed(items).into_iter().map(|line| format!("{INDENT}{line}"));
    [head.to_owned()].into_iter().chain(items).chain([tail.to_owned()]).collect()
}

/// The items, each with a comma, on lines of limited length.
fn packed(items: &[String]) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for item in items {
        match lines.last_mut().filter(|line| line.len() + item.len() < LINE) {
            Some(line) => *line += &format!(" {item},"),
            None => lines.push(format!("{item},")),
        }
    }
    lines
}

/// The template filter of that name: lists without the last comma; all lines but the first begin with `lead`.
pub(super) fn packed_lines(items: Vec<String>, lead: &str) -> String {
    let lines = packed(&items).join(&format!("\n{lead}"));
    lines.strip_suffix(',').unwrap_or(&lines).to_owned()
}

/// Prints the code of one function.
pub(super) struct Printer<'a> {
    language: &'a dyn Expressions,
    /// Identifiers of the parameters and the unknowns.
    parameters: &'a [String],
    unknowns: &'a [String],
    demand: Demand,
    /// The number of register 0.
    first_register: usize,
    /// Registers that are read once and have not been read yet.
    waiting: HashMap<usize, Expression>,
}

impl<'a> Printer<'a> {
    /// A printer for code whose registers begin at `first_register`.
    pub fn new(language: &'a dyn Expressions, names: &'a Names, demand: Demand, first_register: usize) -> Self {
        let (parameters, unknowns) = (&names.parameters[..], &names.unknowns[..]);
        Printer { language, parameters, unknowns, demand, first_register, waiting: HashMap::new() }
    }

    /// A printer for code that reads only parameters.
    pub fn of(language: &'a dyn Expressions, parameters: &'a [String], demand: Demand) -> Self {
        Printer { language, parameters, unknowns: &[], demand, first_register: 0, waiting: HashMap::new() }
    }

    /// Identifiers of the unknowns.
    pub fn unknowns(&self) -> &'a [String] {
        self.unknowns
    }

    pub fn demand(&self) -> &Demand {
        &self.demand
    }

    /// Declarations of the registers that are read, except those that become part of an expression.
    pub fn code(&mut self, code: &[Instruction]) -> Vec<String> {
        let mut lines = Vec::new();
        for instruction in code {
            let reads = self.demand.register(instruction.target);
            if reads == 0 {
                continue;
            }
            let expression = self.operation(instruction.operation);
            if reads == 1 && expression.text.len() <= INLINE {
                self.waiting.insert(instruction.target, expression);
            } else {
                lines.push(self.language.declare(&self.register(instruction.target), &expression.text));
            }
        }
        lines
    }

    /// Declarations of all registers that have not become part of an expression yet.
    pub fn settle(&mut self) -> Vec<String> {
        let mut waiting: Vec<(usize, Expression)> = self.waiting.drain().collect();
        waiting.sort_by_key(|(index, _)| *index);
        waiting.iter().map(|(index, value)| self.language.declare(&self.register(*index), &value.text)).collect()
    }

    /// An operand as an expression of its own.
    pub fn operand(&mut self, operand: Operand) -> String {
        match operand {
            Operand::Constant(value) => self.language.alone(self.language.literal(value)),
            _ => self.expression(operand).text,
        }
    }

    /// An unknown: a local variable.
    pub fn unknown(&self, index: usize) -> String {
        self.unknowns[index].clone()
    }

    fn register(&self, index: usize) -> String {
        format!("r{}", self.first_register + index)
    }

    fn expression(&mut self, operand: Operand) -> Expression {
        match operand {
            Operand::Constant(value) if value.is_sign_negative() => {
                Expression { text: self.language.literal(value), binding: Binding::Sign }
            }
            Operand::Constant(value) => Expression::atom(self.language.literal(value)),
            Operand::Parameter(index) => Expression::atom(&self.parameters[index]),
            Operand::Unknown(index) => Expression::atom(self.unknown(index)),
            Operand::Register(index) => {
                self.waiting.remove(&index).unwrap_or_else(|| Expression::atom(self.register(index)))
            }
            Operand::Magnitude => Expression::atom("magnitude"),
        }
    }

    fn operation(&mut self, operation: Operation) -> Expression {
        let (sign, a, b) = match operation {
            Operation::Add(a, b) => ('+', a, b),
            Operation::Sub(a, b) => ('-', a, b),
            Operation::Mul(a, b) => ('*', a, b),
            Operation::Div(a, b) => ('/', a, b),
            Operation::Abs(a) => {
                let argument = self.operand(a);
                return Expression::atom(self.language.call("abs", &argument));
            }
            Operation::Sqrt(a) => {
                let argument = self.operand(a);
                return Expression::atom(self.language.root(&argument));
            }
        };
        let (binding, right) = match sign {
            '+' | '-' => (Binding::Sum, Binding::Product),
            _ => (Binding::Product, Binding::Atom),
        };
        let are_constants = matches!((a, b), (Operand::Constant(_), Operand::Constant(_)));
        let a = if are_constants { self.operand(a) } else { self.expression(a).within(binding) };
        let b = self.expression(b);
        let right = if b.binding == Binding::Sign { Binding::Atom } else { right };
        Expression { text: format!("{a} {sign} {}", b.within(right)), binding }
    }
}
