//! The order of a graph's operations, and the addresses of its values in memory. Main type: [`Plan`].

use super::super::code::{Kind, narrow};
use super::graph::{Graph, Guards, Node, Test, Value};

/// The use of a row of lanes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Abreast {
    /// Several targets. A value has one row for each combination of the roots before it, of which there are at most this
    /// number: the last root may be that of pairs.
    Targets { roots: usize },
    /// The candidates of one target: each value has this number of rows.
    Candidates { rows: usize },
}

/// The rows of a value: those of consecutive indices, each for `1 << shift` rows of the results.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Rows {
    pub first: u32,
    pub shift: u32,
}

impl Rows {
    /// The address of the row for this index.
    #[inline(always)]
    pub fn at(self, index: usize) -> usize {
        self.first as usize + (index >> self.shift)
    }
}

/// A step of straight-line code.
#[derive(Clone, Copy, Debug)]
pub(super) struct Step {
    pub action: Action,
    /// The number of rows of the result, or of the values that guards compare.
    pub rows: u32,
    /// The first row of the result, or the index of guards.
    pub target: u32,
    /// The operands; those that the action does not have are the first one.
    pub operands: [Rows; 4],
}

#[derive(Clone, Copy, Debug)]
pub(super) enum Action {
    Compute(Kind),
    /// `a b + c`, with two roundings. A product that only a sum reads is not stored.
    ProductPlus,
    /// `a b - c`
    ProductMinus,
    /// `c - a b`
    MinusProduct,
    /// `a b + c d`
    ProductsSum,
    /// `a b - c d`
    ProductsDifference,
    /// Both roots in turn.
    Roots,
    /// The first root of a pair.
    FirstRoot,
    /// The root that the candidate's index selects, by its bit.
    OwnRoot {
        bit: u32,
    },
    /// Guards.
    Guard,
}

/// A comparison by addresses.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlacedTest {
    pub value: Rows,
    pub scale: Rows,
    pub near: bool,
}

/// Straight-line code.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    pub steps: Vec<Step>,
    pub constants: Vec<(u32, f64)>,
    /// The address of each number of the target that is read.
    pub inputs: Vec<(u32, usize)>,
    /// The tests of each case's guards, and whether it applies to ordinary targets.
    pub guards: Vec<(Vec<PlacedTest>, bool)>,
    /// The number of rows of memory.
    pub size: usize,
    /// The number of rows of a candidate's values.
    pub rows: usize,
    pub places: Vec<Rows>,
    pub residuals: Vec<Rows>,
    pub sizes: Vec<Rows>,
}

impl Plan {
    pub fn new(graph: &Graph, abreast: Abreast) -> Self {
        let mut planner = Planner::new(graph, abreast);
        let plan = Plan {
            steps: Vec::new(),
            constants: Vec::new(),
            inputs: Vec::new(),
            guards: Vec::new(),
            size: 0,
            rows: planner.rows(graph.roots),
            places: Vec::new(),
            residuals: Vec::new(),
            sizes: Vec::new(),
        };
        let plan = planner.steps(plan);
        let rows = |values: &[Value]| values.iter().map(|&value| planner.read(value, plan.rows)).collect();
        Plan {
            places: rows(&graph.places),
            residuals: rows(&graph.residuals),
            sizes: rows(&graph.sizes),
            size: planner.size,
            ..plan
        }
    }
}

struct Planner<'a> {
    graph: &'a Graph,
    abreast: Abreast,
    /// By value, its number of reads that are left; results are never released.
    reads: Vec<usize>,
    /// By value, the sum or difference that is the only reader.
    sums: Vec<Option<Value>>,
    /// By value, its first row.
    first: Vec<u32>,
    /// By the logarithm of a number of rows, first rows that are used again.
    free: Vec<Vec<u32>>,
    size: usize,
}

impl<'a> Planner<'a> {
    fn new(graph: &'a Graph, abreast: Abreast) -> Self {
        let mut reads = vec![0; graph.nodes.len()];
        let results = graph.places.iter().chain(&graph.residuals).chain(&graph.sizes);
        results.for_each(|&value| reads[value] += 1);
        for test in graph.guards.iter().flat_map(|(guards, _)| &guards.tests) {
            [test.value, test.scale].into_iter().for_each(|value| reads[value] += 1);
        }
        for (value, node) in graph.nodes.iter().enumerate().rev() {
            // Roots are found even if nothing reads them: they determine which candidates exist.
            reads[value] += usize::from(matches!(node, Node::Root { .. }));
            if reads[value] > 0 {
                operands(node).into_iter().for_each(|operand| reads[operand] += 1);
            }
        }
        let mut sums = vec![None; graph.nodes.len()];
        for (value, node) in graph.nodes.iter().enumerate().filter(|(value, _)| reads[*value] > 0) {
            if let Node::Result(Kind::Add | Kind::Sub, operands) = *node {
                operands
                    .into_iter()
                    .filter(|&operand| reads[operand] == 1)
                    .for_each(|operand| sums[operand] = Some(value));
            }
        }
        let first = vec![u32::MAX; graph.nodes.len()];
        Planner { graph, abreast, reads, sums, first, free: vec![Vec::new(); usize::BITS as usize], size: 0 }
    }

    /// The number of rows of a value after this number of roots.
    fn rows(&self, level: usize) -> usize {
        match self.abreast {
            Abreast::Targets { roots } => 1 << level.min(roots),
            Abreast::Candidates { rows } => rows,
        }
    }

    fn rows_of(&self, value: Value) -> usize {
        match self.graph.nodes[value] {
            Node::Constant(_) | Node::Input(_) => 1,
            Node::Result(..) | Node::Root { .. } => self.rows(self.graph.levels[value]),
        }
    }

