//! The values of a program for the skeleton of a printed file. Main type: [`Outline`].

use serde::Serialize;

use super::about::AboutText;
use super::body::Scene;
use super::dialect::Dialect;
use super::language::Expressions;
use super::names::{Names, remark};
use super::parts::{Parts, RedundantText};
use super::reserved::prefix;
use super::samples::Table;
use super::walk::{self, Function, reads};
use crate::solver::eigenvalue::SixAxes;
use crate::solver::{
    Case, Demand, Described, Facts, JointValue, Layout, Operand, ParameterDemand, Program, Rule, Short, Unit,
};

/// All values that the skeletons use.
#[derive(Serialize)]
pub(super) struct Outline {
    pub name: String,
    /// The name of files without extension.
    pub stem: String,
    /// The number of the program in its file: 0 for the main one.
    part: usize,
    pub version: &'static str,
    pub about: AboutText,
    inputs: Vec<Quantity>,
    /// The inputs with their units.
    target: Vec<String>,
    joints: Vec<Quantity>,
    pub facts: Facts,
    /// The strata for which no derivation exists.
    open: Vec<String>,
    samples: Vec<TableText>,
    degree: usize,
    scale: String,
    chains: Vec<ChainText>,
    /// Whether a chain has given joints between the six.
    has_given: bool,
    /// The names of the parameters.
    parameters: Vec<String>,
    target_lines: Vec<String>,
    /// The arm and its other programs, if the program is the main one of a redundant arm.
    pub redundant: Option<RedundantText>,
    functions: Vec<FunctionText>,
    tip: Option<Body>,
    /// The equations' values, unless all of them are comparisons with the tip.
    values: Option<Body>,
    /// The values of the mechanism as described, if the equations are those of the ideal mechanism, and the tolerance.
    described: Option<Body>,
    within: Option<String>,
    sizes: Body,
    /// The derivatives, unless the run time computes them from the values.
    jacobian: Option<Body>,
    short: Option<Body>,
}

/// A function of a block.
#[derive(Serialize)]
struct FunctionText {
    number: usize,
    label: String,
    known: Vec<String>,
    lines: Vec<String>,
    is_inlined: bool,
    is_led_to_rarely: bool,
    parameters: Vec<Option<String>>,
}

/// A table of samples.
#[derive(Serialize)]
struct TableText {
    width: usize,
    length: usize,
    rows: Vec<String>,
}

impl TableText {
    fn new(dialect: &dyn Dialect, table: &Table) -> Self {
        let rows: Vec<String> = table.rows().iter().map(|row| dialect.row(row)).collect();
        TableText { width: table.rows().first().map_or(1, Vec::len), length: rows.len(), rows }
    }
}

/// The constants of six axes.
#[derive(Serialize)]
struct ChainText {
    six: String,
    /// The given joints between the six, if there are any.
    given: Option<String>,
}

impl ChainText {
    fn new(dialect: &dyn Dialect, six: &SixAxes) -> Self {
        ChainText { six: dialect.chain(six), given: (!six.parts().given.is_empty()).then(|| dialect.given_axes(six)) }
    }
}

/// Lines, and rows of values.
#[derive(Serialize)]
struct Body {
    lines: Vec<String>,
    rows: Vec<Vec<String>>,
    parameters: Vec<Option<String>>,
    reads_at: bool,
}

impl Outline {
    /// The outline of the main program.
    pub fn new(parts: &Parts<'_>, dialect: &dyn Dialect, plain: &dyn Expressions) -> Self {
        Outline::of_part(parts, (0, parts.main), dialect, plain)
    }

    /// The outline of a valid program with its number: 0 for the main one. The language `plain` is for code that computes with a single number.
    pub fn of_part(
        parts: &Parts<'_>,
        (part, program): (usize, &Program),
        dialect: &dyn Dialect,
        plain: &dyn Expressions,
    ) -> Self {
        let (names, layout) = (Names::new(program, dialect), Layout::new(program));
        let scene = Scene { program, layout, language: dialect, names, parts };
        let demand = demanded(&scene, program.cases().any(|case| !case.open));
        let named = scene.names.parameters.iter().zip(&demand.fields);
        let mut parameters: Vec<String> = named.filter(|(_, read)| **read).map(|(name, _)| name.clone()).collect();
        let mut target_lines = target_lines(&scene, &demand);
        if demand.magnitude {
            target_lines.extend(dialect.magnitude(program.scale, &scene.names.parameters));
            parameters.push("magnitude".to_owned());
        }
        let mut facts = Facts::new(&scene.layout);
        let place = |parameter: &usize| parameters.iter().position(|name| *name == scene.names.parameters[*parameter]);
        facts.compared = facts.compared.iter().filter_map(place).collect();
        let text = |language: &dyn Expressions, rows: &[&[Operand]]| {
            let (lines, rows) = scene.checks(language, rows);
            Body::new(lines, rows, &parameters)
        };
        let described = |described: &Described| {
            let (lines, rows) = scene.equations(dialect, &described.code, &[&described.residuals]);
            Body::new(lines, rows, &parameters)
        };
        let checks = &program.checks;
        let rows = |rows: &[Vec<Operand>]| text(plain, &rows.iter().map(Vec::as_slice).collect::<Vec<_>>());
        let forward = program.forward().filter(|forward| !forward.inputs.is_empty());
        let tip = forward.map(|forward| {
            let value =
                |equation: &Option<(Operand, usize)>| equation.map_or(Operand::Constant(0.0), |(value, _)| value);
            text(dialect, &[&forward.equations.iter().map(value).collect::<Vec<_>>()])
        });
        let short = || {
            let columns = |joint: usize| checks.short.iter().map(|short| short.derivatives[joint]).collect();
            let mut rows: Vec<Vec<Operand>> = vec![
                checks.short.iter().map(|short| short.residual).collect(),
                checks.short.iter().map(|short| short.scale).collect(),
            ];
            rows.extend((0..program.joints.len()).map(columns));
            text(dialect, &rows.iter().map(Vec::as_slice).collect::<Vec<_>>())
        };
        let function = |function: Function| FunctionText::new(&parameters, function);
        let sixes = &parts.six_axes;
        Outline {
            name: prefix(&parts.main.name),
            stem: prefix(&parts.main.name),
            part,
            degree: program.degree(),
            scale: dialect.literal(program.scale),
            version: env!("CARGO_PKG_VERSION"),
            about: AboutText::new(program, dialect),
            inputs: program.inputs.iter().map(|i| Quantity::new(dialect, &i.name, i.unit, false)).collect(),
            target: program.inputs.iter().map(|i| format!("`{}` ({})", remark(&i.name), unit_text(i.unit))).collect(),
            joints: joints(program, dialect),
            open: program.cases().filter(|case| case.open).map(|case: &Case| dialect.quote(&case.label)).collect(),
            values: facts.compared.is_empty().then(|| text(dialect, &[&checks.residuals])),
            samples: parts.tables.iter().map(|table| TableText::new(dialect, table)).collect(),
            chains: sixes.iter().map(|six| ChainText::new(dialect, six)).collect(),
            has_given: sixes.iter().any(|six| !six.parts().given.is_empty()),
            target_lines,
            redundant: None,
            functions: walk::functions(&scene, dialect).into_iter().map(function).collect(),
            tip,
            described: program.described.as_ref().map(described),
            within: facts.within.map(|within| dialect.literal(within)),
            sizes: text(dialect, &[&facts.sizes]),
            jacobian: (!facts.are_affine).then(|| rows(&checks.jacobian)),
            short: program.nearby.then(short),
            parameters,
            facts,
        }
    }
}

