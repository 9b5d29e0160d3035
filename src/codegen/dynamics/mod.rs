//! Printing equations of motion: Rust ([`Printed::rust`]) and C99 ([`Printed::c99`]).
//!
//! The recursions of [`crate::dynamics`] run over numbers that write down how they are computed; what is known beforehand is computed at once, and nothing twice. Where
//! such straight-line code would be long, a step of the recursion is written down alone, in a loop over the bodies.

mod loops;
mod recursive;
mod tape;

use serde::Serialize;

use self::recursive::{Recursive, Table};
use self::tape::{Recorded, Tape};
use super::language::{Expressions, number};
use super::names::remark;
use super::printer::{INDENT, Printer, spread};
use crate::document::word;
use crate::dynamics::{Equations, FormalState, Freedom, Place, Value};
use crate::solver::{Demand, Instruction, Operand};
use crate::{Error, ErrorKind, Result};

const RUST: &str = include_str!("../skeleton/dynamics.rs.txt");
const HEADER: &str = include_str!("../skeleton/dynamics.h.txt");
const SOURCE: &str = include_str!("../skeleton/dynamics.c.txt");

/// A function that can be printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Function {
    /// Torques of a motion.
    Inverse,
    /// Torques against gravity.
    Gravity,
    /// The inertia matrix.
    Inertia,
    /// The Coriolis matrix of Christoffel's symbols.
    Coriolis,
    /// What torques change the velocity by.
    Forward,
    /// What inverse dynamics changes by with the configuration and the velocity.
    Derivatives,
}

impl Function {
    /// All of them.
    pub const ALL: [Function; 6] = [
        Function::Inverse,
        Function::Gravity,
        Function::Inertia,
        Function::Coriolis,
        Function::Forward,
        Function::Derivatives,
    ];

    /// Its name in code.
    pub fn name(self) -> &'static str {
        match self {
            Function::Inverse => "inverse",
            Function::Gravity => "gravity",
            Function::Inertia => "inertia",
            Function::Coriolis => "coriolis",
            Function::Forward => "forward",
            Function::Derivatives => "derivatives",
        }
    }

    fn about(self) -> &'static str {
        match self {
            Function::Inverse => "The torques that a motion asks for.",
            Function::Gravity => "The torques that hold the robot against gravity.",
            Function::Inertia => "The inertia matrix M, by rows.",
            Function::Coriolis => "The Coriolis matrix C of Christoffel's symbols, by rows: M' - 2 C is skew.",
            Function::Forward => "What torques change the velocity by.",
            Function::Derivatives => {
                "What the torques of a motion change by with the configuration, and with the velocity, by rows."
            }
        }
    }

    /// What it reads beside q.
    fn inputs(self) -> &'static [&'static str] {
        match self {
            Function::Gravity | Function::Inertia => &[],
            Function::Coriolis => &["v"],
            Function::Inverse | Function::Derivatives => &["v", "a"],
            Function::Forward => &["v", "tau"],
        }
    }
}

/// How a function is printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Form {
    /// As straight-line code where that has at most so many operations as [`LONGEST`], otherwise recursive.
    #[default]
    Shorter,
    /// As straight-line code, which is fastest.
    Straight,
    /// As loops over the bodies, whose figures stand in tables.
    Recursive,
}

/// The most operations of straight-line code, unless it is asked for: some 100 KB.
pub const LONGEST: usize = 3_500;

/// What is printed of a robot.
#[derive(Clone, Debug)]
pub struct Printed<'a> {
    /// The robot's name.
    pub name: &'a str,
    /// Its equations of motion; friction is left out.
    pub equations: &'a Equations,
    /// Lines for the head of the file.
    pub remarks: Vec<String>,
    /// The functions, in order.
    pub functions: Vec<Function>,
    /// How they are printed.
    pub form: Form,
}

/// The code of one function.
struct Body {
    code: Vec<Instruction>,
    results: Vec<Operand>,
}

