//! The values that an ordinary target's candidates need, as a graph in which each value occurs once. Main type:
//! [`Graph`].
//!
//! At an ordinary target one case of each block applies, so that the program is straight-line code with square roots in
//! it. A value that several blocks compute, or one that does not depend on the root of its block, is computed once.

use std::collections::HashMap;

use super::super::code::Kind;
use crate::facts::{is_solved_abreast, usual};
use crate::{Block, Case, Facts, Instruction, JointValue, Layout, Operand, Program, Rule, Step, square};

/// The index of a value.
pub(super) type Value = usize;

/// The origin of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Node {
    /// A constant, by its bits.
    Constant(u64),
    /// A number of the target.
    Input(usize),
    /// The result of an operation; of one operand twice where the operation has one only.
    Result(Kind, [Value; 2]),
    /// A root of `x^2 + constant`, whose typical size is given. The number is its index among all roots.
    Root { constant: Value, typical: Value, number: usize },
}

/// The comparison of a factor with its size.
#[derive(Clone, Copy, Debug)]
pub(super) struct Test {
    pub value: Value,
    pub scale: Value,
    pub near: bool,
}

/// The guards of a case, all of which hold where it applies.
#[derive(Clone, Debug)]
pub(super) struct Guards {
    pub tests: Vec<Test>,
    /// Whether the case applies to ordinary targets.
    pub is_usual: bool,
}

/// The values of an ordinary target's candidates.
#[derive(Clone, Debug, Default)]
pub(super) struct Graph {
    /// Each value after its operands.
    pub nodes: Vec<Node>,
    /// By value, the number of roots of which the last is known when the value is.
    pub levels: Vec<usize>,
    known: HashMap<Node, Value>,
    /// The guards of each case, and the number of values known before.
    pub guards: Vec<(Guards, usize)>,
    pub roots: usize,
    /// The branch numbers of the candidates. The first root is the most significant bit of a candidate's index.
    pub branches: Vec<usize>,
    /// The numbers that the equations read.
    pub places: Vec<Value>,
    /// The equations' values.
    pub residuals: Vec<Value>,
    /// The sizes of equations, without duplicates.
    pub sizes: Vec<Value>,
}

impl Graph {
    /// The graph of a program; `None` if its targets are solved one by one, or have another number of candidates.
    pub fn new(layout: &Layout<'_>, facts: &Facts) -> Option<Self> {
        let program = layout.program;
        if !is_solved_abreast(program) {
            return None;
        }
        let mut builder = Builder {
            graph: Graph { branches: vec![0], ..Graph::default() },
            parameters: Vec::new(),
            magnitude: 0,
            unknowns: vec![Value::MAX; program.unknowns.len()],
            registers: Vec::new(),
        };
        builder.parameters(program);
        for (index, block) in program.blocks.iter().enumerate() {
            builder.block(program, block, index == 0)?;
        }
        let mut graph = builder.with_checks(layout, facts);
        graph.known = HashMap::new();
        (graph.roots > 0 && graph.branches.len() == facts.candidates && graph.is_whole()).then_some(graph)
    }

    /// Whether everything that is read is found.
    fn is_whole(&self) -> bool {
        let tests = self.guards.iter().flat_map(|(guards, _)| &guards.tests).flat_map(|test| [test.value, test.scale]);
        let roots = self.nodes.iter().flat_map(|node| match *node {
            Node::Root { constant, typical, .. } => vec![constant, typical],
            _ => Vec::new(),
        });
        let results = self.places.iter().chain(&self.residuals).chain(&self.sizes).copied();
        results.chain(tests).chain(roots).all(|value| value != Value::MAX)
    }

    /// The value of a node, which is added if it is new.
    fn value(&mut self, node: Node) -> Value {
        *self.known.entry(node).or_insert_with(|| {
            let of = |operands: [Value; 2]| operands.map(|value| self.levels[value]).into_iter().max().unwrap_or(0);
            self.levels.push(match node {
                Node::Constant(_) | Node::Input(_) => 0,
                Node::Result(_, operands) => of(operands),
                Node::Root { number, .. } => number + 1,
            });
            self.nodes.push(node);
            self.nodes.len() - 1
        })
    }

    fn constant(&mut self, value: f64) -> Value {
        self.value(Node::Constant(value.to_bits()))
    }

    fn result(&mut self, kind: Kind, [a, b]: [Value; 2]) -> Value {
        // The order of these operands does not change the result.
        let commutes = matches!(kind, Kind::Add | Kind::Mul);
        self.value(Node::Result(kind, if commutes && b < a { [b, a] } else { [a, b] }))
    }
}