impl FunctionText {
    fn new(parameters: &[String], function: Function) -> Self {
        FunctionText {
            parameters: read_of(parameters, &function.lines),
            number: function.number,
            label: function.label,
            known: function.known,
            lines: function.lines,
            is_inlined: function.is_inlined,
            is_led_to_rarely: function.is_led_to_rarely,
        }
    }
}

impl Body {
    fn new(lines: Vec<String>, rows: Vec<Vec<String>>, parameters: &[String]) -> Self {
        let all: Vec<String> = lines.iter().chain(rows.iter().flatten()).cloned().collect();
        let reads_at = all.iter().any(|line| line.contains("*at") || line.contains("at["));
        Body { parameters: read_of(parameters, &all), reads_at, lines, rows }
    }
}

/// Declarations of the computed parameters. The target numbers are declared together if all are parameters.
fn target_lines(scene: &Scene<'_>, demand: &ParameterDemand) -> Vec<String> {
    let rules = scene.program.parameters.iter().enumerate();
    let are_inputs =
        rules.clone().all(|(index, parameter)| parameter.rule == Rule::Input(index) && demand.computed[index]);
    if are_inputs && scene.program.parameters.len() == scene.program.inputs.len() {
        let names: Vec<&str> = scene.names.parameters.iter().map(String::as_str).collect();
        return scene.language.declare_all(&names, "target");
    }
    scene.parameters(demand)
}

/// By parameter, its name if the lines read it. Empty if they read none.
fn read_of(parameters: &[String], lines: &[String]) -> Vec<Option<String>> {
    let read: Vec<Option<String>> = parameters.iter().map(|name| reads(lines, name).then(|| name.clone())).collect();
    if read.iter().all(Option::is_none) { Vec::new() } else { read }
}

/// An input or a joint.
#[derive(Serialize)]
struct Quantity {
    name: String,
    quoted: String,
    unit: &'static str,
    is_angle: bool,
}

impl Quantity {
    fn new(language: &dyn Expressions, name: &str, unit: Unit, is_angle: bool) -> Self {
        Quantity { name: remark(name), quoted: language.quote(name), unit: unit_text(unit), is_angle }
    }
}

/// The parameters that the printed code needs.
fn demanded(scene: &Scene<'_>, has_answers: bool) -> ParameterDemand {
    let program = scene.program;
    let last = program.blocks.len() - 1;
    let mut readers: Vec<Demand> = Vec::new();
    for (index, block) in program.blocks.iter().enumerate() {
        let wanted = if index < last { scene.layout.wanted_of(index) } else { scene.layout.wanted() };
        readers.extend(scene.layout.block_demands(block, &wanted));
    }
    let checks = &program.checks;
    readers.push(Demand::of_code(&checks.code, &checks.residuals));
    if has_answers {
        readers.push(Demand::of_code(&checks.code, &checks.scales));
        readers.push(Demand::of_code(&checks.code, checks.jacobian.iter().flatten()));
        readers.push(Demand::of_code(&checks.code, checks.short.iter().flat_map(Short::operands)));
    }
    ParameterDemand::new(program, &readers.iter().collect::<Vec<_>>())
}

fn joints(program: &Program, language: &dyn Expressions) -> Vec<Quantity> {
    program
        .joints
        .iter()
        .map(|j| Quantity::new(language, &j.name, j.unit, matches!(j.value, JointValue::Angle { .. })))
        .collect()
}

fn unit_text(unit: Unit) -> &'static str {
    match unit {
        Unit::Metre => "m",
        Unit::Millimetre => "mm",
        Unit::Radian => "rad",
        Unit::One => "1",
    }
}