impl Printed<'_> {
    /// A Rust file on the crate `groebot-runtime` (edition 2024).
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for forward dynamics of a robot whose joints follow others, [`ErrorKind::BadValue`] where bodies without mass would move.
    pub fn rust(&self) -> Result<String> {
        Ok(super::fill(RUST, &self.outline(&Rust, "")?))
    }

    /// A header and a source file in C99 on `groebot_dynamics.h`, of files `stem.h` and `stem.c`; names begin with the robot's.
    ///
    /// # Errors
    /// As [`Printed::rust`].
    pub fn c99(&self, stem: &str) -> Result<[String; 2]> {
        let outline = self.outline(&C, stem)?;
        Ok([HEADER, SOURCE].map(|skeleton| super::fill(skeleton, &outline)))
    }

    /// How many operations a function takes.
    ///
    /// # Errors
    /// As [`Printed::rust`].
    pub fn operations(&self, function: Function) -> Result<usize> {
        Ok(self.record(function)?.code.len())
    }

    fn outline(&self, language: &dyn Language, stem: &str) -> Result<Outline> {
        let values = self.equations.values();
        let angles = values.iter().filter(|value| value.freedom == Freedom::Turn);
        let recursive = Recursive::new(self.equations.formal(|x| x));
        let functions = self.functions.iter().map(|function| self.function(*function, &recursive, language));
        let functions: Vec<FunctionText> = functions.collect::<Result<_>>()?;
        let loops = functions.iter().any(|function| function.is_recursive);
        let ways = values.iter().filter(|value| value.freedom == Freedom::Slide);
        let joints = self.equations.joints().iter().map(|name| format!("`{}`", remark(name)));
        let base = |coordinates: &str| -> Vec<String> {
            if self.equations.is_floating() { coordinates.split(' ').map(str::to_owned).collect() } else { Vec::new() }
        };
        let prefix = word(self.name);
        Ok(Outline {
            version: env!("CARGO_PKG_VERSION"),
            name: remark(self.name),
            guard: prefix.to_ascii_uppercase() + "_DYNAMICS",
            prefix,
            stem: stem.to_owned(),
            configuration: base("x y z qx qy qz qw").into_iter().chain(joints.clone()).collect(),
            freedoms: base("vx vy vz wx wy wz").into_iter().chain(joints).collect(),
            remarks: self.remarks.iter().map(|line| remark(line)).collect(),
            angles: angles.map(|value| joint_value(value, language)).collect(),
            ways: ways.map(|value| joint_value(value, language)).collect(),
            bodies: values.len() + 1,
            tables: if loops { language.tables(&recursive.tables()) } else { Vec::new() },
            functions,
        })
    }

    fn function(&self, function: Function, recursive: &Recursive, language: &dyn Language) -> Result<FunctionText> {
        let Body { code, results } = self.record(function)?;
        let is_recursive = self.form == Form::Recursive || self.form == Form::Shorter && code.len() > LONGEST;
        if is_recursive {
            let mut lines = language.start(function);
            lines.extend(recursive.code(function, language));
            return Ok(self.text(function, language, lines, language.finish(function), true));
        }
        let names = self.names(function, language);
        let demand = Demand::of_code(&code, &results);
        let mut printer = Printer::of(language.expressions(), &names, demand);
        let mut lines = printer.code(&code);
        let results: Vec<String> = results.into_iter().map(|result| printer.operand(result)).collect();
        let (more, answer) = language.answer(function, self.equations.freedoms(), results);
        lines.extend(more);
        Ok(self.text(function, language, lines, answer, false))
    }

    fn text(
        &self,
        function: Function,
        language: &dyn Language,
        code: Vec<String>,
        answer: String,
        is_recursive: bool,
    ) -> FunctionText {
        FunctionText {
            name: function.name(),
            about: function.about(),
            inputs: std::iter::once("q").chain(function.inputs().iter().copied()).collect(),
            parameters: language.parameters(function, self.equations),
            result: if function == Function::Derivatives {
                "[Matrix; 2]"
            } else if matches!(function, Function::Inertia | Function::Coriolis) {
                "Matrix"
            } else {
                "Row"
            },
            reads_ways: code.iter().any(|line| line.contains("way[")),
            code,
            answer,
            is_recursive,
        }
    }

    /// The inputs of the recorded code, in order: cosines, sines, ways, the root's quaternion, and what else is read.
    fn names(&self, function: Function, language: &dyn Language) -> Vec<String> {
        let values = self.equations.values();
        let turning = values.iter().filter(|value| value.freedom == Freedom::Turn).count();
        let pairs = ["c", "s"].into_iter().flat_map(|name| (0..turning).map(move |i| format!("{name}[{i}]")));
        let ways = values.iter().filter(|value| value.freedom == Freedom::Slide);
        let ways = ways.map(|value| format!("({})", joint_value(value, language)));
        let turn = (3..7).map(|i| format!("q[{i}]"));
        let lists = function.inputs().iter();
        let lists = lists.flat_map(|list| (0..self.equations.freedoms()).map(move |i| format!("{list}[{i}]")));
        pairs.chain(ways).chain(turn).chain(lists).collect()
    }

    /// Runs the recursion and writes it down.
    fn record(&self, function: Function) -> Result<Body> {
        let (tape, formal) = (Tape::default(), self.equations.formal(Recorded::constant));
        let values = self.equations.values();
        let turning = values.iter().filter(|value| value.freedom == Freedom::Turn).count();
        let sliding = values.len() - turning;
        let (mut turns, mut slides) = (0, 0);
        let place = |value: &Value| match value.freedom {
            Freedom::Turn => {
                turns += 1;
                Place::Turn([tape.input(turns - 1), tape.input(turning + turns - 1)])
            }
            Freedom::Slide => {
                slides += 1;
                Place::Slide(tape.input(2 * turning + slides - 1))
            }
        };
        let places = values.iter().map(place).collect();
        let first = 2 * turning + sliding;
        let turn = self.equations.is_floating().then(|| std::array::from_fn(|i| tape.input(first + i)));
        let count = self.equations.freedoms();
        let list = |number: usize| (0..count).map(|i| tape.input(first + 4 + number * count + i)).collect::<Vec<_>>();
        let state = FormalState { places, turn, velocity: list(0) };
        let results = match function {
            Function::Inverse => formal.inverse(&state, &list(1)),
            Function::Gravity => formal.gravity(&state),
            Function::Inertia => formal.inertia(&state),
            Function::Coriolis => formal.coriolis(&state),
            Function::Forward => formal.forward(&state, &list(1))?,
            Function::Derivatives => formal.derivatives(&state, &list(1)).concat(),
        };
        if results.iter().any(|result| !result.is_finite()) {
            let text = "a number beyond doubles comes up; are there bodies without mass that would have to move?";
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let (code, results) = tape.code(&results);
        Ok(Body { code, results })
    }
}