struct Builder {
    graph: Graph,
    parameters: Vec<Value>,
    magnitude: Value,
    /// By unknown, its value so far.
    unknowns: Vec<Value>,
    /// By register of the current code, its value.
    registers: Vec<Value>,
}

impl Builder {
    fn parameters(&mut self, program: &Program) {
        for parameter in &program.parameters {
            let value = match &parameter.rule {
                Rule::Root { code, value } => {
                    self.run(code);
                    let value = self.operand(*value);
                    self.graph.result(Kind::Sqrt, [value; 2])
                }
                // `is_solved_abreast` admits no other rule than an input.
                rule => self.graph.value(Node::Input(if let Rule::Input(index) = rule { *index } else { 0 })),
            };
            self.parameters.push(value);
        }
        self.magnitude = self.graph.constant(program.scale);
        for &parameter in &self.parameters {
            self.magnitude = self.graph.result(Kind::Greater, [self.magnitude, parameter]);
        }
    }

    fn operand(&mut self, operand: Operand) -> Value {
        match operand {
            Operand::Constant(value) => self.graph.constant(value),
            Operand::Parameter(index) => self.parameters[index],
            Operand::Unknown(index) => self.unknowns[index],
            Operand::Register(index) => self.registers[index],
            Operand::Magnitude => self.magnitude,
        }
    }

    fn run(&mut self, code: &[Instruction]) {
        for line in code {
            let (a, b) = line.operation.operands();
            let a = self.operand(a);
            let b = b.map_or(a, |b| self.operand(b));
            let known = a != Value::MAX && b != Value::MAX;
            // Code that is not needed may read unknowns that are not found.
            let value = if known { self.graph.result(Kind::of(&line.operation), [a, b]) } else { Value::MAX };
            self.registers.resize(self.registers.len().max(line.target + 1), Value::MAX);
            self.registers[line.target] = value;
        }
    }

    fn block(&mut self, program: &Program, block: &Block, is_first: bool) -> Option<()> {
        self.registers.clear();
        self.run(&block.code);
        let own = self.registers.clone();
        let applies = usual(block)?;
        for case in block.cases.iter().filter(|case| !std::ptr::eq(*case, applies)) {
            self.guards(case, false);
            self.registers.clone_from(&own);
        }
        self.guards(applies, true);
        self.steps(program, applies, if is_first { 0 } else { block.branches() })
    }

    fn guards(&mut self, case: &Case, is_usual: bool) {
        self.run(&case.guard_code);
        let mut tests = Vec::new();
        for guard in &case.guards {
            tests.push(Test { value: self.operand(guard.value), scale: self.operand(guard.scale), near: guard.near });
        }
        if !tests.is_empty() {
            self.graph.guards.push((Guards { tests, is_usual }, self.graph.nodes.len()));
        }
    }

    /// The steps of a case in a block with `radix` branch numbers; `None` for steps of other kinds.
    fn steps(&mut self, program: &Program, case: &Case, radix: usize) -> Option<()> {
        for branch in &mut self.graph.branches {
            *branch = radix * *branch + case.first_branch;
        }
        for (index, step) in case.steps.iter().enumerate() {
            match step {
                Step::Compute(code) => self.run(code),
                Step::Set { unknown, value } => self.unknowns[*unknown] = self.operand(*value),
                Step::Roots { unknown, polynomials, typical, half_angle: false } => {
                    let is_plain = program.joints.iter().any(|joint| joint.value == JointValue::Plain(*unknown));
                    let usual = if is_plain { Operand::Magnitude } else { Operand::Constant(1.0) };
                    let (constant, typical) = (square(polynomials)?, typical.unwrap_or(usual));
                    let (constant, typical) = (self.operand(constant), self.operand(typical));
                    let node = Node::Root { constant, typical, number: self.graph.roots };
                    self.unknowns[*unknown] = self.graph.value(node);
                    self.graph.roots += 1;
                    let stride: usize = case.steps[index + 1..].iter().map(Step::slots).product();
                    let branches = self.graph.branches.iter();
                    self.graph.branches = branches.flat_map(|&branch| [branch, branch + stride]).collect();
                }
                _ => return None,
            }
        }
        Some(())
    }

    fn with_checks(mut self, layout: &Layout<'_>, facts: &Facts) -> Graph {
        let checks = &layout.program.checks;
        self.registers.clear();
        self.run(&checks.code);
        let residuals = checks.residuals.iter().map(|&value| self.operand(value)).collect();
        let sizes = facts.sizes.iter().map(|&value| self.operand(value)).collect();
        let places = layout.places().into_iter().map(|unknown| self.unknowns[unknown]).collect();
        Graph { residuals, sizes, places, ..self.graph }
    }
}