    /// The place of a value that is read for this number of rows.
    fn read(&self, value: Value, rows: usize) -> Rows {
        Rows { first: self.first[value], shift: (rows / self.rows_of(value)).trailing_zeros() }
    }

    fn take(&mut self, value: Value) -> u32 {
        let rows = self.rows_of(value);
        let first = self.free[rows.trailing_zeros() as usize].pop().unwrap_or_else(|| {
            self.size += rows;
            narrow(self.size - rows)
        });
        self.first[value] = first;
        first
    }

    /// Ends a read of a value; its rows are used again after the last one.
    fn release(&mut self, value: Value) {
        self.reads[value] -= 1;
        let is_computed = matches!(self.graph.nodes[value], Node::Result(..) | Node::Root { .. });
        if self.reads[value] == 0 && is_computed {
            let class = self.rows_of(value).trailing_zeros() as usize;
            self.free[class].push(self.first[value]);
        }
    }

    /// Constants and inputs are written before the code runs: no result has their rows.
    fn start(&mut self, plan: &mut Plan) {
        for (value, node) in self.graph.nodes.iter().enumerate().filter(|(value, _)| self.reads[*value] > 0) {
            match *node {
                Node::Constant(bits) => {
                    plan.constants.push((narrow(self.size), f64::from_bits(bits)));
                }
                Node::Input(input) => plan.inputs.push((narrow(self.size), input)),
                Node::Result(..) | Node::Root { .. } => continue,
            }
            self.first[value] = narrow(self.size);
            self.size += 1;
        }
    }

    fn steps(&mut self, mut plan: Plan) -> Plan {
        self.start(&mut plan);
        let graph = self.graph;
        let mut guards = graph.guards.iter().peekable();
        for value in 0..=graph.nodes.len() {
            while let Some((own, _)) = guards.next_if(|(_, known)| *known <= value) {
                self.guard(own, &mut plan);
            }
            let Some(node) = graph.nodes.get(value).filter(|_| self.reads[value] > 0) else { continue };
            match *node {
                Node::Constant(_) | Node::Input(_) => {}
                Node::Result(..) if self.is_fused(value) => {}
                Node::Result(kind, operands) => {
                    let (action, operands) = self.fused(kind, operands);
                    plan.steps.push(self.step(action, value, &operands));
                }
                Node::Root { constant, typical, number } => {
                    plan.steps.push(self.step(self.root(number), value, &[constant, typical]));
                }
            }
        }
        plan
    }

    fn root(&self, number: usize) -> Action {
        match self.abreast {
            Abreast::Targets { roots } if number < roots => Action::Roots,
            Abreast::Targets { .. } => Action::FirstRoot,
            Abreast::Candidates { .. } => Action::OwnRoot { bit: (self.graph.roots - 1 - number) as u32 },
        }
    }

    /// Whether a value is a product that only a sum or a difference with the same number of rows reads.
    fn is_fused(&self, value: Value) -> bool {
        let is_product = matches!(self.graph.nodes[value], Node::Result(Kind::Mul, _));
        is_product && self.sums[value].is_some_and(|sum| self.rows_of(sum) == self.rows_of(value))
    }

    /// The action and the operands of a result, with the products among its operands.
    fn fused(&self, kind: Kind, [x, y]: [Value; 2]) -> (Action, Vec<Value>) {
        let product = |value: Value| match self.graph.nodes[value] {
            Node::Result(Kind::Mul, operands) if self.is_fused(value) => Some(operands),
            _ => None,
        };
        let is_sum = kind == Kind::Add;
        match (product(x), product(y)) {
            _ if !matches!(kind, Kind::Add | Kind::Sub) => (Action::Compute(kind), vec![x, y]),
            (Some([a, b]), Some([c, d])) => {
                (if is_sum { Action::ProductsSum } else { Action::ProductsDifference }, vec![a, b, c, d])
            }
            (Some([a, b]), None) => (if is_sum { Action::ProductPlus } else { Action::ProductMinus }, vec![a, b, y]),
            (None, Some([a, b])) => (if is_sum { Action::ProductPlus } else { Action::MinusProduct }, vec![a, b, x]),
            (None, None) => (Action::Compute(kind), vec![x, y]),
        }
    }

    fn step(&mut self, action: Action, value: Value, operands: &[Value]) -> Step {
        // Both roots are found from rows without them.
        let rows = if let Action::Roots = action { self.rows_of(value) / 2 } else { self.rows_of(value) };
        let read = |index: usize| self.read(operands.get(index).copied().unwrap_or(operands[0]), rows);
        let addresses = std::array::from_fn(read);
        operands.iter().for_each(|&operand| self.release(operand));
        let target = self.take(value);
        Step { action, rows: narrow(rows), target, operands: addresses }
    }

    fn guard(&mut self, guards: &Guards, plan: &mut Plan) {
        let values = || guards.tests.iter().flat_map(|test| [test.value, test.scale]);
        let rows = values().map(|value| self.rows_of(value)).max().unwrap_or(1);
        let placed = |test: &Test| PlacedTest {
            value: self.read(test.value, rows),
            scale: self.read(test.scale, rows),
            near: test.near,
        };
        let tests = guards.tests.iter().map(placed).collect();
        values().for_each(|value| self.release(value));
        let target = narrow(plan.guards.len());
        plan.guards.push((tests, guards.is_usual));
        let operands = [Rows::default(); 4];
        plan.steps.push(Step { action: Action::Guard, rows: narrow(rows), target, operands });
    }
}

/// The values that a node reads.
fn operands(node: &Node) -> Vec<Value> {
    match *node {
        Node::Constant(_) | Node::Input(_) => Vec::new(),
        Node::Result(_, operands) => operands.to_vec(),
        Node::Root { constant, typical, .. } => vec![constant, typical],
    }
}