/// The value of a joint by the configuration.
fn joint_value(value: &Value, language: &dyn Language) -> String {
    let Value { place, factor, offset, .. } = *value;
    let mut text = format!("q[{place}]");
    if factor != 1.0 {
        text = format!("{} * {text}", language.expressions().literal(factor));
    }
    if offset != 0.0 { format!("{text} + {}", language.expressions().literal(offset)) } else { text }
}

/// What a skeleton is filled with.
#[derive(Serialize)]
struct Outline {
    version: &'static str,
    name: String,
    prefix: String,
    guard: String,
    stem: String,
    configuration: Vec<String>,
    freedoms: Vec<String>,
    remarks: Vec<String>,
    angles: Vec<String>,
    ways: Vec<String>,
    bodies: usize,
    tables: Vec<String>,
    functions: Vec<FunctionText>,
}

#[derive(Serialize)]
struct FunctionText {
    name: &'static str,
    about: &'static str,
    inputs: Vec<&'static str>,
    parameters: String,
    result: &'static str,
    code: Vec<String>,
    answer: String,
    reads_ways: bool,
    is_recursive: bool,
}

/// What differs between the languages.
trait Language {
    fn expressions(&self) -> &dyn Expressions;
    /// What is done with the results: statements, and an expression at last.
    fn answer(&self, function: Function, freedoms: usize, results: Vec<String>) -> (Vec<String>, String);
    /// The list of parameters.
    fn parameters(&self, function: Function, equations: &Equations) -> String;
    /// The results of a recursive function, nought at first, and what is returned.
    fn start(&self, function: Function) -> Vec<String>;
    /// As told.
    fn finish(&self, function: Function) -> String;
    /// The entry of a matrix of results.
    fn entry(&self, matrix: &str, row: &str, column: &str) -> String;
    /// New numbers, nought at first: so many of each body.
    fn zeros(&self, name: &str, count: usize) -> String;
    /// So many alone.
    fn zero_row(&self, name: &str, count: usize) -> String;
    /// A place in a table that does not change.
    fn index(&self, name: &str, value: &str) -> String;
    /// The head of a loop through the bodies: `i`.
    fn bodies(&self, inward: bool) -> &'static str;
    /// What begins with a body and goes on while there is one: `j`.
    fn climb(&self) -> [&'static str; 2];
    /// The head of a block.
    fn when(&self, condition: &str) -> String;
    /// Tables of a file, and how many rows they have.
    fn tables(&self, tables: &[Table]) -> Vec<String>;
}

/// The rows of a table as text.
fn rows(table: &Table, brackets: [&str; 2], literal: impl Fn(f64) -> String) -> String {
    match table {
        Table::Places(_, places) => places.iter().map(ToString::to_string).collect::<Vec<_>>().join(", "),
        Table::Numbers(_, rows) => {
            let row = |row: &Vec<f64>| {
                let numbers: Vec<String> = row.iter().map(|number| literal(*number)).collect();
                format!("\n{INDENT}{}{}{}", brackets[0], numbers.join(", "), brackets[1])
            };
            rows.iter().map(row).collect::<Vec<_>>().join(",")
        }
    }
}

/// The results of a function by name, and whether they are matrices.
fn results(function: Function) -> (&'static [&'static str], bool) {
    match function {
        Function::Derivatives => (&["by_q", "by_v"], true),
        Function::Inertia | Function::Coriolis => (&["out"], true),
        _ => (&["out"], false),
    }
}

struct Rust;

impl Language for Rust {
    fn expressions(&self) -> &dyn Expressions {
        self
    }

    fn answer(&self, function: Function, freedoms: usize, results: Vec<String>) -> (Vec<String>, String) {
        let row = |row: &[String]| spread("[", row, "]").join("\n    ");
        let matrix = |rows: &[String]| {
            let rows: Vec<String> = rows.chunks(freedoms).map(row).collect();
            format!("[\n    {},\n    ]", rows.join(",\n    "))
        };
        let answer = match function {
            Function::Derivatives => {
                let both: Vec<String> = results.chunks(freedoms * freedoms).map(matrix).collect();
                format!("[{}]", both.join(", "))
            }
            Function::Inertia | Function::Coriolis => matrix(&results),
            _ => row(&results),
        };
        (Vec::new(), answer)
    }

    fn parameters(&self, _: Function, _: &Equations) -> String {
        String::new()
    }

    fn start(&self, function: Function) -> Vec<String> {
        let (names, are_matrices) = results(function);
        let zeros = if are_matrices { "[[0.0; FREEDOMS]; FREEDOMS]" } else { "[0.0; FREEDOMS]" };
        names.iter().map(|name| format!("let mut {name} = {zeros};")).collect()
    }

    fn finish(&self, function: Function) -> String {
        match results(function) {
            ([one], _) => (*one).to_owned(),
            (all, _) => format!("[{}]", all.join(", ")),
        }
    }

    fn entry(&self, matrix: &str, row: &str, column: &str) -> String {
        format!("{matrix}[{row}][{column}]")
    }

    fn zeros(&self, name: &str, count: usize) -> String {
        format!("let mut {name} = [[0.0; {count}]; BODIES];")
    }

    fn zero_row(&self, name: &str, count: usize) -> String {
        format!("let mut {name} = [0.0; {count}];")
    }

    fn index(&self, name: &str, value: &str) -> String {
        format!("let {name} = {value};")
    }

    fn bodies(&self, inward: bool) -> &'static str {
        if inward { "for i in (1..BODIES).rev() {" } else { "for i in 1..BODIES {" }
    }

    fn climb(&self) -> [&'static str; 2] {
        ["let mut j = i;", "while j != 0 {"]
    }

    fn when(&self, condition: &str) -> String {
        format!("if {condition} {{")
    }

    fn tables(&self, tables: &[Table]) -> Vec<String> {
        let table = |table: &Table| {
            let rows = rows(table, ["[", "]"], number);
            let (name, kind) = match table {
                Table::Places(name, _) => (name, "usize".to_owned()),
                Table::Numbers(name, all) => (name, format!("[f64; {}]", all[0].len())),
            };
            format!("static {name}: [{kind}; BODIES] = [{rows}];")
        };
        tables.iter().map(table).collect()
    }
}

struct C;

impl Language for C {
    fn expressions(&self) -> &dyn Expressions {
        self
    }

    fn answer(&self, function: Function, freedoms: usize, results: Vec<String>) -> (Vec<String>, String) {
        let size = freedoms * freedoms;
        let written = |(at, result): (usize, String)| match function {
            Function::Derivatives if at < size => format!("by_q[{at}] = {result};"),
            Function::Derivatives => format!("by_v[{}] = {result};", at - size),
            _ => format!("out[{at}] = {result};"),
        };
        (results.into_iter().enumerate().map(written).collect(), String::new())
    }

    fn parameters(&self, function: Function, equations: &Equations) -> String {
        let (coordinates, freedoms) = (equations.coordinates(), equations.freedoms());
        let read = |(name, count): (&str, usize)| format!("const gb_real {name}[{count}]");
        let reads = std::iter::once(("q", coordinates)).chain(function.inputs().iter().map(|name| (*name, freedoms)));
        let size = freedoms * freedoms;
        let written = match function {
            Function::Derivatives => format!("gb_real by_q[{size}], gb_real by_v[{size}]"),
            Function::Inertia | Function::Coriolis => format!("gb_real out[{size}]"),
            _ => format!("gb_real out[{freedoms}]"),
        };
        reads.map(read).chain([written]).collect::<Vec<_>>().join(", ")
    }

    fn start(&self, function: Function) -> Vec<String> {
        let (names, are_matrices) = results(function);
        let count = if are_matrices { "FREEDOMS * FREEDOMS" } else { "FREEDOMS" };
        let zero = |name: &&str| format!("{INDENT}{name}[k] = 0;");
        let head = format!("for (int k = 0; k < {count}; ++k) {{");
        std::iter::once(head).chain(names.iter().map(zero)).chain(["}".to_owned()]).collect()
    }

    fn finish(&self, _: Function) -> String {
        String::new()
    }

    fn entry(&self, matrix: &str, row: &str, column: &str) -> String {
        format!("{matrix}[{row} * FREEDOMS + {column}]")
    }

    fn zeros(&self, name: &str, count: usize) -> String {
        format!("gb_real {name}[BODIES][{count}] = {{{{0}}}};")
    }

    fn zero_row(&self, name: &str, count: usize) -> String {
        format!("gb_real {name}[{count}] = {{0}};")
    }

    fn index(&self, name: &str, value: &str) -> String {
        format!("const int {name} = {value};")
    }

    fn bodies(&self, inward: bool) -> &'static str {
        if inward { "for (int i = BODIES - 1; i > 0; --i) {" } else { "for (int i = 1; i < BODIES; ++i) {" }
    }

    fn climb(&self) -> [&'static str; 2] {
        ["int j = i;", "while (j != 0) {"]
    }

    fn when(&self, condition: &str) -> String {
        format!("if ({condition}) {{")
    }

    fn tables(&self, tables: &[Table]) -> Vec<String> {
        let table = |table: &Table| {
            // Whole numbers are numbers of either precision.
            let literal = |value: f64| if value == value.trunc() { value.to_string() } else { self.literal(value) };
            let rows = rows(table, ["{", "}"], literal);
            match table {
                Table::Places(name, _) => format!("static const int {name}[BODIES] = {{{rows}}};"),
                Table::Numbers(name, all) => {
                    format!("static const gb_real {name}[BODIES][{}] = {{{rows}}};", all[0].len())
                }
            }
        };
        tables.iter().map(table).collect()
    }
}

impl Expressions for Rust {
    fn is_reserved(&self, _: &str) -> bool {
        false
    }

    fn call(&self, function: &str, argument: &str) -> String {
        format!("f64::{function}({argument})")
    }

    fn root(&self, square: &str) -> String {
        format!("f64::sqrt({square})")
    }

    fn declare(&self, name: &str, value: &str) -> String {
        format!("let {name} = {value};")
    }

    fn infinity(&self, positive: bool) -> String {
        if positive { "f64::INFINITY" } else { "f64::NEG_INFINITY" }.to_owned()
    }

    fn quote(&self, text: &str) -> String {
        format!("\"{}\"", text.escape_default())
    }
}

impl Expressions for C {
    fn is_reserved(&self, _: &str) -> bool {
        false
    }

    fn call(&self, function: &str, argument: &str) -> String {
        format!("{function}({argument})")
    }

    fn root(&self, square: &str) -> String {
        format!("sqrt({square})")
    }

    fn literal(&self, value: f64) -> String {
        let text = number(value);
        text.strip_prefix('-').map_or_else(|| format!("GB_N({text})"), |size| format!("-GB_N({size})"))
    }

    fn declare(&self, name: &str, value: &str) -> String {
        format!("const gb_real {name} = {value};")
    }

    fn infinity(&self, positive: bool) -> String {
        if positive { "INFINITY" } else { "-INFINITY" }.to_owned()
    }

    fn quote(&self, text: &str) -> String {
        format!("\"{text}\"")
    }
}
